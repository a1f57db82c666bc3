//! Slag: what an ash is made of and how thick its melt is. One viscosity law a file.
//!
//! A [`ViscosityLaw`] is chosen by name; [`SlagViscosity`] is a law with a composition worked in, ready to be asked at
//! many temperatures. How well each law meets measurements is shown in `tests/slag_viscosity.rs`.

mod composition;
pub mod urbain;
pub mod watt_fereday;

pub use composition::{Composition, CompositionError, Oxide, Role};

/// Ceiling of the exponent: `exp` stays finite (1e304), so a cold slag raises no overflow in a caller that traps it.
const LARGEST_EXPONENT: f64 = 700.0;

/// Asks a law at a temperature [K]: never below 1 K, and not a number where there is no temperature.
fn guarded(temperature: f64, law: impl FnOnce(f64) -> f64) -> f64 {
    if temperature > 0.0 { law(temperature.max(1.0)) } else { f64::NAN }
}

/// How the viscosity of a molten slag follows from its composition and temperature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ViscosityLaw {
    /// Urbain et al. 1981, see [`urbain`].
    Urbain,
    /// Urbain's law with the constants of Kalmanovitch and Frank 1988, see [`urbain`].
    KalmanovitchFrank,
    /// Watt and Fereday 1969, see [`watt_fereday`].
    WattFereday,
}

impl ViscosityLaw {
    /// Every law.
    pub const ALL: [Self; 3] = [Self::Urbain, Self::KalmanovitchFrank, Self::WattFereday];

    /// The name in model files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Urbain => "urbain",
            Self::KalmanovitchFrank => "kalmanovitch-frank",
            Self::WattFereday => "watt-fereday",
        }
    }

    /// The law of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.name() == name)
    }

    /// Viscosity of the slag [Pa s] at a temperature [K].
    ///
    /// Not a number where [`SlagViscosity::new`] refuses the composition, or when the temperature is not positive.
    pub fn viscosity(self, composition: &Composition, temperature: f64) -> f64 {
        SlagViscosity::new(self, composition).map_or(f64::NAN, |slag| slag.at(temperature))
    }
}

/// A composition to which a law cannot be applied.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("viscosity law `{}` does not apply to this composition: {reason}", .law.name())]
pub struct UnsuitableComposition {
    /// The law.
    pub law: ViscosityLaw,
    /// What the composition lacks.
    pub reason: &'static str,
}

/// The viscosity of one slag after one law, prepared: a temperature costs one `exp`.
///
/// ```
/// use nearwall::slag::{Composition, SlagViscosity, ViscosityLaw};
///
/// let ash = [("SiO2", 50.0), ("Al2O3", 25.0), ("CaO", 15.0), ("FeO", 10.0)];
/// let slag = SlagViscosity::new(ViscosityLaw::KalmanovitchFrank, &Composition::new(ash)?)?;
/// assert!((slag.at(1700.0) - 15.12).abs() < 0.01); // Pa s
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlagViscosity {
    law: ViscosityLaw,
    form: Form,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    Weymann(urbain::Weymann),
    WattFereday(watt_fereday::Line),
}

impl SlagViscosity {
    /// Works a composition into a law.
    ///
    /// # Errors
    /// [`UnsuitableComposition`] when the composition has none of the oxides that the law knows, or (Watt–Fereday)
    /// so little silica and alumina that the viscosity would not fall with temperature.
    pub fn new(law: ViscosityLaw, composition: &Composition) -> Result<Self, UnsuitableComposition> {
        let weymann = |constants| {
            urbain::Weymann::new(constants, composition)
                .map(Form::Weymann)
                .ok_or("it has no oxide that stays in the melt")
        };
        let form = match law {
            ViscosityLaw::Urbain => weymann(urbain::URBAIN),
            ViscosityLaw::KalmanovitchFrank => weymann(urbain::KALMANOVITCH_FRANK),
            ViscosityLaw::WattFereday => watt_fereday::Line::new(composition)
                .map(Form::WattFereday)
                .ok_or("it has too little SiO2 and Al2O3"),
        };
        match form {
            Ok(form) => Ok(Self { law, form }),
            Err(reason) => Err(UnsuitableComposition { law, reason }),
        }
    }

    /// The law it follows.
    pub fn law(&self) -> ViscosityLaw {
        self.law
    }

    /// Viscosity [Pa s] at a temperature [K].
    ///
    /// The laws describe a liquid; a slag too cold to flow gets a number that grows up to some 1e300 and stays finite.
    /// Not a number when the temperature is not positive.
    pub fn at(&self, temperature: f64) -> f64 {
        guarded(temperature, |t| match self.form {
            Form::Weymann(law) => law.at(t),
            Form::WattFereday(law) => law.at(t),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn slag() -> Composition {
        Composition::new([("SiO2", 50.0), ("Al2O3", 25.0), ("CaO", 15.0), ("FeO", 10.0)]).unwrap()
    }

    #[test]
    fn every_name_leads_back_to_its_law() {
        for law in ViscosityLaw::ALL {
            assert_eq!(ViscosityLaw::from_name(law.name()), Some(law));
        }
        assert_eq!(ViscosityLaw::from_name("water"), None);
    }

    #[test]
    fn prepared_and_direct_give_the_same_bits() {
        let direct = |law, t| match law {
            ViscosityLaw::Urbain => urbain::viscosity(urbain::URBAIN, &slag(), t),
            ViscosityLaw::KalmanovitchFrank => urbain::viscosity(urbain::KALMANOVITCH_FRANK, &slag(), t),
            ViscosityLaw::WattFereday => watt_fereday::viscosity(&slag(), t),
        };
        for law in ViscosityLaw::ALL {
            let prepared = SlagViscosity::new(law, &slag()).unwrap();
            assert_eq!(prepared.law(), law);
            for t in [1400.0, 1600.0, 1900.0] {
                assert_eq!(prepared.at(t).to_bits(), direct(law, t).to_bits());
                assert_eq!(law.viscosity(&slag(), t).to_bits(), direct(law, t).to_bits());
            }
        }
    }

    #[test]
    fn only_ratios_of_oxides_matter() {
        let half = Composition::new([("SiO2", 25.0), ("Al2O3", 12.5), ("CaO", 7.5), ("FeO", 5.0)]);
        for law in ViscosityLaw::ALL {
            let (a, b) = (law.viscosity(&slag(), 1600.0), law.viscosity(half.as_ref().unwrap(), 1600.0));
            assert_relative_eq!(a, b, max_relative = 1e-13);
        }
    }

    #[test]
    fn viscosity_falls_with_temperature_and_stays_finite_in_the_cold() {
        for law in ViscosityLaw::ALL {
            let slag = SlagViscosity::new(law, &slag()).unwrap();
            let hot: Vec<f64> = (0..15).map(|i| slag.at(1000.0 + 100.0 * f64::from(i))).collect();
            assert!(hot.windows(2).all(|pair| pair[0] > pair[1]), "{law:?}: {hot:?}");
            for t in [f64::MIN_POSITIVE, 1.0, 40.0, 300.0, 423.15, 424.0, 600.0] {
                let cold = slag.at(t);
                assert!(cold.is_finite() && cold > 1e12, "{law:?} at {t} K: {cold}");
            }
            for t in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
                assert!(slag.at(t).is_nan());
            }
        }
    }

    #[test]
    fn compositions_that_do_not_fit_are_refused_by_name() {
        let sulphur = Composition::new([("SO3", 1.0)]).unwrap();
        for law in ViscosityLaw::ALL {
            let message = SlagViscosity::new(law, &sulphur).unwrap_err().to_string();
            assert!(message.contains(law.name()), "{message}");
            assert!(law.viscosity(&sulphur, 1600.0).is_nan());
        }
    }
}
