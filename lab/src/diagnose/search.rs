//! Minimises a cost over parameters from given places, by the simplex method of Nelder and Mead (crate argmin).
//!
//! Every parameter has a coordinate from 0 to 1 over its search range.

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::neldermead::NelderMead;

use nearwall::effect::{Parameter, Search};

/// The descent ends when the standard deviation of the simplex' costs falls below this [nats].
const SIMPLEX_TOLERANCE: f64 = 0.01;

/// The search range of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SearchAxis {
    low: f64,
    high: f64,
    logarithmic: bool,
    /// Whether the parameter could lie beyond each end.
    open: [bool; 2],
}

/// A coordinate nearer than this to 0 or 1 is at an end.
const AT_END: f64 = 0.005;
/// Nearer than this to an end a coordinate costs something: where the data do not tell, it stays away from the end.
const EDGE: f64 = 0.1;
/// What the end itself costs [nats]: one standard error.
const EDGE_COST: f64 = 0.5;

impl SearchAxis {
    /// A linear axis.
    pub fn linear(low: f64, high: f64) -> Self {
        Self { low, high, logarithmic: false, open: [true; 2] }
    }

    /// An axis of factors.
    pub fn logarithmic(low: f64, high: f64) -> Self {
        Self { logarithmic: true, ..Self::linear(low, high) }
    }

    /// The axis of a parameter that begins lower by a factor, as far as its bounds allow.
    pub fn lowered(self, factor: f64, parameter: &Parameter) -> Self {
        let least = parameter.bounds.0;
        let low = (factor * self.low).max(least);
        Self { low, open: [low > least, self.open[1]], ..self }
    }

    /// Whether a coordinate is at an end beyond which the parameter could lie.
    pub fn is_at_end(self, at: f64) -> bool {
        (self.open[0] && at < AT_END) || (self.open[1] && at > 1.0 - AT_END)
    }

    /// The axis of a parameter; `range` gives the least and largest value of an input in the data. `None` if the input
    /// that sets the range does not vary, or only outside the bounds of the parameter, as in a wrong unit.
    pub fn of(parameter: &Parameter, range: impl Fn(&str) -> Option<[f64; 2]>) -> Option<Self> {
        let (least, most) = parameter.bounds;
        let within = |low: f64, high: f64, logarithmic| {
            let (low, high) = (low.max(least), high.min(most));
            (low < high).then_some(Self { low, high, logarithmic, open: [low > least, high < most] })
        };
        match parameter.search {
            Search::Linear(low, high) => within(low, high, false),
            Search::Log(low, high) => within(low, high, true),
            Search::InputRange(input) => range(input).and_then(|[low, high]| within(low, high, false)),
            Search::InputWidth(input) => {
                range(input).and_then(|[low, high]| within((high - low) / 50.0, 4.0 * (high - low), true))
            }
        }
    }

    /// The parameter at a coordinate, which is clamped to 0 to 1.
    pub fn value(self, coordinate: f64) -> f64 {
        let share = coordinate.clamp(0.0, 1.0);
        if self.logarithmic {
            self.low * (self.high / self.low).powf(share)
        } else {
            self.low + share * (self.high - self.low)
        }
    }

    /// The coordinate of a value, from 0 to 1.
    pub fn coordinate(self, value: f64) -> f64 {
        let share = if self.logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        share.clamp(0.0, 1.0)
    }
}

/// A cost with a penalty outside 0 to 1 and a small one near the ends, for argmin.
struct Bounded<F>(F);

impl<F: Fn(&[f64]) -> f64> CostFunction for Bounded<F> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, at: &Self::Param) -> Result<f64, Error> {
        let outside: f64 = at.iter().map(|c| (c - c.clamp(0.0, 1.0)).abs()).sum();
        let cost = (self.0)(at);
        let near = |c: &f64| (1.0 - c.min(1.0 - c) / EDGE).clamp(0.0, 1.0);
        let edges: f64 = at.iter().map(near).sum();
        Ok(if cost.is_finite() { cost + 1e3 * outside + EDGE_COST * edges } else { 1e30 })
    }
}

/// A local minimum from `start`, with an initial simplex of this size and at most `rounds` iterations; and its cost.
pub(super) fn descend(
    cost: impl Fn(&[f64]) -> f64,
    start: &[f64],
    size: f64,
    rounds: u64,
) -> (Vec<f64>, f64) {
    descend_to(SIMPLEX_TOLERANCE, cost, start, size, rounds)
}

/// The same to a tolerance [nats].
pub(super) fn descend_to(
    tolerance: f64,
    cost: impl Fn(&[f64]) -> f64,
    start: &[f64],
    size: f64,
    rounds: u64,
) -> (Vec<f64>, f64) {
    let corner = |moved: usize| {
        let mut corner = start.to_vec();
        // No corner lies outside 0 to 1.
        corner[moved] += if corner[moved] + size > 1.0 { -size } else { size };
        corner
    };
    let simplex: Vec<Vec<f64>> =
        std::iter::once(start.to_vec()).chain((0..start.len()).map(corner)).collect();
    let fallback = || (start.to_vec(), cost(start));
    let Ok(solver) = NelderMead::new(simplex).with_sd_tolerance(tolerance) else { return fallback() };
    let run = Executor::new(Bounded(&cost), solver).configure(|state| state.max_iters(rounds)).run();
    let Ok(result) = run else { return fallback() };
    let Some(at) = result.state.best_param else { return fallback() };
    let at: Vec<f64> = at.iter().map(|c| c.clamp(0.0, 1.0)).collect();
    // Without what the ends cost.
    let least = cost(&at);
    (at, least)
}

/// The places of smallest cost, at most `count`.
pub(super) fn best_of(cost: impl Fn(&[f64]) -> f64, places: &[Vec<f64>], count: usize) -> Vec<Vec<f64>> {
    let mut all: Vec<(&Vec<f64>, f64)> = places.iter().map(|place| (place, cost(place))).collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all.into_iter().take(count).map(|(place, _)| place.clone()).collect()
}

/// The places of a grid with so many steps along each coordinate.
pub(super) fn grid(dimensions: usize, steps: usize) -> Vec<Vec<f64>> {
    let place = |index: usize| {
        let digit = |axis: usize| (index / steps.pow(axis as u32)) % steps;
        (0..dimensions).map(|axis| (digit(axis) as f64 + 0.5) / steps as f64).collect()
    };
    (0..steps.pow(dimensions as u32)).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grid_and_descent_find_a_minimum_at_a_bound_and_inside() {
        let cost = |x: &[f64]| 1e4 * (x[0] - 0.31).powi(2) + 1e5 * (x[1] - 1.2).powi(2);
        let places: Vec<Vec<f64>> =
            (0..9).map(|i| vec![f64::from(i % 3) / 3.0, f64::from(i / 3) / 3.0]).collect();
        let start = best_of(cost, &places, 1).remove(0);
        let (at, _) = descend(cost, &start, 0.1, 200);
        assert!((at[0] - 0.31).abs() < 0.02 && at[1] > 0.99, "{at:?}");
    }

    /// Steps that are as sharp as the distance of two readings: all narrower ones fit alike.
    #[test]
    fn where_the_data_leave_the_end_open_a_coordinate_is_not_at_it() {
        let axis = SearchAxis::linear(0.0, 1.0);
        let flat = |x: &[f64]| 50.0 * (x[0] - 0.1).max(0.0) + 1e3 * (x[1] - 0.4).powi(2);
        let (at, _) = descend(flat, &[0.05, 0.45], 0.1, 200);
        assert!(!axis.is_at_end(at[0]) && at[0] < 0.11, "{at:?}");
        let steep = |x: &[f64]| 60.0 * x[0];
        assert!(axis.is_at_end(descend(steep, &[0.05], 0.1, 200).0[0]));
    }
}
