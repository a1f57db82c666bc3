//! The readings of a rig with their noise, and the log likelihood of predictions.
//!
//! A share with a count is binomial; a reading with a stated error is normal; readings of one kind
//! without either share one normal scatter, which is fitted, larger the smaller a count they rest
//! on. The Monte Carlo variance of a prediction adds to each.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Binomial, Distribution as _, StandardNormal};

use crate::dataset::Experiment;
use crate::rig::PredictedReading;

/// Distance that a predicted share keeps from 0 and 1 [1]: a stray particle must not refute a law.
const SHARE_MARGIN: f64 = 0.003;
/// Number of kinds of observables.
const KINDS: usize = 8;
/// Scatter of readings without a stated error before they are seen, which counts as one reading
/// more: of a single particle where counts are given, otherwise of a reading [1]. Without it a few
/// readings could be met exactly by chance.
const PRIOR_SCATTER: [f64; 2] = [0.1, 0.01];

/// What is known of the error of a reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Noise {
    /// A share of so many.
    Counted(f64),
    /// Standard error [1].
    Stated(f64),
    /// The scatter of a kind of readings, by place, with a factor on its variance.
    Shared { kind: usize, factor: f64 },
}

/// A reading.
#[derive(Debug, Clone)]
pub(super) struct Datum {
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
pub(super) struct Data {
    pub readings: Vec<Datum>,
    /// Kinds of observables.
    pub kinds: Vec<&'static str>,
    /// Prior variance of each kind [1].
    prior: Vec<f64>,
    /// Number of experiments.
    pub experiments: usize,
}

/// Predictions of all readings, prepared for many values of the data.
#[derive(Debug, Clone)]
pub(super) struct PreparedReadings {
    rows: Vec<PreparedReading>,
}

#[derive(Debug, Clone, Copy)]
enum PreparedReading {
    /// `slope y + constant + count h(y)`, with the entropy `h` of a share.
    Share { slope: f64, constant: f64, count: f64 },
    /// `constant - (y - mean)²/(2 variance)`.
    Normal { mean: f64, half: f64, constant: f64 },
    /// Adds `(y - mean)² weight` to the sum of its kind.
    Shared { kind: usize, mean: f64, weight: f64 },
}

/// Values of all readings, measured or drawn.
#[derive(Debug, Clone)]
pub(super) struct ReadingValues {
    value: Vec<f64>,
    /// Entropy of a share of this value [nats].
    entropy: Vec<f64>,
}

impl ReadingValues {
    fn new(value: Vec<f64>) -> Self {
        let of = |y: f64| if y > 0.0 { -y * y.ln() } else { 0.0 };
        let entropy = value.iter().map(|&y| of(y) + of(1.0 - y)).collect();
        Self { value, entropy }
    }
}

impl Data {
    pub fn new(experiments: &[Experiment]) -> Self {
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
        let counted = |kind: usize| {
            readings.iter().any(|one: &Datum| {
                one.kind == kind && matches!(one.noise, Noise::Shared { factor, .. } if factor < 1.0)
            })
        };
        let prior = (0..kinds.len()).map(|kind| PRIOR_SCATTER[usize::from(!counted(kind))].powi(2)).collect();
        Self { readings, kinds, prior, experiments: experiments.len() }
    }

    /// The measured values.
    pub fn values(&self) -> ReadingValues {
        ReadingValues::new(self.readings.iter().map(|datum| datum.value).collect())
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
        let row = |(datum, one): (&Datum, &PredictedReading)| {
            let one = &existing(one, datum.value);
            match datum.noise {
                Noise::Counted(stated) => {
                    let (p, count) = share(one, stated);
                    let constant = count * (1.0 - p).ln();
                    let slope = count * p.ln() - constant;
                    PreparedReading::Share { slope, constant: constant - 0.5 * (stated / count).ln(), count }
                }
                Noise::Stated(error) => {
                    let variance = error * error + one.variance;
                    PreparedReading::Normal {
                        mean: one.value,
                        half: 0.5 / variance,
                        constant: -0.5 * variance.ln(),
                    }
                }
                Noise::Shared { kind, factor } => {
                    PreparedReading::Shared { kind, mean: one.value, weight: 1.0 / factor }
                }
            }
        };
        PreparedReadings { rows: self.readings.iter().zip(predicted).map(row).collect() }
    }

    /// Log likelihood of values under predictions, each experiment with its weight [nats].
    pub fn score(&self, prepared: &PreparedReadings, values: &ReadingValues, weights: &[f64]) -> f64 {
        let mut score = 0.0;
        let mut sums = [(0.0, 0.0); KINDS];
        for (index, times) in self.inside(weights) {
            let value = values.value[index];
            match prepared.rows[index] {
                PreparedReading::Share { slope, constant, count } => {
                    score += times * (slope * value + constant + count * values.entropy[index]);
                }
                PreparedReading::Normal { mean, half, constant } => {
                    score += times * (constant - half * (value - mean).powi(2));
                }
                PreparedReading::Shared { kind, mean, weight } => {
                    let sum = &mut sums[kind.min(KINDS - 1)];
                    sum.0 += times;
                    sum.1 += times * weight * (value - mean).powi(2);
                }
            }
        }
        for ((count, sum), prior) in sums.into_iter().zip(&self.prior).filter(|((count, _), _)| *count > 0.0)
        {
            let variance = (sum + prior) / (count + 1.0);
            score -= 0.5 * (count + 1.0) * f64::ln(variance);
        }
        score
    }

    /// Largest gain of any other predictions [nats]: infinite where a scatter is fitted.
    pub fn room(&self, predicted: &[PredictedReading], weights: &[f64]) -> f64 {
        if self.inside(weights).any(|(i, _)| matches!(self.readings[i].noise, Noise::Shared { .. })) {
            return f64::INFINITY;
        }
        let exact =
            |(datum, one): (&Datum, &PredictedReading)| PredictedReading { value: datum.value, ..*one };
        let exact: Vec<PredictedReading> = self.readings.iter().zip(predicted).map(exact).collect();
        let score = |all: &[PredictedReading]| self.score(&self.prepare(all), &self.values(), weights);
        score(&exact) - score(predicted)
    }

    /// Fitted scatter of each kind under predictions [1].
    pub fn scatter(&self, predicted: &[PredictedReading], weights: &[f64]) -> Vec<f64> {
        let mut sums = vec![(0.0, 0.0); self.kinds.len()];
        for (index, _) in self.inside(weights) {
            let (datum, one) = (&self.readings[index], &predicted[index]);
            if let Noise::Shared { kind, factor } = datum.noise {
                sums[kind].0 += 1.0;
                sums[kind].1 += (datum.value - existing(one, datum.value).value).powi(2) / factor;
            }
        }
        let scatter = |((count, sum), prior): ((f64, f64), &f64)| ((sum + prior) / (count + 1.0)).sqrt();
        sums.into_iter().zip(&self.prior).map(scatter).collect()
    }

    /// Variance of a reading about a prediction [1]; `scatter` is that of each kind.
    pub fn variance(&self, index: usize, one: &PredictedReading, scatter: &[f64]) -> f64 {
        match self.readings[index].noise {
            Noise::Counted(count) => {
                let (p, count) = share(one, count);
                p * (1.0 - p) / count
            }
            Noise::Stated(error) => error * error + one.variance,
            Noise::Shared { kind, factor } => factor * scatter[kind].powi(2) + one.variance,
        }
    }

    /// Chi-square of the readings with a known error, and their number.
    pub fn chi_square(&self, predicted: &[PredictedReading], weights: &[f64]) -> (f64, usize) {
        let is_known = |index: &usize| !matches!(self.readings[*index].noise, Noise::Shared { .. });
        let known = self.inside(weights).map(|(index, _)| index).filter(is_known);
        let term = |index: usize| {
            let value = self.readings[index].value;
            let one = &existing(&predicted[index], value);
            let centre = match self.readings[index].noise {
                Noise::Counted(count) => share(one, count).0,
                _ => one.value,
            };
            (value - centre).powi(2) / self.variance(index, one, &[])
        };
        known.fold((0.0, 0), |(sum, count), index| (sum + term(index), count + 1))
    }

    /// Values as predictions would give them, with a new error each; `scatter` is that of each kind.
    pub fn draw(
        &self,
        predicted: &[PredictedReading],
        scatter: &[f64],
        random: &mut ChaCha8Rng,
    ) -> ReadingValues {
        let mut one = |(index, datum): (usize, &Datum)| {
            let one = &existing(&predicted[index], datum.value);
            let normal: f64 = StandardNormal.sample(random);
            match datum.noise {
                Noise::Counted(count) => {
                    let p =
                        (one.value + one.variance.sqrt() * normal).clamp(SHARE_MARGIN, 1.0 - SHARE_MARGIN);
                    let drawn = Binomial::new(count.round() as u64, p).map(|law| law.sample(random));
                    drawn.map_or(p, |drawn| drawn as f64 / count.round())
                }
                _ => one.value + self.variance(index, one, scatter).sqrt() * normal,
            }
        };
        ReadingValues::new(self.readings.iter().enumerate().map(&mut one).collect())
    }
}

/// A prediction that can be compared: where the model says that nothing happens that could be
/// measured, as no rebound, it is as wrong as it could be.
fn existing(one: &PredictedReading, measured: f64) -> PredictedReading {
    if one.value.is_finite() {
        return *one;
    }
    PredictedReading {
        value: if measured > 0.5 { 0.0 } else { 1.0 },
        variance: 0.0,
        particles: one.particles,
    }
}

/// A predicted share away from 0 and 1, and the count reduced by the prediction's own error.
fn share(one: &PredictedReading, count: f64) -> (f64, f64) {
    let p = one.value.clamp(SHARE_MARGIN, 1.0 - SHARE_MARGIN);
    (p, count / (1.0 + one.variance * count / (p * (1.0 - p))))
}
