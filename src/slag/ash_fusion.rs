//! Fusion temperatures of an ash, estimated from its composition alone, with a 90 % band.
//!
//! ```text
//! T = c0 + c1 b + c2 b² + c3 b³ + c4 a         b = base/(base + acid)
//! base = Fe2O3 + CaO + MgO + Na2O + K2O        acid = SiO2 + Al2O3 + TiO2
//! ```
//!
//! `T` one of the four temperatures of a laboratory's sheet [K], each with coefficients of its own;
//! `a` share of `Al2O3` in the ash [1]; all shares by weight, all iron as `Fe2O3`, scaled so that the ten oxides of
//! [`LARGEST_SHARES`] add up to 1. Ashes melt lowest near `b` = 0.4, where acid and basic oxides form eutectics;
//! alumina raises all four. Where the equations cross, the flow temperature counts first: no other temperature is
//! above it, and the softening temperature lies between the neighbours.
//!
//! # Source, range and error
//! Least squares on the 308 ashes of `tests/data/ash_fusion_temperatures.csv` (coal, biomass and mixtures of them;
//! its header names the papers and the weaknesses of the collection). Ashes beyond [`LARGEST_SHARES`] or
//! [`BASE_SHARES`] are refused.
//!
//! The tests fit again with every group of papers left out in turn, the terms chosen anew each time. For ashes of
//! papers that the fit has not seen, the root mean square error is 136, 115, 90 and 80 K (deformation, softening,
//! hemisphere, flow); `ln(base/acid)` alone gives 283, 196, 200 and 178 K. The band holds 93, 93, 91 and 92 % of them.
//! Its half width is the 90 % quantile of the errors without each group, wider by Student's factor for the few groups.
//!
//! Not known: the atmosphere of each row (reducing gas lowers the temperatures of ash rich in iron), and how far values
//! of 1500 °C and above, the end of many furnaces, are too low.

use super::composition::{Composition, Oxide};
use super::watt_fereday::FERRIC_PER_FERROUS;

/// The four temperatures of a laboratory's sheet, in their order.
pub const NAMES: [&str; 4] = ["deformation", "softening", "hemisphere", "flow"];

/// Largest share of each oxide in the fitted ashes [wt%].
pub const LARGEST_SHARES: [(Oxide, f64); 10] = [
    (Oxide::SiO2, 94.5),
    (Oxide::Al2O3, 40.0),
    (Oxide::Fe2O3, 67.9),
    (Oxide::MgO, 38.3),
    (Oxide::CaO, 86.2),
    (Oxide::Na2O, 29.9),
    (Oxide::P2O5, 27.7),
    (Oxide::K2O, 66.8),
    (Oxide::TiO2, 22.0),
    (Oxide::SO3, 45.9),
];

/// Smallest and largest `base/(base + acid)` of the fitted ashes [1].
pub const BASE_SHARES: [f64; 2] = [0.016, 0.997];

/// Most of all other oxides together [wt%]; assumed, the fitted ashes list none.
pub const MOST_OTHER: f64 = 1.0;

const BASE: [Oxide; 5] = [Oxide::Fe2O3, Oxide::CaO, Oxide::MgO, Oxide::Na2O, Oxide::K2O];
const ACID: [Oxide; 3] = [Oxide::SiO2, Oxide::Al2O3, Oxide::TiO2];

/// Terms of the equation.
const TERMS: usize = 5;

/// The equation of one temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Fit {
    /// [K]
    coefficients: [f64; TERMS],
    /// Half width of the 90 % band [K].
    half_width: f64,
}

/// By temperature, as in [`NAMES`].
const FITS: [Fit; 4] = [
    Fit { coefficients: [1703.95, -2911.75, 5205.64, -2408.14, 828.26], half_width: 271.0 },
    Fit { coefficients: [1666.24, -2101.82, 3771.90, -1630.17, 791.15], half_width: 177.0 },
    Fit { coefficients: [1844.15, -2154.69, 3423.13, -1365.51, 322.61], half_width: 160.0 },
    Fit { coefficients: [1893.65, -2291.08, 3821.20, -1672.98, 233.59], half_width: 133.0 },
];

/// The fusion temperatures of an ash: as a laboratory gives them, or estimated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FusionTemperatures {
    /// The first rounding of the specimen [K].
    pub deformation: f64,
    /// As high as wide [K].
    pub softening: Option<f64>,
    /// Half as high as wide [K].
    pub hemisphere: Option<f64>,
    /// Spread to a flat layer [K].
    pub flow: f64,
    /// Half width of the 90 % band of each [K], as in [`NAMES`].
    pub half_widths: [f64; 4],
    /// Whether they are estimated from the composition.
    pub estimated: bool,
}

impl FusionTemperatures {
    /// The temperatures that are known [K], with names and half widths of their 90 % bands [K].
    pub fn known(&self) -> impl Iterator<Item = (&'static str, f64, f64)> {
        let all = [Some(self.deformation), self.softening, self.hemisphere, Some(self.flow)];
        let all = NAMES.into_iter().zip(all).zip(self.half_widths);
        all.filter_map(|((name, temperature), band)| Some((name, temperature?, band)))
    }

    /// All temperatures moved by a part of the half width of their bands; none above a later one.
    #[must_use]
    pub fn shifted(&self, part: f64) -> Self {
        let [deformation, softening, hemisphere, flow] = self.half_widths.map(|width| part * width);
        let flow = self.flow + flow;
        let hemisphere = self.hemisphere.map(|own| flow.min(own + hemisphere));
        let softening = self.softening.map(|own| hemisphere.unwrap_or(flow).min(own + softening));
        let deformation = softening.or(hemisphere).unwrap_or(flow).min(self.deformation + deformation);
        Self { deformation, softening, hemisphere, flow, ..*self }
    }

    /// All in one line: each with its 90 % band.
    pub fn describe(&self) -> String {
        let each: Vec<_> =
            self.known().map(|(name, t, band)| format!("{name} {t:.0} ± {band:.0} K")).collect();
        let origin = if self.estimated { "estimated from the composition" } else { "given" };
        format!("{} (90 % band, {origin})", each.join(", "))
    }
}

/// Why there is no estimate for a composition: a share [wt%] or ratio [1] that no fitted ash has.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "no fusion temperatures can be estimated: {quantity} is {}, and the fitted ashes have {low} to {high} (shares in \
        wt%)",
    (.value * 1e4).round() / 1e4
)]
pub struct OutsideAshes {
    /// The oxide, or what else is outside.
    pub quantity: &'static str,
    /// Its value.
    pub value: f64,
    /// The smallest of the ashes.
    pub low: f64,
    /// The largest of the ashes.
    pub high: f64,
}

/// Shares [1] of the ten oxides, all iron as `Fe2O3`, and of all others.
fn shares(composition: &Composition) -> ([f64; LARGEST_SHARES.len()], f64) {
    let ferrous = composition.weight_percent(Oxide::FeO);
    let own = LARGEST_SHARES.map(|(oxide, _)| {
        let more = if oxide == Oxide::Fe2O3 { FERRIC_PER_FERROUS * ferrous } else { 0.0 };
        composition.weight_percent(oxide) + more
    });
    let ten: f64 = own.iter().sum();
    let listed = LARGEST_SHARES.iter().map(|(oxide, _)| composition.weight_percent(*oxide)).sum::<f64>();
    (own.map(|share| share / ten), 0.01 * (100.0 - listed - ferrous))
}

/// `base/(base + acid)` [1] and the share of `Al2O3` [1] among the ten oxides.
fn base_and_alumina(shares: &[f64; LARGEST_SHARES.len()]) -> [f64; 2] {
    let sum = |group: &[Oxide]| -> f64 {
        let pairs = LARGEST_SHARES.iter().zip(shares);
        pairs.filter(|((oxide, _), _)| group.contains(oxide)).map(|(_, share)| share).sum()
    };
    let base = sum(&BASE);
    [base / (base + sum(&ACID)), sum(&[Oxide::Al2O3])]
}

fn terms([base, alumina]: [f64; 2]) -> [f64; TERMS] {
    [1.0, base, base * base, base * base * base, alumina]
}

/// Deformation, softening, hemisphere and flow [K] in their order, from the value of each equation.
fn ordered([deformation, softening, hemisphere, flow]: [f64; 4]) -> [f64; 4] {
    let hemisphere = hemisphere.min(flow);
    let deformation = deformation.min(hemisphere);
    [deformation, softening.max(deformation).min(hemisphere), hemisphere, flow]
}

/// The first share that no fitted ash has.
fn outside(composition: &Composition) -> Option<OutsideAshes> {
    let (shares, others) = shares(composition);
    let [base, _] = base_and_alumina(&shares);
    let oxides = LARGEST_SHARES.iter().zip(shares).map(|((oxide, high), share)| OutsideAshes {
        quantity: oxide.name(),
        value: 100.0 * share,
        low: 0.0,
        high: *high,
    });
    let [low, high] = BASE_SHARES;
    let more = [
        OutsideAshes { quantity: "base/(base + acid)", value: base, low, high },
        OutsideAshes { quantity: "MnO + B2O3", value: 100.0 * others, low: 0.0, high: MOST_OTHER },
    ];
    // A ratio of nothing to nothing is outside too.
    let rounding = 1e-9;
    let inside = |of: &OutsideAshes| (of.low - rounding..=of.high + rounding).contains(&of.value);
    oxides.chain(more).find(|quantity| !inside(quantity))
}

/// The fusion temperatures of an ash, estimated from its composition.
///
/// ```
/// use nearwall::slag::{Composition, ash_fusion};
///
/// let ash = [("SiO2", 50.0), ("Al2O3", 25.0), ("Fe2O3", 10.0), ("CaO", 13.0), ("MgO", 2.0)];
/// let found = ash_fusion::estimate(&Composition::new(ash)?)?;
/// // b = a = 0.25: 1893.65 - 572.77 + 238.83 - 26.14 + 58.40 K
/// assert!((found.flow - 1591.97).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`OutsideAshes`] for a composition unlike those of the fitted ashes.
pub fn estimate(composition: &Composition) -> Result<FusionTemperatures, OutsideAshes> {
    if let Some(beyond) = outside(composition) {
        return Err(beyond);
    }
    let terms = terms(base_and_alumina(&shares(composition).0));
    let value = |fit: Fit| fit.coefficients.iter().zip(terms).map(|(c, term)| c * term).sum();
    let [deformation, softening, hemisphere, flow] = ordered(FITS.map(value));
    Ok(FusionTemperatures {
        deformation,
        softening: Some(softening),
        hemisphere: Some(hemisphere),
        flow,
        half_widths: FITS.map(|fit| fit.half_width),
        estimated: true,
    })
}
