//! Heat through a wall and what lies on it: the surface temperature that the next impact meets.
//!
//! From the coolant outwards: the wall, powder with its voids and melt, in the order of
//! `src/deposit/layers.rs`. Steady conduction: a deposit of 5 mm follows the gas within a minute,
//! and grows over hours.

use super::Model;
use crate::deposit::conduction::{self, ConductingLayer, ConductionError, Coolant, HotSide};
use crate::deposit::conductivity::{self, Phases};
use crate::deposit::{Deposit, WallMelt, layers, sintering};
use crate::impact::ImpactError;
use crate::material::Material;
use crate::slag::film;

/// Rounds in which conductivities and temperatures are made to agree, and the change of temperature
/// [K] at which they do.
const MOST_ROUNDS: u32 = 50;
const AGREED: f64 = 1e-9;
/// Emissivity of grains whose material has none [1]; assumed.
const GRAIN_EMISSIVITY: f64 = 0.8;

/// A cooled wall, and what heats it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallCooling {
    /// What cools it from behind.
    pub coolant: Coolant,
    /// Thickness of the wall over its conductivity [m² K/W].
    pub wall_resistance: f64,
    /// What heats its surface.
    pub hot: HotSide,
    /// Conductivity of the gas in the voids of the powder [W/(m K)].
    pub gas_conductivity: f64,
}

/// The temperatures of a wall with a deposit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallHeat {
    /// Of the surface towards the gas [K].
    pub surface_temperature: f64,
    /// Of the wall under the deposit [K].
    pub wall_temperature: f64,
    /// Of the outside of the powder [K], under the melt.
    pub powder_temperature: f64,
    /// Heat flux from the gas to the coolant [W/m²].
    pub heat_flux: f64,
    /// Thermal resistance of the deposit [m² K/W].
    pub deposit_resistance: f64,
}

/// Why there are no temperatures.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WallHeatError {
    /// The material of a layer has no conductivity.
    #[error("material {0} has no thermal_conductivity; give it one")]
    NoConductivity(String),
    /// A deposit, a voidage or a wall that does not exist.
    #[error(transparent)]
    Deposit(#[from] ImpactError),
    /// The heat balance.
    #[error(transparent)]
    Conduction(#[from] ConductionError),
}

impl WallHeat {
    /// Temperatures [K] of the cold and the hot side of the powder.
    pub fn powder_sides(&self) -> [f64; 2] {
        [self.wall_temperature, self.powder_temperature]
    }
}

impl Model {
    /// Steady temperatures of a wall with a deposit whose fresh powder has a `voidage` [1].
    ///
    /// # Errors
    /// [`WallHeatError`].
    pub fn wall_heat(
        &self,
        wall: usize,
        deposit: &Deposit,
        voidage: f64,
        cooling: &WallCooling,
    ) -> Result<WallHeat, WallHeatError> {
        super::deposit::check_voidage(voidage)?;
        let melted = self.melt_material(self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?);
        let grains = self.particle.melting();
        let bare = ConductingLayer { thickness: cooling.wall_resistance, conductivity: 1.0 };
        let [thickness, porosity] = [deposit.layer_thickness(voidage), deposit.porosity(voidage)];

        let mut surface = cooling.hot.gas_temperature;
        let mut found = None;
        for _ in 0..MOST_ROUNDS {
            let mean = 0.5 * (surface + cooling.coolant.temperature);
            let phases = Phases {
                solid: if thickness > 0.0 { conductivity_of(grains, mean)? } else { 1.0 },
                gas: cooling.gas_conductivity,
                radiative: conductivity::radiative(
                    mean,
                    deposit.powder_diameter(),
                    grains.emissivity_near(mean).unwrap_or(GRAIN_EMISSIVITY),
                ),
            };
            let neck = sintering::neck_of_porosity(porosity, voidage);
            let powder =
                ConductingLayer { thickness, conductivity: conductivity::deposit(porosity, neck, &phases) };
            let melt = match deposit.molten {
                0.0 => ConductingLayer { thickness: 0.0, ..bare },
                mass => ConductingLayer {
                    thickness: mass / melted.density_near(surface)?,
                    conductivity: conductivity_of(melted, surface)?,
                },
            };
            let [inner, outer] = layers::outwards(powder, melt);
            let steady = conduction::steady(&[bare, inner, outer], &cooling.coolant, &cooling.hot)?;
            let change = (steady.surface_temperature - surface).abs();
            surface = steady.surface_temperature;
            let cold_sides = [steady.cold_sides[1], steady.cold_sides[2]];
            let [wall_temperature, powder_temperature] = layers::powder_sides(cold_sides, surface);
            found = Some(WallHeat {
                surface_temperature: surface,
                wall_temperature,
                powder_temperature,
                heat_flux: steady.heat_flux,
                deposit_resistance: powder.resistance() + melt.resistance(),
            });
            if change <= AGREED {
                break;
            }
        }
        found.ok_or(WallHeatError::Conduction(ConductionError::NoBalance))
    }

    /// Mean speed [m/s] at which melt of a mass [kg/m²] runs down a wall that a heat flux [W/m²]
    /// crosses: hot and thin outside, stiff inside. `surface_temperature` [K], `gravity_along` the
    /// wall [m/s²].
    ///
    /// # Errors
    /// [`WallHeatError`].
    pub fn film_velocity(
        &self,
        wall: usize,
        molten: f64,
        surface_temperature: f64,
        heat_flux: f64,
        gravity_along: f64,
    ) -> Result<f64, WallHeatError> {
        let at_surface = self.melt(wall, surface_temperature)?;
        let thickness = molten / at_surface.density;
        if heat_flux <= 0.0 || thickness == 0.0 {
            let WallMelt { density, viscosity, .. } = at_surface;
            return Ok(film::mean_velocity(thickness, density, viscosity, gravity_along));
        }
        let material = self.melt_material(&self.walls[wall]);
        let fall = heat_flux * thickness / conductivity_of(material, surface_temperature)?;
        // Colder than that nothing flows, and no law of viscosity needs to answer.
        let bottom = (surface_temperature - fall).max(1.0);
        let viscosity =
            |temperature: f64| self.melt(wall, temperature).map_or(f64::INFINITY, |melt| melt.viscosity);
        let temperatures = [bottom, surface_temperature];
        Ok(film::mean_velocity_of_layers(
            thickness,
            temperatures,
            at_surface.density,
            gravity_along,
            viscosity,
        ))
    }
}

fn conductivity_of(material: &Material, temperature: f64) -> Result<f64, WallHeatError> {
    material
        .thermal_conductivity_near(temperature)
        .ok_or_else(|| WallHeatError::NoConductivity(material.name().to_owned()))
}
