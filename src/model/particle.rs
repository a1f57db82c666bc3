//! The particle of a model: its material, and the ash that it becomes.
//!
//! A char particle has the mechanical properties of its material at conversion 0 and of its ash at
//! conversion 1, in between *assumed* linear in the conversion (density, modulus, Poisson's ratio,
//! yield strength, work of adhesion). A model file without `ash` keeps those of the material.

use crate::impact::{Impact, ImpactError};
use crate::material::{Material, Mechanical};
use crate::normal::{self, Contact};

/// A `[particle]` table.
#[derive(Debug, Clone)]
pub struct Particle {
    pub(super) material: Material,
    pub(super) ash: Option<Material>,
}

impl Particle {
    /// The material of the unburnt particle.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// What is left when all carbon is gone, where the model file says so.
    pub fn ash(&self) -> Option<&Material> {
        self.ash.as_ref()
    }

    /// Its materials, to change them.
    pub(super) fn solids_mut(&mut self) -> impl Iterator<Item = &mut Material> {
        [Some(&mut self.material), self.ash.as_mut()].into_iter().flatten()
    }

    /// The material whose melt makes the particle sticky: the ash where there is one.
    pub fn melting(&self) -> &Material {
        self.ash.as_ref().unwrap_or(&self.material)
    }

    /// Whether the mechanical properties are the same for every impact.
    pub(super) fn is_constant(&self) -> bool {
        self.ash.is_none() && self.material.is_constant()
    }

    /// The material whose stated ranges an impact has to keep: that of the particle up to half of the
    /// conversion, the ash beyond.
    pub(super) fn stated_material(&self, impact: &Impact) -> &Material {
        self.ash.as_ref().filter(|_| impact.conversion > 0.5).unwrap_or(&self.material)
    }

    /// Density [kg/m³] of the materials for an impact, whatever density the impact gives.
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] outside a table.
    pub(super) fn density_of_materials(&self, impact: &Impact) -> Result<f64, ImpactError> {
        let char = self.material.density(impact.particle_temperature)?;
        let Some(ash) = &self.ash else { return Ok(char) };
        Ok(char + (ash.density(impact.particle_temperature)? - char) * impact.conversion)
    }

    /// The contact with a wall for an impact; the density is that of the impact where it is given.
    /// Work of adhesion as in [`Contact::new`].
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] outside a table.
    pub(super) fn contact(
        &self,
        impact: &Impact,
        wall: &Mechanical,
        yield_ratio: f64,
        work_of_adhesion: Option<f64>,
    ) -> Result<Contact, ImpactError> {
        let temperature = impact.particle_temperature;
        let char = self.material.mechanical(temperature)?;
        let ash = self.ash.as_ref().map(|ash| ash.mechanical(temperature)).transpose()?;
        let density = density_of(impact, &char, ash.as_ref());
        let work = |solid| normal::work_of_adhesion(solid, wall, work_of_adhesion);
        let works = [work(&char), ash.as_ref().map_or(0.0, work)];
        Ok(contact_of(impact.conversion, density, (&char, ash.as_ref()), wall, yield_ratio, works))
    }
}

/// The contact of a particle of a density [kg/m³] with a wall: of char, or of char and ash at a
/// conversion [1], from the work of adhesion [J/m²] of both; see [`Particle::contact`].
#[inline(always)]
pub(super) fn contact_of(
    conversion: f64,
    density: f64,
    (char, ash): (&Mechanical, Option<&Mechanical>),
    wall: &Mechanical,
    yield_ratio: f64,
    [of_char, of_ash]: [f64; 2],
) -> Contact {
    let contact = match ash {
        None => Contact::new(char, wall, yield_ratio, Some(of_char)),
        Some(ash) => {
            // A work of adhesion fitted to ash holds for ash: those of the two solids are mixed.
            let work = (1.0 - conversion) * of_char + conversion * of_ash;
            Contact::new(&char.mixed(ash, conversion), wall, yield_ratio, Some(work))
        }
    };
    Contact { density, ..contact }
}

/// Density [kg/m³] of an impact's particle: the one given, else that of its char, or char and ash.
#[inline(always)]
pub(super) fn density_of(impact: &Impact, char: &Mechanical, ash: Option<&Mechanical>) -> f64 {
    let mixed =
        ash.map_or(char.density, |ash| char.density + (ash.density - char.density) * impact.conversion);
    if impact.particle_density > 0.0 { impact.particle_density } else { mixed }
}
