//! Normal restitution: the share of the speed towards the wall that a particle keeps. One law a file.
//!
//! The laws of [`NormalLaw`] with a variant of their own can be prepared for vectors. All others
//! are listed in [`LISTED_LAWS`]: a new one is one file with a [`ListedNormalLaw`] and one line
//! there; the model file and `nearwall check` then know it, and tests demand its row in the
//! documents.

mod bons;
mod brach_dunn;
mod constant;
mod contact;
mod contact_heat;
mod contact_time;
mod el_batsh;
pub(crate) mod grant_tabakoff;
mod plastic_jkr;
pub(crate) mod tabakoff_wakeman;
mod thornton_ning;
mod whitaker_bons;

pub(crate) use bons::ORIGIN as BONS;
pub use contact::{Contact, LARGEST_CONTACT_RADIUS, reduced_modulus, stiffness_ratio, work_of_adhesion};
pub use contact_heat::{HalfSpace, contact_heat};
pub use contact_time::{Touch, contact_time, touch};
pub use thornton_ning::{
    ThorntonNingConstants, adhesive_velocity, plastic_term, restitution, sticking_velocity, yield_velocity,
};

use crate::impact::Impact;
use crate::input::{InputError, Section};
use crate::law::{Origin, Parameter, ParameterValues, QuantityKind, read_values};

/// Every listed law.
pub static LISTED_LAWS: [&ListedNormalLaw; 6] = [
    &brach_dunn::BRACH_DUNN,
    &el_batsh::EL_BATSH,
    &bons::BONS,
    &whitaker_bons::WHITAKER_BONS,
    &grant_tabakoff::GRANT_TABAKOFF,
    &tabakoff_wakeman::TABAKOFF_WAKEMAN,
];

/// The kinds of the numbers of the laws that are not listed.
pub(crate) const NORMAL_KINDS: [(&str, QuantityKind); 1] = [("e_n", QuantityKind::Share)];

/// A law that may depend on every input of an impact, with its parameters and the case to which it was fitted.
#[derive(Debug)]
pub struct ListedNormalLaw {
    /// The name in model files.
    pub name: &'static str,
    /// Source, case and range.
    pub origin: &'static Origin,
    /// Its parameters, at most [`MOST_PARAMETERS`](crate::law::MOST_PARAMETERS).
    pub parameters: &'static [Parameter],
    /// Normal restitution [1] from the values of the parameters; `None` when the particle sticks.
    pub restitution: fn(&Impact, &Contact, &ParameterValues) -> Option<f64>,
    /// Sticking velocity [m/s] at the size and the temperatures of an impact; `None` for a law
    /// under which no particle sticks.
    pub sticking_velocity: Option<fn(&Impact, &Contact, &ParameterValues) -> f64>,
}

/// Laws are equal when their names are.
impl PartialEq for ListedNormalLaw {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

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
    /// A law of [`LISTED_LAWS`].
    Listed {
        /// The law.
        law: &'static ListedNormalLaw,
        /// The values of its parameters.
        values: ParameterValues,
    },
}

impl NormalLaw {
    /// Reads the `model` of a `[normal]` table and the law's own keys.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an unknown law or a value out of bounds.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        let mut names = vec!["thornton-ning", "thornton-ning-raised-pull-off", "constant"];
        names.extend(LISTED_LAWS.map(|law| law.name));
        let word = section.choice("model", &names)?;
        let named = |law: &&&'static ListedNormalLaw| Some(law.name) == word.as_deref();
        if let Some(&law) = LISTED_LAWS.iter().find(named) {
            return Ok(Self::Listed { law, values: read_values(section, law.parameters)? });
        }
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
            Self::Listed { law, .. } => law.name,
        }
    }

    /// Normal restitution [1] of a particle of `diameter` [m] that hits head-on at `normal_speed`
    /// [m/s], without temperatures; `None` when adhesion holds it.
    pub fn restitution(self, contact: &Contact, diameter: f64, normal_speed: f64) -> Option<f64> {
        self.rebound(contact, &Impact { diameter, normal_speed, ..Impact::default() })
    }

    /// Normal restitution [1] of an impact; `None` when adhesion holds the particle.
    #[inline(always)]
    pub fn rebound(self, contact: &Contact, impact: &Impact) -> Option<f64> {
        let e_n = match self {
            Self::ThorntonNing => {
                let constants = ThorntonNingConstants::new(contact);
                let adhesion = constants.adhesive_pressure(impact.diameter);
                constants.energy(contact.density, impact.normal_speed, adhesion).sqrt()
            }
            Self::PlasticJkr => plastic_jkr::restitution(
                impact.normal_speed,
                adhesive_velocity(contact, impact.diameter),
                yield_velocity(contact),
            ),
            Self::Constant { restitution } => return Some(restitution),
            Self::Listed { law, values } => return (law.restitution)(impact, contact, &values),
        };
        (e_n > 0.0).then_some(e_n)
    }

    /// The case to which a listed law was fitted.
    pub fn origin(self) -> Option<&'static Origin> {
        match self {
            Self::Listed { law, .. } => Some(law.origin),
            _ => None,
        }
    }

    /// Whether the law describes the contact of two solids.
    #[inline(always)]
    pub fn is_contact_law(self) -> bool {
        match self {
            Self::ThorntonNing | Self::PlasticJkr => true,
            Self::Constant { .. } | Self::Listed { .. } => false,
        }
    }

    /// Whether there are speeds under which particles stick by this law.
    pub fn has_sticking_velocity(self) -> bool {
        match self {
            Self::Listed { law, .. } => law.sticking_velocity.is_some(),
            _ => self.is_contact_law(),
        }
    }

    /// Whether the law is stated for an impact: the contact radius has to stay below
    /// [`LARGEST_CONTACT_RADIUS`] times that of the particle, and a listed law has the range of its
    /// fit.
    #[inline(always)]
    pub fn holds_for(self, contact: &Contact, impact: &Impact) -> bool {
        match self {
            Self::ThorntonNing | Self::PlasticJkr => {
                contact.density * impact.normal_speed * impact.normal_speed
                    <= contact.largest_impact_pressure()
            }
            Self::Constant { .. } => true,
            Self::Listed { law, .. } => law.origin.holds_for(impact),
        }
    }

    /// Adhesive, yield and sticking velocity of a particle of `diameter` [m], without temperatures;
    /// for a law under which no particle sticks those of Thornton–Ning.
    pub fn speeds(self, contact: &Contact, diameter: f64) -> Speeds {
        self.speeds_of(contact, &Impact { diameter, ..Impact::default() })
    }

    /// The same at the size and the temperatures of an impact.
    pub fn speeds_of(self, contact: &Contact, impact: &Impact) -> Speeds {
        let plain = thornton_ning::speeds(contact, impact.diameter);
        match self {
            Self::ThorntonNing | Self::Constant { .. } => plain,
            Self::PlasticJkr => {
                let [yielding, sticking] = plastic_jkr::speeds(plain.adhesive, plain.yielding);
                Speeds { yielding, sticking, ..plain }
            }
            Self::Listed { law, values } => {
                let sticking = law.sticking_velocity.map(|sticking| sticking(impact, contact, &values));
                Speeds { sticking: sticking.unwrap_or(plain.sticking), ..plain }
            }
        }
    }
}
