//! Tangential restitution: the share of the speed along the wall that a particle keeps. One law a file.
//!
//! The laws of [`TangentialLaw`] with a variant of their own can be prepared for vectors. All
//! others are listed in [`LISTED_LAWS`]: a new one is one file with a [`ListedTangentialLaw`] and
//! one line there; the model file and `nearwall check` then know it, and tests demand its row in
//! the documents.

mod bons;
mod constant;
mod grant_tabakoff;
mod maw_barber_fawcett;
mod sliding;
mod sliding_rolling;
mod tabakoff_wakeman;

pub use sliding_rolling::critical_angle;

use crate::impact::Impact;
use crate::input::{InputError, Section};
use crate::law::{Origin, Parameter, ParameterValues, QuantityKind, read_values};

/// Every listed law.
pub static LISTED_LAWS: [&ListedTangentialLaw; 4] = [
    &maw_barber_fawcett::MAW_BARBER_FAWCETT,
    &bons::BONS,
    &grant_tabakoff::GRANT_TABAKOFF,
    &tabakoff_wakeman::TABAKOFF_WAKEMAN,
];

/// The kinds of the numbers of the laws that are not listed.
pub(crate) const TANGENTIAL_KINDS: [(&str, QuantityKind); 2] =
    [("e_t", QuantityKind::Share), ("friction", QuantityKind::Share)];

/// A law with its parameters and the case to which it was fitted.
#[derive(Debug)]
pub struct ListedTangentialLaw {
    /// The name in model files.
    pub name: &'static str,
    /// Source, case and range.
    pub origin: &'static Origin,
    /// Its parameters, at most [`MOST_PARAMETERS`](crate::law::MOST_PARAMETERS).
    pub parameters: &'static [Parameter],
    /// Tangential restitution and spin from the values of the parameters.
    pub rebound: fn(&ImpactKinematics, &ParameterValues) -> Rebound,
}

/// Laws are equal when their names are.
impl PartialEq for ListedTangentialLaw {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

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

    /// Angle between path and surface [rad]: 0 glancing, pi/2 head-on.
    fn angle_from_surface(&self) -> f64 {
        self.normal_speed.abs().atan2(self.tangential_speed.abs())
    }

    /// The rebound with a speed along the wall [m/s] and the spin `omega_0 + x/d`; `at_rest` is
    /// `e_t` of a head-on impact.
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
    /// A law of [`LISTED_LAWS`].
    Listed {
        /// The law.
        law: &'static ListedTangentialLaw,
        /// The values of its parameters.
        values: ParameterValues,
    },
}

impl TangentialLaw {
    /// Reads a `[tangential]` table.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown law or a value out of bounds.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let mut names = vec!["constant", "sliding", "sliding-rolling"];
        names.extend(LISTED_LAWS.map(|law| law.name));
        let word = section.choice("model", &names)?;
        let named = |law: &&&'static ListedTangentialLaw| Some(law.name) == word.as_deref();
        if let Some(&law) = LISTED_LAWS.iter().find(named) {
            return Ok(Self::Listed { law, values: read_values(section, law.parameters)? });
        }
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
            Self::Listed { law, .. } => law.name,
        }
    }

    /// Whether the law is stated for an impact; a law without a case to which it was fitted holds for all.
    pub fn holds_for(self, impact: &Impact) -> bool {
        self.origin().is_none_or(|origin| origin.holds_for(impact))
    }

    /// The case to which a listed law was fitted.
    pub fn origin(self) -> Option<&'static Origin> {
        match self {
            Self::Listed { law, .. } => Some(law.origin),
            _ => None,
        }
    }

    /// Its friction coefficient [1]; `None` for a law without one.
    pub fn friction(self) -> Option<f64> {
        match self {
            Self::Constant { .. } => None,
            Self::Sliding { friction } | Self::SlidingRolling { friction } => Some(friction),
            Self::Listed { law, values } => {
                let place = law.parameters.iter().position(|parameter| parameter.name == "friction")?;
                values.get(place).copied()
            }
        }
    }

    /// Tangential restitution and spin after the impact. Without tangential speed the restitution
    /// is its limit for a small one.
    #[inline(always)]
    pub fn rebound(self, kinematics: &ImpactKinematics) -> Rebound {
        match self {
            Self::Constant { restitution } => Rebound { restitution, spin: kinematics.spin },
            Self::Sliding { friction } => sliding::rebound(friction, kinematics),
            Self::SlidingRolling { friction } => sliding_rolling::rebound(friction, kinematics),
            Self::Listed { law, values } => (law.rebound)(kinematics, &values),
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
