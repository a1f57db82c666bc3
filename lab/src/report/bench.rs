//! The result of a benchmark as text: where the chosen law fails, then all laws.

use super::format::{number, percent};
use super::page::{Table, TableColumn};
use crate::diagnose::benchmark::{
    BenchmarkEntry, BenchmarkMeasure, BenchmarkResult, EntryKind, SetMeasure, Shortfall,
};

/// Ranges of inputs that are shown.
const RANGES: usize = 3;

/// A set is shown unasked where its score is further below the level than this [nats].
const NEAR_LEVEL: f64 = 0.1;

/// The result as text; `chosen` are the entries whose sets are shown, each with its ranges of inputs: all sets, or
/// those in which it is clearly worse than the level.
pub fn text(
    result: &BenchmarkResult,
    chosen: &[(&BenchmarkEntry, Vec<Shortfall>)],
    all_sets: bool,
) -> String {
    let [all, used] = result.readings;
    let sources = result.sources.len();
    let mut text = format!(
        "{used} of {all} readings of {sources} sources are decided by all and scored. Each source is predicted with \
            numbers and\n\
         a scatter that were fitted to the other sources, and counts once. Beyond level: mean log score of a reading \
         less\n\
         that of the mean of the other sources [nats]. In band: readings of e_n and e_t in the 95 % band of the \
         scatter.\n"
    );
    for (entry, ranges) in chosen {
        text += &failures(entry, ranges, all_sets);
    }
    for (kind, caption) in [
        (EntryKind::Whole, "Models and programs, all readings"),
        (EntryKind::Law(0), "Laws of e_n and of capture by adhesion"),
        (EntryKind::Law(1), "Laws of e_t"),
    ] {
        text += &laws(result, kind, caption).map_or(String::new(), |table| table.text());
    }
    text + &captures(result).map_or(String::new(), |table| table.text())
}

/// The laws of capture by a melt, the worst first; each on its own readings. `None` without any.
fn captures(result: &BenchmarkResult) -> Option<Table> {
    let capture = |entry: &BenchmarkEntry| entry.by_observable[2];
    let gain = |entry: &BenchmarkEntry| capture(entry).map_or(f64::INFINITY, |measure| measure.gain);
    let mut entries: Vec<&BenchmarkEntry> =
        result.entries.iter().filter(|entry| entry.kind == EntryKind::Law(2)).collect();
    entries.sort_by(|a, b| gain(a).total_cmp(&gain(b)));
    let worst = |entry: &BenchmarkEntry| {
        let worst = entry.sets.iter().min_by(|a, b| a.measure.gain.total_cmp(&b.measure.gain));
        worst.map_or("–".to_owned(), |set| format!("{} {}", set.set, nats(set.measure.gain)))
    };
    let columns: [TableColumn<'_, &BenchmarkEntry>; 7] = [
        ("law", &|entry| entry.name.clone()),
        ("captured beyond level", &|entry| nats(capture(entry).map_or(f64::NAN, |measure| measure.gain))),
        ("adhesion alone", &|entry| nats(entry.without.map_or(f64::NAN, |measure| measure.gain))),
        ("readings", &|entry| capture(entry).map_or(0, |measure| measure.readings).to_string()),
        ("sources", &|entry| sources(entry).to_string()),
        ("worst set", &|entry| worst(entry)),
        ("fitted numbers", &|entry| fitted(entry)),
    ];
    let caption = "Laws of capture by a melt, the worst first: captures in which a melt may matter, of sets that have \
        what the law needs";
    (!entries.is_empty()).then(|| Table::of_items(caption, 1, &entries, &columns))
}

/// The number of sources of an entry's readings.
fn sources(entry: &BenchmarkEntry) -> usize {
    let mut names: Vec<&str> = entry.sets.iter().map(|set| set.source.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names.len()
}

/// The sets of an entry, the worst first, and the ranges of inputs in which it is worse than the level.
fn failures(entry: &BenchmarkEntry, ranges: &[Shortfall], all_sets: bool) -> String {
    let of_kind = |set: &&SetMeasure| match entry.kind {
        EntryKind::Law(0) => set.observable != "e_t",
        EntryKind::Law(1) => set.observable == "e_t",
        _ => true,
    };
    let mut sets: Vec<&SetMeasure> = entry.sets.iter().filter(of_kind).collect();
    sets.sort_by(|a, b| a.measure.gain.total_cmp(&b.measure.gain));
    let count = sets.len();
    sets.retain(|set| all_sets || set.measure.gain < -NEAR_LEVEL);
    let row = |set: &&SetMeasure| {
        let [measured, predicted] = set.means.map(short);
        let label = if set.observable == "outcome" { "captured" } else { set.observable };
        let measure = &set.measure;
        let cells = [set.set.as_str(), set.source.as_str(), label].map(str::to_owned);
        let numbers = [measure.readings.to_string(), measured, predicted, short(measure.rms)];
        cells.into_iter().chain(numbers).chain([share(measure.coverage), nats(measure.gain)]).collect()
    };
    let header = ["set", "source", "", "readings", "measured", "predicted", "rms", "in band", "beyond level"];
    let caption = format!("{}, the worst set first", entry.name);
    let mut text = Table::new(&caption, 3, &header, sets.iter().map(row).collect()).text();
    if sets.len() < count {
        text += &format!("  near the level or better in the {} others\n", count - sets.len());
    }
    text + &shortfalls(ranges) + &reservations(entry)
}

/// Ranges of an input in which it falls short, a line each.
fn shortfalls(ranges: &[Shortfall]) -> String {
    let mut text = String::new();
    for Shortfall { input, unit, range: [low, high], readings, gain } in ranges.iter().take(RANGES) {
        let unit = if *unit == "1" { String::new() } else { format!(" {unit}") };
        let range = if low == high { number(*low) } else { format!("{} to {}", number(*low), number(*high)) };
        text += &format!(
            "  worst over {input}: {range}{unit}, {} beyond level ({readings} readings)\n",
            nats(*gain)
        );
    }
    text
}

/// What its own bands hold, and what it does not decide.
fn reservations(entry: &BenchmarkEntry) -> String {
    let mut text = String::new();
    if let Some(coverage) = entry.own_coverage {
        text += &format!("  its own bands hold {} of the readings\n", percent(coverage));
    }
    if entry.undecided > 0 {
        let reason = entry.refusal.as_ref().map_or(String::new(), |reason| format!("; {reason}"));
        text += &format!("  {} readings are not decided{reason}\n", entry.undecided);
    }
    text
}

/// Everything of one kind, the best first, with the level; `None` if there is nothing of it.
fn laws(result: &BenchmarkResult, kind: EntryKind, caption: &str) -> Option<Table> {
    let [e_n, e_t, capture] = [0, 1, 2];
    let shown: &[usize] = match kind {
        EntryKind::Law(0) => &[e_n, capture],
        EntryKind::Law(_) => &[e_t],
        _ => &[e_n, e_t, capture],
    };
    let gain = |entry: &BenchmarkEntry| match kind {
        EntryKind::Whole => entry.whole.gain,
        _ => shown.iter().filter_map(|&which| Some(entry.by_observable[which]?.gain)).sum(),
    };
    let of_kind = |entry: &&BenchmarkEntry| entry.kind == kind || entry.kind == EntryKind::Level;
    let mut entries: Vec<&BenchmarkEntry> = result.entries.iter().filter(of_kind).collect();
    entries.sort_by(|a, b| gain(b).total_cmp(&gain(a)));
    let mut header = vec!["law".to_owned()];
    for &which in shown {
        header.extend(columns(which).iter().map(|&name| name.to_owned()));
    }
    header.push(if kind == EntryKind::Whole { "all" } else { "fitted numbers" }.to_owned());
    let row = |entry: &&BenchmarkEntry| {
        let mut cells = vec![entry.name.clone()];
        shown.iter().for_each(|&which| cells.extend(measures(which, entry.by_observable[which].as_ref())));
        cells.push(if kind == EntryKind::Whole { nats(entry.whole.gain) } else { fitted(entry) });
        cells
    };
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    (entries.len() > 1).then(|| Table::new(caption, 1, &header, entries.iter().map(row).collect()))
}

/// The fitted numbers with their ranges over the sources that were left out.
fn fitted(entry: &BenchmarkEntry) -> String {
    let one = |(name, [low, high]): &(&str, [f64; 2])| match low == high {
        true => format!("{name} {}", number(*low)),
        false => format!("{name} {} to {}", number(*low), number(*high)),
    };
    entry.numbers.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// Headings of the columns of an observable.
fn columns(observable: usize) -> &'static [&'static str] {
    [
        &["e_n beyond level", "rms", "in band"][..],
        &["e_t beyond level", "rms", "in band"],
        &["captured beyond level"],
    ][observable]
}

fn measures(observable: usize, measure: Option<&BenchmarkMeasure>) -> Vec<String> {
    let of = |value: fn(&BenchmarkMeasure) -> f64| measure.map_or(f64::NAN, value);
    let mut cells = vec![nats(of(|one| one.gain))];
    if observable < 2 {
        cells.extend([short(of(|one| one.rms)), share(of(|one| one.coverage))]);
    }
    cells
}

/// A difference of log scores with two decimals.
fn nats(value: f64) -> String {
    let rounded = (100.0 * value).round() / 100.0;
    // Adding zero takes the sign off a negative one.
    if value.is_finite() { format!("{:+.2}", rounded + 0.0) } else { "–".to_owned() }
}

fn short(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "–".to_owned() }
}

fn share(value: f64) -> String {
    if value.is_finite() { format!("{:.0} %", 100.0 * value) } else { "–".to_owned() }
}
