//! The log score of a measured row under a prediction.
//!
//! `e_n` and `e_t` of a rebound are normal about the prediction with the scatter `s`, except for a
//! share of 2 % gross errors: the density is `0.98 N(residual; s) + 0.02`, where the second
//! term is uniform between 0 and 1. So a few outliers cannot decide for or against a cause. Where tails are
//! heavy, a quarter of the readings is normal with four times the scatter instead (contaminated normal; Tukey 1960). A
//! capture scores `ln p`, a rebound `ln (1-p)`, with `p` within 0.005 to 0.995; a single impact with
//! `e_n` above 0 is a rebound whether or not an outcome is stated. Under a stochastic model, and
//! where a row does not state all inputs, the probability of a row is the mean over its predictions.
//! The scatter of an average of `n` impacts is `s/sqrt(n)`, or `s` combined with its stated standard
//! error. A value known to be below a limit has the probability of the normal distribution below it
//! instead of a density (Tobin 1958), and of a gross error one half.

use super::forecast::Prediction;
use crate::dataset::{Limit, Measurement, Reading};

/// Expected share of gross errors among many readings [1].
pub(super) const GROSS_SHARE: f64 = 0.02;
/// Density of a gross error [1]: uniform between 0 and 1.
pub(super) const GROSS_DENSITY: f64 = 1.0;
/// Scatter of a reading in a heavy tail, over that of the others [1].
const TAIL_WIDTH: f64 = 4.0;
/// Beyond this many standard deviations the normal density is negligible beside that of a gross error.
const NEGLIGIBLE_DISTANCE: f64 = 8.0;
/// A prediction is at most this many standard deviations beyond a limit: the tail's probability is still a number.
const FARTHEST_LIMIT: f64 = 30.0;
/// No outcome is predicted with more certainty than one minus this.
const UNCERTAINTY: f64 = 0.005;
/// Largest offset of the log odds of capture.
const LARGEST_ODDS: f64 = 10.0;
/// Smallest scatter of a restitution [1].
pub(super) const SMALLEST_SCATTER: f64 = 1e-3;

/// Scatter of single measurements of `e_n` and `e_t` about the prediction [1].
pub(super) type Scatter = [f64; 2];

/// Expected shares of the readings of one quantity that are not normal about the prediction with the scatter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outliers {
    /// Share of gross errors [1].
    pub gross: f64,
    /// Share of readings in a heavy tail [1].
    pub tails: f64,
}

impl Outliers {
    /// All readings are normal.
    pub const NONE: Self = Self { gross: 0.0, tails: 0.0 };
    /// What many readings of any laboratory have.
    pub const EXPECTED: Self = Self { gross: GROSS_SHARE, tails: 0.0 };

    fn is_none(self) -> bool {
        self == Self::NONE
    }
}

/// Correction of the prediction of one row, and what is known of its noise beside the scatter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Offset {
    /// Added to `e_n` and `e_t` [1].
    pub restitution: [f64; 2],
    /// Added to the log odds of capture [1].
    pub capture: f64,
    /// Factor on the probability of capture [1].
    pub ceiling: f64,
    /// Factor on the scatter [1].
    pub spread: f64,
    /// Variance of `e_n` and `e_t` due to the errors of the inputs [1].
    pub variance: [f64; 2],
    /// Step to which `e_n` and `e_t` are rounded, 0 where it is small [1].
    pub step: [f64; 2],
    /// Variance of the offsets of `e_n` and `e_t`, where they are estimates [1].
    pub uncertainty: [f64; 2],
    /// Least `e_n` that the instrument sees [1].
    pub visible_from: f64,
    /// Whether smaller ones are noted as captures rather than missing.
    pub noted: bool,
    /// Expected outliers of `e_n` and `e_t`.
    pub outliers: [Outliers; 2],
}

impl Default for Offset {
    fn default() -> Self {
        Self {
            restitution: [0.0; 2],
            capture: 0.0,
            ceiling: 1.0,
            spread: 1.0,
            variance: [0.0; 2],
            step: [0.0; 2],
            uncertainty: [0.0; 2],
            visible_from: f64::NEG_INFINITY,
            noted: false,
            outliers: [Outliers::EXPECTED; 2],
        }
    }
}

impl Offset {
    /// Variance of `e_n` (0) or `e_t` (1) that is no scatter: by errors of the inputs and by rounding [1].
    fn foreign_variance(&self, which: usize) -> f64 {
        self.variance[which] + rounding_variance(self.step[which])
    }
}

/// Predicted means of a row over its draws.
pub(super) struct Mean {
    /// `e_n` and `e_t` of the rebounds [1].
    pub restitution: [f64; 2],
    /// Their variances over the draws [1].
    pub variance: [f64; 2],
    /// Probability of capture [1].
    pub capture: f64,
}

/// The measured ones of `e_n` (0) and `e_t` (1).
fn readings(row: &Measurement) -> impl Iterator<Item = (usize, &Reading)> {
    [&row.e_n, &row.e_t].into_iter().enumerate().filter_map(|(which, one)| Some((which, one.as_ref()?)))
}

/// The censored ones of `e_n` (0) and `e_t` (1).
fn limits(row: &Measurement) -> impl Iterator<Item = (usize, &Limit)> {
    row.limits.iter().enumerate().filter_map(|(which, one)| Some((which, one.as_ref()?)))
}

/// A censored value under a normal distribution about its prediction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Censored {
    /// Probability that the value is beyond the limit as stated, gross errors included [1].
    pub probability: f64,
    /// Probability that it is no gross error [1].
    regular: f64,
    /// Slope of the log probability by the prediction [1], and minus its second derivative [1].
    pub slope: f64,
    pub information: f64,
    /// Expected square deviation of the value from the prediction [1].
    square: f64,
}

impl Censored {
    /// Of a value expected at `expected` with this standard deviation; of gross errors a share `gross` is expected.
    pub fn new(limit: &Limit, expected: f64, deviation: f64, gross: f64) -> Self {
        let sign = if limit.below { 1.0 } else { -1.0 };
        let z = sign * (limit.reading.value - expected) / deviation;
        let bounded = z.max(-FARTHEST_LIMIT);
        let tail = 0.5 * statrs::function::erf::erfc(-bounded / std::f64::consts::SQRT_2);
        // The ratio of density and tail; beyond the farthest limit it grows with the distance.
        let ratio = (-0.5 * bounded * bounded).exp() / std::f64::consts::TAU.sqrt() / tail + (bounded - z);
        let beyond = 0.5 * (bounded * bounded - z * z);
        let tail = tail * beyond.exp();
        let probability = ((1.0 - gross) * tail + 0.5 * gross).max(f64::MIN_POSITIVE);
        let regular = if gross > 0.0 { (1.0 - gross) * tail / probability } else { 1.0 };
        Self {
            probability,
            regular,
            slope: -sign * regular * ratio / deviation,
            information: regular * (ratio * (z + ratio)).clamp(0.0, 1.0) / (deviation * deviation),
            square: deviation * deviation * (1.0 - z * ratio),
        }
    }
}

/// The probability of capture with its offset, away from 0 and 1: no curve may gain from a claim of certainty.
#[inline]
fn capture(prediction: &Prediction, offset: &Offset) -> f64 {
    let plain = visible_capture(offset.ceiling * prediction.capture);
    if offset.capture == 0.0 {
        return plain;
    }
    let odds = plain / (1.0 - plain) * offset.capture.clamp(-LARGEST_ODDS, LARGEST_ODDS).exp();
    visible_capture(odds / (1.0 + odds))
}

/// A probability of capture [1] away from 0 and 1, as it is scored.
pub(super) fn visible_capture(probability: f64) -> f64 {
    UNCERTAINTY + (1.0 - 2.0 * UNCERTAINTY) * probability
}

/// The log odds of a probability of capture [1], which is kept away from 0 and 1.
pub(super) fn capture_odds(probability: f64) -> f64 {
    let end = (-LARGEST_ODDS).exp();
    let inside = probability.clamp(end, 1.0 - end);
    (inside / (1.0 - inside)).ln()
}

/// The means over the draws of a row.
#[inline]
pub(super) fn mean(predictions: &[Prediction], offset: &Offset) -> Mean {
    let (mut rebounds, mut captured, mut all) = (0.0, 0.0, 0.0);
    let (mut sum, mut squares) = ([0.0; 2], [0.0; 2]);
    for one in predictions {
        let p = capture(one, offset);
        let weight = (1.0 - p) * one.weight;
        captured += p * one.weight;
        all += one.weight;
        rebounds += weight;
        for (which, e) in one.restitution.into_iter().enumerate() {
            sum[which] += weight * e;
            squares[which] += weight * e * e;
        }
    }
    let plain = sum.map(|sum| sum / rebounds);
    Mean {
        restitution: [0, 1].map(|which| plain[which] + offset.restitution[which]),
        variance: [0, 1].map(|which| (squares[which] / rebounds - plain[which] * plain[which]).max(0.0)),
        capture: captured / all,
    }
}

/// The standard deviation of a reading about the prediction [1]; `variance` is that of the prediction.
#[inline]
fn deviation(
    scatter: f64,
    offset: &Offset,
    which: usize,
    reading: &Reading,
    rebounds: f64,
    variance: f64,
) -> f64 {
    let count = rebounds.max(1.0);
    let own = (scatter * offset.spread).powi(2);
    let own = match reading.error {
        Some(error) => own + error * error + variance / count,
        None => (own + variance) / count,
    };
    (own + offset.foreign_variance(which)).sqrt().max(SMALLEST_SCATTER)
}

fn normal_density(residual: f64, deviation: f64) -> f64 {
    let z = residual / deviation;
    if z.abs() > NEGLIGIBLE_DISTANCE {
        return 0.0;
    }
    (-0.5 * z * z).exp() / (deviation * (2.0 * std::f64::consts::PI).sqrt())
}

/// Densities of a residual [1]: of the normal part, of the heavy tail, and of gross errors. Without gross errors a far
/// residual keeps the density of a normal distribution.
fn densities(residual: f64, deviation: f64, Outliers { gross, tails }: Outliers) -> [f64; 3] {
    let tail = if tails > 0.0 { tails * normal_density(residual, TAIL_WIDTH * deviation) } else { 0.0 };
    let normal = (1.0 - gross - tails) * normal_density(residual, deviation);
    [normal, tail, (gross * GROSS_DENSITY).max(f64::MIN_POSITIVE)]
}

/// Density of a residual [1], rounded to multiples of `step`.
fn density(residual: f64, deviation: f64, outliers: Outliers, step: f64) -> f64 {
    if step > deviation {
        return rounded_density(residual, deviation, outliers, step);
    }
    densities(residual, deviation, outliers).iter().sum()
}

/// Log density of a residual.
fn log_density(residual: f64, deviation: f64, outliers: Outliers, step: f64) -> f64 {
    if !outliers.is_none() || step > deviation {
        return density(residual, deviation, outliers, step).ln();
    }
    let z = residual / deviation;
    -0.5 * z * z - deviation.ln() - 0.5 * std::f64::consts::TAU.ln()
}

/// Mean density over the step of a rounded residual [1]. About a step as wide as the scatter a normal distribution with
/// the variance of rounding is as good; about a wider one it would have more than all of the probability.
fn rounded_density(residual: f64, deviation: f64, Outliers { gross, tails }: Outliers, step: f64) -> f64 {
    let own = (deviation * deviation - rounding_variance(step)).sqrt().max(SMALLEST_SCATTER);
    let mean = |width: f64| {
        let below = |limit: f64| 0.5 * statrs::function::erf::erfc(-limit / width / std::f64::consts::SQRT_2);
        // From the nearer side, where the difference is exact.
        let near = -residual.abs();
        (below(near + 0.5 * step) - below(near - 0.5 * step)) / step
    };
    let tail = if tails > 0.0 { tails * mean(TAIL_WIDTH * own) } else { 0.0 };
    ((1.0 - gross - tails) * mean(own) + tail + gross * GROSS_DENSITY).max(f64::MIN_POSITIVE)
}

/// Variance of the error of rounding to a step [1] (Sheppard 1898).
fn rounding_variance(step: f64) -> f64 {
    step * step / 12.0
}

/// What a residual tells of the prediction.
pub(super) struct Weight {
    /// Probability that it is no gross error [1].
    pub regular: f64,
    /// Its expected inverse variance, in those of the scatter [1].
    pub precision: f64,
}

impl Weight {
    pub fn of(residual: f64, deviation: f64, outliers: Outliers) -> Self {
        if outliers.is_none() {
            return Self { regular: 1.0, precision: 1.0 };
        }
        let [normal, tail, gross] = densities(residual, deviation, outliers);
        let all = normal + tail + gross;
        let precision = (normal + tail / TAIL_WIDTH.powi(2)) / all;
        Self { regular: (normal + tail) / all, precision }
    }
}

/// The part of a normal distribution that an instrument does not see.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hidden {
    /// Its share [1].
    pub share: f64,
    /// Mean of the visible part beyond that of the whole, in standard deviations [1].
    pub shift: f64,
    /// Mean square deviation of the hidden part, in variances [1].
    pub square: f64,
}

impl Hidden {
    /// Of a distribution about `expected` with this deviation, below `visible_from`; `None` if all is visible.
    pub fn of(expected: f64, deviation: f64, visible_from: f64) -> Option<Self> {
        let limit = (visible_from - expected) / deviation;
        if limit < -NEGLIGIBLE_DISTANCE {
            return None;
        }
        let limit = limit.min(3.0);
        let share = 0.5 * statrs::function::erf::erfc(-limit / std::f64::consts::SQRT_2);
        let density = (-0.5 * limit * limit).exp() / std::f64::consts::TAU.sqrt();
        Some(Self { share, shift: density / (1.0 - share), square: 1.0 - limit * density / share })
    }
}

/// Density of a reading of `e_n` (0) or `e_t` (1) that the instrument sees.
fn visible_density(which: usize, residual: f64, expected: f64, deviation: f64, offset: &Offset) -> f64 {
    let whole = density(residual, deviation, offset.outliers[which], offset.step[which]);
    whole / visible_share(which, expected, deviation, offset)
}

/// Log density of a reading that the instrument sees.
fn visible_log_density(which: usize, residual: f64, expected: f64, deviation: f64, offset: &Offset) -> f64 {
    let visible = visible_share(which, expected, deviation, offset);
    log_density(residual, deviation, offset.outliers[which], offset.step[which]) - visible.ln()
}

/// Share of the readings about an expected one that the instrument sees [1].
fn visible_share(which: usize, expected: f64, deviation: f64, offset: &Offset) -> f64 {
    let regular = 1.0 - offset.outliers[which].gross;
    Hidden::of(expected, deviation, visible_from(offset, which))
        .map_or(1.0, |hidden| 1.0 - regular * hidden.share)
}

/// The least reading that the instrument sees: it has a limit for `e_n` alone.
fn visible_from(offset: &Offset, which: usize) -> f64 {
    if which == 0 && !offset.noted { offset.visible_from } else { f64::NEG_INFINITY }
}

/// The standard deviation of a reading, and the mean by which visible readings exceed the prediction [1].
#[inline]
pub(super) fn reading_noise(
    scatter: f64,
    offset: &Offset,
    which: usize,
    row: &Measurement,
    reading: &Reading,
    mean: &Mean,
) -> (f64, f64) {
    let width = deviation(scatter, offset, which, reading, row.rebounds, mean.variance[which]);
    let hidden = Hidden::of(mean.restitution[which], width, visible_from(offset, which));
    (width, hidden.map_or(0.0, |hidden| width * hidden.shift))
}

/// A censored value under the predicted mean.
pub(super) fn censored(
    scatter: f64,
    offset: &Offset,
    which: usize,
    row: &Measurement,
    limit: &Limit,
    mean: &Mean,
) -> Censored {
    let width = deviation(scatter, offset, which, &limit.reading, row.rebounds, mean.variance[which]);
    Censored::new(limit, mean.restitution[which], width, offset.outliers[which].gross)
}

/// Log score of one row [nats].
pub(super) fn score(row: &Measurement, predictions: &[Prediction], offset: &Offset, scatter: Scatter) -> f64 {
    if row.impacts > 1.0 {
        score_average(row, predictions, offset, scatter)
    } else {
        score_single(row, predictions, offset, scatter)
    }
}

/// Log density of the readings and limits of a row about the expected ones; `variance` is that of the prediction.
fn log_likelihood(
    row: &Measurement,
    expected: [f64; 2],
    variance: [f64; 2],
    offset: &Offset,
    scatter: Scatter,
) -> f64 {
    let width = |which: usize, reading: &Reading| {
        deviation(scatter[which], offset, which, reading, row.rebounds, variance[which])
    };
    let readings = readings(row).map(|(which, reading)| {
        let expected = expected[which];
        let residual = reading.value - expected;
        visible_log_density(which, residual, expected, width(which, reading), offset)
    });
    let limits = limits(row).map(|(which, limit)| {
        Censored::new(limit, expected[which], width(which, &limit.reading), offset.outliers[which].gross)
            .probability
            .ln()
    });
    readings.sum::<f64>() + limits.sum::<f64>()
}

/// The probability of capture, or of a rebound that is noted as one.
fn noted(one: &Prediction, offset: &Offset, scatter: Scatter, p: f64) -> f64 {
    if !offset.noted {
        return p;
    }
    let width = (scatter[0] * offset.spread).hypot(one.reach[0]).max(SMALLEST_SCATTER);
    let hidden = Hidden::of(shifted(one, offset)[0], width, offset.visible_from);
    (p + (1.0 - p) * hidden.map_or(0.0, |hidden| hidden.share)).min(1.0 - UNCERTAINTY)
}

/// `e_n` and `e_t` of a prediction with the offset.
fn shifted(one: &Prediction, offset: &Offset) -> [f64; 2] {
    [0, 1].map(|which| one.restitution[which] + offset.restitution[which])
}

fn score_single(row: &Measurement, predictions: &[Prediction], offset: &Offset, scatter: Scatter) -> f64 {
    let captured = row.captured.is_some_and(|share| share > 0.5);
    let known = row.captured.is_some() || row.is_unstated_rebound();
    if let [one] = predictions {
        let p = capture(one, offset);
        if captured {
            return noted(one, offset, scatter, p).ln();
        }
        let known = if known { (1.0 - p).ln() } else { 0.0 };
        return known + log_likelihood(row, shifted(one, offset), [0.0; 2], offset, scatter);
    }
    let (mut sum, mut rebounds, mut all) = (0.0, 0.0, 0.0);
    for one in predictions {
        let p = capture(one, offset);
        all += one.weight;
        if captured {
            sum += noted(one, offset, scatter, p) * one.weight;
            continue;
        }
        let mut density = 1.0;
        for (which, reading) in readings(row) {
            let width = deviation(scatter[which], offset, which, reading, 1.0, one.reach[which].powi(2));
            let expected = one.restitution[which] + offset.restitution[which];
            density *= visible_density(which, reading.value - expected, expected, width, offset);
        }
        for (which, limit) in limits(row) {
            let reach = one.reach[which].powi(2);
            let width = deviation(scatter[which], offset, which, &limit.reading, 1.0, reach);
            density *= Censored::new(limit, shifted(one, offset)[which], width, offset.outliers[which].gross)
                .probability;
        }
        sum += (1.0 - p) * one.weight * density;
        rebounds += (1.0 - p) * one.weight;
    }
    let sum = sum.max(f64::MIN_POSITIVE);
    // Where nothing tells whether the particle was captured, the row is a sample of the rebounds.
    if known { (sum / all).ln() } else { (sum / rebounds).ln() }
}

/// The predictions of a row for each choice of its missing inputs.
fn by_filling(predictions: &[Prediction]) -> impl Iterator<Item = &[Prediction]> {
    predictions.chunk_by(|one, other| one.filling == other.filling)
}

/// The impacts of an average have the same inputs, known or not.
fn score_average(row: &Measurement, predictions: &[Prediction], offset: &Offset, scatter: Scatter) -> f64 {
    let one = |predictions: &[Prediction]| {
        let mean = mean(predictions, offset);
        let captures = row.captured.map_or(0.0, |share| {
            row.impacts * (share * mean.capture.ln() + (1.0 - share) * (1.0 - mean.capture).ln())
        });
        captures + log_likelihood(row, mean.restitution, mean.variance, offset, scatter)
    };
    let scores: Vec<f64> = by_filling(predictions).map(one).collect();
    let most = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    most + (scores.iter().map(|score| (score - most).exp()).sum::<f64>() / scores.len() as f64).ln()
}

/// Adds a row's squared residuals and their weights, of `e_n` and `e_t`, for one step of expectation–maximisation.
pub(super) fn add_squares(
    sums: &mut [[f64; 2]; 2],
    row: &Measurement,
    predictions: &[Prediction],
    offset: &Offset,
    scatter: Scatter,
) {
    if row.captured.is_some_and(|share| share >= 1.0) {
        return;
    }
    let averages: Vec<Prediction>;
    let predictions = if row.impacts <= 1.0 || predictions.len() == 1 {
        predictions
    } else {
        averages = by_filling(predictions).map(|draws| average(draws, offset)).collect();
        &averages
    };
    // Of a single prediction the weight cancels: no density is needed.
    if let [one] = predictions {
        for seen in Seen::all(row, one, offset, scatter) {
            sums[seen.which].iter_mut().zip(seen.own_square()).for_each(|(sum, term)| *sum += term);
        }
        return;
    }
    // The weight of a draw is the likelihood of the row under it, over that of all draws.
    let (mut own, mut total) = ([[0.0; 2]; 2], 0.0);
    for one in predictions {
        let mut likelihood = (1.0 - capture(one, offset)) * one.weight;
        let mut terms = [[0.0; 2]; 2];
        for seen in Seen::all(row, one, offset, scatter) {
            likelihood *= seen.density();
            terms[seen.which] = seen.own_square();
        }
        for (sum, term) in own.iter_mut().flatten().zip(terms.as_flattened()) {
            *sum += likelihood * term;
        }
        total += likelihood;
    }
    if total > 0.0 {
        for (sum, own) in sums.iter_mut().flatten().zip(own.as_flattened()) {
            *sum += own / total;
        }
    }
}

/// The mean of draws as one prediction, without the offset.
fn average(draws: &[Prediction], offset: &Offset) -> Prediction {
    let mean = mean(draws, offset);
    let restitution = [0, 1].map(|which| mean.restitution[which] - offset.restitution[which]);
    let reach = mean.variance.map(f64::sqrt);
    Prediction { restitution, capture: mean.capture, weight: 1.0, reach, filling: 0 }
}

/// What was seen of `e_n` or `e_t`, beside one prediction.
struct Seen<'a> {
    /// 0 for `e_n`, 1 for `e_t`.
    which: usize,
    reading: &'a Reading,
    /// The limit, if the value is one.
    limit: Option<&'a Limit>,
    /// Number of rebounds of the row.
    rebounds: f64,
    offset: &'a Offset,
    /// Scatter of a single measurement [1].
    scatter: f64,
    /// The predicted value, the variance of this prediction, and the standard deviation of the reading [1].
    expected: f64,
    variance: f64,
    width: f64,
}

impl<'a> Seen<'a> {
    /// All of a row.
    fn all(
        row: &'a Measurement,
        one: &'a Prediction,
        offset: &'a Offset,
        scatter: Scatter,
    ) -> impl Iterator<Item = Self> {
        let readings = readings(row).map(|(which, reading)| (which, reading, None));
        let limits = limits(row).map(|(which, limit)| (which, &limit.reading, Some(limit)));
        readings.chain(limits).map(move |(which, reading, limit)| {
            let (scatter, variance) = (scatter[which], one.reach[which].powi(2));
            let width = deviation(scatter, offset, which, reading, row.rebounds, variance);
            let expected = one.restitution[which] + offset.restitution[which];
            Self { which, reading, limit, rebounds: row.rebounds, offset, scatter, expected, variance, width }
        })
    }

    /// Its density; of a limit its probability.
    fn density(&self) -> f64 {
        let Self { which, offset, expected, width, .. } = *self;
        match self.limit {
            Some(limit) => Censored::new(limit, expected, width, offset.outliers[which].gross).probability,
            None => visible_density(which, self.reading.value - expected, expected, width, offset),
        }
    }

    /// The square of its residual that is due to the scatter, with its weight.
    fn own_square(&self) -> [f64; 2] {
        let Self { which, offset, expected, variance, width, .. } = *self;
        let residual = self.reading.value - expected;
        let count = self.rebounds.max(1.0);
        let (foreign, count) = match self.reading.error {
            Some(error) => (error * error + variance / count, 1.0),
            None => (variance / count, count),
        };
        let foreign = foreign + offset.foreign_variance(which);
        // Fisher scoring for a variance that is partly known: rows in which the rest dominates say little.
        let own = (self.scatter * offset.spread).powi(2) / count;
        let share = (own / (own + foreign)).powi(2);
        let own_square = |square: f64, rows: f64| (square - rows * foreign) * count / offset.spread.powi(2);
        if let Some(limit) = self.limit {
            let censored = Censored::new(limit, expected, width, offset.outliers[which].gross);
            let weight = censored.regular * share;
            return [weight * own_square(censored.square + offset.uncertainty[which], 1.0), weight];
        }
        let Weight { regular, precision } = Weight::of(residual, width, offset.outliers[which]);
        let seen = residual * residual + offset.uncertainty[which];
        let (square, rows) = match Hidden::of(expected, width, visible_from(offset, which)) {
            None => (seen, 1.0),
            Some(hidden) => {
                let unseen = hidden.share / (1.0 - hidden.share);
                (seen + unseen * hidden.square * width * width, 1.0 + unseen)
            }
        };
        [share * own_square(precision * square, regular * rows), share * regular * rows]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::{Continuous, ContinuousCDF, Normal};

    /// Without gross errors.
    fn exact() -> Offset {
        Offset { outliers: [Outliers::NONE; 2], ..Offset::default() }
    }

    fn prediction(e_n: f64, capture: f64, filling: usize) -> Prediction {
        Prediction { restitution: [e_n, 0.7], capture, weight: 1.0, reach: [0.0; 2], filling }
    }

    fn row(e_n: Option<f64>, captured: Option<f64>, impacts: f64) -> Measurement {
        let e_n = e_n.map(|value| Reading { value, error: None });
        Measurement { e_n, captured, impacts, rebounds: impacts, ..Measurement::default() }
    }

    /// Tails, their means and mean squares of a normal distribution by sums over its density.
    #[test]
    fn a_censored_value_has_the_probability_and_the_moments_of_the_tail() {
        for (limit, expected, below) in
            [(0.2, 0.25, true), (0.2, 0.7, true), (0.9, 0.7, false), (0.9, 1.1, false)]
        {
            let (law, step) = (Normal::new(expected, 0.1).unwrap(), 1e-5);
            let side = if below { -1.0 } else { 1.0 };
            let moments = (0..200_000).fold([0.0; 3], |sums, place| {
                let value = limit + side * (f64::from(place) + 0.5) * step;
                let (share, from) = (law.pdf(value) * step, value - expected);
                [sums[0] + share, sums[1] + share * from, sums[2] + share * from * from]
            });
            let stated = Limit { reading: Reading { value: limit, error: None }, below };
            let found = Censored::new(&stated, expected, 0.1, 0.0);
            assert!(
                (found.probability / moments[0] - 1.0).abs() < 1e-5,
                "{} {}",
                found.probability,
                moments[0]
            );
            // The slope is that of the mean of the tail in variances (Fisher's identity), the square its second moment.
            let [mean, square] = [moments[1], moments[2]].map(|sum| sum / moments[0]);
            assert!((found.slope - mean / 0.01).abs() < 1e-3, "{} {mean}", found.slope);
            assert!((found.square - square).abs() < 1e-6, "{} {square}", found.square);
            let information = (1.0 - (square - mean * mean) / 0.01) / 0.01;
            assert!((found.information - information).abs() < 0.01, "{} {information}", found.information);
        }
    }

    #[test]
    fn far_beyond_its_limit_a_censored_value_is_a_reading_at_the_limit() {
        let stated = Limit { reading: Reading { value: 0.2, error: None }, below: true };
        let [near, far] = [4.0, 9.0].map(|expected| Censored::new(&stated, expected, 0.1, 0.0));
        for (found, distance) in [(near, 38.0), (far, 88.0)] {
            assert!((found.slope / (-10.0 * distance) - 1.0).abs() < 2e-3, "{found:?}");
            assert!((found.information / 100.0 - 1.0).abs() < 2e-3, "{found:?}");
        }
        assert!(Censored::new(&stated, 4.0, 0.1, 0.02).slope.abs() < 1e-9, "a gross error has no slope");
    }

    /// Three quarters of the density are normal with the scatter, a quarter with four times that; and what the weight
    /// says of a residual is the slope of the log density in units of the normal one.
    #[test]
    fn a_heavy_tail_has_its_density_and_its_weight() {
        let tails = Outliers { tails: 0.25, ..Outliers::NONE };
        let laws = [0.1, 0.4].map(|width| Normal::new(0.5, width).unwrap());
        let expected = |value: f64| (0.75 * laws[0].pdf(value) + 0.25 * laws[1].pdf(value)).ln();
        let score = |value: f64| log_density(value - 0.5, 0.1, tails, 0.0);
        for value in [0.5, 0.58, 0.75, 1.1] {
            assert!((score(value) - expected(value)).abs() < 1e-9, "{value}");
            let slope = (expected(value + 1e-6) - expected(value - 1e-6)) / 2e-6;
            let weight = Weight::of(value - 0.5, 0.1, tails);
            assert!((slope + weight.precision * (value - 0.5) / 0.01).abs() < 1e-4, "{value}");
            assert!((weight.regular - 1.0).abs() < 1e-9);
        }
    }

    /// The probabilities of all steps add up to one, and each is that of a normal distribution within the step.
    #[test]
    fn a_rounded_reading_has_the_probability_of_its_step() {
        let (step, scatter, law) = (0.05, 0.02, Normal::new(0.693, 0.02).unwrap());
        let width = f64::hypot(scatter, step / 12_f64.sqrt());
        let density = |value: f64, outliers: Outliers| density(value - 0.693, width, outliers, step);
        for value in [0.55, 0.65, 0.7, 0.75, 0.9] {
            let inside = law.cdf(value + 0.5 * step) - law.cdf(value - 0.5 * step);
            assert!((density(value, Outliers::NONE) * step - inside).abs() < 1e-9, "{value}");
        }
        let tails = Outliers { tails: 0.25, ..Outliers::NONE };
        let whole: f64 = (0..40).map(|place| density(f64::from(place) * step, tails) * step).sum();
        assert!((whole - 1.0).abs() < 1e-9, "{whole}");
    }

    #[test]
    fn a_rebound_without_an_outcome_scores_as_one() {
        let two = [prediction(0.5, 0.3, 0), prediction(0.2, 0.8, 0)];
        for predictions in [&two[..1], &two] {
            let of = |row: &Measurement| score(row, predictions, &exact(), [0.1; 2]);
            assert_eq!(of(&row(Some(0.4), None, 1.0)), of(&row(Some(0.4), Some(0.0), 1.0)));
            // An average over the rebounds among several impacts says nothing about captures.
            assert!(of(&row(Some(0.4), None, 3.0)) > of(&row(Some(0.4), Some(0.0), 3.0)));
        }
        let one = score(&row(Some(0.5), None, 1.0), &two[..1], &exact(), [0.1; 2]);
        let expected = (1.0 - (0.005 + 0.99 * 0.3_f64)).ln() + Normal::new(0.5, 0.1).unwrap().pdf(0.5).ln();
        assert!((one - expected).abs() < 1e-12, "{one}, {expected}");
    }

    /// All impacts of an average have the same unknown input; each single impact has its own.
    #[test]
    fn a_missing_input_of_an_average_is_the_same_for_all_its_impacts() {
        let cold_or_hot = [prediction(0.6, 0.0, 0), prediction(0.2, 0.0, 1)];
        let average = score(&row(Some(0.6), None, 25.0), &cold_or_hot, &exact(), [0.1; 2]);
        let law = Normal::new(0.6, 0.02).unwrap();
        let expected = (0.5 * law.pdf(0.6) + 0.5 * law.pdf(1.0)).ln();
        assert!((average - expected).abs() < 1e-9, "{average}, {expected}");
        assert!(law.cdf(0.6) == 0.5);
    }
}
