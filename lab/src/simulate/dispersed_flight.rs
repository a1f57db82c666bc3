//! The path of a particle that turbulence, thermophoresis or molecules push off the way of the mean flow.
//!
//! In a step the drive `d = u + a/b` changes linearly, with `u` the velocity of the gas with its fluctuation, `a` the
//! acceleration of weight and thermophoresis, `b` the response rate of the particle. Then `dv/dt = b (d - v)` has an
//! exact solution for any `b dt`, so that the finest particles need no short steps:
//!
//! `v = d(t) - s/b + c exp(-b t)`, `x = x_0 + d_0 t + s t²/2 - s t/b + c (1 - exp(-b t))/b`, `s = (d_1 - d_0)/dt`,
//! `c = v_0 - d_0 + s/b`.
//!
//! `d_1` is taken where a constant drive would lead (Heun). A step is halved while response or drive change by more
//! than a twentieth, in turbulence a tenth, and displace the particle by more than a hundredth of its diameter. The
//! walk stays what it is as long as it may ([`nearwall::transport::langevin`]), and goes on by half of that time before
//! and half after (Strang): all of it after would thin out tracers at a wall by a fifth, as steps become shorter
//! towards it. Brownian motion adds its exact displacement; whether it touched a wall within a step is drawn from the
//! Brownian bridge. All draws depend on the seed, the number of the particle and its step alone.

use nalgebra::Vector3;

use super::drag;
use super::error::SimulationError;
use super::flight::{FlightEnd, NEAR, Step, contact};
use super::gas::GasState;
use super::motion::{CONVERSION, ParticleMotion, ParticleState, TEMPERATURE, position, state, velocity};
use super::near_wall::StayTimes;
use super::surface::{Surface, SurfaceKind, SurfaceShape};
use nearwall::rng::ImpactRng;
use nearwall::transport::GasTurbulence;
use nearwall::transport::brownian::BrownianStep;
use nearwall::transport::thermophoresis::{self, ThermalGas};

/// Steps of one flight before it is given up.
const STEP_LIMIT: usize = 20_000_000;
/// Shortest flight in steps, so that no short piece of a field is skipped.
const FEWEST_STEPS: f64 = 200.0;
/// Largest change of drive and response in a step, over their size [1]: in still or laminar gas, and in turbulence,
/// where the walk limits most steps and a larger share saves no more (`tutorials/standalone/duct.toml`, 2000 grains of
/// 10 µm: 1.64 million steps with 0.05, 1.04 with 0.1, 1.01 with 0.2 and 0.4; 349, 333, 338 and 335 of them settle).
const LARGEST_CHANGES: [f64; 2] = [0.05, 0.1];
/// Displacement by a change of drive or response that need not be looked at, over the diameter [1]. In a corner both
/// jump from one wall to the other, however short the step.
const DISPLACEMENT: f64 = 0.01;
/// Halvings of a step.
const HALVINGS: u32 = 40;
/// First stream of the draws of a path; those of impacts are far below.
const STREAMS: u64 = 1 << 40;
/// Streams of a step: two of the walk, three of Brownian motion, one of the bridge.
const STREAMS_PER_STEP: u64 = 8;

/// The walk of the gas's fluctuation along the path of a particle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Walk {
    random: ImpactRng,
    /// Steps so far.
    steps: u64,
    /// Standard normal numbers.
    values: [f64; 3],
}

impl Walk {
    /// At the start of a particle.
    pub(super) fn new(random: ImpactRng) -> Self {
        let mut walk = Self { random, steps: 0, values: [0.0; 3] };
        walk.values = walk.draws(0);
        walk.steps = 1;
        walk
    }

    fn normal(&self, stream: u64) -> [f64; 2] {
        self.random.normal(STREAMS + STREAMS_PER_STEP * self.steps + stream)
    }

    /// Three standard normal numbers of this step.
    fn draws(&self, stream: u64) -> [f64; 3] {
        let ([one, two], [three, _]) = (self.normal(stream), self.normal(stream + 1));
        [one, two, three]
    }
}

/// A particle with what disperses it.
#[derive(Debug)]
pub(super) struct Dispersed<'a> {
    pub motion: &'a ParticleMotion<'a>,
    pub surfaces: &'a [Surface],
    /// Thermal conductivity of the particle [W/(m K)].
    pub conductivity: f64,
}

/// The gas at a place: its mean, and its turbulence.
#[derive(Clone, Copy)]
struct Place {
    gas: GasState,
    turbulence: Option<GasTurbulence>,
}

impl Place {
    /// Longest step [s] whose walk may be taken as constant on the path.
    fn longest_step(&self) -> f64 {
        self.turbulence.map_or(f64::INFINITY, |turbulence| turbulence.longest_step())
    }

    /// The gas with its fluctuation.
    fn with_fluctuation(mut self, walk: &Walk) -> GasState {
        if let Some(turbulence) = &self.turbulence {
            self.gas.velocity += Vector3::from(turbulence.velocity(walk.values));
        }
        self.gas
    }
}

/// A path under a drive that changes linearly.
#[derive(Debug, Clone, Copy)]
struct Path {
    start: ParticleState,
    /// Drive at the start [m/s] and its change [m/s²].
    drive: [Vector3<f64>; 2],
    response: f64,
    /// Change of temperature at the start [K/s], rate of exchange [1/s], change of conversion [1/s].
    heat: [f64; 3],
    /// Brownian displacement [m] and velocity [m/s] at the end of the `duration` [s].
    brownian: [Vector3<f64>; 2],
    duration: f64,
}

impl Path {
    fn at(&self, time: f64) -> ParticleState {
        let [drive, change] = self.drive;
        let decayed = -(-self.response * time).exp_m1();
        let lag = change / self.response;
        let off = velocity(&self.start) - drive + lag;
        let share = time / self.duration;
        let place = position(&self.start)
            + (drive - lag + 0.5 * time * change) * time
            + off * (decayed / self.response)
            + self.brownian[0] * share;
        let speed = drive + change * time - lag + off * (1.0 - decayed) + self.brownian[1] * share;
        let [heating, exchange, conversion] = self.heat;
        let warmed = if exchange > 0.0 { -(-exchange * time).exp_m1() / exchange } else { time };
        let converted = (self.start[CONVERSION] + conversion * time).min(self.start[CONVERSION].max(1.0));
        state(&place, &speed, self.start[TEMPERATURE] + heating * warmed, converted)
    }

    /// How far [m] it can lead towards a surface: the velocity stays between that at the start and the drive.
    fn reach(&self, shape: &SurfaceShape) -> f64 {
        let [drive, change] = self.drive;
        let speeds = [velocity(&self.start), drive, drive + change * self.duration];
        let fastest = speeds.iter().map(|speed| shape.closing(speed)).fold(0.0, f64::max);
        fastest * self.duration + shape.closing(&self.brownian[0])
    }
}

impl Dispersed<'_> {
    /// Follows a particle as [`super::flight::fly`] does, and its walk.
    pub(super) fn fly(
        &self,
        [mut now, until]: [f64; 2],
        start: &ParticleState,
        walk: &mut Walk,
        stays: &mut StayTimes,
    ) -> Result<FlightEnd, SimulationError> {
        let (mut here, mut longest) = (*start, (until - now) / FEWEST_STEPS);
        let mut place = self.place(start);
        // Time [s] that the walk stays what it is, from now on and so far, and by which it has yet to go on.
        let (mut held, mut moved, mut owed) = (0.0, 0.0, 0.0);
        for _ in 0..STEP_LIMIT {
            if until - now <= 1e-14 * until.abs() {
                return Ok(FlightEnd { time: until, state: here, surface: None });
            }
            if held <= 0.0 {
                (held, moved) = (place.longest_step().min(until - now), 0.0);
                self.advance(walk, &here, &place, owed + 0.5 * held);
            }
            let mut path = self.path(&here, &place, longest.min(held), walk);
            let spread = self.add_brownian(&mut path, &place, walk);
            // The rest of a step says nothing about how long the next may be.
            let next = if path.duration < held { 2.0 * path.duration } else { longest.max(2.0 * held) };
            longest = next.min(until / FEWEST_STEPS);
            let step = Step { times: [now, now + path.duration], states: [here, path.at(path.duration)] };
            if !step.states[1].iter().all(|value| value.is_finite()) {
                return Err(SimulationError::NotFinite);
            }
            let mut at = |time| path.at(time - now);
            let reach = |shape: &SurfaceShape| path.reach(shape);
            let touched = contact(&step, &mut at, reach, self.surfaces, &self.motion.body)
                .or_else(|| spread.and_then(|spread| self.bridge(&step, &path, &spread, walk)));
            let (time, after) = touched.map_or_else(|| step.end(), |end| (end.time, end.state));
            stays.add(&step, &mut at, self.surfaces, &self.motion.body, (time, after));
            place = self.place(&after);
            walk.steps += 1;
            moved += time - now;
            // What rounding leaves is no time.
            held = if path.duration > (1.0 - 1e-9) * held { 0.0 } else { held - path.duration };
            owed = 0.5 * moved;
            if let Some(end) = touched {
                self.advance(walk, &after, &place, owed);
                return Ok(end);
            }
            (now, here) = (time, after);
        }
        Err(SimulationError::TooManySteps(STEP_LIMIT))
    }

    /// The gas where a particle is.
    fn place(&self, here: &ParticleState) -> Place {
        let (field, at) = (self.motion.gas, position(here));
        let gas = field.at(&at);
        let turbulence = field.turbulence.and_then(|law| law.at(self.surfaces, &at, &gas));
        Place { gas, turbulence }
    }

    /// Acceleration of weight and thermophoresis [m/s²].
    fn push(&self, here: &ParticleState, gas: &GasState) -> Vector3<f64> {
        self.motion.weight(here, gas) + self.thermophoresis(here, gas)
    }

    /// Acceleration by thermophoresis [m/s²].
    fn thermophoresis(&self, here: &ParticleState, gas: &GasState) -> Vector3<f64> {
        if !self.motion.gas.thermophoresis {
            return Vector3::zeros();
        }
        let (body, conversion) = (&self.motion.body, here[CONVERSION]);
        let GasState { temperature, density, viscosity, conductivity, mean_free_path, .. } = *gas;
        let thermal = ThermalGas { temperature, density, viscosity, conductivity, mean_free_path };
        let force =
            thermophoresis::force_over_gradient(&thermal, body.diameter_at(conversion), self.conductivity);
        self.motion.gas.temperature_gradient(&position(here)) * (force / body.mass_at(conversion))
    }

    /// The path from a state, at most `longest` [s] long.
    fn path(&self, here: &ParticleState, place: &Place, longest: f64, walk: &Walk) -> Path {
        let (motion, body) = (self.motion, &self.motion.body);
        let gas = place.with_fluctuation(walk);
        let rates = motion.rates(here, &gas);
        let begin = gas.velocity + self.push(here, &gas) / rates.response;
        let largest = LARGEST_CHANGES[usize::from(place.turbulence.is_some())];
        let mut path = Path {
            start: *here,
            drive: [begin, Vector3::zeros()],
            response: rates.response,
            heat: [rates.heating, rates.exchange, rates.conversion],
            brownian: [Vector3::zeros(); 2],
            duration: longest.min(place.longest_step()),
        };
        for _ in 0..HALVINGS {
            let end = path.at(path.duration);
            let gas = self.place(&end).with_fluctuation(walk);
            let drive = gas.velocity + self.push(&end, &gas) / rates.response;
            let change = drive - begin;
            let moved = 0.5 * change.norm() * path.duration;
            let is_even = change.norm() <= largest * drive.norm().max(begin.norm());
            path.drive[1] = change / path.duration;
            // The slip of the first guess would be that of a particle that has not followed the gas.
            let (_, response) = motion.response(&path.at(path.duration), &gas);
            let (turned, slip) =
                ((response - rates.response).abs(), (begin - velocity(here)).norm() + change.norm());
            let deflected = 0.5 * turned * slip * path.duration * path.duration;
            let nearest = DISPLACEMENT * body.diameter;
            let keeps_response = turned <= largest * rates.response || deflected <= nearest;
            if keeps_response && (is_even || moved <= nearest) {
                path.response = 0.5 * (rates.response + response);
                return path;
            }
            path.duration *= 0.5;
            path.drive[1] = Vector3::zeros();
        }
        path
    }

    /// Adds Brownian motion to a path; `None` in a gas without.
    fn add_brownian(&self, path: &mut Path, place: &Place, walk: &Walk) -> Option<BrownianStep> {
        let motion = self.motion;
        if !motion.gas.brownian {
            return None;
        }
        let mass = motion.body.mass_at(path.start[CONVERSION]);
        let step = BrownianStep::new(place.gas.temperature, mass, 1.0 / path.response, path.duration);
        for axis in 0..3 {
            let [displacement, speed] = step.drawn(walk.normal(2 + axis as u64));
            path.brownian[0][axis] = displacement;
            path.brownian[1][axis] = speed;
        }
        Some(step)
    }

    /// The contact with a wall in between, drawn for a step that begins and ends in front of it.
    fn bridge(&self, step: &Step, path: &Path, spread: &BrownianStep, walk: &Walk) -> Option<FlightEnd> {
        let body = &self.motion.body;
        for (index, surface) in self.surfaces.iter().enumerate() {
            if !matches!(surface.kind, SurfaceKind::Wall { .. }) {
                continue;
            }
            let gap = |state: &ParticleState| {
                surface.gap(&position(state), body.diameter_at(state[CONVERSION])).max(0.0)
            };
            let [begin, end] = step.states.each_ref().map(gap);
            let stream = STREAMS + STREAMS_PER_STEP * walk.steps + 5;
            let probability = spread.touch_probability([begin, end]);
            // Two walls that near each other are no case of a prescribed field: one draw serves all.
            if probability <= walk.random.uniform(stream) {
                continue;
            }
            let time = path.duration * begin / (begin + end).max(f64::MIN_POSITIVE);
            let mut touching = path.at(time);
            let inward = surface.shape.normal(&position(&touching));
            let too_far = surface.gap(&position(&touching), body.diameter_at(touching[CONVERSION]))
                - 0.5 * NEAR * body.diameter;
            let there = position(&touching) - inward * too_far;
            if surface.shape.covers(&there) {
                touching.fixed_rows_mut::<3>(0).copy_from(&there);
                return Some(FlightEnd { time: step.times[0] + time, state: touching, surface: Some(index) });
            }
        }
        None
    }

    /// Takes the walk on by a time [s] at a state, in this place; nothing without turbulence.
    fn advance(&self, walk: &mut Walk, after: &ParticleState, place: &Place, duration: f64) {
        let (body, conversion) = (&self.motion.body, after[CONVERSION]);
        if let Some(turbulence) = &place.turbulence {
            let (diameter, density) = (body.diameter_at(conversion), body.density_at(conversion));
            let slip = drag::slip_factor(place.gas.mean_free_path, diameter);
            let relaxation = slip / drag::response_rate(0.0, place.gas.viscosity, density, diameter);
            walk.values = turbulence.advance(walk.values, relaxation, duration, walk.draws(0));
            walk.steps += 1;
        }
    }
}
