//! Random models and impacts.

use nearwall::effect::{EFFECTS, EffectInfo, Parameter, Search};
use nearwall::{Impact, ImpactRng, Model, Outcome, normal, tangential};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::common::random::seed;

/// The number of cases of a test, drawn from the printed seed (`NEARWALL_TEST_SEED` repeats it).
/// The seed replaces a file of failures.
pub fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(seed()),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Wax on Pyrex with these laws and effects; constant properties, valid input at any temperature.
pub fn wax(normal: &str, tangential: &str, effects: &str) -> Model {
    let text = format!(
        "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
         [normal]\n{normal}\n[tangential]\n{tangential}\n{effects}"
    );
    Model::from_toml("m", &text).unwrap()
}

/// Thornton–Ning for wax.
pub const THORNTON_NING: &str = "model = \"thornton-ning\"\nyield_ratio = 0.7";

/// Mirror and constant law.
pub fn constant_normal(e_n: f64) -> String {
    format!("model = \"constant\"\ne_n = {e_n:e}")
}

/// No loss along the wall.
pub const FREE: &str = "model = \"constant\"\ne_t = 1";

/// The `[[effects]]` table of a kind, its parameters in their order.
pub fn table(id: &str, values: &[f64]) -> String {
    let kind = EFFECTS.into_iter().find(|kind| kind.id == id).unwrap();
    let lines = kind.parameters.iter().zip(values).map(|(p, value)| format!("{} = {value:e}\n", p.name));
    format!("[[effects]]\nkind = \"{id}\"\n{}", lines.collect::<String>())
}

pub fn resolve(model: &Model, impact: &Impact) -> Outcome {
    model.resolve(0, impact, ImpactRng::default()).unwrap()
}

pub fn e_n(model: &Model, impact: &Impact) -> f64 {
    resolve(model, impact).normal_restitution
}

/// Uniform in the logarithm.
pub fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> + Clone {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// Sometimes zero, else uniform in the logarithm.
fn sometimes(low: f64, high: f64) -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 3 => decades(low, high)]
}

/// An ordinary impact, without spin.
pub fn impacts() -> impl Strategy<Value = Impact> {
    let speeds = (decades(1e-4, 1e3), sometimes(1e-4, 1e3), decades(1e-7, 1e-2));
    let state = (250.0..2500.0, 250.0..2500.0, 0.0..=1.0, 0.0..=1.0);
    let wall = (sometimes(1e-7, 1e-2), sometimes(1e-8, 1e-3), sometimes(1e-1, 1e2), sometimes(1e-9, 1e-2));
    (speeds, state, wall).prop_map(|(speeds, state, wall)| Impact {
        normal_speed: speeds.0,
        tangential_speed: speeds.1,
        diameter: speeds.2,
        particle_temperature: state.0,
        wall_temperature: state.1,
        conversion: state.2,
        coverage: state.3,
        layer_thickness: wall.0,
        film_thickness: wall.1,
        gas_speed: wall.2,
        melt_thickness: wall.3,
        ..Impact::default()
    })
}

/// An ordinary impact with spin: rim speeds from far below to far above the speed of the impact, either way round.
pub fn spinning() -> impl Strategy<Value = Impact> {
    (impacts(), decades(1e-3, 1e3), any::<bool>()).prop_map(|(impact, share, forward)| {
        let spin = share * impact.speed() / impact.diameter;
        Impact { spin: if forward { spin } else { -spin }, ..impact }
    })
}

/// The keys of a listed law with random parameters.
fn listed(name: &'static str, parameters: &'static [Parameter]) -> BoxedStrategy<String> {
    let text = move |values: Vec<f64>| {
        let lines = parameters.iter().zip(values).map(|(p, value)| format!("\n{} = {value:e}", p.name));
        format!("model = \"{name}\"{}", lines.collect::<String>())
    };
    parameters.iter().map(values).collect::<Vec<_>>().prop_map(text).boxed()
}

/// One of the listed tangential laws.
pub fn listed_tangential_laws() -> impl Strategy<Value = String> {
    let laws = tangential::LISTED_LAWS.map(|law| listed(law.name, law.parameters));
    proptest::strategy::Union::new(laws)
}

/// One of the listed normal laws.
pub fn listed_normal_laws() -> impl Strategy<Value = String> {
    let laws = normal::LISTED_LAWS.map(|law| listed(law.name, law.parameters));
    proptest::strategy::Union::new(laws)
}

/// A law for the motion along the wall.
pub fn tangential_laws() -> impl Strategy<Value = String> {
    prop_oneof![
        listed_tangential_laws(),
        (0.0..=1.0).prop_map(|e_t| format!("model = \"constant\"\ne_t = {e_t:e}")),
        decades(1e-3, 10.0).prop_map(|f| format!("model = \"sliding\"\nfriction = {f:e}")),
        decades(1e-3, 10.0).prop_map(|f| format!("model = \"sliding-rolling\"\nfriction = {f:e}")),
    ]
}

/// A normal law.
pub fn normal_laws() -> impl Strategy<Value = String> {
    prop_oneof![
        listed_normal_laws(),
        (0.0..=1.0).prop_map(constant_normal),
        (any::<bool>(), decades(0.1, 10.0), decades(1e-4, 10.0)).prop_map(|(raised, ratio, work)| {
            let law = if raised { "thornton-ning-raised-pull-off" } else { "thornton-ning" };
            format!("model = \"{law}\"\nyield_ratio = {ratio:e}\nwork_of_adhesion = {work:e}")
        }),
    ]
}

/// A parameter within the range of a fit; within the ranges of [`impacts`] where the fit uses those of the data.
fn values(parameter: &'static Parameter) -> BoxedStrategy<f64> {
    match parameter.search {
        Search::Linear(low, high) => (low..high).boxed(),
        Search::Log(low, high) => decades(low, high).boxed(),
        Search::InputRange("T_p") => (250.0..2500.0).boxed(),
        Search::InputWidth("T_p") => decades(1.0, 1e3).boxed(),
        Search::InputRange("v_n") => decades(1e-3, 1e3).boxed(),
        Search::InputRange("d") | Search::InputWidth("layer_thickness") => decades(1e-6, 1e-2).boxed(),
        Search::InputRange("conversion") => (0.0..1.0).boxed(),
        Search::InputWidth("conversion") => decades(1e-3, 1.0).boxed(),
        other => unreachable!("{other:?}"),
    }
}

/// The table of a kind with random parameters, or nothing.
fn perhaps(kind: &'static EffectInfo) -> BoxedStrategy<String> {
    let parameters: Vec<_> = kind.parameters.iter().map(values).collect();
    let with = parameters.prop_map(|values| table(kind.id, &values));
    prop_oneof![2 => Just(String::new()), 1 => with].boxed()
}

/// Some of the effects but those named, in the order of [`EFFECTS`].
pub fn effects_but(left_out: &[&str]) -> impl Strategy<Value = String> + use<> {
    let kinds = EFFECTS.into_iter().filter(|kind| !left_out.contains(&kind.id));
    kinds.map(perhaps).collect::<Vec<_>>().prop_map(|tables| tables.concat())
}
