//! Confidence intervals of fitted parameters that are robust against an inexact law or scatter, and what the data cannot separate.
//!
//! The covariance is the sandwich `H⁻¹ (Σ s sᵀ) H⁻¹`, or `H⁻¹` where that is larger. `s` is the derivative of the log score of each
//! independent unit by the coordinates, `H` the matrix of second derivatives of the sum, both by finite differences over half a standard
//! error. The 95 % interval, by Student's t, is symmetric in the coordinate, so it is not symmetric in the value on a logarithmic
//! axis; it ends at the bounds of the search range.

use nalgebra::DMatrix;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::hypothesis::Hypothesis;
use super::search::SearchAxis;

/// First step of the differences, in the coordinate; the next is half a standard error within these bounds.
const FIRST_STEP: f64 = 4e-3;
const STEPS: [f64; 2] = [1e-4, 2e-2];
/// A coordinate nearer than this to 0 or 1 is at the bound of its range.
const BOUND: f64 = 0.02;
/// Correlation of two parameters from which the data determine only their combination.
const INSEPARABLE: f64 = 0.97;

/// Covariance of the free coordinates.
struct Covariance {
    /// The coordinates that are not at a bound.
    free: Vec<usize>,
    /// Of these; `None` where the data do not determine them.
    matrix: Option<DMatrix<f64>>,
    /// Standard error of every coordinate.
    errors: Vec<f64>,
}

/// Sets the 95 % intervals of all parts, fitted to these rows, and what cannot be separated.
pub(super) fn set_intervals(hypothesis: &mut Hypothesis<'_>, rows: &[usize]) {
    let count = hypothesis.coordinates().len();
    if count == 0 {
        return;
    }
    let first = covariance(hypothesis, rows, &vec![FIRST_STEP; count]);
    let steps: Vec<f64> = first.errors.iter().map(|error| (0.5 * error).clamp(STEPS[0], STEPS[1])).collect();
    let found = covariance(hypothesis, rows, &steps);
    let units = unit_count(hypothesis, rows);
    let freedom = (units as f64 - count as f64).max(1.0);
    let quantile = StudentsT::new(0.0, 1.0, freedom).map_or(2.0, |law| law.inverse_cdf(0.975));
    let mut place = 0;
    for part in &mut hypothesis.parts {
        let own = place..place + part.axes.len();
        place = own.end;
        part.inseparable = inseparable(&found, own.clone());
        let ends = |((axis, at), error): ((&SearchAxis, &f64), &f64)| {
            let mut ends = [at - quantile * error, at + quantile * error].map(|end| axis.value(end));
            ends.sort_by(f64::total_cmp);
            ends
        };
        part.intervals = part.axes.iter().zip(&part.at).zip(&found.errors[own]).map(ends).collect();
    }
}

/// Number of independent units among these rows.
fn unit_count(hypothesis: &Hypothesis<'_>, rows: &[usize]) -> usize {
    let mut units: Vec<usize> = rows.iter().map(|&row| hypothesis.data.units[row]).collect();
    units.sort_unstable();
    units.dedup();
    units.len()
}

/// The covariance by differences over these steps.
fn covariance(hypothesis: &Hypothesis<'_>, rows: &[usize], steps: &[f64]) -> Covariance {
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
            let (one, two) = (2.0 * steps[a], 2.0 * steps[b]);
            let sum = |x: f64, y: f64| scores([(a, x * one), (b, y * two)]).iter().sum::<f64>();
            let second =
                (sum(1.0, 1.0) - sum(1.0, -1.0) - sum(-1.0, 1.0) + sum(-1.0, -1.0)) / (4.0 * one * two);
            curvature[(a, b)] = -second;
            curvature[(b, a)] = -second;
        }
    }
    let meat = slopes.transpose() * &slopes;
    robust(&at, &curvature, &meat, unit_count(hypothesis, rows))
}

/// The covariance from second derivatives and from `meat`, which is `Σ s sᵀ`. A coordinate at a bound has no usable curvature: it does
/// not enter the covariance of the others, and its error follows from its own derivatives.
fn robust(at: &[f64], curvature: &DMatrix<f64>, meat: &DMatrix<f64>, units: usize) -> Covariance {
    let free: Vec<usize> = (0..at.len()).filter(|&i| (BOUND..=1.0 - BOUND).contains(&at[i])).collect();
    let mut errors: Vec<f64> = (0..at.len()).map(|i| meat[(i, i)].max(1.0).recip().sqrt()).collect();
    let part = |m: &DMatrix<f64>| DMatrix::from_fn(free.len(), free.len(), |i, j| m[(free[i], free[j])]);
    let factor = units as f64 / (units as f64 - free.len() as f64).max(1.0);
    let matrix = part(curvature).cholesky().map(|c| c.inverse());
    if let Some(inverse) = &matrix {
        let sandwich = inverse * part(meat) * inverse;
        for (place, &coordinate) in free.iter().enumerate() {
            // The sandwich is too small where few rows carry the information.
            let variance = sandwich[(place, place)].max(inverse[(place, place)]);
            errors[coordinate] = (variance * factor).sqrt().min(1.0);
        }
    }
    Covariance { free, matrix, errors }
}

/// Pairs of a part's parameters, by place, of which the data determine only a combination, with their correlation [1].
fn inseparable(found: &Covariance, own: std::ops::Range<usize>) -> Vec<([usize; 2], f64)> {
    let Some(matrix) = &found.matrix else { return Vec::new() };
    let places: Vec<(usize, usize)> =
        found.free.iter().copied().enumerate().filter(|(_, coordinate)| own.contains(coordinate)).collect();
    let mut pairs = Vec::new();
    for (first, &(i, one)) in places.iter().enumerate() {
        for &(j, two) in &places[first + 1..] {
            let correlation = matrix[(i, j)] / (matrix[(i, i)] * matrix[(j, j)]).sqrt();
            if correlation.abs() > INSEPARABLE {
                pairs.push(([one - own.start, two - own.start], correlation));
            }
        }
    }
    pairs
}
