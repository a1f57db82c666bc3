//! Confidence intervals of fitted parameters that are robust against an inexact law or scatter.
//!
//! The covariance is the sandwich `H⁻¹ (Σ s sᵀ) H⁻¹`, or `H⁻¹` where that is larger. `s` is each row's derivative of the
//! log score by the coordinates, `H` the matrix of second derivatives of the sum, both by finite differences. The 95 %
//! interval is symmetric in the coordinate, so it is not symmetric in the value on a logarithmic axis; it ends at the
//! bounds of the search range.

use nalgebra::DMatrix;

use super::hypothesis::Hypothesis;

/// Step of the differences, in the coordinate.
const STEP: f64 = 4e-3;
/// A coordinate nearer than this to 0 or 1 is at the bound of its range.
const BOUND: f64 = 0.02;
/// 97.5 % quantile of the normal distribution.
const NORMAL_975: f64 = 1.959_963_985;

/// Sets the 95 % intervals of all parts, fitted to these rows.
pub(super) fn set_intervals(hypothesis: &mut Hypothesis<'_>, rows: &[usize]) {
    let at = hypothesis.coordinates();
    let count = at.len();
    let offsets = hypothesis.offsets();
    let scores = |steps: [(usize, f64); 2]| {
        let mut moved = at.clone();
        steps.into_iter().for_each(|(place, step)| moved[place] += step);
        hypothesis.with_coordinates(&moved).evaluate(rows, &offsets).with_fitted_scatter().scores()
    };
    let mut slopes = DMatrix::zeros(rows.len(), count);
    for place in 0..count {
        let [up, down] = [STEP, -STEP].map(|step| scores([(place, step), (place, 0.0)]));
        for (row, (up, down)) in up.iter().zip(&down).enumerate() {
            slopes[(row, place)] = (up - down) / (2.0 * STEP);
        }
    }
    let mut curvature = DMatrix::zeros(count, count);
    let wide = 4.0 * STEP;
    for a in 0..count {
        for b in 0..=a {
            let sum = |one: f64, two: f64| scores([(a, one), (b, two)]).iter().sum::<f64>();
            let second = (sum(wide, wide) - sum(wide, -wide) - sum(-wide, wide) + sum(-wide, -wide))
                / (4.0 * wide * wide);
            curvature[(a, b)] = -second;
            curvature[(b, a)] = -second;
        }
    }
    let errors = standard_errors(&at, &curvature, &(slopes.transpose() * &slopes), rows.len());
    let mut errors = errors.into_iter();
    for part in &mut hypothesis.parts {
        let ends = |((axis, at), error): ((&super::search::SearchAxis, &f64), f64)| {
            let mut ends = [at - NORMAL_975 * error, at + NORMAL_975 * error].map(|end| axis.value(end));
            ends.sort_by(f64::total_cmp);
            ends
        };
        part.intervals = part.axes.iter().zip(&part.at).zip(errors.by_ref()).map(ends).collect();
    }
}

/// Standard errors of the coordinates; `meat` is `Σ s sᵀ`. A coordinate at a bound has no usable curvature: it does not
/// enter the covariance of the others, and its error follows from its own derivatives.
fn standard_errors(at: &[f64], curvature: &DMatrix<f64>, meat: &DMatrix<f64>, rows: usize) -> Vec<f64> {
    let free: Vec<usize> = (0..at.len()).filter(|&i| (BOUND..=1.0 - BOUND).contains(&at[i])).collect();
    let mut errors: Vec<f64> = (0..at.len()).map(|i| meat[(i, i)].max(1.0).recip().sqrt()).collect();
    let part = |m: &DMatrix<f64>| DMatrix::from_fn(free.len(), free.len(), |i, j| m[(free[i], free[j])]);
    let factor = rows as f64 / (rows as f64 - free.len() as f64).max(1.0);
    if let Some(inverse) = part(curvature).cholesky().map(|c| c.inverse()) {
        let sandwich = &inverse * part(meat) * &inverse;
        for (place, &coordinate) in free.iter().enumerate() {
            // The sandwich is too small where few rows carry the information.
            let variance = sandwich[(place, place)].max(inverse[(place, place)]);
            errors[coordinate] = (variance * factor).sqrt().min(1.0);
        }
    }
    errors
}
