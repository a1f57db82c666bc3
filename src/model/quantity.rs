//! What kind of quantity each number of a model file is and its unit, as its definition says.

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
        ["normal", key, ..] => own(&normal::NORMAL_KINDS, key),
        ["tangential", key, ..] => own(&tangential::TANGENTIAL_KINDS, key),
        ["capture", key, ..] => own(&capture::CAPTURE_KINDS, key),
        ["walls", _, "coverage"] => Some(QuantityKind::Share),
        _ => None,
    }
    .or_else(|| parameter(path).map(|parameter| parameter.kind))
}

/// The SI unit of the number at a place in a model file, "1" for one without a unit; `None` where no definition
/// states one.
pub fn unit_of(path: &[&str]) -> Option<&'static str> {
    match *path {
        ["materials", _, key, ..] => material::unit_of(key),
        _ => parameter(path).map(|parameter| parameter.unit),
    }
}

/// The parameter of a listed law or an effect at a place in a model file.
fn parameter(path: &[&str]) -> Option<&'static Parameter> {
    let (lists, name): (Vec<&'static [Parameter]>, &str) = match *path {
        ["effects", id, key, ..] => {
            (EFFECTS.iter().filter(|info| info.id == id).map(|info| info.parameters).collect(), key)
        }
        ["normal", key, ..] => (normal::LISTED_LAWS.iter().map(|law| law.parameters).collect(), key),
        ["tangential", key, ..] => (tangential::LISTED_LAWS.iter().map(|law| law.parameters).collect(), key),
        _ => return None,
    };
    lists.into_iter().flatten().find(|parameter| parameter.name == name)
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
        assert_eq!(unit_of(&["effects", "melting-transition", "width"]), Some("K"));
        assert_eq!(unit_of(&["materials", "own", "density"]), Some("kg/m3"));
        assert_eq!(kind_of(&["normal", "e_n"]), Some(QuantityKind::Share));
        assert_eq!(kind_of(&["tangential", "friction"]), Some(QuantityKind::Share));
        assert_eq!(kind_of(&["capture", "contact_angle"]), Some(QuantityKind::Angle));
    }
}
