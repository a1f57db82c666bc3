//! Heat through a wall and what lies on it: the surface temperature that the next impact meets.
//!
//! From the coolant outwards: the wall and the layers of `src/deposit/layers.rs`, each with the
//! conductivity at its own mean temperature; in powder also that of the gas in the voids and of
//! radiation. Steady conduction: a deposit of 5 mm follows the gas within a minute, and grows over
//! hours. Where slag melts or freezes, the front takes heat or gives it (`src/deposit/front.rs`).

use super::Model;
use super::wall::Wall;
use crate::deposit::conduction::{ConductionError, HotSide};
use crate::deposit::conductivity::{self, Phases};
use crate::deposit::front::{FrontStep, HeatFlow, ThermalLayers};
use crate::deposit::layers::Layers;
use crate::deposit::{Deposit, WallMelt, sintering};
use crate::impact::ImpactError;
use crate::material::Material;
use crate::slag::film;

pub use crate::deposit::WallCooling;

/// Rounds in which conductivities and temperatures are made to agree: plain ones, then those that go
/// half of the way, and the change of temperature [K] at which they agree.
const PLAIN_ROUNDS: u32 = 50;
const MOST_ROUNDS: u32 = 200;
const AGREED: f64 = 1e-9;
/// Emissivity of grains whose material has none [1]; assumed.
const GRAIN_EMISSIVITY: f64 = 0.8;

/// The temperatures of a wall with a deposit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallHeat {
    /// Of the surface towards the gas [K].
    pub surface_temperature: f64,
    /// Of the wall under the deposit [K].
    pub wall_temperature: f64,
    /// Of the cold and the hot side of each layer [K].
    pub sides: Layers<[f64; 2]>,
    /// Heat flux from the gas into the surface [W/m²].
    pub heat_flux: f64,
    /// Heat flux into the coolant [W/m²]: [`Self::heat_flux`] unless slag melts or freezes.
    pub coolant_flux: f64,
    /// Thermal resistance of the deposit [m² K/W].
    pub deposit_resistance: f64,
    /// Temperature [K] of what holds it behind the surface, the coolant or a front that moves, and the
    /// thermal resistance [m² K/W] in between.
    pub behind: [f64; 2],
    /// Change of temperature [K] in the last round in which temperatures and conductivities were made to
    /// agree: at most 1e-9 where they do.
    pub disagreement: f64,
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
    /// Whether temperatures and conductivities agree. Where they do not, the conductivities are those of
    /// temperatures that are off by [`Self::disagreement`].
    pub fn has_settled(&self) -> bool {
        self.disagreement <= AGREED
    }
}

impl Model {
    /// Temperatures of a wall with a deposit whose fresh powder has a `voidage` [1].
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
        let (thermal, flow, disagreement) = self.thermal_layers(wall, deposit, voidage, cooling)?;
        Ok(WallHeat {
            surface_temperature: flow.surface(),
            wall_temperature: flow.wall(),
            sides: flow.sides,
            heat_flux: flow.from_gas,
            coolant_flux: flow.to_coolant,
            deposit_resistance: thermal.resistance(&deposit.layers()),
            behind: flow.behind,
            disagreement,
        })
    }

    /// What melts and freezes in a deposit over a time step [s], with the heat that it takes.
    /// Conductivities are those at its start.
    ///
    /// # Errors
    /// [`WallHeatError`].
    pub fn front_step(
        &self,
        wall: usize,
        deposit: &Deposit,
        voidage: f64,
        cooling: &WallCooling,
        duration: f64,
    ) -> Result<FrontStep, WallHeatError> {
        let (thermal, flow, _) = self.thermal_layers(wall, deposit, voidage, cooling)?;
        Ok(thermal.after_flow(&deposit.layers(), &flow, duration)?)
    }

    /// The layers of a deposit with their conductivities at their mean temperatures, the flow of heat,
    /// and the disagreement [K] of both.
    pub(super) fn thermal_layers(
        &self,
        wall: usize,
        deposit: &Deposit,
        voidage: f64,
        cooling: &WallCooling,
    ) -> Result<(ThermalLayers, HeatFlow, f64), WallHeatError> {
        super::deposit::check_voidage(voidage)?;
        let of = self.walls.get(wall).ok_or(ImpactError::NoSuchWall(wall))?;
        let masses = deposit.layers();
        let start = 0.5 * (cooling.hot.gas_temperature + cooling.coolant.temperature);
        let mut means = [start; 4];
        // What processes release at the surface [W/m²]. A surface that is held at a temperature needs no balance.
        let released_at = |surface: f64| {
            let gas = cooling.vapour_side();
            if cooling.hot.coefficient.is_finite() { of.processes.heat_flux(&gas, surface) } else { 0.0 }
        };
        let (mut released, mut round) = (0.0, 0);
        loop {
            if masses.inner_powder == 0.0 {
                // What melt will enclose of the outer powder.
                means[0] = means[3];
            }
            let thermal = self.layers_at_means((of, deposit), voidage, cooling, means, released)?;
            let flow = thermal.flow(&masses)?;
            let found = flow.sides.outwards().map(|[cold, hot]| 0.5 * (cold + hot));
            let more = released_at(flow.surface()) - released;
            let rise = if more == 0.0 { 0.0 } else { (more / cooling.hot.coefficient).abs() };
            let lying = means.iter().zip(found).zip(masses.outwards()).filter(|(_, mass)| *mass > 0.0);
            let disagreement = lying.map(|((mean, found), _)| (found - mean).abs()).fold(rise, f64::max);
            round += 1;
            if disagreement <= AGREED || round == MOST_ROUNDS {
                return Ok((thermal, flow, disagreement));
            }
            let way = if round <= PLAIN_ROUNDS { 1.0 } else { 0.5 };
            released += way * more;
            means.iter_mut().zip(found).for_each(|(mean, found)| *mean += way * (found - *mean));
        }
    }

    /// The layers of a deposit at mean temperatures [K], with what processes release at the surface [W/m²].
    fn layers_at_means(
        &self,
        (of, deposit): (&Wall, &Deposit),
        voidage: f64,
        cooling: &WallCooling,
        means: [f64; 4],
        released: f64,
    ) -> Result<ThermalLayers, WallHeatError> {
        let slag_melts_at = self.slag_melts_at(of);
        let near = slag_melts_at.unwrap_or(0.5 * (cooling.hot.gas_temperature + cooling.coolant.temperature));
        Ok(ThermalLayers {
            coolant: cooling.coolant,
            wall_resistance: cooling.wall_resistance,
            hot: HotSide { particle_flux: cooling.hot.particle_flux + released, ..cooling.hot },
            resistance_per_mass: self.resistances_per_mass(of, deposit, voidage, cooling, means)?,
            slag_melts_at,
            powder_melts_at: self.powder_melts_at(deposit.conversion),
            heat_of_fusion: self.melt_material(of).heat_of_fusion_near(near).unwrap_or(0.0),
        })
    }

    /// Thermal resistance over mass of each layer [m² K/W per kg/m²], at mean temperatures [K].
    fn resistances_per_mass(
        &self,
        wall: &Wall,
        deposit: &Deposit,
        voidage: f64,
        cooling: &WallCooling,
        [inner, frozen, molten, outer]: [f64; 4],
    ) -> Result<Layers<f64>, WallHeatError> {
        let grains = self.particle.melting();
        let slag = |temperature: f64| {
            let material = self.melt_material(wall);
            let conductivity = match material.thermal_conductivity_near(temperature) {
                // No slag lies there that would need it.
                None if deposit.slag() == 0.0 => 1.0,
                _ => conductivity_of(material, temperature)?,
            };
            Ok::<f64, WallHeatError>(1.0 / (material.density_near(temperature)? * conductivity))
        };
        let powder = |temperature: f64| {
            if deposit.powder == 0.0 {
                return Ok(0.0);
            }
            let porosity = deposit.porosity(voidage);
            let emissivity = grains.emissivity_near(temperature).unwrap_or(GRAIN_EMISSIVITY);
            let phases = Phases {
                solid: conductivity_of(grains, temperature)?,
                gas: cooling.void_gas.at(temperature),
                radiative: conductivity::radiative(temperature, deposit.powder_diameter(), emissivity),
            };
            let neck = sintering::neck_of_porosity(porosity, voidage);
            let conductivity = conductivity::deposit(porosity, neck, &phases);
            Ok::<f64, WallHeatError>(deposit.layer_thickness(voidage) / (deposit.powder * conductivity))
        };
        Ok(Layers {
            inner_powder: powder(inner)?,
            frozen: slag(frozen)?,
            molten: slag(molten)?,
            outer_powder: powder(outer)?,
        })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deposit::conduction::{Coolant, HotSide, STEFAN_BOLTZMANN};
    use crate::deposit::{VapourSide, VoidGas};
    use approx::assert_relative_eq;

    const ASH: &str = r#"
[particle]
material = "ash"
[walls.default]
material = "ash"
[normal]
model = "constant"
e_n = 0.4
[tangential]
model = "constant"
e_t = 0.7
[capture]
model = "viscosity"
law = "kalmanovitch-frank"
reference_viscosity = 1e4
[materials.ash]
density = 2500
youngs_modulus = 1e10
poisson_ratio = 0.2
yield_strength = 1e8
surface_energy = 0.1
viscosity = 100
critical_viscosity_temperature = 1400
thermal_conductivity = { T = [500, 1500], value = [1.0, 2.0] }
emissivity = 0.9
"#;

    const COOLING: WallCooling = WallCooling {
        coolant: Coolant { temperature: 580.0, coefficient: 5e3 },
        wall_resistance: 3e-4,
        hot: HotSide {
            gas_temperature: 1700.0,
            coefficient: 80.0,
            emissivity: 0.8,
            irradiation: 2.5e5,
            particle_flux: 1e3,
        },
        void_gas: VoidGas { conductivity: 0.1, temperature: 1500.0, exponent: 0.8 },
        vapour: VapourSide { coefficient: None, fraction: None },
    };

    /// 1.5 kg/m² of powder under 2 kg/m² of frozen and 1 kg/m² of molten slag, and powder outside.
    const DEPOSIT: Deposit = Deposit {
        molten: 1.0,
        powder: 2.0,
        solid: 8e-4,
        cover: 12.0,
        conversion: 1.0,
        closed: 0.0,
        resuspended: 0.0,
        frozen: 2.0,
        behind: 0.75,
    };

    /// The layers one after the other by hand: each resistance from the conductivity at the mean of the
    /// temperatures that the library found, and one flux through all of them.
    #[test]
    fn the_layers_are_resistances_in_series() {
        let model = Model::from_toml("m", ASH).unwrap();
        for deposit in [DEPOSIT, Deposit { powder: 0.0, solid: 0.0, cover: 0.0, ..DEPOSIT }] {
            let heat = model.wall_heat(0, &deposit, 0.6, &COOLING).unwrap();
            let flux = heat.coolant_flux;
            assert_eq!((heat.heat_flux, heat.has_settled()), (flux, true));
            let solid = |kelvin: f64| 1.0 + (kelvin - 500.0) / 1000.0;
            let powder = |kelvin: f64| {
                let gas = 0.1 * (kelvin / 1500.0_f64).powf(0.8);
                let radiative = 4.0 * STEFAN_BOLTZMANN * kelvin.powi(3) * 1e-4 * 0.9 / 1.1;
                conductivity::packed_bed(0.6, &Phases { solid: solid(kelvin), gas, radiative })
            };
            let thick = |mass: f64| mass / 2.0 * 8e-4 / 0.4;
            let slag = |mass: f64| mass / 2500.0;
            let Layers { inner_powder, frozen, molten, outer_powder } = deposit.layers();
            let parts: [(f64, &dyn Fn(f64) -> f64); 4] = [
                (thick(inner_powder), &powder),
                (slag(frozen), &solid),
                (slag(molten), &solid),
                (thick(outer_powder), &powder),
            ];
            let mut temperature = 580.0 + flux * (1.0 / 5e3 + 3e-4);
            assert_relative_eq!(heat.wall_temperature, temperature, max_relative = 1e-9);
            for ((thickness, conductivity), sides) in parts.into_iter().zip(heat.sides.outwards()) {
                assert_relative_eq!(sides[0], temperature, max_relative = 1e-9);
                temperature += flux * thickness / conductivity(0.5 * (sides[0] + sides[1]));
                assert_relative_eq!(sides[1], temperature, max_relative = 1e-9);
            }
            assert_relative_eq!(heat.surface_temperature, temperature, max_relative = 1e-9);
            assert_relative_eq!(COOLING.hot.heat_flux(temperature), flux, max_relative = 1e-9);
            let [behind, resistance] = heat.behind;
            assert_relative_eq!((temperature - behind) / resistance, flux, max_relative = 1e-9);
        }
    }

    /// A conductivity that jumps a thousandfold within a thousandth of a kelvin has no temperature at
    /// which both agree; the temperatures that are found lie between coolant and gas, and say so.
    #[test]
    fn what_does_not_settle_is_said() {
        let jump = "thermal_conductivity = { T = [1000, 1000.001], value = [0.01, 10] }";
        let text = ASH.replace("thermal_conductivity = { T = [500, 1500], value = [1.0, 2.0] }", jump);
        let model = Model::from_toml("m", &text).unwrap();
        let slag = Deposit { powder: 0.0, solid: 0.0, cover: 0.0, molten: 0.0, frozen: 5.0, ..DEPOSIT };
        let heat = model.wall_heat(0, &slag, 0.6, &COOLING).unwrap();
        assert!(!heat.has_settled() && heat.disagreement > 1e-3, "{heat:?}");
        assert!(heat.surface_temperature > 580.0 && heat.surface_temperature < 1700.0);
        assert!(model.front_step(0, &slag, 0.6, &COOLING, 60.0).is_ok());
    }
}
