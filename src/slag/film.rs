//! Slag film on a wall: laminar flow under gravity.
//!
//! Steady, fully developed, thin against the curvature of the wall, no shear by the gas:
//! `d(mu du/dy)/dy = -rho g_t` with `u = 0` at the wall and no stress at the surface. With one
//! temperature across (Nusselt's film) the mean speed is `rho g_t delta²/(3 mu)`. With a temperature
//! that rises linearly from the bottom to the surface, hot slag outside flows over stiff slag inside:
//!
//! `u = rho g_t/delta ∫ (delta - y)²/mu(T(y)) dy`, `y` from 0 at the bottom to `delta`.
//!
//! `delta` thickness [m], `y` distance from the bottom [m], `mu` viscosity [Pa s], `rho` density
//! [kg/m³], `g_t` the part of gravity along the wall [m/s²], which is `g sin(beta)` on a wall at
//! `beta` from the horizontal. Valid for Reynolds numbers `4 rho u delta/mu` below some 30, far above
//! any slag's. Neglected: freezing, heat carried along by the film, the drag of the gas.
//!
//! Source of the second: M. Seggiani, Modelling and simulation of time varying slag flow in a Prenflo
//! entrained-flow gasifier, Fuel 77 (1998) 1611 (not re-read; linear temperature, viscosity over the
//! depth). The tests hold it against the closed integral for `mu` exponential in depth.

/// Points and weights of Gauss and Legendre on -1 to 1, of one panel.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
];
/// Panels over the depth: viscosity may fall a hundredfold across it.
const PANELS: u32 = 16;
/// Mean speed over the thickness [m/s].
pub fn mean_velocity(thickness: f64, density: f64, viscosity: f64, gravity_along: f64) -> f64 {
    density * gravity_along * thickness * thickness / (3.0 * viscosity)
}

/// Mean speed [m/s] of a film of a thickness [m] with these temperatures [K] of its bottom and its
/// surface and a straight line in between. A part whose viscosity is infinite does not move.
pub fn mean_velocity_of_layers(
    thickness: f64,
    [bottom, surface]: [f64; 2],
    density: f64,
    gravity_along: f64,
    viscosity: impl Fn(f64) -> f64,
) -> f64 {
    let rise = surface - bottom;
    let panel = |number: u32| {
        let width = 1.0 / f64::from(PANELS);
        let point = |(x, weight): (f64, f64)| {
            let depth = width * (f64::from(number) + 0.5 * (1.0 + x));
            0.5 * width * weight * (1.0 - depth).powi(2) / viscosity(bottom + rise * depth)
        };
        GAUSS.into_iter().map(point).sum::<f64>()
    };
    let mobility: f64 = (0..PANELS).map(panel).sum();
    density * gravity_along * thickness * thickness * mobility
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const RHO: f64 = 2700.0;
    const MU: f64 = 12.0;
    const G: f64 = 9.81;
    const DELTA: f64 = 1.3e-3;

    /// The profile `u(y) = (rho g_t/mu) (delta y - y²/2)` solves the equation of motion. Its mean by
    /// Simpson's rule, which is exact for a parabola.
    #[test]
    fn the_mean_is_that_of_the_parabolic_profile() {
        let profile = |y: f64| RHO * G / MU * (DELTA * y - 0.5 * y * y);
        let mean = (4.0 * profile(0.5 * DELTA) + profile(DELTA)) / 6.0;
        assert_relative_eq!(mean_velocity(DELTA, RHO, MU, G), mean, max_relative = 1e-14);
        // A wall that does not lean and a melt that does not flow: nothing moves.
        assert_eq!(mean_velocity(DELTA, RHO, MU, 0.0), 0.0);
        assert_eq!(mean_velocity(DELTA, RHO, f64::INFINITY, G), 0.0);
    }

    #[test]
    fn layers_of_one_viscosity_are_the_nusselt_film() {
        let found = mean_velocity_of_layers(DELTA, [1500.0, 1700.0], RHO, G, |_| MU);
        assert_relative_eq!(found, mean_velocity(DELTA, RHO, MU, G), max_relative = 1e-13);
        let stiff = |t: f64| if t < 1600.0 { f64::INFINITY } else { MU };
        // Of the film only the outer half moves.
        let outer = mean_velocity_of_layers(DELTA, [1500.0, 1700.0], RHO, G, stiff);
        assert_relative_eq!(outer, found / 8.0, max_relative = 1e-12);
    }

    /// `mu = mu_s exp(a (1 - y/delta))`: `u = rho g delta²/mu_s (2 - (a² + 2a + 2) exp(-a))/a³`.
    #[test]
    fn viscosity_exponential_in_depth_has_a_closed_integral() {
        let [bottom, surface] = [1550.0, 1750.0];
        for a in [0.5, 2.0, 6.0_f64] {
            let viscosity = |t: f64| 5.0 * (a * (surface - t) / (surface - bottom)).exp();
            let found = mean_velocity_of_layers(DELTA, [bottom, surface], RHO, G, viscosity);
            let closed =
                RHO * G * DELTA * DELTA / 5.0 * (2.0 - (a * a + 2.0 * a + 2.0) * (-a).exp()) / a.powi(3);
            assert_relative_eq!(found, closed, max_relative = 1e-9);
        }
    }
}
