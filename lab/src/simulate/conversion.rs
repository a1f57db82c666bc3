//! Carbon conversion in flight by a simple law, so that the conversion at the wall is not an input.
//!
//! `first-order`: `dX/dt = A exp(-E/(R T_p)) (1 - X)`; `fixed-rate`: `dX/dt = rate` until nothing
//! is left. `X` is the carbon conversion [1]. The law does not resolve oxygen and steam in the gas,
//! diffusion to the particle, or heat of reaction: its parameters hold for one gas and one coal.
//! [`super::shrinkage`] gives the particle's size and density.

use super::geometry::required_within;
use super::shrinkage::{DIAMETER_EXPONENT, LARGEST_DIAMETER_EXPONENT};
use nearwall::input::{InputError, Section};

pub use nearwall::deposit::vapour_condensation::GAS_CONSTANT;

/// A `[conversion]` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CarbonConversion {
    law: ConversionLaw,
    /// Combustible share of the unburnt particle's mass, `c` [1].
    pub carbon: f64,
    /// Exponent `a` of the size of the combustible matter [1].
    pub diameter_exponent: f64,
    /// Density of the ash [kg/m³], where the case gives it.
    pub ash_density: Option<f64>,
}

/// Carbon left at which a fixed rate begins to fade out [1].
const FADE: f64 = 1e-3;

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

impl CarbonConversion {
    /// No conversion; the mass does not depend on it.
    pub const NONE: Self = Self {
        law: ConversionLaw::None,
        carbon: 0.0,
        diameter_exponent: DIAMETER_EXPONENT,
        ash_density: None,
    };

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
        let exponent = section.number_within("diameter_exponent", 0.0, LARGEST_DIAMETER_EXPONENT)?;
        let ash_density = section.number_within("ash_density", f64::MIN_POSITIVE, 1e6)?;
        section.text("source")?;
        section.finish()?;
        Ok(Self { law, carbon, diameter_exponent: exponent.unwrap_or(DIAMETER_EXPONENT), ash_density })
    }

    /// The same law for particles with another combustible share [1].
    pub(super) fn with_carbon(self, carbon: f64) -> Self {
        Self { carbon, ..self }
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
            ConversionLaw::FixedRate(rate) => rate * (1.0 - conversion).clamp(0.0, FADE) / FADE,
        }
    }

    /// Conversion [1] after a `duration` [s] at one temperature [K]: the integral of [`CarbonConversion::rate`].
    pub fn after(&self, temperature: f64, conversion: f64, duration: f64) -> f64 {
        let left = 1.0 - conversion;
        match self.law {
            ConversionLaw::None | ConversionLaw::FixedRate(0.0) => conversion,
            ConversionLaw::FirstOrder { .. } => 1.0 - left * (-duration * self.rate(temperature, 0.0)).exp(),
            ConversionLaw::FixedRate(rate) => {
                let straight = ((left - FADE) / rate).clamp(0.0, duration);
                let fading = (duration - straight) * rate / FADE;
                1.0 - (left - rate * straight) * (-fading).exp()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rate in small steps of the midpoint rule.
    #[test]
    fn the_conversion_after_a_time_is_the_integral_of_the_rate() {
        let first_order = ConversionLaw::FirstOrder { factor: 500.0, activation_energy: 60_000.0 };
        for law in
            [first_order, ConversionLaw::FixedRate(0.8), ConversionLaw::FixedRate(0.0), ConversionLaw::None]
        {
            let burning = CarbonConversion { law, ..CarbonConversion::NONE };
            for (start, duration) in [(0.0, 1.0), (0.0, 1.2499), (0.0, 1.2505), (0.9995, 0.001), (1.0, 3.0)] {
                let steps = 100_000;
                let h = duration / f64::from(steps);
                let integrated = (0..steps).fold(start, |x, _| {
                    let middle = x + 0.5 * h * burning.rate(1500.0, x);
                    x + h * burning.rate(1500.0, middle)
                });
                let ours = burning.after(1500.0, start, duration);
                assert!((ours - integrated).abs() < 1e-7, "{law:?} {start} {duration}: {ours} {integrated}");
            }
        }
    }
}
