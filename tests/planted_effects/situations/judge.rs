//! Judges an answer.

use serde_json::Value;

use super::expected::{Rival, is_curve, is_one_of, is_rival, variables};
use super::probabilities::{Probabilities, explanations};
use super::run::Answer;
use super::set::Set;
use crate::gates::Interval;

/// Probability from which a rival keeps a cause from being named, so is asked about [1].
const ASKED: f64 = 0.2;
/// Probability from which a rival is named as a cause is [1].
const NAMED: f64 = 0.8;
/// Probability of capture that is predicted where no impact was captured [1].
const INVENTED: f64 = 0.05;

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
    /// The truth in words.
    pub truth: String,
    pub probabilities: Probabilities,
    /// Whether the gain holds, if one is stated.
    pub gain: Option<bool>,
    /// Whether the extended model is worse than the base on the fresh rows, if a gain is stated.
    pub worse: Option<bool>,
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
        Ok(_) if invents(set, answer) => (Verdict::False, said(diagnosis)),
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
        null: set.expected.is_null(),
        cell: set.expected.cell.clone(),
        rows: set.rows.len(),
        verdict,
        power: set.oracle.power,
        sees: set.oracle.sees,
        said,
        truth: set.expected.words(),
        probabilities: Probabilities::of(&set.expected, answer.diagnosis.as_ref().ok()),
        gain,
        worse: answer.gain.as_ref().and_then(|gain| gain.as_ref().ok()).map(|gain| gain.ratio > 1.0),
        gain_note: answer.gain.as_ref().filter(|_| gain == Some(false)).map(note),
        intervals: intervals(set, diagnosis),
        seconds: answer.seconds,
    }
}

pub fn list<'a>(diagnosis: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> {
    diagnosis[key].as_array().into_iter().flatten()
}

pub fn text<'a>(value: &'a Value, key: &str) -> &'a str {
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

/// Whether the extended model captures particles where none was captured.
fn invents(set: &Set, answer: &Answer) -> bool {
    set.expected.no_captures && answer.captures.is_some_and(|share| share > INVENTED)
}

/// Slips and artefacts that are asked about.
fn rivals(diagnosis: &Value) -> impl Iterator<Item = &str> {
    let asked = |one: &&Value| one["probability"].as_f64().is_none_or(|probability| probability >= ASKED);
    list(diagnosis, "rivals").filter(asked).map(|one| text(one, "id"))
}

fn said(diagnosis: &Value) -> Vec<String> {
    let mut all: Vec<String> = list(diagnosis, "findings").map(|one| text(one, "cause").into()).collect();
    all.extend(calibrations(diagnosis));
    all.extend(list(diagnosis, "undecided").map(|one| format!("?{}", one.as_str().unwrap_or_default())));
    all.extend(rivals(diagnosis).map(|id| format!("!{id}")));
    all.extend(is_refuted(diagnosis).then(|| "refuted".into()));
    all
}

/// Slips and artefacts that are as good as named.
fn named_rivals(diagnosis: &Value) -> impl Iterator<Item = &str> {
    let named = |one: &&Value| one["probability"].as_f64().is_some_and(|probability| probability >= NAMED);
    list(diagnosis, "rivals").filter(named).map(|one| text(one, "id"))
}

/// What a finding lists beside itself.
fn beside(finding: &Value) -> impl Iterator<Item = &str> {
    list(finding, "indistinguishable_from").filter_map(Value::as_str)
}

fn verdict(set: &Set, diagnosis: &Value) -> Verdict {
    let expected = &set.expected;
    let findings: Vec<&Value> = list(diagnosis, "findings").collect();
    let undecided: Vec<&str> = list(diagnosis, "undecided").filter_map(Value::as_str).collect();
    let refuted = is_refuted(diagnosis) || !undecided.is_empty();
    let never = |name: &str| is_one_of(&expected.never, name, &[]);
    if findings.iter().any(|one| never(text(one, "cause"))) || rivals(diagnosis).any(never) {
        return Verdict::False;
    }
    if let Some(rival) = expected.rival {
        return of_rival(set, rival, diagnosis, refuted);
    }
    // A finding that lists a planted cause as indistinguishable is honest.
    let lists = |finding: &Value| beside(finding).any(|one| expected.is_planted(one, &[]));
    let is_right = |finding: &Value| expected.is_planted(text(finding, "cause"), &variables(finding));
    let is_false = |finding: &&Value| {
        !is_right(finding) && !expected.is_allowed(text(finding, "cause")) && !lists(finding)
    };
    let rival = named_rivals(diagnosis).any(|id| !expected.is_allowed(id));
    if rival || expected.is_at_bound(diagnosis) || findings.iter().any(is_false) {
        return Verdict::False;
    }
    if expected.planted.is_empty() {
        return match calibrations(diagnosis).iter().all(|one| expected.is_allowed(one)) {
            false => Verdict::False,
            true if undecided.is_empty() => Verdict::Right,
            true => Verdict::Honest,
        };
    }
    of_causes(set, diagnosis, &undecided, refuted)
}

/// All causes named is right, all named or left open is honest; a curve leaves open what has a name.
fn of_causes(set: &Set, diagnosis: &Value, undecided: &[&str], refuted: bool) -> Verdict {
    let findings: Vec<&Value> = list(diagnosis, "findings").collect();
    let calibrations = calibrations(diagnosis);
    let explanations = explanations(diagnosis);
    let means = |finding: &Value, cause: &[&str]| {
        set.expected.means(text(finding, "cause"), &variables(finding), cause)
    };
    let is_named = |cause: &Vec<&str>| {
        let law = |finding: &&&Value| is_curve(cause[0]) || !is_curve(text(finding, "cause"));
        findings.iter().filter(law).any(|finding| means(finding, cause))
            || calibrations.iter().any(|one| is_one_of(cause, one, &[]))
    };
    let left_open = |cause: &Vec<&str>| {
        let beside = findings.iter().flat_map(|finding| beside(finding)).chain(undecided.iter().copied());
        let possible = explanations.iter().flat_map(|(causes, _)| causes.iter().copied());
        findings.iter().any(|finding| means(finding, cause))
            || beside.chain(possible).any(|one| set.expected.means(one, &[], cause))
    };
    let planted = &set.expected.planted;
    if planted.iter().all(is_named) {
        return Verdict::Right;
    }
    if planted.iter().all(|cause| is_named(cause) || left_open(cause)) {
        return Verdict::Honest;
    }
    unless_seen(set, findings.is_empty() && set.expected.refuted_is_honest && refuted)
}

/// Nothing right is said: honest if it is `enough`, or if the oracle does not see the effect either.
fn unless_seen(set: &Set, enough: bool) -> Verdict {
    let seen = set.oracle.sees && set.oracle.power > 0.9;
    if enough || !seen { Verdict::Honest } else { Verdict::Missed }
}

/// A slip is right if it is suspected, the instrument if no cause is named beside it; false is a cause alone.
fn of_rival(set: &Set, rival: Rival, diagnosis: &Value, refuted: bool) -> Verdict {
    let findings = || list(diagnosis, "findings");
    let open = findings().flat_map(beside).chain(rivals(diagnosis));
    let suspected = open.chain(findings().map(|one| text(one, "cause"))).any(|id| rival.is(id));
    let number = rival == Rival::Instrument && !calibrations(diagnosis).is_empty();
    let named = number || findings().any(|one| !is_rival(text(one, "cause")));
    let possible = explanations(diagnosis).iter().any(|(causes, _)| causes.iter().any(|one| rival.is(one)));
    match (suspected, named) {
        (true, false) => Verdict::Right,
        (true, true) if rival == Rival::Slip => Verdict::Right,
        (true, true) => Verdict::Honest,
        (false, true) => Verdict::False,
        (false, false) if rival == Rival::Instrument => Verdict::Honest,
        (false, false) => unless_seen(set, refuted || possible),
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
