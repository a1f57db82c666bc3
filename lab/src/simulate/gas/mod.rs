//! The gas that carries the particles: a prescribed velocity field, one kind a file, and the gas's properties.
//!
//! Particles do not act on the gas. A field is the mean flow; `[gas.turbulence]` adds fluctuations. Properties are
//! taken at the gas's own local temperature.

mod duct;
mod stagnation_jet;
mod swirling_pipe;
mod turbulence;
mod uniform;

pub use duct::Duct;
pub use stagnation_jet::StagnationJet;
pub use swirling_pipe::SwirlingPipe;
pub use turbulence::Turbulence;
pub use uniform::Uniform;

use nalgebra::Vector3;

use super::error::SimulationError;
use super::linear_profile::LinearProfile;
use nearwall::deposit::VoidGas;
use nearwall::input::{InputError, Limits, Section};
use nearwall::material::Property;
use nearwall::transport::thermophoresis;

/// A steady velocity field.
pub trait VelocityField: Send + Sync + std::fmt::Debug {
    /// Gas velocity [m/s] at a position [m]. It has to be finite everywhere, also behind a wall.
    fn velocity(&self, position: &Vector3<f64>) -> Vector3<f64>;

    /// Friction velocity [m/s] at the walls of a turbulent duct, and half its height [m].
    fn turbulent_duct(&self) -> Option<[f64; 2]> {
        None
    }

    /// Why gas would hardly flow like this, in words; `None` where nothing speaks against it.
    fn doubt(&self) -> Option<String> {
        None
    }
}

/// A gas: its velocity field, temperature and properties.
#[derive(Debug)]
pub struct Gas {
    field: Box<dyn VelocityField>,
    temperature: LinearProfile,
    /// In the order of [`GAS_PROPERTIES`].
    properties: [Property; 4],
    mean_free_path: f64,
    /// Pressure [Pa] from which the mean free path follows instead.
    pressure: Option<f64>,
    accommodation: f64,
    /// Its fluctuations, if it has some.
    pub turbulence: Option<Turbulence>,
    /// Whether its gradients of temperature push particles.
    pub thermophoresis: bool,
    /// Whether its molecules push particles about.
    pub brownian: bool,
}

/// Keys and units of the properties that depend on the temperature.
const GAS_PROPERTIES: [(&str, &str); 4] =
    [("density", "kg/m3"), ("viscosity", "Pa s"), ("conductivity", "W/(m K)"), ("heat_capacity", "J/(kg K)")];

/// The gas at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GasState {
    /// Velocity [m/s].
    pub velocity: Vector3<f64>,
    /// Temperature [K].
    pub temperature: f64,
    /// Density [kg/m³].
    pub density: f64,
    /// Dynamic viscosity [Pa s].
    pub viscosity: f64,
    /// Thermal conductivity [W/(m K)].
    pub conductivity: f64,
    /// Heat capacity [J/(kg K)].
    pub heat_capacity: f64,
    /// Mean free path of the molecules [m]; 0 for a dense gas.
    pub mean_free_path: f64,
    /// Share of the exchanged heat that molecules take over on hitting a particle [1]; acts in a thin gas.
    pub accommodation: f64,
}

/// Density, viscosity, conductivity and heat capacity.
fn properties(section: &Section<'_>) -> Result<[Property; 4], InputError> {
    let [density, viscosity, conductivity, heat_capacity] = GAS_PROPERTIES.map(|(key, unit)| {
        let read = Property::read(section, key, &Limits::positive(unit))?;
        read.ok_or_else(|| section.missing(key, &format!("a number [{unit}] or a table over T")))
    });
    Ok([density?, viscosity?, conductivity?, heat_capacity?])
}

impl Gas {
    /// Reads a `[gas]` table.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown field, a missing property, or one that is not known at the gas's
    /// temperatures.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let name = section.choice("field", &["uniform", "stagnation-jet", "swirling-pipe", "duct"])?;
        let Some(name) = name else {
            let what = "\"uniform\", \"stagnation-jet\", \"swirling-pipe\" or \"duct\"";
            return Err(section.missing("field", what));
        };
        let mut field: Box<dyn VelocityField> = match name.as_str() {
            "stagnation-jet" => Box::new(StagnationJet::read(section)?),
            "swirling-pipe" => Box::new(SwirlingPipe::read(section)?),
            "uniform" => Box::new(Uniform::read(section)?),
            _ => Box::new(Uniform::at_rest()),
        };
        let temperature = LinearProfile::read(section, "temperature", 1.0, 1e5)?
            .ok_or_else(|| section.missing("temperature", "a temperature [K]"))?;
        let properties = properties(section)?;
        if name == "duct" {
            let [low, high] = temperature.extremes();
            let mean = 0.5 * (low + high);
            let known = |property: &Property| property.at(mean).unwrap_or(f64::NAN);
            field = Box::new(Duct::read(section, known(&properties[1]) / known(&properties[0]))?);
        }
        let turbulence = section.section("turbulence")?;
        let turbulence = turbulence.map(|s| Turbulence::read(&s, field.turbulent_duct())).transpose()?;
        let gas = Self {
            field,
            temperature,
            properties,
            mean_free_path: section.number_within("mean_free_path", 0.0, f64::INFINITY)?.unwrap_or(0.0),
            pressure: section.number_within("pressure", f64::MIN_POSITIVE, f64::INFINITY)?,
            accommodation: section.number_within("accommodation", 1e-3, 1.0)?.unwrap_or(1.0),
            turbulence,
            thermophoresis: section.boolean("thermophoresis")?.unwrap_or(false),
            brownian: section.boolean("brownian")?.unwrap_or(false),
        };
        gas.check_thin(section)?;
        Ok(gas)
    }

    /// The gas at a position [m].
    pub fn at(&self, position: &Vector3<f64>) -> GasState {
        let temperature = self.temperature.at(position);
        // `check` made sure that every property is known at every temperature of the gas.
        let [density, viscosity, conductivity, heat_capacity] =
            self.properties.each_ref().map(|property| property.at(temperature).unwrap_or(f64::NAN));
        let velocity = self.field.velocity(position);
        let accommodation = self.accommodation;
        let from_pressure = |pressure| thermophoresis::mean_free_path(viscosity, density, pressure);
        let mean_free_path = self.pressure.map_or(self.mean_free_path, from_pressure);
        GasState {
            velocity,
            temperature,
            density,
            viscosity,
            conductivity,
            heat_capacity,
            mean_free_path,
            accommodation,
        }
    }

    /// Gradient of the temperature [K/m] at a position [m].
    pub fn temperature_gradient(&self, position: &Vector3<f64>) -> Vector3<f64> {
        self.temperature.gradient(position)
    }

    /// Whether it pushes particles at random.
    pub fn is_random(&self) -> bool {
        self.turbulence.is_some() || self.brownian
    }

    /// Whether particles leave the path that the mean flow and their inertia give them.
    pub fn disperses(&self) -> bool {
        self.is_random() || self.thermophoresis
    }

    /// The gas in the voids of a deposit at a position [m] of a wall with a coolant temperature [K]: through
    /// the conductivity at both temperatures, or as near to the colder one as it is known.
    pub(super) fn in_voids(&self, position: &Vector3<f64>, coldest: f64) -> VoidGas {
        let GasState { temperature, conductivity, .. } = self.at(position);
        let [.., property, _] = &self.properties;
        let [low, high] = property.known_range().unwrap_or([temperature; 2]);
        let other = coldest.max(low).min(high);
        let there = property.at(other).ok().map(|conductivity| [other, conductivity]);
        VoidGas::through([temperature, conductivity], there)
    }

    /// Why gas would hardly flow like its field, in words.
    pub fn doubt(&self) -> Option<String> {
        self.field.doubt()
    }

    /// The same gas at one temperature [K] everywhere.
    ///
    /// # Errors
    /// [`SimulationError::GasProperty`] for a property that is not known there.
    pub fn set_temperature(&mut self, temperature: f64) -> Result<(), SimulationError> {
        self.known_at(temperature)?;
        self.temperature = LinearProfile::constant(temperature);
        Ok(())
    }

    /// Whether every property is known at a temperature [K].
    ///
    /// # Errors
    /// [`SimulationError::GasProperty`] for the first property that is not.
    pub fn known_at(&self, temperature: f64) -> Result<(), SimulationError> {
        for ((key, _), property) in GAS_PROPERTIES.iter().zip(&self.properties) {
            property.at(temperature).map_err(|known| SimulationError::GasProperty {
                key,
                temperature,
                known,
            })?;
        }
        Ok(())
    }

    /// Checks that the mean free path is known where it matters.
    fn check_thin(&self, section: &Section<'_>) -> Result<(), InputError> {
        let given = [self.mean_free_path > 0.0, self.pressure.is_some()];
        match given {
            [true, true] => Err(section.fault("pressure", "gives the mean free path; remove mean_free_path")),
            [false, false] if self.thermophoresis || self.brownian => {
                let what =
                    "the pressure [Pa], or mean_free_path [m], which molecules that push particles need,";
                Err(section.missing("pressure", what))
            }
            _ => Ok(()),
        }
    }

    /// Checks that every property is known at the temperatures of the case file.
    pub fn check(&self, section: &Section<'_>) -> Result<(), InputError> {
        let known = |temperature| self.known_at(temperature).map_err(|p| section.fault("temperature", p));
        self.temperature.extremes().into_iter().try_for_each(known)
    }
}
