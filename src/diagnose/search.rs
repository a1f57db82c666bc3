//! Finds the parameters that fit best: a coarse grid, then the simplex search of Nelder and Mead (crate argmin).
//!
//! A parameter is searched in a coordinate that runs from 0 to 1 over its search range.

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::neldermead::NelderMead;

use crate::effect::{Parameter, Search};

/// The descent ends where the simplex' costs agree to this [nats].
const TOLERANCE: f64 = 0.01;

/// A parameter's range in this data set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Axis {
    /// From one value to another, evenly.
    pub fn linear(low: f64, high: f64) -> Self {
        Self { low, high, logarithmic: false }
    }

    fn log(low: f64, high: f64) -> Self {
        Self { low, high, logarithmic: true }
    }

    /// The axis of a parameter; `range` gives the least and largest value that the data have of an input. `None` where
    /// the data do not vary in the input that sets the range, or only beyond what makes sense for the parameter: a wrong
    /// unit, say, from which a fit would write a model that cannot be read.
    pub fn of(parameter: &Parameter, range: impl Fn(&str) -> Option<[f64; 2]>) -> Option<Self> {
        let (least, most) = parameter.bounds;
        let within = |low: f64, high: f64| {
            let (low, high) = (low.max(least), high.min(most));
            (low < high).then_some((low, high))
        };
        match parameter.search {
            Search::Linear(low, high) => Some(Self::linear(low, high)),
            Search::Log(low, high) => Some(Self::log(low, high)),
            Search::InputRange(input) => {
                let [low, high] = range(input)?;
                within(low, high).map(|(low, high)| Self::linear(low, high))
            }
            Search::InputWidth(input) => {
                let [low, high] = range(input)?;
                within((high - low) / 50.0, 4.0 * (high - low)).map(|(low, high)| Self::log(low, high))
            }
        }
    }

    /// The parameter at a coordinate, which is kept within 0 and 1.
    pub fn value(self, coordinate: f64) -> f64 {
        let share = coordinate.clamp(0.0, 1.0);
        if self.logarithmic {
            self.low * (self.high / self.low).powf(share)
        } else {
            self.low + share * (self.high - self.low)
        }
    }
}

/// A cost with a wall around 0 to 1, for argmin.
struct Walled<F>(F);

impl<F: Fn(&[f64]) -> f64> CostFunction for Walled<F> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, at: &Self::Param) -> Result<f64, Error> {
        let outside: f64 = at.iter().map(|c| (c - c.clamp(0.0, 1.0)).abs()).sum();
        let cost = (self.0)(at);
        Ok(if cost.is_finite() { cost + 1e3 * outside } else { 1e30 })
    }
}

/// The minimum near `start`, with a simplex of this size, and the cost there.
pub(super) fn descend(
    cost: impl Fn(&[f64]) -> f64,
    start: &[f64],
    size: f64,
    rounds: u64,
) -> (Vec<f64>, f64) {
    let corner = |moved: usize| {
        let mut corner = start.to_vec();
        // Away from the nearer end, so that no corner lies outside.
        corner[moved] += if corner[moved] + size > 1.0 { -size } else { size };
        corner
    };
    let simplex: Vec<Vec<f64>> =
        std::iter::once(start.to_vec()).chain((0..start.len()).map(corner)).collect();
    let fallback = || (start.to_vec(), cost(start));
    let Ok(solver) = NelderMead::new(simplex).with_sd_tolerance(TOLERANCE) else { return fallback() };
    let run = Executor::new(Walled(&cost), solver).configure(|state| state.max_iters(rounds)).run();
    let Ok(result) = run else { return fallback() };
    match result.state.best_param {
        Some(at) => (at.iter().map(|c| c.clamp(0.0, 1.0)).collect(), result.state.best_cost),
        None => fallback(),
    }
}

/// The best places of a grid over all coordinates, at most `count` of them, no two of them neighbours.
pub(super) fn best_of_grid(cost: impl Fn(&[f64]) -> f64, dimensions: usize, count: usize) -> Vec<Vec<f64>> {
    let steps = [1, 24, 9, 5][dimensions.min(3)];
    let size = usize::pow(steps, dimensions as u32);
    let point = |index: usize| {
        let digit = |place: usize| (index / usize::pow(steps, place as u32)) % steps;
        (0..dimensions).map(|place| (digit(place) as f64 + 0.5) / steps as f64).collect::<Vec<f64>>()
    };
    let mut all: Vec<(Vec<f64>, f64)> = (0..size).map(|index| (point(index), cost(&point(index)))).collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut best: Vec<Vec<f64>> = Vec::new();
    for (place, _) in all {
        let near =
            |other: &Vec<f64>| place.iter().zip(other).all(|(a, b)| (a - b).abs() * (steps as f64) < 1.5);
        if best.len() < count && !best.iter().any(near) {
            best.push(place);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grid_and_descent_find_a_minimum_at_the_wall_and_inside() {
        let cost = |x: &[f64]| 1e4 * (x[0] - 0.31).powi(2) + 1e5 * (x[1] - 1.2).powi(2);
        let start = best_of_grid(cost, 2, 1).remove(0);
        let (at, _) = descend(cost, &start, 0.1, 200);
        assert!((at[0] - 0.31).abs() < 0.02 && at[1] > 0.99, "{at:?}");
    }
}
