//! Slag: the composition of an ash and the properties of its melt. One viscosity law a file;
//! [`film`] is the flow down a wall.
//!
//! A new law is one file with a [`ViscosityLaw`] and one line in [`VISCOSITY_LAWS`]; the model file
//! and `nearwall check` then know it. `tests/library/slag_viscosity.rs` compares the laws with
//! measurements. The laws describe a liquid or a quenched glass: that a slag with time crystallises
//! is in [`critical_viscosity_temperature`] and [`crystal_load`].

pub mod ash_fusion;
mod composition;
pub mod critical_viscosity_temperature;
pub mod crystal_load;
pub mod density;
pub mod elastic;
pub mod film;
pub mod giordano_russell_dingwell;
pub mod measured_range;
pub mod surface_tension;
pub mod urbain;
pub mod watt_fereday;

use fearless_simd::{Level, dispatch};

use crate::vector_math::exponential;
pub use ash_fusion::{FusionTemperatures, OutsideAshes};
pub use composition::{Composition, CompositionError, Oxide, OxideRole};

/// Every viscosity law.
pub static VISCOSITY_LAWS: [&ViscosityLaw; 4] = [
    &urbain::URBAIN,
    &urbain::KALMANOVITCH_FRANK,
    &watt_fereday::WATT_FEREDAY,
    &giordano_russell_dingwell::GIORDANO_RUSSELL_DINGWELL,
];

/// Ceiling of the exponent: `exp` stays finite (1e304), so a cold slag raises no overflow in a caller that traps it.
const LARGEST_VISCOSITY_EXPONENT: f64 = 700.0;

/// The properties of a melt at one temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Molten {
    /// Density `rho` [kg/m³].
    pub density: f64,
    /// Viscosity `mu` [Pa s].
    pub viscosity: f64,
    /// Surface tension `sigma` [N/m].
    pub surface_tension: f64,
}

/// How the viscosity of a molten slag follows from its composition and temperature.
#[derive(Debug)]
pub struct ViscosityLaw {
    /// The name in model files.
    pub name: &'static str,
    /// The slags and temperatures for which it is stated, in words.
    pub stated_for: &'static str,
    /// The two coefficients of the law for a composition, or what the composition lacks.
    pub coefficients: fn(&Composition) -> Result<[f64; 2], &'static str>,
    /// Viscosity [Pa s] from the coefficients, at a temperature [K] of 1 or more.
    pub viscosity: fn([f64; 2], f64) -> f64,
    /// The same for many temperatures, with the vectors of a level: `for_each_temperature` of that function.
    pub viscosities: fn(Level, [f64; 2], &[f64], &mut [f64]),
    /// Temperatures [K] for which the law is stated with a composition; `None` for a composition outside its range.
    pub range: fn(&Composition) -> Option<[f64; 2]>,
    /// Root mean square error in log10 on measured melts within that range; `None` where none was compared.
    pub error: Option<f64>,
}

/// Calls `viscosity` for each temperature, with the vectors of `level`. A law's function is inlined
/// here, so it becomes vectors where it has no branches.
#[inline(always)]
fn for_each_temperature(
    level: Level,
    coefficients: [f64; 2],
    temperatures: &[f64],
    viscosities: &mut [f64],
    viscosity: impl Fn([f64; 2], f64) -> f64,
) {
    dispatch!(level, _simd => {
        for (mu, temperature) in viscosities.iter_mut().zip(temperatures) {
            *mu = viscosity(coefficients, from_one_kelvin(*temperature));
        }
    });
}

/// The laws are not asked below 1 K.
#[inline(always)]
fn from_one_kelvin(temperature: f64) -> f64 {
    if temperature > 1.0 { temperature } else { 1.0 }
}

/// `exp` with its exponent at most [`LARGEST_VISCOSITY_EXPONENT`].
#[inline(always)]
fn limited_exponential(exponent: f64) -> f64 {
    exponential(if exponent < LARGEST_VISCOSITY_EXPONENT { exponent } else { LARGEST_VISCOSITY_EXPONENT })
}

/// Laws are equal when their names are.
impl PartialEq for ViscosityLaw {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl ViscosityLaw {
    /// The law of this name.
    pub fn from_name(name: &str) -> Option<&'static Self> {
        VISCOSITY_LAWS.into_iter().find(|law| law.name == name)
    }

    /// [`SlagViscosity::band_at`] within the range of the law.
    pub fn band(&self) -> Option<f64> {
        const NORMAL_90: f64 = 1.645;
        self.error.map(|error| 10_f64.powf(NORMAL_90 * error))
    }

    /// Viscosity of the slag [Pa s] at a temperature [K].
    ///
    /// Not a number where [`SlagViscosity::new`] refuses the composition, or when the temperature is not positive.
    pub fn at(&'static self, composition: &Composition, temperature: f64) -> f64 {
        SlagViscosity::new(self, composition).map_or(f64::NAN, |slag| slag.at(temperature))
    }
}

/// A composition to which a law cannot be applied.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("viscosity law `{}` does not apply to this composition: {reason}", .law.name)]
pub struct UnsuitableComposition {
    /// The law.
    pub law: &'static ViscosityLaw,
    /// What the composition lacks.
    pub reason: &'static str,
}

/// The viscosity of one slag after one law, prepared: a temperature costs one `exp`.
///
/// ```
/// use nearwall::slag::{Composition, SlagViscosity, urbain};
///
/// let ash = [("SiO2", 50.0), ("Al2O3", 25.0), ("CaO", 15.0), ("FeO", 10.0)];
/// let slag = SlagViscosity::new(&urbain::KALMANOVITCH_FRANK, &Composition::new(ash)?)?;
/// assert!((slag.at(1700.0) - 15.12).abs() < 0.01); // Pa s
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlagViscosity {
    law: &'static ViscosityLaw,
    coefficients: [f64; 2],
    range: Option<[f64; 2]>,
}

impl SlagViscosity {
    /// The law for a composition.
    ///
    /// # Errors
    /// [`UnsuitableComposition`] when the composition has none of the oxides that the law knows, or (Watt–Fereday,
    /// Giordano–Russell–Dingwell) one whose viscosity would not fall with temperature.
    pub fn new(law: &'static ViscosityLaw, composition: &Composition) -> Result<Self, UnsuitableComposition> {
        match (law.coefficients)(composition) {
            Ok(coefficients) => Ok(Self { law, coefficients, range: (law.range)(composition) }),
            Err(reason) => Err(UnsuitableComposition { law, reason }),
        }
    }

    /// The law.
    pub fn law(&self) -> &'static ViscosityLaw {
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
        if temperature > 0.0 {
            (self.law.viscosity)(self.coefficients, from_one_kelvin(temperature))
        } else {
            f64::NAN
        }
    }

    /// Factor [1] by which 90 % of measured melts are at most thicker or thinner than the law says, at a temperature
    /// [K]: `10^(1.645 s)` with the error `s` of the law, whose errors are taken as normal (a test counts them).
    /// `None` outside the range of the law and for one without a stated error.
    pub fn band_at(&self, temperature: f64) -> Option<f64> {
        self.law.band().filter(|_| self.holds_at(temperature))
    }

    /// As [`SlagViscosity::at`] for many positive temperatures [K], with the vectors of `level`.
    pub(crate) fn at_each(&self, level: Level, temperatures: &[f64], viscosities: &mut [f64]) {
        (self.law.viscosities)(level, self.coefficients, temperatures, viscosities);
    }

    /// Temperatures [K] for which the law is stated with this composition; `None` outside its range.
    pub(crate) fn range(&self) -> Option<[f64; 2]> {
        self.range
    }
}

#[cfg(test)]
mod tests {
    use super::composition::oxides;
    use super::*;
    use approx::assert_relative_eq;

    fn slag() -> Composition {
        Composition::new([("SiO2", 50.0), ("Al2O3", 25.0), ("CaO", 15.0), ("FeO", 10.0)]).unwrap()
    }

    #[test]
    fn every_name_leads_back_to_its_law_and_is_documented() {
        let page = include_str!("../../docs/reference/model-file.md");
        for law in VISCOSITY_LAWS {
            assert_eq!(ViscosityLaw::from_name(law.name), Some(law));
            assert!(
                page.contains(&format!("\"{}\"", law.name)),
                "docs/reference/model-file.md does not name {}",
                law.name
            );
        }
        assert_eq!(ViscosityLaw::from_name("water"), None);
    }

    #[test]
    fn prepared_and_direct_give_the_same_bits() {
        for law in VISCOSITY_LAWS {
            let prepared = SlagViscosity::new(law, &slag()).unwrap();
            assert_eq!(prepared.law(), law);
            for t in [1400.0, 1600.0, 1900.0] {
                assert_eq!(prepared.at(t).to_bits(), law.at(&slag(), t).to_bits());
            }
        }
    }

    /// Each law with a slag inside its range, a temperature below it, one inside, one above, and a slag outside.
    #[test]
    fn every_law_holds_in_its_range_alone() {
        let lime = oxides("SiO2 20, CaO 80");
        let alkali = oxides("SiO2 65, Al2O3 15, K2O 8, Na2O 8, CaO 4");
        let coal = oxides("SiO2 45, Al2O3 25, Fe2O3 10, CaO 15, MgO 5");
        for law in VISCOSITY_LAWS {
            let inside = if law.name == "giordano-russell-dingwell" { &alkali } else { &coal };
            let slag = SlagViscosity::new(law, inside).unwrap();
            let [low, high] = (law.range)(inside).unwrap();
            assert!(low > 1000.0 && high < 2600.0, "{law:?}");
            assert!(slag.holds_at(low) && slag.holds_at(1600.0) && slag.holds_at(high), "{law:?}");
            assert!(!slag.holds_at(low - 1.0) && !slag.holds_at(high + 1.0), "{law:?}");
            let words = law.stated_for;
            assert!(words.contains("wt%") && words.ends_with(&format!("{low:.0} to {high:.0} K")), "{words}");
            let outside = SlagViscosity::new(law, &lime);
            assert!(outside.is_err() || !outside.unwrap().holds_at(1600.0), "{law:?}");
        }
    }

    #[test]
    fn only_ratios_of_oxides_matter() {
        let half = Composition::new([("SiO2", 25.0), ("Al2O3", 12.5), ("CaO", 7.5), ("FeO", 5.0)]);
        for law in VISCOSITY_LAWS {
            let (a, b) = (law.at(&slag(), 1600.0), law.at(half.as_ref().unwrap(), 1600.0));
            assert_relative_eq!(a, b, max_relative = 1e-13);
        }
    }

    #[test]
    fn viscosity_falls_with_temperature_and_stays_finite_in_the_cold() {
        for law in VISCOSITY_LAWS {
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
        for law in VISCOSITY_LAWS {
            let message = SlagViscosity::new(law, &sulphur).unwrap_err().to_string();
            assert!(message.contains(law.name), "{message}");
            assert!(law.at(&sulphur, 1600.0).is_nan());
        }
    }
}
