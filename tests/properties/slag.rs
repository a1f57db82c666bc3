//! Walls with slag and powder: area shares stand outside probabilities, stiff slag holds nothing, capture goes one way.

use nearwall::{Impact, ImpactRng, Model};
use proptest::prelude::*;

use crate::cases::{config, decades, impacts};

/// Coal slag under char, powder of char on it. `capture` and `effects` are TOML.
fn model(capture: &str, effects: &str) -> Model {
    let text = format!(
        "[particle]\nmaterial = \"coal-char\"\nash = \"fly-ash\"\n\
         [walls.default]\nmaterial = \"refractory\"\nslag = \"coal-slag\"\npowder = \"coal-char\"\n\
         [normal]\nmodel = \"thornton-ning\"\nyield_ratio = 1.6\n[tangential]\nmodel = \"sliding-rolling\"\nfriction = 0.3\n\
         [capture]\nmodel = \"viscosity\"\nlaw = \"kalmanovitch-frank\"\n{capture}\n{effects}"
    );
    Model::from_toml("slag", &text).unwrap()
}

/// Char becomes sticky at a conversion of 0.89.
const EXPOSED: &str = "[[effects]]\nkind = \"conversion-transition\"\nthreshold = 0.89\nwidth = 0.01\n";

fn effects() -> impl Strategy<Value = String> {
    let film = "[[effects]]\nkind = \"liquid-film\"\nasperity = 1e-6\n";
    let wetting = "[[effects]]\nkind = \"dry-on-melt\"\ncontact_angle = 150\n";
    let powder = "[[effects]]\nkind = \"powder-layer\"\nthickness = 1e-4\nresidual = 0.25\n";
    let any = proptest::sample::subsequence(vec![EXPOSED, film, wetting, powder], 0..=4);
    any.prop_map(|parts| parts.concat())
}

fn capture() -> impl Strategy<Value = String> {
    let combination = prop_oneof![
        Just("combination = \"uintah\"".to_owned()),
        (0.0..1.0).prop_map(|erosion| format!("erosion = {erosion}"))
    ];
    let solidification = prop_oneof![Just("watt"), Just("none")];
    (decades(1.0, 1e6), combination, solidification).prop_map(|(reference, combination, solidification)| {
        format!("reference_viscosity = {reference:e}\n{combination}\nsolidification = \"{solidification}\"")
    })
}

/// A hot wall and a hot particle with something lying between them.
fn hot() -> impl Strategy<Value = Impact> {
    (impacts(), 900.0..1950.0, 900.0..1950.0, 0.0..=1.0, prop_oneof![Just(0.0), decades(1e-9, 1e-2)])
        .prop_map(|(impact, particle_temperature, wall_temperature, conversion, melt_thickness)| Impact {
            particle_temperature,
            wall_temperature,
            conversion,
            melt_thickness,
            particle_density: 1000.0,
            ..impact
        })
}

fn probability(model: &Model, impact: &Impact, key: u64) -> f64 {
    model.resolve(0, impact, ImpactRng::new(7, key)).unwrap().sticking_probability
}

proptest! {
    #![proptest_config(config(300))]

    /// `P = c P_covered + (1 - c) P_bare`, for every model and draw.
    #[test]
    fn a_covered_share_captures_like_powder(
        capture in capture(), effects in effects(), impact in hot(), share in 0.0..=1.0, key in any::<u64>()
    ) {
        let model = model(&capture, &effects);
        let at = |coverage| probability(&model, &Impact { coverage, ..impact }, key);
        // A covered share of 0 with a layer would be derived from the layer.
        let bare = probability(&model, &Impact { coverage: 0.0, layer_thickness: 0.0, ..impact }, key);
        let (covered, both) = (at(1.0), at(share));
        if share > 0.0 {
            let expected = share * covered + (1.0 - share) * bare;
            prop_assert!((both - expected).abs() < 1e-12, "{both} {expected}");
            prop_assert!(both <= share * covered + (1.0 - share) + 1e-12);
        }
    }

    /// Where bare slag is stickier than the powder, more cover captures less.
    #[test]
    fn more_cover_less_capture(capture in capture(), impact in hot(), key in any::<u64>()) {
        let model = model(&capture, EXPOSED);
        let shares: Vec<f64> = (0..=20).map(|i| f64::from(i) / 20.0).collect();
        let impact = Impact { layer_thickness: 0.0, ..impact };
        let over: Vec<f64> =
            shares.iter().map(|&coverage| probability(&model, &Impact { coverage, ..impact }, key)).collect();
        if over[0] >= over[20] {
            prop_assert!(over.windows(2).all(|pair| pair[1] <= pair[0] + 1e-12), "{over:?}");
        }
    }

    /// A hotter wall and a thinner slag capture more; `mu_ref` stands for the viscosity.
    #[test]
    fn hotter_and_thinner_capture_more(impact in hot(), reference in decades(1.0, 1e6), key in any::<u64>()) {
        let at = |reference: f64| model(&format!("reference_viscosity = {reference:e}"), EXPOSED);
        let by_reference: Vec<f64> =
            [0.1, 0.3, 1.0, 3.0, 10.0].map(|factor| probability(&at(factor * reference), &impact, key)).to_vec();
        prop_assert!(by_reference.is_sorted(), "{by_reference:?}");
        // Without adhesion, which has its own dependence on temperature.
        let model = at(reference);
        let temperatures = (0..40).map(|i| 900.0 + 25.0 * f64::from(i));
        let fast = Impact { normal_speed: 5.0 + impact.normal_speed, coverage: 0.0, layer_thickness: 0.0, ..impact };
        let by_temperature: Vec<f64> = temperatures
            .map(|wall_temperature| probability(&model, &Impact { wall_temperature, ..fast }, key))
            .filter(|probability| *probability < 1.0)
            .collect();
        prop_assert!(by_temperature.is_sorted(), "{by_temperature:?}");
    }

    /// Below the temperature of critical viscosity, 1528 K for this slag, only what is sticky itself stays.
    #[test]
    fn stiff_slag_holds_nothing_dry(effects in effects(), impact in hot(), key in any::<u64>()) {
        let model = model("reference_viscosity = 1e6", &format!("{effects}{EXPOSED}"));
        let dry = Impact {
            wall_temperature: impact.wall_temperature.min(1527.0),
            // Too fast and too large for adhesion.
            normal_speed: 10.0 + impact.normal_speed,
            diameter: impact.diameter.max(20e-6),
            conversion: 0.2,
            film_thickness: 0.0,
            melt_thickness: 0.0,
            ..impact
        };
        let found = probability(&model, &dry, key);
        prop_assert!(found < 1e-12, "{found}");
    }
}
