//! Shedding of a deposit by its weight and by the shear of the gas: stress against strength on its weakest plane.
//!
//! The mass outside of a plane, `M` per area, pulls on it with the tensile stress `sigma` and the shear stress `tau`:
//!
//! - `sigma = -M g cos(beta)` where positive (an overhang), else 0; `tau² = (M g sin(beta) + tau_d)² + tau_c²`
//! - utilisation `U = sqrt((sigma/S_t)² + (tau/S_s)²)`; the plane breaks at `U >= 1`
//! - strengths that scatter by a common log-normal factor of median 1 and geometric spread `s`: the share `Phi(ln U/ln s)` is shed
//!
//! `M` [kg/m²], `g` gravity [m/s²], `beta` angle of the wall from the horizontal (0 a floor that bears the deposit, pi/2 a vertical
//! wall, pi a ceiling), `tau_d` and `tau_c` shear of the gas [Pa] down the slope and across, of magnitude `rho u*²`, `S_t` tensile
//! and `S_s` shear strength of the plane [Pa], `Phi` the standard normal distribution. Forces balance on a thin layer. *Assumed*: the
//! quadratic combination, as for adhesive joints; no friction under pressure; that one factor scatters both strengths; that all
//! outside of the broken plane falls at once; no peeling from edges, thermal stress, sootblowing or momentum of particles.
//!
//! Why a share: "A simple model of the adhesive failure of a layer: cohesive effects" (abstract read) computes that a thick, cohesive
//! cake leaves as a whole at a threshold below its mean strength, and a thin one in part, by the distribution of its adhesion. So
//! `s = 1` is for thick deposits, with a strength below the mean of measured ones.
//!
//! No strength is built in. Measurements were found only in words: McCollor et al. (force to remove coal ash deposits), "Adhesion
//! strength of biomass ash deposits" (DTU 2016: shear strength on superheater tubes depends on temperature, composition, time and
//! steel) and Naganuma et al. 2013 (adhesion to alloys rises with time and alkali); the abstracts give no number. For scale: 10 mm of
//! a deposit of 1500 kg/m³ load a wall with 147 Pa, and gas of 1 kg/m³ at `u*` = 1 m/s with 1 Pa.
//!
//! Range: thickness small against the radius of the wall. No function fails; a strength of 0 breaks under any load.

use super::resuspension::normal_below;
use crate::input::{InputError, Section};

/// Plane within a deposit, or between it and the wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Mass of the deposit outside of it [kg/m²].
    pub outside: f64,
    /// Tensile strength [Pa].
    pub tensile_strength: f64,
    /// Shear strength [Pa].
    pub shear_strength: f64,
}

/// Strength with which a deposit holds to a wall: a `shedding` table of the model file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    /// Tensile strength [Pa], median over the places of the wall.
    pub tensile: f64,
    /// Shear strength [Pa], likewise.
    pub shear: f64,
    /// Geometric spread from place to place, at least 1 [1].
    pub spread: f64,
}

impl Strength {
    /// Whether a deposit of a mass [kg/m²] falls off the wall at a place, which `draw` [1] between 0 and 1 ranks from the weakest to the
    /// strongest. A place keeps its draw, so that the result does not depend on the length of time steps.
    pub fn breaks(&self, mass: f64, load: &Load, draw: f64) -> bool {
        let plane = Plane { outside: mass, tensile_strength: self.tensile, shear_strength: self.shear };
        mass > 0.0 && shed_share(load.utilisation(&plane), self.spread) > draw
    }

    /// Reads the table.
    ///
    /// # Errors
    /// [`InputError::Fault`] for a number that is missing or has no meaning.
    pub(crate) fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let strength = |key: &str| {
            let given = section.number_within(key, 0.0, f64::INFINITY)?;
            given.ok_or_else(|| section.missing(key, "[Pa]"))
        };
        let spread = section.number_within("spread", 1.0, 100.0)?.unwrap_or(1.0);
        Ok(Self { tensile: strength("tensile_strength")?, shear: strength("shear_strength")?, spread })
    }
}

/// Gravity and gas shear on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// Gravity outward from the wall [m/s²], negative where it presses the deposit on.
    pub gravity_outward: f64,
    /// Gravity along the wall [m/s²], not negative.
    pub gravity_along: f64,
    /// Shear stress of the gas [Pa] down the slope and across it.
    pub gas_shear: [f64; 2],
}

impl Load {
    /// Load on a wall at an angle [rad] from the horizontal, from 0 (floor) to pi (ceiling), with gravity [m/s²].
    pub fn on_slope(angle: f64, gravity: f64, gas_shear: [f64; 2]) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Self { gravity_outward: -gravity * cosine, gravity_along: gravity * sine, gas_shear }
    }

    /// Utilisation `U` [1] of a plane: it breaks at 1.
    pub fn utilisation(&self, plane: &Plane) -> f64 {
        let [down, across] = self.gas_shear;
        let tension = plane.outside * self.gravity_outward.max(0.0);
        let shear = (plane.outside * self.gravity_along + down).hypot(across);
        ratio(tension, plane.tensile_strength).hypot(ratio(shear, plane.shear_strength))
    }

    /// Index and utilisation of the plane with the greatest one; the outer one of equals, planes given from the wall outward.
    /// `None` without planes.
    pub fn weakest(&self, planes: &[Plane]) -> Option<(usize, f64)> {
        let used = planes.iter().map(|plane| self.utilisation(plane)).enumerate();
        used.max_by(|(_, one), (_, other)| one.total_cmp(other))
    }

    /// Mass outside [kg/m²] at which a plane of these strengths breaks: 0 where the gas alone does it, infinite where weight cannot.
    /// Solves `U = 1`, quadratic in the mass.
    pub fn critical_mass(&self, tensile_strength: f64, shear_strength: f64) -> f64 {
        let [down, across] = self.gas_shear.map(|shear| ratio(shear, shear_strength));
        let along = ratio(self.gravity_along, shear_strength);
        let outward = ratio(self.gravity_outward.max(0.0), tensile_strength);
        let squares = outward * outward + along * along;
        let (half, left) = (along * down, 1.0 - down * down - across * across);
        if left <= 0.0 {
            0.0
        } else if squares == 0.0 {
            f64::INFINITY
        } else if squares.is_infinite() {
            0.0
        } else if half > 0.0 {
            // The same root without a difference of nearly equal numbers.
            left / (half + (half * half + squares * left).sqrt())
        } else {
            ((half * half + squares * left).sqrt() - half) / squares
        }
    }
}

/// Share of the wall [1] whose deposit is shed at a utilisation [1], with a geometric spread [1] of the strength from place to place;
/// a spread of 1 sheds all or nothing.
pub fn shed_share(utilisation: f64, spread: f64) -> f64 {
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
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::{FRAC_PI_2, PI};

    const G: f64 = 9.81;
    const CALM: [f64; 2] = [0.0, 0.0];

    fn plane(outside: f64) -> Plane {
        Plane { outside, tensile_strength: 200.0, shear_strength: 100.0 }
    }

    /// Hanging weight per area over strength: on a ceiling all tension, on a vertical wall all shear, on a floor nothing.
    #[test]
    fn weight_alone_by_hand() {
        let layer = plane(1500.0 * 0.01);
        let used = |angle: f64| Load::on_slope(angle, G, CALM).utilisation(&layer);
        assert_relative_eq!(used(PI), 147.15 / 200.0, max_relative = 1e-12);
        assert_relative_eq!(used(FRAC_PI_2), 147.15 / 100.0, max_relative = 1e-12);
        assert_eq!(used(0.0), 0.0);
        // Halfway over: both components are 104.0507 Pa; 0.520254² + 1.040507² = 1.353320.
        assert_relative_eq!(used(0.75 * PI), 1.353_320_f64.sqrt(), max_relative = 1e-6);
    }

    /// Of many places with a spread of strengths, the share that theory states loses its deposit, and again the same ones.
    #[test]
    fn places_keep_their_strength() {
        let strength = Strength { tensile: 200.0, shear: 100.0, spread: 2.0 };
        let load = Load::on_slope(FRAC_PI_2, G, CALM);
        let mass = 50.0 / G;
        let broken =
            (0..1000).filter(|place| strength.breaks(mass, &load, (f64::from(*place) + 0.5) / 1000.0));
        // Half of the median strength, a spread of 2: Phi(-1) = 0.1587.
        assert_eq!(broken.count(), 159);
        let even = Strength { spread: 1.0, ..strength };
        assert!(!even.breaks(99.9 / G, &load, 0.0) && even.breaks(100.1 / G, &load, 0.999));
        assert!(!even.breaks(0.0, &load, 0.0));
    }

    #[test]
    fn gas_shear_adds_as_a_vector() {
        let wall = |shear| Load::on_slope(FRAC_PI_2, G, shear).utilisation(&plane(3.0 / G));
        assert_relative_eq!(wall([1.0, 3.0]), 0.05, max_relative = 1e-12);
        assert!(wall([-3.0, 0.0]) < 1e-12);
        // On a floor only the gas acts: 1 kg/m³ at u* = 10 m/s reaches 100 Pa.
        assert_relative_eq!(Load::on_slope(0.0, G, [0.0, 100.0]).utilisation(&plane(5.0)), 1.0);
    }

    #[test]
    fn the_critical_mass_just_breaks() {
        for angle in [0.1, 1.0, FRAC_PI_2, 2.0, 3.0, PI] {
            for shear in [CALM, [30.0, 0.0], [-60.0, 20.0], [99.0, 10.0]] {
                let load = Load::on_slope(angle, G, shear);
                let mass = load.critical_mass(200.0, 100.0);
                assert!(mass.is_finite() && mass > 0.0);
                assert_relative_eq!(load.utilisation(&plane(mass)), 1.0, max_relative = 1e-9);
            }
        }
        assert_eq!(Load::on_slope(1.0, G, [80.0, 80.0]).critical_mass(200.0, 100.0), 0.0);
        assert_eq!(Load::on_slope(0.0, G, [10.0, 0.0]).critical_mass(200.0, 100.0), f64::INFINITY);
        assert_eq!(Load::on_slope(1.0, G, CALM).critical_mass(200.0, 0.0), 0.0);
    }

    /// A sintered layer on a powder on the wall: the most loaded plane is not the one that breaks.
    #[test]
    fn the_weakest_plane_breaks() {
        let wall = Plane { outside: 12.0, tensile_strength: 1e4, shear_strength: 1e4 };
        let powder = Plane { outside: 10.0, tensile_strength: 50.0, shear_strength: 50.0 };
        let load = Load::on_slope(FRAC_PI_2, G, CALM);
        let (index, used) = load.weakest(&[wall, powder]).unwrap();
        assert_eq!(index, 1);
        assert_relative_eq!(used, 98.1 / 50.0, max_relative = 1e-12);
        assert!(load.weakest(&[]).is_none());
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
