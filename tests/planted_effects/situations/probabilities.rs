//! Whether stated probabilities are true as often as they say.

use serde_json::Value;

use super::expected::{Expected, variables};
use super::judge::{Judgement, list, text};
use crate::gates::require;

/// Least probability that the logarithmic score gives to the true explanation [1].
const FLOOR: f64 = 0.01;
/// Ends of the bands of stated probabilities [1].
const BANDS: [(f64, f64); 4] = [(0.0, 0.5), (0.5, 0.8), (0.8, 0.95), (0.95, 1.0)];

/// A stated probability, and whether what it is stated for is true.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stated {
    pub probability: f64,
    pub holds: bool,
}

/// All probabilities of one answer.
#[derive(Clone, Debug, Default)]
pub struct Probabilities {
    /// Of single causes: findings, their alternatives, numbers of the base and rivals.
    pub causes: Vec<Stated>,
    /// Of whole explanations.
    pub explanations: Vec<Stated>,
    /// Whether the answer states them; otherwise they are the shares of resamples.
    pub stated: bool,
}

impl Probabilities {
    /// Of an answer to a set with this truth; of none if there is no answer.
    pub fn of(expected: &Expected, diagnosis: Option<&Value>) -> Self {
        let Some(diagnosis) = diagnosis else { return Self::default() };
        let at_bound = expected.is_at_bound(diagnosis).then(|| expected.clone().without_bound());
        let expected = at_bound.as_ref().unwrap_or(expected);
        let explanations = explanations(diagnosis)
            .into_iter()
            .map(|(causes, probability)| Stated { probability, holds: expected.is_truth(&causes) });
        Self {
            causes: causes(expected, diagnosis),
            explanations: explanations.collect(),
            stated: diagnosis["explanations"].is_array(),
        }
    }

    /// Probability that is given to the truth.
    pub fn of_truth(&self) -> f64 {
        let true_ones = self.explanations.iter().filter(|one| one.holds);
        true_ones.fold(0.0, |sum, one| sum + one.probability)
    }

    /// Logarithmic score [nats].
    pub fn log_score(&self) -> f64 {
        self.of_truth().clamp(FLOOR, 1.0).recip().ln()
    }
}

/// Every cause once, with its largest probability; without what is neither right nor false.
fn causes(expected: &Expected, diagnosis: &Value) -> Vec<Stated> {
    let findings = || list(diagnosis, "findings");
    let alternatives = findings().flat_map(|one| list(one, "alternatives"));
    let of_cause = |one| (text(one, "cause"), variables(one), probability(one));
    let of_number = |one| (text(one, "key"), vec![], one["probability"].as_f64());
    let of_rival = |one| (text(one, "id"), vec![], one["probability"].as_f64());
    let alternatives = alternatives.chain(list(diagnosis, "alternatives"));
    let mut all: Vec<(&str, Vec<&str>, Option<f64>)> = findings().map(of_cause).collect();
    all.extend(alternatives.filter(|one| one["probability"].is_number()).map(of_cause));
    all.extend(list(diagnosis, "calibration").map(of_number));
    all.extend(list(diagnosis, "rivals").map(of_rival));
    all.sort_by(|a, b| a.0.cmp(b.0).then(b.2.unwrap_or(0.0).total_cmp(&a.2.unwrap_or(0.0))));
    all.dedup_by_key(|one| one.0);
    let holds = |name: &str, variables: &[&str]| match expected.rival {
        Some(rival) => rival.is(name),
        None => expected.is_planted(name, variables),
    };
    let judged = all.into_iter().filter(|(name, ..)| !expected.is_allowed(name));
    judged
        .filter_map(|(name, variables, probability)| {
            Some(Stated { probability: probability?, holds: holds(name, &variables) })
        })
        .collect()
}

/// The stated probability of a finding or alternative; without one, the share of resamples.
fn probability(one: &Value) -> Option<f64> {
    one["probability"].as_f64().or(one["certainty"].as_f64())
}

/// The explanations with their probabilities.
pub fn explanations(diagnosis: &Value) -> Vec<(Vec<&str>, f64)> {
    let causes = |one| list(one, "causes").filter_map(Value::as_str).collect();
    match diagnosis["explanations"].as_array() {
        Some(all) => all.iter().filter_map(|one| Some((causes(one), one["probability"].as_f64()?))).collect(),
        None => of_resamples(diagnosis),
    }
}

/// Of an answer that states none. All findings together have the least of their shares of resamples; what
/// is indistinguishable from the first and the rivals, in its place, have the rest. Without a finding,
/// undecided causes and rivals share 1 less the level of the tests, or nothing is there.
fn of_resamples(diagnosis: &Value) -> Vec<(Vec<&str>, f64)> {
    let confidence = 1.0 - diagnosis["level"].as_f64().unwrap_or(0.05);
    let findings: Vec<&Value> = list(diagnosis, "findings").collect();
    let numbers = list(diagnosis, "calibration").map(|one| text(one, "key"));
    let named: Vec<&str> = findings.iter().map(|one| text(one, "cause")).chain(numbers).collect();
    let rivals = list(diagnosis, "rivals").map(|one| text(one, "id"));
    let Some(first) = findings.first() else {
        let open: Vec<&str> = list(diagnosis, "undecided").filter_map(Value::as_str).collect();
        let open: Vec<&str> = open.into_iter().chain(rivals.filter(|_| named.is_empty())).collect();
        let share = confidence / open.len().max(1) as f64;
        return if open.is_empty() {
            vec![(named, confidence)]
        } else {
            open.into_iter().map(|one| (vec![one], share)).collect()
        };
    };
    let certain = findings.iter().filter_map(|one| one["certainty"].as_f64()).fold(1.0, f64::min);
    let others: Vec<&str> =
        list(first, "indistinguishable_from").filter_map(Value::as_str).chain(rivals).collect();
    let share = (1.0 - certain) / others.len().max(1) as f64;
    let instead = |other| std::iter::once(other).chain(named[1..].iter().copied()).collect();
    std::iter::once((named.clone(), certain))
        .chain(others.iter().map(|other| (instead(*other), share)))
        .collect()
}

/// Prints how often what is stated is true; the demands on stated probabilities.
pub fn report(all: &[Judgement]) -> Vec<Result<(), String>> {
    let of = |pick: fn(&Probabilities) -> &[Stated]| -> Vec<Stated> {
        all.iter().flat_map(|one| pick(&one.probabilities)).copied().collect()
    };
    let mut results = vec![];
    println!("\n| stated | what | number | mean stated | true |\n|---|---|---|---|---|");
    let kinds = [("causes", of(|one| &one.causes)), ("explanations", of(|one| &one.explanations))];
    for (what, stated) in &kinds {
        for band in BANDS {
            print_band(what, stated, band);
        }
    }
    let scores: Vec<f64> = all.iter().map(|one| one.probabilities.log_score()).collect();
    let mean = scores.iter().sum::<f64>() / scores.len().max(1) as f64;
    println!("\nlogarithmic score of explanations: {mean:.3} nats a set");
    if all.iter().any(|one| one.probabilities.stated) {
        kinds.iter().for_each(|(what, stated)| results.extend(demands(what, stated)));
    }
    results
}

/// Those within a band, its upper end excluded unless it is 1.
fn within(stated: &[Stated], (low, high): (f64, f64)) -> Vec<Stated> {
    let inside = |p: f64| p >= low && (p < high || high == 1.0);
    stated.iter().copied().filter(|one| inside(one.probability)).collect()
}

fn print_band(what: &str, stated: &[Stated], band: (f64, f64)) {
    let (inside, (low, high)) = (within(stated, band), (100.0 * band.0, 100.0 * band.1));
    let count = inside.len().max(1) as f64;
    let mean = inside.iter().fold(0.0, |sum, one| sum + one.probability) / count;
    let holds = inside.iter().filter(|one| one.holds).count() as f64 / count;
    println!("| {low:.0}-{high:.0} % | {what} | {} | {mean:.3} | {holds:.3} |", inside.len());
}

/// From one half on, as many are true as the band says: not fewer and not more.
fn demands(what: &str, stated: &[Stated]) -> Vec<Result<(), String>> {
    let one = |band: (f64, f64)| {
        let (inside, (low, high)) = (within(stated, band), band);
        let holds = inside.iter().filter(|one| one.holds).count();
        let words = format!("{what} with {:.0} to {:.0} % that are", 100.0 * low, 100.0 * high);
        [
            require(&format!("{words} true"), holds, inside.len(), low),
            require(&format!("{words} not"), inside.len() - holds, inside.len(), 1.0 - high),
        ]
    };
    BANDS[1..].iter().copied().flat_map(one).collect()
}
