//! What to measure next: the experiments that best tell the surviving causes apart and best pin their numbers.
//!
//! Every surviving explanation `h` with the weight `w_h` (its probability) predicts a reading with some
//! values of its numbers that the file leaves open. With the error of the reading, of standard
//! deviation `s`, they make a density `p_h(y)` of its value (a kernel estimate that keeps their
//! variance). The scatter between runs is part of that error: further particles in one run do not
//! reduce it. The expected information on which cause it is, is `sum w_h ∫ p_h ln(p_h/p) dy` with
//! `p = sum w_h p_h` [nats]: a cause that predicts one value is also told from one that leaves it
//! open. That on the numbers of the first cause is `ln(1 + v_1/s²)/2` with their variance `v_1`.
//! The first rows tell the causes apart as well as possible, the others are worth most in both.
//! Each row is the best one when those above it are measured: on the cause by the density of all
//! readings together, on the numbers by linear regression on the expected readings.
//!
//! The count that decides between the two leading causes is that at which the expected ratio of
//! their likelihoods is `e³`.

use std::collections::BTreeMap;

use serde::Serialize;

use super::super::explanations::{FoundExplanation, distinct};
use super::super::reach::Reach;
use super::addition::{RigAddition, moved, shapes};
use super::choice::RigChoice;
use super::noise::PreparedReadings;
use super::posterior::Posterior;
use super::prediction_table::predict;
use super::proposals::proposals;
use super::rig_search::FittedRig;
use super::study::RigStudy;
use crate::dataset::{Experiment, RigMeasurements, RigReading};
use crate::rig::{CaseText, Forward, PredictionError, RigCase, SimulatedRig};

/// Most explanations that are asked to be told apart.
const MOST_SURVIVING: usize = 5;
/// Values of the numbers of the first cause, and of any other one.
const STATES: [usize; 2] = [12, 5];
/// Most rows of the table.
const MOST_PROPOSALS: usize = 8;
/// Particles followed in each proposal.
const PROPOSAL_PARTICLES: u64 = 128;
/// Count of particles that is assumed where the file states neither counts nor errors.
const ASSUMED_COUNT: f64 = 100.0;
/// Logarithm of the ratio of likelihoods that decides [nats].
const DECIDES: f64 = 3.0;
/// Largest number of usual readings that a proposal may ask for; beyond it no number is given.
const MOST_REPEATS: f64 = 100.0;
/// The first rows only tell causes apart, as long as one is expected to tell so much [nats]: a
/// rival of a small weight is worth little, but as long as it is there the cause has no name.
const TELLING: usize = 4;
const LEAST_TOLD: f64 = 0.002;
/// Least expected information of any other row [nats].
const LEAST_WORTH: f64 = 0.02;

/// An experiment worth making.
#[derive(Debug, Clone, Serialize)]
pub struct NextExperiment {
    /// Its settings: dotted keys of the case and cells.
    pub settings: Vec<(String, String)>,
    /// What to observe, as in `captured@target`.
    pub observable: String,
    /// Particles to count for it, or repeats of a reading with the usual error; `None` where the
    /// leading causes predict nearly the same, so that no count decides between them.
    pub repeats: Option<u64>,
    /// Standard error to reach with these repeats [1], where the file states errors.
    pub error: Option<f64>,
    /// Expected information on which cause it is, with as many particles as usual in the file [nats].
    pub tells_causes: f64,
    /// The same on the numbers of the first cause [nats].
    pub pins_numbers: f64,
    /// What each surviving cause predicts [1].
    pub predicted: Vec<(String, f64)>,
}

/// The error of a usual reading.
#[derive(Debug, Clone, Copy)]
enum Usual {
    /// A share of so many particles, and the correlation between two of a run [1].
    Share(f64, f64),
    /// Stated error [1].
    Error(f64),
    /// A fitted scatter of a single particle or reading [1], and the number of these.
    Scatter(f64, f64),
}

impl Usual {
    /// Variance of a reading of so many particles or repeats about a prediction.
    fn variance(self, mean: f64, count: f64) -> f64 {
        let p = mean.clamp(0.01, 0.99);
        match self {
            Self::Share(_, correlation) => {
                p * (1.0 - p) * (1.0 + (count - 1.0).max(0.0) * correlation) / count
            }
            Self::Error(error) => error * error / count,
            Self::Scatter(scatter, _) => scatter * scatter / count,
        }
    }

    /// Particles or repeats of a usual reading.
    fn count(self) -> f64 {
        match self {
            Self::Error(_) => 1.0,
            Self::Share(count, _) | Self::Scatter(_, count) => count,
        }
    }
}

/// A surviving cause.
struct Cause {
    name: String,
    /// Its probability [1].
    weight: f64,
    /// Likely values of its numbers, all of one weight; the first is the fit.
    states: Vec<Vec<RigAddition>>,
}

/// A reading that could be made.
#[derive(Debug)]
struct Possible {
    /// Index of the proposal and of the column.
    place: [usize; 2],
    usual: Usual,
    /// What each state of each cause predicts, one cause after the other.
    predicted: Vec<f64>,
    /// The same without what is known once the rows above are measured.
    left: Vec<f64>,
}

/// Ranks experiments over the settings of the file and along the usual levers of a rig; the most
/// telling first.
///
/// # Errors
/// Why the cases of the proposals cannot be simulated.
pub(super) fn next_experiments(
    study: &RigStudy<'_>,
    choice: &RigChoice,
    posterior: &Posterior,
    (data, text): (&RigMeasurements, &CaseText),
    reach: &[Reach],
) -> Result<Vec<NextExperiment>, PredictionError> {
    let columns = columns(study, choice, data)?;
    let proposed = proposals(data, text, reach).into_iter().enumerate().map(|(number, settings)| {
        let readings = columns.iter().map(|(reading, _)| reading.clone()).collect();
        Experiment { name: format!("proposal {}", number + 1), line: 0, settings, readings }
    });
    // A proposal that the case refuses, as a temperature without a gas property, is none.
    let cases: Vec<RigCase> = proposed.filter_map(|one| RigCase::proposed(text, &one).ok()).collect();
    let mut causes = causes(study, choice, posterior);
    let moved = causes.iter().flat_map(|cause| &cause.states).flatten();
    let mut ranges: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for (number, _, widths) in moved.filter_map(RigAddition::case_number) {
        let [least, most] = ranges.entry(number).or_default();
        (*least, *most) = (least.min(widths), most.max(widths));
    }
    let forward = SimulatedRig::of_proposals(&cases, PROPOSAL_PARTICLES).with_case_numbers(&ranges);
    let proposed = forward.experiments();
    let by_state = predict_states(&forward, &mut causes);
    if causes.is_empty() || proposed.is_empty() {
        return Ok(Vec::new());
    }
    let possible = |index: usize| {
        let predicted: Vec<f64> = by_state.iter().map(|all| all[index]).collect();
        let [place, column] = [index / columns.len(), index % columns.len()];
        let left = predicted.clone();
        let is_known = predicted.iter().all(|value| value.is_finite());
        is_known.then(|| Possible { place: [place, column], usual: columns[column].1, predicted, left })
    };
    let options: Vec<Possible> = (0..proposed.len() * columns.len()).filter_map(possible).collect();
    let ensemble = Ensemble::new(&causes);
    let row = |one: &Possible| {
        let [place, column] = one.place;
        ensemble.row(one, &causes, proposed[place].settings.clone(), &columns[column].0.column)
    };
    Ok(ensemble.ranked(options).iter().map(row).collect())
}

/// What each state of each cause predicts for all readings; states that the case refuses are left
/// out, and causes without any.
fn predict_states(forward: &SimulatedRig<'_>, causes: &mut Vec<Cause>) -> Vec<Vec<f64>> {
    let mut by_state: Vec<Vec<f64>> = Vec::new();
    for cause in causes.iter_mut() {
        cause.states.retain(|state| match predict(forward, state) {
            Ok(predicted) => {
                by_state.push(predicted.iter().map(|one| one.value).collect());
                true
            }
            Err(_) => false,
        });
    }
    causes.retain(|cause| !cause.states.is_empty());
    by_state
}

/// Errors of readings that stand for a normal distribution, in standard deviations: means of eight
/// parts of it of equal probability. Their variance is 0.945.
const NORMAL_ERRORS: [f64; 8] = [-1.647, -0.8949, -0.4905, -0.1580, 0.1580, 0.4905, 0.8949, 1.647];

/// Factor and shift that give each reading of a table its own order of these errors.
const ORDERS: [[usize; 2]; MOST_PROPOSALS] = [[1, 0], [3, 3], [1, 6], [3, 2], [5, 4], [7, 7], [5, 2], [7, 5]];

/// Readings that are taken to be measured.
struct MeasuredReadings {
    /// For each state and error that gives the readings, the logarithm of their density by each state.
    logs: Vec<Vec<f64>>,
    /// Number of readings.
    rows: usize,
}

/// Weights of the states of all causes.
struct Ensemble {
    /// By state: its weight, which sums up to one, and its cause.
    states: Vec<(f64, usize)>,
    /// By cause.
    weights: Vec<f64>,
}

impl Ensemble {
    fn new(causes: &[Cause]) -> Self {
        let total: f64 = causes.iter().map(|cause| cause.weight).sum();
        let weights: Vec<f64> = causes.iter().map(|cause| cause.weight / total).collect();
        let of = |(place, cause): (usize, &Cause)| {
            let count = cause.states.len();
            vec![(weights[place] / count as f64, place); count]
        };
        Self { states: causes.iter().enumerate().flat_map(of).collect(), weights }
    }

    /// Mean of each cause.
    fn means(&self, predicted: &[f64]) -> Vec<f64> {
        let mut means = vec![0.0; self.weights.len()];
        for ((weight, cause), value) in self.states.iter().zip(predicted) {
            means[*cause] += weight * value;
        }
        means.iter().zip(&self.weights).map(|(sum, weight)| sum / weight.max(f64::MIN_POSITIVE)).collect()
    }

    fn mean(&self, predicted: &[f64]) -> f64 {
        self.states.iter().zip(predicted).map(|((weight, _), value)| weight * value).sum()
    }

    /// Variance of each cause by its numbers.
    fn spreads(&self, predicted: &[f64]) -> Vec<f64> {
        let means = self.means(predicted);
        let mut spreads = vec![0.0; self.weights.len()];
        for ((weight, cause), value) in self.states.iter().zip(predicted) {
            spreads[*cause] += weight * (value - means[*cause]).powi(2);
        }
        spreads.iter().zip(&self.weights).map(|(sum, weight)| sum / weight.max(f64::MIN_POSITIVE)).collect()
    }

    /// Variance of a reading of so many particles or repeats.
    fn noise(&self, one: &Possible, count: f64) -> f64 {
        one.usual.variance(self.mean(&one.predicted), count)
    }

    /// The kernels of all states for a reading of so many particles: their middles, and their
    /// variance with that of the reading.
    fn kernels(&self, one: &Possible, count: f64) -> Vec<[f64; 2]> {
        let noise = self.noise(one, count);
        let [means, spreads] = [self.means(&one.predicted), self.spreads(&one.predicted)];
        let kernel = |((weight, cause), value): (&(f64, usize), &f64)| {
            // Silverman's width; the middles move together so that the variance of the cause stays.
            let share = (weight / self.weights[*cause]).powf(0.4);
            let middle = means[*cause] + (1.0 - share).max(0.0).sqrt() * (value - means[*cause]);
            [middle, noise + share * spreads[*cause]]
        };
        self.states.iter().zip(&one.predicted).map(kernel).collect()
    }

    /// Nothing is measured yet.
    fn unmeasured(&self) -> MeasuredReadings {
        let count = self.states.len();
        MeasuredReadings { logs: vec![vec![0.0; count]; count * NORMAL_ERRORS.len()], rows: 0 }
    }

    /// The readings that were measured and one more of so many particles.
    fn with(&self, measured: &MeasuredReadings, one: &Possible, count: f64) -> MeasuredReadings {
        let kernels = self.kernels(one, count);
        let [factor, shift] = ORDERS[measured.rows % MOST_PROPOSALS];
        let row = |(place, logs): (usize, &Vec<f64>)| {
            let [middle, variance] = kernels[place / NORMAL_ERRORS.len()];
            let reading =
                middle + variance.sqrt() * NORMAL_ERRORS[(factor * place + shift) % NORMAL_ERRORS.len()];
            let log = |[middle, variance]: &[f64; 2]| {
                -0.5 * (reading - middle).powi(2) / variance - 0.5 * variance.ln()
            };
            logs.iter().zip(&kernels).map(|(known, kernel)| known + log(kernel)).collect()
        };
        MeasuredReadings {
            logs: measured.logs.iter().enumerate().map(row).collect(),
            rows: measured.rows + 1,
        }
    }

    /// Logarithms of the densities of all causes at a set of readings, given those of the states.
    fn log_densities(&self, logs: &[f64]) -> Vec<f64> {
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut sums = vec![0.0; self.weights.len()];
        for ((weight, cause), log) in self.states.iter().zip(logs) {
            sums[*cause] += weight / self.weights[*cause] * (log - most).exp();
        }
        sums.into_iter().map(|sum| most + sum.max(f64::MIN_POSITIVE).ln()).collect()
    }

    /// Mean over the readings that the states predict of a function of the cause and all causes'
    /// log densities, each state with this weight.
    fn expected(
        &self,
        measured: &MeasuredReadings,
        weight: impl Fn(usize) -> f64,
        of: impl Fn(usize, &[f64]) -> f64,
    ) -> f64 {
        let one = |(place, logs): (usize, &Vec<f64>)| {
            let state = place / NORMAL_ERRORS.len();
            let weight = weight(state) / NORMAL_ERRORS.len() as f64;
            if weight == 0.0 { 0.0 } else { weight * of(self.states[state].1, &self.log_densities(logs)) }
        };
        measured.logs.iter().enumerate().map(one).sum()
    }

    /// Expected information on the cause [nats].
    fn tells(&self, measured: &MeasuredReadings) -> f64 {
        let gain = |cause: usize, logs: &[f64]| {
            let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let all: f64 = logs.iter().zip(&self.weights).map(|(log, w)| w * (log - most).exp()).sum();
            logs[cause] - most - all.ln()
        };
        self.expected(measured, |state| self.states[state].0, gain).max(0.0)
    }

    /// The least count that decides between the leading causes: the expected logarithm of the ratio
    /// of their likelihoods is [`DECIDES`].
    fn decides(&self, one: &Possible) -> Option<f64> {
        let first = |state: usize| {
            let (weight, cause) = self.states[state];
            if cause == 0 { weight / self.weights[0] } else { 0.0 }
        };
        let ratio = |count: f64| {
            let measured = self.with(&self.unmeasured(), one, count);
            self.expected(&measured, first, |_, logs| logs[0] - logs[1])
        };
        let [mut low, mut high] = [0.0, MOST_REPEATS * one.usual.count()];
        if self.weights.len() < 2 || ratio(high) < DECIDES {
            return None;
        }
        while high - low > 1e-4 * high {
            let middle = 0.5 * (low + high);
            if ratio(middle) < DECIDES { low = middle } else { high = middle }
        }
        Some((high * (1.0 - 1e-4)).ceil())
    }

    /// Expected information on the numbers of the first cause [nats].
    fn pins(&self, one: &Possible) -> f64 {
        let spread = self.spreads(&one.left).first().copied().unwrap_or(0.0);
        0.5 * (spread / self.noise(one, one.usual.count())).ln_1p()
    }

    /// Removes from what is left to know of `one` its regression on `other`, as far as the noise of
    /// that reading allows.
    fn regress(&self, one: &mut Possible, other: &Possible) {
        let [mean, other_mean] = [self.mean(&one.left), self.mean(&other.left)];
        let (mut both, mut square) = (0.0, 0.0);
        for (place, (weight, _)) in self.states.iter().enumerate() {
            let from = other.left[place] - other_mean;
            both += weight * from * (one.left[place] - mean);
            square += weight * from * from;
        }
        let noise = self.noise(other, other.usual.count());
        let slope = both / (square + noise) / (1.0 + (noise / (square + noise)).sqrt());
        for (value, seen) in one.left.iter_mut().zip(&other.left) {
            *value -= slope * (seen - other_mean);
        }
    }

    /// The readings most worth making, the best first; of each proposal one. Each is the best one
    /// when those above it are measured.
    fn ranked(&self, mut options: Vec<Possible>) -> Vec<Possible> {
        let mut ranked: Vec<Possible> = Vec::new();
        let mut measured = self.unmeasured();
        while ranked.len() < MOST_PROPOSALS {
            let before = self.tells(&measured);
            let with = |one: &Possible| self.with(&measured, one, one.usual.count());
            let told: Vec<f64> = options.iter().map(|one| self.tells(&with(one)) - before).collect();
            let worth: Vec<f64> =
                options.iter().zip(&told).map(|(one, told)| told + self.pins(one)).collect();
            let most = |of: &[f64], least: f64| {
                let best = of.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
                best.filter(|(_, value)| **value > least).map(|(place, _)| place)
            };
            let telling = if ranked.len() < TELLING { most(&told, LEAST_TOLD) } else { None };
            let Some(best) = telling.or_else(|| most(&worth, LEAST_WORTH)) else { break };
            measured = with(&options[best]);
            let best = options.remove(best);
            options.retain(|one| one.place[0] != best.place[0]);
            options.iter_mut().for_each(|one| self.regress(one, &best));
            ranked.push(best);
        }
        ranked
    }

    fn row(
        &self,
        one: &Possible,
        causes: &[Cause],
        settings: Vec<(String, String)>,
        column: &str,
    ) -> NextExperiment {
        let means = self.means(&one.predicted);
        let repeats = self.decides(one).map(|repeats| repeats as u64);
        let error = match (one.usual, repeats) {
            (Usual::Error(error), Some(repeats)) => Some(error / (repeats as f64).sqrt()),
            _ => None,
        };
        NextExperiment {
            settings,
            observable: column.to_owned(),
            repeats,
            error,
            tells_causes: self.tells(&self.with(&self.unmeasured(), one, one.usual.count())),
            pins_numbers: self.pins(one),
            predicted: causes.iter().zip(&means).map(|(cause, mean)| (cause.name.clone(), *mean)).collect(),
        }
    }
}

/// The explanations that hold 95 %, two at least, with their probabilities.
fn causes(study: &RigStudy<'_>, choice: &RigChoice, posterior: &Posterior) -> Vec<Cause> {
    let additions = choice.additions();
    let drawn = posterior.draws(STATES[0] - 1, study.seed);
    let surviving = choice.explanations.listed().len().clamp(2, MOST_SURVIVING);
    let cause = |one: &FoundExplanation<RigAddition>| {
        let own = &one.told.additions;
        let states = match !drawn.is_empty() && shapes(own) == shapes(&additions) {
            true => std::iter::once(additions.clone())
                .chain(drawn.iter().map(|at| moved(&additions, at)))
                .collect(),
            false => states(study, &choice.visited[one.place].fitted, STATES[1]),
        };
        let name = match one.told.causes.as_slice() {
            [] => "no further effect".to_owned(),
            causes => causes.join(" and "),
        };
        Cause { name, weight: one.probability, states }
    };
    choice.explanations.all().iter().take(surviving).map(cause).collect()
}

/// An explanation as it was fitted, and with its last addition at places of the search range as often as they
/// are likely.
fn states(study: &RigStudy<'_>, fitted: &FittedRig, count: usize) -> Vec<Vec<RigAddition>> {
    let mut states = vec![fitted.additions.clone()];
    let Some((last, before)) = fitted.additions.split_last() else { return states };
    let own = predict(study.forward, before).ok().map(|predicted| study.data.prepare(&predicted));
    let table = &study.table;
    let places = table.candidates.iter().filter(|candidate| candidate.addition.key() == last.key());
    let all = vec![1.0; study.data.experiments];
    let score = |prepared: &PreparedReadings| study.data.score(prepared, study.data.values(), &all);
    let all_places = places.flat_map(|one| one.places.iter().map(|place| (&one.addition, place)));
    let scored = all_places.filter_map(|(addition, place)| {
        let shifted = own.as_ref()?.shifted(&table.base_prepared, &place.prepared);
        Some((score(&shifted), addition.moved(&place.at)))
    });
    let scored: Vec<(f64, RigAddition)> = scored.chain([(score(&fitted.prepared), last.clone())]).collect();
    let best = scored.iter().map(|(score, _)| *score).fold(f64::NEG_INFINITY, f64::max);
    let total: f64 = scored.iter().map(|(score, _)| (score - best).exp()).sum();
    let step = total / (count - 1).max(1) as f64;
    let (mut sum, mut wanted) = (0.0, 0.5 * step);
    for (score, one) in scored {
        sum += (score - best).exp();
        while sum > wanted && states.len() < count {
            states.push([before, std::slice::from_ref(&one)].concat());
            wanted += step;
        }
    }
    states
}

/// The observables of the file with the usual error of each.
fn columns(
    study: &RigStudy<'_>,
    choice: &RigChoice,
    data: &RigMeasurements,
) -> Result<Vec<(RigReading, Usual)>, PredictionError> {
    let weights = vec![1.0; study.data.experiments];
    let scatter = study.data.scatter(&predict(study.forward, &choice.additions())?, &weights);
    let mut columns: Vec<(RigReading, Usual)> = Vec::new();
    let all = || data.experiments.iter().flat_map(|one| &one.readings);
    for reading in all() {
        if columns.iter().any(|(known, _)| known.column == reading.column) {
            continue;
        }
        let own = || all().filter(|one| one.column == reading.column);
        let count = median(own().filter_map(|one| one.count).collect());
        let error = median(own().filter_map(|one| one.error).collect());
        let kind = study.data.kinds.iter().position(|kind| *kind == reading.quantity.kind());
        let usual = match (error, kind.and_then(|kind| scatter.unstated.get(kind))) {
            (Some(error), _) => Usual::Error(error),
            (None, Some(scatter)) if count.is_none() || !reading.quantity.is_share() => {
                Usual::Scatter(*scatter, count.unwrap_or(1.0))
            }
            _ => {
                let correlation = kind.map_or(0.0, |kind| study.data.between(&scatter, kind, true));
                Usual::Share(count.unwrap_or(ASSUMED_COUNT), correlation)
            }
        };
        columns.push((reading.clone(), usual));
    }
    Ok(columns)
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// The proposals as a table that can be filled in: the columns of the data file.
pub(super) fn table(rows: &[NextExperiment]) -> String {
    let keys = distinct(rows.iter().flat_map(|row| row.settings.iter().map(|(key, _)| key)));
    let observables = distinct(rows.iter().map(|row| &row.observable));
    let mut header: Vec<String> = vec!["experiment".to_owned()];
    header.extend(keys.iter().cloned());
    for observable in &observables {
        let stated = rows.iter().any(|row| row.observable == *observable && row.error.is_some());
        header.extend([observable.clone(), format!("{observable}_{}", if stated { "err" } else { "n" })]);
    }
    header.extend(["tells_causes_nats".to_owned(), "pins_numbers_nats".to_owned()]);
    let mut lines = vec![header];
    for (number, row) in rows.iter().enumerate() {
        let mut cells = vec![format!("next {}", number + 1)];
        let cell = |key: &String| row.settings.iter().find(|(known, _)| known == key).map(|(_, cell)| cell);
        cells.extend(keys.iter().map(|key| cell(key).cloned().unwrap_or_default()));
        for observable in &observables {
            let wanted = match (row.error, row.repeats) {
                _ if *observable != row.observable => String::new(),
                (Some(error), _) => format!("{error:.2e}"),
                (None, repeats) => repeats.map_or(String::new(), |repeats| repeats.to_string()),
            };
            cells.extend([String::new(), wanted]);
        }
        cells.extend([format!("{:.2}", row.tells_causes), format!("{:.2}", row.pins_numbers)]);
        lines.push(cells);
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let written = lines.iter().try_for_each(|cells| writer.write_record(cells));
    // Nothing fails in memory.
    let bytes = written.ok().and_then(|()| writer.into_inner().ok()).unwrap_or_default();
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cause(name: &str, states: usize) -> Cause {
        Cause { name: name.to_owned(), weight: 1.0, states: vec![Vec::new(); states] }
    }

    fn shares(predicted: &[f64]) -> Possible {
        let [predicted, left] = [predicted.to_vec(), predicted.to_vec()];
        Possible { place: [0, 0], usual: Usual::Share(100.0, 0.0), predicted, left }
    }

    #[test]
    fn no_count_decides_where_two_causes_predict_the_same() {
        let causes = [cause("one", 2), cause("other", 2)];
        let ensemble = Ensemble::new(&causes);
        let row =
            |predicted: &[f64]| ensemble.row(&shares(predicted), &causes, Vec::new(), "captured@target");
        let same = row(&[0.3, 0.7, 0.3, 0.7]);
        assert_eq!((same.repeats, same.tells_causes), (None, 0.0));
        assert!(same.pins_numbers > 1.0, "{same:?}");
        assert!(table(&[same]).ends_with("next 1,,,0.00,1.42\n"));
        // 2 ln(e³) p (1 - p) / 0.2².
        let apart = row(&[0.4, 0.4, 0.6, 0.6]);
        assert_eq!(apart.repeats, Some(38));
        assert_eq!(apart.pins_numbers, 0.0);
    }

    /// Two normal densities of one middle, with variances of 1 and 4 times that of a reading: the
    /// information on which it is by integration.
    #[test]
    fn a_cause_that_leaves_a_reading_open_is_told_from_one_that_does_not() {
        let causes = [cause("sure", 1), cause("open", 40)];
        let ensemble = Ensemble::new(&causes);
        let density = |x: f64, sigma: f64| (-0.5 * (x / sigma).powi(2)).exp() / (sigma * 2.506_628_274_631);
        let at = |x: f64| {
            let both = [density(x, 1.0), density(x, 2.0)];
            let mean = 0.5 * (both[0] + both[1]);
            both.iter().map(|one| 0.5 * one * (one / mean).ln()).sum::<f64>()
        };
        let information: f64 = (-1200..=1200).map(|i| 0.01 * at(0.01 * f64::from(i))).sum();
        let mut predicted = vec![0.5];
        // Even in probability: the quantiles of a normal distribution of three times the variance of the reading.
        let normal = statrs::distribution::Normal::new(0.5, (3.0 * 0.0025_f64).sqrt()).unwrap();
        let quantile =
            |i: u32| statrs::distribution::ContinuousCDF::inverse_cdf(&normal, (f64::from(i) + 0.5) / 40.0);
        predicted.extend((0..40).map(quantile));
        let one = shares(&predicted);
        let told = ensemble.tells(&ensemble.with(&ensemble.unmeasured(), &one, 100.0));
        assert!((told - information).abs() < 0.02, "{told} {information}");
    }

    #[test]
    fn stated_errors_ask_for_an_error() {
        let causes = [cause("one", 1), cause("other", 1)];
        let one = Possible { usual: Usual::Error(0.02), ..shares(&[0.5, 0.51]) };
        let row = Ensemble::new(&causes).row(&one, &causes, Vec::new(), "mean_e_n@target");
        assert_eq!(row.repeats, Some(24));
        let text = table(&[row]);
        assert!(text.starts_with("experiment,mean_e_n@target,mean_e_n@target_err,"), "{text}");
        assert!(text.contains("next 1,,4.08e-3,"), "{text}");
    }

    #[test]
    fn a_reading_that_tells_the_same_is_worth_less_once_the_first_is_measured() {
        let causes = [cause("one", 2), cause("other", 2)];
        let ensemble = Ensemble::new(&causes);
        let first = shares(&[0.3, 0.3, 0.7, 0.7]);
        let (mut same, mut new) = (shares(&[0.3, 0.3, 0.7, 0.7]), shares(&[0.3, 0.7, 0.3, 0.7]));
        let pins = ensemble.pins(&new);
        ensemble.regress(&mut same, &first);
        ensemble.regress(&mut new, &first);
        let once = ensemble.with(&ensemble.unmeasured(), &first, 100.0);
        let told = ensemble.tells(&once);
        assert!(ensemble.tells(&ensemble.with(&once, &same, 100.0)) - told < 0.1 * told);
        assert_eq!(ensemble.pins(&new), pins);
    }
}
