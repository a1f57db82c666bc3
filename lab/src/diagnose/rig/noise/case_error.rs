//! The likelihood averaged over the errors of the case's numbers.
//!
//! Every number of the case has a standard error that all experiments share: with `z` of these
//! errors the readings are predicted `J z` away, `J` being the changes of the base law's readings by
//! one error each. The likelihood of any explanation is its mean over `z`, which is standard normal,
//! by Laplace's approximation: `ln L(z) - z²/2 - ½ ln det(1 + Jᵀ H J)` at the best `z`, with the
//! curvature `H` of the log likelihood over the readings. For normal readings this is exactly their
//! covariance widened by `J Jᵀ`. No wall law has to explain what the instruments do not know.
//! Directions of `z` that change no reading are left out.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::super::scatter::{NormalDensity, regular};
use super::{Data, FittedScatter, Noise, PreparedReading, PreparedReadings, WeightedGroup, WeightedValues};
use crate::rig::{PredictedReading, slope};

/// Steps of Newton's method to the best errors.
const STEPS: usize = 2;
/// Difference of log odds over which the density of a count is differentiated [1]: that of its table.
const LOG_ODDS_STEP: f64 = 0.06;
/// Information of the readings on a direction, over that of its prior, below which it is left out [1].
const LEAST_INFORMATION: f64 = 0.01;

/// Predictions with the errors of the case that fit best, and the mean log likelihood [nats].
#[derive(Debug, Clone)]
pub(in crate::diagnose) struct Settled {
    pub prepared: PreparedReadings,
    pub score: f64,
}

/// The errors of the case that fit best.
#[derive(Debug, Clone)]
pub(in crate::diagnose) struct CaseFit {
    /// Chi-square without them [1].
    pub chi_square: f64,
    /// By number of the case: its error and the standard deviation of that, in its standard errors.
    pub errors: Vec<[f64; 2]>,
    /// How much each takes from chi-square [1].
    pub carried: Vec<f64>,
}

/// How the log likelihood of a reading changes with its prediction: index, slope, curvature.
type ReadingSlope = (usize, f64, f64);

impl Data {
    /// Sets the changes of all readings by one standard error of each number of the case, from
    /// predictions of the base law and of the base law with each number moved by so many.
    pub fn set_case_errors(&mut self, base: &PreparedReadings, moved: &[[PreparedReadings; 2]], widths: f64) {
        let change = |[down, up]: &[PreparedReadings; 2]| -> Vec<f64> {
            let rows = up.rows.iter().zip(&down.rows);
            rows.map(|(up, down)| (up.mean() - down.mean()) / (2.0 * widths)).collect()
        };
        let changes: Vec<Vec<f64>> = moved.iter().map(change).collect();
        if changes.is_empty() {
            return;
        }
        let weights = vec![1.0; self.experiments];
        let slopes = self.slopes(base, &self.weighted(&self.measured, &weights));
        let information = normal_matrix(&changes, &slopes);
        let eigen = SymmetricEigen::new(information);
        let mixed = |column: usize| -> Vec<f64> {
            let share = eigen.eigenvectors.column(column);
            let one =
                |reading: usize| changes.iter().zip(share.iter()).map(|(own, s)| own[reading] * s).sum();
            (0..self.readings.len()).map(one).collect()
        };
        let seen = (0..changes.len()).filter(|column| eigen.eigenvalues[*column] > LEAST_INFORMATION);
        self.case_errors = seen.map(mixed).collect();
        self.case_changes = changes;
    }

    /// What the errors of the case carry of the misfit of predictions, taken as normal. Only these
    /// readings count.
    pub fn case_fit(
        &self,
        readings: &[usize],
        predicted: &[PredictedReading],
        scatter: &FittedScatter,
    ) -> CaseFit {
        let count = self.case_changes.len();
        let mut chi_square = 0.0;
        let (mut matrix, mut vector) = (DMatrix::identity(count, count), DVector::zeros(count));
        for &index in readings {
            let [residual, variance] = self.residual(index, &predicted[index], scatter);
            // From log odds to the share itself.
            let is_counted = matches!(self.readings[index].noise, Noise::Counted(_));
            let slope = slope(is_counted, predicted[index].value);
            let row = DVector::from_iterator(count, self.case_changes.iter().map(|own| slope * own[index]));
            chi_square += residual * residual / variance;
            vector += &row * (residual / variance);
            matrix += &row * row.transpose() / variance;
        }
        let root = if count > 0 { matrix.cholesky() } else { None };
        let Some(root) = root else {
            return CaseFit { chi_square, errors: vec![[0.0, 1.0]; count], carried: vec![0.0; count] };
        };
        let best = root.solve(&vector);
        let spread = root.inverse().diagonal().map(f64::sqrt);
        CaseFit {
            chi_square,
            errors: best.iter().zip(spread.iter()).map(|(best, spread)| [*best, *spread]).collect(),
            carried: best.iter().zip(vector.iter()).map(|(best, pull)| best * pull).collect(),
        }
    }

    /// The mean log likelihood over the errors of the case, and the predictions with the best ones.
    pub fn settled(&self, prepared: &PreparedReadings, weighted: &WeightedValues<'_>) -> Settled {
        let start = self.score_as_is(prepared, weighted);
        if self.case_errors.is_empty() {
            return Settled { prepared: prepared.clone(), score: start };
        }
        let mut errors = DVector::zeros(self.case_errors.len());
        let mut at = prepared.clone();
        let (mut first, mut volume) = (start, 0.0);
        for step in 0..STEPS {
            let slopes = self.slopes(&at, weighted);
            let matrix =
                normal_matrix(&self.case_errors, &slopes) + DMatrix::identity(errors.len(), errors.len());
            let Some(root) = matrix.cholesky() else { break };
            volume = root.l_dirty().diagonal().iter().map(|one| one.ln()).sum();
            if step == 0 {
                first = start - volume;
            }
            let pull =
                |own: &Vec<f64>| slopes.iter().map(|(index, slope, _)| own[*index] * slope).sum::<f64>();
            let gradient = DVector::from_iterator(errors.len(), self.case_errors.iter().map(pull)) - &errors;
            let change = root.solve(&gradient);
            at.shift(&self.case_errors, change.as_slice());
            errors += change;
        }
        let last = self.score_as_is(&at, weighted) - 0.5 * errors.norm_squared() - volume;
        // Newton's method may lead astray where a few readings decide on the scatter.
        if last >= first {
            Settled { prepared: at, score: last }
        } else {
            Settled { prepared: prepared.clone(), score: first }
        }
    }

    /// Slopes and curvatures of the log likelihood over the predictions, with the scatter that is
    /// probable there held as it is.
    fn slopes(&self, prepared: &PreparedReadings, weighted: &WeightedValues<'_>) -> Vec<ReadingSlope> {
        let mut all = Vec::new();
        for one in weighted.groups.iter().filter(|one| !one.readings.is_empty()) {
            all.extend(one.slopes(prepared, weighted));
        }
        let unstated = self.unstated_of(prepared, weighted);
        for (index, times) in &weighted.shared {
            if let PreparedReading::Shared { kind, mean, weight } = prepared.rows[*index] {
                let curvature = times * weight / unstated[kind].powi(2);
                all.push((*index, curvature * (weighted.values.value[*index] - mean), curvature));
            }
        }
        all
    }
}

/// `Jᵀ H J`.
fn normal_matrix(changes: &[Vec<f64>], slopes: &[ReadingSlope]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(changes.len(), changes.len());
    for (a, one) in changes.iter().enumerate() {
        for (b, other) in changes.iter().enumerate().take(a + 1) {
            let sum: f64 =
                slopes.iter().map(|(index, _, curvature)| one[*index] * curvature * other[*index]).sum();
            matrix[(a, b)] = sum;
            matrix[(b, a)] = sum;
        }
    }
    matrix
}

impl WeightedGroup<'_> {
    fn slopes(&self, prepared: &PreparedReadings, weighted: &WeightedValues<'_>) -> Vec<ReadingSlope> {
        let probable = self.group.probabilities(&self.likelihood(prepared, weighted.values));
        let one = |(index, times, normal): &(usize, f64, Option<&NormalDensity>)| {
            let value = weighted.values.value[*index];
            match (prepared.rows[*index], normal, &weighted.values.counted[*index]) {
                (PreparedReading::Normal { mean, trust }, Some(normal), _) => {
                    // A gross error pulls at nothing.
                    let regular = regular(&normal.at(trust.share * (value - mean).powi(2), trust.half_log));
                    let each = normal.weight.iter().zip(&regular).zip(&probable);
                    let weight: f64 = each.map(|((w, regular), p)| w * regular * p).sum();
                    let curvature = 2.0 * times * trust.share * weight;
                    Some((*index, curvature * (value - mean), curvature))
                }
                (PreparedReading::Share { log_odds, trust }, _, Some(density)) => {
                    let [low, here, high] =
                        [-LOG_ODDS_STEP, 0.0, LOG_ODDS_STEP].map(|step| density.at(log_odds + step));
                    let (mut slope, mut bend) = (0.0, 0.0);
                    for (place, p) in probable.iter().enumerate() {
                        slope += p * (high[place] - low[place]);
                        bend += p * (2.0 * here[place] - high[place] - low[place]);
                    }
                    let times = times * trust.share;
                    let curvature = (times * bend / LOG_ODDS_STEP.powi(2)).max(0.0);
                    Some((*index, times * slope / (2.0 * LOG_ODDS_STEP), curvature))
                }
                _ => None,
            }
        };
        self.readings.iter().filter_map(one).collect()
    }
}

impl PreparedReading {
    /// The prediction on the scale on which changes add.
    fn mean(&self) -> f64 {
        match *self {
            Self::Share { log_odds, .. } => log_odds,
            Self::Normal { mean, .. } | Self::Shared { mean, .. } => mean,
        }
    }
}

impl PreparedReadings {
    /// Adds so much of each change.
    fn shift(&mut self, changes: &[Vec<f64>], by: &[f64]) {
        for (index, row) in self.rows.iter_mut().enumerate() {
            let (PreparedReading::Share { log_odds: mean, .. }
            | PreparedReading::Normal { mean, .. }
            | PreparedReading::Shared { mean, .. }) = row;
            *mean += changes.iter().zip(by).map(|(change, by)| change[index] * by).sum::<f64>();
        }
    }
}
