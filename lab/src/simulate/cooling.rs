//! A cooled wall of a case: its temperature follows from the deposit on it.
//!
//! Table `cooling` of a wall: `coolant_temperature` [K], `coolant_coefficient` [W/(m² K)] (infinite
//! unless given), `thickness` [m] and `conductivity` [W/(m K)] of the wall (the latter by its
//! material unless given), `gas_coefficient` [W/(m² K)], `gas_temperature` [K] (that of the case's
//! gas at the wall unless given), `surroundings_temperature` [K] that radiates onto the wall, with
//! the `emissivity` of its surface [1]. What arriving particles bring comes on top.

use nalgebra::Vector3;

use super::gas::Gas;
use super::geometry::required_within;
use nearwall::deposit::VapourSide;
use nearwall::deposit::conduction::{Coolant, HotSide, STEFAN_BOLTZMANN};
use nearwall::input::{InputError, Section};
use nearwall::model::{Model, WallCooling};

/// A `cooling` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cooling {
    /// What cools the wall from behind.
    pub coolant: Coolant,
    /// Thickness of the wall over its conductivity [m² K/W].
    wall_resistance: f64,
    /// Heat transfer coefficient of the gas [W/(m² K)].
    gas_coefficient: f64,
    /// Temperature of the gas [K], where the case gives another one than that of its gas.
    gas_temperature: Option<f64>,
    /// Emissivity of the surface [1] and irradiation [W/m²].
    radiation: Option<[f64; 2]>,
}

impl Cooling {
    /// Reads the table of a wall of the model.
    ///
    /// # Errors
    /// [`InputError::Fault`] for a number that is missing or has no meaning.
    pub(super) fn read(section: &Section<'_>, model: &Model, wall: usize) -> Result<Self, InputError> {
        let positive = |key: &str| section.number_within(key, f64::MIN_POSITIVE, f64::INFINITY);
        let coolant = Coolant {
            temperature: required_within(section, "coolant_temperature", 1.0, 1e4)?,
            coefficient: positive("coolant_coefficient")?.unwrap_or(f64::INFINITY),
        };
        let thickness = required_within(section, "thickness", 0.0, 100.0)?;
        let material = model.walls()[wall].material();
        let own = || material.thermal_conductivity_near(coolant.temperature);
        let conductivity = positive("conductivity")?.or_else(own).ok_or_else(|| {
            section.missing("conductivity", &format!("[W/(m K)]; material {} has none", material.name()))
        })?;
        let surroundings = section.number_within("surroundings_temperature", 0.0, 1e4)?;
        let emissivity = section.number_within("emissivity", 0.0, 1.0)?;
        let radiation = match (surroundings, emissivity) {
            (None, None) => None,
            (Some(surroundings), Some(emissivity)) => {
                Some([emissivity, STEFAN_BOLTZMANN * surroundings.powi(4)])
            }
            (None, _) => {
                return Err(section.missing("surroundings_temperature", "[K], beside the emissivity"));
            }
            (_, None) => return Err(section.missing("emissivity", "[1] of the surface of the deposit")),
        };
        let cooling = Self {
            coolant,
            wall_resistance: thickness / conductivity,
            gas_coefficient: required_within(section, "gas_coefficient", 0.0, 1e6)?,
            gas_temperature: section.number_within("gas_temperature", 1.0, 1e5)?,
            radiation,
        };
        section.finish()?;
        Ok(cooling)
    }

    /// As the model takes it, at a place of the wall where particles bring `particle_flux` [W/m²].
    pub(super) fn at(&self, gas: &Gas, place: &Vector3<f64>, particle_flux: f64) -> WallCooling {
        let void_gas = gas.in_voids(place, self.coolant.temperature);
        let gas = gas.at(place);
        let [emissivity, irradiation] = self.radiation.unwrap_or_default();
        let hot = HotSide {
            gas_temperature: self.gas_temperature.unwrap_or(gas.temperature),
            coefficient: self.gas_coefficient,
            emissivity,
            irradiation,
            particle_flux,
        };
        WallCooling {
            coolant: self.coolant,
            wall_resistance: self.wall_resistance,
            hot,
            void_gas,
            vapour: VapourSide::default(),
        }
    }
}
