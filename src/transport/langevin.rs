//! The normalised Langevin walk: the fluctuating velocity of the gas along the path of a particle.
//!
//! The walk `w` is a vector of standard normal numbers. It follows an Ornstein–Uhlenbeck process,
//!
//! `dw = (-w/tau + A/(1 + St)) dt + sqrt(2/tau) dW`, `u' = R w`, `A = div R`, `St = tau_p/tau`,
//!
//! with `R = sigma_3 I + (sigma_2 - sigma_3) n n + (sigma_1 - sigma_3) s s` of the standard deviations [m/s] along the
//! flow (`s`), away from the wall (`n`) and across, `tau` the Lagrangian time scale [s], `tau_p` the relaxation time of
//! the particle [s]. `A` [1/s] is the drift correction: beside a plane wall `n` times the slope of `sigma_2`. Without
//! it particles gather where the fluctuations are weak; with it a tracer stays mixed, since the uniform density times
//! the normal distribution of `w` is a stationary solution of the Fokker–Planck equation. A heavy particle does not
//! follow the gas and sees less of it, by `1 + St`.
//!
//! Bocksell and Loth, Int. J. Multiphase Flow 32 (2006) 1234; Dehbi, Int. J. Multiphase Flow 34 (2008) 819 and 36
//! (2010); second source of the drift: the well-mixed condition of Thomson (1987), from which it is derived above. The
//! components are drawn independently: the shear stress of the fluctuations is left out, and with it the drift along
//! the flow.
//!
//! A step is exact for a `tau` and `A` that do not change in it, however long it is:
//! `w' = a w + (1 - a) tau A/(1 + St) + sqrt(1 - a²) xi`, `a = exp(-dt/tau)`, `xi` standard normal. The path takes the
//! fluctuation from the walk of the step and the place that the particle has reached in it; steps of up to
//! [`GasTurbulence::longest_step`] then give a deposition that does not depend on them (measured, see the tests).

use super::near_wall::{Core, WallLayer};

/// Longest step over the Lagrangian time scale [1].
const STEP_SHARE: f64 = 0.2;

/// The turbulence at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GasTurbulence {
    /// Standard deviation of the velocity along the flow, away from the wall and across [m/s].
    pub deviations: [f64; 3],
    /// Direction of the flow along the wall, of length 1; zero for gas at rest.
    pub along: [f64; 3],
    /// Direction away from the wall, of length 1; zero far from walls.
    pub normal: [f64; 3],
    /// Drift `A` of the walk [1/s].
    pub drift: [f64; 3],
    /// Lagrangian time scale [s].
    pub time_scale: f64,
}

impl GasTurbulence {
    /// Beside a wall, in a mean flow with the velocity `flow` [m/s], whose direction alone counts. Without a `core` it
    /// is that of the wall's friction velocity.
    pub fn beside(wall: &WallLayer, core: Option<&Core>, flow: [f64; 3]) -> Self {
        let at = wall.fluctuations(core);
        let [_, normal, across] = at.deviations;
        let drift = at.normal_gradient + (normal - across) * wall.divergence;
        let of_core = core.map_or([0.0; 3], |core| core.gradient.map(|slope| at.core_share * slope));
        Self {
            deviations: at.deviations,
            along: direction(sum(flow, wall.normal, -dot(flow, wall.normal))),
            normal: wall.normal,
            drift: sum(of_core, wall.normal, drift),
            time_scale: at.time_scale,
        }
    }

    /// Far from walls.
    pub fn free(core: &Core) -> Self {
        Self {
            deviations: [core.fluctuation; 3],
            along: [0.0; 3],
            normal: [0.0; 3],
            drift: core.gradient,
            time_scale: core.time_scale,
        }
    }

    /// Fluctuating velocity [m/s] of a walk [1] here.
    pub fn velocity(&self, walk: [f64; 3]) -> [f64; 3] {
        let [along, normal, across] = self.deviations;
        let even = walk.map(|part| across * part);
        let with_normal = sum(even, self.normal, (normal - across) * dot(walk, self.normal));
        sum(with_normal, self.along, (along - across) * dot(walk, self.along))
    }

    /// The walk [1] after a step of a `duration` [s] that ends here, for a particle with a relaxation time [s].
    /// `draws` are three independent standard normal numbers.
    pub fn advance(&self, walk: [f64; 3], relaxation_time: f64, duration: f64, draws: [f64; 3]) -> [f64; 3] {
        let steps = duration / self.time_scale;
        let kept = (-steps).exp();
        let spread = (-(-2.0 * steps).exp_m1()).sqrt();
        let pushed = -(-steps).exp_m1() * self.time_scale / (1.0 + relaxation_time / self.time_scale);
        std::array::from_fn(|i| kept * walk[i] + pushed * self.drift[i] + spread * draws[i])
    }

    /// Longest step [s] whose walk may be taken as constant on the path: a fifth of the Lagrangian time.
    pub fn longest_step(&self) -> f64 {
        STEP_SHARE * self.time_scale
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
