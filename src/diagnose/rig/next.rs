//! What to measure next: the experiments that best tell the surviving causes apart and best pin their numbers.
//!
//! An experiment is worth what it is expected to tell. For causes `h` with weights `w_h` (their likelihoods) that predict `m_h` for a reading with
//! the error `s`, that is about `sum w_h (m_h - m)² / (2 s²)` [nats] with `m = sum w_h m_h`; for the numbers of the chosen cause, with the
//! variance `V` of its prediction over draws of the fit, `ln(1 + V/s²)/2`. The count that decides between the two leading causes is
//! that at which the expected ratio of their likelihoods is `e³`.

use serde::Serialize;

use super::addition::RigAddition;
use super::choice::{Choice, RigStudy, Scored, moved};
use super::posterior::Posterior;
use super::shelf::predict;
use crate::dataset::{Experiment, RigMeasurements, RigReading};
use crate::rig::{CaseText, Predicted, RigCase, Simulated};

/// Causes within this of the best are asked to be told apart [nats], and most of them.
const SURVIVES: f64 = 6.0;
const MOST_CAUSES: usize = 4;
/// Draws of the fit.
const DRAWS: usize = 12;
/// Most proposals, and most rows of the table.
const PROPOSALS: usize = 36;
const ROWS: usize = 8;
/// Particles followed in each.
const PARTICLES: u64 = 200;
/// Count of particles that is assumed where the file states neither counts nor errors.
const COUNT: f64 = 100.0;
/// Logarithm of the ratio of likelihoods that decides [nats].
const DECIDES: f64 = 3.0;
/// Least expected information of a row [nats].
const LEAST: f64 = 0.02;
/// Keys of a case that a rig can usually vary, and the factors or steps to try.
const LEVERS: [(&str, [f64; 2], bool); 8] = [
    ("particles.speed", [0.5, 2.0], true),
    ("particles.speed.mean", [0.5, 2.0], true),
    ("particles.diameter", [0.5, 2.0], true),
    ("particles.diameter.mean", [0.5, 2.0], true),
    ("particles.angle_deg", [-20.0, -40.0], false),
    ("particles.angle_deg.mean", [-20.0, -40.0], false),
    ("particles.temperature", [-50.0, 50.0], false),
    ("particles.conversion", [-0.2, 0.2], false),
];

/// An experiment worth making.
#[derive(Debug, Clone, Serialize)]
pub struct NextExperiment {
    /// Its settings: dotted keys of the case and cells.
    pub settings: Vec<(String, String)>,
    /// What to observe, as in `captured@target`.
    pub observable: String,
    /// Particles to count for it, or repeats of a reading with the usual error.
    pub repeats: u64,
    /// Expected information on which cause it is, with as many particles as usual in the file [nats].
    pub tells_causes: f64,
    /// The same on the numbers of the chosen cause [nats].
    pub pins_numbers: f64,
    /// What each surviving cause predicts [1].
    pub predicted: Vec<(String, f64)>,
}

/// The error of a reading.
#[derive(Debug, Clone, Copy)]
enum Usual {
    Count(f64),
    Error(f64),
}

/// Ranks experiments near those of the file and along the usual levers of a rig; the most telling first.
///
/// # Errors
/// Why the cases of the proposals cannot be simulated.
pub(super) fn next_experiments(
    study: &RigStudy<'_>,
    choice: &Choice,
    posterior: &Posterior,
    data: &RigMeasurements,
    text: &CaseText,
) -> Result<Vec<NextExperiment>, String> {
    let columns = columns(data);
    let experiments: Vec<Experiment> = proposals(data, text)
        .into_iter()
        .enumerate()
        .map(|(number, settings)| {
            let readings = columns.iter().map(|(reading, _)| reading.clone()).collect();
            Experiment { name: format!("proposal {}", number + 1), line: 0, settings, readings }
        })
        .collect();
    // A proposal that the case refuses, as a temperature without a gas property, is none.
    let cases: Vec<RigCase> =
        experiments.iter().filter_map(|one| RigCase::proposed(text, one).ok()).collect();
    let forward = Simulated::new(&cases, PARTICLES)?;
    let causes = causes(choice);
    if causes.is_empty() || cases.is_empty() {
        return Ok(Vec::new());
    }
    let by_cause: Vec<Vec<Predicted>> =
        causes.iter().filter_map(|(_, additions, _)| predict(&forward, additions).ok()).collect();
    if by_cause.len() < causes.len() {
        return Ok(Vec::new());
    }
    let drawn = posterior.draws(DRAWS, study.seed);
    let by_draw: Vec<Vec<Predicted>> =
        drawn.iter().filter_map(|at| predict(&forward, &moved(&choice.additions, at)).ok()).collect();
    let total: f64 = causes.iter().map(|(.., weight)| weight).sum();
    let weights: Vec<f64> = causes.iter().map(|(.., weight)| weight / total).collect();
    let mut rows = Vec::new();
    for (place, case) in cases.iter().enumerate() {
        for (column, (reading, usual)) in columns.iter().enumerate() {
            let index = place * columns.len() + column;
            let means: Vec<f64> = by_cause.iter().map(|all| all[index].value).collect();
            if means.iter().any(|mean| !mean.is_finite()) {
                continue;
            }
            let mean: f64 = means.iter().zip(&weights).map(|(mean, weight)| mean * weight).sum();
            let one = variance(mean, Usual::Count(1.0), usual);
            let usual_variance = variance(mean, *usual, usual);
            let between: f64 =
                means.iter().zip(&weights).map(|(m, weight)| weight * (m - mean).powi(2)).sum();
            let apart = means.get(1).map_or(0.0, |other| (means[0] - other).powi(2));
            let repeats =
                if apart > 0.0 { (2.0 * DECIDES * one / apart).ceil().max(1.0) } else { f64::INFINITY };
            let values: Vec<f64> =
                by_draw.iter().map(|all| all[index].value).filter(|v| v.is_finite()).collect();
            let row = NextExperiment {
                settings: case.settings().to_vec(),
                observable: reading.column.clone(),
                repeats: if repeats < 1e6 { repeats as u64 } else { usual_count(usual) },
                tells_causes: 0.5 * between / usual_variance,
                pins_numbers: 0.5 * (spread(&values) / usual_variance).ln_1p(),
                predicted: causes.iter().zip(&means).map(|((name, ..), m)| (name.clone(), *m)).collect(),
            };
            rows.push(row);
        }
    }
    rows.retain(|row| row.tells_causes.max(row.pins_numbers) > LEAST);
    let worth = |row: &NextExperiment| row.tells_causes + row.pins_numbers;
    rows.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
    rows.truncate(ROWS);
    Ok(rows)
}

/// The surviving causes: name, additions, and likelihood as a weight.
fn causes(choice: &Choice) -> Vec<(String, Vec<RigAddition>, f64)> {
    let Some(last) = choice.rounds.last() else {
        return choice.hints.iter().take(MOST_CAUSES).map(hint).chain([nothing()]).collect();
    };
    let before = &choice.additions[..choice.additions.len().saturating_sub(1)];
    let best = last.winner.gain;
    let other = |one: &Scored| {
        let mut additions = before.to_vec();
        additions.push(one.addition.clone());
        (one.addition.name(), additions, (one.gain - best).exp())
    };
    let mut all = vec![(last.winner.addition.name(), choice.additions.clone(), 1.0)];
    all.extend(last.others.iter().filter(|one| one.gain > best - SURVIVES).take(MOST_CAUSES).map(other));
    all
}

fn hint(one: &Scored) -> (String, Vec<RigAddition>, f64) {
    (one.addition.name(), vec![one.addition.clone()], one.gain.exp())
}

fn nothing() -> (String, Vec<RigAddition>, f64) {
    ("no further effect".to_owned(), Vec::new(), 1.0)
}

/// The observables of the file with the usual error of each.
fn columns(data: &RigMeasurements) -> Vec<(RigReading, Usual)> {
    let mut columns: Vec<(RigReading, Usual)> = Vec::new();
    let all = || data.experiments.iter().flat_map(|one| &one.readings);
    for reading in all() {
        if columns.iter().any(|(known, _)| known.column == reading.column) {
            continue;
        }
        let own = || all().filter(|one| one.column == reading.column);
        let counts = median(own().filter_map(|one| one.count).collect());
        let errors = median(own().filter_map(|one| one.error).collect());
        let usual = match (errors, counts) {
            (Some(error), _) => Usual::Error(error),
            (None, count) => Usual::Count(count.unwrap_or(COUNT)),
        };
        columns.push((reading.clone(), usual));
    }
    columns
}

fn usual_count(usual: &Usual) -> u64 {
    match usual {
        Usual::Count(count) => *count as u64,
        Usual::Error(_) => 1,
    }
}

/// Variance of a reading about a share: of one particle or one repeat, or as usual.
fn variance(mean: f64, wanted: Usual, usual: &Usual) -> f64 {
    let p = mean.clamp(0.01, 0.99);
    match (wanted, usual) {
        (Usual::Error(error), _) => error * error,
        (_, Usual::Error(error)) => error * error,
        (Usual::Count(count), _) => p * (1.0 - p) / count,
    }
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

fn spread(values: &[f64]) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count
}

/// Settings worth trying: those of the file, halfway between neighbours, beyond the ends, and one lever at a time from the middle.
fn proposals(data: &RigMeasurements, text: &CaseText) -> Vec<Vec<(String, String)>> {
    let known: Vec<&Vec<(String, String)>> = data.experiments.iter().map(|one| &one.settings).collect();
    let mut all: Vec<Vec<(String, String)>> = known.iter().map(|one| (*one).clone()).collect();
    for pair in known.windows(2) {
        for (from, to, share) in [(pair[0], pair[1], 0.5), (pair[0], pair[1], -0.5), (pair[1], pair[0], -0.5)]
        {
            all.extend(between(from, to, share));
        }
    }
    let middle = known.get(known.len() / 2).map_or(Vec::new(), |one| (*one).clone());
    for (key, steps, factor) in LEVERS {
        let cell = middle.iter().find(|(known, _)| known == key).and_then(|(_, cell)| cell.parse().ok());
        let Some(value) = cell.or_else(|| text.number(key)) else { continue };
        for step in steps {
            let moved: f64 = if factor { value * step } else { value + step };
            let mut settings = middle.clone();
            settings.retain(|(known, _)| known != key);
            settings.push((key.to_owned(), cell_of(moved)));
            all.push(settings);
        }
    }
    let mut distinct: Vec<Vec<(String, String)>> = Vec::new();
    for one in all {
        if !distinct.contains(&one) {
            distinct.push(one);
        }
    }
    distinct.truncate(PROPOSALS);
    distinct
}

/// Settings on the line from one experiment to another: 0 is the first, 1 the second; `None` if words differ.
fn between(from: &[(String, String)], to: &[(String, String)], share: f64) -> Option<Vec<(String, String)>> {
    if from.len() != to.len() {
        return None;
    }
    let mut moved = Vec::new();
    for ((key, one), (other_key, other)) in from.iter().zip(to) {
        if key != other_key {
            return None;
        }
        let cell = match (one.parse::<f64>(), other.parse::<f64>()) {
            _ if one == other => one.clone(),
            (Ok(a), Ok(b)) => cell_of(a + share * (b - a)),
            _ => return None,
        };
        moved.push((key.clone(), cell));
    }
    Some(moved)
}

/// A number with four digits.
fn cell_of(value: f64) -> String {
    format!("{value:.3e}").parse::<f64>().map_or_else(|_| value.to_string(), |rounded| rounded.to_string())
}

/// The proposals as a table that can be filled in: the columns of the data file.
pub(super) fn table(rows: &[NextExperiment]) -> String {
    let mut keys: Vec<&String> = Vec::new();
    let mut observables: Vec<&String> = Vec::new();
    for row in rows {
        for (key, _) in &row.settings {
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
        if !observables.contains(&&row.observable) {
            observables.push(&row.observable);
        }
    }
    let mut header: Vec<String> = vec!["experiment".to_owned()];
    header.extend(keys.iter().map(|key| (*key).clone()));
    for observable in &observables {
        header.extend([(*observable).clone(), format!("{observable}_n")]);
    }
    header.extend(["tells_causes_nats".to_owned(), "pins_numbers_nats".to_owned()]);
    let mut lines = vec![header];
    for (number, row) in rows.iter().enumerate() {
        let mut cells = vec![format!("next {}", number + 1)];
        let cell = |key: &String| row.settings.iter().find(|(known, _)| known == key).map(|(_, cell)| cell);
        cells.extend(keys.iter().map(|key| cell(key).cloned().unwrap_or_default()));
        for observable in &observables {
            let own = **observable == row.observable;
            cells.extend([String::new(), if own { row.repeats.to_string() } else { String::new() }]);
        }
        cells.extend([format!("{:.2}", row.tells_causes), format!("{:.2}", row.pins_numbers)]);
        lines.push(cells);
    }
    let quote = |cell: &String| {
        if cell.contains([',', '"', '\n']) {
            format!("\"{}\"", cell.replace('"', "\"\""))
        } else {
            cell.clone()
        }
    };
    lines.iter().map(|cells| cells.iter().map(quote).collect::<Vec<_>>().join(",") + "\n").collect()
}
