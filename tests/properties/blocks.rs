//! Same inputs, same bits: single impacts, with a trace, and in blocks of any length with any vectors.

use nearwall::model::block::{BLOCK, Block, Level, Outcomes};
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

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn a_trace_changes_nothing(
        model in models(),
        impacts in prop::collection::vec(prop_oneof![impacts(), spinning(), hostile()], 1..40),
        seed: u64,
    ) {
        for (key, impact) in impacts.iter().enumerate() {
            let draw = ImpactRng::new(seed, key as u64);
            let plain = model.resolve(0, impact, draw).unwrap();
            let (traced, _) = model.explain(0, impact, draw).unwrap();
            prop_assert_eq!(bits(&plain), bits(&traced), "{:?}: {:?} or {:?}", impact, plain, traced);
        }
    }

    #[test]
    fn blocks_give_the_bits_of_single_impacts(
        model in models(),
        impacts in prop::collection::vec(prop_oneof![impacts(), spinning(), hostile()], 1..=BLOCK),
        seed: u64,
        first: u64,
    ) {
        let mut block = Block { length: impacts.len(), ..Block::default() };
        for (index, impact) in impacts.iter().enumerate() {
            block.keys[index] = first.wrapping_add(index as u64);
            for (column, input) in block.inputs.iter_mut().zip(&INPUTS) {
                column[index] = (input.value)(impact);
            }
        }
        for level in levels() {
            let mut outcomes = Outcomes::default();
            model.resolve_block_at(level, 0, &block, seed, &mut outcomes).unwrap();
            for (index, impact) in impacts.iter().enumerate() {
                let alone = model.resolve(0, impact, ImpactRng::new(seed, block.keys[index])).unwrap();
                prop_assert_eq!(bits(&alone), bits_at(&outcomes, index), "{:?}, {} of {}: {:?}", level, index, impacts.len(), impact);
            }
        }
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
    assert!(!prepared(&THORNTON_NING.replace("thornton-ning", "thornton-ning-raised-pull-off"), ""));
    assert!(!prepared("model = \"grant-tabakoff\"", ""));
    assert!(!wax(THORNTON_NING, "model = \"maw-barber-fawcett\"\nfriction = 0.3", "").is_prepared(0));
}
