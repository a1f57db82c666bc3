//! Same inputs, same bits: single impacts, with a trace, and in blocks of any length with any vectors.

use nearwall::model::Limit;
use nearwall::model::block::{BLOCK, Block, Level, Outcomes, Workspace};
use nearwall::{Impact, ImpactRng, Model, Outcome, impact::INPUTS};
use proptest::prelude::*;

use crate::cases::*;

fn bits(outcome: &Outcome) -> [u64; 7] {
    [
        outcome.normal_restitution.to_bits(),
        outcome.tangential_restitution.to_bits(),
        outcome.sticking_probability.to_bits(),
        outcome.spin.to_bits(),
        outcome.regime as u64,
        u64::from(outcome.stuck),
        u64::from(outcome.outside_range),
    ]
}

fn bits_at(outcomes: &Outcomes, index: usize) -> [u64; 7] {
    [
        outcomes.normal_restitution[index].to_bits(),
        outcomes.tangential_restitution[index].to_bits(),
        outcomes.sticking_probability[index].to_bits(),
        outcomes.spin[index].to_bits(),
        outcomes.regime[index].into(),
        outcomes.stuck[index].into(),
        outcomes.outside_range[index].into(),
    ]
}

/// Every vector width in the build that this machine supports.
fn levels() -> Vec<Level> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    {
        use fearless_simd::Simd;
        let narrower = [
            best.as_sse2().map(Simd::level),
            best.as_sse4_2().map(Simd::level),
            best.as_avx2().map(Simd::level),
            best.as_avx512().map(Simd::level),
        ];
        narrower.into_iter().flatten().collect()
    }
    #[cfg(not(target_arch = "x86_64"))]
    vec![best]
}

/// Effects with a precomputed form; sometimes with an asymmetry or a range that needs the general steps.
fn precomputed_effects() -> impl Strategy<Value = String> {
    let ratio = prop_oneof![Just(String::new()), decades(0.1, 10.0).prop_map(|c| table("yield-ratio", &[c]))];
    let energy =
        prop_oneof![Just(String::new()), decades(1e-4, 10.0).prop_map(|w| table("adhesion-energy", &[w]))];
    let asymmetry = || prop_oneof![4 => Just(1.0), 1 => decades(0.2, 5.0)];
    let melting = (300.0..2000.0, decades(1.0, 1e3), 0.0..=1.0, asymmetry());
    let melting = melting.prop_map(|(t, w, s, a)| table("melting-transition", &[t, w, s, a]));
    let valid = prop_oneof![
        Just(""),
        Just("valid = { v_n = [0.01, 10], T_p = [300, 900] }\n"),
        Just("valid = { coverage = [0, 0.5] }\n")
    ];
    let burning = (0.0..=1.0, decades(1e-3, 1.0), 0.0..=1.0, asymmetry(), valid);
    let burning =
        burning.prop_map(|(x, w, s, a, valid)| table("conversion-transition", &[x, w, s, a]) + valid);
    let [melting, burning] = [melting.boxed(), burning.boxed()]
        .map(|effect| prop_oneof![1 => Just(String::new()), 2 => effect].boxed());
    (ratio, energy, melting, burning).prop_map(|(a, b, c, d)| a + &b + &c + &d)
}

fn models() -> impl Strategy<Value = Model> {
    (normal_laws(), tangential_laws(), precomputed_effects())
        .prop_map(|(normal, tangential, effects)| wax(&normal, &tangential, &effects))
}

/// Numbers at the ends of what is allowed.
fn hostile() -> impl Strategy<Value = Impact> {
    let number = || {
        prop_oneof![Just(0.0), Just(-0.0), Just(5e-324), Just(1e-300), decades(1e-20, 1e20), Just(1.7e308)]
    };
    let positive = || prop_oneof![Just(5e-324), decades(1e-300, 1e300), Just(1.7e308)];
    (number(), number(), positive(), positive(), number(), any::<bool>()).prop_map(
        |(v_n, v_t, d, t, omega, back)| Impact {
            normal_speed: v_n,
            tangential_speed: v_t,
            diameter: d,
            particle_temperature: t,
            spin: if back { -omega } else { omega },
            ..Impact::default()
        },
    )
}

/// Walls whose contact differs between impacts: char that becomes ash, properties as constants,
/// tables and formulas, slag and powder, every criterion and every effect without chance.
fn varying_models() -> impl Strategy<Value = Model> {
    let particle = prop_oneof![
        Just("coal-char\"\nash = \"fly-ash"),
        Just("coal-char\"\nash = \"odd"),
        Just("odd"),
        Just("crystal"),
        Just("coal-slag")
    ];
    let wall = prop_oneof![Just("refractory"), Just("coal-slag"), Just("odd"), Just("stainless-steel")];
    let on_it = prop_oneof![
        Just(""),
        Just("slag = \"coal-slag\"\n"),
        Just("slag = \"measured\"\npowder = \"coal-char\"\ncoverage = 0.4\n"),
        Just("slag = \"coal-slag\"\npowder = \"odd\"\nlayer_thickness = 2e-5\n"),
        Just("slag = \"crystal\"\n"),
        Just("powder = \"fly-ash\"\ncoverage = 1\n"),
    ];
    let law = prop_oneof![
        Just("kalmanovitch-frank"),
        Just("urbain"),
        Just("watt-fereday"),
        Just("giordano-russell-dingwell")
    ];
    let solid = prop_oneof![Just("watt"), Just("none")];
    let criterion = prop_oneof![
        4 => decades(1.0, 1e6).prop_map(|reference| format!("model = \"viscosity\"\nreference_viscosity = {reference:e}")),
        1 => Just("model = \"kinetic-energy\"".to_owned()),
        1 => Just("model = \"fusion\"".to_owned()),
    ];
    let combination =
        prop_oneof![Just("uintah\"".to_owned()), (0.0..1.0).prop_map(|e| format!("walsh\"\nerosion = {e}"))];
    let capture = (law, solid, criterion, combination).prop_map(|(law, solid, criterion, combination)| {
        let chosen = !criterion.contains("fusion");
        let solid = if chosen { format!("solidification = \"{solid}\"\n") } else { String::new() };
        format!("{criterion}\nlaw = \"{law}\"\n{solid}combination = \"{combination}")
    });
    let wetting =
        prop_oneof![Just(String::new()), (0.0..180.0).prop_map(|angle| table("dry-on-melt", &[angle]))];
    let others = prop_oneof![2 => Just(String::new()), 1 => effects_but(&["nano-roughness", "micro-roughness", "agglomerates"])];
    let normal = prop_oneof![3 => Just(THORNTON_NING.to_owned()), 1 => (0.0..=1.0).prop_map(constant_normal), 1 => normal_laws()];
    (particle, wall, on_it, capture, normal, tangential_laws(), (precomputed_effects(), wetting, others)).prop_map(
        |(particle, wall, on_it, capture, normal, tangential, (effects, wetting, others))| {
            let text = format!(
                "[particle]\nmaterial = \"{particle}\"\n[walls.default]\nmaterial = \"{wall}\"\n{on_it}\
                 [normal]\n{normal}\n[tangential]\n{tangential}\n[capture]\n{capture}\n{ODD}{effects}{wetting}{others}"
            );
            Model::from_toml("varying", &text).unwrap()
        },
    )
}

/// Materials with every form of a property.
const ODD: &str = r#"
[materials.odd]
density = { polynomial = [2500, -0.2], T0 = 300, valid = [250, 3000] }
youngs_modulus = { T = [250, 700, 1200, 1500, 3000], value = [70e9, 60e9, 20e9, 5e9, 4e9] }
poisson_ratio = 0.2
yield_strength = { arrhenius = [1e6, 800], valid = [250, 3000] }
surface_energy = { polynomial = [0.4, -1e-5, -1e-8], T0 = 300, valid = [250, 3000] }
work_of_adhesion = { T = [250, 900, 3000], value = [2, 0.5, 0.1] }
composition = { SiO2 = 50, Al2O3 = 25, CaO = 15, FeO = 10, unit = "wt%" }
[materials.measured]
density = 2700
youngs_modulus = 5e9
poisson_ratio = 0.25
yield_strength = 1e6
surface_energy = 0.5
surface_tension = 0.4
viscosity = { T = [1200, 1400, 1600, 1900], value = [1e5, 1e3, 30, 2] }
critical_viscosity_temperature = 1450
fusion_temperatures = { deformation = 1300, softening = 1380, hemisphere = 1420, flow = 1500 }
[materials.crystal]
like = "measured"
melting_point = 1550
crystalline = true
"#;

/// Impacts on them, from below to beyond what the properties are known for, without or with melt of earlier particles.
fn varying_impacts() -> impl Strategy<Value = Vec<Impact>> {
    let lying = || prop_oneof![Just(0.0), 0.0..=1.0];
    let melt = prop_oneof![2 => Just(0.0), 1 => decades(1e-9, 1e-3)];
    let one = move || {
        let (layer, film) =
            (prop_oneof![Just(0.0), decades(1e-7, 1e-3)], prop_oneof![Just(0.0), decades(1e-7, 1e-4)]);
        (prop_oneof![impacts(), spinning()], 300.0..2200.0, 300.0..2200.0, 0.0..=1.0, lying(), layer, film)
    };
    (prop::collection::vec(one(), 1..=BLOCK), melt, any::<bool>()).prop_map(
        |(impacts, melt_thickness, layers)| {
            let each =
                |(impact, particle_temperature, wall_temperature, conversion, coverage, layer, film)| {
                    Impact {
                        particle_temperature,
                        wall_temperature,
                        conversion,
                        coverage,
                        layer_thickness: if layers { layer } else { 0.0 },
                        film_thickness: film,
                        melt_thickness,
                        ..impact
                    }
                };
            impacts.into_iter().map(each).collect()
        },
    )
}

/// The decision with a trace has the bits of that without.
fn compare_with_trace(model: &Model, impacts: &[Impact], seed: u64) -> Result<(), TestCaseError> {
    for (key, impact) in impacts.iter().enumerate() {
        let draw = ImpactRng::new(seed, key as u64);
        let (plain, traced) = (model.resolve(0, impact, draw), model.explain(0, impact, draw));
        match (plain, traced) {
            (Ok(plain), Ok((traced, _))) => {
                prop_assert_eq!(bits(&plain), bits(&traced), "{:?}: {:?} or {:?}", impact, plain, traced);
            }
            (plain, traced) => prop_assert_eq!(plain.err(), traced.err()),
        }
    }
    Ok(())
}

/// A block has the bits of single impacts with every vector width.
fn compare_blocks(model: &Model, impacts: &[Impact], seed: u64, first: u64) -> Result<(), TestCaseError> {
    let mut block = Block { length: impacts.len(), ..Block::default() };
    for (index, impact) in impacts.iter().enumerate() {
        block.keys[index] = first.wrapping_add(index as u64);
        for (column, input) in block.inputs.iter_mut().zip(&INPUTS) {
            column[index] = (input.value)(impact);
        }
    }
    let mut workspace = Workspace::default();
    for level in levels() {
        let mut outcomes = Outcomes::default();
        let done = model.resolve_block_at(level, 0, &block, seed, &mut outcomes, &mut workspace);
        for (index, impact) in impacts.iter().enumerate() {
            match (&done, model.resolve(0, impact, ImpactRng::new(seed, block.keys[index]))) {
                (Ok(()), Ok(alone)) => {
                    let found = bits_at(&outcomes, index);
                    prop_assert_eq!(
                        bits(&alone),
                        found,
                        "{:?}, {} of {}: {:?}",
                        level,
                        index,
                        impacts.len(),
                        impact
                    );
                }
                // The first impact that cannot be decided ends the block.
                (done, Err(error)) => {
                    prop_assert_eq!(done.as_ref().err(), Some(&error));
                    break;
                }
                (Err(_), Ok(_)) => {}
            }
        }
    }
    Ok(())
}

/// The list of what an impact uses outside of its range is empty where the flag is not set, and only there.
fn compare_with_reasons(model: &Model, impacts: &[Impact]) -> Result<(), TestCaseError> {
    for impact in impacts {
        let Ok(outcome) = model.resolve_with(0, impact, |_| 0.5) else { continue };
        let reasons = model.beyond(0, impact).unwrap();
        prop_assert_eq!(outcome.outside_range, !reasons.is_empty(), "{:?} {:?}", impact, reasons);
        for reason in reasons {
            if let Limit::Quantity { value, range: [low, high], .. } = reason.limit {
                prop_assert!(
                    !(low..=high).contains(&value) || (value - high).abs() <= 1e-9 * high,
                    "{:?}",
                    reason
                );
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn reasons_stand_where_the_flag_does(
        model in models(),
        impacts in prop::collection::vec(prop_oneof![impacts(), spinning(), hostile()], 1..40),
    ) {
        compare_with_reasons(&model, &impacts)?;
    }

    #[test]
    fn reasons_stand_where_the_flag_does_on_varying_walls(model in varying_models(), impacts in varying_impacts()) {
        compare_with_reasons(&model, &impacts)?;
    }

    #[test]
    fn a_trace_changes_nothing(
        model in models(),
        impacts in prop::collection::vec(prop_oneof![impacts(), spinning(), hostile()], 1..40),
        seed: u64,
    ) {
        compare_with_trace(&model, &impacts, seed)?;
    }

    #[test]
    fn a_trace_changes_nothing_on_varying_walls(model in varying_models(), impacts in varying_impacts(), seed: u64) {
        compare_with_trace(&model, &impacts, seed)?;
    }

    #[test]
    fn blocks_give_the_bits_of_single_impacts(
        model in models(),
        impacts in prop::collection::vec(prop_oneof![impacts(), spinning(), hostile()], 1..=BLOCK),
        seed: u64,
        first: u64,
    ) {
        compare_blocks(&model, &impacts, seed, first)?;
    }

    #[test]
    fn blocks_on_varying_walls_do_too(model in varying_models(), impacts in varying_impacts(), seed: u64, first: u64) {
        compare_blocks(&model, &impacts, seed, first)?;
    }
}

/// The tests above cover prepared walls.
#[test]
fn walls_are_prepared_where_they_can_be() {
    let prepared = |normal: &str, effects: &str| wax(normal, FREE, effects).is_prepared(0);
    let transition = |asymmetry| table("melting-transition", &[360.0, 7.0, 1.0, asymmetry]);
    assert!(prepared(THORNTON_NING, "") && prepared(&constant_normal(0.5), &transition(1.0)));
    assert!(prepared(
        THORNTON_NING,
        &(transition(1.0) + &table("conversion-transition", &[0.9, 0.01, 0.0, 1.0]))
    ));
    assert!(!prepared(THORNTON_NING, &transition(2.0)));
    assert!(!prepared(THORNTON_NING, &table("gas-lift", &[0.05])));
    assert!(!prepared(THORNTON_NING, &table("nano-roughness", &[0.5])));
    let gasifier = include_str!("../../tutorials/slaggingGasifier/constant/nearWall.toml");
    let gasifier = Model::from_toml("gasifier", gasifier).unwrap();
    assert!((0..gasifier.walls().len()).all(|wall| gasifier.is_prepared(wall)));
    assert!(prepared(&THORNTON_NING.replace("thornton-ning", "thornton-ning-raised-pull-off"), ""));
    assert!(prepared("model = \"grant-tabakoff\"", ""));
    assert!(wax(THORNTON_NING, "model = \"maw-barber-fawcett\"\nfriction = 0.3", "").is_prepared(0));
}
