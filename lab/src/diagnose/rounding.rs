//! Restitutions that a file gives in steps.
//!
//! Where all readings are multiples of a step, a reading has the probability of its step rather than a density. Without
//! this, a step above the scatter looks like readings that mostly agree to the last digit, with heavy tails.

use super::likelihood::Offset;
use crate::dataset::Measurement;

/// The steps that are looked for, from the largest [1].
const STEPS: [f64; 6] = [0.1, 0.05, 0.02, 0.01, 0.005, 0.002];
/// Six readings of one digit more are all multiples of 0.05 by chance in one of 15 000 files.
const LEAST_READINGS: usize = 6;
/// Largest distance from a multiple, in steps: what a decimal number loses in its binary form.
const EXACT: f64 = 1e-6;

/// Steps of the readings of `e_n` and `e_t`, 0 for finer ones [1]. A stated error includes rounding.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rounding([f64; 2]);

impl Rounding {
    /// Of the rows of a file.
    pub fn of(rows: &[Measurement]) -> Self {
        let step = |which: usize| {
            let values: Vec<f64> = rows.iter().filter_map(|row| unstated(row, which)).collect();
            let is_multiple = |value: &f64, step: f64| (value / step - (value / step).round()).abs() < EXACT;
            let of_all = |step: &f64| values.iter().all(|value| is_multiple(value, *step));
            STEPS.into_iter().find(of_all).filter(|_| values.len() >= LEAST_READINGS).unwrap_or(0.0)
        };
        Self([0, 1].map(step))
    }

    /// Notes them for some rows of the file.
    pub fn note(self, rows: &[Measurement], noise: &mut [Offset]) {
        for (row, offset) in rows.iter().zip(noise) {
            for which in (0..2).filter(|which| unstated(row, *which).is_some()) {
                offset.step[which] = self.0[which];
            }
        }
    }
}

/// The reading of `e_n` (0) or `e_t` (1) of a row, if its error is not stated.
fn unstated(row: &Measurement, which: usize) -> Option<f64> {
    [row.e_n, row.e_t][which].filter(|reading| reading.error.is_none()).map(|reading| reading.value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::Reading;

    fn found(values: &[f64], error: Option<f64>) -> f64 {
        let row = |value: &f64| Measurement {
            e_n: Some(Reading { value: *value, error }),
            ..Measurement::default()
        };
        Rounding::of(&values.iter().map(row).collect::<Vec<_>>()).0[0]
    }

    /// None where errors are stated, of few or of fine values.
    #[test]
    fn a_step_is_seen() {
        let coarse: Vec<f64> = [3, 7, 8, 8, 9, 12, 15].map(|steps| f64::from(steps) * 0.05).to_vec();
        assert_eq!(found(&coarse, None), 0.05);
        assert_eq!(found(&coarse, Some(0.02)), 0.0);
        assert_eq!(found(&coarse[..5], None), 0.0);
        let fine: Vec<f64> = coarse.iter().map(|value| value + 0.0013).collect();
        assert_eq!(found(&fine, None), 0.0);
    }
}
