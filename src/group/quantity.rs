//! What groups are computed from.

use super::ProductGroup;
use crate::impact::Impact;

/// A quantity of an impact on a wall that its inputs alone may not give.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Density of the particle [kg/m³].
    Density,
    /// Viscosity of the particle's liquid [Pa s].
    Viscosity,
    /// Surface tension of the particle's liquid [N/m].
    SurfaceTension,
    /// Sticking velocity of the normal law [m/s].
    StickingVelocity,
    /// Yield velocity of the normal law [m/s].
    YieldVelocity,
    /// Melting point of the particle [K].
    MeltingPoint,
    /// Viscosity at and below which every impact sticks, by the capture criterion [Pa s].
    ReferenceViscosity,
    /// Viscosity of the liquid film on the wall [Pa s].
    FilmViscosity,
    /// Viscosity of the gas [Pa s].
    GasViscosity,
    /// `e_n` before fitted corrections [1].
    NormalRestitution,
    /// Friction coefficient of the tangential law, 1 where it has none [1].
    Friction,
}

/// What gives a quantity, in words.
struct Provision {
    /// The quantity in words.
    words: &'static str,
    /// The input that a model file may declare for it.
    input: Option<&'static str>,
    /// What in a model file gives it, an instruction; empty where every model does or only the input can.
    remedy: &'static str,
}

impl Quantity {
    /// The quantity in words.
    pub fn words(self) -> &'static str {
        self.provision().words
    }

    /// Name of the input of a model file, `[inputs.NAME]`, or of the column that states it for each impact.
    pub fn input(self) -> Option<&'static str> {
        self.provision().input
    }

    /// What to add to a model file that lacks the quantity.
    pub fn remedy(self) -> String {
        let Provision { input, remedy, .. } = self.provision();
        let declare = input.map(|input| format!("declare [inputs.{input}]"));
        match (remedy, declare) {
            ("", declare) => declare.unwrap_or_default(),
            (remedy, Some(declare)) => format!("{remedy}, or {declare}"),
            (remedy, None) => remedy.to_owned(),
        }
    }

    const fn provision(self) -> Provision {
        let (words, input, remedy) = match self {
            Self::Density => ("the density of the particle", None, ""),
            Self::Viscosity => (
                "the viscosity of the particle's liquid",
                Some("mu_p"),
                "give viscosity to the particle's material, or a composition and a law in [capture]",
            ),
            Self::SurfaceTension => (
                "the surface tension of the particle's liquid",
                Some("sigma_p"),
                "give surface_tension to the particle's material",
            ),
            Self::StickingVelocity => (
                "a sticking velocity",
                None,
                "choose a [normal] model that has one, for instance \"thornton-ning\"",
            ),
            Self::YieldVelocity => {
                ("a yield velocity", None, "choose [normal] model = \"thornton-ning\", which has one")
            }
            Self::MeltingPoint => {
                ("the melting point of the particle", None, "give melting_point to the particle's material")
            }
            Self::ReferenceViscosity => (
                "a reference viscosity",
                None,
                "choose [capture] model = \"viscosity\" or \"kinetic-energy\"",
            ),
            Self::FilmViscosity => (
                "the viscosity of the film on the wall",
                Some("mu_film"),
                "give slag to a wall, or viscosity to the effect \"liquid-film\"",
            ),
            Self::GasViscosity => ("the viscosity of the gas", Some("mu_gas"), ""),
            Self::NormalRestitution => ("e_n before fitted corrections", None, ""),
            Self::Friction => ("the friction coefficient", None, ""),
        };
        Provision { words, input, remedy }
    }
}

/// An impact on a wall of a model, as groups see it.
pub trait Circumstances {
    /// The impact with what lies on the wall as a whole.
    fn impact(&self) -> &Impact;

    /// A quantity, in the unit of [`Quantity`]; NaN where it is not known for this impact.
    fn quantity(&self, quantity: Quantity) -> f64;

    /// The groups that the model file declares.
    fn products(&self) -> &[ProductGroup];
}
