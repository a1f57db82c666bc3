//! Normal restitution: the share of the speed towards the wall that a particle keeps. One law a file.

mod constant;
mod contact;
mod plastic_jkr;
mod thornton_ning;

pub use contact::{Contact, LARGEST_CONTACT_RADIUS, reduced_modulus, stiffness_ratio};
pub use thornton_ning::{
    Prepared, adhesive_velocity, plastic_term, restitution, sticking_velocity, yield_velocity,
};

use crate::input::{InputError, Section};

/// The speeds that separate sticking, elastic and plastic impacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Speeds {
    /// Adhesive velocity `v_adh` [m/s].
    pub adhesive: f64,
    /// Yield velocity `v_y` [m/s].
    pub yielding: f64,
    /// Sticking velocity `v_s` [m/s]: slower impacts do not rebound.
    pub sticking: f64,
}

/// The law that gives the normal restitution of a dry impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NormalLaw {
    /// Thornton–Ning: elastic–perfectly plastic with adhesion.
    ThorntonNing,
    /// The same contact with its pull-off raised by yielding; `thornton-ning-raised-pull-off` in model files.
    PlasticJkr,
    /// The same restitution for every impact.
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
        let word =
            section.choice("model", &["thornton-ning", "thornton-ning-raised-pull-off", "constant"])?;
        match word.as_deref() {
            Some("thornton-ning-raised-pull-off") => Ok(Self::PlasticJkr),
            Some("constant") => Ok(Self::Constant { restitution: constant::read(section)? }),
            _ => Ok(Self::ThorntonNing),
        }
    }

    /// The name in model files.
    pub fn name(self) -> &'static str {
        match self {
            Self::ThorntonNing => "thornton-ning",
            Self::PlasticJkr => "thornton-ning-raised-pull-off",
            Self::Constant { .. } => "constant",
        }
    }

    /// Normal restitution [1] of a particle of `diameter` [m] that hits at `normal_speed` [m/s]; `None` when
    /// adhesion holds it.
    pub fn restitution(self, contact: &Contact, diameter: f64, normal_speed: f64) -> Option<f64> {
        let e_n = match self {
            Self::ThorntonNing => Prepared::new(contact).restitution(contact.density, diameter, normal_speed),
            Self::PlasticJkr => plastic_jkr::restitution(
                normal_speed,
                adhesive_velocity(contact, diameter),
                yield_velocity(contact),
            ),
            Self::Constant { restitution } => return Some(restitution),
        };
        (e_n > 0.0).then_some(e_n)
    }

    /// Whether the law describes the contact of two solids.
    pub fn is_contact_law(self) -> bool {
        match self {
            Self::ThorntonNing | Self::PlasticJkr => true,
            Self::Constant { .. } => false,
        }
    }

    /// Whether the law is stated for a speed towards the wall [m/s]: the contact radius has to stay below
    /// [`LARGEST_CONTACT_RADIUS`] times that of the particle.
    pub fn holds_for(self, contact: &Contact, normal_speed: f64) -> bool {
        !self.is_contact_law()
            || contact.density * normal_speed * normal_speed <= contact.largest_impact_pressure()
    }

    /// Adhesive, yield and sticking velocity of a particle of `diameter` [m]; for the constant law those of Thornton–Ning.
    pub fn speeds(self, contact: &Contact, diameter: f64) -> Speeds {
        let plain = thornton_ning::speeds(contact, diameter);
        match self {
            Self::ThorntonNing | Self::Constant { .. } => plain,
            Self::PlasticJkr => {
                let [yielding, sticking] = plastic_jkr::speeds(plain.adhesive, plain.yielding);
                Speeds { yielding, sticking, ..plain }
            }
        }
    }
}
