//! The path of one particle from one contact to the next.
//!
//! Dormand–Prince 5(4) with its own step control integrates [`super::motion`]; contacts are found on its
//! dense output. Where drag or heating are so fast that they alone keep its steps short, as of particles of some
//! micrometres, Radau IIA of order 5 goes on, whose steps follow the flow; where its iteration does not converge, the
//! first takes over again.

use differential_equations::error::Error;
use differential_equations::methods::{ExplicitRungeKutta, ImplicitRungeKutta};
use differential_equations::status::Status;

use super::error::SimulationError;
use super::motion::{
    Body, CONVERSION, PATH_POINTS, ParticleMotion, ParticleState, PathSolver, position, reach, velocity,
};
use super::near_wall::StayTimes;
use super::surface::{Surface, SurfaceShape};

/// End of a flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlightEnd {
    /// Time [s].
    pub time: f64,
    /// State of the particle there.
    pub state: ParticleState,
    /// Index of the surface that was reached; `None` when the time was up.
    pub surface: Option<usize>,
}

/// Integration steps of one flight before it is given up.
const STEP_LIMIT: usize = 200_000;
/// Steps after which an explicit method is asked whether stability alone keeps them short.
const LOOKED_AT: usize = 30;
/// Step over the time in which a particle takes on what the gas has, from which on that is so; the method is stable
/// up to 3.3 [1].
const NEAR_LIMIT: f64 = 2.0;
/// Tolerance from which on only relative errors of velocity, temperature and conversion grow with it [1].
const FINE: f64 = 1e-6;
/// Most iterations until a contact is found.
const CONTACT_ITERATIONS: u32 = 80;
/// Gap at a contact, in diameters.
pub(super) const NEAR: f64 = 1e-10;

/// Follows a particle from `start` at `time` until it touches a surface or the time `until` is reached.
///
/// `tolerance` is the relative error allowed per step [1]. A particle reaches a surface only from its front; one that
/// starts behind a surface does not touch it.
///
/// # Errors
/// [`SimulationError`] when the path cannot be followed.
pub fn fly(
    motion: &ParticleMotion<'_>,
    surfaces: &[Surface],
    time: f64,
    until: f64,
    start: &ParticleState,
    tolerance: f64,
) -> Result<FlightEnd, SimulationError> {
    fly_timed(motion, surfaces, [time, until], start, tolerance, &mut StayTimes::default())
}

/// [`fly`] from `time` to `until`, adding the time that the particle spends near the walls to `stays`.
pub(super) fn fly_timed(
    motion: &ParticleMotion<'_>,
    surfaces: &[Surface],
    [time, until]: [f64; 2],
    start: &ParticleState,
    tolerance: f64,
    stays: &mut StayTimes,
) -> Result<FlightEnd, SimulationError> {
    let [relative, absolute] = tolerances(tolerance, &motion.body);
    let flight = Flight { motion, surfaces, until };
    let (mut now, mut here) = (time, *start);
    loop {
        let explicit = ExplicitRungeKutta::dopri5().rtol(relative.clone()).atol(absolute.clone());
        let explicit = Method { solver: explicit.max_steps(STEP_LIMIT), is_implicit: false };
        let (later, there) = match flight.follow(explicit, now, &here, stays)? {
            Flown::Finished(end) => return Ok(end),
            Flown::HandedOver(later, there) => (later, there),
        };
        let implicit = ImplicitRungeKutta::radau5().rtol(relative.clone()).atol(absolute.clone());
        let implicit = Method { solver: implicit.max_steps(STEP_LIMIT), is_implicit: true };
        (now, here) = match flight.follow(implicit, later, &there, stays)? {
            Flown::Finished(end) => return Ok(end),
            // Neither method gets on from here.
            Flown::HandedOver(last, _) if last <= now => return Err(SimulationError::NotFinite),
            Flown::HandedOver(last, there) => (last, there),
        };
    }
}

/// A method of integration.
struct Method<S> {
    solver: S,
    is_implicit: bool,
}

/// A particle, what it can touch, and the time [s] at which its flight ends.
struct Flight<'a> {
    motion: &'a ParticleMotion<'a>,
    surfaces: &'a [Surface],
    until: f64,
}

/// How far an integration came.
enum Flown {
    Finished(FlightEnd),
    /// Time [s] and state from which the other method should go on.
    HandedOver(f64, ParticleState),
}

impl Flight<'_> {
    /// Integrates from a state at a time to the first contact or the end.
    fn follow(
        &self,
        Method { mut solver, is_implicit }: Method<impl PathSolver>,
        time: f64,
        start: &ParticleState,
        stays: &mut StayTimes,
    ) -> Result<Flown, SimulationError> {
        let &Self { motion, surfaces, until } = self;
        if time >= until {
            // An integration over no time is an error to the solver.
            return Ok(Flown::Finished(FlightEnd { time, state: *start, surface: None }));
        }
        solver.init(motion, time, until, start).map_err(|_| SimulationError::NotFinite)?;
        let (mut steps, mut taken) = (0, 0);
        loop {
            let left = until - solver.t();
            if left <= 1e-14 * until.abs() {
                return Ok(Flown::Finished(FlightEnd { time: until, state: *solver.y(), surface: None }));
            }
            if solver.h() > left {
                solver.set_h(left);
            }
            steps += 1;
            if steps > STEP_LIMIT {
                return Err(SimulationError::TooManySteps(STEP_LIMIT));
            }
            match try_step(&mut solver, motion)? {
                StepAttempt::Taken => taken += 1,
                StepAttempt::Rejected => continue,
                StepAttempt::HandedOver => return Ok(Flown::HandedOver(solver.t(), *solver.y())),
            }
            let step = Step { times: [solver.t_prev(), solver.t()], states: [*solver.y_prev(), *solver.y()] };
            let mut at = |time| solver.interpolate(time).unwrap_or(step.states[1]);
            let ([from, to], [before, after]) = (step.times, step.states);
            let reach = |_: &SurfaceShape| reach(to - from, &before, &after);
            let arrival = contact(&step, &mut at, reach, surfaces, &motion.body);
            let end = arrival.map_or_else(|| step.end(), |end| (end.time, end.state));
            stays.add(&step, &mut at, surfaces, &motion.body, end);
            if let Some(arrival) = arrival {
                return Ok(Flown::Finished(arrival));
            } else if !is_implicit && taken % LOOKED_AT == 0 && self.is_slow(&step) {
                return Ok(Flown::HandedOver(solver.t(), *solver.y()));
            }
        }
    }

    /// Whether an explicit method can take no much longer step.
    fn is_slow(&self, step: &Step) -> bool {
        let ([from, to], state) = (step.times, &step.states[1]);
        let rates = self.motion.rates(state, &self.motion.gas.at(&position(state)));
        (to - from) * rates.response.max(rates.exchange) > NEAR_LIMIT
    }
}

/// What became of a step of the integration.
enum StepAttempt {
    Taken,
    /// Too long; the solver tries a shorter one.
    Rejected,
    /// Not taken: stability, not accuracy, keeps an explicit step short, or the iteration of an implicit one does not
    /// converge.
    HandedOver,
}

fn try_step<S: PathSolver>(
    solver: &mut S,
    motion: &ParticleMotion<'_>,
) -> Result<StepAttempt, SimulationError> {
    match solver.step(motion) {
        Ok(_) if matches!(solver.status(), Status::RejectedStep) && solver.h().is_normal() => {
            Ok(StepAttempt::Rejected)
        }
        Ok(_) if matches!(solver.status(), Status::RejectedStep) => Err(SimulationError::NotFinite),
        Ok(_) if solver.y().iter().all(|value| value.is_finite()) => Ok(StepAttempt::Taken),
        Err(Error::Stiffness { .. } | Error::StepSize { .. }) => Ok(StepAttempt::HandedOver),
        Err(Error::MaxSteps { .. }) => Err(SimulationError::TooManySteps(STEP_LIMIT)),
        _ => Err(SimulationError::NotFinite),
    }
}

/// Relative and absolute tolerances of a state. Absolute errors are small whatever the value: a thousandth of a
/// diameter, 0.1 mm/s, 0.01 K, 1e-5, all at a tolerance of 1e-6. A larger tolerance leaves them, and the share of a
/// place that it allows, since the origin may be far: small hops of a particle that a flow presses on a wall are
/// impacts, too.
fn tolerances(tolerance: f64, body: &Body) -> [Vec<f64>; 2] {
    let fine = tolerance.min(FINE);
    let length = 1e3 * body.diameter;
    let absolute = [length, length, length, 100.0, 100.0, 100.0, 1e4, 10.0].map(|scale| fine * scale);
    let relative = [[fine; 3].as_slice(), &[tolerance; 5]].concat();
    [relative, absolute.to_vec()]
}

/// A step of a path: its times [s] and the states there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    pub times: [f64; 2],
    pub states: [ParticleState; 2],
}

impl Step {
    /// The later time and state.
    pub fn end(&self) -> (f64, ParticleState) {
        (self.times[1], self.states[1])
    }
}

/// The first contact in a step; `at` gives the states in it, `reach` how far [m] it can lead towards a surface.
pub(super) fn contact(
    step: &Step,
    at: &mut impl FnMut(f64) -> ParticleState,
    reach: impl Fn(&SurfaceShape) -> f64,
    surfaces: &[Surface],
    body: &Body,
) -> Option<FlightEnd> {
    let mut first: Option<FlightEnd> = None;
    for (index, surface) in surfaces.iter().enumerate() {
        let distance = |state: &ParticleState| {
            let (place, diameter) = (position(state), body.diameter_at(state[CONVERSION]));
            [surface.gap(&place, diameter), surface.shape.normal(&place).dot(&velocity(state))]
        };
        let [at_start, _] = distance(&step.states[0]);
        // Rounding may leave a particle that has just rebounded a hair behind the wall.
        if at_start > reach(&surface.shape) || at_start < -1e-6 * body.diameter {
            continue;
        }
        if let Some(arrival) = crossing(at, &distance, NEAR * body.diameter, step)
            && surface.shape.covers(&position(&arrival.1))
            && first.as_ref().is_none_or(|earlier| arrival.0 < earlier.time)
        {
            first = Some(FlightEnd { time: arrival.0, state: arrival.1, surface: Some(index) });
        }
    }
    first
}

/// The last time and state in front of the surface, when the step leads behind it: at most `near` [m] away.
fn crossing(
    at: &mut impl FnMut(f64) -> ParticleState,
    distance: &impl Fn(&ParticleState) -> [f64; 2],
    near: f64,
    &Step { times: [from, to], states: [before, after] }: &Step,
) -> Option<(f64, ParticleState)> {
    let point = |(time, state): (f64, ParticleState)| PathPoint::new(time, distance(&state));
    let mut last = point((from, before));
    for place in 1..=PATH_POINTS {
        let time = from + (to - from) * f64::from(place) / f64::from(PATH_POINTS);
        let next = point(if place == PATH_POINTS { (to, after) } else { (time, at(time)) });
        let mut between = |time| point((time, at(time)));
        let behind = if next.gap < 0.0 { Some(next) } else { dip(&mut between, [last, next]) };
        if let Some(behind) = behind {
            let arrival = arrival(|time| between(time).gap, near, [last, behind]);
            return Some((arrival, at(arrival)));
        }
        last = next;
    }
    None
}

/// A point of a path.
#[derive(Clone, Copy)]
struct PathPoint {
    /// [s]
    time: f64,
    /// Gap to the surface [m].
    gap: f64,
    /// How fast the gap grows [m/s].
    opening: f64,
}

impl PathPoint {
    fn new(time: f64, [gap, opening]: [f64; 2]) -> Self {
        Self { time, gap, opening }
    }
}

/// A point behind the surface between two in front of it, where the path comes nearer and goes away again.
fn dip(
    between: &mut impl FnMut(f64) -> PathPoint,
    [mut before, mut after]: [PathPoint; 2],
) -> Option<PathPoint> {
    for _ in 0..CONTACT_ITERATIONS {
        let duration = after.time - before.time;
        let bend = after.opening - before.opening;
        if !(before.opening < 0.0 && after.opening > 0.0 && duration > 0.0) {
            return None;
        }
        // A path that bends away from the surface lies in front of both tangents, which meet here.
        let meeting = (before.gap - after.gap + after.opening * duration) / bend;
        if before.gap + before.opening * meeting >= 0.0 {
            return None;
        }
        let lowest = between(before.time - before.opening / bend * duration);
        if lowest.gap < 0.0 {
            return Some(lowest);
        }
        if lowest.opening < 0.0 { before = lowest } else { after = lowest }
    }
    None
}

/// A time at which the gap is within 0 to `near`, between one with a positive and one with a
/// negative gap. Illinois method: the secant, with the gap of an end that stays for a second time
/// halved.
fn arrival(mut gap: impl FnMut(f64) -> f64, near: f64, [in_front, behind]: [PathPoint; 2]) -> f64 {
    let aim = 0.5 * near;
    let (mut low, mut high) = (in_front.time, behind.time);
    let (mut at_low, mut at_high) = (in_front.gap - aim, behind.gap - aim);
    let mut last_moved = 0.0;
    for _ in 0..CONTACT_ITERATIONS {
        let secant = high - at_high * (high - low) / (at_high - at_low);
        // A particle that starts at the wall has to leave it first.
        let leaves = at_low > aim && secant > low && secant < high;
        let time = if leaves { secant } else { 0.5 * (low + high) };
        if time <= low || time >= high {
            break;
        }
        let here = gap(time) - aim;
        if here.abs() <= aim {
            return time;
        }
        if here > 0.0 {
            (low, at_low) = (time, here);
            at_high *= if last_moved > 0.0 { 0.5 } else { 1.0 };
        } else {
            (high, at_high) = (time, here);
            at_low *= if last_moved < 0.0 { 0.5 } else { 1.0 };
        }
        last_moved = here;
    }
    low
}
