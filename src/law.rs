//! What laws have in common: parameters, and the case to which a law was fitted.

use crate::impact::Impact;
use crate::input::{InputError, Section};

/// What kind of quantity a number is: it says how far apart two values of it are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuantityKind {
    /// A share, 0 to 1: values differ by a factor of their odds.
    Share,
    /// A temperature: values differ by a difference.
    Temperature,
    /// An angle: values differ by a difference.
    Angle,
    /// Any other quantity: values differ by a factor.
    Amount,
}

/// One parameter of a law or an effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Key in the model file.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// What kind of quantity it is.
    pub kind: QuantityKind,
    /// Smallest and largest value that makes sense.
    pub bounds: (f64, f64),
    /// Value where the model file does not give it, and which a fit leaves unless another one is
    /// worth it; `None` for a parameter that every fit searches.
    pub default: Option<f64>,
    /// Value where the model file does not give it, of a parameter that every fit searches; `None` for a required one.
    pub absent: Option<f64>,
    /// Range of a fit.
    pub search: Search,
    /// One line of explanation.
    pub about: &'static str,
}

/// Range in which a fit searches a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Search {
    /// Uniform between two values.
    Linear(f64, f64),
    /// Uniform in the logarithm between two positive values.
    Log(f64, f64),
    /// Uniform within the range of an input in the data.
    InputRange(&'static str),
    /// Uniform in the logarithm, from a fiftieth of the range of an input in the data to four times that range.
    InputWidth(&'static str),
}

impl Parameter {
    /// A parameter that the model file must give.
    pub(crate) const fn new(
        name: &'static str,
        unit: &'static str,
        bounds: (f64, f64),
        search: Search,
    ) -> Self {
        Self {
            name,
            unit,
            kind: QuantityKind::Amount,
            bounds,
            default: None,
            absent: None,
            search,
            about: "",
        }
    }

    pub(crate) const fn kind(self, kind: QuantityKind) -> Self {
        Self { kind, ..self }
    }

    pub(crate) const fn default(self, value: f64) -> Self {
        Self { default: Some(value), ..self }
    }

    pub(crate) const fn absent(self, value: f64) -> Self {
        Self { absent: Some(value), ..self }
    }

    pub(crate) const fn about(self, about: &'static str) -> Self {
        Self { about, ..self }
    }

    /// Reads a number, or `{ value, low, high }` of a fit.
    pub(crate) fn read(&self, section: &Section<'_>) -> Result<f64, InputError> {
        let Self { name, unit, bounds: (low, high), default, absent, about, .. } = *self;
        let missing = |s: &Section<'_>| s.missing(name, &format!("a number [{unit}], {about},"));
        if !section.is_section(name) {
            self.refuse_celsius(section, name)?;
            let given = section.number_within(name, low, high)?;
            return given.or(default).or(absent).ok_or_else(|| missing(section));
        }
        let fitted = section.required_section(name)?;
        self.refuse_celsius(&fitted, "value")?;
        let value = fitted.number_within("value", low, high)?.ok_or_else(|| missing(&fitted))?;
        fitted.number("low")?;
        fitted.number("high")?;
        fitted.text("unit")?;
        fitted.finish()?;
        Ok(value)
    }
}

impl Parameter {
    /// Refuses a temperature [K] below the bounds, which is probably in degrees Celsius.
    fn refuse_celsius(&self, section: &Section<'_>, key: &str) -> Result<(), InputError> {
        match section.number(key)? {
            Some(value) if self.kind == QuantityKind::Temperature && value < self.bounds.0 => {
                let kelvin = value + CELSIUS_ZERO;
                let problem = "nothing softens or melts at";
                let remedy = "if that is in degrees Celsius, write";
                Err(section.fault(key, format!("{problem} {value} K; {remedy} {kelvin:.2}")))
            }
            _ => Ok(()),
        }
    }
}

/// 0 °C [K].
const CELSIUS_ZERO: f64 = 273.15;

/// Most parameters of a listed law.
pub const MOST_PARAMETERS: usize = 4;

/// The values of the parameters of a listed law, in their order; the rest is 0.
pub type ParameterValues = [f64; MOST_PARAMETERS];

/// Reads the parameters of a listed law.
pub(crate) fn read_values(
    section: &Section<'_>,
    parameters: &'static [Parameter],
) -> Result<ParameterValues, InputError> {
    let mut values = ParameterValues::default();
    for (value, parameter) in values.iter_mut().zip(parameters) {
        *value = parameter.read(section)?;
    }
    Ok(values)
}

/// Parameters with their values and units, as in `name = 0.3 m/s`.
pub(crate) fn describe_values(parameters: &[Parameter], values: &[f64]) -> Vec<String> {
    let text = |(parameter, value): (&Parameter, &f64)| match parameter.unit {
        "1" => format!("{} = {value}", parameter.name),
        unit => format!("{} = {value} {unit}", parameter.name),
    };
    parameters.iter().zip(values).map(text).collect()
}

/// Where a listed law comes from and for which impacts it is stated.
#[derive(Debug)]
pub struct Origin {
    /// The publication.
    pub source: &'static str,
    /// The particles, walls and impacts to which it was fitted, or the case that it describes.
    pub case: &'static str,
    /// The impacts of that case; outside, the outcome is marked as outside the valid range.
    pub range: &'static [FitLimit],
}

/// The range of one quantity of an impact to which a law was fitted.
#[derive(Debug)]
pub struct FitLimit {
    /// The quantity in words.
    pub quantity: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Lowest and highest value.
    pub range: [f64; 2],
    /// Reads it from an impact.
    pub value: fn(&Impact) -> f64,
}

impl FitLimit {
    /// The angle between path and surface [degrees]: 0 glancing, 90 head-on.
    pub(crate) const fn angle(low: f64, high: f64) -> Self {
        let value = |impact: &Impact| impact.angle_from_surface().to_degrees();
        Self { quantity: "angle from the surface", unit: "degrees", range: [low, high], value }
    }

    /// The speed of the particle [m/s].
    pub(crate) const fn speed(low: f64, high: f64) -> Self {
        Self { quantity: "speed", unit: "m/s", range: [low, high], value: Impact::speed }
    }

    /// The diameter of the particle [m].
    pub(crate) const fn diameter(low: f64, high: f64) -> Self {
        Self { quantity: "diameter", unit: "m", range: [low, high], value: |impact| impact.diameter }
    }

    /// The mean of the temperatures of particle and wall [K].
    pub(crate) const fn temperature(low: f64, high: f64) -> Self {
        Self { quantity: "mean temperature", unit: "K", range: [low, high], value: Impact::mean_temperature }
    }
}

impl Origin {
    /// Whether an impact lies in the range of the fit.
    pub fn holds_for(&self, impact: &Impact) -> bool {
        self.left_by(impact).next().is_none()
    }

    /// The limits of the fit that an impact leaves.
    pub(crate) fn left_by(&self, impact: &Impact) -> impl Iterator<Item = &'static FitLimit> {
        let impact = *impact;
        self.range.iter().filter(move |limit| {
            let [low, high] = limit.range;
            // Rounding: an angle of 90 degrees is computed from two speeds.
            let value = (limit.value)(&impact);
            !(value >= low * (1.0 - 1e-12) && value <= high * (1.0 + 1e-12))
        })
    }

    /// Case and range in one line.
    pub(crate) fn describe(&self) -> String {
        let limit = |limit: &FitLimit| {
            let FitLimit { quantity, unit, range: [low, high], .. } = limit;
            // A diameter is easier to read as 5e-7 than as 0.0000005.
            if *high < 0.1 {
                format!("{quantity} {low:e} to {high:e} {unit}")
            } else {
                format!("{quantity} {low} to {high} {unit}")
            }
        };
        let range: Vec<String> = self.range.iter().map(limit).collect();
        if range.is_empty() {
            self.case.to_owned()
        } else {
            format!("{}; stated for {}", self.case, range.join(", "))
        }
    }
}

/// `c0 + c1 x + c2 x² + ...`
pub(crate) fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_begins_with_its_constant() {
        assert_eq!(polynomial(&[3.0, 2.0, 1.0], 10.0), 123.0);
        assert_eq!(polynomial(&[], 10.0), 0.0);
    }

    static STEEP: Origin = Origin { source: "", case: "", range: &[FitLimit::angle(80.0, 90.0)] };
    static FAST: Origin = Origin { source: "", case: "sand", range: &[FitLimit::speed(60.0, 190.0)] };

    /// The angle is counted from the surface: a head-on impact has 90 degrees.
    #[test]
    fn angles_are_counted_from_the_surface() {
        let holds = |normal_speed, tangential_speed| {
            STEEP.holds_for(&Impact { normal_speed, tangential_speed, ..Impact::default() })
        };
        assert!(holds(1.0, 0.0) && holds(1.0, 0.1) && !holds(0.1, 1.0));
    }

    #[test]
    fn a_description_has_the_range_with_units() {
        assert_eq!(FAST.describe(), "sand; stated for speed 60 to 190 m/s");
    }
}
