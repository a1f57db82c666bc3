//! Diameter and density of a particle whose combustible matter reacts away.
//!
//! The unburnt particle of volume `V_0` and mass `m_0 = rho_0 V_0` is dense ash of volume `V_ash`
//! and combustible matter around it. With the carbon conversion `X` and the combustible share `c`
//! of the unburnt mass:
//!
//! ```text
//! m(X) = m_0 (1 - c X)
//! V(X) = V_ash + (V_0 - V_ash) (1 - X)^(3 a),    V_ash = (1 - c) m_0 / rho_ash
//! d(X) = (6 V/pi)^(1/3),    rho(X) = m/V
//! ```
//!
//! So the combustible matter has the usual power laws: its size goes as `(1 - X)^a`, its density as
//! `(1 - X)^b` with `3 a + b = 1`, because its mass goes as `1 - X`. Without ash these are the laws
//! of the whole particle: `a = 1/3` is a core that shrinks at constant density, `a = 0` a sphere of
//! constant size that becomes lighter. At `X = 1` the particle is a dense sphere of its ash for
//! every `a > 0`; with `a = 0` it stays a hollow sphere of its first diameter (a cenosphere). The
//! mass, and so the ash that is left, does not depend on `a`. A particle without combustible matter
//! (`c = 0`) keeps its size.
//!
//! Symbols: `a`, `b`, `c`, `X` [1], `d` [m], `rho` [kg/m³]. Range: `a` from 0 to 1/3, `rho_ash >=
//! (1 - c) rho_0` (the ash fits into the particle). Swelling and fragmentation are left out. The
//! default `a` = 0.25 stands for combustion (pore diffusion and surface together): the Carbon
//! Burnout Kinetics code (Hurt, Sun and Lunden 1998; inputs of public copies, the paper not
//! re-read) uses `b` = 0.2, so `a` = 0.27, for combustion and `b` = 0.95, so `a` = 0.02, for slow
//! gasification inside the pores.

use super::error::SimulationError;

/// Exponent `a` where a case gives none [1].
pub const DIAMETER_EXPONENT: f64 = 0.25;
/// Largest exponent [1]: a core of constant density.
pub const LARGEST_DIAMETER_EXPONENT: f64 = 1.0 / 3.0;
/// Density of ash [kg/m³] where neither the case nor the model gives it: *assumed*, that of the built-in `fly-ash`.
pub const ASH_DENSITY: f64 = 2300.0;

/// The shrinkage law of one particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shrinkage {
    /// `c` [1].
    combustible: f64,
    /// `a` [1].
    exponent: f64,
    /// `V_ash/V_0` [1].
    ash_volume: f64,
}

impl Shrinkage {
    /// A particle that keeps size and mass.
    pub const NONE: Self = Self { combustible: 0.0, exponent: 0.0, ash_volume: 1.0 };

    /// The law for a particle of unburnt `density` [kg/m³] with a `combustible` share of its mass
    /// [1], the `exponent` `a` [1] and the density of its ash [kg/m³].
    ///
    /// # Errors
    /// [`SimulationError::AshTooLarge`] when the ash is larger than the particle.
    pub fn new(
        density: f64,
        combustible: f64,
        exponent: f64,
        ash_density: f64,
    ) -> Result<Self, SimulationError> {
        if combustible == 0.0 {
            return Ok(Self::NONE);
        }
        let ash_volume = (1.0 - combustible) * density / ash_density;
        if ash_volume > 1.0 {
            let ash_percent = 100.0 * (1.0 - combustible);
            return Err(SimulationError::AshTooLarge { ash_density, density, ash_percent });
        }
        Ok(Self { combustible, exponent, ash_volume })
    }

    /// Combustible share of the unburnt mass, `c` [1].
    pub fn combustible(&self) -> f64 {
        self.combustible
    }

    /// Mass over unburnt mass [1] at a conversion [1].
    pub fn mass_left(&self, conversion: f64) -> f64 {
        1.0 - self.combustible * conversion.clamp(0.0, 1.0)
    }

    /// Volume over unburnt volume [1] at a conversion [1].
    pub fn volume_left(&self, conversion: f64) -> f64 {
        if self.exponent == 0.0 || self.combustible == 0.0 {
            return 1.0;
        }
        let left = 1.0 - conversion.clamp(0.0, 1.0);
        self.ash_volume + (1.0 - self.ash_volume) * left.powf(3.0 * self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const EXPONENTS: [f64; 5] = [0.0, 0.02, 0.25, 0.3, LARGEST_DIAMETER_EXPONENT];

    fn law(exponent: f64) -> Shrinkage {
        Shrinkage::new(1200.0, 0.9, exponent, 2400.0).unwrap()
    }

    #[test]
    fn the_mass_of_ash_is_the_same_for_every_law_and_its_sphere_is_dense() {
        for exponent in EXPONENTS {
            let law = law(exponent);
            assert_relative_eq!(law.mass_left(1.0), 0.1, max_relative = 1e-14);
            assert_eq!(law.mass_left(0.4), 1.0 - 0.9 * 0.4);
            if exponent > 0.0 {
                assert_relative_eq!(
                    1200.0 * law.mass_left(1.0) / law.volume_left(1.0),
                    2400.0,
                    max_relative = 1e-13
                );
            }
        }
        assert_eq!(law(0.0).volume_left(1.0), 1.0);
    }

    #[test]
    fn the_volume_falls_steadily_to_that_of_the_ash() {
        for exponent in EXPONENTS {
            let volumes: Vec<f64> =
                (0..=10_000).map(|i| law(exponent).volume_left(f64::from(i) / 1e4)).collect();
            assert_eq!(volumes[0], 1.0);
            assert!(volumes.is_sorted_by(|a, b| a >= b), "{exponent}");
            assert!(volumes.iter().all(|volume| *volume >= 0.05 - 1e-15), "{exponent}");
        }
        // No jump at burn-out: 10^-15 before it the combustible volume is (10^-15)^(3a) of what it was.
        assert!(law(LARGEST_DIAMETER_EXPONENT).volume_left(1.0 - 1e-15) - 0.05 < 2e-15);
        assert_relative_eq!(law(0.25).volume_left(1.0 - 1e-12) - 0.05, 0.95e-9, max_relative = 1e-3);
    }

    /// Without ash: d ~ (1-X)^a and rho ~ (1-X)^b with 3a + b = 1.
    #[test]
    fn without_ash_the_power_laws_are_those_of_the_particle() {
        for exponent in EXPONENTS {
            let law = Shrinkage::new(700.0, 1.0, exponent, 2400.0).unwrap();
            for conversion in [0.1, 0.5, 0.99] {
                let left: f64 = 1.0 - conversion;
                let volume = law.volume_left(conversion);
                assert_relative_eq!(volume.cbrt(), left.powf(exponent), max_relative = 1e-12);
                let density = law.mass_left(conversion) / volume;
                assert_relative_eq!(density, left.powf(1.0 - 3.0 * exponent), max_relative = 1e-12);
            }
        }
    }

    #[test]
    fn ash_has_to_fit_and_stone_does_not_shrink() {
        assert!(Shrinkage::new(2000.0, 0.1, 0.25, 1000.0).unwrap_err().to_string().contains("does not fit"));
        let stone = Shrinkage::new(2600.0, 0.0, 0.25, 1000.0).unwrap();
        assert_eq!((stone.mass_left(0.7), stone.volume_left(0.7)), (1.0, 1.0));
    }
}
