//! Thermophoresis: the force on a small sphere down a gradient of temperature (Talbot et al. 1980).
//!
//! `F = -C mu² d/rho grad(T)/T` with the coefficient
//!
//! `C = 6 pi C_s (K + C_t Kn) / ((1 + 3 C_m Kn) (1 + 2 K + 2 C_t Kn))`,
//!
//! `K = k_g/k_p` the conductivity of the gas over that of the particle, `Kn = 2 lambda/d`, `lambda` the mean free path
//! [m], `d` the diameter [m], `mu` the viscosity [Pa s], `rho` the density [kg/m³] and `T` the temperature [K] of the
//! gas. `C_s` = 1.17, `C_m` = 1.14, `C_t` = 2.18.
//!
//! Talbot, Cheng, Schefer and Willis, J. Fluid Mech. 101 (1980) 737. Second source: the manual of Fluent, from memory;
//! tests compare with both limits. Interpolates between the continuum (Brock 1962) at small `Kn` and free molecules
//! (Waldmann 1959), within 20 % of measurements at all `Kn` (the authors'); conducting particles at `Kn` below 0.1 are
//! held back more than it says. A sphere far from the wall on its own scale, of the gas's temperature. `lambda` has to
//! be that of viscosity, `mu/rho sqrt(pi/(2 R T))`, with `R` the gas constant over the molar mass.

use std::f64::consts::PI;

const SLIP: f64 = 1.17;
const MOMENTUM: f64 = 1.14;
const JUMP: f64 = 2.18;

/// Coefficient `C` [1] of the force at a Knudsen number [1] and a ratio [1] of conductivities, gas over particle.
pub fn coefficient(knudsen: f64, conductivity_ratio: f64) -> f64 {
    let jump = JUMP * knudsen;
    6.0 * PI * SLIP * (conductivity_ratio + jump)
        / ((1.0 + 3.0 * MOMENTUM * knudsen) * (1.0 + 2.0 * conductivity_ratio + 2.0 * jump))
}

/// The gas around a particle, as thermophoresis sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThermalGas {
    /// Temperature [K].
    pub temperature: f64,
    /// Density [kg/m³].
    pub density: f64,
    /// Dynamic viscosity [Pa s].
    pub viscosity: f64,
    /// Thermal conductivity [W/(m K)].
    pub conductivity: f64,
    /// Mean free path of the molecules [m].
    pub mean_free_path: f64,
}

/// Force over the gradient of the gas's temperature [N m/K], negative: towards the cold. `diameter` [m] and
/// `conductivity` [W/(m K)] of the particle.
pub fn force_over_gradient(gas: &ThermalGas, diameter: f64, conductivity: f64) -> f64 {
    let knudsen = 2.0 * gas.mean_free_path / diameter;
    let coefficient = coefficient(knudsen, gas.conductivity / conductivity);
    -coefficient * gas.viscosity * gas.viscosity * diameter / (gas.density * gas.temperature)
}

/// Mean free path [m] of the molecules of a gas: `mu sqrt(pi/(2 rho p))`, from its viscosity [Pa s], density [kg/m³]
/// and pressure [Pa] (ideal gas; the definition that goes with viscosity).
pub fn mean_free_path(viscosity: f64, density: f64, pressure: f64) -> f64 {
    viscosity * (PI / (2.0 * density * pressure)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn air(mean_free_path: f64) -> ThermalGas {
        ThermalGas {
            temperature: 300.0,
            density: 1.177,
            viscosity: 1.846e-5,
            conductivity: 0.0263,
            mean_free_path,
        }
    }

    /// Hinds, Aerosol Technology: 0.066 µm at 293 K and 101 kPa; with the definition of viscosity 0.067 to 0.068 µm.
    #[test]
    fn the_mean_free_path_of_air_is_known() {
        assert_relative_eq!(mean_free_path(1.82e-5, 1.204, 101_325.0), 0.0665e-6, max_relative = 0.02);
    }

    /// Waldmann: in a gas of free molecules particles of all sizes and materials drift with
    /// `0.55 nu grad(T)/T`, `0.75/(1 + pi/8)` for diffuse reflection. Their drag is `3 pi mu d / C_c` with Cunningham's
    /// `C_c = 1.657 Kn` there. Talbot's constants meet that within the 2 % by which they differ from Millikan's.
    #[test]
    fn free_molecules_push_as_waldmann_says() {
        let diameter = 1e-9;
        let gas = air(100.0 * diameter);
        let knudsen = 200.0;
        for conductivity in [0.1, 50.0] {
            let slip = 1.0 + knudsen * (1.257 + 0.4 * (-1.1_f64 / knudsen).exp());
            let speed = force_over_gradient(&gas, diameter, conductivity) * slip
                / (3.0 * PI * gas.viscosity * diameter);
            let reduced = -speed * gas.temperature * gas.density / gas.viscosity;
            assert_relative_eq!(reduced, 0.75 / (1.0 + PI / 8.0), max_relative = 0.06);
        }
    }

    /// Brock (1962) in the continuum: `-6 pi C_s mu² d K/(1 + 2 K) grad(T)/(rho T)`; by hand for glass in air,
    /// `K = 0.0263/1.0`: speed `2 C_s K/(1 + 2 K) nu grad(T)/T`, 3.05e-8 m/s per K/m... of `nu/T = 5.228e-8`.
    #[test]
    fn the_continuum_is_that_of_brock() {
        let gas = air(0.0);
        let speed = force_over_gradient(&gas, 1e-5, 1.0) / (3.0 * PI * gas.viscosity * 1e-5);
        assert_relative_eq!(speed, -2.0 * 1.17 * 0.0263 / 1.0526 * 5.228e-8, max_relative = 1e-3);
    }
}
