//! The units of a column map.

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
    pub(super) const SI: Self = part("SI", 1.0);

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

/// A unit of which `divisor` make one SI unit.
const fn part(name: &'static str, divisor: f64) -> Unit {
    scaled(name, 1.0, divisor)
}

const LENGTH_UNITS: [Unit; 5] =
    [part("m", 1.0), part("mm", 1e3), part("um", 1e6), part("µm", 1e6), part("nm", 1e9)];
const SPEED_UNITS: [Unit; 4] = [part("m/s", 1.0), part("cm/s", 1e2), part("mm/s", 1e3), part("km/h", 3.6)];
const TEMPERATURE_UNITS: [Unit; 4] = [
    part("K", 1.0),
    Unit { name: "C", offset: 273.15, factor: 1.0, divisor: 1.0 },
    Unit { name: "°C", offset: 273.15, factor: 1.0, divisor: 1.0 },
    Unit { name: "F", offset: 459.67, factor: 5.0, divisor: 9.0 },
];
const SPIN_UNITS: [Unit; 4] =
    [part("rad/s", 1.0), part("s^-1", 1.0), part("1/s", 1.0), scaled("rpm", std::f64::consts::TAU, 60.0)];
const DENSITY_UNITS: [Unit; 2] = [part("kg/m3", 1.0), scaled("g/cm3", 1e3, 1.0)];
const SHARE_UNITS: [Unit; 2] = [part("1", 1.0), part("%", 100.0)];
/// Angles are converted to degrees, not radians: 90 is a right angle exactly.
const ANGLE_UNITS: [Unit; 2] = [part("deg", 1.0), scaled("rad", 180.0, std::f64::consts::PI)];

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

    /// Its units; empty if it has none.
    pub(super) fn units(self) -> &'static [Unit] {
        match self {
            Self::Length => &LENGTH_UNITS,
            Self::Speed => &SPEED_UNITS,
            Self::Temperature => &TEMPERATURE_UNITS,
            Self::Spin => &SPIN_UNITS,
            Self::Density => &DENSITY_UNITS,
            Self::Share => &SHARE_UNITS,
            Self::Angle => &ANGLE_UNITS,
            Self::Count | Self::Text => &[],
        }
    }

    /// The unit of this name. The Greek letter mu is accepted for the micro sign, which looks the same.
    pub(super) fn unit(self, name: &str) -> Option<Unit> {
        let name = name.replace('μ', "µ").replace('³', "3");
        self.units().iter().find(|unit| unit.name == name).copied()
    }

    /// The unit that a file states: also `-`, which means that there is none, and 1 of a count.
    pub(super) fn stated_unit(self, name: &str) -> Option<Unit> {
        let none = matches!(self, Self::Share | Self::Count | Self::Text) && ["-", "1", ""].contains(&name);
        if none { Some(Unit::SI) } else { self.unit(name) }
    }

    /// The names of its units.
    pub(super) fn unit_names(self) -> String {
        let names: Vec<&str> = self.units().iter().map(|unit| unit.name).collect();
        if names.is_empty() { "-".to_owned() } else { names.join(", ") }
    }
}

/// Reads the key `unit`, SI by default; an angle has no default.
pub(super) fn read_unit(details: &Section<'_>, dimension: Dimension) -> Result<Unit, InputError> {
    let units = dimension.units();
    if units.is_empty() {
        return Ok(Unit::SI);
    }
    match details.text("unit")? {
        Some(word) => dimension.unit(&word).ok_or_else(|| {
            let known: Vec<&str> = units.iter().map(|unit| unit.name).collect();
            details.fault("unit", unknown(&word, "unit", &known))
        }),
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
    fn every_input_can_be_mapped_once() {
        let all: Vec<&str> = names().map(|(name, _)| name).collect();
        assert!(INPUTS.iter().all(|input| all.contains(&input.name)));
        assert!(all.iter().enumerate().all(|(index, name)| !all[..index].contains(name)));
        for input in &INPUTS {
            let dimension = names().find(|(name, _)| *name == input.name).unwrap().1;
            assert_eq!(dimension.units()[0].name, input.unit, "{}", input.name);
        }
    }
}
