//! The trajectory of one particle: flights and hits until it is captured or gone.

use nalgebra::Vector3;

use super::case::{Case, HIT_BITS};
use super::drag;
use super::flight::{
    Body, CONVERSION, FlightEnd, ParticleMotion, State, TEMPERATURE, fly, position, velocity,
};
use super::geometry::across;
use super::injection::{Injection, ParticleWeight};
use super::surface::{Shape, Surface, SurfaceKind};
use crate::impact::{Impact, ImpactError, Outcome};
use crate::rng::ImpactRng;

/// A rebound slower than this [m/s] leaves the particle lying on the wall.
const REST: f64 = 1e-9;

/// How a particle ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Fate {
    /// Captured by the surface with this index.
    Stuck(usize),
    /// Left through the surface with this index.
    Escaped(usize),
    /// Still in the gas at the time limit.
    Airborne,
    /// Given up: too many hits, or at rest on a wall that does not capture it.
    GivenUp,
    /// The model cannot decide a hit, or the path cannot be integrated; with the reason.
    Unusable(String),
}

/// One hit on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Time since the particle started [s].
    pub time: f64,
    /// Index of the surface.
    pub surface: usize,
    /// Centre of the particle [m].
    pub position: Vector3<f64>,
    /// The impact.
    pub impact: Impact,
    /// Its outcome.
    pub outcome: Outcome,
    /// Mass of all real particles that this one represents [kg].
    pub mass: f64,
}

/// The hits of a particle and its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// How it ended.
    pub fate: Fate,
    /// Its hits in order.
    pub hits: Vec<Hit>,
    /// Diameter [m].
    pub diameter: f64,
    /// Mass of all real particles that it represents, at the start and at the end [kg].
    pub mass: [f64; 2],
    /// Where it ended [m].
    pub position: Vector3<f64>,
    /// Temperature at the end [K].
    pub temperature: f64,
    /// Conversion at the end [1].
    pub conversion: f64,
}

/// Follows the particle with this number.
pub(super) fn follow(case: &Case, number: u64) -> Trajectory {
    let (diameter, mut start) = case.injection.draw(case.seed, number);
    let (density, trouble) = match case.density(start[TEMPERATURE]) {
        Ok(density) => (density, None),
        Err(error) => (1.0, Some(error.to_string())),
    };
    let Injection { heat_capacity, radiation, burning, .. } = case.injection;
    let body = Body { diameter, density, heat_capacity, radiation, burning };
    if case.injection.relative_to_gas {
        let speed = velocity(&start) + case.gas.at(&position(&start)).velocity;
        start.fixed_rows_mut::<3>(3).copy_from(&speed);
    }
    let mut tracker = Tracker {
        case,
        number,
        motion: ParticleMotion { gas: &case.gas, gravity: case.gravity, body },
        time: 0.0,
        state: start,
        spin: Vector3::zeros(),
        weight: match case.injection.weight {
            ParticleWeight::One => 1.0,
            ParticleWeight::EqualShare(mass) => {
                mass / (case.injection.count as f64 * body.mass_at(start[CONVERSION]))
            }
        },
        hits: Vec::new(),
    };
    let mass = tracker.mass();
    let fate = match trouble.or_else(|| tracker.misplaced()) {
        Some(reason) => Fate::Unusable(reason),
        None => tracker.travel(),
    };
    Trajectory {
        fate,
        diameter,
        mass: [mass, tracker.mass()],
        position: position(&tracker.state),
        temperature: tracker.state[TEMPERATURE],
        conversion: tracker.state[CONVERSION].clamp(0.0, 1.0),
        hits: tracker.hits,
    }
}

struct Tracker<'a> {
    case: &'a Case,
    number: u64,
    motion: ParticleMotion<'a>,
    time: f64,
    state: State,
    /// Angular velocity [rad/s].
    spin: Vector3<f64>,
    /// Number of real particles that this one represents.
    weight: f64,
    hits: Vec<Hit>,
}

impl Tracker<'_> {
    fn mass(&self) -> f64 {
        self.weight * self.motion.body.mass_at(self.state[CONVERSION])
    }

    /// The wall that the particle starts in or behind, if it does.
    fn misplaced(&self) -> Option<String> {
        let here = position(&self.state);
        let behind = |s: &&Surface| s.shape.covers(&here) && s.gap(&here, self.motion.body.diameter) < 0.0;
        let wall = self.case.surfaces.iter().find(behind)?;
        Some(format!("starts in or behind `{}`; move the start or turn the normal", wall.name))
    }

    fn travel(&mut self) -> Fate {
        loop {
            let case = self.case;
            let (from, until) = (self.time, case.time_limit);
            let end = fly(&self.motion, &case.surfaces, from, until, &self.state, case.tolerance);
            let FlightEnd { time, state, surface } = match end {
                Ok(end) => end,
                Err(lost) => return Fate::Unusable(lost.to_string()),
            };
            self.let_spin_decay(time - self.time, &state);
            (self.time, self.state) = (time, state);
            let Some(index) = surface else { return Fate::Airborne };
            if self.hits.len() as u64 >= case.hit_limit {
                return Fate::GivenUp;
            }
            match self.hit(index) {
                Ok(None) => {}
                Ok(Some(fate)) => return fate,
                Err(error) => return Fate::Unusable(error.to_string()),
            }
        }
    }

    /// Spin dies out exponentially; the gas's viscosity is that at the end of the flight, and in a thin gas the torque is
    /// taken to be less by the same factor as the drag.
    fn let_spin_decay(&mut self, duration: f64, end: &State) {
        let gas = self.case.gas.at(&position(end));
        let body = &self.motion.body;
        let density = body.density_at(end[CONVERSION]);
        let rate = drag::spin_decay_rate(gas.viscosity, density, body.diameter);
        self.spin *= (-duration * rate / drag::slip_factor(gas.mean_free_path, body.diameter)).exp();
    }

    /// Resolves the hit on a surface; `None` when the particle flies on.
    fn hit(&mut self, index: usize) -> Result<Option<Fate>, ImpactError> {
        let surface = &self.case.surfaces[index];
        let SurfaceKind::Wall { model: wall, temperature } = &surface.kind else {
            return Ok(Some(Fate::Escaped(index)));
        };
        let here = position(&self.state);
        let frame = WallFrame::new(&surface.shape, &here, &velocity(&self.state));
        let spin_axis = frame.normal.cross(&frame.along);
        let gas = self.case.gas.at(&here).velocity;
        let impact = Impact {
            normal_speed: frame.normal_speed,
            tangential_speed: frame.tangential_speed,
            diameter: self.motion.body.diameter,
            particle_temperature: self.state[TEMPERATURE],
            wall_temperature: temperature.at(&here),
            conversion: self.state[CONVERSION].clamp(0.0, 1.0),
            gas_speed: (gas - frame.normal * frame.normal.dot(&gas)).norm(),
            spin: self.spin.dot(&spin_axis),
            ..Impact::default()
        };
        let key = (self.number << HIT_BITS) | self.hits.len() as u64;
        let outcome = self.case.model.resolve(*wall, &impact, ImpactRng::new(self.case.seed, key))?;
        let mass = self.mass();
        self.hits.push(Hit { time: self.time, surface: index, position: here, impact, outcome, mass });
        if outcome.stuck {
            return Ok(Some(Fate::Stuck(index)));
        }
        let back = outcome.normal_restitution * impact.normal_speed;
        if back < REST {
            return Ok(Some(Fate::GivenUp));
        }
        let forward = outcome.tangential_restitution * impact.tangential_speed;
        let rebound = frame.normal * back + frame.along * forward;
        self.state.fixed_rows_mut::<3>(3).copy_from(&rebound);
        self.spin += spin_axis * (outcome.spin - impact.spin);
        Ok(None)
    }
}

/// The wall at a hit: its normal into the gas, the direction of sliding, and the two speeds.
struct WallFrame {
    normal: Vector3<f64>,
    along: Vector3<f64>,
    normal_speed: f64,
    tangential_speed: f64,
}

impl WallFrame {
    fn new(shape: &Shape, position: &Vector3<f64>, velocity: &Vector3<f64>) -> Self {
        let normal = shape.normal(position);
        let away = normal.dot(velocity);
        let sliding = velocity - normal * away;
        let tangential_speed = sliding.norm();
        // A head-on hit slides nowhere; any direction along the wall will do.
        let along = sliding.try_normalize(1e-300).unwrap_or_else(|| across(&normal)[0]);
        Self { normal, along, normal_speed: (-away).max(0.0), tangential_speed }
    }
}
