//! Follows one particle: flights and hits until it is captured or gone.

use nalgebra::Vector3;

use super::case::{Case, HIT_BITS};
use super::dispersed_flight::{Dispersed, Walk};
use super::drag;
use super::error::SimulationError;
use super::flight::{FlightEnd, fly_timed};
use super::geometry::across;
use super::injection::{Injection, ParticleWeight};
use super::motion::{Body, CONVERSION, ParticleMotion, ParticleState, TEMPERATURE, position, velocity};
use super::near_wall::StayTimes;
use super::shrinkage::Shrinkage;
use super::surface::{Surface, SurfaceKind, SurfaceShape};
use super::trajectory::{Fate, Hit, Trajectory};
use super::wall_deposits::WallDeposits;
use nearwall::impact::{Impact, ImpactError, Outcome};
use nearwall::model::Model;
use nearwall::rng::ImpactRng;

/// A rebound slower than this [m/s] leaves the particle lying on the wall.
const REST: f64 = 1e-9;

/// Follows the particle with this number; the walls stay as they are.
pub(super) fn follow(case: &Case, walls: Option<&WallDeposits>, number: u64) -> Trajectory {
    let stays = StayTimes::new(case.near_wall_distance, case.surfaces.len());
    let (start, own) = Start::drawn(case, number);
    let (mut tracker, trouble) = Tracker::start(case, walls, start, stays);
    let mass = tracker.mass();
    let fate = trouble.map_or_else(|| tracker.travel(), Fate::Unusable);
    Trajectory {
        fate,
        injection: start.injection,
        released: case.deposit.map_or(0.0, |deposit| deposit.release(own, tracker.injection.count)),
        diameter: tracker.diameter(),
        weight: tracker.weight,
        mass: [mass, tracker.mass()],
        position: position(&tracker.state),
        temperature: tracker.motion.body.temperature(&tracker.state),
        conversion: tracker.state[CONVERSION].clamp(0.0, 1.0),
        stays: tracker.stays.times,
        hits: tracker.hits,
    }
}

fn body(
    case: &Case,
    injection: &Injection,
    diameter: f64,
    temperature: f64,
) -> Result<Body, SimulationError> {
    let density = case.density(injection, temperature)?;
    injection.body(diameter, density, temperature, case.model_of(injection))
}

/// Stands for a particle that cannot be used.
fn nothing_known(diameter: f64, injection: &Injection) -> Body {
    Body {
        diameter,
        density: 1.0,
        shrinkage: Shrinkage::NONE,
        heat_capacity: None,
        fusion: None,
        radiation: None,
        burning: injection.burning,
    }
}

/// The start of a particle.
#[derive(Debug, Clone, Copy)]
pub struct Start {
    /// Its number, from which its random numbers follow.
    pub number: u64,
    /// Index of its injection.
    pub injection: usize,
    /// [m].
    pub diameter: f64,
    /// As the injection gives it.
    pub state: ParticleState,
}

impl Start {
    /// The start of the particle with this number, and its number within its injection.
    pub fn drawn(case: &Case, number: u64) -> (Self, u64) {
        let (injection, own) = case.origin(number).unwrap_or_default();
        let (diameter, state) = case.injections[injection].draw(case.seed, number);
        (Self { number, injection, diameter, state }, own)
    }
}

/// A particle on its way.
#[derive(Debug, Clone)]
pub(super) struct Tracker<'a> {
    pub case: &'a Case,
    pub injection: &'a Injection,
    walls: Option<&'a WallDeposits>,
    number: u64,
    motion: ParticleMotion<'a>,
    time: f64,
    state: ParticleState,
    /// Angular velocity [rad/s].
    spin: Vector3<f64>,
    /// Number of real particles that this one represents.
    pub weight: f64,
    stays: StayTimes,
    hits: Vec<Hit>,
    /// Thermal conductivity [W/(m K)] and the walk of a particle that the gas disperses.
    dispersed: Option<(f64, Walk)>,
}

/// A contact with a wall before the model has decided it.
#[derive(Debug)]
pub(super) struct WallContact {
    frame: WallFrame,
    /// Index of the wall in the particle's model.
    pub wall: usize,
    /// Where the centre of the particle is [m].
    pub position: Vector3<f64>,
    /// The impact.
    pub impact: Impact,
}

impl<'a> Tracker<'a> {
    /// A particle at its start, and why it cannot be followed, if it cannot.
    pub fn start(
        case: &'a Case,
        walls: Option<&'a WallDeposits>,
        Start { number, injection, diameter, state: mut start }: Start,
        stays: StayTimes,
    ) -> (Self, Option<SimulationError>) {
        let injection = &case.injections[injection];
        let (body, trouble) = match body(case, injection, diameter, start[TEMPERATURE]) {
            Ok(body) => (body, None),
            Err(reason) => (nothing_known(diameter, injection), Some(reason)),
        };
        start[TEMPERATURE] =
            body.fusion.map_or(start[TEMPERATURE], |fusion| fusion.sensible(start[TEMPERATURE]));
        if injection.relative_to_gas {
            let speed = velocity(&start) + case.gas.at(&position(&start)).velocity;
            start.fixed_rows_mut::<3>(3).copy_from(&speed);
        }
        let (dispersed, missing) = dispersion(case, injection, number, start[TEMPERATURE]);
        let tracker = Self {
            case,
            injection,
            walls,
            number,
            motion: ParticleMotion { gas: &case.gas, gravity: case.gravity, body },
            time: 0.0,
            state: start,
            spin: Vector3::zeros(),
            weight: match injection.weight {
                ParticleWeight::One => 1.0,
                ParticleWeight::EqualShare(mass) => {
                    mass / (injection.count as f64 * body.mass_at(start[CONVERSION]))
                }
            },
            stays,
            hits: Vec::new(),
            dispersed,
        };
        let trouble = trouble.or(missing).or_else(|| tracker.misplaced());
        (tracker, trouble)
    }

    /// Mass of all real particles that this one represents [kg].
    pub fn mass(&self) -> f64 {
        self.weight * self.motion.body.mass_at(self.state[CONVERSION])
    }

    fn diameter(&self) -> f64 {
        self.motion.body.diameter_at(self.state[CONVERSION])
    }

    /// The wall that the particle starts in or behind, if it does.
    fn misplaced(&self) -> Option<SimulationError> {
        let here = position(&self.state);
        let behind = |s: &&Surface| s.shape.covers(&here) && s.gap(&here, self.diameter()) < 0.0;
        let wall = self.case.surfaces.iter().find(behind)?;
        Some(SimulationError::Misplaced(wall.name.clone()))
    }

    fn travel(&mut self) -> Fate {
        loop {
            let index = match self.fly() {
                Ok(index) => index,
                Err(fate) => return fate,
            };
            if self.hits.len() as u64 >= self.case.hit_limit {
                return Fate::GivenUp;
            }
            match self.hit(index) {
                Ok(None) => {}
                Ok(Some(fate)) => return fate,
                Err(error) => return Fate::Unusable(error.into()),
            }
        }
    }

    /// Flies to the next surface and returns its index.
    ///
    /// # Errors
    /// The fate of a particle that reaches none.
    pub fn fly(&mut self) -> Result<usize, Fate> {
        let case = self.case;
        let (from, until) = (self.time, case.time_limit);
        let (start, stays) = (&self.state, &mut self.stays);
        let end = match &mut self.dispersed {
            None => fly_timed(&self.motion, &case.surfaces, [from, until], start, case.tolerance, stays),
            Some((conductivity, walk)) => {
                let (motion, surfaces) = (&self.motion, case.surfaces.as_slice());
                let dispersed = Dispersed { motion, surfaces, conductivity: *conductivity };
                dispersed.fly([from, until], start, walk, stays)
            }
        };
        let FlightEnd { time, state, surface } = end.map_err(Fate::Unusable)?;
        self.let_spin_decay(time - self.time, &state);
        (self.time, self.state) = (time, state);
        surface.ok_or(Fate::Airborne)
    }

    /// Spin dies out exponentially; the gas's viscosity is that at the end of the flight, and in a
    /// thin gas the torque is taken to be less by the same factor as the drag.
    fn let_spin_decay(&mut self, duration: f64, end: &ParticleState) {
        let gas = self.case.gas.at(&position(end));
        let body = &self.motion.body;
        let (density, diameter) = (body.density_at(end[CONVERSION]), body.diameter_at(end[CONVERSION]));
        let rate = drag::spin_decay_rate(gas.viscosity, density, diameter);
        self.spin *= (-duration * rate / drag::slip_factor(gas.mean_free_path, diameter)).exp();
    }

    /// Resolves the hit on a surface; `None` when the particle flies on.
    fn hit(&mut self, index: usize) -> Result<Option<Fate>, ImpactError> {
        let model = self.case.model_of(self.injection);
        let Some(contact) = self.contact(index, model)? else { return Ok(Some(Fate::Escaped(index))) };
        let WallContact { impact, wall, position, .. } = contact;
        let random = impact_random(self.case, self.number, self.hits.len() as u64);
        let outcome = model.resolve(wall, &impact, random)?;
        let (time, mass) = (self.time, self.mass());
        let (eroded, density) = (model.erosion(wall, &impact, mass)?, impact.particle_density);
        let heat = if outcome.stuck { 0.0 } else { self.give_heat(&contact)? };
        self.hits.push(Hit { time, surface: index, position, impact, outcome, density, eroded, mass, heat });
        if outcome.stuck {
            return Ok(Some(Fate::Stuck(index)));
        }
        Ok((!self.rebound(&contact, &outcome)).then_some(Fate::GivenUp))
    }

    /// The impact on a surface that was reached, with what lies on the wall; `None` on an exit.
    fn contact(&self, index: usize, model: &Model) -> Result<Option<WallContact>, ImpactError> {
        let Some(mut contact) = self.bare_contact(index) else { return Ok(None) };
        if let Some(walls) = self.walls {
            let WallContact { position, wall, impact, .. } = &contact;
            contact.impact = walls.apply(self.case, index, position, model, *wall, impact)?;
        }
        Ok(Some(contact))
    }

    /// The impact on a surface that was reached, without what lies on the wall; `None` on an exit.
    pub fn bare_contact(&self, index: usize) -> Option<WallContact> {
        let surface = &self.case.surfaces[index];
        let SurfaceKind::Wall { model: wall, temperature, .. } = &surface.kind else { return None };
        let here = position(&self.state);
        let frame = WallFrame::new(&surface.shape, &here, &velocity(&self.state));
        let gas = self.case.gas.at(&here).velocity;
        let impact = Impact {
            normal_speed: frame.normal_speed,
            tangential_speed: frame.tangential_speed,
            diameter: self.diameter(),
            particle_temperature: self.motion.body.temperature(&self.state),
            particle_density: self.motion.body.density_at(self.state[CONVERSION]),
            wall_temperature: temperature.at(&here),
            conversion: self.state[CONVERSION].clamp(0.0, 1.0),
            gas_speed: (gas - frame.normal * frame.normal.dot(&gas)).norm(),
            spin: self.spin.dot(&frame.spin_axis()),
            ..Impact::default()
        };
        Some(WallContact { frame, wall: self.injection.wall(*wall), position: here, impact })
    }

    /// Cools the particle by the heat that it gives to the wall while it touches it; returns that of all real particles
    /// that it represents [J].
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn give_heat(&mut self, contact: &WallContact) -> Result<f64, ImpactError> {
        let model = self.case.model_of(self.injection);
        let asked = self.motion.body.heat_capacity.filter(|_| model.has_contact_heat());
        let Some(heat_capacity) = asked else { return Ok(0.0) };
        let heat = model.contact_heat(contact.wall, &contact.impact)?;
        let mass = self.motion.body.mass_at(self.state[CONVERSION]);
        self.state[TEMPERATURE] -= heat / (mass * heat_capacity);
        Ok(self.weight * heat)
    }

    /// Sets the velocity after a rebound; false for a particle that comes to rest on the wall.
    pub fn rebound(&mut self, contact: &WallContact, outcome: &Outcome) -> bool {
        let WallContact { frame, impact, .. } = contact;
        let back = outcome.normal_restitution * impact.normal_speed;
        if back < REST {
            return false;
        }
        let forward = outcome.tangential_restitution * impact.tangential_speed;
        let rebound = frame.normal * back + frame.along * forward;
        self.state.fixed_rows_mut::<3>(3).copy_from(&rebound);
        self.spin += frame.spin_axis() * (outcome.spin - impact.spin);
        true
    }
}

/// Thermal conductivity [W/(m K)] and walk of a particle with this number that starts at a temperature [K], in a gas
/// that disperses it; and why it cannot be followed, if it cannot.
fn dispersion(
    case: &Case,
    injection: &Injection,
    number: u64,
    temperature: f64,
) -> (Option<(f64, Walk)>, Option<SimulationError>) {
    if !case.gas.disperses() {
        return (None, None);
    }
    let material = case.model_of(injection).particle();
    let known = injection.conductivity.or_else(|| material.thermal_conductivity_near(temperature));
    let missing = (case.gas.thermophoresis && known.is_none())
        .then(|| SimulationError::NoConductivity(material.name().to_owned()));
    (Some((known.unwrap_or(1.0), Walk::new(impact_random(case, number, 0)))), missing)
}

/// The random numbers of a hit of the particle with this number, by how many it had before.
pub(super) fn impact_random(case: &Case, number: u64, before: u64) -> ImpactRng {
    ImpactRng::new(case.seed, (number << HIT_BITS) | before)
}

/// The wall at a hit: its normal into the gas, the direction of sliding, and the two speeds.
#[derive(Debug, Clone, Copy)]
struct WallFrame {
    normal: Vector3<f64>,
    along: Vector3<f64>,
    normal_speed: f64,
    tangential_speed: f64,
}

impl WallFrame {
    /// Axis of the spin that rolling along the wall has.
    fn spin_axis(&self) -> Vector3<f64> {
        self.normal.cross(&self.along)
    }

    fn new(shape: &SurfaceShape, position: &Vector3<f64>, velocity: &Vector3<f64>) -> Self {
        let normal = shape.normal(position);
        let away = normal.dot(velocity);
        let sliding = velocity - normal * away;
        let tangential_speed = sliding.norm();
        // A head-on hit slides nowhere; any direction along the wall will do.
        let along = sliding.try_normalize(1e-300).unwrap_or_else(|| across(&normal)[0]);
        Self { normal, along, normal_speed: (-away).max(0.0), tangential_speed }
    }
}
