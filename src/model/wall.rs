//! One wall of a model: its material and what lies on it.

use std::sync::Arc;

use regex_lite::Regex;

use super::particle::Particle;
use crate::capture::StickinessCriterion;
use crate::deposit::{ProcessInfo, WallProcesses, cover};
use crate::erosion::Erosion;
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
    /// The stickiness of that slag.
    pub(super) melt: Option<Arc<dyn StickinessCriterion>>,
    /// Temperature [K] below which that slag is solid; `None` without slag, or where it is not known.
    pub(super) slag_solid_below: Option<f64>,
    /// The contact partner where powder covers the wall; otherwise the wall itself.
    pub(super) powder: Option<Material>,
    pub(super) covering: Covering,
    /// How impacts erode it, where the model file says so.
    pub(super) erosion: Option<Arc<dyn Erosion>>,
    /// What changes a deposit on it over time.
    pub(super) processes: WallProcesses,
    /// Whether particles that rebound exchange heat with it while they touch it.
    pub(super) contact_heat: bool,
    pub(super) adhesion: ContactSettings,
    /// The contact with the particle, where no property depends on temperature.
    pub(super) prepared: Option<Contact>,
}

/// Keys of the model file that change the contact of the two materials.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactSettings {
    /// `c = p_y / sigma_y` [1].
    pub yield_ratio: f64,
    /// Work of adhesion [J/m²] of the particle's material where it is given.
    pub work: Option<f64>,
    /// Work of adhesion [J/m²] of every contact, where an effect sets it.
    pub set: Option<f64>,
}

/// What the model file puts on a wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct Covering {
    /// Thickness of the powder layer [m].
    pub layer_thickness: f64,
    /// Thickness of the liquid film [m].
    pub film_thickness: f64,
    /// Covered share [1].
    pub coverage: f64,
}

/// What an impact meets on a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum WallPlace {
    /// The wall as a whole, where bare and covered share do not differ.
    Anywhere,
    /// Bare wall or slag.
    Bare,
    /// Powder or char.
    Covered,
}

impl Covering {
    /// Gives an impact the powder, the covering and the film that the model file puts on the wall.
    ///
    /// A layer whose coverage is not given covers like grains of the particle's diameter.
    pub fn apply(&self, impact: &mut Impact) {
        let diameter = impact.diameter;
        let by_layer = |thickness: f64| {
            if thickness > 0.0 { cover::share(cover::of_layer(thickness, diameter)) } else { 0.0 }
        };
        // A wall's memory knows its cover and gives it with the layer.
        let given = if impact.coverage > 0.0 { impact.coverage } else { by_layer(impact.layer_thickness) };
        impact.coverage = given.max(self.coverage).max(by_layer(self.layer_thickness));
        impact.layer_thickness = impact.layer_thickness.max(self.layer_thickness);
        impact.film_thickness = impact.film_thickness.max(self.film_thickness);
    }
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

    /// The processes that change a deposit on it, with their places in [`PROCESSES`](crate::deposit::PROCESSES).
    pub fn processes(&self) -> impl Iterator<Item = (usize, &'static ProcessInfo)> {
        self.processes.acting()
    }

    /// Whether the name of the wall is a regular expression that matches the whole of `patch`.
    pub(super) fn fits(&self, patch: &str) -> bool {
        self.pattern.as_ref().is_some_and(|pattern| pattern.is_match(patch))
    }

    /// Whether covered and bare share decide an impact differently.
    pub(super) fn is_patchwork(&self, impact: &Impact) -> bool {
        self.melt.is_some() || self.powder.is_some() || impact.melt_thickness > 0.0
    }

    /// What a dry particle meets at a place.
    pub(super) fn partner(&self, place: WallPlace) -> &Material {
        match (place, &self.powder) {
            (WallPlace::Covered, Some(powder)) => powder,
            _ => &self.material,
        }
    }

    /// What a dry particle meets at a place, and its temperature [K]: powder and frozen slag have that of the
    /// surface, the wall's material its own. `frozen` is the slag where the wall lies under it.
    pub(super) fn solid_met<'w>(
        &'w self,
        impact: &Impact,
        place: WallPlace,
        frozen: Option<&'w Material>,
    ) -> (&'w Material, f64) {
        match (place, &self.powder, frozen) {
            (WallPlace::Covered, Some(powder), _) => (powder, impact.wall_temperature),
            (WallPlace::Bare | WallPlace::Anywhere, _, Some(slag)) => (slag, impact.wall_temperature),
            _ => (&self.material, impact.own_wall_temperature()),
        }
    }

    /// The contact with what is met ([`Self::solid_met`]) at the temperatures of the impact.
    pub(super) fn contact(
        &self,
        particle: &Particle,
        impact: &Impact,
        place: WallPlace,
        frozen: Option<&Material>,
    ) -> Result<Contact, ImpactError> {
        let (partner, temperature) = self.solid_met(impact, place, frozen);
        if let Some(contact) = self.prepared
            && std::ptr::eq(partner, &raw const self.material)
        {
            let given = impact.particle_density;
            return Ok(if given > 0.0 { Contact { density: given, ..contact } } else { contact });
        }
        let wall = partner.mechanical(temperature)?;
        let ContactSettings { yield_ratio, work, .. } = self.adhesion;
        particle.contact(impact, &wall, yield_ratio, work)
    }

    /// Stickiness of the slag that the model file puts on the wall [1].
    pub(super) fn slag_stickiness(&self, impact: &Impact) -> f64 {
        self.melt.as_ref().map_or(0.0, |melt| melt.on_wall(impact))
    }
}
