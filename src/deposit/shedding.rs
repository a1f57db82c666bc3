//! Shedding of a deposit by its weight and by the shear of the gas: stress against strength on its weakest plane.
//!
//! The mass outside of a plane, `M` per area, pulls on it with the tensile stress `sigma` and the shear stress `tau`:
//!
//! - `sigma = -M g cos(beta)` where positive (an overhang), else 0; `tau² = (M g sin(beta) + tau_d)² + tau_c²`
//! - utilisation `U = sqrt((sigma/S_t)² + (tau/S_s)²)`; the plane breaks at `U >= 1`
//! - strengths that scatter by a common log-normal factor of median 1 and geometric spread `s`: the
//!   share `Phi(ln U/ln s)` is shed
//!
//! `M` [kg/m²], `g` gravity [m/s²], `beta` angle of the wall from the horizontal (0 a floor that
//! bears the deposit, pi/2 a vertical wall, pi a ceiling), `tau_d` and `tau_c` shear of the gas
//! [Pa] down the slope and across, of magnitude `rho u*²`, `S_t` tensile and `S_s` shear strength
//! of the plane [Pa], `Phi` the standard normal distribution. Forces balance on a thin layer.
//! *Assumed*: the quadratic combination, as for adhesive joints; no friction under pressure; that
//! one factor scatters both strengths; that all outside of the broken plane falls at once; no
//! peeling from edges, thermal stress, sootblowing or momentum of particles.
//!
//! Why a share: "A simple model of the adhesive failure of a layer: cohesive effects" (abstract
//! read) computes that a thick, cohesive cake leaves as a whole at a threshold below its mean
//! strength, and a thin one in part, by the distribution of its adhesion. So `s = 1` is for thick
//! deposits, with a strength below the mean of measured ones.
//!
//! Sintering bonds grains to each other and to the wall. Necks carry by their cross-section, `(x/r)²` of
//! that of the grains, with `x/r` of the powder's shrinkage (`sintering.rs`): where `sintered_strength`
//! [Pa] is given, its `(x/r)²` is added to both strengths (*assumed*, as for sintered metals and
//! ceramics at small necks).
//!
//! No strength is built in. Measurements were found only in words: McCollor et al. (force to remove
//! coal ash deposits), "Adhesion strength of biomass ash deposits" (DTU 2016: shear strength on
//! superheater tubes depends on temperature, composition, time and steel) and Naganuma et al. 2013
//! (adhesion to alloys rises with time and alkali); the abstracts give no number. For scale: 10 mm
//! of a deposit of 1500 kg/m³ load a wall with 147 Pa, and gas of 1 kg/m³ at `u*` = 1 m/s with 1
//! Pa.
//!
//! Range: thickness small against the radius of the wall. No function fails; a strength of 0 breaks under any load.

use super::Deposit;
use super::process::{Process, ProcessInfo, Step, Surroundings, own_table};
use super::resuspension::normal_below;
use super::sintering;
use crate::input::{InputError, Section};

pub(super) const INFO: ProcessInfo = ProcessInfo {
    name: "shedding",
    loss: Some("shed"),
    gain: None,
    read: |wall| own_table(wall, "shedding", Strength::read),
};

/// Strength with which a deposit holds to a wall: a `shedding` table of the model file.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Strength {
    /// Tensile strength [Pa], median over the places of the wall.
    tensile: f64,
    /// Shear strength [Pa], likewise.
    shear: f64,
    /// Geometric spread from place to place, at least 1 [1].
    spread: f64,
    /// What sintered necks as wide as the grains add to both [Pa].
    sintered: f64,
}

impl Process for Strength {
    /// The whole deposit falls off a place, or nothing.
    fn after(&self, deposit: &Deposit, step: &Step<'_>) -> Deposit {
        let voidage = step.surroundings.voidage;
        let neck = sintering::neck_of_porosity(deposit.porosity(voidage), voidage);
        let broken = self.with_necks(neck).breaks(deposit.mass(), step.surroundings);
        if broken { Deposit::default() } else { *deposit }
    }

    fn describe(&self) -> String {
        let Self { tensile, shear, spread, sintered } = self;
        let necks =
            if *sintered > 0.0 { format!(", {sintered} Pa more by full necks") } else { String::new() };
        format!(", sheds deposits at {tensile} Pa of tension, {shear} Pa of shear, spread {spread}{necks}")
    }
}

impl Strength {
    /// The strength with necks of a ratio `x/r` [1], which carry by their cross-section.
    fn with_necks(self, neck: f64) -> Self {
        let more = self.sintered * neck * neck;
        Self { tensile: self.tensile + more, shear: self.shear + more, ..self }
    }

    /// Whether a deposit of a mass [kg/m²] falls off a place of the wall.
    fn breaks(&self, mass: f64, surroundings: &Surroundings) -> bool {
        mass > 0.0 && shed_share(self.utilisation(mass, surroundings), self.spread) > surroundings.draw
    }

    /// Utilisation `U` [1] of the median strength by a deposit of a mass [kg/m²].
    fn utilisation(&self, mass: f64, surroundings: &Surroundings) -> f64 {
        let [down, across] = surroundings.gas.shear;
        let tension = mass * surroundings.gravity_outward.max(0.0);
        let shear = (mass * surroundings.gravity_along + down).hypot(across);
        ratio(tension, self.tensile).hypot(ratio(shear, self.shear))
    }

    /// Reads the table.
    fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let strength = |key: &str| {
            let given = section.number_within(key, 0.0, f64::INFINITY)?;
            given.ok_or_else(|| section.missing(key, "[Pa]"))
        };
        let spread = section.number_within("spread", 1.0, 100.0)?.unwrap_or(1.0);
        let sintered = section.number_within("sintered_strength", 0.0, f64::INFINITY)?.unwrap_or(0.0);
        let [tensile, shear] = [strength("tensile_strength")?, strength("shear_strength")?];
        Ok(Self { tensile, shear, spread, sintered })
    }
}

/// Share of the wall [1] whose deposit is shed at a utilisation [1], with a geometric spread [1] of the
/// strength from place to place; a spread of 1 sheds all or nothing.
fn shed_share(utilisation: f64, spread: f64) -> f64 {
    if spread <= 1.0 {
        return f64::from(u8::from(utilisation >= 1.0));
    }
    normal_below(utilisation.ln() / spread.ln())
}

/// Stress over strength [1]; no stress uses nothing of a strength of 0.
fn ratio(stress: f64, strength: f64) -> f64 {
    if stress == 0.0 { 0.0 } else { stress / strength }
}

#[cfg(test)]
mod tests {
    use super::super::process::WallGas;
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::{FRAC_PI_2, PI};

    const G: f64 = 9.81;
    const CALM: [f64; 2] = [0.0, 0.0];
    const STRENGTH: Strength = Strength { tensile: 200.0, shear: 100.0, spread: 1.0, sintered: 0.0 };

    /// On a wall at an angle [rad] from the horizontal, from 0 (floor) to pi (ceiling).
    fn on_slope(angle: f64, shear: [f64; 2]) -> Surroundings {
        let (sine, cosine) = angle.sin_cos();
        let gas = WallGas { density: 1.0, kinematic_viscosity: 1e-5, shear };
        Surroundings { gas, gravity_outward: -G * cosine, gravity_along: G * sine, ..Default::default() }
    }

    /// Hanging weight per area over strength: on a ceiling all tension, on a vertical wall all
    /// shear, on a floor nothing.
    #[test]
    fn weight_alone_by_hand() {
        let used = |angle: f64| STRENGTH.utilisation(1500.0 * 0.01, &on_slope(angle, CALM));
        assert_relative_eq!(used(PI), 147.15 / 200.0, max_relative = 1e-12);
        assert_relative_eq!(used(FRAC_PI_2), 147.15 / 100.0, max_relative = 1e-12);
        assert_eq!(used(0.0), 0.0);
        // Halfway over: both components are 104.0507 Pa; 0.520254² + 1.040507² = 1.353320.
        assert_relative_eq!(used(0.75 * PI), 1.353_320_f64.sqrt(), max_relative = 1e-6);
    }

    /// Of many places with a spread of strengths, the share that theory states loses its deposit,
    /// and again the same ones.
    #[test]
    fn places_keep_their_strength() {
        let strength = Strength { spread: 2.0, ..STRENGTH };
        let at = |draw: f64| Surroundings { draw, ..on_slope(FRAC_PI_2, CALM) };
        let mass = 50.0 / G;
        let broken = (0..1000).filter(|place| strength.breaks(mass, &at((f64::from(*place) + 0.5) / 1000.0)));
        // Half of the median strength, a spread of 2: Phi(-1) = 0.1587.
        assert_eq!(broken.count(), 159);
        assert!(!STRENGTH.breaks(99.9 / G, &at(0.0)) && STRENGTH.breaks(100.1 / G, &at(0.999)));
        assert!(!STRENGTH.breaks(0.0, &at(0.0)));
    }

    /// Necks of a tenth of the grain carry 1 % of what full necks carry: 100 + 0.01 * 4000 = 140 Pa.
    #[test]
    fn sintered_necks_hold() {
        let sintered = Strength { sintered: 4000.0, ..STRENGTH }.with_necks(0.1);
        assert_relative_eq!(sintered.shear, 140.0);
        let wall = on_slope(FRAC_PI_2, CALM);
        assert!(STRENGTH.breaks(120.0 / G, &wall) && !sintered.breaks(120.0 / G, &wall));
        assert!(sintered.breaks(141.0 / G, &wall));
    }

    #[test]
    fn gas_shear_adds_as_a_vector() {
        let wall = |shear| STRENGTH.utilisation(3.0 / G, &on_slope(FRAC_PI_2, shear));
        assert_relative_eq!(wall([1.0, 3.0]), 0.05, max_relative = 1e-12);
        assert!(wall([-3.0, 0.0]) < 1e-12);
        // On a floor only the gas acts: 1 kg/m³ at u* = 10 m/s reaches 100 Pa.
        assert_relative_eq!(STRENGTH.utilisation(5.0, &on_slope(0.0, [0.0, 100.0])), 1.0);
        // Without strength any load breaks it, and none does not.
        let none = Strength { shear: 0.0, ..STRENGTH };
        assert!(none.breaks(1e-9, &on_slope(1.0, CALM)) && !none.breaks(1e9, &on_slope(0.0, CALM)));
    }

    #[test]
    fn shares_have_their_limits() {
        assert_eq!([shed_share(0.999, 1.0), shed_share(1.0, 1.0)], [0.0, 1.0]);
        assert_relative_eq!(shed_share(1.0, 2.0), 0.5);
        // One geometric deviation below and above: 15.8655 % and the rest.
        assert_relative_eq!(shed_share(0.5, 2.0), 0.158_655, max_relative = 1e-5);
        assert_relative_eq!(shed_share(2.0, 2.0), 0.841_345, max_relative = 1e-5);
        assert_eq!([shed_share(0.0, 2.0), shed_share(f64::INFINITY, 2.0)], [0.0, 1.0]);
    }
}
