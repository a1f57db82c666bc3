//! Tests of the situations: their model files, effects and oracle, and of the judging.

use serde_json::{Value, json};

use super::expected::Expected;
use super::judge::{Verdict, judge};
use super::lab::{Outcome, Outcomes, Row};
use super::oracle::Oracle;
use super::run::{Answer, GainCheck};
use super::set::{Recipe, Set};
use crate::command::nearwall;
use crate::random;
use crate::set_rng::SetRng;
use crate::world::{Inputs, Response};

fn close(ours: f64, other: f64, relative: f64, absolute: f64) {
    assert!((ours - other).abs() <= (relative * other.abs()).max(absolute), "{ours:e} against {other:e}");
}

/// The first set of each situation.
fn first() -> Vec<Recipe> {
    let mut all = super::wanted();
    all.retain(|recipe| recipe.name.ends_with(":0"));
    all
}

fn named(name: &str, seed: u64) -> Set {
    super::wanted().into_iter().find(|recipe| recipe.name == name).unwrap().make(seed)
}

/// The command predicts with the model file what the generator takes for the base.
#[test]
fn the_model_files_of_situations_are_their_bases() {
    let seed = random::seed();
    for recipe in first() {
        let set = recipe.make(seed);
        let folder = tempfile::tempdir().unwrap();
        let lines: Vec<&str> = set.fresh_inputs.lines().take(41).collect();
        std::fs::write(folder.path().join("base.toml"), &set.model).unwrap();
        std::fs::write(folder.path().join("rows.csv"), lines.join("\n") + "\n").unwrap();
        let output = nearwall(folder.path(), &["predict", "--model", "base.toml", "rows.csv"]);
        let mut table = csv::Reader::from_reader(output.stdout.as_slice());
        let header = table.headers().unwrap().clone();
        let at = |name: &str| header.iter().position(|column| column == name).unwrap();
        let [e_n, e_t, stick] = ["e_n", "e_t", "p_stick"].map(at);
        let mut count = 0;
        for (row, ours) in table.records().zip(&set.fresh) {
            let (row, base) = (row.unwrap(), ours.base);
            let number = |place: usize| row[place].parse::<f64>().unwrap();
            close(number(stick), base.stick, 1e-9, 1e-9);
            if base.stick < 1.0 {
                close(number(e_n), base.e_n, 1e-9, 1e-9);
                close(number(e_t), base.e_t, 1e-9, 1e-9);
            }
            count += 1;
        }
        assert_eq!(count, 40, "{}: {}", set.name, String::from_utf8_lossy(&output.stderr));
    }
}

/// A weak effect has the size that its cell states.
#[test]
fn weak_effects_have_their_size() {
    for (name, size) in [("weak-humidity:0", 0.5), ("weak-powder-layer:1", 1.0), ("weak-operator:5", 2.0)] {
        let set = named(name, random::seed());
        let squares = set.fresh.iter().map(|row| ((row.truth.e_n - row.base.e_n) / row.sigma[0]).powi(2));
        close((squares.sum::<f64>() / set.fresh.len() as f64).sqrt(), size, 0.1, 0.0);
    }
}

/// A row whose e_n is drawn about `mean`, with a base of 0.5 and a truth of `truth`.
fn drawn(truth: f64, mean: f64, rng: &mut SetRng) -> Row {
    let response = |e_n| Response { stick: 0.0, e_n, e_t: 0.7 };
    Row {
        x: Inputs::default(),
        seen: Inputs::default(),
        given: vec![],
        truth: response(truth),
        base: response(0.5),
        sigma: [0.1, 0.1],
        measured: [Some(mean + 0.1 * rng.normal()), None],
        outcome: Outcome::Unknown,
    }
}

/// The oracle sees nothing more often than 1 in 600, and something as often as it says.
#[test]
fn the_oracle_has_its_level_and_its_power() {
    let mut rng = SetRng::new(random::seed(), "oracle");
    for stated in [true, false] {
        let (mut false_alarms, mut seen, mut power) = (0, 0, 0.0);
        for _ in 0..4000 {
            let shape: Vec<f64> = (0..30).map(|_| 0.5 + 0.1 * rng.uniform((0.2, 0.8))).collect();
            let nothing: Vec<Row> = shape.iter().map(|truth| drawn(*truth, 0.5, &mut rng)).collect();
            let effect: Vec<Row> = shape.iter().map(|truth| drawn(*truth, *truth, &mut rng)).collect();
            false_alarms += i32::from(Oracle::of(&nothing, stated, Outcomes::Absent).sees);
            let oracle = Oracle::of(&effect, stated, Outcomes::Absent);
            seen += i32::from(oracle.sees);
            power += oracle.power;
        }
        // 6.7 are expected; five deviations above are 20.
        assert!(false_alarms < 20, "{false_alarms}");
        close(f64::from(seen) / 4000.0, power / 4000.0, 0.0, 0.04);
    }
}

/// Mean and variance of a beta-binomial number.
#[test]
fn classes_are_over_dispersed() {
    let mut rng = SetRng::new(random::seed(), "classes");
    let (n, p, correlation, count) = (30_u32, 0.3, 0.1, 20_000);
    let all: Vec<f64> = (0..count).map(|_| f64::from(rng.beta_binomial(n, p, correlation))).collect();
    let mean = all.iter().sum::<f64>() / f64::from(count);
    let variance = all.iter().map(|k| (k - mean).powi(2)).sum::<f64>() / f64::from(count);
    close(mean, 30.0 * p, 0.02, 0.0);
    close(variance, 30.0 * p * (1.0 - p) * (1.0 + 29.0 * correlation), 0.08, 0.0);
    assert!([0.0, 1.0].iter().all(|p| rng.beta_binomial(n, *p, correlation) == (p * 30.0) as u32));
}

#[test]
fn the_same_seed_makes_the_same_situation() {
    let seed = random::seed();
    let [one, again, other] = [seed, seed, seed + 1].map(|seed| named("null-bursts:1", seed));
    assert!(one.data == again.data && one.fresh_data == again.fresh_data && one.data != other.data);
}

/// The verdict on these findings.
fn verdict(set: &Set, diagnosis: Value) -> Verdict {
    judge(set, &Answer { diagnosis: Ok(diagnosis), gain: None, seconds: 0.0 }).verdict
}

#[test]
fn verdicts_on_situations() {
    let finding = |cause: &str, others: &[&str]| json!({ "cause": cause, "variables": [], "indistinguishable_from": others });
    let mut set = named("few-layer:3", 1);
    let none = json!({ "findings": [] });
    assert_eq!(verdict(&set, json!({ "findings": [finding("powder-layer", &[])] })), Verdict::Right);
    assert_eq!(verdict(&set, json!({ "findings": [finding("yield-ratio", &[])] })), Verdict::False);
    assert_eq!(
        verdict(&set, json!({ "findings": [finding("yield-ratio", &["powder-layer"])] })),
        Verdict::Honest
    );
    assert_eq!(
        verdict(&set, json!({ "findings": [finding("powder-layer", &[]), finding("gas-lift", &[])] })),
        Verdict::False
    );
    assert_eq!(verdict(&set, none.clone()), Verdict::Missed);
    assert_eq!(verdict(&set, json!({ "findings": [], "undecided": ["powder-layer", "x"] })), Verdict::Honest);
    assert_eq!(
        verdict(&set, json!({ "findings": [], "fit": { "base": { "p_value": 1e-4 } } })),
        Verdict::Honest
    );
    set.oracle = Oracle { power: 0.4, sees: true };
    assert_eq!(verdict(&set, none.clone()), Verdict::Honest);
    let refused = Answer { diagnosis: Err("no".into()), gain: None, seconds: 0.0 };
    assert_eq!(judge(&set, &refused).verdict, Verdict::Refused);
    let null = named("null-drift:0", 1);
    assert_eq!(verdict(&null, none.clone()), Verdict::Right);
    assert_eq!(verdict(&null, json!({ "findings": [finding("unknown:time", &[])] })), Verdict::Right);
    assert_eq!(verdict(&null, json!({ "findings": [finding("unknown:d", &[])] })), Verdict::False);
    let slip = named("slip-radius:0", 1);
    let rival = json!([{ "id": "slip:diameter-is-radius" }]);
    let adhesion = finding("adhesion-energy", &[]);
    assert_eq!(verdict(&slip, json!({ "findings": [adhesion], "rivals": rival })), Verdict::Right);
    assert_eq!(verdict(&slip, json!({ "findings": [adhesion], "rivals": [] })), Verdict::False);
}

#[test]
fn a_product_is_named_by_both_columns() {
    let expected = Expected::cause(&["v_n*layer_thickness", "level*"]);
    assert!(expected.is_planted("unknown:layer_thickness*v_n", &["layer_thickness", "v_n"]));
    assert!(!expected.is_planted("unknown:v_n", &["v_n"]));
    assert!(!expected.is_planted("powder-layer", &["layer_thickness", "v_n"]));
    assert!(expected.is_planted("level:e_n", &[]));
}

#[test]
fn a_gain_holds_within_its_interval() {
    let gain = |ratio| GainCheck { observable: "e_n".into(), ratio, stated: [0.5, 0.6] };
    assert_eq!([0.4, 0.55, 0.7].map(|ratio| gain(ratio).holds(false)), [false, true, false]);
    assert_eq!([0.4, 0.55, 0.7].map(|ratio| gain(ratio).holds(true)), [true, true, false]);
}
