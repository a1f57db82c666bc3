//! Surface tension of a molten silicate slag from its composition, after Kucuk, Clare and Jones.
//!
//! ```text
//! sigma = 271.2 + 3.47 Al2O3 + 3.34 CaO + 1.96 MgO + 2.68 FeO + 2.92 MnO - 2.22 K2O - 2.86 B2O3        sigma in mN/m
//! ```
//!
//! with shares in mol% of what stays in the melt, at 1400 °C. `SiO2`, `Na2O` and, for lack of a
//! coefficient, `TiO2`, `P2O5` and `Fe2O3` have the value of the constant.
//!
//! Source: A. Kucuk, A. G. Clare, L. Jones, "An estimation of the surface tension of silicate glass
//! melts at 1400 °C using statistical analysis", Glass Technol. 40 (1999) 149–153; the coefficients
//! as glassproperties.com prints them.
//!
//! # Range and error
//! The source's data have errors of 1 to 5 %. Other data: four lavas from limburgite to andesite
//! 350 to 370 mN/m at 1200 to 1500 °C (Walker and Mullins 1981; the formula gives 363 to 403 for
//! rocks of these names), slags of black and brown coal in reducing gas 400 to 700 at 1 bar
//! (Melchior et al. 2009) and 270 to 490 at up to 10 bar (Melchior et al. 2011); the built-in
//! `coal-slag` gets 396. Mills' partial molar values (1600 °C) are 2 to 15 % higher. An error of 15
//! % is a fair estimate (assumed).
//!
//! The change with temperature is left out, because the sources disagree on its sign: -0.15 mN/(m K) in Mills' scheme,
//! small and positive for lavas and for most coal slags. 200 K change the value by less than 10 % either way. Below the
//! melting range of the ash the measured tension rises steeply; the formula does not know of it. Range: [`holds`].

use super::composition::{Composition, Oxide};

/// Surface tension at zero of every oxide that has a coefficient [N/m].
const CONSTANT: f64 = 0.2712;

/// Change with the share of an oxide [N/m per mol%].
const PER_MOLE_PERCENT: [(Oxide, f64); 7] = [
    (Oxide::Al2O3, 3.47e-3),
    (Oxide::CaO, 3.34e-3),
    (Oxide::MgO, 1.96e-3),
    (Oxide::FeO, 2.68e-3),
    (Oxide::MnO, 2.92e-3),
    (Oxide::K2O, -2.22e-3),
    (Oxide::B2O3, -2.86e-3),
];

/// Law and error of the estimate, in words.
pub const ORIGIN: &str =
    "estimated from the composition after Kucuk et al., src/slag/surface_tension.rs: within 15 % (assumed)";

/// Temperatures [K] at which the value is used without a flag: those of the measurements above.
pub const KUCUK_TEMPERATURES: [f64; 2] = [1473.15, 1823.15];

/// Surface tension [N/m]; `None` for a composition with nothing but volatiles.
///
/// ```
/// use nearwall::slag::{Composition, surface_tension};
///
/// let ash = [("SiO2", 45.0), ("Al2O3", 18.0), ("FeO", 18.0), ("CaO", 7.0), ("MgO", 1.0), ("K2O", 2.0)];
/// let found = surface_tension::kucuk(&Composition::new(ash)?).unwrap();
/// assert!((found - 0.398).abs() < 2e-3); // N/m
/// # Ok::<(), nearwall::slag::CompositionError>(())
/// ```
pub fn kucuk(composition: &Composition) -> Option<f64> {
    let melt = 1.0 - composition.mole_fraction(Oxide::SO3);
    let share = |oxide| 100.0 * composition.mole_fraction(oxide) / melt;
    let sum: f64 = PER_MOLE_PERCENT.iter().map(|(oxide, slope)| slope * share(*oxide)).sum();
    Some(CONSTANT + sum).filter(|sigma| melt > 0.0 && *sigma > 0.0)
}

/// Whether the formula is stated for a composition at a temperature [K]: a silicate (at least 30
/// mol% `SiO2`, assumed) with at most 10 mol% of the oxides that have no coefficient (`Na2O`
/// apart), within [`KUCUK_TEMPERATURES`].
pub fn holds(composition: &Composition, temperature: f64) -> bool {
    let share = |oxide| 100.0 * composition.mole_fraction(oxide);
    let without: f64 = [Oxide::TiO2, Oxide::P2O5, Oxide::Fe2O3].map(share).iter().sum();
    share(Oxide::SiO2) >= 30.0
        && without <= 10.0
        && (KUCUK_TEMPERATURES[0]..=KUCUK_TEMPERATURES[1]).contains(&temperature)
}

#[cfg(test)]
mod tests {
    use super::super::composition::oxides;
    use super::*;
    use approx::assert_relative_eq;

    /// By hand: wollastonite melt is half CaO by moles, 271.2 + 50 · 3.34 = 438.2 mN/m.
    #[test]
    fn wollastonite_by_hand() {
        let melt = Composition::new([("SiO2", 60.083), ("CaO", 56.077)]).unwrap();
        assert_relative_eq!(kucuk(&melt).unwrap(), 0.4382, max_relative = 1e-12);
        let sulphur = Composition::new([("SiO2", 60.083), ("CaO", 56.077), ("SO3", 30.0)]).unwrap();
        assert_relative_eq!(kucuk(&sulphur).unwrap(), 0.4382, max_relative = 1e-12);
        assert_eq!(kucuk(&oxides("SO3 1")), None);
    }

    /// One mole of each of nine: (271.2 + (3.47 + 3.34 + 1.96 + 2.68 + 2.92 - 2.22 - 2.86) · 100/9) mN/m.
    #[test]
    fn every_coefficient_by_hand() {
        use Oxide::{Al2O3, B2O3, CaO, FeO, K2O, MgO, MnO, Na2O, SiO2};
        let all = [SiO2, Na2O, Al2O3, CaO, MgO, FeO, MnO, K2O, B2O3];
        let melt = Composition::new(all.map(|oxide| (oxide.name(), oxide.molar_mass()))).unwrap();
        assert_relative_eq!(kucuk(&melt).unwrap(), 0.374422222222, max_relative = 1e-11);
    }

    /// Measured: an andesite and a basalt near 360 mN/m (Walker and Mullins, Contrib. Mineral.
    /// Petrol. 76 (1981) 455: 350 to 370 for limburgite to andesite), CaO–50 wt% Al2O3 624 mN/m at
    /// 1550 °C (Metals 15 (2025) 1252), though that melt is no silicate.
    #[test]
    fn near_measured_melts() {
        let andesite = oxides("SiO2 58, Al2O3 17.5, FeO 7, MgO 3.5, CaO 7, Na2O 3.5, K2O 1.6, TiO2 0.9");
        let basalt = oxides("SiO2 50, Al2O3 15, FeO 10, MgO 7.5, CaO 11, Na2O 2.8, K2O 0.5, TiO2 1.8");
        assert!((kucuk(&andesite).unwrap() - 0.36).abs() < 0.01);
        assert!((kucuk(&basalt).unwrap() - 0.36).abs() < 0.04);
        let aluminate = oxides("CaO 50, Al2O3 50");
        assert_relative_eq!(kucuk(&aluminate).unwrap(), 0.624, max_relative = 0.03);
        assert!(holds(&andesite, 1573.0) && !holds(&andesite, 1400.0) && !holds(&aluminate, 1573.0));
    }
}
