//! The `[capture]` table: the criterion for the stickiness of a particle.
//!
//! `viscosity` also applies to the slag on a wall. `droplet` applies to the particle alone: a deposit has no speed and is
//! sticky when it is molten.

use std::sync::Arc;

use super::droplet::DropletCriterion;
use super::viscosity::ViscosityCriterion;
use crate::impact::{Impact, ImpactError};
use crate::input::{InputError, Section};
use crate::material::Material;
use crate::slag::UnsuitableComposition;

/// The criterion of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Criterion {
    /// A melt of low viscosity sticks.
    Viscosity(ViscosityCriterion),
    /// A droplet that does not splash stays.
    Droplet(DropletCriterion),
}

/// Why a criterion does not apply to a material.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unsuitable {
    /// The viscosity law does not apply to its composition.
    #[error(transparent)]
    Composition(#[from] UnsuitableComposition),
    /// The droplet criterion needs properties that it lacks.
    #[error(
        "`{material}` has no {}, which [capture] model = \"droplet\" needs; give it to the material in [materials.{material}]",
        .lacking.join(", no ")
    )]
    Lacking {
        /// The material's name.
        material: String,
        /// The keys that it lacks.
        lacking: Vec<&'static str>,
    },
}

impl Criterion {
    /// Reads a `[capture]` table; `None` when its model is `none`.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown model or law, or a missing or impossible number.
    pub fn read(section: &Section<'_>) -> Result<Option<Self>, InputError> {
        match section.choice("model", &["none", "viscosity", "droplet"])?.as_deref() {
            Some("viscosity") => Ok(Some(Self::Viscosity(ViscosityCriterion::read(section)?))),
            Some("droplet") => Ok(Some(Self::Droplet(DropletCriterion::read(section)?))),
            _ => Ok(None),
        }
    }

    /// The criterion in words.
    pub fn describe(self) -> String {
        match self {
            Self::Viscosity(criterion) => criterion.describe(),
            Self::Droplet(criterion) => criterion.describe(),
        }
    }

    /// The criterion for slag on a wall, if this one applies to it.
    pub fn of_slag(self) -> Option<ViscosityCriterion> {
        match self {
            Self::Viscosity(criterion) => Some(criterion),
            Self::Droplet(_) => None,
        }
    }

    /// The criterion for particles of a material; `None` when it does not apply to that.
    ///
    /// # Errors
    /// [`Unsuitable`] when the material lacks what the criterion needs.
    pub fn of_particle(self, material: &Material) -> Result<Option<Arc<dyn ParticleStickiness>>, Unsuitable> {
        match self {
            Self::Viscosity(criterion) => Ok(criterion.prepare(material)?.map(|melt| Arc::new(melt) as _)),
            Self::Droplet(criterion) => {
                let lacking = |lacking| Unsuitable::Lacking { material: material.name().to_owned(), lacking };
                Ok(Some(Arc::new(criterion.prepare(material).map_err(lacking)?)))
            }
        }
    }
}

/// The criterion for the particle's material.
pub trait ParticleStickiness: std::fmt::Debug + Send + Sync {
    /// The model's name in the `[capture]` table.
    fn name(&self) -> &'static str;

    /// Stickiness of the particle [1].
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] where a required property is not known.
    fn at(&self, impact: &Impact) -> Result<f64, ImpactError>;

    /// Stickiness [1] of the material on a wall at a temperature [K]. By the droplet criterion it is 1 above the melting point and
    /// 0 below.
    fn as_deposit(&self, temperature: f64) -> f64;

    /// Viscosity [Pa s] of the material on a wall at a temperature [K]: infinite where it is frozen and below a measured table,
    /// and that at the end of the table above it.
    fn film_viscosity(&self, temperature: f64) -> f64;

    /// Whether a particle at a temperature [K] is a droplet, whose capture does not depend on the wall.
    fn is_droplet(&self, _temperature: f64) -> bool {
        false
    }

    /// Temperatures [K] at which the criterion can be evaluated.
    fn known_range(&self) -> [f64; 2];

    /// Whether the criterion is stated for this material at a temperature [K].
    fn holds_at(&self, temperature: f64) -> bool;
}
