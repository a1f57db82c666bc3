//! Kinetic-energy criterion: the viscosity at which an impact sticks falls with its kinetic energy
//! (Srinivasachar, Helble & Boni 1990).
//!
//! `P = min(1, mu_ref/mu(T))` with `mu_ref = A (E/1 J)^-n`, `E = pi/12 rho d³ v_n²`. `mu` viscosity
//! of the melt [Pa s] at its own temperature, `rho` density [kg/m³] and `d` diameter [m] of the
//! particle, `v_n` speed towards the wall [m/s], `A` [Pa s] and `n` [1]. A faster or larger
//! particle needs a thinner melt. Both directions of impact: the particle's own melt at `T_p`, and
//! slag on a wall at `T_w` for the kinetic energy of the particle that meets it.
//!
//! `A = 5e-12 Pa s` and `n = 1.78`: after Srinivasachar et al., Symp. (Int.) Combust. 23 (1990)
//! 1305, from memory; **no second source was found**, so give `coefficient` and `exponent` if you
//! have the paper. They say 9.0e4 Pa s for 50 µm at 3 m/s (2500 kg/m³), within the 8 to 1e7 Pa s of
//! the literature; their power is steep: ten times the speed takes 3.6 decades. *Assumed*: that `E`
//! is that of the speed towards the wall, and Walsh's proportion in place of a step at `mu_ref`.
//! Valid for silicate ash above its critical viscosity temperature and for energies near those
//! measured, some 1e-11 to 1e-8 J (5 to 65 µm at 1 to 10 m/s; not re-read).

use std::f64::consts::PI;

use crate::impact::Impact;
use crate::input::{InputError, Limits, Section};

/// `A` [Pa s] of Srinivasachar et al.
const COEFFICIENT: f64 = 5e-12;
/// `n` [1] of Srinivasachar et al.
const EXPONENT: f64 = 1.78;

const COEFFICIENTS: Limits =
    Limits { unit: "Pa s", low: 1e-100, high: 1e100, known: "5e-12 by Srinivasachar et al." };

/// The `coefficient` and the `exponent` of a `[capture]` table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EnergyLaw {
    coefficient: f64,
    exponent: f64,
}

impl EnergyLaw {
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        Ok(Self {
            coefficient: section.quantity("coefficient", &COEFFICIENTS)?.unwrap_or(COEFFICIENT),
            exponent: section.number_within("exponent", 0.0, 10.0)?.unwrap_or(EXPONENT),
        })
    }

    /// `A` [Pa s].
    pub fn coefficient_mut(&mut self) -> &mut f64 {
        &mut self.coefficient
    }

    pub fn describe(self) -> String {
        let Self { coefficient, exponent } = self;
        let default = (coefficient, exponent) == (COEFFICIENT, EXPONENT);
        let warning = if default { " (quoted from memory, without a second source)" } else { "" };
        format!("reference viscosity {coefficient:e} Pa s (E/J)^-{exponent}{warning}")
    }

    /// Viscosity [Pa s] up to which an impact of a particle of this density [kg/m³] sticks.
    pub fn at(self, density: f64, impact: &Impact) -> f64 {
        let energy = kinetic_energy(density, impact.diameter, impact.normal_speed);
        critical_viscosity(energy, self.coefficient, self.exponent)
    }
}

/// Kinetic energy [J] of a sphere's motion towards the wall, `pi/12 rho d³ v_n²`, from density
/// [kg/m³], diameter [m] and speed [m/s].
pub fn kinetic_energy(density: f64, diameter: f64, normal_speed: f64) -> f64 {
    PI / 12.0 * density * diameter.powi(3) * normal_speed * normal_speed
}

/// Viscosity [Pa s] up to which an impact of this kinetic energy [J] sticks, `A E^-n`; infinite without motion.
pub fn critical_viscosity(kinetic_energy: f64, coefficient: f64, exponent: f64) -> f64 {
    coefficient * kinetic_energy.powf(-exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// By hand: 50 µm, 2500 kg/m³: mass 1.636e-10 kg, at 3 m/s 7.363e-10 J; log10 = -9.1330, times -1.78 is 16.2567;
    /// 5e-12 · 10^16.2567 = 9.03e4 Pa s.
    #[test]
    fn fifty_micrometres_at_three_metres_a_second() {
        let energy = kinetic_energy(2500.0, 50e-6, 3.0);
        assert_relative_eq!(energy, 7.363e-10, max_relative = 1e-3);
        assert_relative_eq!(critical_viscosity(energy, COEFFICIENT, EXPONENT), 9.03e4, max_relative = 3e-3);
    }

    #[test]
    fn faster_and_larger_need_a_thinner_melt() {
        let at = |diameter, speed| {
            critical_viscosity(kinetic_energy(2500.0, diameter, speed), COEFFICIENT, EXPONENT)
        };
        assert!(at(50e-6, 2.0) > at(50e-6, 3.0) && at(40e-6, 3.0) > at(50e-6, 3.0));
        assert_relative_eq!((at(50e-6, 1.0) / at(50e-6, 10.0)).log10(), 3.56, max_relative = 1e-9);
        assert_eq!(at(50e-6, 0.0), f64::INFINITY);
    }
}
