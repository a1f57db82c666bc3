//! Initial positions and states of the particles.
//!
//! Each particle draws its state from its own stream of a seeded generator (ChaCha8, stream = number of the particle),
//! so it is the same on any thread and however many particles there are.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::Distribution as _;
use rand_distr::StandardUniform;

use super::burning::Burning;
use super::distribution::Distribution;
use super::flight::{State, state};
use super::geometry::{across, direction, required_vector, required_within, vector};
use crate::input::{InputError, Section};

/// The `[particles]` of a case.
#[derive(Debug, Clone)]
pub struct Injection {
    /// How many particles are followed.
    pub count: u64,
    place: Place,
    /// Mean direction of flight, length 1.
    along: Vector3<f64>,
    diameter: Distribution,
    speed: Distribution,
    /// Whether the speed comes on top of the gas's own velocity.
    pub relative_to_gas: bool,
    angle: Distribution,
    azimuth: Distribution,
    temperature: Distribution,
    conversion: Distribution,
    /// Density before any carbon is gone [kg/m³]; otherwise that of the model's particle.
    pub density: Option<f64>,
    /// Heat capacity [J/(kg K)]; without it the temperature stays.
    pub heat_capacity: Option<f64>,
    /// Emissivity [1] and temperature of the surroundings [K].
    pub radiation: Option<(f64, f64)>,
    /// Real particles that each followed particle represents.
    pub weight: ParticleWeight,
    /// Law of carbon conversion.
    pub burning: Burning,
}

/// Number of real particles that one followed particle represents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParticleWeight {
    /// One real particle: the size distribution counts particles.
    One,
    /// An equal share of this mass [kg]: the size distribution counts mass.
    EqualShare(f64),
}

#[derive(Debug, Clone, PartialEq)]
enum Place {
    Point(Vector3<f64>),
    Disc { centre: Vector3<f64>, normal: Vector3<f64>, radii: [f64; 2] },
}

/// Quantities of particles that a sweep can change, in SI units or degrees.
pub const SWEEPABLE: [&str; 5] = ["diameter", "speed", "angle_deg", "particle_temperature", "conversion"];

impl Injection {
    /// Reads a `[particles]` table.
    ///
    /// # Errors
    /// [`InputError::Fault`] for a missing or impossible state.
    pub fn read(section: &Section<'_>, burning: Burning) -> Result<Self, InputError> {
        let needed = |key: &str, what: &str, low: f64, high: f64| {
            Distribution::read(section, key, low, high)?.ok_or_else(|| section.missing(key, what))
        };
        let count = required_within(section, "count", 1.0, 1e8)?;
        if count.fract() != 0.0 {
            return Err(section.fault("count", "a whole number of particles"));
        }
        let place = section.required_section("position")?;
        let angle = Distribution::read(section, "angle_deg", -90.0, 90.0)?;
        let azimuth = Distribution::read(section, "azimuth_deg", -360.0, 360.0)?;
        let conversion = Distribution::read(section, "conversion", 0.0, 1.0)?;
        let positive = f64::MIN_POSITIVE;
        Ok(Self {
            count: count as u64,
            place: Place::read(&place)?,
            along: direction(section, "direction")?,
            diameter: needed("diameter", "a diameter [m]", positive, 1.0)?,
            speed: needed("speed", "a speed [m/s]", 0.0, 1e5)?,
            relative_to_gas: section.boolean("relative_to_gas")?.unwrap_or(false),
            angle: angle.unwrap_or_else(|| Distribution::fixed(90.0)),
            azimuth: azimuth.unwrap_or_else(|| Distribution::uniform(0.0, 360.0)),
            temperature: needed("temperature", "a temperature [K]", 1.0, 1e5)?,
            conversion: conversion.unwrap_or_else(|| Distribution::fixed(1.0)),
            density: section.number_within("density", positive, 1e6)?,
            heat_capacity: section.number_within("heat_capacity", positive, 1e6)?,
            radiation: read_radiation(section)?,
            weight: read_weight(section)?,
            burning,
        })
    }

    /// Draws the diameter [m] and the first state of the particle with this number. Its velocity is on top of the gas's
    /// where the case says so.
    pub fn draw(&self, seed: u64, number: u64) -> (f64, State) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(number);
        let random = &mut random;
        let position = self.place.draw(random);
        let diameter = self.diameter.sample(random);
        let speed = self.speed.sample(random);
        let angle = self.angle.sample(random).to_radians();
        let azimuth = self.azimuth.sample(random).to_radians();
        let [first, second] = across(&self.along);
        let sideways = first * azimuth.cos() + second * azimuth.sin();
        let velocity = speed * (self.along * angle.sin() + sideways * angle.cos());
        let (temperature, conversion) = (self.temperature.sample(random), self.conversion.sample(random));
        (diameter, state(&position, &velocity, temperature, conversion))
    }

    /// Centres one of [`SWEEPABLE`] on a value.
    pub(super) fn centre(&mut self, what: &str, value: f64) {
        let distribution = match what {
            "diameter" => &mut self.diameter,
            "speed" => &mut self.speed,
            "angle_deg" => &mut self.angle,
            "conversion" => &mut self.conversion,
            _ => &mut self.temperature,
        };
        *distribution = distribution.centred(value);
    }
}

impl Place {
    fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let place = match section.choice("shape", &["point", "disc"])?.as_deref() {
            Some("point") => Self::Point(required_vector(section, "at")?),
            Some(_) => {
                let outer = required_within(section, "radius", 0.0, f64::INFINITY)?;
                let inner = section.number_within("inner_radius", 0.0, outer)?.unwrap_or(0.0);
                let centre = vector(section, "center")?;
                Self::Disc {
                    centre: centre.ok_or_else(|| section.missing("center", "[x, y, z] [m]"))?,
                    normal: direction(section, "normal")?,
                    radii: [inner, outer],
                }
            }
            None => return Err(section.missing("shape", "\"point\" or \"disc\"")),
        };
        section.finish()?;
        Ok(place)
    }

    /// Evenly over the area.
    fn draw(&self, random: &mut ChaCha8Rng) -> Vector3<f64> {
        match self {
            Self::Point(point) => *point,
            Self::Disc { centre, normal, radii: [inner, outer] } => {
                let uniform = |random: &mut ChaCha8Rng| -> f64 { StandardUniform.sample(random) };
                let share = uniform(random);
                let radius = (inner * inner + share * (outer * outer - inner * inner)).sqrt();
                let angle = TAU * uniform(random);
                let [first, second] = across(normal);
                centre + radius * (first * angle.cos() + second * angle.sin())
            }
        }
    }
}

fn read_radiation(section: &Section<'_>) -> Result<Option<(f64, f64)>, InputError> {
    let emissivity = section.number_within("emissivity", 0.0, 1.0)?;
    let surroundings = section.number_within("radiation_temperature", 1.0, 1e5)?;
    match (emissivity, surroundings) {
        (Some(emissivity), Some(temperature)) => Ok(Some((emissivity, temperature))),
        (None, None) => Ok(None),
        (Some(_), None) => Err(section.missing("radiation_temperature", "the temperature around [K]")),
        (None, Some(_)) => Err(section.missing("emissivity", "a number 0 to 1")),
    }
}

fn read_weight(section: &Section<'_>) -> Result<ParticleWeight, InputError> {
    let mass = section.number_within("mass", f64::MIN_POSITIVE, f64::INFINITY)?;
    match (section.choice("sizes_count", &["particles", "mass"])?.as_deref(), mass) {
        (Some("mass"), Some(mass)) => Ok(ParticleWeight::EqualShare(mass)),
        (Some("mass"), None) => Err(section.missing("mass", "the mass of all particles [kg]")),
        (_, Some(_)) => Err(section.fault("mass", "needs `sizes_count = \"mass\"`")),
        (_, None) => Ok(ParticleWeight::One),
    }
}
