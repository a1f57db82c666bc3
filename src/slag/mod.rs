//! Slag: what an ash is made of and how thick its melt is. One viscosity law a file; [`film`] is how
//! it runs down a wall.
//!
//! A [`ViscosityLaw`] is chosen by name; [`SlagViscosity`] is a law with a composition worked in, ready to be asked at
//! many temperatures. How well each law meets measurements is shown in `tests/library/slag_viscosity.rs`.

mod composition;
pub mod film;
pub mod silica_corrected;
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
    /// Kalmanovitch and Frank's law with a correction for silica, fitted here, see [`silica_corrected`].
    SilicaCorrected,
}

impl ViscosityLaw {
    /// Every law.
    pub const ALL: [Self; 4] =
        [Self::Urbain, Self::KalmanovitchFrank, Self::WattFereday, Self::SilicaCorrected];

    /// The name in model files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Urbain => "urbain",
            Self::KalmanovitchFrank => "kalmanovitch-frank",
            Self::WattFereday => "watt-fereday",
            Self::SilicaCorrected => "kalmanovitch-frank-silica",
        }
    }

    /// The law of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.name() == name)
    }

    /// The slags that it is stated for, in words; `None` for the published laws, whose ranges are not checked.
    pub fn stated_for(self) -> Option<&'static str> {
        match self {
            Self::Urbain | Self::KalmanovitchFrank | Self::WattFereday => None,
            Self::SilicaCorrected => {
                Some("SiO2 30 to 70, Al2O3 9 to 40, iron oxides up to 22 wt%, 1523 to 2456 K")
            }
        }
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
    /// Temperatures [K] that the law is stated for with this composition; `None` for none.
    range: Option<[f64; 2]>,
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
            ViscosityLaw::SilicaCorrected => urbain::Weymann::new(urbain::KALMANOVITCH_FRANK, composition)
                .zip(silica_corrected::factor(composition))
                .map(|(law, factor)| Form::Weymann(law.thickened(factor)))
                .ok_or("it has no oxide that stays in the melt"),
        };
        let range = match law {
            ViscosityLaw::SilicaCorrected => {
                silica_corrected::holds_for(composition).then_some(silica_corrected::TEMPERATURES)
            }
            _ => Some([0.0, f64::INFINITY]),
        };
        match form {
            Ok(form) => Ok(Self { law, form, range }),
            Err(reason) => Err(UnsuitableComposition { law, reason }),
        }
    }

    /// The law it follows.
    pub fn law(&self) -> ViscosityLaw {
        self.law
    }

    /// Whether the law is stated for this composition at a temperature [K]; see [`ViscosityLaw::stated_for`].
    pub fn holds_at(&self, temperature: f64) -> bool {
        self.range.is_some_and(|[low, high]| (low..=high).contains(&temperature))
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
            ViscosityLaw::SilicaCorrected => law.viscosity(&slag(), t),
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

    /// 15.124931412384822 Pa s after Kalmanovitch and Frank (see [`urbain`]), times 10^0.068970746.
    #[test]
    fn the_corrected_law_is_a_factor_on_kalmanovitch_and_frank() {
        let found = SlagViscosity::new(ViscosityLaw::SilicaCorrected, &slag()).unwrap();
        assert_relative_eq!(found.at(1700.0), 17.728180298, max_relative = 1e-8);
        assert!(found.holds_at(1700.0) && !found.holds_at(1500.0) && !found.holds_at(2500.0));
        let lime = Composition::new([("SiO2", 20.0), ("CaO", 80.0)]).unwrap();
        let outside = SlagViscosity::new(ViscosityLaw::SilicaCorrected, &lime).unwrap();
        assert!(!outside.holds_at(1700.0) && outside.at(1700.0) > 0.0);
        assert!(SlagViscosity::new(ViscosityLaw::Urbain, &lime).unwrap().holds_at(300.0));
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
