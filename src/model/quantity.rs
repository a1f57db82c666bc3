//! What kind of quantity each number of a model file is, as its definition says.

use crate::effect::EFFECTS;
use crate::law::{Parameter, QuantityKind};
use crate::{capture, material, normal, tangential};

/// The kind of the number at a place in a model file, for instance `["effects", "melting-transition", "width"]` or
/// `["materials", "montan-wax", "density"]`; `None` where no definition states one.
pub fn kind_of(path: &[&str]) -> Option<QuantityKind> {
    let own = |kinds: &[(&str, QuantityKind)], key: &str| {
        kinds.iter().find(|(name, _)| *name == key).map(|(_, kind)| *kind)
    };
    match *path {
        ["materials", _, key, ..] => material::kind_of(key),
        ["effects", id, key, ..] => {
            parameter(EFFECTS.iter().filter(|info| info.id == id).map(|info| info.parameters), key)
        }
        ["normal", key, ..] => own(&normal::NORMAL_KINDS, key)
            .or_else(|| parameter(normal::LISTED_LAWS.iter().map(|law| law.parameters), key)),
        ["tangential", key, ..] => own(&tangential::TANGENTIAL_KINDS, key)
            .or_else(|| parameter(tangential::LISTED_LAWS.iter().map(|law| law.parameters), key)),
        ["capture", key, ..] => own(&capture::CAPTURE_KINDS, key),
        ["walls", _, "coverage"] => Some(QuantityKind::Share),
        _ => None,
    }
}

/// The kind of the parameter of this name.
fn parameter(mut laws: impl Iterator<Item = &'static [Parameter]>, name: &str) -> Option<QuantityKind> {
    laws.find_map(|parameters| parameters.iter().find(|parameter| parameter.name == name))
        .map(|parameter| parameter.kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_stands_at_the_definition_of_a_number() {
        for (path, kind) in [
            (["effects", "melting-transition", "temperature"], Some(QuantityKind::Temperature)),
            (["effects", "melting-transition", "width"], Some(QuantityKind::Amount)),
            (["effects", "dry-on-melt", "contact_angle"], Some(QuantityKind::Angle)),
            (["materials", "own", "poisson_ratio"], Some(QuantityKind::Share)),
            (["materials", "own", "composition"], None),
            (["walls", "default", "coverage"], Some(QuantityKind::Share)),
        ] {
            assert_eq!(kind_of(&path), kind, "{path:?}");
        }
        assert_eq!(kind_of(&["normal", "e_n"]), Some(QuantityKind::Share));
        assert_eq!(kind_of(&["tangential", "friction"]), Some(QuantityKind::Share));
        assert_eq!(kind_of(&["capture", "contact_angle"]), Some(QuantityKind::Angle));
    }
}
