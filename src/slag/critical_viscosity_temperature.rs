//! Temperature of critical viscosity of a slag after Watt: below it a slag that has had time to crystallise is stiff.
//!
//! ```text
//! T_cv = 2990 - 1470 (S/A) + 360 (S/A)² - 14.7 (F + C + M) + 0.15 (F + C + M)²     T_cv in °C
//! ```
//!
//! `S`, `A`, `F`, `C` and `M` are the shares of `SiO2`, `Al2O3`, `Fe2O3`, `CaO` and `MgO` [wt%],
//! scaled so that the five add up to 100, with all iron as `Fe2O3` ([`FiveOxides`]). Alkalis,
//! titania and the rest do not enter.
//!
//! A slag on a wall stays for minutes or longer and crystallises below this temperature. A droplet in flight cools
//! in milliseconds and stays a glass: the temperature says nothing about it.
//!
//! Source: J. D. Watt, "The flow properties of slags formed from the ashes of British coals. Part
//! 2: The crystallizing behaviour of the slags", J. Inst. Fuel 42 (1969) 131–134; often cited as
//! Watt 1963. Not re-read, and no second source with the numbers could be looked up. That it is in
//! °C follows from M. Seggiani, Fuel 77 (1998) 1611, who writes it in kelvin with 3263 for 2990
//! (from memory).
//!
//! # Range and error
//! Slags of British bituminous ash in Watt and Fereday's range of composition
//! ([`FiveOxides::is_like_british_ash`]; the range is that of part 1). In addition `S/A` at most
//! [`LARGEST_OXIDE_RATIO`] (assumed): the parabola has its minimum at `S/A = 2.04` and rises beyond
//! it, by 1380 K at `S/A = 4`, where slags rich in silica crystallise late if at all. Outside there is
//! no value: a straw ash would get 44,778 K.
//!
//! The source's error is not known to us. Of the ashes in `tests/data/ash_fusion_temperatures.csv` 44 lie
//! in the range and have a flow temperature: `T_cv` is 30 K below it in the mean, with a standard
//! deviation of 66 K and a correlation of 0.63 (0.21 with the hemisphere temperature, 26 ashes).

use super::composition::Composition;
use super::watt_fereday::FiveOxides;

/// Largest ratio of silica to alumina [1] at which the formula is used: beyond it
/// the parabola has risen by more than 100 K above its minimum. Assumed.
pub const LARGEST_OXIDE_RATIO: f64 = 2.57;

/// Temperature of critical viscosity [K]; `None` for a composition outside the range.
///
/// ```
/// use nearwall::slag::{Composition, critical_viscosity_temperature};
///
/// let ash = [("SiO2", 50.0), ("Al2O3", 25.0), ("Fe2O3", 10.0), ("CaO", 13.0), ("MgO", 2.0)];
/// let found = critical_viscosity_temperature::watt(&Composition::new(ash)?);
/// // 2990 - 2940 + 1440 - 367.5 + 93.75 = 1216.25 °C
/// assert!((found.unwrap() - 1489.4).abs() < 1e-9);
/// # Ok::<(), nearwall::slag::CompositionError>(())
/// ```
pub fn watt(composition: &Composition) -> Option<f64> {
    const ZERO_CELSIUS: f64 = 273.15;
    let of = FiveOxides::of(composition)?;
    if !of.is_like_british_ash() || of.silica > LARGEST_OXIDE_RATIO * of.alumina {
        return None;
    }
    let ratio = of.silica / of.alumina;
    let flux = of.iron + of.lime + of.magnesia;
    let celsius = 2990.0 + ratio * (360.0 * ratio - 1470.0) + flux * (0.15 * flux - 14.7);
    Some(celsius + ZERO_CELSIUS)
}

#[cfg(test)]
mod tests {
    use super::super::composition::oxides;
    use super::*;
    use approx::assert_relative_eq;

    /// By hand: 18 FeO are 20.004 Fe2O3, so the five add up to 91.004; F + C + M = 28.004/91.004 =
    /// 30.7723 wt%, S/A = 2.5: 2990 - 3675 + 2250 - 452.353 + 142.040 = 1254.687 °C.
    #[test]
    fn slag_of_illinois_coal() {
        let slag = oxides("SiO2 45, Al2O3 18, FeO 18, CaO 7, MgO 1, Na2O 0.6, K2O 1.9, TiO2 1, P2O5 0.2");
        assert_relative_eq!(watt(&slag).unwrap(), 1254.687 + 273.15, epsilon = 2e-3);
    }

    #[test]
    fn only_the_five_oxides_count() {
        let five = oxides("SiO2 50, Al2O3 25, Fe2O3 10, CaO 13, MgO 2");
        let more = oxides("SiO2 50, Al2O3 25, Fe2O3 10, CaO 13, MgO 2, Na2O 7, SO3 5, TiO2 3");
        assert_relative_eq!(watt(&five).unwrap(), watt(&more).unwrap(), max_relative = 1e-13);
        // One mole of Fe2O3 is two of FeO.
        let ferrous = oxides("SiO2 50, Al2O3 25, FeO 8.998102, CaO 13, MgO 2");
        assert_relative_eq!(watt(&five).unwrap(), watt(&ferrous).unwrap(), max_relative = 1e-6);
    }

    /// The last is a wheat straw, for which the formula gives 44,778 K.
    #[test]
    fn compositions_outside_the_range_have_none() {
        for outside in
            ["SiO2 60, CaO 40", "Na2O 1", "SiO2 60, Al2O3 1e-300", "SiO2 59, Al2O3 5, CaO 9, K2O 20"]
        {
            assert_eq!(watt(&oxides(outside)), None, "{outside}");
        }
    }

    #[test]
    fn the_range_ends_where_the_parabola_rises() {
        let with = |silica: f64, alumina: f64| {
            let rest = 100.0 - silica - alumina - 3.0;
            let shares = [("SiO2", silica), ("Al2O3", alumina), ("MgO", 3.0)];
            let flux = [("Fe2O3", 0.5 * rest), ("CaO", 0.5 * rest)];
            watt(&Composition::new(shares.into_iter().chain(flux)).unwrap()).is_some()
        };
        assert!(with(50.0, 20.0) && with(35.0, 30.0) && !with(53.0, 20.0) && !with(28.0, 28.0));
        // The rise above the minimum at 1470/720: 360 (2.57 - 2.0417)² = 100.5 K.
        assert_relative_eq!(360.0 * (LARGEST_OXIDE_RATIO - 1470.0 / 720.0_f64).powi(2), 100.5, epsilon = 0.1);
    }
}
