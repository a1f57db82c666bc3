//! Compositions and temperatures of the measured slags on which the errors of Urbain's and of
//! Kalmanovitch and Frank's law are stated: `tests/data/slag_viscosity_measured.csv`.
//!
//! The ranges that the two sources give for their fits were not re-read; the range here is where
//! the stated error was found. Most of the slags are from blast furnaces. No slag has `Na2O` or
//! `P2O5`; up to [`MOST_OTHER`] of them is allowed (assumed).

use super::composition::{Composition, Oxide};

/// The range in words.
pub const IN_WORDS: &str = "SiO2 30 to 70, Al2O3 9 to 40, CaO up to 50, MgO up to 38, iron oxides up to 22, K2O up to \
    6.6, TiO2 up to 2.3 and all else together up to 1 wt%, 1523 to 2456 K";

/// Temperatures of the measurements [K].
pub const MEASURED_TEMPERATURES: [f64; 2] = [1523.0, 2456.5];

/// Shares [wt%] of the measured slags.
pub const MEASURED_OXIDES: [(Oxide, f64, f64); 6] = [
    (Oxide::SiO2, 30.0, 70.0),
    (Oxide::Al2O3, 8.9, 40.0),
    (Oxide::CaO, 0.0, 50.1),
    (Oxide::MgO, 0.0, 38.5),
    (Oxide::K2O, 0.0, 6.6),
    (Oxide::TiO2, 0.0, 2.3),
];

/// Most iron oxides together [wt%].
pub const MOST_IRON: f64 = 22.1;

/// Most of every other oxide together [wt%]; assumed, 0.6 (`MnO`) was measured.
pub const MOST_OTHER: f64 = 1.0;

/// Temperatures [K] at which slags like this one were measured; `None` where none were. Shares are
/// those in what stays in the melt, without `SO3`.
pub fn temperatures(composition: &Composition) -> Option<[f64; 2]> {
    let melt = 100.0 - composition.weight_percent(Oxide::SO3);
    if melt <= 0.0 {
        return None;
    }
    let share = |oxide| 100.0 * composition.weight_percent(oxide) / melt;
    let iron = share(Oxide::FeO) + share(Oxide::Fe2O3);
    let listed: f64 = MEASURED_OXIDES.iter().map(|(oxide, ..)| share(*oxide)).sum();
    let within = MEASURED_OXIDES.iter().all(|(oxide, low, high)| (*low..=*high).contains(&share(*oxide)))
        && iron <= MOST_IRON
        && 100.0 - listed - iron <= MOST_OTHER;
    within.then_some(MEASURED_TEMPERATURES)
}

#[cfg(test)]
mod tests {
    use super::super::composition::oxides;
    use super::*;

    fn slag(silica: f64, lime: f64) -> Composition {
        Composition::new([("SiO2", silica), ("Al2O3", 20.0), ("CaO", lime)]).unwrap()
    }

    #[test]
    fn the_range_ends_with_the_measured_slags() {
        assert_eq!(temperatures(&slag(50.0, 30.0)), Some([1523.0, 2456.5]));
        assert!(temperatures(&slag(71.0, 9.0)).is_none() && temperatures(&slag(29.0, 51.0)).is_none());
        let with = |oxide: &'static str, share: f64| {
            let oxides = [("SiO2", 65.0 - share), ("Al2O3", 25.0), ("CaO", 10.0), (oxide, share)];
            temperatures(&Composition::new(oxides).unwrap()).is_some()
        };
        assert!(with("FeO", 22.0) && !with("FeO", 23.0) && !with("Fe2O3", 23.0));
        assert!(with("Na2O", 0.9) && !with("Na2O", 1.5) && !with("P2O5", 1.5));
        assert!(with("K2O", 6.5) && !with("K2O", 7.0));
    }

    #[test]
    fn sulphur_counts_nowhere() {
        assert!(temperatures(&oxides("SiO2 50, Al2O3 20, CaO 30, SO3 7")).is_some());
        assert!(temperatures(&oxides("SO3 1")).is_none());
    }
}
