//! Brownian motion of a fine particle: its random velocity and displacement in a time step.
//!
//! Molecules push a sphere with white noise of the spectral density that Li and Ahmadi, Aerosol Sci. Technol. 16
//! (1992) 209, use, `S_0 = 216 nu k_B T/(pi² rho d⁵ (rho_p/rho)² C_c)`; the force of a step `dt` is then `m sqrt(pi
//! S_0/dt)` times a standard normal number. That is Langevin's equation `dv = -v/tau dt + sqrt(2 k_B T/(m tau)) dW`
//! (second source: OpenFOAM's `BrownianMotionForce`, and equality of both forms in the tests). A force that is constant
//! in a step needs `dt` far below `tau`; here the step is exact for any `dt` (Chandrasekhar, Rev. Mod. Phys. 15 (1943)
//! 1, eqs. 171-175): with `b = dt/tau`, velocity and displacement of each direction are normal with
//!
//! `<v²> = (k_B T/m) (1 - e^-2b)`, `<x v> = (k_B T/m) tau (1 - e^-b)²`,
//! `<x²> = (k_B T/m) tau² (2b - 3 + 4 e^-b - e^-2b)`.
//!
//! `k_B T/m` [m²/s²] of the particle's mass `m` [kg], `tau` its relaxation time with slip [s]. For long times the
//! displacement is that of the diffusivity `D = k_B T tau/m` [m²/s] (Einstein). Far from walls.

use std::f64::consts::PI;

/// Boltzmann's constant [J/K].
pub const BOLTZMANN: f64 = 1.380_649e-23;

/// The spread of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrownianStep {
    /// Standard deviation of the displacement [m].
    displacement: f64,
    /// Part of the velocity that goes with the displacement, and the rest of its standard deviation [m/s].
    velocity: [f64; 2],
}

impl BrownianStep {
    /// A step of a `duration` [s] of a particle with a `mass` [kg] and a relaxation time [s] in a gas of a
    /// `temperature` [K].
    pub fn new(temperature: f64, mass: f64, relaxation_time: f64, duration: f64) -> Self {
        let square = BOLTZMANN * temperature / mass;
        let steps = duration / relaxation_time;
        let [one, two] = [-(-steps).exp_m1(), -(-2.0 * steps).exp_m1()];
        // 2 b - 3 + 4 e^-b - e^-2b loses all digits to cancellation at small b, where it is 2/3 b³ - b⁴/2.
        let shape = if steps < 1e-2 {
            steps.powi(3) * (2.0 / 3.0 - 0.5 * steps + 7.0 / 30.0 * steps * steps)
        } else {
            2.0 * steps - 4.0 * one + two
        };
        let displacement = (square * shape).sqrt() * relaxation_time;
        let common =
            if displacement > 0.0 { square * relaxation_time * one * one / displacement } else { 0.0 };
        Self { displacement, velocity: [common, (square * two - common * common).max(0.0).sqrt()] }
    }

    /// Displacement [m] and change of velocity [m/s] of one direction, for two independent standard normal numbers.
    pub fn drawn(&self, [first, second]: [f64; 2]) -> [f64; 2] {
        let [common, rest] = self.velocity;
        [self.displacement * first, common * first + rest * second]
    }

    /// Probability [1] that a path which begins and ends at these gaps [m] from a plane wall has touched it in between
    /// (Brownian bridge): `exp(-2 g_0 g_1/<x²>)`.
    pub fn touch_probability(&self, [begin, end]: [f64; 2]) -> f64 {
        let variance = self.displacement * self.displacement;
        if variance > 0.0 { (-2.0 * begin * end / variance).exp() } else { 0.0 }
    }
}

/// Spectral density `S_0` [m²/s³] of the acceleration, as Li and Ahmadi write it. `viscosity` [Pa s] and `temperature`
/// [K] of the gas, `density` [kg/m³] and `diameter` [m] of the particle, `slip_factor` [1] of Cunningham.
pub fn spectral_density(
    viscosity: f64,
    temperature: f64,
    density: f64,
    diameter: f64,
    slip_factor: f64,
) -> f64 {
    216.0 * viscosity * BOLTZMANN * temperature
        / (PI * PI * diameter.powi(5) * density * density * slip_factor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const SIZE: f64 = 1e-7;
    const DENSITY: f64 = 1000.0;
    const VISCOSITY: f64 = 1.81e-5;
    const SLIP: f64 = 2.9;

    fn mass_and_time() -> [f64; 2] {
        let mass = PI / 6.0 * DENSITY * SIZE.powi(3);
        [mass, DENSITY * SIZE * SIZE * SLIP / (18.0 * VISCOSITY)]
    }

    /// Hinds, Aerosol Technology, table 7.1: 0.1 µm in air at 293 K diffuses with 6.9e-10 m²/s.
    #[test]
    fn long_steps_diffuse_as_tabulated() {
        let [mass, time] = mass_and_time();
        let duration = 1e4 * time;
        let step = BrownianStep::new(293.0, mass, time, duration);
        assert_relative_eq!(step.displacement.powi(2) / (2.0 * duration), 6.9e-10, max_relative = 0.02);
    }

    /// In a step far below the relaxation time the force of Li and Ahmadi, constant over it, gives the same velocity.
    #[test]
    fn short_steps_are_those_of_li_and_ahmadi() {
        let [mass, time] = mass_and_time();
        let duration = 1e-4 * time;
        let step = BrownianStep::new(293.0, mass, time, duration);
        let spectrum = spectral_density(VISCOSITY, 293.0, DENSITY, SIZE, SLIP);
        let expected = (PI * spectrum / duration).sqrt() * duration;
        let [common, rest] = step.velocity;
        assert_relative_eq!(common.hypot(rest), expected, max_relative = 1e-3);
    }

    /// Both forms of the displacement meet where one takes over, and two steps spread as one twice as long.
    #[test]
    fn the_spread_does_not_depend_on_the_step() {
        let [mass, time] = mass_and_time();
        for duration in [0.003, 0.0099, 0.02, 1.0, 30.0].map(|steps| steps * time) {
            let [half, whole] = [duration, 2.0 * duration].map(|d| BrownianStep::new(293.0, mass, time, d));
            let kept = (-duration / time).exp();
            let along = -(-duration / time).exp_m1() * time;
            let [common, rest] = half.velocity;
            let velocity = common.hypot(rest).powi(2);
            let covariance = half.displacement * common;
            let displacement =
                2.0 * half.displacement.powi(2) + along * along * velocity + 2.0 * along * covariance;
            assert_relative_eq!(whole.displacement.powi(2), displacement, max_relative = 1e-8);
            let [whole_common, whole_rest] = whole.velocity;
            assert_relative_eq!(
                whole_common.hypot(whole_rest).powi(2),
                velocity * (1.0 + kept * kept),
                max_relative = 1e-10
            );
        }
    }
}
