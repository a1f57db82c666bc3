//! The readings of a rig with their noise, and the log likelihood of predictions.
//!
//! A share with a count is a beta-binomial; a reading with a stated error is normal; both have a
//! scatter between runs ([`super::scatter`]) over which the likelihood is averaged, so that it is no
//! number to be fitted. Readings of one kind without error and count share one normal scatter,
//! which is fitted, larger the smaller a count they rest on.
//!
//! Every explanation has the same errors. The Monte Carlo variance that adds to a reading's is that
//! of the base model, whatever is compared: all laws follow the same particles with the same random
//! numbers, and with a variance of its own the law that is simulated worst would be forgiven most.
//! Only what a replay cannot know ([`PredictedReading::doubt`]) widens a single prediction.

mod case_error;

use rand_chacha::ChaCha8Rng;
use rand_distr::{Beta, Binomial, Distribution as _, StandardNormal};

use super::scatter::{CountDensity, GRID, Group, GroupedReading, NormalDensity, OverGrid, log_sum, regular};
use crate::dataset::Experiment;
use crate::rig::{PredictedReading, away_from_edges, changed};

/// Number of kinds of observables.
const KINDS: usize = 8;
/// Scatter of readings without a stated error before they are seen, which counts as one reading
/// more: of a single particle where counts are given, otherwise of a reading [1]. Without it a few
/// readings could be met exactly by chance.
const PRIOR_SCATTER: [f64; 2] = [0.1, 0.01];

/// What is known of the error of a reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::diagnose) enum Noise {
    /// A share of so many.
    Counted(f64),
    /// Standard error [1].
    Stated(f64),
    /// The scatter of a kind of readings, by place, with a factor on its variance.
    Shared { kind: usize, factor: f64 },
}

/// A reading.
#[derive(Debug, Clone)]
pub(in crate::diagnose) struct Datum {
    /// Index of the experiment.
    pub experiment: usize,
    /// Place among the readings of the experiment.
    pub place: usize,
    /// Place in [`Data::kinds`].
    pub kind: usize,
    pub value: f64,
    pub noise: Noise,
}

/// All readings.
#[derive(Debug, Clone)]
pub(in crate::diagnose) struct Data {
    pub readings: Vec<Datum>,
    /// Kinds of observables.
    pub kinds: Vec<&'static str>,
    /// Prior variance of each kind [1].
    prior: Vec<f64>,
    /// Number of experiments.
    pub experiments: usize,
    /// Readings that share a scatter between runs.
    groups: Vec<Group>,
    /// What is known of each reading with a stated error or a count; see [`Noise`].
    known: Vec<Option<KnownError>>,
    /// The measured values.
    measured: ReadingValues,
    /// Changes of the predictions by errors of the case, by direction; see [`case_error`].
    case_errors: Vec<Vec<f64>>,
    /// The same by number of the case.
    case_changes: Vec<Vec<f64>>,
}

/// A reading with a stated error or a count in its group.
#[derive(Debug, Clone)]
struct KnownError {
    /// Place in [`Data::groups`].
    group: usize,
    reading: GroupedReading,
    /// Of a stated error.
    normal: Option<NormalDensity>,
}

/// The scatter that was fitted to readings.
#[derive(Debug, Clone, Default)]
pub(in crate::diagnose) struct FittedScatter {
    /// Of each kind without errors and counts [1].
    pub unstated: Vec<f64>,
    /// Of each group, squared: of a stated error the standard deviation, of a count the
    /// correlation [1]. None: as stated.
    between: Vec<f64>,
}

/// Predictions of all readings, prepared for many values of the data.
#[derive(Debug, Clone)]
pub(in crate::diagnose) struct PreparedReadings {
    rows: Vec<PreparedReading>,
}

impl PreparedReadings {
    /// With the change from one prediction to another added: in log odds of a share of a count.
    pub fn shifted(&self, from: &Self, to: &Self) -> Self {
        use PreparedReading::{Normal, Share, Shared};
        let row = |((own, from), to): ((&PreparedReading, &PreparedReading), &PreparedReading)| match (
            *own, *from, *to,
        ) {
            (Share { log_odds, trust }, Share { log_odds: from, .. }, Share { log_odds: to, .. }) => {
                Share { log_odds: log_odds + (to - from), trust }
            }
            (Normal { mean, trust }, Normal { mean: from, .. }, Normal { mean: to, .. }) => {
                Normal { mean: mean + (to - from), trust }
            }
            (Shared { kind, mean, weight }, Shared { mean: from, .. }, Shared { mean: to, .. }) => {
                Shared { kind, mean: mean + (to - from), weight }
            }
            _ => *own,
        };
        Self { rows: self.rows.iter().zip(&from.rows).zip(&to.rows).map(row).collect() }
    }
}

/// The distance of a value `y` from a prediction.
#[derive(Debug, Clone, Copy)]
enum PreparedReading {
    /// A count about a share with these log odds.
    Share { log_odds: f64, trust: Trust },
    /// `(y - mean)²`.
    Normal { mean: f64, trust: Trust },
    /// Adds `(y - mean)² weight` to the sum of its kind.
    Shared { kind: usize, mean: f64, weight: f64 },
}

/// Variance of a reading over that with the doubt of a replay [1], and half its logarithm [nats].
#[derive(Debug, Clone, Copy)]
struct Trust {
    share: f64,
    half_log: f64,
}

impl Trust {
    fn new(variance: f64, doubt: f64) -> Self {
        let share = variance / (variance + doubt);
        Self { share, half_log: 0.5 * share.ln() }
    }
}

/// Values of all readings, measured or drawn.
#[derive(Debug, Clone, Default)]
pub(in crate::diagnose) struct ReadingValues {
    value: Vec<f64>,
    /// Of a share of a count: its density.
    counted: Vec<Option<CountDensity>>,
}

/// Values with the weights of their experiments, ready to be compared with many predictions.
#[derive(Debug)]
pub(in crate::diagnose) struct WeightedValues<'a> {
    values: &'a ReadingValues,
    groups: Vec<WeightedGroup<'a>>,
    /// Readings that share a fitted scatter: index and weight.
    shared: Vec<(usize, f64)>,
}

#[derive(Debug)]
struct WeightedGroup<'a> {
    group: &'a Group,
    /// Index, weight, and of a stated error its density.
    readings: Vec<(usize, f64, Option<&'a NormalDensity>)>,
}

/// Every reading with its noise, and the names of their kinds.
fn readings(experiments: &[Experiment]) -> (Vec<Datum>, Vec<&'static str>) {
    let mut kinds: Vec<&'static str> = Vec::new();
    let mut readings = Vec::new();
    for (experiment, one) in experiments.iter().enumerate() {
        for (place, reading) in one.readings.iter().enumerate() {
            let name = reading.quantity.kind();
            let kind = kinds.iter().position(|kind| *kind == name).unwrap_or_else(|| {
                kinds.push(name);
                kinds.len() - 1
            });
            let noise = match (reading.error, reading.count) {
                (Some(error), _) => Noise::Stated(error),
                (None, Some(count)) if reading.quantity.is_share() => Noise::Counted(count),
                (None, count) => Noise::Shared { kind, factor: 1.0 / count.unwrap_or(1.0) },
            };
            readings.push(Datum { experiment, place, kind, value: reading.value, noise });
        }
    }
    (readings, kinds)
}

impl Data {
    /// The readings of experiments; `base` are the predictions of the base model, whose Monte Carlo
    /// variance all explanations share.
    pub fn new(experiments: &[Experiment], base: &[PredictedReading]) -> Self {
        let (readings, kinds) = readings(experiments);
        let counted = |kind: usize| {
            readings.iter().any(|one: &Datum| {
                one.kind == kind && matches!(one.noise, Noise::Shared { factor, .. } if factor < 1.0)
            })
        };
        let prior = (0..kinds.len()).map(|kind| PRIOR_SCATTER[usize::from(!counted(kind))].powi(2)).collect();
        let is_share =
            |datum: &Datum| experiments[datum.experiment].readings[datum.place].quantity.is_share();
        let grouped: Vec<_> =
            readings.iter().zip(base).map(|(datum, base)| grouped(datum, base, is_share(datum))).collect();
        let (groups, known) = groups(&readings, &grouped, kinds.len());
        let measured = ReadingValues::default();
        let mut data = Self {
            readings,
            kinds,
            prior,
            experiments: experiments.len(),
            groups,
            known,
            measured,
            case_errors: Vec::new(),
            case_changes: Vec::new(),
        };
        data.measured = data.ready(data.readings.iter().map(|datum| datum.value).collect());
        data
    }

    /// The measured values.
    pub fn values(&self) -> &ReadingValues {
        &self.measured
    }

    /// Values, ready to be compared with predictions.
    fn ready(&self, value: Vec<f64>) -> ReadingValues {
        let counted = |(value, known): (&f64, &Option<KnownError>)| {
            let known = known.as_ref().filter(|known| known.normal.is_none())?;
            Some(self.groups[known.group].counted(&known.reading, *value))
        };
        let counted = value.iter().zip(&self.known).map(counted).collect();
        ReadingValues { value, counted }
    }

    /// The readings of experiments with a weight, and the weight.
    fn inside<'a>(&'a self, weights: &'a [f64]) -> impl Iterator<Item = (usize, f64)> + 'a {
        let weighted = self.readings.iter().enumerate().map(|(i, datum)| (i, weights[datum.experiment]));
        weighted.filter(|(_, weight)| *weight > 0.0)
    }

    /// Number of readings of experiments with a weight.
    pub fn count(&self, weights: &[f64]) -> usize {
        self.inside(weights).count()
    }

    pub fn prepare(&self, predicted: &[PredictedReading]) -> PreparedReadings {
        let row = |((datum, known), one): ((&Datum, &Option<KnownError>), &PredictedReading)| {
            let one = existing(one, datum.value);
            match (datum.noise, known) {
                (Noise::Shared { kind, factor }, _) => {
                    PreparedReading::Shared { kind, mean: one.value, weight: 1.0 / factor }
                }
                (Noise::Counted(count), _) => {
                    let p = away_from_edges(one.value);
                    let trust = Trust::new(p * (1.0 - p) / count, one.doubt);
                    PreparedReading::Share { log_odds: log_odds_of(one.value), trust }
                }
                (Noise::Stated(error), known) => {
                    let own = known.as_ref().map_or(error * error, |known| known.reading.own);
                    PreparedReading::Normal { mean: one.value, trust: Trust::new(own, one.doubt) }
                }
            }
        };
        let rows = self.readings.iter().zip(&self.known).zip(predicted).map(row).collect();
        PreparedReadings { rows }
    }

    /// The same predictions where at most a share of what is captured is [1].
    pub fn below(&self, prepared: &PreparedReadings, ceiling: f64) -> PreparedReadings {
        use PreparedReading::{Normal, Share, Shared};
        let row = |(datum, own): (&Datum, &PreparedReading)| match *own {
            _ if !self.kinds[datum.kind].starts_with("capture") => *own,
            Share { log_odds, trust } => {
                Share { log_odds: log_odds_of(ceiling / (1.0 + (-log_odds).exp())), trust }
            }
            Normal { mean, trust } => Normal { mean: ceiling * mean, trust },
            Shared { kind, mean, weight } => Shared { kind, mean: ceiling * mean, weight },
        };
        PreparedReadings { rows: self.readings.iter().zip(&prepared.rows).map(row).collect() }
    }

    /// Values with the weights of their experiments.
    pub fn weighted<'a>(&'a self, values: &'a ReadingValues, weights: &[f64]) -> WeightedValues<'a> {
        let mut groups: Vec<WeightedGroup<'a>> =
            self.groups.iter().map(|group| WeightedGroup { group, readings: Vec::new() }).collect();
        let mut shared = Vec::new();
        for (index, times) in self.inside(weights) {
            let Some(known) = &self.known[index] else {
                shared.push((index, times));
                continue;
            };
            groups[known.group].readings.push((index, times, known.normal.as_ref()));
        }
        WeightedValues { values, groups, shared }
    }

    /// Log likelihood of the measured values of each experiment with a weight [nats]. Their sum is that of all
    /// together: what the scatter between runs, which they share, adds to it is spread evenly.
    pub fn shares(&self, prepared: &PreparedReadings, weights: &[f64]) -> Vec<f64> {
        let each = self.log_scores(prepared, &self.measured, weights);
        let inside = each.iter().zip(weights).filter(|(_, weight)| **weight > 0.0);
        let inside: Vec<f64> = inside.map(|(score, _)| *score).collect();
        let all = self.score(prepared, &self.measured, weights);
        let rest = (all - inside.iter().sum::<f64>()) / inside.len().max(1) as f64;
        inside.iter().map(|score| score + rest).collect()
    }

    /// Log likelihood of values under predictions, each experiment with its weight [nats].
    pub fn score(&self, prepared: &PreparedReadings, values: &ReadingValues, weights: &[f64]) -> f64 {
        self.score_weighted(prepared, &self.weighted(values, weights))
    }

    /// The same of weighted values, averaged over the errors of the case.
    pub fn score_weighted(&self, prepared: &PreparedReadings, weighted: &WeightedValues<'_>) -> f64 {
        self.settled(prepared, weighted).score
    }

    /// The same as if the case had no errors.
    fn score_as_is(&self, prepared: &PreparedReadings, weighted: &WeightedValues<'_>) -> f64 {
        let known = weighted.groups.iter().filter(|one| !one.readings.is_empty());
        let known: f64 =
            known.map(|one| one.group.log_mean(&one.likelihood(prepared, weighted.values))).sum();
        known + self.score_unstated(prepared, weighted)
    }

    /// Log likelihood of the readings that share a fitted scatter [nats].
    fn score_unstated(&self, prepared: &PreparedReadings, weighted: &WeightedValues<'_>) -> f64 {
        let mut sums = [(0.0, 0.0); KINDS];
        for (index, times) in &weighted.shared {
            if let PreparedReading::Shared { kind, mean, weight } = prepared.rows[*index] {
                let sum = &mut sums[kind.min(KINDS - 1)];
                sum.0 += times;
                sum.1 += times * weight * (weighted.values.value[*index] - mean).powi(2);
            }
        }
        let of = |((count, sum), prior): ((f64, f64), &f64)| {
            let variance: f64 = (sum + prior) / (count + 1.0);
            if count > 0.0 { -0.5 * (count + 1.0) * variance.ln() } else { 0.0 }
        };
        sums.into_iter().zip(&self.prior).map(of).sum()
    }

    /// Log density of the readings of each experiment under predictions, with the scatter that the
    /// experiments with weights tell [nats]: of one without a weight its predictive density.
    pub fn log_scores(
        &self,
        prepared: &PreparedReadings,
        values: &ReadingValues,
        weights: &[f64],
    ) -> Vec<f64> {
        let mut scores = vec![0.0; self.experiments];
        let all = self.weighted(values, weights);
        let prepared = &self.settled(prepared, &all).prepared;
        let told = all.groups.iter().map(|one| one.group.probabilities(&one.likelihood(prepared, values)));
        let told: Vec<OverGrid> = told.map(|one| one.map(f64::ln)).collect();
        let unstated = self.unstated_of(prepared, &all);
        for (experiment, score) in scores.iter_mut().enumerate() {
            let mut only = vec![0.0; self.experiments];
            only[experiment] = 1.0;
            let own = self.weighted(values, &only);
            for (one, told) in own.groups.iter().zip(&told).filter(|(one, _)| !one.readings.is_empty()) {
                let likelihood = one.likelihood(prepared, values);
                *score += log_sum(&std::array::from_fn(|place| told[place] + likelihood[place]));
            }
            for (index, _) in &own.shared {
                if let PreparedReading::Shared { kind, mean, weight } = prepared.rows[*index] {
                    let variance = unstated[kind].powi(2) / weight;
                    *score -= 0.5 * variance.ln() + 0.5 * (values.value[*index] - mean).powi(2) / variance;
                }
            }
        }
        scores
    }

    /// Largest gain of any other predictions [nats].
    pub fn room(&self, predicted: &[PredictedReading], weights: &[f64]) -> f64 {
        let exact =
            |(datum, one): (&Datum, &PredictedReading)| PredictedReading { value: datum.value, ..*one };
        let exact: Vec<PredictedReading> = self.readings.iter().zip(predicted).map(exact).collect();
        let score = |all: &[PredictedReading]| self.score(&self.prepare(all), self.values(), weights);
        score(&exact) - score(predicted)
    }

    /// The scatter that is left about predictions.
    pub fn scatter(&self, predicted: &[PredictedReading], weights: &[f64]) -> FittedScatter {
        let values = self.values();
        let weighted = self.weighted(values, weights);
        let prepared = self.settled(&self.prepare(predicted), &weighted).prepared;
        let mean = |one: &WeightedGroup<'_>| {
            let probabilities = one.group.probabilities(&one.likelihood(&prepared, values));
            probabilities.iter().zip(&one.group.squares).map(|(p, square)| p * square).sum()
        };
        FittedScatter {
            unstated: self.unstated_of(&prepared, &weighted),
            between: weighted.groups.iter().map(mean).collect(),
        }
    }

    /// The scatter between runs, squared, of the counted or stated readings of a kind [1].
    pub fn between(&self, scatter: &FittedScatter, kind: usize, counted: bool) -> f64 {
        let mut all = self.groups.iter().zip(&scatter.between);
        let found = all.find(|(group, _)| group.kind == kind && group.counted == counted);
        found.map_or(0.0, |(_, square)| *square)
    }

    /// A sentence on each kind of readings that scatter as much as their errors again, or more.
    pub fn scatter_notes(&self, scatter: &FittedScatter) -> Vec<String> {
        let note = |(group, square): (&Group, &f64)| {
            let name = self.kinds[group.kind];
            let deviation = if group.counted { 0.5 * square.sqrt() } else { square.sqrt() };
            let of = if group.counted { "their counts (at a share of one half)" } else { "their errors" };
            (*square >= group.unit).then(|| {
                format!("Readings of {name} scatter from run to run by {deviation:.2e} beyond {of}: all causes are \
                    judged with it.")
            })
        };
        self.groups.iter().zip(&scatter.between).filter_map(note).collect()
    }

    /// Readings that are more probably gross errors than not: index and that probability [1].
    pub fn gross_errors(&self, predicted: &[PredictedReading], weights: &[f64]) -> Vec<(usize, f64)> {
        let values = self.values();
        let all = self.weighted(values, weights);
        let prepared = &self.settled(&self.prepare(predicted), &all).prepared;
        let of_group = |group: &WeightedGroup<'_>| -> Vec<(usize, f64)> {
            let told = group.group.probabilities(&group.likelihood(prepared, values));
            let one = |reading: &(usize, f64, Option<&NormalDensity>)| {
                let single = WeightedGroup { group: group.group, readings: vec![*reading] };
                let regular = regular(&single.likelihood(prepared, values));
                (reading.0, told.iter().zip(regular).map(|(told, regular)| told * (1.0 - regular)).sum())
            };
            group.readings.iter().map(one).filter(|(_, gross)| *gross > 0.5).collect()
        };
        all.groups.iter().flat_map(of_group).collect()
    }

    /// Fitted scatter of each kind without errors and counts [1].
    fn unstated_of(&self, prepared: &PreparedReadings, weighted: &WeightedValues<'_>) -> Vec<f64> {
        let mut sums = vec![(0.0, 0.0); self.kinds.len()];
        for (index, _) in &weighted.shared {
            if let PreparedReading::Shared { kind, mean, weight } = prepared.rows[*index] {
                sums[kind].0 += 1.0;
                sums[kind].1 += (weighted.values.value[*index] - mean).powi(2) * weight;
            }
        }
        let scatter = |((count, sum), prior): ((f64, f64), &f64)| ((sum + prior) / (count + 1.0)).sqrt();
        sums.into_iter().zip(&self.prior).map(scatter).collect()
    }

    /// Variance of a reading about a prediction [1].
    pub fn variance(&self, index: usize, one: &PredictedReading, scatter: &FittedScatter) -> f64 {
        let known = self.known[index].as_ref();
        let between = known.and_then(|known| scatter.between.get(known.group)).copied().unwrap_or(0.0);
        let own = known.map_or(GroupedReading { own: 0.0, with: 0.0, misfit: 0.0 }, |known| known.reading);
        let variance = match self.readings[index].noise {
            Noise::Counted(count) => {
                let p = away_from_edges(one.value);
                p * (1.0 - p) / count * (1.0 + (count - 1.0).max(0.0) * (between + own.with))
            }
            Noise::Stated(_) => own.own + between * own.with,
            Noise::Shared { kind, factor } => {
                factor * scatter.unstated.get(kind).copied().unwrap_or(0.0).powi(2)
            }
        };
        variance + one.doubt
    }

    /// Chi-square of those of these readings that have a known error, as they and the case state it, and their number.
    pub fn chi_square(&self, predicted: &[PredictedReading], readings: &[usize]) -> (f64, usize) {
        let is_known = |index: &usize| !matches!(self.readings[*index].noise, Noise::Shared { .. });
        let known: Vec<usize> = readings.iter().copied().filter(is_known).collect();
        let fit = self.case_fit(&known, predicted, &FittedScatter::default());
        (fit.chi_square - fit.carried.iter().sum::<f64>(), known.len())
    }

    /// Indices of the readings of experiments with a weight that are no gross errors about predictions.
    pub fn regular(&self, predicted: &[PredictedReading], weights: &[f64]) -> Vec<usize> {
        let gross = self.gross_errors(predicted, weights);
        let is_regular = |index: &usize| gross.iter().all(|(one, _)| one != index);
        self.inside(weights).map(|(index, _)| index).filter(is_regular).collect()
    }

    /// A predicted value that a reading can have, and its variance beside the reading's value.
    fn residual(&self, index: usize, one: &PredictedReading, scatter: &FittedScatter) -> [f64; 2] {
        let value = self.readings[index].value;
        let one = &existing(one, value);
        let centre = match self.readings[index].noise {
            Noise::Counted(_) => away_from_edges(one.value),
            _ => one.value,
        };
        [value - centre, self.variance(index, one, scatter)]
    }

    /// Values as predictions would give them, with a new error and a new scatter each, and with new
    /// errors of the case.
    pub fn draw(
        &self,
        predicted: &[PredictedReading],
        scatter: &FittedScatter,
        random: &mut ChaCha8Rng,
    ) -> ReadingValues {
        let errors: Vec<f64> = self.case_errors.iter().map(|_| StandardNormal.sample(random)).collect();
        let mut one = |(index, datum): (usize, &Datum)| {
            let one = &existing(&predicted[index], datum.value);
            let normal: f64 = StandardNormal.sample(random);
            let change: f64 =
                self.case_errors.iter().zip(&errors).map(|(own, error)| own[index] * error).sum();
            match datum.noise {
                Noise::Counted(count) => {
                    let p = away_from_edges(changed(true, one.value, change));
                    // Of a beta distribution with the variance beyond that of the count.
                    let binomial = p * (1.0 - p) / count;
                    let beyond = (self.variance(index, one, scatter) - binomial) / (p * (1.0 - p));
                    let size = (1.0 - beyond) / beyond;
                    let run = Beta::new(p * size, (1.0 - p) * size).map_or(p, |law| law.sample(random));
                    let drawn = Binomial::new(count.round() as u64, run).map(|law| law.sample(random));
                    drawn.map_or(p, |drawn| drawn as f64 / count.round())
                }
                _ => one.value + change + self.variance(index, one, scatter).sqrt() * normal,
            }
        };
        self.ready(self.readings.iter().enumerate().map(&mut one).collect())
    }
}

impl WeightedGroup<'_> {
    /// Log likelihood of its readings for each scatter of the grid [nats].
    fn likelihood(&self, prepared: &PreparedReadings, values: &ReadingValues) -> OverGrid {
        let mut sums = [0.0; GRID];
        for (index, times, normal) in &self.readings {
            let value = values.value[*index];
            match (prepared.rows[*index], normal, &values.counted[*index]) {
                (PreparedReading::Normal { mean, trust }, Some(normal), _) => {
                    let density = normal.at(trust.share * (value - mean).powi(2), trust.half_log);
                    sums.iter_mut().zip(density).for_each(|(sum, one)| *sum += times * one);
                }
                (PreparedReading::Share { log_odds, trust }, _, Some(density)) => {
                    let here = density.at(log_odds);
                    // Only a replay has doubt.
                    let there = if trust.share < 1.0 { density.at(log_odds_of(value)) } else { here };
                    for ((sum, here), there) in sums.iter_mut().zip(here).zip(there) {
                        *sum += times * (there + trust.share * (here - there) + trust.half_log);
                    }
                }
                _ => {}
            }
        }
        sums
    }
}

/// What a group needs of a reading with a stated error or a count; none for others.
fn grouped(datum: &Datum, base: &PredictedReading, is_share: bool) -> Option<GroupedReading> {
    let existing = existing(base, datum.value);
    let misfit = (datum.value - existing.value).powi(2);
    match datum.noise {
        Noise::Shared { .. } => None,
        Noise::Counted(count) => {
            let p = away_from_edges(existing.value);
            let single = p * (1.0 - p);
            Some(GroupedReading { own: count, with: existing.variance / single, misfit: misfit / single })
        }
        Noise::Stated(error) => {
            // By the measured value alone, those that came out small would weigh most.
            let middle = 0.5 * (datum.value + existing.value).clamp(0.0, 2.0);
            let with = if is_share { 4.0 * middle * (1.0 - middle) } else { 1.0 };
            Some(GroupedReading { own: error * error + existing.variance, with, misfit })
        }
    }
}

/// The groups of readings, and each reading in its group.
fn groups(
    readings: &[Datum],
    grouped: &[Option<GroupedReading>],
    kinds: usize,
) -> (Vec<Group>, Vec<Option<KnownError>>) {
    let mut groups = Vec::new();
    let mut known: Vec<Option<KnownError>> = vec![None; readings.len()];
    for (kind, counted) in (0..kinds).flat_map(|kind| [(kind, false), (kind, true)]) {
        let is_member =
            |datum: &Datum| datum.kind == kind && matches!(datum.noise, Noise::Counted(_)) == counted;
        let members = || {
            let all = readings.iter().zip(grouped).enumerate().filter(|(_, (datum, _))| is_member(datum));
            all.filter_map(|(index, (_, one))| Some((index, (*one)?)))
        };
        let all: Vec<GroupedReading> = members().map(|(_, one)| one).collect();
        if all.is_empty() {
            continue;
        }
        let group = Group::new(kind, counted, &all);
        for (index, reading) in members() {
            let normal = (!counted).then(|| group.normal(&reading));
            known[index] = Some(KnownError { group: groups.len(), reading, normal });
        }
        groups.push(group);
    }
    (groups, known)
}

/// Log odds of a share that keeps away from 0 and 1.
fn log_odds_of(share: f64) -> f64 {
    let p = away_from_edges(share);
    (p / (1.0 - p)).ln()
}

/// A prediction that can be compared: where the model says that nothing happens that could be
/// measured, as no rebound, it is as wrong as it could be.
fn existing(one: &PredictedReading, measured: f64) -> PredictedReading {
    if one.value.is_finite() {
        return *one;
    }
    let value = if measured > 0.5 { 0.0 } else { 1.0 };
    PredictedReading { value, variance: 0.0, doubt: 0.0, ..*one }
}
