//! One wall of a model: its material and what lies on it.

use regex_lite::Regex;

use crate::capture::MeltStickiness;
use crate::impact::{Impact, ImpactError};
use crate::material::Material;
use crate::normal::Contact;

/// A `[walls.<name>]` table.
#[derive(Debug, Clone)]
pub struct Wall {
    pub(super) name: String,
    pub(super) pattern: Option<Regex>,
    pub(super) material: Material,
    /// The slag on it.
    pub(super) slag: Option<Material>,
    pub(super) melt: Option<MeltStickiness>,
    pub(super) layer_thickness: f64,
    pub(super) coverage: f64,
    pub(super) adhesion: Adhesion,
    /// The contact with the particle, where no property depends on temperature.
    pub(super) prepared: Option<Contact>,
}

/// Keys of the model file that change the contact of the two materials.
#[derive(Debug, Clone, Copy)]
pub(super) struct Adhesion {
    /// `c = p_y / sigma_y` [1].
    pub yield_ratio: f64,
    /// Work of adhesion [J/m²] where it is given.
    pub work: Option<f64>,
}

impl Wall {
    /// The name in the model file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Whether the name of the wall is a regular expression that matches the whole of `patch`.
    pub(super) fn fits(&self, patch: &str) -> bool {
        self.pattern.as_ref().is_some_and(|pattern| pattern.is_match(patch))
    }

    /// The impact with the powder and the covering that the model file puts on the wall.
    ///
    /// A powder layer also covers: one particle diameter of it hides the wall.
    pub(super) fn apply_deposit(&self, impact: &Impact) -> Impact {
        let layer_thickness = impact.layer_thickness.max(self.layer_thickness);
        let by_layer = (layer_thickness / impact.diameter).min(1.0);
        let coverage = impact.coverage.max(self.coverage).max(by_layer);
        Impact { layer_thickness, coverage, ..*impact }
    }

    /// The contact at the temperatures of the impact.
    pub(super) fn contact(&self, particle: &Material, impact: &Impact) -> Result<Contact, ImpactError> {
        if let Some(contact) = self.prepared {
            return Ok(contact);
        }
        let particle = particle.mechanical(impact.particle_temperature)?;
        let wall = self.material.mechanical(impact.wall_temperature)?;
        Ok(Contact::new(&particle, &wall, self.adhesion.yield_ratio, self.adhesion.work))
    }

    /// Stickiness of the wall [1]: that of its slag where no powder or char covers it, else 0.
    pub(super) fn stickiness(&self, impact: &Impact) -> Result<f64, ImpactError> {
        match &self.melt {
            Some(melt) => Ok(melt.probability(impact.wall_temperature)? * (1.0 - impact.coverage)),
            None => Ok(0.0),
        }
    }
}
