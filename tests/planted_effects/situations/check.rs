//! Tests of the situations: their model files, effects and oracle, and of the judging.

use serde_json::{Value, json};

use super::expected::{Expected, Rival};
use super::instrument::turned;
use super::judge::{Verdict, judge};
use super::lab::{Outcome, Outcomes, Row};
use super::oracle::Oracle;
use super::probabilities::{Probabilities, Stated};
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
    let (situation, index) = name.split_once(':').unwrap();
    let (_, _, plan) = super::situations().into_iter().find(|(name, ..)| name == situation).unwrap();
    Recipe::new(situation, index.parse().unwrap(), plan).make(seed)
}

/// The command predicts with the model file what the generator takes for the base.
#[test]
fn the_model_files_of_situations_are_their_bases() {
    let seed = random::seed();
    for recipe in first() {
        let set = recipe.with_fresh(seed, 100);
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
    judge(set, &Answer { diagnosis: Ok(diagnosis), gain: None, captures: None, seconds: 0.0 }).verdict
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
    let refused = Answer { diagnosis: Err("no".into()), gain: None, captures: None, seconds: 0.0 };
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

/// A turned frame keeps the speeds before and after an impact, and turning back restores the readings.
#[test]
fn a_tilt_is_a_rotation() {
    let x = Inputs { v_n: 3.0, v_t: 2.0, ..Inputs::default() };
    let e = [0.5, 0.8];
    let rebound = |x: &Inputs, e: [f64; 2]| f64::hypot(e[0] * x.v_n, e[1] * x.v_t);
    let ([v_n, v_t], seen) = turned(&x, e, 0.1).unwrap();
    let tilted = Inputs { v_n, v_t, ..x };
    close(v_n.hypot(v_t), 13_f64.sqrt(), 1e-12, 0.0);
    close(rebound(&tilted, seen), rebound(&x, e), 1e-12, 0.0);
    // By hand: 3 cos 0.1 - 2 sin 0.1 towards the wall, 1.5 cos 0.1 + 1.6 sin 0.1 back.
    close(v_n, 2.785_345_7, 1e-7, 0.0);
    close(seen[0] * v_n, 1.652_239_6, 1e-7, 0.0);
    let (speeds, back) = turned(&tilted, seen, -0.1).unwrap();
    speeds.iter().chain(&back).zip([3.0, 2.0, 0.5, 0.8]).for_each(|(ours, given)| {
        close(*ours, given, 1e-12, 0.0);
    });
    assert!(turned(&x, [0.05, 0.8], -0.2).is_none());
}

/// The rows of an instrument differ from those of an ideal one: in what the situation says.
#[test]
fn instruments_change_what_they_say() {
    let seed = random::seed();
    let rows = |name: &str| named(name, seed).rows;
    let angle = |x: &Inputs| x.v_t.atan2(x.v_n).to_degrees();
    for (name, degrees) in [("instrument-tilt:0", 5.0), ("instrument-tilt:1", -5.0)] {
        for row in rows(name) {
            close(angle(&row.seen) - angle(&row.x), degrees, 0.0, 1e-9);
        }
    }
    let mut constants = vec![];
    for row in rows("instrument-drag:0") {
        // Stokes: the lost speed goes with the inverse square of the size.
        let lost = row.seen.v_n - row.x.v_n;
        constants.push(lost * row.x.d.powi(2));
        close(angle(&row.seen), angle(&row.x), 0.0, 1e-9);
        assert!(row.truth.e_n < row.base.e_n);
    }
    constants.windows(2).for_each(|pair| close(pair[0], pair[1], 1e-6, 0.0));
    for name in ["instrument-drift:0", "instrument-drift:1"] {
        // The mean error of the second half over that of the first one, in the noise of a mean of 150 rows or more.
        let rows = rows(name);
        let off = |part: &[Row]| {
            let all: Vec<f64> = part
                .iter()
                .filter_map(|row| Some((row.measured[0]? - row.truth.e_n) / row.sigma[0]))
                .collect();
            all.iter().sum::<f64>() / all.len() as f64
        };
        let (first, second) = rows.split_at(rows.len() / 2);
        assert!((off(second) - off(first)).abs() > 0.35, "{name}: {} and {}", off(first), off(second));
    }
    let sorted = rows("sorted-by-speed:0");
    assert!(sorted.windows(2).all(|pair| pair[0].seen.v_n <= pair[1].seen.v_n));
    let stuck = rows("instrument-noted-as-stuck:0");
    let share = stuck.iter().filter(|row| row.outcome == Outcome::Stuck).count() as f64 / stuck.len() as f64;
    assert!((0.02..0.4).contains(&share), "{share}");
    let blank = |rows: &[Row]| rows.iter().filter(|row| row.seen.t_p.is_nan()).count();
    let merged = named("null-blank:1", seed);
    assert_eq!((merged.rows.len(), blank(&merged.rows), blank(&merged.fresh)), (200, 195, 0));
    let cells = merged.data.lines().nth(2).unwrap().split(',').nth(3).unwrap();
    assert_eq!(cells, "");
}

/// Readings of a swept temperature follow each other, and the temperature follows the order.
#[test]
fn a_drift_is_seen_in_the_order_of_the_file() {
    let mut correlations = vec![];
    for index in 0..20 {
        let rows = named(&format!("null-swept:{}", 2 * index), random::seed()).rows;
        assert!(rows.windows(2).all(|pair| pair[0].seen.t_p < pair[1].seen.t_p));
        let residual = |row: &Row| row.measured[0].map(|e_n| e_n - row.truth.e_n);
        let off: Vec<f64> = rows.iter().filter_map(residual).collect();
        let square = off.iter().map(|r| r * r).sum::<f64>();
        correlations.push(off.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / square);
    }
    close(correlations.iter().sum::<f64>() / 20.0, 0.5, 0.0, 0.12);
}

#[test]
fn verdicts_on_instruments() {
    let finding = |cause: &str| json!({ "cause": cause, "variables": [], "indistinguishable_from": [] });
    let set = named("instrument-tilt:0", 1);
    let rival = |probability| json!([{ "id": "artefact:tilt", "probability": probability }]);
    let said =
        |findings: Value, rivals: Value| verdict(&set, json!({ "findings": findings, "rivals": rivals }));
    assert_eq!(said(json!([]), rival(0.9)), Verdict::Right);
    assert_eq!(said(json!([]), json!([])), Verdict::Honest);
    assert_eq!(said(json!([finding("instrument:tilt")]), json!([])), Verdict::Right);
    assert_eq!(said(json!([finding("oblique-angle")]), rival(0.5)), Verdict::Honest);
    assert_eq!(said(json!([finding("oblique-angle")]), rival(0.1)), Verdict::False);
    let number = json!({ "findings": [], "calibration": [{ "key": "tangential.e_t" }] });
    assert_eq!(verdict(&set, number), Verdict::False);
    let digit = named("slip-harmless:1", 1);
    let law = finding("powder-layer");
    let asked = json!([{ "id": "slip:walls.brick.youngs_modulus" }]);
    assert_eq!(verdict(&digit, json!({ "findings": [law], "rivals": [] })), Verdict::Right);
    assert_eq!(verdict(&digit, json!({ "findings": [law], "rivals": asked })), Verdict::False);
    assert_eq!(verdict(&digit, json!({ "findings": [finding("unknown:layer_thickness")] })), Verdict::Honest);
}

/// A slip that nobody made is no better than a cause that does not act.
#[test]
fn a_named_slip_is_a_cause() {
    let null = named("null-clean:0", 1);
    let named = |probability: f64| {
        let rivals = json!([{ "id": "slip:diameter-is-radius", "probability": probability }]);
        verdict(&null, json!({ "findings": [], "rivals": rivals }))
    };
    assert_eq!([0.1, 0.9].map(named), [Verdict::Right, Verdict::False]);
}

/// Captures that nothing shows, and a law at the end of its range.
#[test]
fn verdicts_on_laws() {
    let finding = |cause: &str| json!({ "cause": cause, "variables": [], "indistinguishable_from": [] });
    let rebounds = named("rebounds-only:0", 1);
    let melting = json!({ "cause": "melting-transition", "indistinguishable_from": ["thermal-softening"] });
    assert_eq!(verdict(&rebounds, json!({ "findings": [melting] })), Verdict::False);
    let diagnosis = || Ok(json!({ "findings": [finding("unknown:T_p")] }));
    let by_captures = |captures| {
        let answer = Answer { diagnosis: diagnosis(), gain: None, captures: Some(captures), seconds: 0.0 };
        judge(&rebounds, &answer).verdict
    };
    assert_eq!([0.0, 0.3].map(by_captures), [Verdict::Right, Verdict::False]);
    let bed = named("law-granular-bed:0", 1);
    let oblique = |strength: f64| {
        let finding =
            json!({ "cause": "oblique-angle", "parameters": { "strength": { "value": strength } } });
        verdict(&bed, json!({ "findings": [finding] }))
    };
    assert_eq!([-1.0, -1.49998].map(oblique), [Verdict::Right, Verdict::False]);
    let of_bound = json!({ "findings": [{ "cause": "oblique-angle", "certainty": 0.9,
        "parameters": { "strength": { "value": -1.5 } } }] });
    assert_eq!(Probabilities::of(&bed.expected, Some(&of_bound)).of_truth(), 0.0);
}

#[test]
fn the_truth_is_all_that_is_planted() {
    let two = Expected {
        planted: vec![vec!["powder-layer", "unknown:layer_thickness"], vec!["unknown:d"]],
        ..Expected::default().allowing(&["level*"])
    };
    let truth = |causes: &[&str]| two.is_truth(causes);
    assert!(truth(&["powder-layer", "unknown:d"]) && truth(&["unknown:d", "powder-layer", "level:e_n"]));
    assert!(truth(&["unknown:d*layer_thickness"]) && truth(&["unknown:layer_thickness", "unknown:d"]));
    assert!(!truth(&["powder-layer"]) && !truth(&[]) && !truth(&["powder-layer", "unknown:d", "gas-lift"]));
    assert!(!truth(&["unknown:d*v_n", "powder-layer"]));
    assert!(Expected::nothing().is_truth(&[]) && !Expected::nothing().is_truth(&["unknown:d"]));
    assert!(
        Expected::instrument().is_truth(&["artefact:drag"]) && !Expected::slip().is_truth(&["artefact:drag"])
    );
    assert!(!Expected::instrument().is_truth(&[]) && Rival::Slip.is("slip:diameter-is-radius"));
    let number = Expected::cause(&["calibration:tangential.e_t"]);
    assert!(number.is_truth(&["tangential.e_t"]) && number.is_truth(&["calibration:tangential.e_t"]));
}

/// Findings, alternatives, rivals and explanations with and without stated probabilities.
#[test]
fn probabilities_are_read() {
    let expected = Expected::cause(&["powder-layer"]);
    let stated = |probability, holds| Stated { probability, holds };
    let new = json!({
        "findings": [{ "cause": "powder-layer", "probability": 0.9, "certainty": 1.0, "alternatives": [
            { "cause": "gas-lift", "probability": 0.08 },
            { "cause": "powder-layer", "probability": 0.1 } ] }],
        "rivals": [{ "id": "slip:diameter-is-radius", "probability": 0.02 }],
        "explanations": [
            { "causes": ["powder-layer"], "probability": 0.88 },
            { "causes": [], "probability": 0.07 } ],
    });
    let read = Probabilities::of(&expected, Some(&new));
    assert!(read.stated);
    assert_eq!(read.causes, [stated(0.08, false), stated(0.9, true), stated(0.02, false)]);
    assert_eq!(read.explanations, [stated(0.88, true), stated(0.07, false)]);
    close(read.log_score(), 0.127_833, 1e-5, 0.0);
    let old = json!({ "level": 0.05, "findings": [{ "cause": "gas-lift", "certainty": 0.7,
        "indistinguishable_from": ["powder-layer", "liquid-film"] }] });
    let read = Probabilities::of(&expected, Some(&old));
    assert!(!read.stated && read.causes == [stated(0.7, false)]);
    close(read.of_truth(), 0.15, 1e-9, 0.0);
    let none = Probabilities::of(&expected, Some(&json!({ "level": 0.05, "findings": [] })));
    assert_eq!(none.explanations, [stated(0.95, false)]);
    close(none.log_score(), 4.605_170, 1e-6, 0.0);
}
