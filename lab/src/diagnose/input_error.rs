//! Stated errors of the inputs, taken into account before any fit.
//!
//! A reading `x` with the standard error `sigma` says of the true value `t` what Bayes' theorem
//! does with the distribution of the true values in these rows (regression calibration; Carroll et
//! al. 2006, ch. 4). That distribution is the one of largest likelihood on a grid over the
//! readings, by a fixed number of steps of expectation–maximisation (Laird 1978). Rows are
//! predicted at the expected true values; their variance adds to that of `e_n` and `e_t` through
//! the slope of the base model, and its curvature shifts the prediction. Inputs are treated one by
//! one: correlations of their true values are ignored.

use super::likelihood::Offset;
use crate::dataset::{Measurement, Measurements};
use nearwall::impact::{INPUTS, Impact, Input};
use nearwall::model::Model;

/// Places of the grid of true values.
const GRID_PLACES: usize = 120;
/// Steps of the estimate of their distribution: more of them would follow the errors.
const ESTIMATE_STEPS: usize = 60;
/// Largest number of rows for it.
const PRIOR_ROWS: usize = 2000;
/// Errors are a share of the reading if their shares differ by less than this.
const SAME_SHARE: f64 = 1e-3;

/// The rows at the expected values of their inputs, and what the rest of the errors does to the predictions.
pub(super) fn corrected(base: &Model, data: &Measurements) -> (Vec<Measurement>, Vec<Offset>) {
    let mut rows = data.rows.clone();
    let mut noise = vec![Offset::default(); rows.len()];
    for (place, input) in INPUTS.iter().enumerate() {
        // The error of an input that is missing says nothing.
        let error = |row: &Measurement| if row.stated[place] { row.input_errors.of(input.name) } else { 0.0 };
        let errors: Vec<f64> = data.rows.iter().map(error).collect();
        if errors.iter().any(|error| *error > 0.0) {
            correct(base, input, &errors, &mut rows, &mut noise);
        }
    }
    (rows, noise)
}

/// The same for one input whose errors, a share of every value, are not stated.
pub(super) fn assume(
    base: &Model,
    name: &str,
    share: f64,
    rows: &mut [Measurement],
    noise: &mut [Offset],
) -> Option<()> {
    let input = INPUTS.iter().find(|input| input.name == name)?;
    let errors: Vec<f64> = rows.iter().map(|row| share * (input.value)(&row.impact).abs()).collect();
    correct(base, input, &errors, rows, noise);
    Some(())
}

/// Corrects one input.
fn correct(base: &Model, input: &Input, errors: &[f64], rows: &mut [Measurement], noise: &mut [Offset]) {
    let values: Vec<f64> = rows.iter().map(|row| (input.value)(&row.impact)).collect();
    let truth = TrueValues::of(&values, errors);
    for (((row, offset), value), error) in rows.iter_mut().zip(noise).zip(values).zip(errors) {
        if *error <= 0.0 {
            continue;
        }
        let [expected, deviation] = truth.given(value, *error);
        (input.set)(&mut row.impact, expected);
        let Some([below, middle, above]) = around(base, input, row, deviation) else { continue };
        for which in 0..2 {
            offset.variance[which] += (0.5 * (above[which] - below[which])).powi(2);
            offset.restitution[which] += 0.5 * (above[which] + below[which]) - middle[which];
        }
    }
}

/// The distribution of the true values of an input on a grid.
struct TrueValues {
    grid: Vec<f64>,
    weights: Vec<f64>,
    /// Whether all errors are the same share of their reading: then they are of the true value, too.
    relative: bool,
}

impl TrueValues {
    fn of(values: &[f64], errors: &[f64]) -> Self {
        let [low, high] = ends(values);
        let step = (high - low) / (GRID_PLACES - 1) as f64;
        let grid: Vec<f64> = (0..GRID_PLACES).map(|place| low + step * place as f64).collect();
        let shares: Vec<f64> = values.iter().zip(errors).map(|(value, error)| error / value.abs()).collect();
        let [least, most] = ends(&shares);
        let relative = least > 0.0 && most < least * (1.0 + SAME_SHARE);
        let mut found = Self { weights: vec![1.0 / GRID_PLACES as f64; GRID_PLACES], grid, relative };
        let every = values.len().div_ceil(PRIOR_ROWS);
        let some = values.iter().zip(errors).step_by(every).filter(|(_, error)| **error > 0.0);
        let densities: Vec<Vec<f64>> = some.map(|(value, error)| found.densities(*value, *error)).collect();
        for _ in 0..ESTIMATE_STEPS {
            let mut sums = vec![0.0; GRID_PLACES];
            for row in &densities {
                let total: f64 = row.iter().zip(&found.weights).map(|(p, w)| p * w).sum();
                if total > 0.0 {
                    let shares = row.iter().zip(&found.weights).map(|(p, w)| p * w / total);
                    sums.iter_mut().zip(shares).for_each(|(sum, share)| *sum += share);
                }
            }
            let all: f64 = sums.iter().sum();
            if all > 0.0 {
                found.weights = sums.into_iter().map(|sum| sum / all).collect();
            }
        }
        found
    }

    /// Densities of a reading for every true value of the grid, but for a common factor.
    fn densities(&self, value: f64, error: f64) -> Vec<f64> {
        let share = error / value.abs();
        let one = |truth: &f64| {
            let sigma = if self.relative { (share * truth).abs().max(f64::MIN_POSITIVE) } else { error };
            (-0.5 * ((value - truth) / sigma).powi(2)).exp() / sigma
        };
        self.grid.iter().map(one).collect()
    }

    /// Expected true value of a reading and its standard deviation; of a single value far from all
    /// others, the reading and its error.
    fn given(&self, value: f64, error: f64) -> [f64; 2] {
        let shares: Vec<f64> =
            self.densities(value, error).iter().zip(&self.weights).map(|(p, w)| p * w).collect();
        let total: f64 = shares.iter().sum();
        if total <= 0.0 {
            return [value, error];
        }
        let mean = |of: &dyn Fn(f64) -> f64| {
            self.grid.iter().zip(&shares).map(|(truth, share)| of(*truth) * share).sum::<f64>() / total
        };
        let expected = mean(&|truth| truth);
        [expected, mean(&|truth| (truth - expected).powi(2)).sqrt()]
    }
}

/// The smallest and the largest value.
fn ends(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(*v), high.max(*v)])
}

/// `e_n` and `e_t` of the base model one deviation below, at, and one above the value of the input;
/// `None` where an impact there has no meaning.
fn around(base: &Model, input: &Input, row: &Measurement, deviation: f64) -> Option<[[f64; 2]; 3]> {
    let at = |step: f64| {
        let mut impact: Impact = row.impact;
        (input.set)(&mut impact, (input.value)(&row.impact) + step);
        let outcome = base.resolve_with(row.wall, &impact, |_| 0.5).ok()?;
        Some([outcome.normal_restitution, outcome.tangential_restitution])
    };
    Some([at(-deviation)?, at(0.0)?, at(deviation)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use nearwall::rng::ImpactRng;
    use statrs::distribution::{Continuous, ContinuousCDF, Normal};

    /// Between true values that are equally likely from 1 to 2, a reading says what a normal
    /// distribution cut off at 1 and 2 says.
    #[test]
    fn expected_values_are_those_of_a_cut_normal_distribution() {
        let error = 0.2;
        let seen = |key: u64| {
            let draw = ImpactRng::new(3, key);
            let noise = (10..22).map(|stream| draw.uniform(stream)).sum::<f64>() - 6.0;
            1.0 + draw.uniform(1) + error * noise
        };
        let values: Vec<f64> = (0..2000).map(seen).collect();
        let truth = TrueValues::of(&values, &vec![error; 2000]);
        let standard = Normal::standard();
        for reading in [0.9, 1.1, 1.5, 1.8, 2.1] {
            let [low, high] = [1.0, 2.0].map(|end| (end - reading) / error);
            let expected = reading
                + error * (standard.pdf(low) - standard.pdf(high)) / (standard.cdf(high) - standard.cdf(low));
            let [found, _] = truth.given(reading, error);
            assert!((found - expected).abs() < 0.03, "{reading}: {found} instead of {expected}");
        }
    }
}
