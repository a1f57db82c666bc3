//! Viscosity of a molten silicate slag after Urbain, with his constants and with those of Kalmanovitch and Frank.
//!
//! ```text
//! mu = A T exp(1000 B / T)                     mu in poise (0.1 Pa s), T in K (Weymann's form)
//! -ln A = slope B + intercept                  Urbain 1981: 0.2693, 11.6725
//!                                              Kalmanovitch and Frank 1988: 0.2812, 11.8279
//! B = B0 + B1 xg + B2 xg² + B3 xg³
//!   B0 =  13.8    +  39.9355 a -  44.049  a²
//!   B1 =  30.481  - 117.1505 a + 129.9978 a²
//!   B2 = -40.9429 + 234.0486 a - 300.04   a²
//!   B3 =  60.7619 - 153.9276 a + 211.1616 a²
//! a = xm / (xm + xa),   xg + xm + xa = 1
//! ```
//!
//! `xg`, `xm` and `xa` [1] are the mole fractions of glass formers, modifiers and amphoterics, see
//! [`Oxide::role`].
//!
//! Sources: G. Urbain, F. Cambier, M. Deletter, M. R. Anseau, "Viscosity of silicate melts", Trans. J. Br. Ceram.
//! Soc. 80 (1981) 139–141; D. P. Kalmanovitch, M. Frank, "An effective model of viscosity for ash deposition
//! phenomena", in Mineral Matter and Ash Deposition from Coal, Engineering Foundation (1988) 89–101.
//!
//! # Oxides on which the literature differs
//! - `FeO` and `MnO` are modifiers, `Fe2O3` is amphoteric; iron oxides are not converted. An ash analysis
//!   reports all iron as `Fe2O3`; in a reducing gasifier most of it is `FeO`, which makes the slag up to ten times
//!   thinner. Give iron as the oxide that it forms (1 wt% `Fe2O3` = 0.90 wt% `FeO`).
//! - A mole of `TiO2` counts as two of modifier (K. C. Mills in Slag Atlas, 2nd ed. 1995, and his "The estimation
//!   of slag properties", 2011). The measured table is 0.001 closer in log10 than if it counted once.
//! - `SO3` is ignored; it leaves before the ash melts.
//!
//! # Range and error
//! Fully liquid slag: below the liquidus crystals thicken it and both laws are too low. The ranges
//! of the fits were not re-read; both laws count as stated on the slags and temperatures of the
//! measured table ([`measured_range`]), where the errors below were found, and as outside their
//! range elsewhere. Against the 1161 measured points of `tests/data/slag_viscosity_measured.csv`
//! (1523–2456 K, 30–70 wt% SiO2, 8–40 wt% Al2O3) the root mean square error in log10 is 0.18 for
//! Kalmanovitch–Frank (bias +0.04) and 0.29 for Urbain (bias +0.24, that is 1.7 times too thick).
//! Kalmanovitch–Frank is too thick below 40 wt% SiO2 and too thin above 50. Only 44 of the points
//! carry iron; on them the errors are 0.30 and 0.42.

use super::composition::{Composition, Oxide, OxideRole};
use super::{ViscosityLaw, for_each_temperature, limited_exponential, measured_range};
use fearless_simd::Level;

/// Urbain, Cambier, Deletter and Anseau 1981.
pub static URBAIN: ViscosityLaw = ViscosityLaw {
    name: "urbain",
    stated_for: measured_range::IN_WORDS,
    coefficients: |composition| weymann(0.2693, 11.6725, composition),
    viscosity,
    viscosities,
    range: measured_range::temperatures,
    error: Some(0.29),
};

/// Kalmanovitch and Frank 1988, refitted to coal ash slags.
pub static KALMANOVITCH_FRANK: ViscosityLaw = ViscosityLaw {
    name: "kalmanovitch-frank",
    stated_for: measured_range::IN_WORDS,
    coefficients: |composition| weymann(0.2812, 11.8279, composition),
    viscosity,
    viscosities,
    range: measured_range::temperatures,
    error: Some(0.18),
};

/// Shares of the three groups of oxides [1]; they add up to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OxideGroups {
    /// Glass formers, `xg`.
    pub glass_former: f64,
    /// Modifiers, `xm`.
    pub modifier: f64,
    /// Amphoterics, `xa`.
    pub amphoteric: f64,
}

impl OxideGroups {
    /// The groups of a composition; `None` when it has nothing but volatiles.
    pub fn of(composition: &Composition) -> Option<Self> {
        let (mut former, mut modifier, mut amphoteric) = (0.0, 0.0, 0.0);
        for (oxide, _) in composition.oxides() {
            let moles = composition.moles(oxide);
            match oxide.role() {
                OxideRole::GlassFormer => former += moles,
                OxideRole::Modifier if oxide == Oxide::TiO2 => modifier += 2.0 * moles,
                OxideRole::Modifier => modifier += moles,
                OxideRole::Amphoteric => amphoteric += moles,
                OxideRole::Volatile => {}
            }
        }
        let total = former + modifier + amphoteric;
        (total > 0.0).then(|| Self {
            glass_former: former / total,
            modifier: modifier / total,
            amphoteric: amphoteric / total,
        })
    }

    /// Urbain's `B` [1000 K]; between 9.7 and 65 for every possible composition.
    ///
    /// Where nothing but glass former is left `a` is undefined; 0 is taken, and no other choice moves `B` by more
    /// than 1.2 %.
    pub fn activation(&self) -> f64 {
        let rest = self.modifier + self.amphoteric;
        let a = if rest > 0.0 { self.modifier / rest } else { 0.0 };
        let quadratic = |c0: f64, c1: f64, c2: f64| c0 + a * (c1 + a * c2);
        let b0 = quadratic(13.8, 39.9355, -44.049);
        let b1 = quadratic(30.481, -117.1505, 129.9978);
        let b2 = quadratic(-40.9429, 234.0486, -300.04);
        let b3 = quadratic(60.7619, -153.9276, 211.1616);
        let x = self.glass_former;
        b0 + x * (b1 + x * (b2 + x * b3))
    }
}

/// Coefficients of Weymann's form `mu = factor T exp(activation / T)`: `A` [Pa s/K] and `1000 B` [K].
///
/// `slope` and `intercept` give `-ln A = slope B + intercept`, with `A` in poise/K.
fn weymann(slope: f64, intercept: f64, composition: &Composition) -> Result<[f64; 2], &'static str> {
    const PASCAL_SECOND_PER_POISE: f64 = 0.1;
    let b = OxideGroups::of(composition).ok_or("it has no oxide that stays in the melt")?.activation();
    Ok([PASCAL_SECOND_PER_POISE * (-(slope * b + intercept)).exp(), 1000.0 * b])
}

/// Weymann's form: viscosity [Pa s] at a temperature [K] of 1 or more.
#[inline(always)]
pub(super) fn viscosity([factor, activation]: [f64; 2], temperature: f64) -> f64 {
    factor * temperature * limited_exponential(activation / temperature)
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

    fn simple() -> Composition {
        oxides("SiO2 50, Al2O3 25, CaO 15, FeO 10")
    }

    /// Worked by hand from the equations above.
    #[test]
    fn simple_slag_at_1700_kelvin() {
        let groups = OxideGroups::of(&simple()).unwrap();
        assert_relative_eq!(groups.glass_former, 0.560749331259536, max_relative = 1e-13);
        assert_relative_eq!(groups.modifier, 0.274033075395623, max_relative = 1e-13);
        assert_relative_eq!(groups.amphoteric, 0.16521759334484115, max_relative = 1e-13);
        assert_relative_eq!(groups.activation(), 30.64288116835506, max_relative = 1e-13);
        let urbain = URBAIN.at(&simple(), 1700.0);
        assert_relative_eq!(urbain, 25.44183216877954, max_relative = 1e-12);
        let kalmanovitch_frank = KALMANOVITCH_FRANK.at(&simple(), 1700.0);
        assert_relative_eq!(kalmanovitch_frank, 15.124931412384822, max_relative = 1e-12);
    }

    #[test]
    fn every_oxide_counts_in_its_group() {
        let slag = oxides(
            "SiO2 45, Al2O3 20, Fe2O3 8, FeO 5, CaO 10, MgO 3, Na2O 1, K2O 2, \
             TiO2 1.5, P2O5 0.5, MnO 0.5, B2O3 1, SO3 7",
        );
        let groups = OxideGroups::of(&slag).unwrap();
        assert_relative_eq!(groups.glass_former, 0.5308782787326313, max_relative = 1e-13);
        assert_relative_eq!(
            groups.modifier / (groups.modifier + groups.amphoteric),
            0.6080674231747297,
            max_relative = 1e-13
        );
        let found = KALMANOVITCH_FRANK.at(&slag, 1600.0);
        assert_relative_eq!(found, 32.323808090446065, max_relative = 1e-12);
    }

    #[test]
    fn silica_needs_no_modifier_share() {
        let b = |modifier: f64| OxideGroups { glass_former: 1.0, modifier, amphoteric: 0.0 }.activation();
        assert_relative_eq!(b(0.0), 64.1, max_relative = 1e-14);
        assert_relative_eq!(b(1e-300), 64.0764, max_relative = 1e-14);
        let silica = OxideGroups::of(&oxides("SiO2 100")).unwrap();
        assert_eq!(silica, OxideGroups { glass_former: 1.0, modifier: 0.0, amphoteric: 0.0 });
    }

    #[test]
    fn activation_is_positive_for_every_composition() {
        for i in 0..=100 {
            for j in 0..=100 {
                let (x, a) = (f64::from(i) / 100.0, f64::from(j) / 100.0);
                let groups = OxideGroups {
                    glass_former: x,
                    modifier: (1.0 - x) * a,
                    amphoteric: (1.0 - x) * (1.0 - a),
                };
                assert!((9.6..=65.0).contains(&groups.activation()), "xg {x}, a {a}");
            }
        }
    }

    #[test]
    fn ferrous_slag_is_thinner_than_ferric() {
        let with = |iron: &'static str, share: f64| {
            let oxides = [("SiO2", 45.0), ("Al2O3", 18.0), ("CaO", 7.0), (iron, share)];
            let slag = Composition::new(oxides).unwrap();
            KALMANOVITCH_FRANK.at(&slag, 1573.0)
        };
        let ratio = with("Fe2O3", 20.0) / with("FeO", 18.0);
        assert!((5.0..12.0).contains(&ratio), "{ratio}");
    }
}
