//! A column that matters in a way that no effect explains, and the curve over it.

use super::data_split::DataSplit;
use super::forecast::Forecast;
use super::hypothesis::{Observable, residuals};
use super::likelihood::{Offset, Scatter, mean};
use super::smooth::{Basis, Curve};

/// Rounds of the reweighted fit of capture, after its level.
const ROUNDS: usize = 5;
/// Levels of capture are looked for within these log odds.
const WIDEST_ODDS: f64 = 10.0;
/// A smooth curve over a column, for which no effect is known.
#[derive(Debug, Clone)]
pub(super) struct Unknown {
    /// Place among the study's factors.
    pub factor: usize,
    pub observable: Observable,
    /// Whether it multiplies the forecast rather than adding to it.
    pub factorwise: bool,
    pub curve: Curve,
}

/// The log odds to add to every forecast of capture so that as many are captured as were; by bisection. `None` where
/// nothing was observed.
fn level_of_capture(
    study: &DataSplit,
    rows: &[usize],
    forecast: &Forecast,
    shifts: &[Offset],
) -> Option<f64> {
    let excess = |level: f64| {
        let one = |(place, &index): (usize, &usize)| {
            let row = &study.rows[index];
            let shift = Offset { capture: shifts[index].capture + level, ..shifts[index] };
            Some(row.impacts * (mean(forecast.of(place), &shift).capture - row.captured?))
        };
        rows.iter().enumerate().filter_map(one).fold(None, |sum, one| Some(sum.unwrap_or(0.0) + one))
    };
    let (mut low, mut high) = (-WIDEST_ODDS, WIDEST_ODDS);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if excess(middle)? < 0.0 { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

impl Unknown {
    /// The curve over its basis that the residuals of these rows ask for.
    ///
    /// Capture goes by log odds: least squares, reweighted a few times, from the level on.
    pub fn fitted(
        &self,
        study: &DataSplit,
        rows: &[usize],
        forecast: &Forecast,
        shifts: &[Offset],
        scatter: Scatter,
    ) -> Option<Self> {
        let values = study.values(self.factor);
        let Self { factor, observable, factorwise, .. } = *self;
        let new = |curve| Self { factor, observable, factorwise, curve };
        if observable != Observable::Capture {
            let points = residuals(study, rows, forecast, shifts, scatter, observable, factorwise);
            return Curve::fit(values, &self.curve.basis, &points).map(new);
        }
        let mut moved = shifts.to_vec();
        let level = level_of_capture(study, rows, forecast, shifts)?;
        let mut curve = Curve { basis: Basis::Level, heights: vec![level] };
        for _ in 0..if matches!(self.curve.basis, Basis::Level) { 0 } else { ROUNDS } {
            for &row in rows {
                moved[row].capture = shifts[row].capture + curve.at(values, row);
            }
            let mut points = residuals(study, rows, forecast, &moved, scatter, observable, factorwise);
            for point in &mut points {
                point.residual += curve.at(values, point.row);
            }
            curve = Curve::fit(values, &self.curve.basis, &points)?;
        }
        Some(new(curve))
    }

    /// Adds the curve to the shifts of these rows.
    pub fn add(&self, study: &DataSplit, forecast: &Forecast, rows: &[usize], shifts: &mut [Offset]) {
        let values = study.values(self.factor);
        for (place, &index) in rows.iter().enumerate() {
            let height = self.curve.at(values, index);
            let shift = &mut shifts[index];
            let factor = |quantity: f64| if self.factorwise { quantity } else { 1.0 };
            match self.observable {
                Observable::NormalRestitution => {
                    shift.e_n += height * factor(mean(forecast.of(place), &Offset::default()).e_n);
                }
                Observable::TangentialRestitution => {
                    shift.e_t += height * factor(mean(forecast.of(place), &Offset::default()).e_t);
                }
                Observable::Capture => shift.capture += height,
            }
        }
    }
}
