//! Tests with few rows, and of captures in classes, by the fall of chi-square or of the deviance.
//!
//! Where all readings have stated errors, `chi²` is that of the stated errors alone. With `k`
//! parameters more, `n` readings and `chi²_0`, `chi²_1` before and after: if `chi²_1 <= n - k`, the
//! errors are as stated and `chi²_0 - chi²_1` is distributed as chi-square with `k` degrees of
//! freedom; otherwise errors are scaled by `sqrt(chi²_1/(n - k))` (Birge 1932), which is the F test
//! of `((chi²_0 - chi²_1)/k) / (chi²_1/(n - k))`. Without stated errors the F test follows from the
//! gain in log likelihood `G`: `chi²_0/chi²_1 = exp(2 G/n)`. Of captures `2 G` falls; `chi²_1` is
//! Pearson's, which exceeds `n - k` where the impacts of a class are not independent
//! (over-dispersion; McCullagh and Nelder 1989, ch. 4).

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::chi_square;
use super::evaluation::Evaluation;
use super::observable::Observable;

/// From this number of rows on, they are many.
pub(super) const MANY_ROWS: usize = 30;

/// The base of the tests.
#[derive(Debug, Clone, Copy)]
pub(super) struct FewRows {
    /// Readings of `e_n` and `e_t`.
    readings: [usize; 2],
    /// Chi-square of the stated errors, if all readings have one.
    chi_square: Option<f64>,
    captures: bool,
    /// Whether there are too few rows for the score test.
    pub alone: bool,
}

impl FewRows {
    /// `None` if there are many rows, none of them a class of captures.
    pub fn of(rows: &Evaluation<'_>) -> Option<Self> {
        let measured = |&row: &usize| Observable::Capture.measured(&rows.data.rows[row]).is_some();
        let captures = rows.rows.iter().any(measured);
        let classes = rows.rows.iter().any(|row| measured(row) && rows.data.rows[*row].impacts > 1.0);
        let alone = rows.rows.len() < MANY_ROWS;
        (alone || classes).then(|| Self {
            readings: rows.data.readings(),
            chi_square: rows.stated_chi_square().map(|(chi, _)| chi),
            captures,
            alone,
        })
    }

    /// The p-value of an extension with `freedom` parameters more, which gains `gain` [nats];
    /// `observable` is the only one that it changes, if it is one.
    pub fn p_value(
        &self,
        extended: &Evaluation<'_>,
        freedom: f64,
        gain: f64,
        observable: Option<Observable>,
    ) -> f64 {
        let fall_and_rest = if self.captures {
            let (pearson, count) = extended.pearson();
            (2.0 * gain, pearson, count as f64 - freedom)
        } else {
            self.of_readings(extended, freedom, gain, observable)
        };
        let (fall, rest, left) = fall_and_rest;
        if left < 0.5 {
            return 1.0;
        }
        let p = if rest <= left {
            chi_square::p_value(fall, freedom)
        } else {
            FisherSnedecor::new(freedom, left).map_or(1.0, |law| law.sf((fall / freedom) / (rest / left)))
        };
        p.clamp(1e-300, 1.0)
    }

    /// Fall of chi-square, its rest and the degrees of freedom of the rest.
    fn of_readings(
        &self,
        extended: &Evaluation<'_>,
        freedom: f64,
        gain: f64,
        observable: Option<Observable>,
    ) -> (f64, f64, f64) {
        let all = self.readings.iter().sum::<usize>() as f64;
        if let (Some(before), Some((after, _))) = (self.chi_square, extended.stated_chi_square()) {
            return ((before - after).max(0.0), after, all - freedom);
        }
        let of_one = observable.and_then(|observable| self.readings.get(observable as usize).copied());
        let readings = of_one.map_or(all, |count| count as f64);
        let left = readings - freedom;
        // The rest in its own units, just above the degrees of freedom: always the F test.
        let rest = left * (1.0 + 1e-9);
        (left * ((2.0 * gain / readings).exp() - 1.0), rest, left)
    }
}
