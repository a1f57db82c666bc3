//! Restitutions between 0 and 1, and numbers that stay numbers.

use nearwall::effect::EFFECTS;
use nearwall::{Impact, ImpactRng, Model};
use proptest::prelude::*;

use crate::cases::{
    config, decades, effects_but, impacts, normal_laws, resolve, table, tangential_laws, wax,
};

/// Effects that leave 0 to 1 by design.
const BEYOND_ONE: [&str; 4] = [
    "micro-roughness",       // turns speed along the wall into speed away from it
    "agglomerates",          // draws e_n up to 1.5: turned spin adds to what came towards the wall
    "oblique-angle", // a negative strength turns speed along the wall into speed away from it, e_n <= v/v_n
    "tangential-compliance", // near_normal may be given as up to 1.5; below with 0 to 1
];

/// Either end, or uniform in the logarithm.
fn ends(low: f64, high: f64) -> impl Strategy<Value = f64> + Clone {
    prop_oneof![Just(low), Just(high), decades(low, high)]
}

/// The five mechanical properties of a material, as in `src/material`.
fn material() -> impl Strategy<Value = String> {
    let (density, modulus, strength) = (ends(0.01, 2.5e5), ends(1.0, 1e13), ends(0.01, 1e12));
    let poisson = prop_oneof![Just(-0.999), Just(0.5), -0.999..0.5];
    let energy = prop_oneof![Just(0.0), ends(1e-12, 100.0)];
    (density, modulus, poisson, strength, energy).prop_map(|(density, modulus, poisson, strength, energy)| {
        format!(
            "density = {density:e}\nyoungs_modulus = {modulus:e}\npoisson_ratio = {poisson:e}\n\
             yield_strength = {strength:e}\nsurface_energy = {energy:e}\n"
        )
    })
}

proptest! {
    #![proptest_config(config(300))]

    /// Without incoming spin. With it `e_t` is no share any more: backspin throws back (below 0),
    /// forward spin drives on (above 1).
    #[test]
    fn restitutions_and_probabilities_are_shares(
        normal in normal_laws(),
        tangential in tangential_laws(),
        effects in effects_but(&BEYOND_ONE),
        oblique in prop_oneof![Just(None), (0.0..20.0, 0.0..3.0, 0.1..20.0).prop_map(Some)],
        compliance in prop_oneof![Just(None), (0.0..10.0, 0.0..=1.0, 0.05..20.0).prop_map(Some)],
        impact in impacts(),
        key in any::<u64>(),
    ) {
        let mut effects = effects;
        effects += &oblique.map_or_else(String::new, |(a, b, c)| table("oblique-angle", &[a, b, c]));
        effects += &compliance.map_or_else(String::new, |(a, b, c)| table("tangential-compliance", &[a, b, c]));
        let model = wax(&normal, &tangential, &effects);
        let outcome = model.resolve(0, &impact, ImpactRng::new(1, key)).unwrap();
        for share in [outcome.normal_restitution, outcome.tangential_restitution, outcome.sticking_probability] {
            prop_assert!((0.0..=1.0).contains(&share), "{outcome:?}\n{effects}");
        }
    }

    /// Numbers that are legal but far from any particle: every output is a number. `e_t` is finite
    /// without spin; with spin it is what spin makes of a speed along the wall that may be next to
    /// nothing, and may exceed every number.
    #[test]
    fn far_away_inputs_give_numbers(
        normal in prop_oneof![Just(crate::cases::THORNTON_NING.to_owned()), crate::cases::listed_normal_laws()],
        tangential in tangential_laws(),
        effects in effects_but(&[]),
        exponents in proptest::array::uniform9(-300.0..300.0),
        zeros in proptest::array::uniform9(0u8..4),
        spin in prop_oneof![Just(0.0), (-300.0..300.0).prop_map(|power| 10f64.powf(power)), (-300.0..300.0).prop_map(|power| -(10f64.powf(power)))],
        key in any::<u64>(),
    ) {
        let number = |index: usize| 10f64.powf(exponents[index]);
        let or_zero = |index: usize| if zeros[index] == 0 { 0.0 } else { number(index) };
        let impact = Impact {
            normal_speed: or_zero(0),
            tangential_speed: or_zero(1),
            diameter: number(2),
            particle_temperature: number(3),
            layer_thickness: or_zero(4),
            film_thickness: or_zero(5),
            gas_speed: or_zero(6),
            roughness: or_zero(7),
            melt_thickness: or_zero(8),
            spin,
            ..Impact::default()
        };
        let model = wax(&normal, &tangential, &effects);
        let outcome = model.resolve(0, &impact, ImpactRng::new(1, key)).unwrap();
        prop_assert!(outcome.normal_restitution.is_finite() && outcome.normal_restitution >= 0.0, "{outcome:?}");
        prop_assert!((0.0..=1.0).contains(&outcome.sticking_probability), "{outcome:?}");
        prop_assert!(!outcome.tangential_restitution.is_nan() && !outcome.spin.is_nan(), "{outcome:?}");
        if spin == 0.0 {
            prop_assert!(outcome.tangential_restitution.is_finite(), "{outcome:?}");
        }
        let speeds = model.speeds(0, &impact).unwrap();
        prop_assert!(!speeds.sticking.is_nan() && speeds.sticking >= 0.0, "{speeds:?}");
    }

    /// Materials at the ends of what a model file may say, and anywhere between: numbers, and shares that are shares.
    #[test]
    fn the_most_extreme_materials_give_numbers(
        particle in material(),
        wall in material(),
        raised in any::<bool>(),
        ratio in ends(1e-6, 1e6),
        work in prop_oneof![Just(None), Just(Some(0.0)), ends(1e-12, 1e3).prop_map(Some)],
        impact in impacts(),
    ) {
        let law = if raised { "thornton-ning-raised-pull-off" } else { "thornton-ning" };
        let work = work.map_or_else(String::new, |work| format!("work_of_adhesion = {work:e}\n"));
        let text = format!(
            "[particle]\nmaterial = \"p\"\n[walls.default]\nmaterial = \"w\"\n[normal]\nmodel = \"{law}\"\n\
             yield_ratio = {ratio:e}\n{work}[tangential]\nmodel = \"constant\"\ne_t = 1\n\
             [materials.p]\n{particle}[materials.w]\n{wall}"
        );
        let model = Model::from_toml("extreme", &text).unwrap();
        let outcome = resolve(&model, &impact);
        for share in [outcome.normal_restitution, outcome.sticking_probability] {
            prop_assert!((0.0..=1.0).contains(&share), "{outcome:?}\n{text}");
        }
        let speeds = model.speeds(0, &impact).unwrap();
        for speed in [speeds.adhesive, speeds.yielding, speeds.sticking] {
            prop_assert!(speed.is_finite() && speed >= 0.0, "{speeds:?}\n{text}");
        }
    }

    /// The bound of `oblique-angle` where it raises `e_n`.
    #[test]
    fn oblique_gain_ends_at_the_speed_of_arrival(
        strength in -20.0..0.0,
        exponent in 0.0..3.0,
        impact in impacts(),
        work in decades(1e-4, 1.0),
    ) {
        let normal = format!("{}\nwork_of_adhesion = {work:e}", crate::cases::THORNTON_NING);
        let model = wax(&normal, crate::cases::FREE, &table("oblique-angle", &[strength, exponent, 2.0]));
        let e_n = resolve(&model, &impact).normal_restitution;
        prop_assert!(e_n * impact.normal_speed <= impact.speed() * (1.0 + 1e-12));
    }
}

/// The list of exceptions names effects that exist.
#[test]
fn exceptions_are_effects() {
    assert!(BEYOND_ONE.iter().all(|id| EFFECTS.iter().any(|kind| kind.id == *id)));
}
