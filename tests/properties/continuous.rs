//! The outcome is continuous wherever a law changes its form.
//!
//! Two jumps are meant: `e_t` of `sliding-rolling` at the critical angle, whose size is tested
//! here, and the probability of capture, which goes from 0 to 1 where adhesion or a film begins to
//! hold (there `e_n` reaches 0 without a jump). What is drawn jumps by chance.

use nearwall::normal::{restitution, sticking_velocity, stiffness_ratio};
use nearwall::tangential::critical_angle;
use nearwall::{Impact, Model, Outcome};
use proptest::prelude::*;

use crate::cases::{
    FREE, THORNTON_NING, config, constant_normal, decades, e_n, impacts, resolve, table, wax,
};

/// How far to each side of the place.
const ASIDE: f64 = 1e-12;

/// A root that opens at the place has gone 1e-6 of its scale after `ASIDE`; a jump of physical size is above this.
const JUMP: f64 = 1e-5;

/// The function just below and just above a place.
fn sides<T>(place: f64, of: impl Fn(f64) -> T) -> [T; 2] {
    [of(place * (1.0 - ASIDE)), of(place * (1.0 + ASIDE))]
}

fn joined([below, above]: [f64; 2]) -> Result<(), TestCaseError> {
    prop_assert!((below - above).abs() < JUMP, "{below} below, {above} above");
    Ok(())
}

/// Restitutions and spin; the latter in units of the speed of the impact over its diameter.
fn all_joined(impact: &Impact, [below, above]: [Outcome; 2]) -> Result<(), TestCaseError> {
    let rim = impact.diameter / impact.speed();
    joined([below.normal_restitution, above.normal_restitution])?;
    joined([below.tangential_restitution, above.tangential_restitution])?;
    joined([below.spin * rim, above.spin * rim])
}

/// Mindlin's `k` of wax on Pyrex [1].
fn k(model: &Model) -> f64 {
    let solids = [model.particle(), model.walls()[0].material()].map(|m| m.mechanical(293.15).unwrap());
    stiffness_ratio(&solids[0], &solids[1])
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn normal_restitution_at_its_three_speeds(yielding in decades(1e-6, 1e2), ratio in decades(1e-4, 1e4)) {
        let adhesive = ratio * yielding;
        let sticking = sticking_velocity(adhesive, yielding);
        for place in [adhesive, yielding, sticking] {
            joined(sides(place, |speed| restitution(speed, adhesive, yielding)))?;
        }
        prop_assert_eq!(restitution(sticking * (1.0 - ASIDE), adhesive, yielding), 0.0);
        let [below, above] = sides(yielding, |adhesive| sticking_velocity(adhesive, yielding));
        joined([below / yielding, above / yielding])?;
    }

    /// With any spin; where gross sliding ends, and where the slip goes through zero.
    #[test]
    fn maw_barber_fawcett_where_sliding_ends_and_without_slip(
        friction in decades(1e-2, 5.0),
        e in 0.0..=1.0,
        rim in -5.0f64..5.0,
    ) {
        let law = format!("model = \"maw-barber-fawcett\"\nfriction = {friction:e}");
        let model = wax(&constant_normal(e), &law, "");
        let cotangent = 1.0 / critical_angle(friction, e, k(&model)).tan();
        let diameter = 1e-4;
        let impact = |slip: f64| {
            let rim = rim.abs() * cotangent;
            let spin = 2.0 * rim / diameter;
            Impact { normal_speed: 1.0, tangential_speed: slip + rim, diameter, spin, ..Impact::default() }
        };
        all_joined(&impact(cotangent), sides(cotangent, |slip| resolve(&model, &impact(slip))))?;
        let around = [resolve(&model, &impact(-ASIDE * cotangent)), resolve(&model, &impact(ASIDE * cotangent))];
        all_joined(&impact(0.01 * cotangent), around)?;
    }

    /// With any spin: the slip takes the place of the speed along the wall.
    #[test]
    fn tangential_compliance_at_the_critical_angle(
        friction in decades(1e-2, 5.0),
        near_normal in 0.0..=1.5,
        exponent in decades(0.3, 20.0),
        e in 0.0..=1.0,
        rim in -0.9f64..5.0,
        backwards in any::<bool>(),
    ) {
        let model = wax(&constant_normal(e), FREE, &table("tangential-compliance", &[friction, near_normal, exponent]));
        let cotangent = 1.0 / critical_angle(friction, e, k(&model)).tan();
        let diameter = 1e-4;
        let impact = |size: f64| {
            let slip = if backwards { -size } else { size };
            let rim = if backwards { cotangent * (1.1 + rim.abs()) } else { cotangent * rim };
            Impact { normal_speed: 1.0, tangential_speed: slip + rim, diameter, spin: 2.0 * rim / diameter, ..Impact::default() }
        };
        let [below, above] = sides(cotangent, |size| resolve(&model, &impact(size)));
        // With so small an exponent a root opens: `past^0.3` after 1e-12 is 2.5e-4.
        let opens = 2.0 * (ASIDE * (1.0 + cotangent)).powf(exponent.min(1.0)) * (1.0 + impact(cotangent).tangential_speed);
        let speed = impact(cotangent).tangential_speed;
        prop_assert!((below.tangential_restitution - above.tangential_restitution).abs() * speed < JUMP.max(opens));
        prop_assert!((below.spin - above.spin).abs() * diameter < JUMP.max(10.0 * opens));
    }

    /// The paper's law jumps there, from where sliding has come to rolling.
    #[test]
    fn sliding_to_rolling_jumps_by_its_own_amount(friction in decades(1e-2, 5.0), e in 0.0..=1.0) {
        let model = wax(&constant_normal(e), &format!("model = \"sliding-rolling\"\nfriction = {friction:e}"), "");
        let k = k(&model);
        let cotangent = 1.0 / critical_angle(friction, e, k).tan();
        let impact = |tangential_speed| Impact { normal_speed: 1.0, tangential_speed, ..Impact::default() };
        let [steep, glancing] = sides(cotangent, |speed| resolve(&model, &impact(speed)).tangential_restitution);
        prop_assert!((steep - 5.0 / 7.0).abs() < 1e-12);
        prop_assert!((glancing - (1.0 - 2.0 * k / (7.0 * k - 1.0))).abs() < 1e-9);
    }

    /// Where friction has stopped the particle, and where spin begins to outrun it.
    #[test]
    fn sliding_where_it_ends(friction in decades(1e-2, 5.0), e in 0.0..=1.0, impact in impacts(), rim in -3.0..0.99) {
        prop_assume!(impact.tangential_speed > 0.0);
        let model = wax(&constant_normal(e), &format!("model = \"sliding\"\nfriction = {friction:e}"), "");
        let stops = friction * (1.0 + e) * impact.normal_speed;
        let stopping = |tangential_speed| resolve(&model, &Impact { tangential_speed, ..impact });
        all_joined(&Impact { tangential_speed: stops, ..impact }, sides(stops, stopping))?;
        let rolling = 2.0 * impact.tangential_speed / impact.diameter;
        all_joined(&impact, sides(rolling, |spin| resolve(&model, &Impact { spin, ..impact })))?;
        // Where the bound on the energy takes over, `J = 4|s|/7`, at any spin.
        let tangential_speed = stops * 7.0 / 4.0 / (1.0 - rim);
        let spun = |tangential_speed: f64| {
            let spin = rim * rolling_spin(tangential_speed, impact.diameter);
            Impact { tangential_speed, spin, ..impact }
        };
        all_joined(&spun(tangential_speed), sides(tangential_speed, |speed| resolve(&model, &spun(speed))))?;
        // And without any spin, against next to none.
        let next = ASIDE * rolling;
        all_joined(&impact, [-next, next].map(|spin| resolve(&model, &Impact { spin, ..impact })))?;
    }

    /// Head-on, against next to no speed along the wall.
    #[test]
    fn head_on_impacts(friction in decades(1e-2, 5.0), impact in impacts()) {
        for law in ["sliding", "sliding-rolling"] {
            let model = wax(THORNTON_NING, &format!("model = \"{law}\"\nfriction = {friction:e}"), "");
            let along = |tangential_speed| resolve(&model, &Impact { tangential_speed, ..impact });
            all_joined(&impact, [0.0, ASIDE * friction * impact.normal_speed].map(along))?;
        }
        for (id, values) in [("oblique-angle", &[1.0, 0.5, 2.0][..]), ("oblique-angle", &[-2.0, 0.5, 0.5]), ("gas-lift", &[0.1])] {
            let model = wax(&constant_normal(0.5), FREE, &table(id, values));
            let along = |tangential_speed| resolve(&model, &Impact { tangential_speed, ..impact });
            all_joined(&impact, [0.0, ASIDE * impact.normal_speed].map(along))?;
        }
    }

    /// A film as thick as the asperities, and the critical Stokes number.
    #[test]
    fn liquid_films(impact in impacts(), e in 0.05..1.0, viscosity in decades(1e-4, 10.0)) {
        let asperity = 1e-7;
        let model = wax(&constant_normal(e), FREE, &table("liquid-film", &[viscosity, asperity]));
        let thin = Impact { normal_speed: 1.0 + impact.normal_speed, diameter: 1e-3, ..impact };
        joined(sides(asperity, |film_thickness| e_n(&model, &Impact { film_thickness, ..thin })))?;
        let of_material = model.particle().mechanical(293.15).unwrap().density;
        let density = if impact.particle_density > 0.0 { impact.particle_density } else { of_material };
        // Melt and powder of earlier particles make the wall a patchwork, of which the film wets a share.
        let wet = Impact { film_thickness: 1e-5, melt_thickness: 0.0, ..impact };
        let critical = (1.0 + 1.0 / e) * 1e2f64.ln() * 9.0 * viscosity / (density * wet.diameter);
        let [below, above] = sides(critical, |normal_speed| resolve(&model, &Impact { normal_speed, ..wet }));
        joined([below.normal_restitution, above.normal_restitution])?;
        prop_assert_eq!([below.sticking_probability, above.sticking_probability], [1.0, 0.0]);
    }

    /// `min(1, mu_ref/mu)`, a covering of nothing and of everything, a layer as thick as the particle.
    #[test]
    fn capture(temperature in 500.0..2000.0f64, activation in decades(1e3, 1e5), impact in impacts()) {
        // The viscosity is 100 Pa s at this temperature.
        let factor = 100.0 * (-activation / temperature).exp();
        prop_assume!(factor > 1e-300);
        // Up to where it is 1e-6 Pa s: no liquid is thinner than some 3e-6.
        let hottest = (1.0 / temperature - 1e8f64.ln() / activation).max(1e-4).recip();
        let text = format!(
            "[particle]\nmaterial = \"ash\"\n[walls.default]\nmaterial = \"pyrex\"\nslag = \"ash\"\n\
             [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\n{FREE}\n\
             [capture]\nmodel = \"viscosity\"\nlaw = \"urbain\"\nreference_viscosity = 100\n[materials.ash]\n\
             density = 2500\nyoungs_modulus = 5e10\npoisson_ratio = 0.2\nyield_strength = 1e8\nsurface_energy = 0.3\n\
             viscosity = {{ arrhenius = [{factor:e}, {activation:e}], valid = [100, {hottest:e}] }}\n"
        );
        let model = Model::from_toml("melt", &text).unwrap();
        let wall_temperature = impact.wall_temperature.min(hottest);
        let impact = Impact { particle_temperature: 300.0, wall_temperature, layer_thickness: 0.0, ..impact };
        let p = |impact: Impact| resolve(&model, &impact).sticking_probability;
        joined(sides(temperature, |particle_temperature| p(Impact { particle_temperature, coverage: 1.0, ..impact })))?;
        joined(sides(temperature, |wall_temperature| p(Impact { wall_temperature, coverage: 0.5, ..impact })))?;
        joined([0.0, ASIDE].map(|coverage| p(Impact { coverage, ..impact })))?;
        joined([1.0, 1.0 - ASIDE].map(|coverage| p(Impact { coverage, ..impact })))?;
        joined(sides(impact.diameter, |layer_thickness| p(Impact { layer_thickness, ..impact })))?;
        joined([0.0, ASIDE * impact.diameter].map(|layer_thickness| p(Impact { layer_thickness, ..impact })))?;
    }

    /// Onsets and ends of the other effects, and each effect as its strength goes to nothing.
    #[test]
    fn effects_set_in_without_a_jump(impact in impacts(), m in 0.5..3.0) {
        let bare = Impact { layer_thickness: 0.0, ..impact };
        let layer = wax(&constant_normal(0.5), FREE, &table("powder-layer", &[1e-4, 0.2]));
        joined([0.0, ASIDE * 1e-4].map(|layer_thickness| e_n(&layer, &Impact { layer_thickness, ..bare })))?;
        let hot = wax(THORNTON_NING, FREE, &table("thermal-softening", &[800.0, 50.0]));
        joined(sides(800.0, |t| e_n(&hot, &Impact { particle_temperature: t, ..impact })))?;
        // Where twelve decades of strength are used up.
        let small = wax(THORNTON_NING, FREE, &table("size-dependent-yield", &[1e-3, m]));
        joined(sides(1e-3 * 10f64.powf(-12.0 / m), |diameter| e_n(&small, &Impact { diameter, ..impact })))?;
        let fast = wax(THORNTON_NING, FREE, &table("strain-rate-hardening", &[1e-4, m.min(2.0)]));
        joined(sides(1e-4 * 10f64.powf(12.0 / m.min(2.0)), |v| e_n(&fast, &Impact { normal_speed: v, ..impact })))?;
        // Where a gain meets the speed of arrival.
        let gain = wax(&constant_normal(0.5), FREE, &table("oblique-angle", &[-(5f64.ln()), 0.0, 1.0]));
        for speed in ladder(impact.normal_speed) {
            joined(sides(speed, |tangential_speed| e_n(&gain, &Impact { tangential_speed, ..impact })))?;
        }
        let [logistic, other] = [1.0, 1.0 + ASIDE].map(|asymmetry| {
            let model = wax(&constant_normal(0.5), FREE, &table("melting-transition", &[800.0, 30.0, 1.0, asymmetry]));
            resolve(&model, &impact)
        });
        joined([logistic.sticking_probability, other.sticking_probability])?;
        let sliding = "model = \"sliding-rolling\"\nfriction = 0.3";
        let plain = resolve(&wax(&constant_normal(0.5), FREE, ""), &impact);
        let tilted = resolve(&wax(&constant_normal(0.5), FREE, &table("micro-roughness", &[ASIDE])), &steep(&impact));
        joined([plain.normal_restitution, tilted.normal_restitution])?;
        let near = [0.0, 1e-13].map(|spread| {
            e_n(&wax(THORNTON_NING, sliding, &table("nano-roughness", &[spread])), &impact)
        });
        joined(near)?;
    }
}

/// Speeds along the wall around the place where the gain of `e_n` ends.
fn ladder(normal_speed: f64) -> impl Iterator<Item = f64> {
    (1..60).map(move |i| normal_speed * 1.1f64.powi(i - 20))
}

/// A spin with which a sphere rolls at this speed [rad/s].
fn rolling_spin(speed: f64, diameter: f64) -> f64 {
    2.0 * speed / diameter
}

/// An impact whose speed along the wall does not dwarf that towards it: `e_n` is a ratio to the latter.
fn steep(impact: &Impact) -> Impact {
    Impact { tangential_speed: impact.tangential_speed.min(impact.normal_speed), ..*impact }
}
