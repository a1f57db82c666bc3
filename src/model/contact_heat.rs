//! Heat that particles exchange with a wall while they touch it and rebound.

use std::f64::consts::PI;

use super::wall::WallPlace;
use super::{Model, Wall};
use crate::deposit::layers;
use crate::impact::{Impact, ImpactError};
use crate::material::Material;
use crate::normal::{self, HalfSpace};

impl Model {
    /// Heat [J] that one particle of this impact gives to the wall while it touches it and rebounds
    /// ([`normal::contact_heat`]), at most what brings it to the temperature of the surface; negative for a colder
    /// particle. Random numbers are at their median, 0.5, and covered and bare share count by their area. 0 where the
    /// model file does not ask for it, for a droplet, and on melt.
    ///
    /// # Errors
    /// As [`Model::resolve`].
    pub fn contact_heat(&self, wall: usize, impact: &Impact) -> Result<f64, ImpactError> {
        let mut arriving = *impact;
        let wall = self.at_wall(wall, &mut arriving)?;
        if !wall.contact_heat {
            return Ok(0.0);
        }
        if arriving.coverage == 0.0 || !wall.is_patchwork(&arriving) {
            return self.contact_heat_at(wall, &arriving, WallPlace::Anywhere);
        }
        let bare = self.contact_heat_at(wall, &layers::bare(&arriving), WallPlace::Bare)?;
        let covered = self.contact_heat_at(wall, &layers::covered(&arriving), WallPlace::Covered)?;
        Ok((1.0 - arriving.coverage) * bare + arriving.coverage * covered)
    }

    /// Whether any wall asks for the heat of contact.
    pub fn has_contact_heat(&self) -> bool {
        self.walls.iter().any(|wall| wall.contact_heat)
    }

    fn contact_heat_at(&self, wall: &Wall, impact: &Impact, place: WallPlace) -> Result<f64, ImpactError> {
        let temperature = impact.particle_temperature;
        let drop = self.stickiness.as_ref().is_some_and(|criterion| criterion.is_droplet(temperature));
        if drop || (place != WallPlace::Covered && self.melt_met(wall, impact)?.is_some()) {
            return Ok(0.0);
        }
        let contact = self.contact(wall, impact, place, &|_| 0.5)?;
        let touch = normal::touch(&contact, impact.diameter, impact.normal_speed);
        let (met, met_temperature) = wall.solid_met(impact, place, self.frozen_slag(wall, impact));
        let density = met.density_near(met_temperature)?;
        let solids = self.thermal_particle(impact, contact.density);
        let (Some(particle), Some(met)) = (solids, half_space(met, density, met_temperature)) else {
            return Ok(0.0);
        };
        let capacity = PI / 6.0 * impact.diameter.powi(3) * particle.density * particle.heat_capacity;
        let difference = temperature - impact.wall_temperature;
        Ok(difference * normal::contact_heat(&touch, &particle, &met).min(capacity))
    }

    /// Thermal properties of a particle of a density [kg/m³]: of char and ash linear in the conversion, as its
    /// mechanical ones.
    fn thermal_particle(&self, impact: &Impact, density: f64) -> Option<HalfSpace> {
        let of = |material| half_space(material, density, impact.particle_temperature);
        let char = of(self.particle.material())?;
        let Some(ash) = self.particle.ash() else { return Some(char) };
        let ash = of(ash)?;
        let between = |char: f64, ash: f64| char + (ash - char) * impact.conversion;
        Some(HalfSpace {
            density,
            heat_capacity: between(char.heat_capacity, ash.heat_capacity),
            conductivity: between(char.conductivity, ash.conductivity),
        })
    }
}

/// A solid of a density [kg/m³] at a temperature [K]; `None` without a heat capacity or a conductivity.
fn half_space(material: &Material, density: f64, temperature: f64) -> Option<HalfSpace> {
    Some(HalfSpace {
        density,
        heat_capacity: material.heat_capacity_near(temperature)?,
        conductivity: material.thermal_conductivity_near(temperature)?,
    })
}
