//! The tables, and what is demanded of them.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::sync::Mutex;

use super::judge::{Judgement, Verdict};
use super::probabilities;
use crate::gates::require;

/// Longest diagnosis [s], with two at once on two cores.
const SLOWEST: f64 = 60.0;

/// The file that `NEARWALL_PLANTED_TABLE` names, one line a set, each written as soon as its set is judged.
pub struct Lines(Option<Mutex<File>>);

impl Lines {
    pub fn new() -> Self {
        let file = std::env::var_os("NEARWALL_PLANTED_TABLE").map(|path| File::create(path).unwrap());
        let lines = Self(file.map(Mutex::new));
        lines.write("situation,set,verdict,named,truth,probability_of_truth,seconds");
        lines
    }

    pub fn add(&self, one: &Judgement) {
        let Judgement { situation, name, verdict, truth, seconds, probabilities, .. } = one;
        let named = one.said.join(";").replace([',', '\n', '"'], " ");
        let of_truth = probabilities.of_truth();
        self.write(&format!("{situation},{name},{verdict:?},{named},{truth},{of_truth:.4},{seconds:.2}"));
    }

    fn write(&self, line: &str) {
        self.0.iter().for_each(|file| writeln!(file.lock().unwrap(), "{line}").unwrap());
    }
}

/// Prints every table; the list of what failed.
pub fn report(all: &[Judgement]) -> Vec<String> {
    print_situations(all);
    print_cells(all);
    print_parameters(all);
    print_nulls(all);
    print_sets(all);
    let calibrated = probabilities::report(all);
    let spent: f64 = all.iter().map(|one| one.seconds).sum();
    println!("\n{} diagnoses, {spent:.0} s in all", all.len());
    let failed = calibrated.into_iter().filter_map(Result::err);
    failures(all).into_iter().chain(failed).collect()
}

fn count(sets: &[&Judgement], verdict: Verdict) -> usize {
    sets.iter().filter(|one| one.verdict == verdict).count()
}

/// Groups by a name, in the order of the alphabet.
fn by<'a>(
    all: &'a [Judgement],
    name: impl Fn(&'a Judgement) -> Option<&'a str>,
) -> BTreeMap<&'a str, Vec<&'a Judgement>> {
    let mut groups: BTreeMap<&str, Vec<&Judgement>> = BTreeMap::new();
    for one in all {
        if let Some(name) = name(one) {
            groups.entry(name).or_default().push(one);
        }
    }
    groups
}

fn share(hits: usize, of: usize) -> String {
    format!("{hits}/{of}")
}

fn print_situations(all: &[Judgement]) {
    println!(
        "\n| situation | sets | right | honest | missed | wrong | refused | oracle | gain | interval \
         | log score | mean s | longest s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (situation, sets) in by(all, |one| Some(&one.situation)) {
        line(situation, &sets);
    }
    line("all", &all.iter().collect::<Vec<_>>());
}

/// Whether each stated interval of a parameter holds.
fn held_intervals<'a>(sets: impl IntoIterator<Item = &'a Judgement>) -> Vec<bool> {
    sets.into_iter().flat_map(|one| one.intervals.iter().map(|interval| interval.holds())).collect()
}

fn line(situation: &str, sets: &[&Judgement]) {
    let gains: Vec<bool> = sets.iter().filter_map(|one| one.gain).collect();
    let intervals = held_intervals(sets.iter().copied());
    let hits = |list: &[bool]| share(list.iter().filter(|hit| **hit).count(), list.len());
    let counts = [Verdict::Right, Verdict::Honest, Verdict::Missed, Verdict::False, Verdict::Refused]
        .map(|verdict| count(sets, verdict).to_string())
        .join(" | ");
    let oracle = if sets.iter().all(|one| one.null) {
        "-".into()
    } else {
        let power: Vec<f64> = sets.iter().filter(|one| !one.null).map(|one| one.power).collect();
        format!("{:.2}", power.iter().sum::<f64>() / power.len() as f64)
    };
    let longest = sets.iter().map(|one| one.seconds).fold(0.0, f64::max);
    let mean = |value: fn(&Judgement) -> f64| {
        sets.iter().map(|one| value(one)).sum::<f64>() / sets.len().max(1) as f64
    };
    println!(
        "| {situation} | {} | {counts} | {oracle} | {} | {} | {:.2} | {:.1} | {longest:.1} |",
        sets.len(),
        hits(&gains),
        hits(&intervals),
        mean(|one| one.probabilities.log_score()),
        mean(|one| one.seconds)
    );
}

/// Weak effects: named, named or left open, and seen by the oracle.
fn print_cells(all: &[Judgement]) {
    println!(
        "\n| effect, deviations of the noise, rows | sets | named | named or open | oracle | expected |"
    );
    println!("|---|---|---|---|---|---|");
    for (cell, sets) in by(all, |one| one.cell.as_deref()) {
        let named = count(&sets, Verdict::Right);
        let open = sets.iter().filter(|one| one.verdict == Verdict::Honest && !one.said.is_empty()).count();
        let sees = sets.iter().filter(|one| one.sees).count();
        let power: f64 = sets.iter().map(|one| one.power).sum();
        println!("| {cell} | {} | {named} | {} | {sees} | {power:.1} |", sets.len(), named + open);
    }
}

/// Coverage of the intervals by parameter.
fn print_parameters(all: &[Judgement]) {
    let mut parameters: BTreeMap<&str, Vec<bool>> = BTreeMap::new();
    for interval in all.iter().flat_map(|one| &one.intervals) {
        parameters.entry(&interval.parameter).or_default().push(interval.holds());
    }
    println!("\n| parameter | intervals | hold |\n|---|---|---|");
    for (parameter, held) in parameters {
        println!("| {parameter} | {} | {} |", held.len(), held.iter().filter(|held| **held).count());
    }
}

/// What else than findings is said of nothing.
fn print_nulls(all: &[Judgement]) {
    let nulls: Vec<&Judgement> = all.iter().filter(|one| one.null).collect();
    let saying =
        |begin: &str| nulls.iter().filter(|one| one.said.iter().any(|said| said.starts_with(begin))).count();
    println!(
        "\n{} null sets: {} with undecided causes, {} with other numbers of the base, {} with rivals, {} refuted",
        nulls.len(),
        saying("?"),
        saying("calibration:"),
        saying("!"),
        saying("refuted")
    );
}

/// Every set that is not right, and every interval that does not hold.
fn print_sets(all: &[Judgement]) {
    println!();
    for one in all {
        let quiet = one.verdict == Verdict::Right || one.verdict == Verdict::Honest && !one.sees;
        if !quiet {
            let (name, verdict, rows) = (&one.name, one.verdict, one.rows);
            println!("  {verdict:?} {name} ({rows} rows, oracle {:.2}): {}", one.power, one.said.join(", "));
        }
        if let Some(note) = &one.gain_note {
            println!("  gain of {}: {note}", one.name);
        }
        for miss in one.intervals.iter().filter(|interval| !interval.holds()) {
            let (low, high) = (miss.low, miss.high);
            println!(
                "  {} {} is {:.4e}, stated {low:.4e} to {high:.4e}",
                one.name, miss.parameter, miss.truth
            );
        }
    }
}

/// The demands that are not met.
fn failures(all: &[Judgement]) -> Vec<String> {
    println!();
    let sets: Vec<&Judgement> = all.iter().collect();
    let honest = count(&sets, Verdict::Right) + count(&sets, Verdict::Honest);
    let gains: Vec<bool> = all.iter().filter_map(|one| one.gain).collect();
    let held = gains.iter().filter(|held| **held).count();
    let intervals = held_intervals(all);
    let sound = intervals.iter().filter(|holds| **holds).count();
    let mut results = vec![
        require("right or honestly undecided", honest, sets.len(), 0.95),
        require("claimed gain within its interval", held, gains.len(), 0.93),
        require("parameter within its interval", sound, intervals.len(), 0.93),
        require("parameter outside its interval", intervals.len() - sound, intervals.len(), 0.03),
    ];
    let worse: Vec<bool> = all.iter().filter_map(|one| one.worse).collect();
    let count_of = worse.iter().filter(|worse| **worse).count();
    println!("extended model worse than the base on fresh rows: {count_of} of {}", worse.len());
    let nulls: Vec<&Judgement> = all.iter().filter(|one| one.null).collect();
    let silent = nulls.len() - count(&nulls, Verdict::False);
    results.push(require("no false cause where nothing acts", silent, nulls.len(), 0.95));
    for (kind, sets) in by(all, |one| one.null.then_some(&one.situation)) {
        let silent = sets.len() - count(&sets, Verdict::False);
        results.push(require(&format!("no false cause on {kind}"), silent, sets.len(), 0.95));
    }
    for slow in all.iter().filter(|one| one.seconds > SLOWEST) {
        println!("{} took {:.0} s", slow.name, slow.seconds);
    }
    results.into_iter().filter_map(Result::err).collect()
}
