//! The outcome does not depend on the units: every quantity of a model and an impact counted in
//! other kilograms, metres, seconds and kelvins gives the same restitutions and probabilities, and
//! a spin in the other unit.
//!
//! The units are those that the library itself states: of its inputs, of its effects' parameters
//! and of its materials' fields.
//!
//! What does depend on units, and is left out or counted anew:
//! - `oblique-angle` refers to 1 m/s: its `strength` goes with (that speed)^-`speed_exponent`;
//! - `micro-roughness`, `agglomerates`, shares, ratios and exponents have no unit;
//! - polynomials `sum c_i (T - T0)^i`: each `c_i` has a unit of its own, which a file does not
//!   state; Arrhenius forms do (the field's and K) and are here;
//! - the viscosity laws of slags (Urbain, Watt–Fereday) are fits in poise, wt% and K or °C:
//!   numbers, not equations between quantities; a melt with a viscosity of its own is here;
//! - the twelve decades that `thermal-softening` and its kind are kept within are ratios.

use nearwall::effect::{EFFECTS, EffectInfo, Parameter, Search};
use nearwall::impact::INPUTS;
use nearwall::material::Library;
use nearwall::{Impact, ImpactRng, Model, Outcome};
use proptest::prelude::*;

use crate::cases::{config, decades, impacts};

/// Other units: how many of them the old ones are.
#[derive(Debug, Clone, Copy)]
struct Units {
    kilogram: f64,
    metre: f64,
    second: f64,
    kelvin: f64,
}

const SI: Units = Units { kilogram: 1.0, metre: 1.0, second: 1.0, kelvin: 1.0 };

impl Units {
    /// What a number in this SI unit is multiplied with.
    fn factor(self, unit: &str) -> f64 {
        let Self { kilogram, metre, second, kelvin } = self;
        match unit {
            "1" | "rad" | "degrees" => 1.0,
            "m" => metre,
            "K" => kelvin,
            "m/s" => metre / second,
            "s/m" => second / metre,
            "rad/s" => 1.0 / second,
            "kg/m3" => kilogram / metre.powi(3),
            "Pa" => kilogram / (metre * second * second),
            "Pa s" => kilogram / (metre * second),
            "J/m2" | "N/m" => kilogram / (second * second),
            "J/kg" => (metre / second).powi(2),
            "J/(kg K)" => (metre / second).powi(2) / kelvin,
            "W/(m K)" => kilogram * metre / (second.powi(3) * kelvin),
            other => unreachable!("a unit this test does not know: {other}"),
        }
    }
}

fn units() -> impl Strategy<Value = Units> {
    // No further, so that every parameter and property stays within its bounds: tungsten's density,
    // a twelfth of the largest, is counted in up to 1.8^4 = 10 of the other unit.
    let factor = || decades(1.0 / 1.8, 1.8);
    (factor(), factor(), factor(), decades(0.3, 3.0)).prop_map(|(kilogram, metre, second, kelvin)| Units {
        kilogram,
        metre,
        second,
        kelvin,
    })
}

/// A built-in material at room temperature (its melt where that begins), with a melt of its own.
fn material(name: &str, units: Units) -> String {
    let library = Library::built_in().unwrap();
    let fields = library.get(name).unwrap().properties().filter(|(key, ..)| *key != "viscosity");
    let fields = fields.map(|(key, unit, property)| {
        let known = property.known_range().map_or(293.15, |[low, _]| low.max(293.15));
        let value = property.at(known).unwrap() * units.factor(unit);
        format!("{key} = {value:e}\n")
    });
    let (factor, activation) = (1e-3 * units.factor("Pa s"), 2e4 * units.factor("K"));
    let valid = [1e-9 * units.factor("K"), 1e9 * units.factor("K")];
    format!(
        "[materials.own-{name}]\n{}viscosity = {{ arrhenius = [{factor:e}, {activation:e}], valid = [{:e}, {:e}] }}\n",
        fields.collect::<String>(),
        valid[0],
        valid[1]
    )
}

/// A parameter somewhere in the middle of where it is looked for.
fn typical(parameter: &Parameter) -> f64 {
    match parameter.search {
        Search::Linear(low, high) => 0.5 * (low + high),
        Search::Log(low, high) => (low * high).sqrt(),
        Search::InputRange("T_p") => 900.0,
        Search::InputWidth("T_p") => 200.0,
        Search::InputRange("conversion") => 0.5,
        Search::InputWidth("conversion") => 0.1,
        Search::InputRange("v_n") => 1.0,
        Search::InputRange("d") | Search::InputWidth("layer_thickness") => 1e-4,
        other => unreachable!("{other:?}"),
    }
}

fn table(kind: &EffectInfo, units: Units) -> String {
    let values: Vec<f64> = kind.parameters.iter().map(typical).collect();
    let line = |(parameter, value): (&Parameter, &f64)| {
        // The one parameter with a hidden unit.
        let hidden = match (kind.id, parameter.name) {
            ("oblique-angle", "strength") => units.factor("m/s").powf(-values[1]),
            _ => 1.0,
        };
        format!("{} = {:e}\n", parameter.name, value * units.factor(parameter.unit) * hidden)
    };
    let lines: String = kind.parameters.iter().zip(&values).map(line).collect();
    format!("[[effects]]\nkind = \"{}\"\n{lines}", kind.id)
}

/// Tungsten that meets steel with slag on it, and the effects that a mask picks.
fn model(law: &str, mask: u32, units: Units) -> Model {
    // The bits above those of the effects choose the normal law.
    let normal = match mask >> 30 {
        3 => "thornton-ning-raised-pull-off",
        2 => "bons",
        _ => "thornton-ning",
    };
    let picked = EFFECTS.into_iter().enumerate().filter(|(index, _)| mask >> index & 1 == 1);
    let effects: String = picked.map(|(_, kind)| table(kind, units)).collect();
    let text = format!(
        "[particle]\nmaterial = \"own-tungsten\"\n\
         [walls.default]\nmaterial = \"own-stainless-steel\"\nslag = \"own-stainless-steel\"\nlayer_thickness = {:e}\n\
         [normal]\nmodel = \"{normal}\"\nyield_ratio = 2.8\nwork_of_adhesion = {:e}\n\
         [tangential]\n{law}\n[capture]\nmodel = \"viscosity\"\nlaw = \"urbain\"\nreference_viscosity = {:e}\n{effects}{}{}",
        1e-6 * units.factor("m"),
        0.5 * units.factor("J/m2"),
        1e4 * units.factor("Pa s"),
        material("tungsten", units),
        material("stainless-steel", units),
    );
    Model::from_toml("units", &text).unwrap()
}

fn counted(impact: &Impact, units: Units) -> Impact {
    let mut counted = *impact;
    for input in &INPUTS {
        (input.set)(&mut counted, (input.value)(impact) * units.factor(input.unit));
    }
    counted
}

/// To rounding: with regard to the size of the energy, since `e_n` is the root of a difference.
fn same(one: f64, other: f64) -> bool {
    let square = |number: f64| number * number.abs();
    (square(one) - square(other)).abs() <= 1e-9 * (1.0 + square(one).abs())
}

fn agree(one: &Outcome, other: &Outcome, spin: f64) -> bool {
    same(one.normal_restitution, other.normal_restitution)
        && same(one.tangential_restitution, other.tangential_restitution)
        && same(one.sticking_probability, other.sticking_probability)
        && one.regime == other.regime
        && (one.spin - other.spin).abs() <= 1e-9 * (spin.abs() + one.spin.abs())
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn outcomes_do_not_depend_on_units(
        units in units(),
        impact in impacts(),
        share in -3.0..3.0,
        mask in any::<u32>(),
        all in any::<bool>(),
        law in prop_oneof![
            Just("model = \"constant\"\ne_t = 0.7"),
            Just("model = \"sliding\"\nfriction = 0.2"),
            Just("model = \"sliding-rolling\"\nfriction = 0.2"),
            Just("model = \"maw-barber-fawcett\"\nfriction = 0.2"),
        ],
        key in any::<u64>(),
    ) {
        // Without the speed along the wall `e_t` says nothing, and spin cannot be compared with anything.
        let impact = Impact { tangential_speed: impact.tangential_speed.max(1e-4), ..impact };
        let impact = Impact { spin: share * impact.speed() / impact.diameter, ..impact };
        let mask = if all { u32::MAX } else { mask };
        let draw = ImpactRng::new(3, key);
        let plain = model(law, mask, SI).resolve(0, &impact, draw).unwrap();
        let mut other = model(law, mask, units).resolve(0, &counted(&impact, units), draw).unwrap();
        other.spin /= units.factor("rad/s");
        prop_assert!(agree(&plain, &other, impact.spin), "{plain:?}\n{other:?}");
    }

    /// The adhesive, the yield and the sticking velocity are speeds.
    #[test]
    fn speeds_are_speeds(units in units(), impact in impacts(), mask in any::<u32>()) {
        let law = "model = \"sliding\"\nfriction = 0.2";
        let plain = model(law, mask, SI).speeds(0, &impact).unwrap();
        let other = model(law, mask, units).speeds(0, &counted(&impact, units)).unwrap();
        for (one, other) in [(plain.adhesive, other.adhesive), (plain.yielding, other.yielding), (plain.sticking, other.sticking)] {
            let other = other / units.factor("m/s");
            // No speed yields where adhesion alone does.
            // And no speed rebounds where adhesion always wins: infinite in any units.
            prop_assert!(one == other || (other - one).abs() <= 1e-9 * one, "{one} {other}");
        }
    }
}

/// The test above sees a unit that is wrong: the hidden metre per second of `oblique-angle` shows
/// when it is not counted.
#[test]
fn a_hidden_unit_shows() {
    let place = EFFECTS.iter().position(|kind| kind.id == "oblique-angle").unwrap();
    let law = "model = \"constant\"\ne_t = 0.7";
    let impact = Impact { normal_speed: 5.0, tangential_speed: 9.0, ..Impact::default() };
    let units = Units { metre: 10.0, ..SI };
    let right =
        model(law, 1 << place, units).resolve(0, &counted(&impact, units), ImpactRng::default()).unwrap();
    let plain = model(law, 1 << place, SI);
    assert!(agree(&plain.resolve(0, &impact, ImpactRng::default()).unwrap(), &right, 0.0));
    let wrong = model(law, 1 << place, units).with_terms(plain.terms().to_vec());
    let wrong = wrong.resolve(0, &counted(&impact, units), ImpactRng::default()).unwrap();
    assert!(!agree(&right, &wrong, 0.0), "{right:?} {wrong:?}");
}
