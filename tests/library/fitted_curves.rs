//! Fitted curves, level shifts and the inputs that a model file declares, against numbers by hand;
//! the mean over draws against plain random draws.

use nearwall::effect::{CurveAxis, CurveInput, CurveTarget, FittedCurve, Operation, Term};
use nearwall::impact::{EXTRA_INPUTS, ExtraInput, INPUTS};
use nearwall::model::block::{BLOCK, Block, Outcomes, Workspace};
use nearwall::{Impact, ImpactRng, Model, Outcome};

use crate::common::random::seed;

pub const PLAIN: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "pyrex"
[normal]
model = "constant"
e_n = 0.5
[tangential]
model = "constant"
e_t = 0.8
"#;

pub fn model(text: &str) -> Model {
    Model::from_toml("m.toml", &format!("{PLAIN}{text}")).unwrap()
}

pub fn fault(text: &str) -> String {
    Model::from_toml("m.toml", &format!("{PLAIN}{text}")).unwrap_err().to_string()
}

fn at(temperature: f64) -> Impact {
    Impact { normal_speed: 1.0, particle_temperature: temperature, ..Impact::default() }
}

fn resolve(model: &Model, impact: &Impact) -> Outcome {
    model.resolve(0, impact, ImpactRng::default()).unwrap()
}

fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-12, "{value} against {expected}");
}

const CURVE: &str = "[[effects]]\nkind = \"fitted-curve\"\ninput = \"T_p\"\non = \"e_n\"\n\
                     knots = [300, 350, 400]\nvalues = [-0.1, 0.1, 0.05]\n";

#[test]
fn a_curve_is_linear_between_its_knots_and_constant_beyond() {
    let model = model(CURVE);
    for (temperature, expected) in [
        (200.0, 0.4),
        (300.0, 0.4),
        (310.0, 0.44),
        (350.0, 0.6),
        (375.0, 0.575),
        (400.0, 0.55),
        (2000.0, 0.55),
    ] {
        let outcome = resolve(&model, &at(temperature));
        close(outcome.normal_restitution, expected);
        assert_eq!((outcome.tangential_restitution, outcome.sticking_probability), (0.8, 0.0));
    }
    // The last value of the grid is reached however far the impact is.
    close(resolve(&model, &at(f64::MAX)).normal_restitution, 0.55);
}

#[test]
fn factors_levels_and_e_t_act_in_the_order_of_the_file() {
    let level = |on: &str, form: &str, value: &str| {
        format!("[[effects]]\nkind = \"level-shift\"\non = \"{on}\"\nform = \"{form}\"\nvalue = {value}\n")
    };
    let [add, factor] =
        [level("e_n", "add", "{ value = 0.1, low = 0.0, high = 0.2 }"), level("e_n", "factor", "-0.5")];
    close(resolve(&model(&format!("{add}{factor}")), &at(300.0)).normal_restitution, 0.3);
    close(resolve(&model(&format!("{factor}{add}")), &at(300.0)).normal_restitution, 0.35);
    let below = level("e_n", "add", "-0.9");
    assert_eq!(resolve(&model(&below), &at(300.0)).normal_restitution, 0.0);
    // Only the sum is bounded.
    close(
        resolve(&model(&format!("{below}{add}{}", level("e_n", "add", "0.5"))), &at(300.0))
            .normal_restitution,
        0.2,
    );
    close(resolve(&model(&level("e_t", "add", "-1")), &at(300.0)).tangential_restitution, -0.2);
    close(resolve(&model(&level("e_t", "factor", "0.25")), &at(300.0)).tangential_restitution, 1.0);
    let none =
        resolve(&model(&format!("{}{}", level("e_n", "add", "0"), level("capture", "add", "0"))), &at(300.0));
    assert_eq!(none, resolve(&model(""), &at(300.0)));
}

#[test]
fn a_surface_is_bilinear() {
    let surface = "[[effects]]\nkind = \"fitted-curve\"\ninput = [\"v_n\", \"humidity\"]\non = \"e_n\"\n\
                   knots = [[1, 3], [0, 0.5, 1]]\nvalues = [[0, 0.1, 0.2], [0.4, 0.2, 0]]\n\
                   [inputs.humidity]\ndefault = 0.5\n";
    let model = model(surface);
    let e_n = |normal_speed, humidity| {
        let mut impact = Impact { normal_speed, ..Impact::default() };
        impact.extra[0] = humidity;
        resolve(&model, &impact).normal_restitution
    };
    close(e_n(1.0, 0.0), 0.5);
    close(e_n(3.0, 1.0), 0.5);
    close(e_n(3.0, 0.25), 0.8);
    // A quarter of the way in speed, half of the way between the last two knots: 0.75 0.15 + 0.25 0.1.
    close(e_n(1.5, 0.75), 0.6375);
    close(e_n(9.0, -1.0), 0.9);
    close(e_n(1.0, f64::NAN), 0.6);
}

#[test]
fn a_word_has_its_own_value_and_no_neighbour() {
    let text = |default: &str| {
        format!(
            "[inputs.operator]\nlabels = [\"Ann\", \"Bob\", \"Cem\"]\n{default}\n[[effects]]\nkind = \"fitted-curve\"\n\
             input = \"operator\"\non = \"e_n\"\nknots = [\"Cem\", \"Ann\"]\nvalues = [0.3, 0.1]\n"
        )
    };
    let [without, with] = [model(&text("")), model(&text("default = \"Cem\""))];
    let input = &without.extra_inputs()[0];
    let e_n = |model: &Model, value: f64| {
        let mut impact = at(300.0);
        impact.extra[0] = value;
        resolve(model, &impact).normal_restitution
    };
    for (label, expected) in [("Ann", 0.6), ("Bob", 0.5), ("Cem", 0.8), ("Dan", 0.5)] {
        close(e_n(&without, input.value_of_text(label).unwrap()), expected);
        close(e_n(&with, input.value_of_text(label).unwrap()), expected);
    }
    close(e_n(&without, f64::NAN), 0.5);
    close(e_n(&with, f64::NAN), 0.8);
    close(e_n(&without, 1.5), 0.5);
}

/// `p` of the melting transition is that of its logistic; the expected values are those of a pocket calculator.
#[test]
fn log_odds_are_shifted_also_from_0_and_1_and_below_a_ceiling() {
    let melting = "[[effects]]\nkind = \"melting-transition\"\ntemperature = 350\nwidth = 10\n";
    let shift =
        |value: f64| format!("[[effects]]\nkind = \"level-shift\"\non = \"capture\"\nvalue = {value}\n");
    let p = |text: &str, impact: &Impact| resolve(&model(text), impact).sticking_probability;
    let share = at(350.0 + 10.0 * (0.3_f64 / 0.7).ln());
    close(p(melting, &share), 0.3);
    let expected = [
        (at(10.0), 2.0, 0.031112715860032),
        (at(10.0), -2.0, 0.0),
        (share, -1.0, 0.133649119251519),
        (share, 1.5, 0.661369890202167),
        (at(9000.0), -3.0, 0.912445482284232),
        (at(9000.0), 2.0, 1.0),
    ];
    for (impact, value, expected) in expected {
        let shifted = p(&format!("{melting}{}", shift(value)), &impact);
        assert!((shifted - expected).abs() < 1e-11, "{value}: {shifted} against {expected}");
        // Shifts add up, and none of them loses what another one needs.
        let two = p(&format!("{melting}{}{}", shift(value - 7.0), shift(7.0)), &impact);
        assert!((two - expected).abs() < 1e-11, "{value}: {two} against {expected}");
    }
    // A ceiling of nine tenths, before or after a shift in the file, comes first.
    let ceiling = shift(-0.1).replace("value", "form = \"factor\"\nvalue");
    let shifted = 0.627726900687759;
    for (text, expected) in [
        (ceiling.clone(), 0.27),
        (format!("{ceiling}{}", shift(1.5)), shifted),
        (format!("{}{ceiling}", shift(1.5)), shifted),
        (ceiling.repeat(2), 0.243),
        (ceiling.replace("-0.1", "9"), 1.0),
    ] {
        let found = p(&format!("{melting}{text}"), &share);
        assert!((found - expected).abs() < 1e-11, "{text}: {found} against {expected}");
    }
    // A particle that adhesion holds stays, unless a correction of capture releases it.
    let slow = Impact { normal_speed: 1e-3, ..Impact::default() };
    let adhesive = PLAIN.replace("\"constant\"\ne_n = 0.5", "\"thornton-ning\"\nyield_ratio = 0.7");
    let held = |text: &str| resolve(&Model::from_toml("m", &format!("{adhesive}{text}")).unwrap(), &slow);
    let raised = held("[[effects]]\nkind = \"level-shift\"\non = \"e_n\"\nvalue = 0.2\n");
    assert!(raised.stuck && raised.sticking_probability == 1.0);
    assert!((held(&shift(-3.0)).sticking_probability - 0.912445482284232).abs() < 1e-11);
}

#[test]
fn curves_and_inputs_built_in_code_are_those_of_a_file() {
    let place = |name: &str| INPUTS.iter().position(|input| input.name == name).unwrap();
    let axes = vec![
        CurveAxis { input: CurveInput::Input(place("T_p")), knots: vec![300.0, 400.0] },
        CurveAxis { input: CurveInput::Extra(1), knots: vec![0.0, 2.0] },
    ];
    let (on, form) = (CurveTarget::TangentialRestitution, Operation::Factor);
    let curve = FittedCurve { on, form, axes, values: vec![0.0, 0.1, 0.2, 0.4] };
    let level =
        FittedCurve { on: CurveTarget::Capture, form: Operation::Add, axes: Vec::new(), values: vec![0.5] };
    let labels = vec!["A".to_owned()];
    let built = model("")
        .with_extra_inputs(vec![ExtraInput::words("lot", labels), ExtraInput::number("dose", 1.0)])
        .with_terms(vec![Term::fitted_curve(curve), Term::fitted_curve(level)]);
    let read = model(
        "[inputs.lot]\nlabels = [\"A\"]\n[inputs.dose]\ndefault = 1\n[[effects]]\nkind = \"fitted-curve\"\n\
         input = [\"T_p\", \"dose\"]\non = \"e_t\"\nform = \"factor\"\nknots = [[300, 400], [0, 2]]\n\
         values = [[0, 0.1], [0.2, 0.4]]\nlow = [[0, 0], [0, 0]]\nhigh = [[0.2, 0.2], [0.4, 0.5]]\n\
         [[effects]]\nkind = \"level-shift\"\non = \"capture\"\nvalue = 0.5\n",
    );
    assert_eq!(built.extra_inputs(), read.extra_inputs());
    for temperature in [250.0, 330.0, 500.0] {
        assert_eq!(resolve(&built, &at(temperature)), resolve(&read, &at(temperature)));
    }
    close(resolve(&read, &at(350.0)).tangential_restitution, 0.8 * 1.175);
    let lines: Vec<String> =
        read.describe().into_iter().map(|(what, text)| format!("{what} {text}")).collect();
    for line in [
        "input lot, one of A, no default",
        "input dose, default 1",
        "effect fitted-curve: e_t (1 + f), f 0 to 0.4 over T_p (2 knots from 300 to 400) and dose (2 knots from 0 to 2)",
        "effect level-shift: log odds of capture + f, f = 0.5",
    ] {
        assert!(lines.iter().any(|own| own == line), "{line} is not in {lines:#?}");
    }
    let (_, trace) = read.explain(0, &at(350.0), ImpactRng::default()).unwrap();
    let last: Vec<_> = trace.iter().rev().take(2).map(|entry| (entry.term, entry.quantity)).collect();
    assert_eq!(last, [("level-shift", "p_stick"), ("fitted-curve", "e_t")]);
}

#[test]
fn a_range_may_name_a_declared_input() {
    let model = model(&format!(
        "{CURVE}valid = {{ T_p = [290, 410], dose = [0, 1] }}\n[inputs.dose]\ndefault = 0.5\n"
    ));
    let outside = |dose: f64, temperature: f64| {
        let mut impact = at(temperature);
        impact.extra[0] = dose;
        resolve(&model, &impact).outside_range
    };
    assert!(!outside(f64::NAN, 300.0) && !outside(1.0, 300.0));
    assert!(outside(1.5, 300.0) && outside(1.0, 500.0));
    let mut infinite = at(300.0);
    infinite.extra[0] = f64::INFINITY;
    let error = model.resolve(0, &infinite, ImpactRng::default()).unwrap_err().to_string();
    assert_eq!(error, "dose = inf: must be finite");
}

const DECLARED: &str = "[inputs.humidity]\ndefault = 40\n[inputs.operator]\nlabels = [\"Ann\", \"Bob\"]\n\
                        [[effects]]\nkind = \"fitted-curve\"\ninput = \"humidity\"\non = \"e_t\"\n\
                        knots = [0, 100]\nvalues = [0, -0.1]\n";

#[test]
fn blocks_have_declared_inputs_and_laws_alone_stay_prepared() {
    let model = model(DECLARED);
    assert!(!model.is_prepared(0) && self::model("").is_prepared(0));
    let mut block = Block { length: 3, ..Block::default() };
    let mut outcomes = Outcomes::default();
    model.resolve_block(0, &block, 1, &mut outcomes, &mut Workspace::default()).unwrap();
    assert!(outcomes.tangential_restitution[..3].iter().all(|e_t| (e_t - 0.76).abs() < 1e-12));
    block.extra = vec![[f64::NAN; BLOCK]];
    block.extra[0][1] = 100.0;
    model.resolve_block(0, &block, 1, &mut outcomes, &mut Workspace::default()).unwrap();
    for (e_t, expected) in outcomes.tangential_restitution.into_iter().zip([0.76, 0.7, 0.76]) {
        close(e_t, expected);
    }
}

#[test]
fn the_example_of_the_page_is_read() {
    let page = include_str!("../../docs/reference/model-file.md");
    let section = page.split("\n## ").find(|section| section.starts_with("Fitted curves")).unwrap();
    let example = section.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let commented = example.replace("\n# ", "\n");
    for text in [example, &commented] {
        let model = model(text);
        assert_eq!((model.terms().len(), model.extra_inputs().len()), (4, 2));
    }
}

#[test]
fn errors_name_the_key_and_the_remedy() {
    let curve = |from: &str, to: &str| fault(&CURVE.replace(from, to));
    let part = |message: String, parts: &[&str]| {
        assert!(parts.iter().all(|part| message.contains(part)), "{message} lacks one of {parts:?}");
    };
    let values = "values = [-0.1, 0.1, 0.05]";
    part(
        curve("350, 400", "400, 350"),
        &["m.toml:16:1: effects[1].knots", "must ascend, but 350 follows 400", "sort"],
    );
    part(curve("[300, 350, 400]", "[300]"), &["effects[1].knots", "at least two", "level-shift"]);
    part(curve(values, "values = [0, 1]"), &["effects[1].values", "expected 3 numbers", "found 2"]);
    part(curve(values, "values = [0, 1, 1e9]"), &["effects[1].values", "1000000000 is outside -100 to 100"]);
    part(curve(values, ""), &["effects[1].values: missing", "a number for each knot"]);
    part(curve(values, &format!("{values}\nlow = [1, 2]")), &["effects[1].low", "expected 3 numbers"]);
    part(
        curve(values, &format!("{values}\nlow = [1, 2, 3]\nhigh = [1, 2, 2]")),
        &["effects[1].low", "exchange"],
    );
    part(
        curve("\"T_p\"", "\"humidity\""),
        &["effects[1].input", "unknown input `humidity`", "[inputs.humidity]"],
    );
    part(curve("\"T_p\"", "\"layer_thicknes\""), &["did you mean `layer_thickness`?"]);
    part(curve("\"T_p\"", "[\"T_p\", \"T_p\"]"), &["effects[1].input", "two different ones"]);
    part(curve("\"T_p\"", "[\"T_p\", \"T_w\"]"), &["effects[1].knots", "two lists, of T_p and of T_w"]);
    part(curve("\"e_n\"", "\"e_m\""), &["effects[1].on", "known here: e_n, e_t, capture"]);
    part(curve("on = \"e_n\"\n", ""), &["effects[1].on: missing"]);
    part(curve("fitted-curve", "fited-curve"), &["effects[1].kind", "did you mean `fitted-curve`?"]);
    part(curve(values, &format!("{values}\nvalue = 1")), &["unknown key `value`"]);
    part(
        fault("[inputs.T_p]\ndefault = 1\n"),
        &["inputs.T_p", "is an input that every model has", "another name"],
    );
    for observed in ["e_n", "outcome", "captured", "e_t_err", "v_n_err"] {
        let text = fault(&format!("[inputs.{observed}]\ndefault = 1\n"));
        part(text, &["inputs", observed, "observed column", "another name"]);
    }
    part(fault("[inputs.dose]\n"), &["inputs.dose.default: missing", "`labels`"]);
    part(fault("[inputs.lot]\nlabels = [\"A\", \"A\"]\n"), &["inputs.lot.labels", "`A` occurs twice"]);
    part(fault("[inputs.lot]\nlabels = []\n"), &["inputs.lot.labels", "empty"]);
    part(
        fault("[inputs.lot]\nlabels = [\"A\"]\ndefault = \"B\"\n"),
        &["inputs.lot.default", "unknown label `B`"],
    );
    let many: String = (0..=EXTRA_INPUTS).map(|i| format!("[inputs.x{i}]\ndefault = 1\n")).collect();
    part(fault(&many), &["inputs", "9 inputs are declared; at most 8"]);
    let lot = "[inputs.lot]\nlabels = [\"A\"]\n";
    let labels = |knots: &str| {
        fault(&format!("{}{lot}", CURVE.replace("T_p", "lot").replace("[300, 350, 400]", knots)))
    };
    part(labels("[\"B\"]"), &["effects[1].knots", "unknown label of lot `B`"]);
    part(labels("[1, 2, 3]"), &["effects[1].knots", "a list of texts"]);
}

/// Every chance of a model at once: covered wall, tilt, agglomerates and adhesion.
#[test]
fn the_mean_over_draws_is_that_of_random_draws() {
    let base = PLAIN
        .replace("\"pyrex\"", "\"pyrex\"\npowder = \"montan-wax\"\ncoverage = 0.35")
        .replace("\"constant\"\ne_n = 0.5", "\"thornton-ning\"\nyield_ratio = 0.7");
    let effect = |kind: &str, rest: &str| format!("[[effects]]\nkind = \"{kind}\"\n{rest}\n");
    let agglomerates = effect("agglomerates", "fraction = 0.25\nrestitution = 0.8\nspread = 0.1");
    let tilt = effect("micro-roughness", "angle = 0.1");
    let adhesion = effect("nano-roughness", "spread = 0.9");
    let melting = effect("melting-transition", "temperature = 350\nwidth = 10");
    let impact = Impact { normal_speed: 0.4, tangential_speed: 0.6, diameter: 75e-6, ..at(342.0) };
    let (seed, count) = (seed(), 20_000);
    println!("seed {seed}");
    for text in [
        String::new(),
        agglomerates.clone(),
        tilt.clone(),
        format!("{adhesion}{melting}"),
        format!("{agglomerates}{tilt}{adhesion}{melting}"),
    ] {
        let model = Model::from_toml("m", &format!("{base}{text}")).unwrap();
        let outcomes: Vec<Outcome> =
            (0..count).map(|key| model.resolve(0, &impact, ImpactRng::new(seed, key)).unwrap()).collect();
        let mean = model.expect(0, &impact, 64).unwrap();
        assert_eq!(mean, model.expect(0, &impact, 64).unwrap());
        let rebounds: Vec<&Outcome> = outcomes.iter().filter(|outcome| !outcome.stuck).collect();
        let captured = (outcomes.len() - rebounds.len()) as f64 / count as f64;
        let plain = |value: fn(&Outcome) -> f64| {
            let number = rebounds.len() as f64;
            let mean = rebounds.iter().map(|outcome| value(outcome)).sum::<f64>() / number;
            let variance =
                rebounds.iter().map(|outcome| (value(outcome) - mean).powi(2)).sum::<f64>() / number;
            (mean, variance, (variance / number).sqrt())
        };
        let share_error = (captured * (1.0 - captured) / count as f64).sqrt();
        let means = [
            ("e_n", mean.normal_restitution, plain(|outcome| outcome.normal_restitution)),
            ("e_t", mean.tangential_restitution, plain(|outcome| outcome.tangential_restitution)),
            ("p_stick", mean.sticking_probability, (captured, captured * (1.0 - captured), share_error)),
        ];
        for (what, mean, (random, variance, error)) in means {
            // 64 draws miss a sharp branch by up to a fiftieth of the deviation.
            let allowed = 4.0 * error + 0.02 * variance.sqrt() + 1e-12;
            assert!((mean - random).abs() < allowed, "{text}: {what} {mean}, random {random} +- {error}");
        }
        let random = [plain(|outcome| outcome.normal_restitution).1, plain(|o| o.tangential_restitution).1];
        for (variance, random) in mean.variances.into_iter().zip(random) {
            assert!((variance - random).abs() < 0.1 * random + 1e-12, "{text}: {variance}, random {random}");
        }
    }
}
