//! The units of a column map.

use super::any_unit::conversion;
use nearwall::input::{InputError, Section, unknown};

/// A unit and its conversion to SI: `(value + offset) factor / divisor`.
///
/// Small units have a divisor because 75 / 1e6 equals 75e-6 exactly and 75 * 1e-6 does not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Unit {
    /// Its name in a column map.
    pub(super) name: &'static str,
    offset: f64,
    factor: f64,
    divisor: f64,
}

impl Unit {
    /// The SI unit of any dimension.
    pub(super) const SI: Self = scaled("SI", 1.0, 1.0);

    /// The unit of a difference, as a standard error: 1 °C is 1 K.
    pub(super) fn of_difference(self) -> Self {
        Self { offset: 0.0, ..self }
    }

    /// A value in SI units (an angle in degrees).
    pub(super) fn to_si(self, value: f64) -> f64 {
        (value + self.offset) * self.factor / self.divisor
    }
}

pub(super) const fn scaled(name: &'static str, factor: f64, divisor: f64) -> Unit {
    Unit { name, offset: 0.0, factor, divisor }
}

/// The units of temperatures, which have other zeros.
const TEMPERATURES: [Unit; 4] = [
    scaled("K", 1.0, 1.0),
    Unit { name: "C", offset: 273.15, factor: 1.0, divisor: 1.0 },
    Unit { name: "°C", offset: 273.15, factor: 1.0, divisor: 1.0 },
    Unit { name: "F", offset: 459.67, factor: 5.0, divisor: 9.0 },
];
/// Angles are converted to degrees, not radians: 90 is a right angle exactly.
const ANGLES: [Unit; 2] = [scaled("deg", 1.0, 1.0), scaled("rad", 180.0, std::f64::consts::PI)];

/// The dimension of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dimension {
    Length,
    Speed,
    Temperature,
    Spin,
    Density,
    /// A dimensionless number: a share or a restitution.
    Share,
    Angle,
    /// A whole number, which has no unit.
    Count,
    /// Text, which has no unit.
    Text,
}

impl Dimension {
    /// All of them.
    pub(super) const ALL: [Self; 9] = [
        Self::Length,
        Self::Speed,
        Self::Temperature,
        Self::Spin,
        Self::Density,
        Self::Share,
        Self::Angle,
        Self::Count,
        Self::Text,
    ];

    /// The names of its units, that of SI first; empty if it has none. All but those of temperatures and angles are
    /// products of symbols ([`conversion`]).
    pub(super) fn names(self) -> &'static [&'static str] {
        match self {
            Self::Length => &["m", "mm", "um", "µm", "nm"],
            Self::Speed => &["m/s", "cm/s", "mm/s", "km/h"],
            Self::Temperature => &["K", "C", "°C", "F"],
            Self::Spin => &["rad/s", "s^-1", "1/s", "rpm"],
            Self::Density => &["kg/m3", "g/cm3"],
            Self::Share => &["1", "%"],
            Self::Angle => &["deg", "rad"],
            Self::Count | Self::Text => &[],
        }
    }

    /// The unit of this name. The Greek letter mu is accepted for the micro sign, which looks the same.
    pub(super) fn unit(self, name: &str) -> Option<Unit> {
        let name = name.replace('μ', "µ").replace('³', "3");
        let own = |units: &[Unit]| units.iter().find(|unit| unit.name == name).copied();
        let name = self.names().iter().find(|known| **known == name)?;
        match self {
            Self::Temperature => own(&TEMPERATURES),
            Self::Angle => own(&ANGLES),
            _ => conversion(name).map(|[factor, divisor]| scaled(name, factor, divisor)),
        }
    }

    /// The unit that a file states: also `-`, which means that there is none, and 1 of a count.
    pub(super) fn stated_unit(self, name: &str) -> Option<Unit> {
        let none = matches!(self, Self::Share | Self::Count | Self::Text) && ["-", "1", ""].contains(&name);
        if none { Some(Unit::SI) } else { self.unit(name) }
    }

    /// The names of its units in a message.
    pub(super) fn unit_names(self) -> String {
        if self.names().is_empty() { "-".to_owned() } else { self.names().join(", ") }
    }
}

/// Reads the key `unit`, SI by default; an angle has no default.
pub(super) fn read_unit(details: &Section<'_>, dimension: Dimension) -> Result<Unit, InputError> {
    if dimension.names().is_empty() {
        return Ok(Unit::SI);
    }
    match details.text("unit")? {
        Some(word) => dimension
            .unit(&word)
            .ok_or_else(|| details.fault("unit", unknown(&word, "unit", dimension.names()))),
        None if dimension == Dimension::Angle => Err(details.missing("unit", "\"deg\" or \"rad\"")),
        None => Ok(Unit::SI),
    }
}

/// Reads a number in SI units, or a table of `value` and `unit`; the result is in SI units.
pub(super) fn read_quantity(
    section: &Section<'_>,
    key: &str,
    dimension: Dimension,
) -> Result<Option<f64>, InputError> {
    if !section.is_section(key) {
        return section.number(key);
    }
    let details = section.required_section(key)?;
    let value = details.required_number("value")?;
    let unit = read_unit(&details, dimension)?;
    details.finish()?;
    Ok(Some(unit.to_si(value)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::column_names::names;
    use nearwall::impact::INPUTS;

    fn si(dimension: Dimension, unit: &str, value: f64) -> f64 {
        dimension.unit(unit).unwrap().to_si(value)
    }

    #[test]
    fn units_are_converted_exactly() {
        assert_eq!(si(Dimension::Length, "um", 75.0), 75e-6);
        assert_eq!(Dimension::Length.unit("μm"), Dimension::Length.unit("µm"));
        assert_eq!(si(Dimension::Length, "nm", 3.0), 3e-9);
        assert_eq!(si(Dimension::Speed, "km/h", 36.0), 10.0);
        assert_eq!(si(Dimension::Temperature, "C", 20.0), 293.15);
        assert!((si(Dimension::Temperature, "F", 212.0) - 373.15).abs() < 1e-12);
        assert!((si(Dimension::Spin, "rpm", 60.0) - std::f64::consts::TAU).abs() < 1e-12);
        assert_eq!(si(Dimension::Density, "g/cm3", 2.3), 2300.0);
        assert_eq!(Dimension::Temperature.unit("C").unwrap().of_difference().to_si(5.0), 5.0);
        assert!((Dimension::Temperature.unit("F").unwrap().of_difference().to_si(9.0) - 5.0).abs() < 1e-12);
        assert_eq!(si(Dimension::Share, "%", 35.0), 0.35);
        assert_eq!(si(Dimension::Angle, "rad", std::f64::consts::FRAC_PI_2), 90.0);
    }

    #[test]
    fn every_unit_has_a_conversion() {
        for dimension in Dimension::ALL {
            assert!(
                dimension
                    .names()
                    .iter()
                    .all(|name| dimension.unit(name).is_some_and(|unit| unit.name == *name))
            );
        }
    }

    #[test]
    fn every_input_can_be_mapped_once() {
        let all: Vec<&str> = names().map(|(name, _)| name).collect();
        assert!(INPUTS.iter().all(|input| all.contains(&input.name)));
        assert!(all.iter().enumerate().all(|(index, name)| !all[..index].contains(name)));
        for input in &INPUTS {
            let dimension = names().find(|(name, _)| *name == input.name).unwrap().1;
            assert_eq!(dimension.names()[0], input.unit, "{}", input.name);
        }
    }
}
