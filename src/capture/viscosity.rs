//! Viscosity criterion: a melt thinner than a reference viscosity sticks (Walsh et al. 1990).
//!
//! `P = min(1, mu_ref / mu(T))`, with `mu` the viscosity of ash or slag [Pa s] at its own temperature and `mu_ref` the
//! viscosity [Pa s] at and below which every impact sticks. The literature's `mu_ref` spans 8 to 1e7 Pa s: it has no
//! default. Valid for glassy silicate melts; on a wall, where a melt has time to crystallise, it is stiff below its temperature of
//! critical viscosity ([`Solidification`](super::Solidification)). It does not include residual carbon (see the effect
//! `conversion-transition`).

use super::solidification::{Solidification, Stiffening};
use super::{StickinessCriterion, Unsuitable};
use crate::impact::{Impact, ImpactError};
use crate::input::{InputError, Limits, Section};
use crate::material::Material;
use crate::slag::{SlagViscosity, VISCOSITY_LAWS, ViscosityLaw, withdrawn};

/// Probability of sticking [1] from the viscosity and the reference viscosity [both Pa s].
pub fn sticking_probability(viscosity: f64, reference: f64) -> f64 {
    (reference / viscosity).min(1.0)
}

/// From a tenth of the thinnest liquid to far above the viscosity of a solid glass.
const REFERENCE: Limits =
    Limits { unit: "Pa s", low: 1e-7, high: 1e20, known: "literature 8 to 1e7; glass is solid above 1e12" };

/// The viscosity criterion of a `[capture]` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViscosityCriterion {
    law: &'static ViscosityLaw,
    reference: f64,
    solidification: Solidification,
}

impl ViscosityCriterion {
    pub(super) fn read(section: &Section<'_>) -> Result<Self, InputError> {
        if let Some(why) = section.text("law")?.as_deref().and_then(withdrawn) {
            return Err(section.fault("law", why));
        }
        let names = VISCOSITY_LAWS.map(|law| law.name);
        let name = section.choice("law", &names)?;
        let law = match name.and_then(|name| ViscosityLaw::from_name(&name)) {
            Some(law) => law,
            None => return Err(section.missing("law", &format!("one of {}", names.join(", ")))),
        };
        let reference = section.quantity("reference_viscosity", &REFERENCE)?.ok_or_else(|| {
            let what = "the viscosity [Pa s] at which every impact sticks (literature: 8 to 1e7)";
            section.missing("reference_viscosity", what)
        })?;
        Ok(Self { law, reference, solidification: Solidification::read(section)? })
    }

    pub(super) fn describe(self) -> String {
        format!(
            "viscosity ({}, stated for {}), reference_viscosity {} Pa s, solidification {}",
            self.law.name,
            self.law.stated_for,
            self.reference,
            self.solidification.name()
        )
    }

    /// The criterion for a material; `None` for one with neither a viscosity of its own nor an oxide composition. Its own
    /// viscosity has priority.
    ///
    /// # Errors
    /// [`Unsuitable`] when the law cannot be applied to the composition, or the material lacks what `solidification` needs.
    pub fn prepare(self, material: &Material) -> Result<Option<MeltStickiness>, Unsuitable> {
        let melt = match (material.property("viscosity"), material.composition()) {
            (Some(_), _) => MeltViscosity::Given(Box::new(material.clone())),
            (None, Some(composition)) => MeltViscosity::Oxides(SlagViscosity::new(self.law, composition)?),
            (None, None) => return Ok(None),
        };
        let stiffening = self.solidification.prepare(material)?;
        Ok(Some(MeltStickiness { melt, reference: self.reference, stiffening }))
    }
}

/// The criterion for one melt.
#[derive(Debug, Clone)]
pub struct MeltStickiness {
    melt: MeltViscosity,
    reference: f64,
    stiffening: Stiffening,
}

#[derive(Debug, Clone)]
enum MeltViscosity {
    Oxides(SlagViscosity),
    Given(Box<Material>),
}

impl MeltStickiness {
    /// Viscosity of the liquid [Pa s] at a temperature [K].
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] where the material's own viscosity is not known.
    pub fn viscosity(&self, temperature: f64) -> Result<f64, ImpactError> {
        match &self.melt {
            MeltViscosity::Oxides(law) => Ok(law.at(temperature)),
            MeltViscosity::Given(material) => material.viscosity(temperature),
        }
    }
}

impl StickinessCriterion for MeltStickiness {
    fn name(&self) -> &'static str {
        "viscosity"
    }

    fn in_flight(&self, impact: &Impact) -> Result<f64, ImpactError> {
        Ok(sticking_probability(self.viscosity(impact.particle_temperature)?, self.reference))
    }

    fn on_wall(&self, impact: &Impact) -> f64 {
        sticking_probability(self.film_viscosity(impact.wall_temperature), self.reference)
    }

    fn film_viscosity(&self, temperature: f64) -> f64 {
        let [low, high] = self.known_range();
        let known = (temperature >= low).then(|| self.viscosity(temperature.min(high)).ok());
        known.flatten().unwrap_or(f64::INFINITY) * self.stiffening.factor(temperature)
    }

    fn known_range(&self) -> [f64; 2] {
        match &self.melt {
            MeltViscosity::Oxides(_) => [0.0, f64::INFINITY],
            MeltViscosity::Given(material) => material.viscosity_range(),
        }
    }

    /// A material's own viscosity holds within [`Self::known_range`].
    fn holds_in_flight(&self, temperature: f64) -> bool {
        match &self.melt {
            MeltViscosity::Oxides(law) => law.holds_at(temperature),
            MeltViscosity::Given(_) => {
                let [low, high] = self.known_range();
                (low..=high).contains(&temperature)
            }
        }
    }

    fn holds_on_wall(&self, temperature: f64) -> bool {
        // Stiff slag has no viscosity that could be out of range.
        let stiff = self.stiffening.factor(temperature).is_infinite();
        self.stiffening.holds() && (stiff || self.holds_in_flight(temperature))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thin_melts_stick_always_and_thick_ones_in_proportion() {
        assert_eq!(sticking_probability(10.0, 100.0), 1.0);
        assert_eq!(sticking_probability(1000.0, 100.0), 0.1);
    }
}
