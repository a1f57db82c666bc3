//! When slag on a wall stops being a Newtonian liquid.
//!
//! Slag that lies on a wall has time to crystallise. Below the temperature of critical viscosity
//! `T_cv` it is stiff: its viscosity is taken as infinite, it holds no dry particle and does not
//! flow. A droplet in flight is quenched glass instead, so its viscosity law goes on below `T_cv`.
//!
//! `[capture] solidification`:
//! - `"watt"` (default): the first of these that there is
//!   1. the material's `critical_viscosity_temperature` [K]
//!   2. Watt's equation, where it is stated for the composition
//!      ([`crate::slag::critical_viscosity_temperature`])
//!   3. the flow temperature of its `fusion_temperatures`: in the range of Watt's equation it follows
//!      `T_cv` closer than the hemisphere temperature does (figures in that file), some 30 K above it
//!
//!   A material with a composition and none of these stays liquid and is flagged as outside the range:
//!   no temperature is made up. A material without a composition stays liquid.
//! - `"crystal-load"`: crystals thicken the slag between the material's `liquidus` and `solidus` [K]
//!   ([`crate::slag::crystal_load`]).
//! - `"none"`: a liquid at every temperature.

use super::Unsuitable;
use crate::input::{InputError, Section};
use crate::material::Material;
use crate::slag::{critical_viscosity_temperature, crystal_load};

/// The `solidification` of a `[capture]` table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Solidification {
    /// Stiff below the temperature of critical viscosity: given, by Watt's equation, or the flow temperature.
    #[default]
    Watt,
    /// Thickened by crystals between liquidus and solidus.
    CrystalLoad,
    /// A liquid at every temperature.
    None,
}

impl Solidification {
    const NAMES: [(&'static str, Self); 3] =
        [("watt", Self::Watt), ("crystal-load", Self::CrystalLoad), ("none", Self::None)];

    pub(super) fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let word = section.choice("solidification", &Self::NAMES.map(|(name, _)| name))?;
        let named = word.and_then(|word| Self::NAMES.into_iter().find(|(name, _)| *name == word));
        Ok(named.map_or_else(Self::default, |(_, law)| law))
    }

    /// The name in model files.
    pub fn name(self) -> &'static str {
        Self::NAMES.into_iter().find(|(_, law)| *law == self).map_or("", |(name, _)| name)
    }

    /// The law for one material.
    pub(super) fn prepare(self, material: &Material) -> Result<Stiffening, Unsuitable> {
        let given = |key| material.property(key).and_then(|property| property.at(293.15).ok());
        match self {
            Self::None => Ok(Stiffening::Never),
            Self::Watt => {
                let by_watt = || critical_viscosity_temperature::watt(material.composition()?);
                let by_sheet = || material.fusion_temperatures().map(|sheet| sheet.flow);
                let known = given("critical_viscosity_temperature").or_else(by_watt).or_else(by_sheet);
                let unknown =
                    if material.composition().is_some() { Stiffening::Unknown } else { Stiffening::Never };
                Ok(known.map_or(unknown, Stiffening::Below))
            }
            Self::CrystalLoad => match (given("liquidus"), given("solidus")) {
                (Some(liquidus), Some(solidus)) => Ok(Stiffening::Crystals { liquidus, solidus }),
                (liquidus, solidus) => {
                    let missing = [("liquidus", liquidus), ("solidus", solidus)];
                    Err(Unsuitable::Lacking {
                        material: material.name().to_owned(),
                        needed_by: "solidification = \"crystal-load\"",
                        lacking: missing.iter().filter(|m| m.1.is_none()).map(|m| m.0).collect(),
                    })
                }
            },
        }
    }
}

/// How one slag stiffens as it cools.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stiffening {
    Never,
    /// Taken as a liquid at every temperature, because nothing says where it stiffens.
    Unknown,
    /// Below `T_cv` [K].
    Below(f64),
    Crystals {
        liquidus: f64,
        solidus: f64,
    },
}

#[inline(always)]
fn each<T: Copy>(temperatures: &[f64], out: &mut [T], change: impl Fn(f64, T) -> T) {
    for (entry, temperature) in out.iter_mut().zip(temperatures) {
        *entry = change(*temperature, *entry);
    }
}

impl Stiffening {
    /// Factor on the viscosity of the liquid [1] at a temperature [K]: 1 or more, infinite where it is stiff.
    #[inline(always)]
    pub fn factor(self, temperature: f64) -> f64 {
        match self {
            Self::Never | Self::Unknown => 1.0,
            Self::Below(critical) => {
                if temperature < critical {
                    f64::INFINITY
                } else {
                    1.0
                }
            }
            Self::Crystals { liquidus, solidus } => {
                crystal_load::einstein_roscoe(crystal_load::crystal_share(temperature, solidus, liquidus))
            }
        }
    }

    /// Changes each entry by [`Self::factor`], its temperature [K] and its value before. The law is
    /// matched outside the loop, which the compiler turns into vector instructions.
    #[inline(always)]
    pub fn for_each<T: Copy>(self, temperatures: &[f64], out: &mut [T], change: impl Fn(f64, f64, T) -> T) {
        match self {
            Self::Never | Self::Unknown => each(temperatures, out, |t, before| change(1.0, t, before)),
            Self::Below(critical) => {
                let law = Self::Below(critical);
                each(temperatures, out, |t, before| change(law.factor(t), t, before));
            }
            Self::Crystals { liquidus, solidus } => {
                let law = Self::Crystals { liquidus, solidus };
                each(temperatures, out, |t, before| change(law.factor(t), t, before));
            }
        }
    }

    /// Temperature [K] below which it is stiff; `None` for a liquid at every temperature.
    pub fn stiff_below(self) -> Option<f64> {
        match self {
            Self::Never | Self::Unknown => None,
            Self::Below(critical) => Some(critical),
            Self::Crystals { liquidus, solidus } => Some(crystal_load::stiff_temperature(solidus, liquidus)),
        }
    }

    /// Whether it is known where the material stiffens.
    pub fn holds(self) -> bool {
        self != Self::Unknown
    }
}
