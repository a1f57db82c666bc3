//! Slag film on a wall: laminar flow under gravity.
//!
//! Steady, fully developed, thin against the curvature of the wall, no shear by the gas, one temperature across: then
//! `mu d²u/dy² = -rho g_t` with `u = 0` at the wall and no stress at the surface, and
//!
//! `u(y) = (rho g_t/mu) (delta y - y²/2)`, its mean `rho g_t delta²/(3 mu)`, mass flow per width `rho² g_t delta³/(3 mu)`
//!
//! (Nusselt's film). A wall that receives `m` everywhere below its upper edge carries `m x` per width at the distance `x`, so the
//! steady thickness is `delta(x) = (3 mu m x/(rho² g_t))^(1/3)`. A small change of thickness travels at `rho g_t delta²/mu`,
//! three times the mean speed.
//!
//! `delta` thickness [m], `y` distance from the wall [m], `mu` viscosity [Pa s], `rho` density [kg/m³], `g_t` the part of gravity
//! along the wall [m/s²], which is `g sin(beta)` on a wall at `beta` from the horizontal, `m` arrival [kg/m²/s]. Valid for
//! Reynolds numbers `4 rho u delta/mu` below some 30, far above any slag's. Neglected: the temperature profile across
//! the film, which makes the outer slag flow faster (Seggiani 1998 solves it for a gasifier), freezing, and the drag of the gas.

/// Speed [m/s] at a distance from the wall [m] in a film of a thickness [m].
pub fn velocity(distance: f64, thickness: f64, density: f64, viscosity: f64, gravity_along: f64) -> f64 {
    density * gravity_along / viscosity * (thickness * distance - 0.5 * distance * distance)
}

/// Mean speed over the thickness [m/s].
pub fn mean_velocity(thickness: f64, density: f64, viscosity: f64, gravity_along: f64) -> f64 {
    density * gravity_along * thickness * thickness / (3.0 * viscosity)
}

/// Mass flow per width of wall [kg/m/s].
pub fn flow(thickness: f64, density: f64, viscosity: f64, gravity_along: f64) -> f64 {
    density * thickness * mean_velocity(thickness, density, viscosity, gravity_along)
}

/// Speed [m/s] at which a change of thickness travels.
pub fn wave_velocity(thickness: f64, density: f64, viscosity: f64, gravity_along: f64) -> f64 {
    3.0 * mean_velocity(thickness, density, viscosity, gravity_along)
}

/// Steady thickness [m] at a distance [m] below the upper edge of a wall that receives `arrival` [kg/m²/s] everywhere.
pub fn steady_thickness(
    arrival: f64,
    distance: f64,
    density: f64,
    viscosity: f64,
    gravity_along: f64,
) -> f64 {
    (3.0 * viscosity * arrival * distance / (density * density * gravity_along)).cbrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const RHO: f64 = 2700.0;
    const MU: f64 = 12.0;
    const G: f64 = 9.81;
    const DELTA: f64 = 1.3e-3;

    #[test]
    fn the_mean_and_the_flow_are_integrals_of_the_profile() {
        // Simpson's rule is exact for a parabola.
        let u = |y: f64| velocity(y, DELTA, RHO, MU, G);
        let mean = (u(0.0) + 4.0 * u(0.5 * DELTA) + u(DELTA)) / 6.0;
        assert_relative_eq!(mean_velocity(DELTA, RHO, MU, G), mean, max_relative = 1e-14);
        assert_relative_eq!(flow(DELTA, RHO, MU, G), RHO * DELTA * mean, max_relative = 1e-14);
    }

    #[test]
    fn the_profile_sticks_to_the_wall_and_has_no_stress_outside() {
        assert_eq!(velocity(0.0, DELTA, RHO, MU, G), 0.0);
        let h = 1e-6 * DELTA;
        let stress = |y: f64| {
            MU * (velocity(y + h, DELTA, RHO, MU, G) - velocity(y - h, DELTA, RHO, MU, G)) / (2.0 * h)
        };
        // All of the film's weight hangs on the wall, nothing on its surface.
        assert_relative_eq!(stress(0.0), RHO * G * DELTA, max_relative = 1e-8);
        assert!(stress(DELTA).abs() < 1e-8 * RHO * G * DELTA);
    }

    /// Mass balance: what flows at `x` has arrived above it. A wave runs at the slope of flow over mass per area.
    #[test]
    fn the_steady_film_carries_what_arrived_above() {
        let arrival = 0.02;
        for x in [1e-3, 0.1, 3.0] {
            let delta = steady_thickness(arrival, x, RHO, MU, G);
            assert_relative_eq!(flow(delta, RHO, MU, G), arrival * x, max_relative = 1e-13);
            let h = 1e-6 * delta;
            let slope = (flow(delta + h, RHO, MU, G) - flow(delta - h, RHO, MU, G)) / (2.0 * h * RHO);
            assert_relative_eq!(wave_velocity(delta, RHO, MU, G), slope, max_relative = 1e-8);
        }
        assert_eq!(steady_thickness(arrival, 0.0, RHO, MU, G), 0.0);
        assert_eq!(steady_thickness(0.0, 1.0, RHO, MU, G), 0.0);
        // A wall that does not lean and a melt that does not flow: nothing moves.
        assert_eq!(flow(DELTA, RHO, MU, 0.0), 0.0);
        assert_eq!(flow(DELTA, RHO, f64::INFINITY, G), 0.0);
    }
}
