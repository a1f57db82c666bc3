//! When slag on a wall stops being a Newtonian liquid.
//!
//! Slag that lies on a wall has time to crystallise. Below the temperature of critical viscosity
//! `T_cv` it is stiff: its viscosity is taken as infinite, it holds no dry particle and does not
//! flow. A droplet in flight is quenched glass instead, so its viscosity law goes on below `T_cv`.
//!
//! `[capture] solidification`:
//! - `"watt"` (default): the material's `critical_viscosity_temperature` [K] where it is given,
//!   else Watt's equation for its composition ([`crate::slag::critical_viscosity_temperature`]); a
//!   material with neither stays liquid.
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
    /// Stiff below the temperature of critical viscosity, given or by Watt's equation.
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
            Self::Watt => Ok(match (given("critical_viscosity_temperature"), material.composition()) {
                (Some(temperature), _) => Stiffening::Below { temperature, stated: true },
                (None, Some(composition)) => critical_viscosity_temperature::watt(composition).map_or(
                    Stiffening::Never,
                    |temperature| {
                        let stated = critical_viscosity_temperature::watt_holds(composition);
                        Stiffening::Below { temperature, stated }
                    },
                ),
                (None, None) => Stiffening::Never,
            }),
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
    Below {
        /// `T_cv` [K].
        temperature: f64,
        /// Whether Watt's equation is stated for the composition.
        stated: bool,
    },
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
            Self::Never => 1.0,
            Self::Below { temperature: critical, .. } => {
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
            Self::Never => each(temperatures, out, |t, before| change(1.0, t, before)),
            Self::Below { temperature, stated } => {
                let law = Self::Below { temperature, stated };
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
            Self::Never => None,
            Self::Below { temperature, .. } => Some(temperature),
            Self::Crystals { liquidus, solidus } => Some(crystal_load::stiff_temperature(solidus, liquidus)),
        }
    }

    /// Whether the law is stated for the material.
    pub fn holds(self) -> bool {
        !matches!(self, Self::Below { stated: false, .. })
    }
}
