//! Fluctuations of the gas beside a smooth wall, and how long they last.
//!
//! With the distance `y+ = y u_tau/nu` from the wall, and `sigma` the standard deviation of the velocity over the
//! friction velocity `u_tau`:
//!
//! | | |
//! |---|---|
//! | along the flow | `sigma_1 = 0.40 y+ / (1 + 0.0239 y+^1.496)` |
//! | away from the wall | `sigma_2 = 0.0126 y+² / (1 + 0.159 y+ + 0.0082 y+²)` |
//! | across | `sigma_3 = 0.19 y+ / (1 + 0.0361 y+^1.322)` |
//! | time scale | `tau = (nu/u_tau²) 10` up to `y+ = 5`, `(nu/u_tau²) (7.122 + 0.5731 y+ - 0.00129 y+²)` above |
//!
//! `sigma_2` is fitted to the direct simulation of a channel at a Reynolds number of 944 (friction velocity and half
//! height; Hoyas and Jiménez, Phys. Fluids 18 (2006) 011702, their data), within 3 % up to `y+ = 80` with the core
//! below; at 178 it is a third less at the wall. Deposition of fine particles goes with its fourth power. `sigma_1` and
//! `sigma_3` are the fits that Dehbi, Int. J. Multiphase Flow 34 (2008) 819, uses for `y+ < 100`; the time scale is of
//! Kallio and Reeks, Int. J. Multiphase Flow 15 (1989) 433, for `y+ < 200`: both from memory, not re-read.
//!
//! Rare sweeps reach the wall: the velocity away from it has a flatness of 27 at the wall, 12 at `y+ = 5`, 5 at 19 and
//! below 3.6 beyond 35 (Moser, Kim and Mansour, Phys. Fluids 11 (1999) 943, their data at a Reynolds number of 178;
//! 22 at the wall in Kim, Moin and Moser, J. Fluid Mech. 177 (1987) 133). Of a standard normal number `z` it is
//!
//! `sigma_2 (c_1 z + c_3 (z³ - 3 z))`, `c_3 = 0.2 exp(-(y+/13.9)^0.9)`, `c_1² + 6 c_3² = 1`,
//!
//! with a flatness within 4 % of those data up to `y+ = 35`. The skewness, -0.24 to 0.34 there, is left out.
//!
//! Between `y+ = 30` and 100 the fluctuations become those of the core, the same in all directions ([`Core`]). Without
//! a core they are `u_tau`, which is the normal fluctuation at `y+ = 70` to 100, and beyond `y+ = 200` the time
//! grows in proportion to the distance, as the eddy diffusivity `sigma_2² tau` does in the logarithmic layer.
//!
//! At `y+ = 80` that diffusivity is 1.5 times the `0.41 y+` of the logarithmic layer, from 100 on 0.8 to 1.4 times.
//!
//! Beyond these ranges: a rough wall, a separated flow and a corner have other profiles.

/// Ends of the range in which the fluctuations of the wall become those of the core, as `y+` [1].
const BLEND: [f64; 2] = [30.0, 100.0];
/// `c_3` at the wall [1], the `y+` over which it falls to 1/e, and the exponent.
const SWEEPS: [f64; 3] = [0.2, 13.9, 0.9];
/// `y+` below which the slope of `c_3`, which is infinite at the wall, no longer rises [1].
const LEAST: f64 = 1e-6;
/// Largest `y+` of the time scale's fit [1].
const TIME_END: f64 = 200.0;
/// Lagrangian time over `k/epsilon` [1]: `2/C_0` with `C_0` = 14 (Mito and Hanratty 2002, as Dehbi 2008; from memory).
const CORE_TIME: f64 = 2.0 / 14.0;

/// A wall as the gas at one place feels it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallLayer {
    /// Distance from the wall [m].
    pub distance: f64,
    /// Direction away from the wall, of length 1.
    pub normal: [f64; 3],
    /// Divergence of the normal [1/m]: 0 beside a plane, `-1/r` within a pipe at a distance `r` from its axis.
    pub divergence: f64,
    /// Friction velocity [m/s].
    pub friction_velocity: f64,
    /// Kinematic viscosity of the gas [m²/s].
    pub kinematic_viscosity: f64,
}

/// Turbulence far from walls, the same in all directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Core {
    /// Standard deviation of each component of the velocity [m/s].
    pub fluctuation: f64,
    /// Its gradient [1/s].
    pub gradient: [f64; 3],
    /// Lagrangian time scale [s].
    pub time_scale: f64,
}

impl Core {
    /// From turbulent kinetic energy `k` [m²/s²] and dissipation `epsilon` [m²/s³], both the same everywhere:
    /// `sqrt(2 k/3)` and `(1/7) k/epsilon`.
    pub fn uniform(energy: f64, dissipation: f64) -> Self {
        let time_scale = CORE_TIME * energy / dissipation;
        Self { fluctuation: (2.0 / 3.0 * energy).sqrt(), gradient: [0.0; 3], time_scale }
    }
}

/// The turbulence at a place near a wall in the directions of the wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fluctuations {
    /// Standard deviation of the velocity along the flow, away from the wall and across [m/s].
    pub deviations: [f64; 3],
    /// Gradient of the second of them away from the wall [1/s], that of the core's left out.
    pub normal_gradient: f64,
    /// `c_1` and `c_3` [1].
    pub shape: [f64; 2],
    /// Their gradients away from the wall [1/m].
    pub shape_gradient: [f64; 2],
    /// Share of the core [1].
    pub core_share: f64,
    /// Lagrangian time scale [s].
    pub time_scale: f64,
}

impl WallLayer {
    /// Distance over the viscous length [1].
    pub fn distance_plus(&self) -> f64 {
        self.distance.max(0.0) * self.friction_velocity / self.kinematic_viscosity
    }

    /// Does the wall change the fluctuations of a core here?
    pub fn reaches(&self) -> bool {
        self.distance_plus() < BLEND[1]
    }

    /// The fluctuations at this place; `core` is that of [`WallLayer::friction_velocity`] if it is not known.
    pub(super) fn fluctuations(&self, core: Option<&Core>) -> Fluctuations {
        let (plus, speed) = (self.distance_plus(), self.friction_velocity);
        let (length, time) = (self.kinematic_viscosity / speed, self.kinematic_viscosity / (speed * speed));
        let far = core.map_or(speed, |core| core.fluctuation);
        let near = time * time_plus(plus);
        let far_time = core.map_or(near, |core| core.time_scale);
        if !self.reaches() {
            // What follows gives the same there, at the cost of its powers.
            return Fluctuations {
                deviations: [far; 3],
                normal_gradient: 0.0,
                shape: [1.0, 0.0],
                shape_gradient: [0.0; 2],
                core_share: 1.0,
                time_scale: far_time,
            };
        }
        let [core_share, growth] = blend(plus);
        let mixed = |near: f64| near + core_share * (far - near);
        let [normal, slope] = normal_deviation(plus);
        let deviations = [
            mixed(speed * streamwise_deviation(plus)),
            mixed(speed * normal),
            mixed(speed * spanwise_deviation(plus)),
        ];
        let normal_gradient = ((1.0 - core_share) * speed * slope + growth * (far - speed * normal)) / length;
        let time_scale = near + core_share * (far_time - near);
        let [shape, slope] = normal_shape(plus);
        let shape_gradient = slope.map(|slope| slope / length);
        Fluctuations { deviations, normal_gradient, shape, shape_gradient, core_share, time_scale }
    }
}

/// Standard deviation of the velocity along the flow over the friction velocity [1] at `y+`.
pub fn streamwise_deviation(plus: f64) -> f64 {
    0.40 * plus / (1.0 + 0.0239 * plus.powf(1.496))
}

/// Standard deviation of the velocity away from the wall over the friction velocity [1], and its slope over `y+` [1].
pub fn normal_deviation(plus: f64) -> [f64; 2] {
    let below = 1.0 + (0.159 + 0.0082 * plus) * plus;
    let value = 0.0126 * plus * plus / below;
    [value, (0.0252 * plus - value * (0.159 + 0.0164 * plus)) / below]
}

/// `c_1` and `c_3` [1] of the velocity away from the wall at `y+`, and their slopes over `y+` [1].
pub fn normal_shape(plus: f64) -> [[f64; 2]; 2] {
    let [at_wall, range, exponent] = SWEEPS;
    let plus = plus.max(LEAST);
    let (way, [core_share, growth]) = ((plus / range).powf(exponent), blend(plus));
    let near = at_wall * (-way).exp();
    let cubic = (1.0 - core_share) * near;
    let linear = (1.0 - 6.0 * cubic * cubic).sqrt();
    let slope = -cubic * way * exponent / plus - growth * near;
    [[linear, cubic], [-6.0 * cubic * slope / linear, slope]]
}

/// Standard deviation of the velocity along the wall and across the flow over the friction velocity [1] at `y+`.
pub fn spanwise_deviation(plus: f64) -> f64 {
    0.19 * plus / (1.0 + 0.0361 * plus.powf(1.322))
}

/// Lagrangian time scale over `nu/u_tau²` [1] at `y+`.
pub fn time_plus(plus: f64) -> f64 {
    let fit = |plus: f64| 7.122 + (0.5731 - 0.00129 * plus) * plus;
    if plus <= 5.0 {
        10.0
    } else if plus <= TIME_END {
        fit(plus)
    } else {
        fit(TIME_END) * plus / TIME_END
    }
}

/// Share of the core at `y+` [1] and its slope over `y+` [1]: `s² (3 - 2 s)` with `s` from 0 to 1 over [`BLEND`].
fn blend(plus: f64) -> [f64; 2] {
    let [begin, end] = BLEND;
    let place = ((plus - begin) / (end - begin)).clamp(0.0, 1.0);
    [place * place * (3.0 - 2.0 * place), 6.0 * place * (1.0 - place) / (end - begin)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn layer(plus: f64) -> WallLayer {
        WallLayer {
            distance: plus * 1.5e-5 / 0.3,
            normal: [0.0, 0.0, 1.0],
            divergence: 0.0,
            friction_velocity: 0.3,
            kinematic_viscosity: 1.5e-5,
        }
    }

    /// Known of direct simulations of channels (Kim, Moin and Moser 1987; Moser, Kim and Mansour 1999): at the wall
    /// `u' = 0.36 y+` to `0.40 y+`, `w' = 0.2 y+`; largest `u'` 2.6 to 2.8 at y+ of 13 to 18, and `w'` 1.1 to 1.4 at
    /// 35 to
    /// 50. The fit of `w'` is broad and has its largest value at 29.
    #[test]
    fn profiles_are_those_of_simulated_channels() {
        let highest = |law: fn(f64) -> f64| {
            (1..1000)
                .map(|n| 0.1 * f64::from(n))
                .fold([0.0; 2], |best, plus| if law(plus) > best[1] { [plus, law(plus)] } else { best })
        };
        let [place, peak] = highest(streamwise_deviation);
        assert!((12.0..20.0).contains(&place) && (2.5..2.9).contains(&peak), "{place} {peak}");
        let [place, peak] = highest(spanwise_deviation);
        assert!((28.0..50.0).contains(&place) && (1.05..1.4).contains(&peak), "{place} {peak}");
        let near = 0.1;
        assert!((0.36..0.41).contains(&(streamwise_deviation(near) / near)));
        assert!((0.15..0.25).contains(&(spanwise_deviation(near) / near)));
    }

    /// The normal deviation at a Reynolds number of 944 (Hoyas and Jiménez 2006, their data), the flatness at 178
    /// (Moser, Kim and Mansour 1999, theirs).
    #[test]
    fn normal_velocity_is_that_of_simulated_channels() {
        for (plus, flatness) in
            [(0.054, 26.97), (1.34, 21.5), (5.34, 12.41), (10.4, 8.01), (19.0, 5.11), (30.0, 3.82)]
        {
            let [[linear, cubic], _] = normal_shape(plus);
            assert_relative_eq!(linear * linear + 6.0 * cubic * cubic, 1.0, max_relative = 1e-14);
            // Moments of Hermite polynomials of a standard normal number.
            let ours = 3.0 * linear.powi(4)
                + 24.0 * linear.powi(3) * cubic
                + 252.0 * (linear * cubic).powi(2)
                + 1296.0 * linear * cubic.powi(3)
                + 3348.0 * cubic.powi(4);
            assert_relative_eq!(ours, flatness, max_relative = 0.05);
        }
        for (plus, deviation) in [
            (0.125, 1.9307e-4),
            (1.125, 0.013_433),
            (5.277, 0.170_006),
            (10.11, 0.378_206),
            (21.05, 0.720_096),
            (38.03, 0.959_593),
            (80.12, 1.074_331),
        ] {
            let ours = layer(plus).fluctuations(None).deviations[1] / 0.3;
            assert_relative_eq!(ours, deviation, max_relative = 0.03);
        }
    }

    /// In the logarithmic layer, beyond what the wall changes, the eddy diffusivity is `0.41 y+` over a turbulent
    /// Schmidt number of 0.7 to 1.2.
    #[test]
    fn mixing_in_the_logarithmic_layer_is_that_of_von_karman() {
        for plus in [100.0, 150.0, 200.0, 1000.0] {
            let at = layer(plus).fluctuations(None);
            let diffusivity = at.deviations[1].powi(2) * at.time_scale / 1.5e-5;
            let ratio = diffusivity / (0.41 * plus);
            assert!((0.83..1.43).contains(&ratio), "y+ {plus}: {ratio}");
        }
    }

    #[test]
    fn the_gradient_is_the_difference() {
        let core = Core { fluctuation: 0.5, gradient: [0.0; 3], time_scale: 0.01 };
        for plus in [0.01, 1.0, 4.0, 20.0, 31.0, 60.0, 99.0, 500.0] {
            for core in [None, Some(&core)] {
                let step = 1e-5 * plus;
                let at = |plus: f64| layer(plus).fluctuations(core);
                let difference = at(plus + step).deviations[1] - at(plus - step).deviations[1];
                let slope = difference / (layer(2.0 * step).distance);
                let scale = at(plus).deviations[1] / layer(plus).distance;
                assert_relative_eq!(
                    at(plus).normal_gradient,
                    slope,
                    epsilon = 1e-6 * scale,
                    max_relative = 1e-6
                );
                let [first, last] = [plus - step, plus + step].map(|plus| at(plus).shape);
                for part in 0..2 {
                    let slope = (last[part] - first[part]) / layer(2.0 * step).distance;
                    let scale = 1e-6 / layer(plus).distance;
                    assert_relative_eq!(
                        at(plus).shape_gradient[part],
                        slope,
                        epsilon = scale,
                        max_relative = 1e-5
                    );
                }
            }
        }
    }

    /// At a production that balances dissipation, `k = u_tau²/sqrt(0.09)` and `epsilon = u_tau³/(0.41 y)`.
    #[test]
    fn the_core_of_k_and_epsilon_mixes_like_the_wall_layer() {
        let (speed, plus) = (0.3_f64, 90.0);
        let wall = layer(plus);
        let core = Core::uniform(speed * speed / 0.3, speed.powi(3) / (0.41 * wall.distance));
        let ours = core.fluctuation.powi(2) * core.time_scale / 1.5e-5;
        assert!((0.8..1.3).contains(&(ours / (0.41 * plus))), "{ours}");
        assert!(layer(99.0).reaches() && !layer(101.0).reaches());
        let far = layer(101.0).fluctuations(Some(&core));
        far.deviations.into_iter().for_each(|part| assert_relative_eq!(part, core.fluctuation));
        assert_relative_eq!(far.time_scale, core.time_scale);
    }
}
