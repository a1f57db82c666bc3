//! Experiments that could be made: over the ranges of the settings of the file, and along the usual levers of a rig.

use super::super::reach::Reach;
use super::places::halton;
use crate::dataset::RigMeasurements;
use crate::rig::CaseText;

/// Most settings of the file that are proposed again.
const KNOWN: usize = 12;
/// Settings inside the ranges of the file.
const INSIDE_RANGES: usize = 12;
/// Settings that vary whose ends are combined, at most.
const CORNERS: usize = 3;
/// How far beyond a range, as a share of it.
const BEYOND_RANGE: f64 = 0.5;
/// Keys of a case that a rig can usually vary, and the factors or steps to try.
const LEVERS: [(&str, [f64; 2], bool); 9] = [
    ("particles.speed", [0.5, 2.0], true),
    ("particles.speed.mean", [0.5, 2.0], true),
    ("particles.diameter", [0.5, 2.0], true),
    ("particles.diameter.mean", [0.5, 2.0], true),
    ("particles.diameter.scale", [0.5, 2.0], true),
    ("particles.angle_deg", [-20.0, -40.0], false),
    ("particles.angle_deg.mean", [-20.0, -40.0], false),
    ("particles.temperature", [-50.0, 50.0], false),
    ("particles.conversion", [-0.2, 0.2], false),
];

/// Settings of one experiment: dotted keys and cells.
type Settings = Vec<(String, String)>;

/// A setting whose numbers vary from experiment to experiment.
struct Range {
    key: String,
    /// Least and largest value of each number of the cell: one, or three of a vector.
    low: Vec<f64>,
    high: Vec<f64>,
}

impl Range {
    /// The cell at a share of the range; beyond 0 and 1 outside of it, but never across zero.
    fn cell(&self, share: f64) -> String {
        let at = |(&low, &high): (&f64, &f64)| {
            let value = low + share * (high - low);
            let crosses = low > 0.0 && value <= 0.0;
            cell_of(if crosses { 0.5 * low } else { value })
        };
        let numbers: Vec<String> = self.low.iter().zip(&self.high).map(at).collect();
        match numbers.as_slice() {
            [one] => one.clone(),
            several => format!("[{}]", several.join(", ")),
        }
    }
}

/// Settings worth trying: those of the file, ends of the ranges with each other, settings inside,
/// one setting beyond its range, and one lever at a time.
/// Where the laboratory states what it can vary, only that varies, over the whole of its range.
pub(super) fn proposals(data: &RigMeasurements, text: &CaseText, reach: &[Reach]) -> Vec<Settings> {
    let known: Vec<&Settings> = data.experiments.iter().map(|one| &one.settings).collect();
    let Some(middle) = known.get(known.len() / 2).map(|one| (*one).clone()) else { return Vec::new() };
    let stated =
        |one: &Reach| Range { key: one.name.clone(), low: vec![one.range[0]], high: vec![one.range[1]] };
    let free = reach.is_empty();
    let ranges: Vec<Range> = if free { ranges(&known) } else { reach.iter().map(stated).collect() };
    let mut all: Vec<Settings> = Vec::new();
    let every = known.len().div_ceil(KNOWN).max(1);
    all.extend(known.iter().step_by(every).filter(|_| free).map(|one| (*one).clone()));
    let corners = ranges.len().min(CORNERS);
    for corner in 0..1_usize << corners {
        let end = |place: usize| if place < corners { (corner >> place & 1) as f64 } else { 0.5 };
        all.push(moved(&middle, &ranges, end));
    }
    for number in 1..=INSIDE_RANGES {
        let from = known[number % known.len()];
        all.push(moved(from, &ranges, |place| halton(number, [2, 3, 5, 7, 11, 13][place % 6])));
    }
    for (beyond, _) in ranges.iter().enumerate().filter(|_| free) {
        for share in [-BEYOND_RANGE, 1.0 + BEYOND_RANGE] {
            all.push(moved(&middle, &ranges, |place| if place == beyond { share } else { 0.5 }));
        }
    }
    if free {
        all.extend(by_levers(&middle, &ranges, text));
    }
    let mut distinct: Vec<Settings> = Vec::new();
    for one in all {
        if !distinct.iter().any(|other| same(&one, other)) {
            distinct.push(one);
        }
    }
    distinct
}

/// The middle of the ranges with one lever that the file does not move.
fn by_levers(middle: &Settings, ranges: &[Range], text: &CaseText) -> Vec<Settings> {
    let mut all = Vec::new();
    for (key, steps, factor) in
        LEVERS.into_iter().filter(|(key, ..)| ranges.iter().all(|one| one.key != *key))
    {
        let cell = middle.iter().find(|(known, _)| known == key).and_then(|(_, cell)| cell.parse().ok());
        let Some(value) = cell.or_else(|| text.number(key)) else { continue };
        for step in steps {
            let value: f64 = if factor { value * step } else { value + step };
            let mut settings = moved(middle, ranges, |_| 0.5);
            settings.retain(|(known, _)| known != key);
            settings.push((key.to_owned(), cell_of(value)));
            all.push(settings);
        }
    }
    all
}

/// Whether both set the same, however their numbers are written.
fn same(one: &Settings, other: &Settings) -> bool {
    let cell = |(a, b): (&(String, String), &(String, String))| {
        a.0 == b.0 && (a.1 == b.1 || numbers(&a.1).is_some_and(|value| Some(value) == numbers(&b.1)))
    };
    one.len() == other.len() && one.iter().zip(other).all(cell)
}

/// The ranges of the settings that vary and are numbers in all experiments that have them.
fn ranges(known: &[&Settings]) -> Vec<Range> {
    let mut ranges: Vec<Range> = Vec::new();
    for (key, _) in known.iter().flat_map(|settings| settings.iter()) {
        if ranges.iter().any(|range| range.key == *key) {
            continue;
        }
        let cells = known.iter().flat_map(|settings| settings.iter()).filter(|(other, _)| other == key);
        let Some(numbers) = cells.map(|(_, cell)| numbers(cell)).collect::<Option<Vec<_>>>() else {
            continue;
        };
        let Some(first) = numbers.first().filter(|first| numbers.iter().all(|n| n.len() == first.len()))
        else {
            continue;
        };
        let end = |pick: fn(f64, f64) -> f64| {
            let of = |place: usize| numbers.iter().map(|n| n[place]).fold(first[place], pick);
            (0..first.len()).map(of).collect::<Vec<f64>>()
        };
        let range = Range { key: key.clone(), low: end(f64::min), high: end(f64::max) };
        if range.low != range.high {
            ranges.push(range);
        }
    }
    ranges
}

/// The numbers of a cell: one, or those of a vector.
fn numbers(cell: &str) -> Option<Vec<f64>> {
    let inside = cell.trim().strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    inside.unwrap_or(cell).split(',').map(|number| number.trim().parse().ok()).collect()
}

/// Settings with all ranges at a share; what neither an experiment sets nor a range varies stays as in the case.
fn moved(from: &Settings, ranges: &[Range], share: impl Fn(usize) -> f64) -> Settings {
    let cell = |(key, cell): &(String, String)| {
        let range = ranges.iter().enumerate().find(|(_, range)| range.key == *key);
        (key.clone(), range.map_or(cell.clone(), |(place, range)| range.cell(share(place))))
    };
    let mut settings: Settings = from.iter().map(cell).collect();
    for (place, range) in ranges.iter().enumerate() {
        if settings.iter().all(|(key, _)| *key != range.key) {
            settings.push((range.key.clone(), range.cell(share(place))));
        }
    }
    settings
}

/// A number with four digits.
fn cell_of(value: f64) -> String {
    format!("{value:.3e}").parse::<f64>().map_or_else(|_| value.to_string(), |rounded| rounded.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(cells: [&str; 2]) -> Settings {
        ["gas.velocity", "particles.speed"].iter().zip(cells).map(|(k, c)| ((*k).into(), c.into())).collect()
    }

    #[test]
    fn ranges_have_vectors_and_do_not_cross_zero() {
        let known = [settings(["[1, 0, 0]", "2"]), settings(["[5, 0, 0]", "6"])];
        let ranges = ranges(&known.iter().collect::<Vec<_>>());
        assert_eq!(ranges.len(), 2);
        assert_eq!(moved(&known[0], &ranges, |_| 0.5), settings(["[3, 0, 0]", "4"]));
        assert_eq!(ranges[1].cell(-0.5), "1");
        assert!(same(&settings(["[1, 0, 0]", "2e0"]), &known[0]));
    }

    #[test]
    fn words_have_no_range() {
        let known = [settings(["hot", "2"]), settings(["cold", "2"])];
        assert!(ranges(&known.iter().collect::<Vec<_>>()).is_empty());
    }
}
