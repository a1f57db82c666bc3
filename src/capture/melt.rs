//! The viscosity of a melt: a material's own, or by a law from its composition; on a wall it
//! stiffens as it crystallises.

use fearless_simd::{Level, dispatch};

use super::Unsuitable;
use super::solidification::{Solidification, Stiffening};
use crate::impact::{BLOCK, ImpactError};
use crate::input::{InputError, Section};
use crate::material::Material;
use crate::slag::{SlagViscosity, VISCOSITY_LAWS, ViscosityLaw};

/// The `law` and the `solidification` of a `[capture]` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MeltLaws {
    law: Option<&'static ViscosityLaw>,
    solidification: Solidification,
}

impl MeltLaws {
    /// With a `law` that has to be given.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let laws = Self::read_optional(section)?;
        if laws.law.is_none() {
            let names = VISCOSITY_LAWS.map(|law| law.name);
            return Err(section.missing("law", &format!("one of {}", names.join(", "))));
        }
        Ok(laws)
    }

    /// With a `law` that only materials without a viscosity of their own need.
    pub fn read_optional(section: &Section<'_>) -> Result<Self, InputError> {
        Ok(Self { solidification: Solidification::read(section)?, ..Self::read_law(section)? })
    }

    /// As [`Self::read_optional`] for a criterion that itself says when melt is stiff.
    pub fn read_law(section: &Section<'_>) -> Result<Self, InputError> {
        let name = section.choice("law", &VISCOSITY_LAWS.map(|law| law.name))?;
        let law = name.and_then(|name| ViscosityLaw::from_name(&name));
        Ok(Self { law, solidification: Solidification::None })
    }

    /// The law with its range, in words; `None` without one.
    pub fn describe(self) -> Option<String> {
        let law = self.law?;
        Some(format!("{}, stated for {}", law.name, law.stated_for))
    }

    pub fn solidification(self) -> &'static str {
        self.solidification.name()
    }

    /// The melt of a material; `None` for one with neither a viscosity of its own nor a composition
    /// and a law. Its own viscosity has priority.
    ///
    /// # Errors
    /// [`Unsuitable`] when the law cannot be applied to the composition, or the material lacks what
    /// `solidification` needs.
    pub fn prepare(self, material: &Material) -> Result<Option<Melt>, Unsuitable> {
        let viscosity = match (material.property("viscosity"), self.law, material.composition()) {
            (Some(_), _, _) => MeltViscosity::Given(Box::new(material.clone())),
            (None, Some(law), Some(composition)) => {
                MeltViscosity::Oxides(SlagViscosity::new(law, composition)?)
            }
            _ => return Ok(None),
        };
        let solid_below = material.crystalline_below().unwrap_or(0.0);
        Ok(Some(Melt { viscosity, solid_below, stiffening: self.solidification.prepare(material)? }))
    }
}

/// One melt.
#[derive(Debug, Clone)]
pub(super) struct Melt {
    viscosity: MeltViscosity,
    /// Temperature [K] below which it is crystals, in flight too: the melting point of a crystalline
    /// material, 0 for any other.
    solid_below: f64,
    stiffening: Stiffening,
}

#[derive(Debug, Clone)]
enum MeltViscosity {
    Oxides(SlagViscosity),
    Given(Box<Material>),
}

impl Melt {
    /// Viscosity of the liquid [Pa s] at a temperature [K]; infinite for crystals.
    ///
    /// # Errors
    /// [`ImpactError::OutOfRange`] where the material's own viscosity is not known.
    pub fn viscosity(&self, temperature: f64) -> Result<f64, ImpactError> {
        if temperature < self.solid_below {
            return Ok(f64::INFINITY);
        }
        match &self.viscosity {
            MeltViscosity::Oxides(law) => Ok(law.at(temperature)),
            MeltViscosity::Given(material) => material.viscosity(temperature),
        }
    }

    /// Factor [1] of the 90 % band of the viscosity of the liquid at a temperature [K]; `None` for crystals, a
    /// material's own viscosity, and where none is stated.
    pub fn band_at(&self, temperature: f64) -> Option<f64> {
        match &self.viscosity {
            MeltViscosity::Oxides(law) if temperature >= self.solid_below => law.band_at(temperature),
            MeltViscosity::Oxides(_) | MeltViscosity::Given(_) => None,
        }
    }

    /// The law of a viscosity that follows from the composition, with its 90 % band, in words; `None` for a
    /// material's own.
    pub fn describe(&self) -> Option<String> {
        let MeltViscosity::Oxides(slag) = &self.viscosity else { return None };
        let band = match slag.law().band().filter(|_| slag.range().is_some()) {
            Some(factor) => format!("within a factor of {factor:.1} in its range (90 % band)"),
            None => "without a stated band for this composition".to_owned(),
        };
        Some(format!("viscosity from the composition by {}, {band}", slag.law().name))
    }

    /// Viscosity [Pa s] on a wall at a temperature [K]: infinite where it is stiff or below a
    /// measured table, and that at the end of the table above it.
    pub fn film_viscosity(&self, temperature: f64) -> f64 {
        let [low, high] = self.known_range();
        let known = (temperature >= low).then(|| self.viscosity(temperature.min(high)).ok());
        known.flatten().unwrap_or(f64::INFINITY) * self.stiffening.factor(temperature)
    }

    /// As [`Self::viscosity`] for many temperatures [K] at which it is known, with the vectors of `level`.
    pub fn viscosities(&self, level: Level, temperatures: &[f64], out: &mut [f64]) {
        self.liquid_viscosities(level, temperatures, out);
        let solid_below = self.solid_below;
        dispatch!(level, _simd => {
            for (viscosity, temperature) in out.iter_mut().zip(temperatures) {
                *viscosity = if *temperature < solid_below { f64::INFINITY } else { *viscosity };
            }
        });
    }

    fn liquid_viscosities(&self, level: Level, temperatures: &[f64], out: &mut [f64]) {
        match &self.viscosity {
            MeltViscosity::Oxides(law) => law.at_each(level, temperatures, out),
            MeltViscosity::Given(material) => {
                if let Some(property) = material.property("viscosity") {
                    let out = &mut out[..temperatures.len()];
                    dispatch!(level, _simd => property.within_range_each(temperatures, out));
                }
            }
        }
    }

    /// As [`Self::film_viscosity`] for the wall temperatures [K] of a block.
    pub fn film_viscosities(&self, level: Level, temperatures: &[f64], out: &mut [f64]) {
        let [low, high] = self.known_range();
        let mut known = [0.0; BLOCK];
        let known = &mut known[..temperatures.len()];
        dispatch!(level, _simd => {
            known.iter_mut().zip(temperatures).for_each(|(known, t)| *known = t.max(low).min(high));
        });
        self.viscosities(level, known, out);
        dispatch!(level, _simd => self.stiffening.for_each(temperatures, out, |factor, temperature, viscosity| {
            let known = if temperature >= low { viscosity } else { f64::INFINITY };
            known * factor
        }));
    }

    /// As [`Self::holds_in_flight`] for many temperatures [K]: 1 or 0.
    pub fn hold_in_flight(&self, level: Level, temperatures: &[f64], out: &mut [u64]) {
        let ([low, high], solid_below) = (self.stated_range(), self.solid_below);
        dispatch!(level, _simd => {
            let inside = |t: f64| u64::from((t < solid_below) | ((t >= low) & (t <= high)));
            out.iter_mut().zip(temperatures).for_each(|(holds, t)| *holds = inside(*t));
        });
    }

    /// As [`Self::holds_on_wall`] for many temperatures [K]: 1 or 0.
    pub fn hold_on_wall(&self, level: Level, temperatures: &[f64], out: &mut [u64]) {
        let ([low, high], solid_below) = (self.stated_range(), self.solid_below);
        let stated = self.stiffening.holds();
        dispatch!(level, _simd => self.stiffening.for_each(temperatures, out, |factor, t, _| {
            let liquid = (t >= low) & (t <= high);
            u64::from((t < solid_below) | (stated & ((factor == f64::INFINITY) | liquid)))
        }));
    }

    /// Temperatures [K] for which the viscosity is stated; from infinity to 0 for none.
    pub fn stated_range(&self) -> [f64; 2] {
        match &self.viscosity {
            MeltViscosity::Oxides(law) => law.range().unwrap_or([f64::INFINITY, 0.0]),
            MeltViscosity::Given(_) => self.known_range(),
        }
    }

    /// The compositions for which its law of viscosity is stated, in words, where this one is none of them.
    pub fn stated_for(&self) -> Option<&'static str> {
        match &self.viscosity {
            MeltViscosity::Oxides(slag) if slag.range().is_none() => Some(slag.law().stated_for),
            _ => None,
        }
    }

    /// Temperatures [K] at which the viscosity is known; crystals need none.
    pub fn known_range(&self) -> [f64; 2] {
        match &self.viscosity {
            MeltViscosity::Oxides(_) => [0.0, f64::INFINITY],
            MeltViscosity::Given(material) => {
                let [low, high] = material.viscosity_range();
                [if self.solid_below >= low { 0.0 } else { low }, high]
            }
        }
    }

    /// Whether the viscosity is stated for the material at a temperature [K]; a material's own is
    /// within [`Self::known_range`].
    pub fn holds_in_flight(&self, temperature: f64) -> bool {
        let [low, high] = self.stated_range();
        temperature < self.solid_below || (low..=high).contains(&temperature)
    }

    /// Temperature [K] below which it is stiff on a wall; `None` for a liquid at every temperature.
    pub fn stiff_below(&self) -> Option<f64> {
        let stiff = self.stiffening.stiff_below().filter(|temperature| *temperature >= self.solid_below);
        stiff.or((self.solid_below > 0.0).then_some(self.solid_below))
    }

    /// Whether it is known where it stiffens.
    pub fn stiffening_is_known(&self) -> bool {
        let melts_first = self.stiffening.stiff_below().is_none_or(|stiff| stiff < self.solid_below);
        self.stiffening.holds() || (self.solid_below > 0.0 && melts_first)
    }

    /// As [`Self::holds_in_flight`], on a wall.
    pub fn holds_on_wall(&self, temperature: f64) -> bool {
        if temperature < self.solid_below {
            return true;
        }
        // Stiff slag has no viscosity that could be out of range.
        let stiff = self.stiffening.factor(temperature).is_infinite();
        self.stiffening.holds() && (stiff || self.holds_in_flight(temperature))
    }
}
