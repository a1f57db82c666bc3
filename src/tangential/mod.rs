//! Tangential restitution: the share of the speed along the wall that a particle keeps. One law a file.

mod constant;
mod sliding;
mod sliding_rolling;

pub use sliding_rolling::critical_angle;

use crate::input::{InputError, Section};

/// The quantities of an impact that a tangential law uses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactKinematics {
    /// Speed towards the wall `v_n` [m/s].
    pub normal_speed: f64,
    /// Speed along the wall `v_t` [m/s].
    pub tangential_speed: f64,
    /// Particle diameter `d` [m].
    pub diameter: f64,
    /// Spin before the impact `omega` [rad/s].
    pub spin: f64,
    /// Normal restitution `e_n` [1].
    pub normal_restitution: f64,
    /// Mindlin's stiffness ratio `k` [1].
    pub stiffness_ratio: f64,
}

impl ImpactKinematics {
    /// Speed of the contact point along the wall [m/s].
    #[inline(always)]
    fn slip(&self) -> f64 {
        self.tangential_speed - 0.5 * self.diameter * self.spin
    }

    /// The rebound with a speed along the wall [m/s] and the spin `omega_0 + x/d`; `at_rest` is `e_t` of a head-on impact.
    #[inline(always)]
    fn rebound(&self, [speed, omega_0, x]: [f64; 3], at_rest: f64) -> Rebound {
        let ratio = speed / self.tangential_speed;
        Rebound {
            restitution: if self.tangential_speed > 0.0 { ratio } else { at_rest },
            spin: omega_0 + x / self.diameter,
        }
    }
}

/// Tangential restitution and spin after the impact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rebound {
    /// Tangential restitution `e_t` [1].
    pub restitution: f64,
    /// Spin [rad/s].
    pub spin: f64,
}

/// The law that gives the tangential restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TangentialLaw {
    /// The same number for every impact.
    Constant {
        /// Tangential restitution `e_t` [1].
        restitution: f64,
    },
    /// Gross sliding with a friction coefficient `f` [1].
    Sliding {
        /// Friction coefficient `f` [1].
        friction: f64,
    },
    /// Sliding at glancing angles, rolling at steep ones.
    SlidingRolling {
        /// Friction coefficient `f` [1].
        friction: f64,
    },
}

impl TangentialLaw {
    /// Reads a `[tangential]` table.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown law or a value out of bounds.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let word = section.choice("model", &["constant", "sliding", "sliding-rolling"])?;
        let friction = |s: &Section<'_>| {
            s.number_within("friction", 0.0, f64::INFINITY)?
                .ok_or_else(|| s.missing("friction", "a friction coefficient"))
        };
        match word.as_deref() {
            Some("constant") => Ok(Self::Constant { restitution: constant::read(section)? }),
            Some("sliding") => Ok(Self::Sliding { friction: friction(section)? }),
            Some(_) => Ok(Self::SlidingRolling { friction: friction(section)? }),
            None => Err(section.missing("model", "\"constant\", \"sliding\" or \"sliding-rolling\"")),
        }
    }

    /// The name in model files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Constant { .. } => "constant",
            Self::Sliding { .. } => "sliding",
            Self::SlidingRolling { .. } => "sliding-rolling",
        }
    }

    /// Tangential restitution and spin after the impact. Without tangential speed the restitution is its limit for a small one.
    #[inline(always)]
    pub fn rebound(self, kinematics: &ImpactKinematics) -> Rebound {
        match self {
            Self::Constant { restitution } => Rebound { restitution, spin: kinematics.spin },
            Self::Sliding { friction } => sliding::rebound(friction, kinematics),
            Self::SlidingRolling { friction } => sliding_rolling::rebound(friction, kinematics),
        }
    }
}

/// Helpers for the tests of tangential laws and effects.
#[cfg(test)]
pub(crate) mod testing {
    use super::{ImpactKinematics, Rebound};
    use approx::assert_relative_eq;

    /// Wax that hits at 1 m/s under `alpha` [degrees] from the surface.
    pub fn kinematics(alpha: f64, spin: f64) -> ImpactKinematics {
        let (normal_speed, tangential_speed) = alpha.to_radians().sin_cos();
        ImpactKinematics {
            normal_speed,
            tangential_speed,
            diameter: 75e-6,
            spin,
            normal_restitution: 0.39,
            stiffness_ratio: 0.676,
        }
    }

    /// A rigid sphere keeps its angular momentum about the contact point: `u + (2/5)(d/2) omega`.
    pub fn momentum_is_kept(rebound: impl Fn(&ImpactKinematics) -> Rebound) {
        for alpha in [5.0, 20.0, 40.0, 44.0, 60.0, 85.0] {
            for spin in [-3e5, -1e4, 0.0, 1e4, 3e5] {
                let before = kinematics(alpha, spin);
                let after = rebound(&before);
                let momentum = |u: f64, omega: f64| u + 0.2 * before.diameter * omega;
                let left = momentum(after.restitution * before.tangential_speed, after.spin);
                let came = momentum(before.tangential_speed, spin);
                assert_relative_eq!(left, came, max_relative = 1e-12, epsilon = 1e-12);
            }
        }
    }
}
