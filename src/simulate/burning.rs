//! Carbon conversion in flight by a simple law, so that the conversion at the wall is not an input.
//!
//! `first-order`: `dX/dt = A exp(-E/(R T_p)) (1 - X)`; `fixed-rate`: `dX/dt = rate` until nothing is left.
//! `X` is the carbon conversion [1]. The law does not resolve oxygen and steam in the gas, diffusion to
//! the particle, or heat of reaction: its parameters hold for one gas and one coal. The particle keeps its diameter and loses density, its mass is
//! `m_0 (1 - c X)` with `c` the carbon share of the unburnt particle.

use crate::input::{InputError, Section};
use crate::simulate::geometry::required_within;

/// Gas constant [J/(mol K)] (CODATA 2018, exact).
pub const GAS_CONSTANT: f64 = 8.314_462_618;

/// A `[conversion]` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Burning {
    law: ConversionLaw,
    /// Carbon share of the unburnt particle's mass, `c` [1].
    pub carbon: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum ConversionLaw {
    /// The conversion stays.
    None,
    FirstOrder {
        factor: f64,
        activation_energy: f64,
    },
    FixedRate(f64),
}

impl Burning {
    /// No conversion; the mass does not depend on it.
    pub const NONE: Self = Self { law: ConversionLaw::None, carbon: 0.0 };

    /// Reads a `[conversion]` table.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown law or a parameter that is missing or out of bounds.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let not_negative = |key| required_within(section, key, 0.0, f64::INFINITY);
        let law = match section.choice("law", &["first-order", "fixed-rate"])?.as_deref() {
            Some("first-order") => ConversionLaw::FirstOrder {
                factor: not_negative("pre_exponential")?,
                activation_energy: not_negative("activation_energy")?,
            },
            Some(_) => ConversionLaw::FixedRate(not_negative("rate")?),
            None => return Err(section.missing("law", "\"first-order\" or \"fixed-rate\"")),
        };
        let carbon = section.number_within("carbon", 0.0, 0.999)?.unwrap_or(0.0);
        section.text("source")?;
        section.finish()?;
        Ok(Self { law, carbon })
    }

    /// Rate of conversion `dX/dt` [1/s] at a particle temperature [K] and a conversion [1].
    pub fn rate(&self, temperature: f64, conversion: f64) -> f64 {
        match self.law {
            ConversionLaw::None => 0.0,
            ConversionLaw::FirstOrder { factor, activation_energy } => {
                factor
                    * (-activation_energy / (GAS_CONSTANT * temperature)).exp()
                    * (1.0 - conversion).max(0.0)
            }
            // Fades out over the last thousandth, so that the path stays smooth.
            ConversionLaw::FixedRate(rate) => rate * (1000.0 * (1.0 - conversion)).clamp(0.0, 1.0),
        }
    }

    /// Share of the unburnt mass that is left [1] at a conversion [1].
    pub fn mass_left(&self, conversion: f64) -> f64 {
        1.0 - self.carbon * conversion.clamp(0.0, 1.0)
    }
}
