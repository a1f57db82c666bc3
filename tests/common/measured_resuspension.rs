//! The measured resuspension, `tests/data/resuspension_measured.csv`.
#![allow(dead_code, reason = "each test uses its part")]
#![allow(clippy::unwrap_used, reason = "clippy.toml's leave for tests does not reach their helpers")]

use nearwall::deposit::resuspension::{AdhesionDistribution, Conditions};

const TABLE: &str = include_str!("../data/resuspension_measured.csv");

/// One measured point.
pub struct Measured {
    /// Diameter of the spheres [µm].
    pub diameter: u32,
    /// Friction velocity [m/s].
    pub friction_velocity: f64,
    /// Fraction that remains after 1 s [1].
    pub remaining: f64,
}

/// Every row of the table with this diameter [µm].
pub fn measured(diameter: u32) -> Vec<Measured> {
    let rows = TABLE.lines().filter(|line| !line.starts_with('#')).skip(1).map(|line| {
        let [_run, diameter, friction_velocity, remaining] = line.split(',').collect::<Vec<_>>()[..] else {
            unreachable!("{line}")
        };
        Measured {
            diameter: diameter.parse().unwrap(),
            friction_velocity: friction_velocity.parse().unwrap(),
            remaining: remaining.parse().unwrap(),
        }
    });
    rows.filter(|row| row.diameter == diameter).collect()
}

/// The law under the conditions of the runs: 0.56 J/m² and air at room temperature.
pub fn alumina(diameter: u32, friction_velocity: f64) -> Conditions {
    let radius = 0.5e-6 * f64::from(diameter);
    Conditions {
        radius,
        adhesion: AdhesionDistribution::biasi(radius, 0.56).unwrap(),
        gas_density: 1.181,
        kinematic_viscosity: 1.539e-5,
        friction_velocity,
    }
}
