//! Stated errors of the inputs, taken into account before any fit.
//!
//! A reading `x` with the standard error `sigma` of an input whose true values have the mean `m` and the variance `V` in these rows
//! has the expected value `m + V/(V + sigma²) (x - m)` and the variance `V sigma²/(V + sigma²)` (regression calibration; Carroll et
//! al. 2006, ch. 4). Rows are predicted at the expected values; the variance adds to that of `e_n` and `e_t` through the slope of the
//! base model, and its curvature shifts the prediction. `V` is the variance of the readings without that of their errors. Inputs are
//! treated one by one: correlations of their true values are ignored.

use super::likelihood::Offset;
use crate::dataset::{Measurement, Measurements};
use crate::impact::{INPUTS, Impact, Input};
use crate::model::Model;

/// The rows at the expected values of their inputs, and what the rest of the errors does to the predictions.
pub(super) fn corrected(base: &Model, data: &Measurements) -> (Vec<Measurement>, Vec<Offset>) {
    let mut rows = data.rows.clone();
    let mut noise = vec![Offset::default(); rows.len()];
    for input in &INPUTS {
        let errors: Vec<f64> = data.rows.iter().map(|row| row.input_errors.of(input.name)).collect();
        if errors.iter().any(|error| *error > 0.0) {
            correct(base, input, &errors, &mut rows, &mut noise);
        }
    }
    (rows, noise)
}

/// Corrects one input.
fn correct(base: &Model, input: &Input, errors: &[f64], rows: &mut [Measurement], noise: &mut [Offset]) {
    let count = rows.len() as f64;
    let values: Vec<f64> = rows.iter().map(|row| (input.value)(&row.impact)).collect();
    let mean = values.iter().sum::<f64>() / count;
    let observed = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0).max(1.0);
    let known = errors.iter().map(|error| error * error).sum::<f64>() / count;
    let variance = (observed - known).max(0.0);
    for (((row, offset), value), error) in rows.iter_mut().zip(noise).zip(values).zip(errors) {
        let own = error * error;
        if own <= 0.0 {
            continue;
        }
        let share = variance / (variance + own);
        (input.set)(&mut row.impact, mean + share * (value - mean));
        let deviation = (share * own).sqrt();
        let Some([below, middle, above]) = around(base, input, row, deviation) else { continue };
        for which in 0..2 {
            offset.variance[which] += (0.5 * (above[which] - below[which])).powi(2);
            offset.restitution[which] += 0.5 * (above[which] + below[which]) - middle[which];
        }
    }
}

/// `e_n` and `e_t` of the base model one deviation below, at, and one above the value of the input; `None` where an impact there has no
/// meaning.
fn around(base: &Model, input: &Input, row: &Measurement, deviation: f64) -> Option<[[f64; 2]; 3]> {
    let at = |step: f64| {
        let mut impact: Impact = row.impact;
        (input.set)(&mut impact, (input.value)(&row.impact) + step);
        let outcome = base.resolve_with(row.wall, &impact, |_| 0.5).ok()?;
        Some([outcome.normal_restitution, outcome.tangential_restitution])
    };
    Some([at(-deviation)?, at(0.0)?, at(deviation)?])
}
