//! Covariance of fitted coordinates that is robust against an inexact law or scatter.
//!
//! With `s` the derivative of the log score of each independent unit by the coordinates and `H` the
//! matrix of second derivatives of the sum, both by finite differences, the covariance is `H⁻¹` if
//! the model is exact, and the sandwich `H⁻¹ (Σ s sᵀ) H⁻¹` if it is not.

use nalgebra::DMatrix;

use super::hypothesis::Hypothesis;

/// A coordinate nearer than this to 0 or 1 is at the bound of its range.
const AT_BOUND: f64 = 0.02;
/// Largest factor of the sandwich on a variance.
const LARGEST_FACTOR: f64 = 10.0;

/// Covariance of the free coordinates.
pub(super) struct Covariance {
    /// The coordinates that are not at a bound, in order.
    pub free: Vec<usize>,
    /// `H⁻¹` of these; `None` where the data do not determine them.
    pub matrix: Option<DMatrix<f64>>,
    /// Factor of the sandwich on the variance of every coordinate, at least 1.
    pub factors: Vec<f64>,
}

impl Covariance {
    /// By differences over these steps in the coordinates.
    pub fn of(hypothesis: &Hypothesis<'_>, rows: &[usize], steps: &[f64]) -> Self {
        let at = hypothesis.coordinates();
        let count = at.len();
        let offsets = hypothesis.offsets();
        let scores = |moves: [(usize, f64); 2]| {
            let mut moved = at.clone();
            moves.into_iter().for_each(|(place, step)| moved[place] += step);
            hypothesis.with_coordinates(&moved).evaluate(rows, &offsets).with_fitted_scatter().scores()
        };
        let mut slopes = DMatrix::zeros(hypothesis.data.unit_count.max(1), count);
        for place in 0..count {
            let [up, down] = [1.0, -1.0].map(|sign| scores([(place, sign * steps[place]), (place, 0.0)]));
            for ((&row, up), down) in rows.iter().zip(&up).zip(&down) {
                slopes[(hypothesis.data.units[row], place)] += (up - down) / (2.0 * steps[place]);
            }
        }
        let mut curvature = DMatrix::zeros(count, count);
        for a in 0..count {
            for b in 0..=a {
                let sum = |x: f64, y: f64| scores([(a, x * steps[a]), (b, y * steps[b])]).iter().sum::<f64>();
                let second = (sum(1.0, 1.0) - sum(1.0, -1.0) - sum(-1.0, 1.0) + sum(-1.0, -1.0))
                    / (4.0 * steps[a] * steps[b]);
                curvature[(a, b)] = -second;
                curvature[(b, a)] = -second;
            }
        }
        Self::robust(&at, &curvature, &(slopes.transpose() * &slopes))
    }

    /// From `H` with its sign changed and from `meat`, which is `Σ s sᵀ`. A coordinate at a bound
    /// has no usable curvature.
    fn robust(at: &[f64], curvature: &DMatrix<f64>, meat: &DMatrix<f64>) -> Self {
        let free: Vec<usize> =
            (0..at.len()).filter(|&i| (AT_BOUND..=1.0 - AT_BOUND).contains(&at[i])).collect();
        let part = |m: &DMatrix<f64>| DMatrix::from_fn(free.len(), free.len(), |i, j| m[(free[i], free[j])]);
        let matrix = part(curvature).cholesky().map(|c| c.inverse());
        let mut factors = vec![1.0; at.len()];
        if let Some(inverse) = &matrix {
            let sandwich = inverse * part(meat) * inverse;
            for (place, &coordinate) in free.iter().enumerate() {
                // The sandwich is too small where few rows carry the information.
                let factor = sandwich[(place, place)] / inverse[(place, place)];
                factors[coordinate] = factor.clamp(1.0, LARGEST_FACTOR);
            }
        }
        Self { free, matrix, factors }
    }

    /// Standard error of a coordinate under an exact model; `None` at a bound.
    pub fn error(&self, coordinate: usize) -> Option<f64> {
        let matrix = self.matrix.as_ref()?;
        let place = self.free.iter().position(|free| *free == coordinate)?;
        Some(matrix[(place, place)].sqrt())
    }
}
