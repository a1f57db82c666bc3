//! Stickiness that rises over one input (Richards' curve), for `melting-transition` and `conversion-transition`.
//!
//! `S = (1 + (2^(1/a) - 1) exp((x_50 - x) / width))^-a`, one half at `x_50`; with the asymmetry `a` = 1 the logistic
//! `1 / (1 + exp((x_50 - x) / width))`. A particle that still rebounds leaves with `e_n (1 - softening S)`.
//! `x`, `x_50` and `width` are temperatures [K] or carbon conversions [1]; `softening` and `a` are pure numbers.

use super::{Effect, Parameter, Precomputed, Search};
use crate::impact::Impact;
use crate::vector_math::exponential;

/// Last parameter of both effects.
pub(super) const ASYMMETRY: Parameter =
    Parameter::new("asymmetry", "1", (0.01, 100.0), Search::Log(0.2, 10.0))
        .default(1.0)
        .about("above 1 the rise begins steeply and ends slowly, below 1 the other way round");

/// The input that stickiness rises over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Variable {
    /// The particle's temperature [K].
    Temperature,
    /// The carbon conversion [1].
    Conversion,
}

impl Variable {
    #[inline(always)]
    fn value(self, particle_temperature: f64, conversion: f64) -> f64 {
        match self {
            Self::Temperature => particle_temperature,
            Self::Conversion => conversion,
        }
    }
}

/// A symmetric transition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transition {
    variable: Variable,
    middle: f64,
    /// One over the width.
    sharpness: f64,
}

impl Transition {
    /// Stickiness [1] at a particle temperature [K] and carbon conversion [1].
    #[inline(always)]
    pub(crate) fn at(&self, particle_temperature: f64, conversion: f64) -> f64 {
        self.at_value(self.variable.value(particle_temperature, conversion))
    }

    /// Stickiness [1] at a value of [`Self::input`].
    #[inline(always)]
    pub(crate) fn at_value(&self, value: f64) -> f64 {
        1.0 / (1.0 + exponential((self.middle - value) * self.sharpness))
    }

    /// Place in [`INPUTS`](crate::impact::INPUTS) of the input that stickiness rises over.
    pub(crate) fn input(&self) -> usize {
        match self.variable {
            Variable::Temperature => Impact::PARTICLE_TEMPERATURE,
            Variable::Conversion => Impact::CONVERSION,
        }
    }
}

/// Both effects.
#[derive(Debug)]
struct RichardsCurve {
    symmetric: Transition,
    width: f64,
    softening: f64,
    asymmetry: f64,
}

/// The effect with the parameters `x_50`, `width`, `softening` and `a`.
pub(super) fn transition(variable: Variable, values: &[f64]) -> Box<dyn Effect> {
    let symmetric = Transition { variable, middle: values[0], sharpness: values[1].recip() };
    Box::new(RichardsCurve { symmetric, width: values[1], softening: values[2], asymmetry: values[3] })
}

impl Effect for RichardsCurve {
    fn particle_stickiness(&self, impact: &Impact) -> Option<f64> {
        let (temperature, conversion) = (impact.particle_temperature, impact.conversion);
        if self.asymmetry == 1.0 {
            return Some(self.symmetric.at(temperature, conversion));
        }
        let distance =
            (self.symmetric.middle - self.symmetric.variable.value(temperature, conversion)) / self.width;
        let lead = self.asymmetry.recip().exp2() - 1.0;
        Some((1.0 + lead * distance.exp()).powf(-self.asymmetry))
    }

    fn rebound_loss(&self) -> f64 {
        self.softening
    }

    /// Only the symmetric curve: the power of an asymmetric one is not plain arithmetic.
    fn precompute(&self) -> Option<Precomputed> {
        (self.asymmetry == 1.0).then_some(Precomputed::Transition(self.symmetric))
    }
}
