//! Judges the answers, and prints the table of all.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::expected::{is_one_of, variables};
use crate::gates::{Interval, require};
use crate::run::Answer;
use crate::sets::Set;

/// The verdict on one diagnosis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The planted cause is first; or silence on a null.
    Right,
    /// The planted cause is among those that are left open.
    CannotTell,
    /// Something else is first.
    Wrong,
    /// Nothing is said.
    Missed,
    /// There is no diagnosis.
    Failed,
}

/// All that is judged on one set.
pub struct Judgement {
    pub name: String,
    pub family: String,
    pub null: bool,
    pub own: bool,
    pub verdict: Verdict,
    pub notices: bool,
    pub deviations: [f64; 2],
    pub said: Vec<String>,
    /// Root mean square of fresh readings over that of the truth: after, and what a fit of the true law reaches.
    pub gain: Option<[f64; 2]>,
    pub intervals: Vec<Interval>,
    /// For each fresh reading, whether the band holds it.
    pub bands: Vec<bool>,
    pub seconds: f64,
}

fn list<'a>(diagnosis: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> {
    diagnosis[key].as_array().into_iter().flatten()
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

/// Judges one answer.
pub fn judge(set: &Set, answer: &Answer) -> Judgement {
    let empty = Value::Null;
    let diagnosis = answer.diagnosis.as_ref().unwrap_or(&empty);
    let (verdict, said) = match &answer.diagnosis {
        Ok(diagnosis) => (verdict(set, diagnosis), said(diagnosis)),
        Err(message) => (Verdict::Failed, vec![message.trim().into()]),
    };
    Judgement {
        name: set.name.clone(),
        family: set.family().into(),
        null: set.is_null(),
        own: set.plan.own,
        verdict,
        notices: set.oracle.notices,
        deviations: [set.oracle.seen, set.oracle.expected],
        said,
        gain: answer.predicted.as_ref().map(|predicted| gain(set, predicted, &answer.truth)),
        intervals: intervals(set, diagnosis),
        bands: bands(answer),
        seconds: answer.seconds,
    }
}

/// Findings, numbers of the base, and what is left open (`?`).
pub fn said(diagnosis: &Value) -> Vec<String> {
    let mut all: Vec<String> = list(diagnosis, "findings").map(|one| text(one, "cause").into()).collect();
    all.extend(list(diagnosis, "calibration").map(|one| format!("calibration:{}", text(one, "key"))));
    all.extend(list(diagnosis, "undecided").map(|one| format!("?{}", one.as_str().unwrap_or_default())));
    all.extend(list(diagnosis, "rivals").map(|one| format!("!{}", text(one, "id"))));
    let p = &diagnosis["fit"]["base"]["p_value"];
    all.push(format!("p {:.1e}", p.as_f64().unwrap_or(f64::NAN)));
    all
}

/// Whether one of these names is the first finding, or a number of the base where there is none.
pub fn is_first(names: &[&str], diagnosis: &Value) -> bool {
    let mut numbers = list(diagnosis, "calibration").map(|one| format!("calibration:{}", text(one, "key")));
    match diagnosis["findings"].get(0) {
        Some(first) => is_one_of(names, text(first, "cause"), &variables(first)),
        None => numbers.any(|name| is_one_of(names, &name, &[])),
    }
}

/// Whether the misfit is said to lie in a number of the case as far as its instrument may be off, and
/// the planted cause is among the explanations all the same.
pub fn lies_with_the_case(set: &Set, diagnosis: &Value) -> bool {
    let blamed = list(diagnosis, "blame").any(|one| text(one, "party").starts_with("case:"));
    let mut listed = list(diagnosis, "explanations").flat_map(|one| list(one, "causes"));
    let is_planted = |name: &Value| name.as_str().is_some_and(|name| is_one_of(&set.plan.names, name, &[]));
    blamed && listed.any(is_planted)
}

fn verdict(set: &Set, diagnosis: &Value) -> Verdict {
    let names = &set.plan.names;
    let first = diagnosis["findings"].get(0);
    let mut numbers = list(diagnosis, "calibration").map(|one| format!("calibration:{}", text(one, "key")));
    if set.is_null() {
        return if first.is_none() && numbers.next().is_none() { Verdict::Right } else { Verdict::Wrong };
    }
    let beside = first.map(|first| list(first, "indistinguishable_from")).into_iter().flatten();
    let mut open = beside.chain(list(diagnosis, "undecided")).filter_map(Value::as_str);
    if is_first(names, diagnosis) {
        Verdict::Right
    } else if open.any(|name| is_one_of(names, name, &[])) {
        Verdict::CannotTell
    } else if first.is_some() || list(diagnosis, "calibration").next().is_some() {
        Verdict::Wrong
    } else {
        Verdict::Missed
    }
}

/// Stated intervals of planted parameters of the library's own laws.
fn intervals(set: &Set, diagnosis: &Value) -> Vec<Interval> {
    if !set.plan.own {
        return vec![];
    }
    let one = |(cause, name, truth): &(&str, &str, f64)| {
        let stated = match cause.strip_prefix("calibration:") {
            Some(key) => list(diagnosis, "calibration").find(|one| text(one, "key") == key)?,
            None => {
                &list(diagnosis, "findings").find(|one| text(one, "cause") == *cause)?["parameters"][*name]
            }
        };
        let (low, high) = (stated["low"].as_f64()?, stated["high"].as_f64()?);
        Some(Interval { parameter: format!("{cause}.{name}"), truth: *truth, low, high })
    };
    set.plan.parameters.iter().filter_map(one).collect()
}

/// Root mean square error of fresh measurements over that of the truth, and what a fit of the true law reaches.
fn gain(set: &Set, predicted: &[Vec<f64>], truth: &[Vec<f64>]) -> [f64; 2] {
    let (mut sum, mut count) = (0.0, 0.0);
    for (experiment, (predicted, truth)) in set.fresh.iter().zip(predicted.iter().zip(truth)) {
        let pairs = predicted.iter().zip(truth);
        for (index, (reading, (predicted, truth))) in experiment.readings.iter().zip(pairs).enumerate() {
            let variance = if set.lab().readings[index].0.is_share() {
                // Between both: where the truth is almost 0 its own error says nothing.
                let middle = (predicted + truth) / 2.0;
                (middle * (1.0 - middle)).max(0.25 / reading.particles) / reading.particles
            } else {
                reading.sigma.powi(2)
            };
            sum += (predicted - truth).powi(2) / variance;
            count += 1.0;
        }
    }
    let readings: usize = set.experiments.iter().map(|one| one.readings.len()).sum();
    let parameters = set.plan.parameters.len().max(2) as f64;
    [f64::sqrt(1.0 + sum / count), f64::sqrt(1.0 + parameters / readings as f64)]
}

/// Whether the range of the drawn models holds the truth of each fresh reading.
fn bands(answer: &Answer) -> Vec<bool> {
    if answer.bands.is_empty() {
        return vec![];
    }
    let mut all = vec![];
    for (experiment, truth) in answer.truth.iter().enumerate() {
        for (reading, truth) in truth.iter().enumerate() {
            let drawn = answer.bands.iter().map(|model| model[experiment][reading]);
            let (low, high) = drawn.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
            let holds = (low - 1e-6..=high + 1e-6).contains(truth);
            // Where the effect does nothing there is no band.
            if high - low > 1e-6 || !holds {
                all.push(holds);
            }
        }
    }
    all
}

impl Judgement {
    /// Within 20 % of what a fit of the true law reaches.
    fn reaches(&self) -> Option<bool> {
        self.gain.map(|[reached, attainable]| reached <= 1.2 * attainable)
    }
}

/// Prints every table; the list of what failed.
pub fn report(all: &[Judgement]) -> Vec<String> {
    print_table(all);
    print_sets(all);
    print_intervals(all);
    let spent: f64 = all.iter().map(|one| one.seconds).sum();
    let slowest = all.iter().map(|one| one.seconds).fold(0.0, f64::max);
    println!("\n{} diagnoses, {spent:.0} s in all, the slowest {slowest:.1} s\n", all.len());
    failures(all)
}

/// Prints the table of rigs with a right base, and what fails: a larger share that names a cause than
/// `most`, and a diagnosis that takes longer than `longest` [s].
pub fn silence(all: &[Judgement], most: f64, longest: f64) -> Vec<String> {
    let mut families: BTreeMap<&str, Vec<&Judgement>> = BTreeMap::new();
    all.iter().for_each(|one| families.entry(&one.family).or_default().push(one));
    println!(
        "\n| runs | sets | name a cause | failed | median time [s] | longest [s] |\n|---|---|---|---|---|---|"
    );
    for (name, sets) in &families {
        let count = |verdict| sets.iter().filter(|one| one.verdict == verdict).count();
        let mut seconds: Vec<f64> = sets.iter().map(|one| one.seconds).collect();
        seconds.sort_by(f64::total_cmp);
        let (wrong, failed) = (count(Verdict::Wrong), count(Verdict::Failed));
        let [middle, last] = [seconds[seconds.len() / 2], seconds[seconds.len() - 1]];
        println!("| {name} | {} | {wrong} | {failed} | {middle:.1} | {last:.1} |", sets.len());
    }
    let named = all.iter().filter(|one| one.verdict != Verdict::Right).count();
    let mut failures: Vec<String> =
        require("silent", all.len() - named, all.len(), 1.0 - most).err().into_iter().collect();
    let slow = all.iter().filter(|one| one.seconds > longest);
    failures.extend(slow.map(|one| format!("{} took {:.1} s", one.name, one.seconds)));
    failures
}

fn print_table(all: &[Judgement]) {
    println!(
        "\n| cause | sets | oracle notices | right | cannot tell | wrong | missed | failed | gain | bands |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let mut families: BTreeMap<&str, Vec<&Judgement>> = BTreeMap::new();
    for one in all {
        families.entry(&one.family).or_default().push(one);
    }
    for (family, sets) in families {
        line(family, &sets);
    }
    line("all planted", &all.iter().filter(|one| !one.null).collect::<Vec<_>>());
    line("that the oracle notices", &all.iter().filter(|one| !one.null && one.notices).collect::<Vec<_>>());
}

fn line(name: &str, sets: &[&Judgement]) {
    let kinds = [Verdict::Right, Verdict::CannotTell, Verdict::Wrong, Verdict::Missed, Verdict::Failed];
    let counts = kinds.map(|kind| sets.iter().filter(|one| one.verdict == kind).count().to_string());
    let notices = sets.iter().filter(|one| one.notices).count();
    let share = |hits: &[bool]| format!("{}/{}", hits.iter().filter(|hit| **hit).count(), hits.len());
    let gains: Vec<bool> = sets.iter().filter_map(|one| one.reaches()).collect();
    let bands: Vec<bool> = sets.iter().flat_map(|one| one.bands.clone()).collect();
    let (counts, gains, bands) = (counts.join(" | "), share(&gains), share(&bands));
    println!("| {name} | {} | {notices} | {counts} | {gains} | {bands} |", sets.len());
}

/// Every set that is not right, or whose gain or bands fail.
fn print_sets(all: &[Judgement]) {
    println!();
    for one in all {
        let held = one.bands.iter().filter(|held| **held).count();
        let poor = one.reaches() == Some(false) || held * 10 < one.bands.len() * 8;
        if one.verdict != Verdict::Right || poor {
            let [seen, expected] = one.deviations;
            let notices = if one.notices { "noticed" } else { "unnoticed" };
            let gain = one.gain.map_or(String::new(), |[reached, attainable]| {
                format!(", rms {reached:.2} of {attainable:.2}")
            });
            let (name, verdict, said) = (&one.name, one.verdict, one.said.join(", "));
            println!(
                "  {verdict:?} {name} ({notices} by {seen:.1} of {expected:.1}{gain}, bands {held}/{}): {said}",
                one.bands.len()
            );
        }
    }
}

fn print_intervals(all: &[Judgement]) {
    println!("\n| parameter | intervals | hold |\n|---|---|---|");
    let mut parameters: BTreeMap<&str, Vec<bool>> = BTreeMap::new();
    for interval in all.iter().flat_map(|one| &one.intervals) {
        parameters.entry(&interval.parameter).or_default().push(interval.holds());
    }
    for (parameter, held) in parameters {
        println!("| {parameter} | {} | {} |", held.len(), held.iter().filter(|held| **held).count());
    }
    for one in all {
        for miss in one.intervals.iter().filter(|interval| !interval.holds()) {
            let Interval { parameter, truth, low, high } = miss;
            println!("  {} {parameter} is {truth:.4e}, stated {low:.4e} to {high:.4e}", one.name);
        }
    }
}

/// The demands that are not met.
fn failures(all: &[Judgement]) -> Vec<String> {
    let planted = || all.iter().filter(|one| !one.null);
    let noticed: Vec<_> = planted().filter(|one| one.notices && one.verdict != Verdict::CannotTell).collect();
    let right = noticed.iter().filter(|one| one.verdict == Verdict::Right).count();
    let nulls: Vec<_> = all.iter().filter(|one| one.null).collect();
    let silent = nulls.iter().filter(|one| one.verdict == Verdict::Right).count();
    let found = || planted().filter(|one| one.notices && one.verdict == Verdict::Right);
    let gains: Vec<bool> = found().filter_map(Judgement::reaches).collect();
    let intervals: Vec<bool> = found().flat_map(|one| &one.intervals).map(Interval::holds).collect();
    let bands: Vec<bool> = found().filter(|one| one.own).flat_map(|one| one.bands.clone()).collect();
    let hits = |list: &[bool]| list.iter().filter(|hit| **hit).count();
    let mut failures: Vec<String> = [
        require("right first, of those noticed that it claims to tell", right, noticed.len(), 0.9),
        require("silent on nulls", silent, nulls.len(), 0.95),
        require("fresh error within 20 % of attainable, of those right", hits(&gains), gains.len(), 0.9),
        require("parameter within its interval", hits(&intervals), intervals.len(), 0.9),
        require("truth within the band of 39 draws, own laws", hits(&bands), bands.len(), 0.9),
    ]
    .into_iter()
    .filter_map(Result::err)
    .collect();
    if bands.len() >= 300 && hits(&bands) * 100 > 99 * bands.len() {
        failures.push(format!("bands are too wide: {} of {} hold", hits(&bands), bands.len()));
    }
    let failed = all.iter().filter(|one| one.verdict == Verdict::Failed);
    failures.extend(failed.map(|one| format!("{}: {}", one.name, one.said.join(" "))));
    failures
}
