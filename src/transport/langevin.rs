//! The normalised Langevin walk: the fluctuating velocity of the gas along the path of a particle.
//!
//! The walk `w` is a vector of standard normal numbers. It follows an Ornstein–Uhlenbeck process,
//!
//! `dw = (-w/tau_w + A/(1 + St)) dt + sqrt(2/tau_w) dW`, `u' = R w + sigma_2 c_3 (w_n³ - 3 w_n) n`, `w_n = n w`,
//! `A = div R + n div(n sigma_2 c_3) (w_n² - 1)`, `St = tau_p/tau_w`,
//!
//! with `R = sigma_3 I + (c_1 sigma_2 - sigma_3) n n + (sigma_1 - sigma_3) s s` of the standard deviations [m/s] along
//! the flow (`s`), away from the wall (`n`) and across, `c_1` and `c_3` the shape of the distribution away from the
//! wall ([`super::near_wall`]) and `tau_p` the relaxation time of the particle [s]. The time of the walk is `tau_w =
//! tau/(c_1² + 2 c_3²)` [s], so that `tau` is the integral time of the velocity away from the wall: the cube of a walk
//! forgets three times as fast. `A` [1/s] is the drift correction. Without it particles gather where the fluctuations
//! are weak; with it a tracer stays mixed, since the uniform density times the normal distribution `f` of `w` is a
//! stationary solution of the Fokker–Planck equation: `div(u' f) + div_w(A f) = 0` with `d/dw (He_2 f) = -He_3 f`. A
//! heavy particle does not follow the gas and sees less of the drift, by `1 + St`.
//!
//! Bocksell and Loth, Int. J. Multiphase Flow 32 (2006) 1234; Dehbi, Int. J. Multiphase Flow 34 (2008) 819 and 36
//! (2010), both with `c_3 = 0`, which lets too few fine particles arrive (as Jin, Potts and Reeks, Phys. Fluids 27
//! (2015) 053305, found of such walks); second source of the drift: the well-mixed condition of Thomson (1987), from
//! which it is derived above. The
//! components are drawn independently: the shear stress of the fluctuations is left out, and with it the drift along
//! the flow.
//!
//! A step is exact for a `tau` and `A` that do not change in it, however long it is:
//! `w' = a w + (1 - a) tau_w A/(1 + St) + sqrt(1 - a²) xi`, `a = exp(-dt/tau_w)`, `xi` standard normal. The path
//! takes the fluctuation from the walk of the step and the place that the particle has reached in it; steps of up to
//! [`GasTurbulence::longest_step`] then give a deposition that does not depend on them (measured, see the tests).

use super::near_wall::{Core, WallLayer};

/// Longest step over the Lagrangian time scale [1] where a wall changes the fluctuations, and in the core. A walk that
/// stays what it is for a share `h` of that time mixes `(h/2) coth(h/2)` times as fast: by 2 % at 0.5.
const STEP_SHARES: [f64; 2] = [0.2, 0.5];

/// The turbulence at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GasTurbulence {
    /// Standard deviation of the velocity along the flow, away from the wall and across [m/s].
    pub deviations: [f64; 3],
    /// Direction of the flow along the wall, of length 1; zero for gas at rest.
    pub along: [f64; 3],
    /// Direction away from the wall, of length 1; zero far from walls.
    pub normal: [f64; 3],
    /// `c_1` and `c_3` of the velocity away from the wall [1].
    pub shape: [f64; 2],
    /// Drift `div R` of the walk [1/s].
    pub drift: [f64; 3],
    /// Factor of `w_n² - 1` in its drift away from the wall [1/s].
    pub sweep_drift: f64,
    /// Lagrangian time scale [s].
    pub time_scale: f64,
}

impl GasTurbulence {
    /// Beside a wall, in a mean flow with the velocity `flow` [m/s], whose direction alone counts. Without a `core` it
    /// is that of the wall's friction velocity.
    pub fn beside(wall: &WallLayer, core: Option<&Core>, flow: [f64; 3]) -> Self {
        let at = wall.fluctuations(core);
        let ([_, normal, across], [linear, cubic]) = (at.deviations, at.shape);
        let of_core = core.map_or([0.0; 3], |core| core.gradient.map(|slope| at.core_share * slope));
        let gradient = at.normal_gradient + dot(of_core, wall.normal);
        let [drift, sweep_drift] = [[linear, across], [cubic, 0.0]]
            .map(|[part, across]| part * gradient + (part * normal - across) * wall.divergence);
        let [linear_change, cubic_change] = at.shape_gradient.map(|slope| slope * normal);
        let drift = drift + linear_change - dot(of_core, wall.normal);
        Self {
            deviations: at.deviations,
            along: direction(sum(flow, wall.normal, -dot(flow, wall.normal))),
            normal: wall.normal,
            shape: at.shape,
            drift: sum(of_core, wall.normal, drift),
            sweep_drift: sweep_drift + cubic_change,
            time_scale: at.time_scale,
        }
    }

    /// Far from walls.
    pub fn free(core: &Core) -> Self {
        Self {
            deviations: [core.fluctuation; 3],
            along: [0.0; 3],
            normal: [0.0; 3],
            shape: [1.0, 0.0],
            drift: core.gradient,
            sweep_drift: 0.0,
            time_scale: core.time_scale,
        }
    }

    /// Fluctuating velocity [m/s] of a walk [1] here.
    pub fn velocity(&self, walk: [f64; 3]) -> [f64; 3] {
        let ([along, normal, across], [linear, cubic]) = (self.deviations, self.shape);
        let even = walk.map(|part| across * part);
        let away = dot(walk, self.normal);
        let shaped = normal * (linear + cubic * (away * away - 3.0)) * away;
        let with_normal = sum(even, self.normal, shaped - across * away);
        sum(with_normal, self.along, (along - across) * dot(walk, self.along))
    }

    /// The walk [1] after a step of a `duration` [s] that ends here, for a particle with a relaxation time [s].
    /// `draws` are three independent standard normal numbers.
    pub fn advance(&self, walk: [f64; 3], relaxation_time: f64, duration: f64, draws: [f64; 3]) -> [f64; 3] {
        let [linear, cubic] = self.shape;
        let time = self.time_scale / (linear * linear + 2.0 * cubic * cubic);
        let steps = duration / time;
        let kept = (-steps).exp();
        let spread = (-(-2.0 * steps).exp_m1()).sqrt();
        let pushed = -(-steps).exp_m1() * time / (1.0 + relaxation_time / time);
        let away = dot(walk, self.normal);
        let drift = sum(self.drift, self.normal, self.sweep_drift * (away * away - 1.0));
        std::array::from_fn(|i| kept * walk[i] + pushed * drift[i] + spread * draws[i])
    }

    /// Longest step [s] whose walk may be taken as constant on the path: a fifth of the Lagrangian time beside a wall,
    /// half of it in the core.
    pub fn longest_step(&self) -> f64 {
        let [beside, core] = STEP_SHARES;
        let is_core = self.shape == [1.0, 0.0];
        self.time_scale * if is_core { core } else { beside }
    }
}

fn dot(one: [f64; 3], other: [f64; 3]) -> f64 {
    one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
}

/// `one + factor other`.
fn sum(one: [f64; 3], other: [f64; 3], factor: f64) -> [f64; 3] {
    std::array::from_fn(|i| one[i] + factor * other[i])
}

/// The vector at length 1; zero if it has none.
fn direction(vector: [f64; 3]) -> [f64; 3] {
    let length = dot(vector, vector).sqrt();
    if length > 1e-12 { vector.map(|part| part / length) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A uniform density of tracers times the normal distribution `f` of the walk is stationary beside a plane wall:
    /// `d/dy (v f) + d/dw (A f) = 0`, both derivatives taken as differences.
    #[test]
    fn a_tracer_stays_mixed() {
        let at = |plus: f64| {
            let wall = WallLayer {
                distance: plus,
                normal: [0.0, 0.0, 1.0],
                divergence: 0.0,
                friction_velocity: 1.0,
                kinematic_viscosity: 1.0,
            };
            GasTurbulence::beside(&wall, None, [1.0, 0.0, 0.0])
        };
        let density = |walk: f64| (-0.5 * walk * walk).exp();
        for plus in [0.3, 2.0, 8.0, 25.0, 50.0, 90.0] {
            for walk in [-3.0, -1.2, 0.0, 0.4, 2.1] {
                let step = 1e-5;
                let speed = |plus: f64| at(plus).velocity([0.0, 0.0, walk])[2];
                let flux = (speed(plus + step) - speed(plus - step)) / (2.0 * step) * density(walk);
                let here = at(plus);
                // The drift is what a short step without a draw adds to the decay of the walk.
                let drift = |walk: f64| {
                    let duration = 1e-6;
                    let after = here.advance([0.0, 0.0, walk], 0.0, duration, [0.0; 3])[2];
                    let still = GasTurbulence { drift: [0.0; 3], sweep_drift: 0.0, ..here };
                    (after - still.advance([0.0, 0.0, walk], 0.0, duration, [0.0; 3])[2]) / duration
                };
                let along = |walk: f64| drift(walk) * density(walk);
                let turned = (along(walk + step) - along(walk - step)) / (2.0 * step);
                let scale = here.deviations[1] / plus;
                assert!((flux + turned).abs() < 1e-3 * scale, "{plus} {walk}: {flux} {turned}");
            }
        }
    }
}
