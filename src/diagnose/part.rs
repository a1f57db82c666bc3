//! What can be added to a base model and has parameters: an effect, or another value for a number of its laws.

use super::data_split::DataSplit;
use super::search::Axis;
use crate::effect::EffectInfo;
use crate::model::Model;
use crate::normal::NormalLaw;
use crate::tangential::TangentialLaw;

/// A number of the base model's own laws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Number {
    /// `normal.e_n` of constant restitution.
    NormalRestitution,
    /// `tangential.e_t` of constant restitution.
    TangentialRestitution,
    /// `tangential.friction`.
    Friction,
}

impl Number {
    /// Table and key in the model file.
    pub fn key(self) -> [&'static str; 2] {
        match self {
            Self::NormalRestitution => ["normal", "e_n"],
            Self::TangentialRestitution => ["tangential", "e_t"],
            Self::Friction => ["tangential", "friction"],
        }
    }

    /// Its value in a model, where the model has it.
    pub fn of(self, model: &Model) -> Option<f64> {
        match (self, model.normal_law(), model.tangential_law()) {
            (Self::NormalRestitution, NormalLaw::Constant { restitution }, _) => Some(restitution),
            (Self::TangentialRestitution, _, TangentialLaw::Constant { restitution }) => Some(restitution),
            (
                Self::Friction,
                _,
                TangentialLaw::Sliding { friction } | TangentialLaw::SlidingRolling { friction },
            ) => Some(friction),
            _ => None,
        }
    }

    /// The model with another value for it.
    pub fn set(self, model: &Model, value: f64) -> Model {
        let (normal, tangential) = (model.normal_law(), model.tangential_law());
        match (self, tangential) {
            (Self::NormalRestitution, _) => {
                model.with_laws(NormalLaw::Constant { restitution: value }, tangential)
            }
            (Self::TangentialRestitution, _) => {
                model.with_laws(normal, TangentialLaw::Constant { restitution: value })
            }
            (Self::Friction, TangentialLaw::Sliding { .. }) => {
                model.with_laws(normal, TangentialLaw::Sliding { friction: value })
            }
            (Self::Friction, _) => model.with_laws(normal, TangentialLaw::SlidingRolling { friction: value }),
        }
    }
}

/// Something with parameters that can be added to the base.
#[derive(Debug, Clone, Copy)]
pub(super) enum Part {
    /// An effect of the library.
    Effect(&'static EffectInfo),
    /// Another value for a number of the base.
    Number(Number),
}

impl Part {
    /// Its name: an effect's id, or a number's key.
    pub fn name(&self) -> String {
        match self {
            Self::Effect(kind) => kind.id.to_owned(),
            Self::Number(number) => number.key().join("."),
        }
    }

    /// Whether it leaves something to chance.
    pub fn scatters(&self) -> bool {
        matches!(self, Self::Effect(kind) if kind.stream.is_some())
    }

    /// The inputs that it turns on.
    pub fn inputs(&self) -> &'static [&'static str] {
        match self {
            Self::Effect(kind) => kind.inputs,
            Self::Number(_) => &[],
        }
    }

    /// The axes of its parameters, with `refined` also of those that have a default (they come last); `None` where the
    /// data cannot show it.
    pub fn axes(&self, study: &DataSplit, refined: bool) -> Option<Vec<Axis>> {
        match self {
            Self::Number(_) => Some(vec![Axis::linear(0.02, 1.1)]),
            Self::Effect(kind) => {
                // What an effect turns on has to vary. Beside another input, speed and size need not: laws work with them as
                // they are.
                let (known, needed): (Vec<&str>, Vec<&str>) =
                    kind.inputs.iter().partition(|input| ["v_n", "d"].contains(*input));
                let needed = if needed.is_empty() { known } else { needed };
                needed.iter().map(|input| study.range(input)).collect::<Option<Vec<_>>>()?;
                let free = kind.parameters.iter().filter(|p| refined || p.default.is_none());
                free.map(|p| Axis::of(p, |input| study.range(input))).collect()
            }
        }
    }
}

/// A part with its parameters.
#[derive(Debug, Clone)]
pub(super) struct Fitted {
    pub part: Part,
    pub axes: Vec<Axis>,
    /// Coordinates on the axes.
    pub at: Vec<f64>,
}

impl Fitted {
    /// The parameters in SI units; those without an axis have their defaults.
    pub fn values(&self) -> Vec<f64> {
        let mut values: Vec<f64> = self.axes.iter().zip(&self.at).map(|(axis, at)| axis.value(*at)).collect();
        if let Part::Effect(kind) = self.part {
            values
                .extend(kind.parameters.iter().skip(values.len()).filter_map(|parameter| parameter.default));
        }
        values
    }
}
