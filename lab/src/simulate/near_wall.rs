//! Time that a particle spends near each wall, and in the part of a pipe that belongs to it.
//!
//! A particle is near a wall while the gap between its surface and the wall is at most a given
//! distance. The centre is then in a layer of exactly that thickness, whatever the size of the
//! particle, so that time over volume is a concentration that can be compared with that in the
//! whole cross-section. Within a step the path is that of the dense output; where the particle
//! comes near is found by bisection.

use super::flight::Step;
use super::motion::{Body, CONVERSION, PATH_POINTS, ParticleState, position, reach};
use super::surface::{Surface, SurfaceKind, SurfaceShape};

/// Halvings of the piece of a path on which the particle comes near a wall or leaves it.
const NEAR_WALL_HALVINGS: u32 = 30;

/// Times at one surface [s].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StayTime {
    /// Near the wall.
    pub near: f64,
    /// In the whole cross-section of the pipe, between the ends of this part; 0 for a plane.
    pub section: f64,
}

/// Times at all surfaces; empty when they are not asked for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StayTimes {
    /// Gap up to which a particle is near a wall [m].
    distance: f64,
    /// In the order of the surfaces.
    pub times: Vec<StayTime>,
}

impl StayTimes {
    /// No time yet at any of so many surfaces.
    pub(super) fn new(distance: f64, surfaces: usize) -> Self {
        Self { distance, times: vec![StayTime::default(); surfaces] }
    }

    /// Adds a step up to `end`, its time and state; `at` gives the states in it.
    pub(super) fn add(
        &mut self,
        step: &Step,
        at: &mut impl FnMut(f64) -> ParticleState,
        surfaces: &[Surface],
        body: &Body,
        (to, after): (f64, ParticleState),
    ) {
        let (from, before) = (step.times[0], step.states[0]);
        let mut path = Path { states: at, from, to, before, after, places: Vec::new() };
        let reach = reach(to - from, &before, &after);
        for (time, surface) in self.times.iter_mut().zip(surfaces) {
            if !matches!(surface.kind, SurfaceKind::Wall { .. }) {
                continue;
            }
            let gap =
                |state: &ParticleState| surface.gap(&position(state), body.diameter_at(state[CONVERSION]));
            let [begin, end] = bounds(&surface.shape);
            let coordinate = |state: &ParticleState| surface.shape.coordinate(&position(state));
            let inside = |one: &ParticleState, other: &ParticleState| {
                between([begin, end], coordinate(one), coordinate(other))
            };
            if gap(&before) <= self.distance + reach {
                path.each(|duration, one, other, at| {
                    let near = below(self.distance, &gap, [one, other], at);
                    time.near += duration * overlap(near, inside(one, other));
                });
            }
            let is_pipe = matches!(surface.shape, SurfaceShape::Pipe { .. });
            let [one, other] = [&before, &after].map(coordinate);
            if is_pipe && [one, other].iter().all(|z| (begin..=end).contains(z)) {
                time.section += to - from;
            } else if is_pipe && one.min(other) - reach <= end && one.max(other) + reach >= begin {
                path.each(|duration, one, other, _| {
                    time.section += duration * overlap([0.0, 1.0], inside(one, other));
                });
            }
        }
    }
}

/// The coordinates between which a surface lies [m].
fn bounds(shape: &SurfaceShape) -> [f64; 2] {
    match *shape {
        SurfaceShape::Plane { radius, .. } => [f64::NEG_INFINITY, radius.unwrap_or(f64::INFINITY)],
        SurfaceShape::Pipe { zone, .. } => zone,
    }
}

/// The part of a straight piece from `one` to `other`, from 0 to 1, on which the value lies within limits.
fn between([low, high]: [f64; 2], one: f64, other: f64) -> [f64; 2] {
    if one == other {
        return if (low..=high).contains(&one) { [0.0, 1.0] } else { [0.0, 0.0] };
    }
    let [at_low, at_high] = [low, high].map(|limit| ((limit - one) / (other - one)).clamp(0.0, 1.0));
    [at_low.min(at_high), at_low.max(at_high)]
}

/// The part of a piece, from 0 to 1, on which the gap is at most `limit`; `at` gives the state on the piece.
fn below(
    limit: f64,
    gap: &impl Fn(&ParticleState) -> f64,
    [one, other]: [&ParticleState; 2],
    at: &mut dyn FnMut(f64) -> ParticleState,
) -> [f64; 2] {
    match [one, other].map(|state| gap(state) <= limit) {
        [true, true] => [0.0, 1.0],
        [false, false] => [0.0, 0.0],
        [first, _] => {
            let [mut from, mut to] = [0.0, 1.0];
            for _ in 0..NEAR_WALL_HALVINGS {
                let middle = 0.5 * (from + to);
                if (gap(&at(middle)) <= limit) == first { from = middle } else { to = middle }
            }
            if first { [0.0, from] } else { [to, 1.0] }
        }
    }
}

/// Length that two parts have in common.
fn overlap([from, to]: [f64; 2], [begin, end]: [f64; 2]) -> f64 {
    (to.min(end) - from.max(begin)).max(0.0)
}

/// The path of one step.
struct Path<'a, F> {
    states: &'a mut F,
    from: f64,
    to: f64,
    before: ParticleState,
    after: ParticleState,
    /// Filled at the first use.
    places: Vec<ParticleState>,
}

impl<F: FnMut(f64) -> ParticleState> Path<'_, F> {
    /// Calls with the duration and both ends of each piece, and with its states from 0 to 1.
    fn each(
        &mut self,
        mut piece: impl FnMut(f64, &ParticleState, &ParticleState, &mut dyn FnMut(f64) -> ParticleState),
    ) {
        let duration = (self.to - self.from) / f64::from(PATH_POINTS);
        if self.places.is_empty() {
            self.places.push(self.before);
            for place in 1..PATH_POINTS {
                let time = self.from + duration * f64::from(place);
                self.places.push((self.states)(time));
            }
            self.places.push(self.after);
        }
        for (place, pair) in self.places.windows(2).enumerate() {
            let begin = self.from + duration * place as f64;
            let mut at = |share: f64| (self.states)(begin + duration * share);
            piece(duration, &pair[0], &pair[1], &mut at);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_part_within_limits_is_that_of_a_straight_line() {
        assert_eq!(between([1.0, 2.0], 0.0, 4.0), [0.25, 0.5]);
        assert_eq!(between([1.0, 2.0], 4.0, 0.0), [0.5, 0.75]);
        assert_eq!(between([f64::NEG_INFINITY, 1.0], 4.0, 0.0), [0.75, 1.0]);
        assert_eq!(between([f64::NEG_INFINITY, 1.0], 0.0, 4.0), [0.0, 0.25]);
        assert_eq!(between([f64::NEG_INFINITY, f64::INFINITY], 4.0, 0.0), [0.0, 1.0]);
        assert_eq!(overlap([0.0, 1.0], between([1.0, 2.0], 3.0, 5.0)), 0.0);
        assert_eq!(overlap([0.0, 1.0], between([1.0, 2.0], 1.5, 1.5)), 1.0);
        assert_eq!(overlap([0.0, 0.4], [0.3, 0.9]), 0.4 - 0.3);
        assert_eq!(overlap([0.0, 0.4], [0.5, 0.9]), 0.0);
    }
}
