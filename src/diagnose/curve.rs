//! A smooth curve over one column, for a dependence that no effect explains.

use super::evaluation::Evaluation;
use super::likelihood::Offset;
use super::observable::Observable;
use super::smooth::Basis;

/// Rounds of the iteratively reweighted fit of capture.
const ROUNDS: usize = 5;
/// Largest constant offset of capture [log odds].
const WIDEST_ODDS: f64 = 10.0;

/// What a curve is: its column, its observable, and how it acts. A constant ignores the column.
#[derive(Debug, Clone)]
pub(super) struct CurveForm {
    /// Index among the covariates.
    pub covariate: usize,
    pub observable: Observable,
    /// Whether it is multiplied with the prediction rather than added.
    pub multiplicative: bool,
    pub basis: Basis,
}

impl CurveForm {
    /// The curve that fits the residuals best, `None` where there are too few.
    ///
    /// The curve of capture is in log odds and fitted by iteratively reweighted least squares, from a constant on.
    pub fn fit(self, evaluation: &Evaluation<'_>) -> Option<ColumnCurve> {
        let values = evaluation.data.values(self.covariate);
        if self.observable != Observable::Capture {
            let points = evaluation.residuals(self.observable, self.multiplicative);
            let heights = self.basis.fit(values, &points)?;
            return Some(ColumnCurve { form: self, heights });
        }
        let (mut basis, mut heights) = (&Basis::Constant, vec![constant_odds(evaluation)?]);
        for _ in 0..if matches!(self.basis, Basis::Constant) { 0 } else { ROUNDS } {
            let mut offsets = evaluation.offsets.to_vec();
            for &row in evaluation.rows.iter() {
                offsets[row].capture += basis.height(&heights, values, row);
            }
            let mut points = evaluation.with_offsets(offsets).residuals(self.observable, false);
            for point in &mut points {
                point.residual += basis.height(&heights, values, point.row);
            }
            (basis, heights) = (&self.basis, self.basis.fit(values, &points)?);
        }
        Some(ColumnCurve { form: self, heights })
    }
}

/// A fitted curve over a column.
#[derive(Debug, Clone)]
pub(super) struct ColumnCurve {
    pub form: CurveForm,
    /// Heights of the basis functions.
    pub heights: Vec<f64>,
}

impl ColumnCurve {
    /// Adds the curve to the offsets of the evaluated rows.
    pub fn add_to(&self, offsets: &mut [Offset], evaluation: &Evaluation<'_>) {
        let CurveForm { covariate, observable, multiplicative, ref basis } = self.form;
        let values = evaluation.data.values(covariate);
        for (row, predicted) in evaluation.plain(observable) {
            let scale = if multiplicative { predicted } else { 1.0 };
            let height = basis.height(&self.heights, values, row) * scale;
            let offset = &mut offsets[row];
            *offset.restitution.get_mut(observable as usize).unwrap_or(&mut offset.capture) += height;
        }
    }
}

/// The constant offset of the log odds with which as many captures are predicted as were measured, by bisection.
fn constant_odds(evaluation: &Evaluation<'_>) -> Option<f64> {
    let (mut low, mut high) = (-WIDEST_ODDS, WIDEST_ODDS);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if evaluation.excess_captures(middle)? < 0.0 { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}
