//! Model files drawn from a fit: their parameters scatter together as the data leave them open.
//!
//! The coordinates are drawn from a normal distribution about the fit, with the covariance of
//! [`super::covariance`] times the factors of its sandwich, widened as Student's t for few units,
//! and are clamped to their ranges. As for the intervals, parameters that were left at their
//! defaults are free. A coordinate at a bound is drawn from its interval. Curves stay as they are.

use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution as _, StandardNormal};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::covariance::Covariance;
use super::extend::extended;
use super::hypothesis::Hypothesis;
use super::interval::{UNITS_FOR_DEFAULTS, first_errors, steps};

/// Quantile of the normal distribution at the ends of a 95 % interval.
const NORMAL_QUANTILE: f64 = 1.959_964;

/// So many model files; none if the fit has no parameters. `base` is the text of the base model.
///
/// # Errors
/// When the base text cannot be edited.
pub(super) fn draws(
    base: &str,
    hypothesis: &Hypothesis<'_>,
    count: usize,
    seed: u64,
) -> Result<Vec<String>, toml_edit::TomlError> {
    if count == 0 || hypothesis.coordinates().is_empty() {
        return Ok(Vec::new());
    }
    let law = ParameterLaw::new(hypothesis);
    let draw = |number: usize| {
        let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x666f_7265);
        random.set_stream(number as u64);
        extended(base, &law.draw(&mut random))
    };
    (0..count).map(draw).collect()
}

/// The distribution of the coordinates.
struct ParameterLaw<'a> {
    fit: Hypothesis<'a>,
    /// The coordinates with a covariance, and its root.
    free: Vec<usize>,
    root: DMatrix<f64>,
    /// Coordinates drawn by themselves, with the distance of the end of their interval.
    alone: Vec<(usize, f64)>,
}

impl<'a> ParameterLaw<'a> {
    fn new(hypothesis: &Hypothesis<'a>) -> Self {
        let rows = &hypothesis.data.fit;
        let units = hypothesis.data.unit_count_of(rows);
        let stochastic = hypothesis.is_stochastic();
        let covariance = |fit: &Hypothesis<'_>| Covariance::of(fit, rows, &steps(&first_errors(fit, rows)));
        let mut fit = hypothesis.clone();
        if !stochastic && units >= UNITS_FOR_DEFAULTS {
            fit.free_defaults();
        }
        let mut found = covariance(&fit);
        if found.matrix.is_none() {
            fit = hypothesis.clone();
            found = covariance(&fit);
        }
        let at = fit.coordinates();
        let freedom = (units as f64 - at.len() as f64).max(1.0);
        let wider =
            StudentsT::new(0.0, 1.0, freedom).map_or(1.0, |law| law.inverse_cdf(0.975)) / NORMAL_QUANTILE;
        let deviation = |place: usize| wider * found.factors[found.free[place]].sqrt();
        let root = found.matrix.as_ref().and_then(|matrix| {
            let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| {
                deviation(i) * matrix[(i, j)] * deviation(j)
            });
            Some(scaled.cholesky()?.l())
        });
        let free = if root.is_some() { found.free } else { Vec::new() };
        let alone = own_intervals(hypothesis, &fit);
        let alone = alone.into_iter().filter(|(place, _)| !free.contains(place)).collect();
        Self { free, root: root.unwrap_or_else(|| DMatrix::zeros(0, 0)), alone, fit }
    }

    fn draw(&self, random: &mut ChaCha8Rng) -> Hypothesis<'a> {
        let mut at = self.fit.coordinates();
        let normal: DVector<f64> = DVector::from_fn(self.free.len(), |_, _| StandardNormal.sample(random));
        for (place, change) in self.free.iter().zip((&self.root * normal).iter()) {
            at[*place] = (at[*place] + change).clamp(0.0, 1.0);
        }
        for (place, end) in &self.alone {
            let normal: f64 = StandardNormal.sample(random);
            at[*place] = (at[*place] + normal.abs() / NORMAL_QUANTILE * end).clamp(0.0, 1.0);
        }
        let mut drawn = self.fit.with_coordinates(&at);
        // They are those of the fit.
        drawn.parts.iter_mut().for_each(|part| part.intervals.clear());
        drawn
    }
}

/// The coordinates of `fit` that have an interval, with the signed distance of its farther end.
fn own_intervals(hypothesis: &Hypothesis<'_>, fit: &Hypothesis<'_>) -> Vec<(usize, f64)> {
    let (mut first, mut found) = (0, Vec::new());
    for (part, freed) in hypothesis.parts.iter().zip(&fit.parts) {
        for (place, ((axis, at), interval)) in part.axes.iter().zip(&part.at).zip(&part.intervals).enumerate()
        {
            let [low, high] = interval.map(|end| axis.coordinate(end) - at);
            found.push((first + place, if high > -low { high } else { low }));
        }
        first += freed.axes.len();
    }
    found
}
