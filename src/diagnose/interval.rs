//! Intervals of fitted parameters, which hold although the law's shape or the scatter may be wrong.
//!
//! The covariance is the sandwich `H⁻¹ (Σ s sᵀ) H⁻¹`, with `s` each row's derivative of the log score by the coordinates
//! and `H` the second derivatives of the sum, both by differences, or `H⁻¹` where that is larger. The 95 % interval is symmetric in the coordinate and
//! so not in the value where the axis is logarithmic; it ends at the ends of the search range.

use nalgebra::DMatrix;

use super::data_split::DataSplit;
use super::hypothesis::Hypothesis;
use super::likelihood::{Offset, Scatter};

/// Step of the differences, in the coordinate.
const STEP: f64 = 4e-3;
/// A coordinate nearer than this to 0 or 1 lies at the end of its range.
const EDGE: f64 = 0.02;
/// 97.5 % quantile of the normal distribution.
const NORMAL_975: f64 = 1.959_963_985;

/// For every part of a hypothesis the lower and upper ends of its parameters in SI units; rows by index.
pub(super) fn intervals(
    hypothesis: &Hypothesis,
    study: &DataSplit,
    rows: &[usize],
    shifts: &[Offset],
    scatter: Scatter,
) -> Vec<Vec<[f64; 2]>> {
    let at = hypothesis.coordinates();
    let count = at.len();
    let scores_at = |at: &[f64]| {
        let moved = hypothesis.with_coordinates(at);
        let scatter = moved.fit(study, rows, shifts, scatter).scatter;
        moved.row_scores(study, rows, shifts, scatter)
    };
    let moved = |place: usize, step: f64, other: usize, other_step: f64| {
        let mut moved = at.clone();
        moved[place] += step;
        moved[other] += other_step;
        moved
    };
    let sum = |at: Vec<f64>| scores_at(&at).iter().sum::<f64>();
    let mut scores = DMatrix::zeros(rows.len(), count);
    for place in 0..count {
        let (up, down) =
            (scores_at(&moved(place, STEP, place, 0.0)), scores_at(&moved(place, -STEP, place, 0.0)));
        for (row, (up, down)) in up.iter().zip(&down).enumerate() {
            scores[(row, place)] = (up - down) / (2.0 * STEP);
        }
    }
    let meat = scores.transpose() * &scores;
    let mut curvature = DMatrix::zeros(count, count);
    let wide = 4.0 * STEP;
    for a in 0..count {
        for b in 0..=a {
            let second = (sum(moved(a, wide, b, wide))
                - sum(moved(a, wide, b, -wide))
                - sum(moved(a, -wide, b, wide))
                + sum(moved(a, -wide, b, -wide)))
                / (4.0 * wide * wide);
            curvature[(a, b)] = -second;
            curvature[(b, a)] = -second;
        }
    }
    let errors = errors(&at, &curvature, &meat, rows.len());
    let mut place = 0;
    let ends = |place: usize, axis: super::search::Axis| {
        let reach = NORMAL_975 * errors[place];
        let mut ends = [axis.value(at[place] - reach), axis.value(at[place] + reach)];
        ends.sort_by(f64::total_cmp);
        ends
    };
    let of_part = |part: &super::part::Fitted| {
        let first = place;
        place += part.axes.len();
        part.axes.iter().enumerate().map(|(index, axis)| ends(first + index, *axis)).collect()
    };
    hypothesis.parts.iter().map(of_part).collect()
}

/// Standard errors of the coordinates. A coordinate at an end of its range has no curvature to speak of: it is left out
/// of the others' and has the error that its own scores give.
fn errors(at: &[f64], curvature: &DMatrix<f64>, meat: &DMatrix<f64>, rows: usize) -> Vec<f64> {
    let free: Vec<usize> = (0..at.len()).filter(|&i| (EDGE..=1.0 - EDGE).contains(&at[i])).collect();
    let mut errors: Vec<f64> = (0..at.len()).map(|i| meat[(i, i)].max(1.0).recip().sqrt()).collect();
    let part = |m: &DMatrix<f64>| DMatrix::from_fn(free.len(), free.len(), |i, j| m[(free[i], free[j])]);
    let factor = rows as f64 / (rows as f64 - free.len() as f64).max(1.0);
    if let Some(inverse) = part(curvature).cholesky().map(|c| c.inverse()) {
        let sandwich = &inverse * part(meat) * &inverse;
        for (place, &coordinate) in free.iter().enumerate() {
            // The larger of the two: the sandwich is too hopeful where few rows carry the information.
            let variance = sandwich[(place, place)].max(inverse[(place, place)]);
            errors[coordinate] = (variance * factor).sqrt().min(1.0);
        }
    }
    errors
}
