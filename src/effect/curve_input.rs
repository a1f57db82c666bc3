//! What a fitted correction may depend on.

use crate::group::{Circumstances, Declared, GROUPS, GroupInfo};
use crate::impact::INPUTS;

/// An input of a curve or a form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveInput {
    /// One of [`INPUTS`], by place.
    Input(usize),
    /// A number that the model file declares, by place in [`Impact::extra`](crate::Impact::extra).
    Extra(usize),
    /// A word of a list that the model file declares, by place in [`Impact::extra`](crate::Impact::extra).
    Label(usize),
    /// One of [`GROUPS`], by place.
    Group(usize),
    /// A group that the model file declares, by place in [`Model::products`](crate::Model::products).
    Product(usize),
}

impl CurveInput {
    /// The input or group of this name. What a model file declares goes before the built-in groups.
    pub fn named(name: &str, declared: &Declared<'_>) -> Option<Self> {
        if let Some(place) = INPUTS.iter().position(|input| input.name == name) {
            return Some(Self::Input(place));
        }
        let extra = declared.inputs.iter().position(|input| input.name == name);
        if let Some((place, input)) = extra.and_then(|place| Some((place, declared.inputs.get(place)?))) {
            return Some(if input.is_label() { Self::Label(place) } else { Self::Extra(place) });
        }
        let product = declared.products.iter().position(|product| product.name == name);
        product.map(Self::Product).or_else(|| GroupInfo::place(name).map(Self::Group))
    }

    /// The names of all of them.
    pub(super) fn names<'a>(declared: &Declared<'a>) -> Vec<&'a str> {
        let inputs = INPUTS.iter().map(|input| input.name);
        let extra = declared.inputs.iter().map(|input| input.name.as_str());
        let products = declared.products.iter().map(|product| product.name.as_str());
        // A declared input of the name of a group hides it.
        let shown = |group: &&GroupInfo| !declared.inputs.iter().any(|input| input.name == group.name);
        let groups = GROUPS.iter().filter(shown).map(|group| group.name);
        inputs.chain(extra).chain(products).chain(groups).collect()
    }

    /// Whether it is computed from inputs.
    pub fn is_group(self) -> bool {
        matches!(self, Self::Group(_) | Self::Product(_))
    }

    /// Its value for an impact, in its unit; NaN where it has none.
    pub fn value(self, of: &dyn Circumstances) -> f64 {
        let extra = |place: usize| of.impact().extra.get(place).copied();
        let value = match self {
            Self::Input(place) => INPUTS.get(place).map(|input| (input.value)(of.impact())),
            Self::Extra(place) | Self::Label(place) => extra(place),
            Self::Group(place) => GROUPS.get(place).map(|group| group.value(of)),
            Self::Product(place) => of.products().get(place).map(|product| product.value(of)),
        };
        value.unwrap_or(f64::NAN)
    }

    /// Its name.
    pub fn name<'a>(self, declared: &Declared<'a>) -> &'a str {
        let name = match self {
            Self::Input(place) => INPUTS.get(place).map(|input| input.name),
            Self::Extra(place) | Self::Label(place) => {
                declared.inputs.get(place).map(|input| input.name.as_str())
            }
            Self::Group(place) => GROUPS.get(place).map(|group| group.name),
            Self::Product(place) => declared.products.get(place).map(|product| product.name.as_str()),
        };
        name.unwrap_or("?")
    }
}
