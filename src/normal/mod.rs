//! Normal impact: how much of the speed towards the wall comes back. One law a file.

mod constant;
mod contact;
pub mod doublet;
mod thornton_ning;

pub use contact::{Contact, reduced_modulus, stiffness_ratio};
pub use thornton_ning::{
    Speeds, adhesive_velocity, plastic_term, restitution, sticking_velocity, yield_velocity,
};

use crate::input::{InputError, Section};

/// The law that gives the normal restitution of a dry impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NormalLaw {
    /// Elastic–perfectly plastic with adhesion.
    ThorntonNing,
    /// The same number for every impact that does not stick.
    Constant {
        /// Normal restitution `e_n` [1].
        restitution: f64,
    },
}

impl NormalLaw {
    /// Reads the `model` of a `[normal]` table and the law's own keys.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown law or a value out of bounds.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let word = section.choice("model", &["thornton-ning", "constant"])?;
        match word.as_deref() {
            Some("constant") => Ok(Self::Constant { restitution: constant::read(section)? }),
            _ => Ok(Self::ThorntonNing),
        }
    }

    /// The name in model files.
    pub fn name(self) -> &'static str {
        match self {
            Self::ThorntonNing => "thornton-ning",
            Self::Constant { .. } => "constant",
        }
    }

    /// Normal restitution [1] of a particle of `diameter` [m] that hits at `normal_speed` [m/s]; `None` when
    /// adhesion holds it.
    pub fn restitution(self, contact: &Contact, diameter: f64, normal_speed: f64) -> Option<f64> {
        match self {
            Self::ThorntonNing => {
                let adhesive = adhesive_velocity(contact, diameter);
                let e_n = restitution(normal_speed, adhesive, yield_velocity(contact));
                (e_n > 0.0).then_some(e_n)
            }
            Self::Constant { restitution } => Some(restitution),
        }
    }
}
