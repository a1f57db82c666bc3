//! Numbers of a case in words: what a dotted key names, and its unit.

use crate::simulate::DistributionKey;
use nearwall::model::unit_of;

/// SI units of the numbers of a case, and of those of a model whose definition states none, by their last key.
const UNITS: [(&str, &str); 30] = [
    ("activation_energy", "J/mol"),
    ("angle_deg", "°"),
    ("asperity", "m"),
    ("azimuth_deg", "°"),
    ("axial_speed", "m/s"),
    ("carbon", "1"),
    ("conductivity", "W/(m K)"),
    ("contact_angle", "°"),
    ("conversion", "1"),
    ("core_radius", "m"),
    ("coverage", "1"),
    ("decay_length", "m"),
    ("density", "kg/m3"),
    ("diameter", "m"),
    ("emissivity", "1"),
    ("friction", "1"),
    ("hardness", "Pa"),
    ("heat_capacity", "J/(kg K)"),
    ("height", "m"),
    ("mean_free_path", "m"),
    ("peak_height", "m"),
    ("radiation_temperature", "K"),
    ("reference_viscosity", "Pa s"),
    ("speed", "m/s"),
    ("swirl", "rad/s"),
    ("temperature", "K"),
    ("velocity", "m/s"),
    ("viscosity", "Pa s"),
    ("work_of_adhesion", "J/m2"),
    ("yield_ratio", "1"),
];

/// The number at a dotted key in words, for instance "mean diameter of the particles".
pub(crate) fn name_of(key: &str) -> String {
    let parts: Vec<&str> = key.split('.').collect();
    match parts.as_slice() {
        ["model", "materials", material, "composition", oxide] => format!("share of {oxide} in {material}"),
        ["model", "materials", material, rest @ ..] => format!("{} of {material}", words(rest)),
        ["model", "effects", effect, rest @ ..] => format!("{} of {effect}", words(rest)),
        ["model", "walls", wall, rest @ ..] | ["walls", wall, rest @ ..] => {
            format!("{} of the wall {wall}", words(rest))
        }
        ["model", "normal", rest @ ..] => format!("{} of the normal law", words(rest)),
        ["model", "tangential", rest @ ..] => format!("{} of the tangential law", words(rest)),
        ["model", table, rest @ ..] => format!("{} of [{table}]", words(rest)),
        [table @ ("gas" | "particles" | "conversion" | "deposit"), rest @ ..] => {
            format!("{} of the {table}", words(rest))
        }
        _ => words(&parts),
    }
}

/// Keys in words: that of a distribution stands before what it is of.
fn words(keys: &[&str]) -> String {
    let word = |key: &&str| match *key {
        "pre_exponential" => "pre-exponential factor".to_owned(),
        "carbon" => "share of carbon".to_owned(),
        "youngs_modulus" => "Young's modulus".to_owned(),
        "poisson_ratio" => "Poisson's ratio".to_owned(),
        name @ ("e_n" | "e_t") => name.to_owned(),
        other => other.trim_end_matches("_deg").replace('_', " "),
    };
    match keys {
        [before @ .., "value"] if !before.is_empty() => words(before),
        [before @ .., last @ ("mean" | "median")] if !before.is_empty() => {
            format!("{last} {}", words(before))
        }
        [before @ .., last] if !before.is_empty() && DistributionKey::of(last).is_some() => {
            format!("{} of the {}", word(last), words(before))
        }
        _ => keys.iter().map(word).collect::<Vec<_>>().join(" "),
    }
}

/// The SI unit of the number at a dotted key, or degrees; "" where it is not known, "1" for one without a unit.
pub(super) fn unit_of_key(key: &str) -> &'static str {
    let parts: Vec<&str> = key.split('.').collect();
    if let ["model", path @ ..] = parts.as_slice()
        && let Some(unit) = unit_of(path)
    {
        return if unit == "degrees" { "°" } else { unit };
    }
    let of = |part: &str| UNITS.iter().find(|(name, _)| *name == part).map(|(_, unit)| *unit);
    match parts.as_slice() {
        [.., last] if DistributionKey::of(last) == Some(DistributionKey::Shape) => "1",
        [.., before, last] if DistributionKey::of(last).is_some() => of(before).unwrap_or(""),
        [.., last] => of(last).unwrap_or(""),
        [] => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_a_name_and_a_unit() {
        for (key, name, unit) in [
            ("particles.diameter.mean", "mean diameter of the particles", "m"),
            (
                "particles.diameter.geometric_deviation",
                "geometric deviation of the diameter of the particles",
                "1",
            ),
            ("particles.angle_deg.deviation", "deviation of the angle of the particles", "°"),
            ("walls.tube.temperature", "temperature of the wall tube", "K"),
            ("model.materials.ash.surface_energy", "surface energy of ash", "J/m2"),
            ("model.materials.ash.composition.SiO2", "share of SiO2 in ash", "%"),
            ("model.materials.ash.fusion_temperatures", "fusion temperatures of ash", "K"),
            ("model.effects.melting-transition.width", "width of melting-transition", "K"),
            ("model.normal.yield_ratio", "yield ratio of the normal law", "1"),
            ("model.tangential.friction", "friction of the tangential law", "1"),
            ("gas.heat_capacity", "heat capacity of the gas", "J/(kg K)"),
            ("somewhere.else", "somewhere else", ""),
        ] {
            assert_eq!((name_of(key).as_str(), unit_of_key(key)), (name, unit), "{key}");
        }
    }
}
