//! Viscosity of a molten coal ash slag after Watt and Fereday.
//!
//! ```text
//! log10(10 mu) = 1e7 m / (T_C - 150)² + c                      mu in Pa s, T_C in °C
//! m = 0.00835 SiO2 + 0.00601 Al2O3 - 0.109
//! c = 0.0415 SiO2 + 0.0192 Al2O3 + 0.0276 Fe2O3 + 0.0160 CaO - 3.92
//! ```
//!
//! with shares in wt%, scaled so that `SiO2 + Al2O3 + Fe2O3 + CaO + MgO = 100`. `Fe2O3` is the "equivalent" one:
//! all iron as ferric oxide, `Fe2O3 + 1.11 FeO`. Alkalis, titania and the rest do not enter.
//!
//! Source: J. D. Watt, F. Fereday, "The flow properties of slags formed from the ashes of British coals. Part 1:
//! Viscosity of homogeneous liquid slags in relation to slag composition", J. Inst. Fuel 42 (1969) 99–103.
//!
//! # Range and error
//! Fully liquid slag of British bituminous ash: 30–60 wt% SiO2, 15–35 Al2O3, 3–30 Fe2O3, 2–30 CaO, 1–10 MgO.
//! Against the 1161 measured points of `tests/data/slag_viscosity_measured.csv` the root mean square error in log10
//! is 0.39 (bias -0.32, half as thick as measured): most of those slags carry far more lime than coal ash does.
//! Above 50 wt% SiO2 it is 0.18 to 0.30. The law has a pole at 150 °C and is meaningless for a slag that cold.

use super::composition::{Composition, Oxide};
use super::{ViscosityLaw, for_each_temperature, limited_exponential};
use fearless_simd::Level;

/// Mass of ferric oxide that holds the iron of 1 kg of ferrous oxide [kg].
pub(super) const FERRIC_PER_FERROUS: f64 = 159.687 / (2.0 * 71.844);

/// Temperatures [K] for which the law counts as stated; assumed.
const WATT_TEMPERATURES: [f64; 2] = [1423.0, 1873.0];

/// Temperature at which the law has its pole [K].
const POLE: f64 = 150.0 + 273.15;

/// The law.
pub static WATT_FEREDAY: ViscosityLaw = ViscosityLaw {
    name: "watt-fereday",
    stated_for: "SiO2 30 to 60, Al2O3 15 to 35, Fe2O3 3 to 30, CaO 2 to 30 and MgO 1 to 10 wt% of the five, 1423 to \
        1873 K",
    coefficients: |composition| line(composition).ok_or("it has too little SiO2 and Al2O3"),
    viscosity,
    viscosities,
    range: |composition| FiveOxides::of(composition)?.is_like_british_ash().then_some(WATT_TEMPERATURES),
    // None of the measured slags lies in its range.
    error: None,
};

/// Shares [wt%] of the five oxides in Watt and Fereday's normalisation: they add up to 100, all iron as `Fe2O3`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FiveOxides {
    /// `SiO2`.
    pub silica: f64,
    /// `Al2O3`.
    pub alumina: f64,
    /// `Fe2O3 + 1.11 FeO`.
    pub iron: f64,
    /// `CaO`.
    pub lime: f64,
    /// `MgO`.
    pub magnesia: f64,
}

impl FiveOxides {
    /// The shares of a composition; `None` when it has none of the five oxides.
    pub fn of(composition: &Composition) -> Option<Self> {
        let share = |oxide| composition.weight_percent(oxide);
        let iron = share(Oxide::Fe2O3) + FERRIC_PER_FERROUS * share(Oxide::FeO);
        let [silica, alumina, lime, magnesia] =
            [Oxide::SiO2, Oxide::Al2O3, Oxide::CaO, Oxide::MgO].map(share);
        let total = silica + alumina + iron + lime + magnesia;
        let scale = 100.0 / total;
        (total > 0.0).then_some(Self {
            silica: scale * silica,
            alumina: scale * alumina,
            iron: scale * iron,
            lime: scale * lime,
            magnesia: scale * magnesia,
        })
    }

    /// Whether Watt and Fereday's slags of British bituminous ash were like this one.
    pub fn is_like_british_ash(&self) -> bool {
        (30.0..=60.0).contains(&self.silica)
            && (15.0..=35.0).contains(&self.alumina)
            && (3.0..=30.0).contains(&self.iron)
            && (2.0..=30.0).contains(&self.lime)
            && (1.0..=10.0).contains(&self.magnesia)
    }
}

/// `m` and `c` [both 1].
///
/// `None` when none of the five oxides is present, or when `m` is not positive for lack of silica
/// and alumina: the viscosity would not fall with temperature.
fn line(composition: &Composition) -> Option<[f64; 2]> {
    let of = FiveOxides::of(composition)?;
    let slope = 0.00835 * of.silica + 0.00601 * of.alumina - 0.109;
    let intercept = 0.0415 * of.silica + 0.0192 * of.alumina + 0.0276 * of.iron + 0.0160 * of.lime - 3.92;
    (slope > 0.0).then_some([slope, intercept])
}

/// Viscosity [Pa s] at a temperature [K].
#[inline(always)]
fn viscosity([slope, intercept]: [f64; 2], temperature: f64) -> f64 {
    use std::f64::consts::LN_10;
    // One kelvin above the pole the exponent is far beyond its ceiling already.
    let above = (temperature - POLE).max(1.0);
    let log10 = 1e7 * slope / (above * above) + intercept - 1.0;
    limited_exponential(LN_10 * log10)
}

/// [`viscosity`] at many temperatures [K].
fn viscosities(level: Level, coefficients: [f64; 2], temperatures: &[f64], out: &mut [f64]) {
    for_each_temperature(level, coefficients, temperatures, out, viscosity);
}

#[cfg(test)]
mod tests {
    use super::super::composition::oxides;
    use super::*;
    use approx::assert_relative_eq;

    /// m = 0.4175 + 0.1803 - 0.109 = 0.4888, c = 2.075 + 0.576 + 0.32 - 3.92 = -0.949;
    /// at 1350 °C log10(10 mu) = 4.888e6 / 1200² - 0.949 = 2.445444.
    #[test]
    fn three_oxides_by_hand() {
        let slag = oxides("SiO2 50, Al2O3 30, CaO 20");
        let [slope, intercept] = line(&slag).unwrap();
        assert_relative_eq!(slope, 0.4888, max_relative = 1e-13);
        assert_relative_eq!(intercept, -0.949, max_relative = 1e-13);
        let found = WATT_FEREDAY.at(&slag, 1350.0 + 273.15);
        assert_relative_eq!((10.0 * found).log10(), 2.445444444444444, max_relative = 1e-12);
    }

    #[test]
    fn iron_counts_as_ferric_and_the_rest_is_left_out() {
        let slag = oxides("SiO2 45, Al2O3 20, Fe2O3 8, FeO 5, CaO 10, MgO 3, Na2O 4, TiO2 5");
        assert_relative_eq!(WATT_FEREDAY.at(&slag, 1600.0), 17.648111303620798, max_relative = 1e-12);
    }

    #[test]
    fn compositions_without_a_slope_have_no_viscosity() {
        let alkali = oxides("Na2O 1, K2O 1");
        assert!(WATT_FEREDAY.at(&alkali, 1600.0).is_nan());
        let lime = oxides("CaO 95, SiO2 5");
        assert!(WATT_FEREDAY.at(&lime, 1600.0).is_nan());
    }
}
