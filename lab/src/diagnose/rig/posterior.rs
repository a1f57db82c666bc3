//! Draws of the parameters from their likelihood, all together.
//!
//! Population Monte Carlo: normal draws about the fit are weighted by the likelihood over the
//! density that they were drawn from; the next generation is drawn with the mean and covariance of
//! the weighted ones. The prior is even over the search ranges. A misfit that is left
//! is a scatter between runs, which the likelihood has.

use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution as _, StandardNormal, StandardUniform};
use rayon::prelude::*;

use super::addition::{RigAddition, moved};
use super::noise::PreparedReadings;
use super::prediction_table::predict;
use super::study::RigStudy;

/// Draws of each generation.
const GENERATIONS: [usize; 3] = [60, 100, 200];
/// Factor on the standard deviations of the weighted draws from which the next generation is drawn.
const WIDER: f64 = 1.3;
/// Fall of the log likelihood at the first guess of a standard error [nats].
const FALL: f64 = 0.5;
/// Smallest and largest first guess of a standard error, in the coordinate.
const GUESSES: [f64; 2] = [1e-3, 0.4];

/// Log likelihood [nats] and predictions at some coordinates; none outside the search ranges.
type Evaluated = (f64, Option<PreparedReadings>);

/// Weighted draws of the coordinates of additions.
#[derive(Debug, Default)]
pub(super) struct Posterior {
    at: Vec<Vec<f64>>,
    weights: Vec<f64>,
    /// Coordinates and predictions of all generations.
    tried: Vec<(Vec<f64>, PreparedReadings)>,
}

impl Posterior {
    /// Draws about the fit.
    pub fn new(study: &RigStudy<'_>, additions: &[RigAddition], weights: &[f64]) -> Self {
        let centre: Vec<f64> = additions.iter().flat_map(|addition| addition.at.clone()).collect();
        if centre.is_empty() {
            return Self::default();
        }
        let evaluate = |at: &[f64]| {
            let inside = at.iter().all(|coordinate| (0.0..=1.0).contains(coordinate));
            if !inside {
                return (f64::NEG_INFINITY, None);
            }
            let Ok(predicted) = predict(study.forward, &moved(additions, at)) else {
                return (f64::NEG_INFINITY, None);
            };
            let prepared = study.data.prepare(&predicted);
            (study.data.score(&prepared, study.data.values(), weights), Some(prepared))
        };
        let summit = evaluate(&centre).0;
        let guess = |place: usize| guess(&|at| evaluate(at).0, &centre, place, summit);
        let errors: Vec<f64> = (0..centre.len()).map(guess).collect();
        let mut mean = DVector::from_vec(centre);
        let mut covariance = DMatrix::from_diagonal(&DVector::from_iterator(
            errors.len(),
            errors.iter().map(|error| error * error),
        ));
        let (mut found, mut tried) = (Self::default(), Vec::new());
        for (generation, count) in GENERATIONS.into_iter().enumerate() {
            let seed = study.seed + generation as u64;
            found = Self::generation(&evaluate, summit, &mean, &covariance, count, seed);
            tried.append(&mut found.tried);
            if found.weights.iter().sum::<f64>() > 0.0 {
                (mean, covariance) = found.moments(&covariance);
            }
            (study.progress)("values of the numbers");
        }
        Self { tried, ..found }
    }

    fn generation(
        evaluate: &(dyn Fn(&[f64]) -> Evaluated + Sync),
        summit: f64,
        mean: &DVector<f64>,
        covariance: &DMatrix<f64>,
        count: usize,
        seed: u64,
    ) -> Self {
        let wide = covariance * (WIDER * WIDER);
        let Some(root) = wide.clone().cholesky().map(|cholesky| cholesky.l()) else { return Self::default() };
        let draw = |number: usize| {
            let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x706f_7374);
            random.set_stream(number as u64);
            let normal = DVector::from_fn(mean.len(), |_, _| StandardNormal.sample(&mut random));
            let at: Vec<f64> = (mean + &root * &normal).iter().copied().collect();
            let (score, prepared) = evaluate(&at);
            let weight = (score - summit + 0.5 * normal.norm_squared()).exp();
            (at, if weight.is_finite() { weight } else { 0.0 }, prepared)
        };
        let mut found = Self::default();
        for (at, weight, prepared) in (0..count).into_par_iter().map(draw).collect::<Vec<_>>() {
            found.tried.extend(prepared.map(|prepared| (at.clone(), prepared)));
            found.at.push(at);
            found.weights.push(weight);
        }
        found
    }

    /// The most likely of all drawn coordinates for experiments with these weights; no law is evaluated anew.
    pub fn best(&self, study: &RigStudy<'_>, weights: &[f64]) -> Option<Vec<f64>> {
        let values = study.data.values();
        let scored =
            self.tried.iter().map(|(at, prepared)| (study.data.score(prepared, values, weights), at));
        scored.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, at)| at.clone())
    }

    /// Mean and covariance of the draws, no smaller than a hundredth of what they were drawn with.
    fn moments(&self, drawn_with: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let total: f64 = self.weights.iter().sum();
        let size = drawn_with.nrows();
        let mut mean = DVector::zeros(size);
        for (at, weight) in self.at.iter().zip(&self.weights) {
            mean += DVector::from_column_slice(at) * (weight / total);
        }
        let mut covariance = DMatrix::from_diagonal(&(drawn_with.diagonal() * 0.01));
        for (at, weight) in self.at.iter().zip(&self.weights) {
            let from = DVector::from_column_slice(at) - &mean;
            covariance += &from * from.transpose() * (weight / total);
        }
        (mean, covariance)
    }

    /// The 95 % interval of a number that follows from the coordinates.
    pub fn interval(&self, number: impl Fn(&[f64]) -> f64) -> Option<[f64; 2]> {
        let total: f64 = self.weights.iter().sum();
        let mut sorted: Vec<(f64, f64)> =
            self.at.iter().zip(&self.weights).map(|(at, weight)| (number(at), *weight)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let quantile = |share: f64| {
            let mut below = 0.0;
            let found = sorted.iter().find(|(_, weight)| {
                below += weight;
                below >= share * total
            });
            found.map(|(value, _)| *value)
        };
        (total > 0.0).then(|| Some([quantile(0.025)?, quantile(0.975)?])).flatten()
    }

    /// So many draws, each as likely as its weight.
    pub fn draws(&self, count: usize, seed: u64) -> Vec<Vec<f64>> {
        let total: f64 = self.weights.iter().sum();
        if total <= 0.0 {
            return Vec::new();
        }
        let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x6472_6177);
        let start: f64 = StandardUniform.sample(&mut random);
        // Evenly along the sum of the weights.
        let step = total / count as f64;
        let mut wanted = start * step;
        let (mut sum, mut drawn) = (0.0, Vec::new());
        for (at, weight) in self.at.iter().zip(&self.weights) {
            sum += weight;
            while sum > wanted && drawn.len() < count {
                drawn.push(at.clone());
                wanted += step;
            }
        }
        drawn
    }
}

/// Distance in a coordinate at which the log likelihood falls by about [`FALL`].
fn guess(score: &impl Fn(&[f64]) -> f64, centre: &[f64], place: usize, summit: f64) -> f64 {
    let fall = |step: f64| {
        let mut least = f64::INFINITY;
        for sign in [-1.0, 1.0] {
            let mut at = centre.to_vec();
            at[place] += sign * step;
            least = least.min(summit - score(&at));
        }
        least
    };
    let [mut low, mut high] = GUESSES;
    for _ in 0..7 {
        let middle = (low * high).sqrt();
        if fall(middle) < FALL { low = middle } else { high = middle }
    }
    (low * high).sqrt()
}
