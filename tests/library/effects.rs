//! All effects: the documents list them, a model file can use each, and every outcome stays finite.

use std::cell::RefCell;
use std::collections::BTreeSet;

use crate::common::random::{HOSTILE, hostile_cases, random_cases, seed};
use nearwall::effect::{EFFECTS, EffectInfo, Parameter, Search};
use nearwall::impact::INPUTS;
use nearwall::{Impact, ImpactRng, Model, Outcome};

/// The stream that decides whether covered or bare wall is met.
const COVER: u64 = 4;

const IDS: [&str; 19] = [
    "yield-ratio",
    "adhesion-energy",
    "oblique-angle",
    "gas-lift",
    "sliding-to-rolling",
    "tangential-compliance",
    "nano-roughness",
    "micro-roughness",
    "agglomerates",
    "powder-layer",
    "liquid-film",
    "dry-on-melt",
    "melting-transition",
    "conversion-transition",
    "conversion-decline",
    "thermal-softening",
    "size-dependent-yield",
    "strain-rate-hardening",
    "viscoelastic-loss",
];

const PLAIN: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "pyrex"
[normal]
model = "thornton-ning"
yield_ratio = 0.7
[tangential]
model = "sliding-rolling"
friction = 0.28
"#;

/// The `[[effects]]` table of a kind.
fn table(kind: &EffectInfo, values: &[f64]) -> String {
    let lines = kind.parameters.iter().zip(values).map(|(p, value)| format!("{} = {value:e}\n", p.name));
    format!("[[effects]]\nkind = \"{}\"\n{}", kind.id, lines.collect::<String>())
}

fn model(effects: &str) -> Model {
    Model::from_toml("m", &format!("{PLAIN}{effects}")).unwrap()
}

/// A value in the middle of what a fit searches.
fn typical(parameter: &Parameter) -> f64 {
    match parameter.search {
        Search::Linear(low, high) => 0.5 * (low + high),
        Search::Log(low, high) => (low * high).sqrt(),
        Search::InputRange("T_p") => 300.0,
        Search::InputWidth("T_p") => 50.0,
        Search::InputRange("v_n") => 1.0,
        Search::InputRange("d") | Search::InputWidth("layer_thickness") => 1e-4,
        Search::InputRange("conversion") => 0.9,
        Search::InputWidth("conversion") => 0.05,
        other => unreachable!("{other:?}"),
    }
}

fn typicals(kind: &EffectInfo) -> Vec<f64> {
    kind.parameters.iter().map(typical).collect()
}

/// Every combination of the smallest and the largest value of each parameter.
fn corners(kind: &EffectInfo) -> Vec<Vec<f64>> {
    kind.parameters.iter().fold(vec![Vec::new()], |corners, parameter| {
        let (low, high) = parameter.bounds;
        let with = |corner: &Vec<f64>, value| [corner.as_slice(), &[value]].concat();
        corners.iter().flat_map(|corner| [with(corner, low), with(corner, high)]).collect()
    })
}

/// The rows of a document's table whose first column is an effect's id.
fn rows(document: &str) -> Vec<(String, String)> {
    let path = format!("{}/docs/{document}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let section = text.split("\n## ").find(|section| section.starts_with("Effects")).unwrap();
    let row = |line: &str| {
        let (id, rest) = line.strip_prefix("| `")?.split_once('`')?;
        Some((id.to_owned(), rest.to_owned()))
    };
    section.lines().filter_map(row).collect()
}

#[test]
fn the_documents_list_the_effects_in_order() {
    assert_eq!(EFFECTS.map(|kind| kind.id), IDS);
    for document in ["why/physics.md", "reference/model-file.md"] {
        let listed: Vec<String> = rows(document).into_iter().map(|(id, _)| id).collect();
        assert_eq!(listed, IDS, "docs/{document}");
    }
}

#[test]
fn the_model_file_document_has_every_parameter_with_its_unit() {
    for (kind, (_, row)) in EFFECTS.iter().zip(rows("reference/model-file.md")) {
        let cell = row.split('|').nth(1).unwrap().trim();
        let parameters = kind.parameters.iter().map(|p| format!("`{}` [{}]", p.name, p.unit));
        let parameters = parameters.collect::<Vec<_>>().join(", ");
        assert_eq!(cell, parameters.replace("m2", "m²"), "{}", kind.id);
    }
}

#[test]
fn searches_lie_in_bounds_and_inputs_are_known() {
    let known = |name: &str| INPUTS.iter().any(|input| input.name == name);
    for kind in EFFECTS {
        assert!(kind.inputs.iter().all(|name| known(name)), "{}", kind.id);
        for Parameter { name, bounds: (lowest, highest), search, .. } in kind.parameters {
            let inside = match *search {
                Search::Linear(low, high) => lowest <= &low && low < high && &high <= highest,
                Search::Log(low, high) => {
                    lowest.max(0.0) <= low && 0.0 < low && low < high && &high <= highest
                }
                Search::InputRange(input) | Search::InputWidth(input) => {
                    known(input) && kind.inputs.contains(&input)
                }
            };
            assert!(inside && lowest < highest, "{} {name}", kind.id);
        }
    }
}

#[test]
fn streams_are_distinct_and_each_effect_draws_from_its_own() {
    let all: Vec<u64> = EFFECTS.iter().filter_map(|kind| kind.stream).collect();
    assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
    assert!(!all.contains(&0), "capture's");
    let impact = Impact { normal_speed: 2.0, tangential_speed: 1.0, ..Impact::default() };
    for kind in EFFECTS {
        let drawn = RefCell::new(BTreeSet::new());
        let uniform = |stream| {
            drawn.borrow_mut().insert(stream);
            0.5
        };
        model(&table(kind, &typicals(kind))).resolve_with(0, &impact, uniform).unwrap();
        let own: BTreeSet<u64> = kind.stream.into_iter().chain([0]).collect();
        assert_eq!(drawn.into_inner(), own, "{}", kind.id);
    }
}

#[test]
fn a_model_file_reaches_every_effect_and_refuses_what_does_not_fit() {
    for kind in EFFECTS {
        let values = typicals(kind);
        let plain = model(&table(kind, &values));
        assert_eq!(plain.terms()[0].kind().id, kind.id);
        assert_eq!(plain.terms()[0].values(), values);
        let fitted = kind.parameters.iter().zip(&values).map(|(p, value)| {
            format!("{} = {{ value = {value:e}, low = {value:e}, high = {value:e} }}\n", p.name)
        });
        let fitted = format!("[[effects]]\nkind = \"{}\"\n{}", kind.id, fitted.collect::<String>());
        assert_eq!(model(&fitted).terms()[0].values(), values);
        for (index, parameter) in kind.parameters.iter().enumerate() {
            let (low, high) = parameter.bounds;
            for wrong in [low - (low.abs() + 1.0), high * 2.0, f64::NAN] {
                let mut values = values.clone();
                values[index] = wrong;
                let text = format!("{PLAIN}{}", table(kind, &values).replace("NaN", "nan"));
                let error = Model::from_toml("m", &text).unwrap_err().to_string();
                assert!(error.contains(parameter.name), "{error}");
            }
            let text = table(kind, &values).replace(&format!("\n{} = ", parameter.name), "\n# ");
            let optional = parameter.default.or(parameter.absent);
            match (Model::from_toml("m", &format!("{PLAIN}{text}")), optional) {
                (Ok(model), Some(default)) => assert_eq!(model.terms()[0].values()[index], default),
                (Err(error), None) => assert!(error.to_string().contains(parameter.name), "{error}"),
                (read, default) => unreachable!("{} {default:?}: {}", parameter.name, read.is_ok()),
            }
        }
    }
}

fn assert_finite(outcome: &Outcome, what: &dyn std::fmt::Debug) {
    let Outcome {
        normal_restitution: e_n, tangential_restitution: e_t, sticking_probability: p, spin, ..
    } = *outcome;
    assert!(e_n.is_finite() && e_n >= 0.0, "e_n = {e_n}: {what:?}");
    assert!(!e_t.is_nan() && !spin.is_nan() && (0.0..=1.0).contains(&p), "{outcome:?}: {what:?}");
}

/// Impacts with numbers that break arithmetic, under parameters at the ends of their bounds.
#[test]
fn hostile_impacts_have_a_finite_restitution() {
    let cases: Vec<_> = hostile_cases().into_iter().filter(|case| case.1.check().is_ok()).collect();
    assert!(cases.len() > 1000);
    let every = |pick: fn(&EffectInfo) -> Vec<f64>| EFFECTS.map(|kind| table(kind, &pick(kind))).concat();
    let mut effects = vec![
        every(typicals),
        every(|kind| kind.parameters.iter().map(|parameter| parameter.bounds.0).collect()),
        every(|kind| kind.parameters.iter().map(|parameter| parameter.bounds.1).collect()),
    ];
    for kind in EFFECTS {
        effects.extend(corners(kind).iter().map(|corner| table(kind, corner)));
    }
    for effects in effects {
        let model = model(&effects);
        for (_, impact, draw) in &cases {
            assert_finite(&model.resolve(0, impact, *draw).unwrap(), &(&effects, impact));
            model.speeds(0, impact).unwrap();
        }
        for spin in HOSTILE.into_iter().filter(|spin| spin.is_finite()) {
            for chance in [0.0, 1e-300, 0.5, 1.0] {
                let impact = Impact { normal_speed: 1.0, tangential_speed: 3.0, spin, ..Impact::default() };
                let outcome = model.resolve_with(0, &impact, |_| chance).unwrap();
                assert_finite(&outcome, &(&effects, spin, chance));
            }
        }
    }
}

#[test]
fn chance_counts_for_effects_with_streams_and_for_no_others() {
    let cases = random_cases(seed(), 200);
    for kind in EFFECTS {
        let model = model(&table(kind, &typicals(kind)));
        let numbers = |impact: &Impact, chance: f64| {
            // Whether covered or bare wall is met is drawn for every wall with slag, without an effect.
            let of_stream = |stream| if stream == COVER { 0.5 } else { chance };
            let outcome = model.resolve_with(0, impact, of_stream).unwrap();
            [outcome.normal_restitution, outcome.tangential_restitution, outcome.sticking_probability]
        };
        let changed = cases.iter().any(|case| numbers(&case.1, 0.1) != numbers(&case.1, 0.9));
        assert_eq!(changed, kind.stream.is_some(), "{}", kind.id);
    }
}

/// A term with neutral parameters has no effect.
#[test]
fn neutral_parameters_change_nothing() {
    let neutral: [(&str, &[f64]); 12] = [
        ("yield-ratio", &[0.7]),
        ("oblique-angle", &[0.0, 1.0]),
        ("gas-lift", &[0.0]),
        ("sliding-to-rolling", &[0.28]),
        ("nano-roughness", &[0.0]),
        ("micro-roughness", &[0.0]),
        ("agglomerates", &[0.0, 0.8, 0.1]),
        ("powder-layer", &[1e-4, 1.0]),
        ("liquid-film", &[0.0, 1e-7]),
        ("thermal-softening", &[1e4, 1.0]),
        ("size-dependent-yield", &[1e-6, 0.0]),
        ("strain-rate-hardening", &[1.0, 0.0]),
    ];
    let plain = model("");
    for (id, values) in neutral {
        let kind = EFFECTS.into_iter().find(|kind| kind.id == id).unwrap();
        let with = model(&table(kind, values));
        for (_, impact, draw) in random_cases(seed(), 200) {
            assert_eq!(with.resolve(0, &impact, draw), plain.resolve(0, &impact, draw), "{id} {impact:?}");
        }
    }
}

/// A rough mirror sends particles elsewhere but keeps their energy, and glancing ones leave steeper than they came.
#[test]
fn a_rough_mirror_keeps_the_energy() {
    let mirror = PLAIN
        .replace("model = \"thornton-ning\"\n", "model = \"constant\"\ne_n = 1\n")
        .replace("model = \"sliding-rolling\"\nfriction = 0.28", "model = \"constant\"\ne_t = 1");
    let rough = format!("{mirror}[[effects]]\nkind = \"micro-roughness\"\nangle = 0.1\n");
    let rough = Model::from_toml("m", &rough).unwrap();
    let mut steeper = 0;
    for key in 0..1000 {
        let impact = Impact { normal_speed: 0.5, tangential_speed: 3.0, ..Impact::default() };
        let outcome = rough.resolve(0, &impact, ImpactRng::new(1, key)).unwrap();
        let energy =
            (0.5 * outcome.normal_restitution).powi(2) + (3.0 * outcome.tangential_restitution).powi(2);
        assert!((energy - 9.25).abs() < 1e-9, "{outcome:?}");
        steeper += u32::from(outcome.normal_restitution > 1.0);
    }
    assert!(steeper > 500, "{steeper} of 1000 with e_n > 1");
}

/// Stickiness reduces `e_n` after all effects on it, whatever their order in the file.
#[test]
fn stickiness_reduces_e_n_after_the_effects() {
    let agglomerates = "[[effects]]\nkind = \"agglomerates\"\nfraction = 1\nrestitution = 0.8\nspread = 0\n";
    let melting = "[[effects]]\nkind = \"melting-transition\"\ntemperature = 293.15\nwidth = 10\n";
    let impact = Impact { normal_speed: 1.0, ..Impact::default() };
    for effects in [format!("{agglomerates}{melting}"), format!("{melting}{agglomerates}")] {
        let outcome = model(&effects).resolve(0, &impact, ImpactRng::default()).unwrap();
        assert!((outcome.normal_restitution - 0.4).abs() < 1e-12, "{outcome:?}");
    }
}
