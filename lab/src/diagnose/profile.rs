//! The profile of the likelihood: its maximum over all other coordinates with one of them fixed.
//!
//! Its root `r(x) = sqrt(2 (l_max - l(x)))` is the distance in standard errors, whatever the shape
//! of the likelihood (Venzon and Moolgavkar 1988). An interval ends where `r` exceeds a quantile
//! for good: laws with jumps, such as that from sliding to rolling, make the likelihood rough, and
//! `r` may cross the quantile more than once.

use std::cell::Cell;

use super::hypothesis::Hypothesis;
use super::likelihood::{Offset, Scatter};
use super::search::descend;

/// Rise above the summit [nats] that makes it a foothill.
const HIGHER: f64 = 0.05;
/// The walk ends where `r` exceeds the quantile by this factor.
const WALK_END: f64 = 1.4;
/// Steps of the walk, in shares of the quantile.
const WALK_STEP: f64 = 0.5;
/// Shortest step in the coordinate.
const SHORTEST: f64 = 1e-4;
/// Largest number of places on a walk.
const MOST_WALKED: usize = 16;
/// Size of the first simplex of the other coordinates, and its iterations for each of them.
const PROFILE_SIMPLEX: f64 = 0.03;
const PROFILE_ITERATIONS: u64 = 25;

/// The likelihood of some rows about its summit.
pub(super) struct LikelihoodProfile<'a> {
    hypothesis: &'a Hypothesis<'a>,
    rows: &'a [usize],
    offsets: Vec<Offset>,
    /// Coordinates of the summit.
    at: Vec<f64>,
    /// Its log score [nats].
    summit: f64,
}

/// All coordinates of a place that is higher than the summit.
pub(super) struct Higher(pub Vec<f64>);

/// A place on the profile.
#[derive(Clone)]
struct ProfilePoint {
    at: Vec<f64>,
    /// Distance from the summit [standard errors].
    root: f64,
}

impl<'a> LikelihoodProfile<'a> {
    /// About the present coordinates.
    pub fn new(hypothesis: &'a Hypothesis<'a>, rows: &'a [usize]) -> Self {
        let (at, offsets) = (hypothesis.coordinates(), hypothesis.offsets());
        let mut profile = Self { hypothesis, rows, offsets, at, summit: 0.0 };
        profile.summit = profile.score(&profile.at, &Cell::new(hypothesis.scatter));
        profile
    }

    /// Log score at these coordinates [nats]; the scatter is fitted from that of the `last` ones, which are near.
    fn score(&self, at: &[f64], last: &Cell<Scatter>) -> f64 {
        let rows = self.hypothesis.with_coordinates(at).evaluate(self.rows, &self.offsets);
        let fitted = rows.with_scatter(last.get()).with_fitted_scatter();
        last.set(fitted.scatter);
        fitted.score()
    }

    /// The outermost coordinate in the direction `sign` at which `r` is at most `quantile`; `error`
    /// is a guess of the standard error.
    pub fn end(&self, coordinate: usize, sign: f64, quantile: f64, error: f64) -> Result<f64, Higher> {
        let bound = if sign > 0.0 { 1.0 } else { 0.0 };
        let mut step = WALK_STEP * quantile * error;
        let mut last = ProfilePoint { at: self.at.clone(), root: 0.0 };
        let mut end = self.at[coordinate];
        for _ in 0..MOST_WALKED {
            let from = last.at[coordinate];
            if from == bound || last.root > WALK_END * quantile {
                break;
            }
            let place = self.place(coordinate, (from + sign * step).clamp(0.0, 1.0), &last)?;
            let to = place.at[coordinate];
            if place.root <= quantile {
                end = to;
            } else if last.root <= quantile {
                end = from + (to - from) * (quantile - last.root) / (place.root - last.root);
            }
            let rise = (place.root - last.root) / (WALK_STEP * quantile);
            step = (step / rise.clamp(0.5, 2.0)).max(SHORTEST);
            last = place;
        }
        Ok(end)
    }

    /// The profile at a value of a coordinate; the others start as at `near`.
    fn place(&self, coordinate: usize, value: f64, near: &ProfilePoint) -> Result<ProfilePoint, Higher> {
        let others = |at: &[f64]| [&at[..coordinate], &at[coordinate + 1..]].concat();
        let whole = |others: &[f64]| [&others[..coordinate], &[value], &others[coordinate..]].concat();
        let last = Cell::new(self.hypothesis.scatter);
        let cost = |some: &[f64]| -self.score(&whole(some), &last);
        // Straight on from the summit through the nearest place, or as there, whichever is better.
        let walked = near.at[coordinate] - self.at[coordinate];
        let further = if walked == 0.0 { 1.0 } else { (value - self.at[coordinate]) / walked };
        let along = |(to, from): (&f64, &f64)| (from + further * (to - from)).clamp(0.0, 1.0);
        let straight: Vec<f64> = near.at.iter().zip(&self.at).map(along).collect();
        let [one, other] = [others(&near.at), others(&straight)].map(|start| (cost(&start), start));
        let (first, start) = if one.0 < other.0 { one } else { other };
        let (found, least) = match start.len() {
            0 => (start, first),
            count => descend(cost, &start, PROFILE_SIMPLEX, PROFILE_ITERATIONS * count as u64),
        };
        let at = whole(&found);
        let fall = self.summit + least;
        if fall < -HIGHER {
            Err(Higher(at))
        } else {
            Ok(ProfilePoint { at, root: (2.0 * fall.max(0.0)).sqrt() })
        }
    }
}
