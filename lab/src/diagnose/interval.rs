//! 95 % intervals of fitted parameters by profile likelihood, and what the data cannot separate.
//!
//! The root of the profile ([`super::profile`]) reaches Student's quantile at the ends, times the
//! square root of the factor by which units that scatter more than the model says widen the
//! variance ([`super::covariance`]). Parameters that were left at their defaults are free beside
//! the others, and so is the ceiling of captures: the data do not know that the defaults are right. An end at the
//! bound of the search range is that bound. Models that draw at random take too long for profiles: their intervals are
//! symmetric in the coordinate.

use std::ops::Range;

use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::covariance::Covariance;
use super::hypothesis::Hypothesis;
use super::profile::{Higher, LikelihoodProfile};
use super::search::SearchAxis;

/// First step of the differences, in the coordinate; the next is a standard error within these bounds.
const FIRST_STEP: f64 = 8e-3;
const DIFFERENCE_STEPS: [f64; 2] = [2e-4, 4e-2];
/// Standard error of a coordinate of which nothing is known yet, and of one that nothing determines.
const UNKNOWN_ERROR: f64 = 0.05;
/// Correlation of two parameters from which the data determine only their combination.
const INSEPARABLE: f64 = 0.97;
/// Largest number of times that a profile may find a better fit.
const SUMMITS: usize = 4;
/// With fewer independent units the defaults are taken for right.
pub(super) const UNITS_FOR_DEFAULTS: usize = 30;

/// Intervals of all coordinates and their covariance.
struct FoundIntervals {
    ends: Vec<[f64; 2]>,
    covariance: Covariance,
}

/// Sets the 95 % intervals of all parts, fitted to these rows, and what cannot be separated. A
/// profile may find a better fit, which then is the fit.
pub(super) fn set_intervals(hypothesis: &mut Hypothesis<'_>, rows: &[usize]) {
    if hypothesis.coordinates().is_empty() {
        return;
    }
    let units = hypothesis.data.unit_count_of(rows);
    let mut freed = hypothesis.clone();
    let stochastic = hypothesis.is_stochastic();
    if !stochastic && units >= UNITS_FOR_DEFAULTS {
        freed.free_defaults();
        freed.captures = freed.captures.free();
        freed.polish(rows);
    }
    let count = freed.coordinates().len();
    let freedom = (units as f64 - count as f64).max(1.0);
    let quantile = StudentsT::new(0.0, 1.0, freedom).map_or(2.0, |law| law.inverse_cdf(0.975));
    let found =
        if stochastic { symmetric(&freed, rows, quantile) } else { climbed(&mut freed, rows, quantile) };
    if hypothesis.coordinates().len() == count && hypothesis.captures.freedom() == freed.captures.freedom() {
        *hypothesis = freed.clone();
    }
    let FoundIntervals { ends, covariance } = found;
    let mut place = 0;
    for (part, freed) in hypothesis.parts.iter_mut().zip(&freed.parts) {
        let own = place..place + part.axes.len();
        place += freed.axes.len();
        part.inseparable = inseparable(&covariance, own.clone());
        let interval = |((axis, at), ends): ((&SearchAxis, &f64), &[f64; 2])| {
            // With the defaults free the best fit lies elsewhere.
            let mut ends = [axis.value(ends[0].min(*at)), axis.value(ends[1].max(*at))];
            ends.sort_by(f64::total_cmp);
            ends
        };
        part.intervals = part.axes.iter().zip(&part.at).zip(&ends[own]).map(interval).collect();
    }
}

/// The intervals by profiles, around the highest fit that they find.
fn climbed(freed: &mut Hypothesis<'_>, rows: &[usize], quantile: f64) -> FoundIntervals {
    for _ in 0..SUMMITS {
        match profiled(freed, rows, quantile) {
            Ok(intervals) => return intervals,
            Err(Higher(at)) => {
                *freed = freed.with_coordinates(&at);
                freed.polish(rows);
            }
        }
    }
    // A profile that finds a better fit again and again has no ends.
    symmetric(freed, rows, quantile)
}

/// Standard errors of the coordinates from differences over short steps.
pub(super) fn first_errors(hypothesis: &Hypothesis<'_>, rows: &[usize]) -> Vec<f64> {
    let count = hypothesis.coordinates().len();
    let first = Covariance::of(hypothesis, rows, &vec![FIRST_STEP; count]);
    (0..count).map(|place| first.error(place).unwrap_or(UNKNOWN_ERROR)).collect()
}

/// Steps of the differences from standard errors.
pub(super) fn steps(errors: &[f64]) -> Vec<f64> {
    errors.iter().map(|error| error.clamp(DIFFERENCE_STEPS[0], DIFFERENCE_STEPS[1])).collect()
}

/// Without profiles.
fn symmetric(hypothesis: &Hypothesis<'_>, rows: &[usize], quantile: f64) -> FoundIntervals {
    let covariance = Covariance::of(hypothesis, rows, &steps(&first_errors(hypothesis, rows)));
    let of = |(place, at): (usize, f64)| {
        let error = covariance.error(place).unwrap_or(1.0) * covariance.factors[place].sqrt();
        [at - quantile * error, at + quantile * error]
    };
    let ends = hypothesis.coordinates().into_iter().enumerate().map(of).collect();
    FoundIntervals { ends, covariance }
}

/// By profiles, first for an exact model, then with the factors of the sandwich over the errors that follow.
fn profiled(hypothesis: &Hypothesis<'_>, rows: &[usize], quantile: f64) -> Result<FoundIntervals, Higher> {
    let profile = LikelihoodProfile::new(hypothesis, rows);
    let walk = |place: usize, quantile: f64, error: f64| {
        let end = |sign| profile.end(place, sign, quantile, error);
        let (low, high) = rayon::join(|| end(-1.0), || end(1.0));
        Ok([low?, high?])
    };
    let first = first_errors(hypothesis, rows);
    let count = first.len();
    let plain = |place: usize| walk(place, quantile, first[place]);
    let ends = all_or_first_higher((0..count).into_par_iter().map(plain).collect())?;
    let errors: Vec<f64> = ends.iter().map(|[low, high]| 0.5 * (high - low) / quantile).collect();
    let covariance = Covariance::of(hypothesis, rows, &steps(&errors));
    let wider = |place: usize| {
        let factor = covariance.factors[place].sqrt();
        if factor > 1.0 { walk(place, quantile * factor, errors[place]) } else { Ok(ends[place]) }
    };
    let ends = all_or_first_higher((0..count).into_par_iter().map(wider).collect())?;
    Ok(FoundIntervals { ends, covariance })
}

/// The ends of all walks, or the first place that is higher, whichever thread finds one first.
fn all_or_first_higher(walks: Vec<Result<[f64; 2], Higher>>) -> Result<Vec<[f64; 2]>, Higher> {
    walks.into_iter().collect()
}

/// Pairs of a part's parameters, by place, of which the data determine only a combination, with their correlation [1].
fn inseparable(found: &Covariance, own: Range<usize>) -> Vec<([usize; 2], f64)> {
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
