//! Density of a silicate melt or glass from its composition: partial molar volumes of the oxides add.
//!
//! ```text
//! rho = M/V,  M = sum x_i M_i,  V = sum x_i (V_i + (T - T_i) dV_i/dT)
//! ```
//!
//! `x_i` mole fraction [1], `M_i` molar mass [kg/mol], `V_i` partial molar volume [m³/mol] at `T_i` [K].
//! Source: the set of Iacovino & Till, Volcanica 2 (2019) 1, which takes Lange 1997 (SiO2, Al2O3, MgO, CaO, Na2O,
//! K2O), Lange & Carmichael 1987 (TiO2), Guo et al. 2014 (FeO) and Liu & Lange 2006 (Fe2O3); the numbers as two
//! open programs print them (MagmaPandas, santex), without their change with pressure.
//!
//! A glass keeps the volume at which it froze: below [`FROZEN`] the volume of that temperature is taken
//! (*assumed*; the expansion of the glass itself, some 1 % between 300 and 1000 K, is left out). Measured glasses
//! of silica, albite, anorthite, diopside and of windows lie within 4 % (tests). Oxides without a volume (`P2O5`,
//! `MnO`, `B2O3`) count as the mean of the others, up to [`WITHOUT_VOLUME`] mol%; `SO3` leaves before the ash melts.

use super::composition::{Composition, Oxide};

/// Partial molar volume [m³/mol], its temperature [K] and its change [m³/(mol K)].
const VOLUMES: [(Oxide, f64, f64, f64); 9] = [
    (Oxide::SiO2, 26.86e-6, 1773.0, 0.0),
    (Oxide::TiO2, 28.32e-6, 1773.0, 7.24e-9),
    (Oxide::Al2O3, 37.42e-6, 1773.0, 2.62e-9),
    (Oxide::Fe2O3, 41.50e-6, 1723.0, 0.0),
    (Oxide::FeO, 12.68e-6, 1723.0, 3.69e-9),
    (Oxide::MgO, 12.02e-6, 1773.0, 3.27e-9),
    (Oxide::CaO, 16.90e-6, 1773.0, 3.74e-9),
    (Oxide::Na2O, 29.65e-6, 1773.0, 7.68e-9),
    (Oxide::K2O, 47.28e-6, 1773.0, 12.08e-9),
];

/// Temperature [K] at which the volume of a glass freezes, some 850 to 1100 K for silicates (assumed).
pub const FROZEN: f64 = 1000.0;

/// Most oxides without a partial molar volume [mol%] (assumed).
pub const WITHOUT_VOLUME: f64 = 15.0;

/// Density [kg/m³] at a temperature [K]; `None` for less than 30 mol% `SiO2` (no silicate) or too much of what
/// has no volume.
pub fn silicate_density(composition: &Composition, temperature: f64) -> Option<f64> {
    let temperature = temperature.max(FROZEN);
    let share = |oxide| composition.mole_fraction(oxide);
    let (mut known, mut mass, mut volume) = (0.0, 0.0, 0.0);
    for (oxide, at, from, slope) in VOLUMES {
        known += share(oxide);
        mass += share(oxide) * oxide.molar_mass();
        volume += share(oxide) * (at + (temperature - from) * slope);
    }
    let melt = 1.0 - share(Oxide::SO3);
    let fits = share(Oxide::SiO2) >= 0.3 * melt && known >= (1.0 - 0.01 * WITHOUT_VOLUME) * melt;
    (fits && melt > 0.0).then(|| mass / volume)
}

#[cfg(test)]
mod tests {
    use super::super::composition::oxides;
    use super::*;
    use approx::assert_relative_eq;

    /// Half a mole of each at 1773 K, by hand: (60.083 + 56.077)/(26.86 + 16.90) = 2.6545 g/cm³; at 1573 K the volume
    /// of CaO is 16.152.
    #[test]
    fn wollastonite_by_hand() {
        let melt = Composition::new([("SiO2", 60.083), ("CaO", 56.077)]).unwrap();
        assert_relative_eq!(silicate_density(&melt, 1773.0).unwrap(), 2654.5, max_relative = 1e-4);
        assert_relative_eq!(silicate_density(&melt, 1573.0).unwrap(), 116.16e3 / 43.012, max_relative = 1e-4);
        assert_eq!(silicate_density(&melt, 293.0), silicate_density(&melt, FROZEN));
    }

    /// Densities of glasses as commonly tabulated: silica 2200, albite 2370, anorthite 2700, diopside 2860,
    /// window glass 2490 kg/m³.
    #[test]
    fn near_measured_glasses() {
        for (name, glass, measured) in [
            ("silica", "SiO2 100", 2200.0),
            ("albite", "SiO2 68.7, Al2O3 19.4, Na2O 11.8", 2370.0),
            ("anorthite", "SiO2 43.2, Al2O3 36.6, CaO 20.2", 2700.0),
            ("diopside", "SiO2 55.5, CaO 25.9, MgO 18.6", 2860.0),
            ("window", "SiO2 72.5, Na2O 13.5, CaO 9, MgO 4, Al2O3 1", 2490.0),
        ] {
            let found = silicate_density(&oxides(glass), 293.15).unwrap();
            assert!((found / measured - 1.0).abs() < 0.04, "{name}: {found}");
        }
    }

    #[test]
    fn what_is_no_silicate_has_no_density() {
        assert_eq!(silicate_density(&oxides("SiO2 10, CaO 90"), 1600.0), None);
        assert_eq!(silicate_density(&oxides("SiO2 50, P2O5 50"), 1600.0), None);
        assert_eq!(silicate_density(&oxides("SO3 1"), 1600.0), None);
    }
}
