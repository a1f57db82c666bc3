//! Flow along a straight duct: between two planes, in a rectangular or in a round duct.
//!
//! `flow = "laminar"`: `u = (3/2) U (1 - (z/h)²)` between planes at `z = ±h`, `u = 2 U (1 - r²/R²)` in a round duct,
//! `U` the mean speed [m/s]. `flow = "turbulent"`: Reichardt's (1951) law of a smooth wall at the distance `y` from the
//! nearest wall, `y+ = y u_tau/nu`,
//!
//! `u/u_tau = c (2.5 ln(1 + 0.4 y+) + 7.8 (1 - exp(-y+/11) - (y+/11) exp(-y+/3)))`,
//!
//! with `c` such that the mean is `U` (0.9 to 1.1). The friction velocity `u_tau`, where it is not given, follows from
//! Prandtl's law of smooth pipes with the hydraulic diameter `D`: `u_tau = U sqrt(f/8)`, `1/sqrt(f) = 2 log10(Re
//! sqrt(f)) - 0.8`, `Re = U D/nu` above some 4000. Fully developed; corners have no secondary flow. (Both laws from
//! memory, not re-read.)

use nalgebra::Vector3;

use super::VelocityField;
use crate::simulate::geometry::{direction, required_within, vector};
use nearwall::input::{InputError, Section};

/// Places over half a cross-section at which the mean of a profile is taken.
const MEAN_POINTS: u32 = 2000;
/// Reynolds numbers [1] up to which turbulence dies out in ducts, and from which a laminar flow needs a smooth inlet
/// and quiet gas.
const TRANSITION: [f64; 2] = [2000.0, 4000.0];

/// Flow along a duct.
#[derive(Debug)]
pub struct Duct {
    centre: Vector3<f64>,
    along: Vector3<f64>,
    section: CrossSection,
    flow: Flow,
    /// Reynolds number with the hydraulic diameter [1].
    reynolds: f64,
}

/// The form of a duct.
#[derive(Debug, Clone, Copy)]
enum CrossSection {
    /// Half the height [m] along `up`; half the width [m] across, if it has side walls.
    Flat { up: Vector3<f64>, half_height: f64, half_width: Option<f64> },
    /// Radius [m].
    Round(f64),
}

#[derive(Debug, Clone, Copy)]
enum Flow {
    /// Mean speed [m/s].
    Laminar(f64),
    /// Friction velocity [m/s], over the kinematic viscosity [1/m], and `c`.
    Turbulent { friction_velocity: f64, per_length: f64, scale: f64 },
}

impl Duct {
    /// Reads `direction`, `centre` [m], `height`, `width` or `diameter` [m], `up`, `speed` [m/s], `flow` and
    /// `friction_velocity` [m/s]; `viscosity` is the kinematic one of the gas [m²/s].
    ///
    /// # Errors
    /// [`InputError::Fault`] when one is missing or out of bounds.
    pub fn read(section: &Section<'_>, viscosity: f64) -> Result<Self, InputError> {
        let along = direction(section, "direction")?;
        let cross_section = CrossSection::read(section, &along)?;
        let speed = required_within(section, "speed", f64::MIN_POSITIVE, f64::INFINITY)?;
        let flow = match section.choice("flow", &["laminar", "turbulent"])?.as_deref() {
            Some("laminar") if matches!(cross_section, CrossSection::Flat { half_width: Some(_), .. }) => {
                return Err(section.fault("flow", "is turbulent in a duct with a width"));
            }
            Some("laminar") => Flow::Laminar(speed),
            Some(_) => {
                let given = section.number_within("friction_velocity", f64::MIN_POSITIVE, f64::INFINITY)?;
                let smooth =
                    || smooth_friction_velocity(speed, cross_section.hydraulic_diameter(), viscosity);
                let friction_velocity = given.unwrap_or_else(smooth);
                let per_length = friction_velocity / viscosity;
                let mean = friction_velocity * cross_section.mean(|y| reichardt(y * per_length));
                Flow::Turbulent { friction_velocity, per_length, scale: speed / mean }
            }
            None => return Err(section.missing("flow", "\"laminar\" or \"turbulent\"")),
        };
        let centre = vector(section, "centre")?.unwrap_or_default();
        let reynolds = speed * cross_section.hydraulic_diameter() / viscosity;
        Ok(Self { centre, along, section: cross_section, flow, reynolds })
    }
}

impl CrossSection {
    fn read(section: &Section<'_>, along: &Vector3<f64>) -> Result<Self, InputError> {
        let positive = |key: &str| section.number_within(key, f64::MIN_POSITIVE, f64::INFINITY);
        match (positive("diameter")?, positive("height")?) {
            (Some(diameter), None) => Ok(Self::Round(0.5 * diameter)),
            (None, Some(height)) => {
                let up = direction(section, "up")?;
                if up.dot(along).abs() > 1e-6 {
                    return Err(section.fault("up", "has to be at right angles to `direction`"));
                }
                let half_width = positive("width")?.map(|width| 0.5 * width);
                Ok(Self::Flat { up, half_height: 0.5 * height, half_width })
            }
            (Some(_), Some(_)) => Err(section.fault("diameter", "has no `height`; remove one of them")),
            (None, None) => Err(section.missing("height", "the height [m], or a diameter [m],")),
        }
    }

    /// Distance [m] of a place off the middle [m] from the nearest wall; negative behind it.
    fn distance(&self, offset: &Vector3<f64>, along: &Vector3<f64>) -> f64 {
        let across = offset - along * along.dot(offset);
        match self {
            Self::Round(radius) => radius - across.norm(),
            Self::Flat { up, half_height, half_width } => {
                let height = up.dot(&across);
                let from_sides = half_width.map(|half| half - (across - up * height).norm());
                (half_height - height.abs()).min(from_sides.unwrap_or(f64::INFINITY))
            }
        }
    }

    /// Largest distance from a wall [m].
    fn half(&self) -> f64 {
        match *self {
            Self::Round(radius) => radius,
            Self::Flat { half_height, half_width, .. } => {
                half_width.map_or(half_height, |half| half.min(half_height))
            }
        }
    }

    /// Four times the area over the perimeter [m].
    fn hydraulic_diameter(&self) -> f64 {
        match *self {
            Self::Round(radius) => 2.0 * radius,
            Self::Flat { half_height, half_width: None, .. } => 4.0 * half_height,
            Self::Flat { half_height, half_width: Some(half), .. } => {
                4.0 * half_height * half / (half_height + half)
            }
        }
    }

    /// Mean over the area of a function of the distance from the nearest wall [m].
    fn mean(&self, value: impl Fn(f64) -> f64) -> f64 {
        // Length of the line at a distance from the walls, over any factor.
        let length = |y: f64| match *self {
            Self::Round(radius) => radius - y,
            Self::Flat { half_width: None, .. } => 1.0,
            Self::Flat { half_height, half_width: Some(half), .. } => half_height + half - 2.0 * y,
        };
        let mut sums = [0.0; 2];
        for point in 0..MEAN_POINTS {
            let y = self.half() * (f64::from(point) + 0.5) / f64::from(MEAN_POINTS);
            sums[0] += value(y) * length(y);
            sums[1] += length(y);
        }
        sums[0] / sums[1]
    }
}

impl VelocityField for Duct {
    fn velocity(&self, position: &Vector3<f64>) -> Vector3<f64> {
        let distance = self.section.distance(&(position - self.centre), &self.along).max(0.0);
        let speed = match self.flow {
            Flow::Turbulent { friction_velocity, per_length, scale } => {
                scale * friction_velocity * reichardt(distance * per_length)
            }
            Flow::Laminar(mean) => {
                let half = self.section.half();
                let peak = if matches!(self.section, CrossSection::Round(_)) { 2.0 } else { 1.5 };
                peak * mean * distance * (2.0 * half - distance) / (half * half)
            }
        };
        self.along * speed
    }

    fn turbulent_duct(&self) -> Option<[f64; 2]> {
        match self.flow {
            Flow::Turbulent { friction_velocity, .. } => Some([friction_velocity, self.section.half()]),
            Flow::Laminar(_) => None,
        }
    }

    fn doubt(&self) -> Option<String> {
        let (is, would) = match self.flow {
            Flow::Turbulent { .. } if self.reynolds < TRANSITION[0] => ("turbulent", "laminar"),
            Flow::Laminar(_) if self.reynolds > TRANSITION[1] => ("laminar", "turbulent"),
            _ => return None,
        };
        Some(format!(
            "the gas is {is} at a Reynolds number of {:.0}, at which ducts are {would}: check `gas.flow`, `speed` and \
             `viscosity`",
            self.reynolds
        ))
    }
}

/// Mean velocity over the friction velocity [1] at `y+` [1].
fn reichardt(plus: f64) -> f64 {
    2.5 * (0.4 * plus).ln_1p() + 7.8 * (-(-plus / 11.0).exp_m1() - plus / 11.0 * (-plus / 3.0).exp())
}

/// Friction velocity [m/s] in a smooth pipe.
fn smooth_friction_velocity(speed: f64, diameter: f64, viscosity: f64) -> f64 {
    let reynolds = speed * diameter / viscosity;
    // The root of the law is approached from any start; some ten rounds give all digits.
    let root = (0..30).fold(0.14, |root: f64, _| 1.0 / (2.0 * (reynolds * root).max(10.0).log10() - 0.8));
    speed * root / 8.0_f64.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moody's diagram of smooth pipes: f = 0.0309 at Re 1e4, 0.0180 at 1e5, 0.0116 at 1e6.
    #[test]
    fn friction_is_that_of_smooth_pipes() {
        for (reynolds, factor) in [(1e4, 0.0309), (1e5, 0.0180), (1e6, 0.0116)] {
            let ours = 8.0 * smooth_friction_velocity(1.0, 1.0, 1.0 / reynolds).powi(2);
            assert!((ours / factor - 1.0).abs() < 0.01, "Re {reynolds}: {ours}");
        }
    }

    /// Reynolds' experiment: pipes are laminar at 400 and turbulent at 70 000; in between either may be.
    #[test]
    fn an_unlikely_flow_is_doubted() {
        let turbulent = Flow::Turbulent { friction_velocity: 0.1, per_length: 1e4, scale: 1.0 };
        for (flow, reynolds, word) in [
            (turbulent, 400.0, Some("laminar:")),
            (turbulent, 7e4, None),
            (Flow::Laminar(1.0), 400.0, None),
            (Flow::Laminar(1.0), 7e4, Some("turbulent:")),
            (Flow::Laminar(1.0), 3000.0, None),
            (turbulent, 3000.0, None),
        ] {
            let along = Vector3::z();
            let duct =
                Duct { centre: Vector3::zeros(), along, section: CrossSection::Round(0.01), flow, reynolds };
            let doubt = duct.doubt();
            assert_eq!(doubt.is_some(), word.is_some(), "{reynolds}: {doubt:?}");
            assert!(word.is_none_or(|word| doubt.is_some_and(|doubt| doubt.contains(word))), "{reynolds}");
        }
    }

    /// Linear at the wall; far from it Nikuradse's pipes, `2.5 ln y+ + 5.5` (Schlichting, Boundary-Layer Theory).
    #[test]
    fn the_law_of_the_wall_is_linear_then_logarithmic() {
        assert!((reichardt(1.0) - 1.0).abs() < 0.05 && (reichardt(3.0) - 3.0).abs() < 0.15);
        for plus in [100.0, 300.0, 3000.0] {
            assert!(
                (reichardt(plus) - (2.5 * f64::ln(plus) + 5.5)).abs() < 0.1,
                "{plus}: {}",
                reichardt(plus)
            );
        }
    }
}
