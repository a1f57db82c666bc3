//! Viscosity of natural silicate melts, rich in alkali, after Giordano, Russell and Dingwell.
//!
//! ```text
//! log10 mu = -4.55 + B / (T - C)                                mu in Pa s, T in K
//! B = 159.56 (SiO2 + TiO2) - 173.34 Al2O3 + 72.13 (FeO + MnO + P2O5) + 75.69 MgO - 38.98 CaO - 84.08 Na2O
//!     - 2.43 (SiO2 + TiO2) FM - 0.91 (SiO2 + TiO2 + Al2O3 + P2O5) NK + 17.62 Al2O3 NK
//! C = 2.75 SiO2 + 15.72 (TiO2 + Al2O3) + 8.32 FM + 10.20 CaO - 12.29 NK + 0.30 (Al2O3 + FM + CaO - P2O5) NK
//! FM = FeO + MnO + MgO,   NK = Na2O + K2O
//! ```
//!
//! with shares in mol% of these oxides, all iron as `FeO`. The terms for water and fluorine are
//! left out: ash has neither.
//!
//! Source: D. Giordano, J. K. Russell, D. B. Dingwell, "Viscosity of magmatic liquids: a model",
//! Earth Planet. Sci. Lett. 271 (2008) 123–134 (not re-read); the coefficients as three open
//! programs have them, one of them after the authors' own.
//!
//! # Range and error
//! Fitted to melts of volcanic rocks between 1e-1 and 1e14 Pa s, for which the source states a root
//! mean square error of 0.40 in log10 (from memory). Used here without a flag within
//! [`OXIDE_RANGES`] (the ranges of the source's table, from memory), with at least [`LEAST_ALKALI`]
//! of `Na2O + K2O` (assumed) and between 1373 and 1980 K, where it was compared: 592 measured melts
//! in that range and thinner than 1e4 Pa s, of 21 references of the collection of Le Losq and
//! Ferraina (zenodo 13843250; not in this repository). Root mean square error in log10, all
//! references having the same weight: 0.45 (bias -0.15), for Urbain 0.53, for Kalmanovitch–Frank
//! 0.71 (bias -0.53). Some of the points are in the fit, and the collection is not clear about the
//! iron of many; on its 116 points with at most 1 wt% of iron the errors are 0.46, 0.58 and 0.79.
//!
//! **On slags with much lime and no alkali it is useless**: more than ten times too thin on most of
//! the references of `tests/data/slag_viscosity_measured.csv`, none of whose rows is in its range.
//! It is for ash of biomass and alkali-rich ash.

use super::composition::{Composition, Oxide};
use super::{ViscosityLaw, for_each_temperature, limited_exponential};
use fearless_simd::Level;

/// The law.
pub static GIORDANO_RUSSELL_DINGWELL: ViscosityLaw = ViscosityLaw {
    name: "giordano-russell-dingwell",
    stated_for: "SiO2 41 to 79, Al2O3 up to 23, iron as FeO up to 12, MgO up to 32, CaO up to 26, Na2O up to 11, K2O \
        up to 9, TiO2 up to 3 and Na2O + K2O at least 1 wt%, 1373 to 1980 K",
    coefficients: |composition| fulcher(composition).ok_or("its viscosity would not fall with temperature"),
    viscosity,
    viscosities,
    range: |composition| holds_for(composition).then_some([1373.0, 1980.0]),
    error: Some(0.45),
};

/// Shares [wt%] of the fitted melts, iron as `FeO`.
pub const OXIDE_RANGES: [(Oxide, f64, f64); 10] = [
    (Oxide::SiO2, 41.0, 79.0),
    (Oxide::TiO2, 0.0, 3.0),
    (Oxide::Al2O3, 0.0, 23.0),
    (Oxide::FeO, 0.0, 12.0),
    (Oxide::MnO, 0.0, 0.3),
    (Oxide::MgO, 0.0, 32.0),
    (Oxide::CaO, 0.0, 26.0),
    (Oxide::Na2O, 0.0, 11.0),
    (Oxide::K2O, 0.0, 9.0),
    (Oxide::P2O5, 0.0, 1.2),
];

/// Least `Na2O + K2O` [wt%]; assumed.
pub const LEAST_ALKALI: f64 = 1.0;

/// Mass of ferrous oxide that holds the iron of 1 kg of ferric oxide [kg].
const FERROUS_PER_FERRIC: f64 = 2.0 * 71.844 / 159.687;

/// `B` [K] and `C` [K]; `None` when none of the oxides is present or `B` is not positive.
fn fulcher(composition: &Composition) -> Option<[f64; 2]> {
    let moles = |oxide| composition.moles(oxide);
    let iron = moles(Oxide::FeO) + 2.0 * moles(Oxide::Fe2O3);
    let rest = OXIDE_RANGES.iter().map(|(oxide, ..)| *oxide).filter(|oxide| *oxide != Oxide::FeO);
    let total = iron + rest.map(moles).sum::<f64>();
    let share = |oxide| 100.0 * moles(oxide) / total;
    let (alumina, lime, phosphate) = (share(Oxide::Al2O3), share(Oxide::CaO), share(Oxide::P2O5));
    let (iron, manganese) = (100.0 * iron / total, share(Oxide::MnO));
    let silica_titania = share(Oxide::SiO2) + share(Oxide::TiO2);
    let alkali = share(Oxide::Na2O) + share(Oxide::K2O);
    let metals = iron + manganese + share(Oxide::MgO);
    let b = 159.56 * silica_titania - 173.34 * alumina
        + 72.13 * (iron + manganese + phosphate)
        + 75.69 * share(Oxide::MgO)
        - 38.98 * lime
        - 84.08 * share(Oxide::Na2O)
        - 2.43 * silica_titania * metals
        - 0.91 * (silica_titania + alumina + phosphate) * alkali
        + 17.62 * alumina * alkali;
    let c = 2.75 * share(Oxide::SiO2) + 15.72 * (share(Oxide::TiO2) + alumina) + 8.32 * metals + 10.20 * lime
        - 12.29 * alkali
        + 0.30 * (alumina + metals + lime - phosphate) * alkali;
    (total > 0.0 && b > 0.0).then_some([b, c])
}

/// Viscosity [Pa s] at a temperature [K].
#[inline(always)]
fn viscosity([b, c]: [f64; 2], temperature: f64) -> f64 {
    use std::f64::consts::LN_10;
    // One kelvin above the pole the exponent is far beyond its ceiling already.
    let above = (temperature - c).max(1.0);
    limited_exponential(LN_10 * (b / above - 4.55))
}

fn holds_for(composition: &Composition) -> bool {
    let iron = composition.weight_percent(Oxide::FeO)
        + FERROUS_PER_FERRIC * composition.weight_percent(Oxide::Fe2O3);
    let raw = |oxide| if oxide == Oxide::FeO { iron } else { composition.weight_percent(oxide) };
    let total: f64 = OXIDE_RANGES.iter().map(|(oxide, ..)| raw(*oxide)).sum();
    let share = |oxide| 100.0 * raw(oxide) / total;
    total > 0.0
        && OXIDE_RANGES.iter().all(|(oxide, low, high)| (*low..=*high).contains(&share(*oxide)))
        && share(Oxide::Na2O) + share(Oxide::K2O) >= LEAST_ALKALI
        && composition.weight_percent(Oxide::B2O3) == 0.0
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

    /// Molten albite, 75 SiO2, 12.5 Al2O3 and 12.5 mol% Na2O, by hand: B = 11967 - 2166.75 - 1051 -
    /// 995.3125 + 2753.125 = 10507.0625, C = 206.25 + 196.5 - 153.625 + 46.875 = 296; at 1496 K
    /// log10 mu = -4.55 + 10507.0625/1200.
    #[test]
    fn albite_by_hand() {
        let albite =
            Composition::new([("SiO2", 75.0 * 60.083), ("Al2O3", 12.5 * 101.961), ("Na2O", 12.5 * 61.979)])
                .unwrap();
        let [b, c] = fulcher(&albite).unwrap();
        assert_relative_eq!(b, 10507.0625, max_relative = 1e-12);
        assert_relative_eq!(c, 296.0, max_relative = 1e-12);
        let found = GIORDANO_RUSSELL_DINGWELL.at(&albite, 1496.0).log10();
        assert_relative_eq!(found, 4.205885416666667, max_relative = 1e-12);
    }

    /// Every oxide, 1 mol% of each but silica and alumina, by hand: FM = 3, NK = 2, SiO2 + TiO2 =
    /// 82, B = 13083.92 - 1906.74 + 216.39 + 75.69 - 38.98 - 84.08 - 597.78 - 0.91 94 2 + 17.62 11
    /// 2 = 10964.98, C = 222.75 + 188.64 + 24.96 + 10.2 - 24.58
    /// + 0.3 14 2 = 430.37.
    #[test]
    fn every_oxide_has_its_terms() {
        let one = |oxide: Oxide| (oxide.name(), oxide.molar_mass());
        let minor = [
            Oxide::TiO2,
            Oxide::FeO,
            Oxide::MnO,
            Oxide::MgO,
            Oxide::CaO,
            Oxide::Na2O,
            Oxide::K2O,
            Oxide::P2O5,
        ];
        let main = [("SiO2", 81.0 * 60.083e-3), ("Al2O3", 11.0 * 101.961e-3)];
        let melt = Composition::new(main.into_iter().chain(minor.map(one))).unwrap();
        let [b, c] = fulcher(&melt).unwrap();
        assert_relative_eq!(b, 10964.98, max_relative = 1e-10);
        assert_relative_eq!(c, 430.37, max_relative = 1e-10);
    }

    #[test]
    fn iron_counts_as_ferrous() {
        let ferrous = oxides("SiO2 60, Al2O3 15, Na2O 10, K2O 6, FeO 8.998102");
        let ferric = oxides("SiO2 60, Al2O3 15, Na2O 10, K2O 6, Fe2O3 10");
        let at = |slag| GIORDANO_RUSSELL_DINGWELL.at(slag, 1500.0);
        assert_relative_eq!(at(&ferrous), at(&ferric), max_relative = 1e-6);
        assert!(holds_for(&ferrous) && holds_for(&ferric));
    }

    #[test]
    fn the_range_needs_alkali_and_ends_at_the_fitted_melts() {
        assert!(holds_for(&oxides("SiO2 60, Al2O3 15, CaO 10, K2O 8")));
        assert!(!holds_for(&oxides("SiO2 60, Al2O3 15, CaO 10")));
        assert!(!holds_for(&oxides("SiO2 45, Al2O3 15, CaO 30, K2O 8")));
        assert!(!holds_for(&oxides("SiO2 60, Al2O3 15, K2O 8, B2O3 1")));
        assert!(!holds_for(&oxides("SO3 1")));
    }
}
