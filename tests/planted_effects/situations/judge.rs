//! Judges an answer.

use serde_json::Value;

use super::expected::{is_one_of, variables};
use super::run::Answer;
use super::set::Set;
use crate::gates::Interval;

/// The verdict on a set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// All that is planted is named, and nothing else.
    Right,
    /// The planted cause is left open, or could not be seen.
    Honest,
    /// Nothing is said, although the oracle sees it.
    Missed,
    /// A cause is named that is not there.
    False,
    /// There is no diagnosis.
    Refused,
}

/// All that is judged on one set.
pub struct Judgement {
    pub name: String,
    pub situation: String,
    pub null: bool,
    pub cell: Option<String>,
    pub rows: usize,
    pub verdict: Verdict,
    pub power: f64,
    pub sees: bool,
    /// What was said: findings, `?` undecided causes, `!` rivals, and the base if it is refuted.
    pub said: Vec<String>,
    /// Whether the gain holds, if one is stated.
    pub gain: Option<bool>,
    /// The gain that does not hold.
    pub gain_note: Option<String>,
    pub intervals: Vec<Interval>,
    pub seconds: f64,
}

/// Judges an answer.
pub fn judge(set: &Set, answer: &Answer) -> Judgement {
    let empty = Value::Null;
    let diagnosis = answer.diagnosis.as_ref().unwrap_or(&empty);
    let (verdict, said) = match &answer.diagnosis {
        Ok(diagnosis) => (verdict(set, diagnosis), said(diagnosis)),
        Err(message) => (Verdict::Refused, vec![message.clone()]),
    };
    let larger = set.expected.gain_may_be_larger;
    let gain = answer.gain.as_ref().map(|gain| gain.as_ref().is_ok_and(|gain| gain.holds(larger)));
    let note = |gain: &Result<_, String>| match gain {
        Err(message) => message.clone(),
        Ok(super::run::GainCheck { observable, ratio, stated: [low, high] }) => {
            format!("{observable}: {ratio:.3} on fresh rows, stated {low:.3} to {high:.3}")
        }
    };
    Judgement {
        name: set.name.clone(),
        situation: set.situation().into(),
        null: set.expected.planted.is_empty() && !set.expected.slip,
        cell: set.expected.cell.clone(),
        rows: set.rows.len(),
        verdict,
        power: set.oracle.power,
        sees: set.oracle.sees,
        said,
        gain,
        gain_note: answer.gain.as_ref().filter(|_| gain == Some(false)).map(note),
        intervals: intervals(set, diagnosis),
        seconds: answer.seconds,
    }
}

fn list<'a>(diagnosis: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> {
    diagnosis[key].as_array().into_iter().flatten()
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

/// The numbers of the base that are said to differ.
fn calibrations(diagnosis: &Value) -> Vec<String> {
    list(diagnosis, "calibration").map(|one| format!("calibration:{}", text(one, "key"))).collect()
}

/// Whether the record says that the base does not fit.
fn is_refuted(diagnosis: &Value) -> bool {
    diagnosis["fit"]["base"]["p_value"].as_f64().is_some_and(|p| p < 0.01)
}

fn said(diagnosis: &Value) -> Vec<String> {
    let mut all: Vec<String> = list(diagnosis, "findings").map(|one| text(one, "cause").into()).collect();
    all.extend(calibrations(diagnosis));
    all.extend(list(diagnosis, "undecided").map(|one| format!("?{}", one.as_str().unwrap_or_default())));
    all.extend(list(diagnosis, "rivals").map(|one| format!("!{}", text(one, "id"))));
    all.extend(is_refuted(diagnosis).then(|| "refuted".into()));
    all
}

fn verdict(set: &Set, diagnosis: &Value) -> Verdict {
    let expected = &set.expected;
    let findings: Vec<&Value> = list(diagnosis, "findings").collect();
    let undecided: Vec<&str> = list(diagnosis, "undecided").filter_map(Value::as_str).collect();
    if expected.slip {
        return slip(set, diagnosis, &findings, &undecided);
    }
    // A finding that lists a planted cause as indistinguishable is honest.
    let lists = |finding: &Value| {
        list(finding, "indistinguishable_from")
            .filter_map(Value::as_str)
            .any(|one| expected.is_planted(one, &[]))
    };
    let is_right = |finding: &Value| expected.is_planted(text(finding, "cause"), &variables(finding));
    let is_false = |finding: &&Value| {
        !is_right(finding) && !expected.is_allowed(text(finding, "cause")) && !lists(finding)
    };
    if findings.iter().any(is_false) {
        return Verdict::False;
    }
    if expected.planted.is_empty() {
        return if undecided.is_empty() { Verdict::Right } else { Verdict::Honest };
    }
    let calibrations = calibrations(diagnosis);
    let is_named = |cause: &Vec<&str>| {
        findings.iter().any(|finding| is_one_of(cause, text(finding, "cause"), &variables(finding)))
            || calibrations.iter().any(|one| is_one_of(cause, one, &[]))
    };
    let left_open = |cause: &Vec<&str>| {
        undecided.iter().any(|one| is_one_of(cause, one, &[]))
            || findings.iter().any(|finding| {
                list(finding, "indistinguishable_from")
                    .filter_map(Value::as_str)
                    .any(|one| is_one_of(cause, one, &[]))
            })
    };
    if expected.planted.iter().all(is_named) {
        return Verdict::Right;
    }
    if expected.planted.iter().all(|cause| is_named(cause) || left_open(cause)) {
        return Verdict::Honest;
    }
    let enough = expected.refuted_is_honest && (is_refuted(diagnosis) || !undecided.is_empty());
    unless_seen(set, findings.is_empty() && enough)
}

/// Nothing right is said: honest if it is `enough`, or if the oracle does not see the effect either.
fn unless_seen(set: &Set, enough: bool) -> Verdict {
    let seen = set.oracle.sees && set.oracle.power > 0.9;
    if enough || !seen { Verdict::Honest } else { Verdict::Missed }
}

/// A slip is right if it is suspected, and false if a cause stands alone in its place.
fn slip(set: &Set, diagnosis: &Value, findings: &[&Value], undecided: &[&str]) -> Verdict {
    let suspected = list(diagnosis, "rivals").any(|rival| text(rival, "id").starts_with("slip:"));
    match (suspected, findings.is_empty()) {
        (true, _) => Verdict::Right,
        (false, false) => Verdict::False,
        (false, true) => unless_seen(set, is_refuted(diagnosis) || !undecided.is_empty()),
    }
}

/// Stated intervals of planted parameters.
fn intervals(set: &Set, diagnosis: &Value) -> Vec<Interval> {
    let one = |(cause, name, truth): &(&str, &str, f64)| {
        let stated = match cause.strip_prefix("calibration:") {
            Some(key) => list(diagnosis, "calibration").find(|one| text(one, "key") == key)?,
            None => {
                let finding = list(diagnosis, "findings").find(|one| text(one, "cause") == *cause)?;
                &finding["parameters"][*name]
            }
        };
        let (low, high) = (stated["low"].as_f64()?, stated["high"].as_f64()?);
        Some(Interval { parameter: format!("{cause}.{name}"), truth: *truth, low, high })
    };
    set.expected.parameters.iter().filter_map(one).collect()
}
