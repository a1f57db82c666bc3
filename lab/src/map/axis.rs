//! An input that varies over a map, and an input that is fixed.

use std::str::FromStr;

use nearwall::impact::{INPUTS, Impact, ImpactError, Input};
use nearwall::input::unknown;
use nearwall::model::Model;

/// Points of an axis where the user gives no number.
pub const DEFAULT_POINTS: usize = 61;
/// Values of the third input of a series where the user gives no number.
pub const SLIDER_POINTS: usize = 7;
/// Largest number of points of an axis.
const MOST_POINTS: usize = 1001;
/// From this ratio of both ends on, positive values are evenly spaced in their logarithm.
const LOGARITHMIC_RATIO: f64 = 30.0;
/// Temperatures of a default axis [K].
const DEFAULT_TEMPERATURES: [f64; 2] = [273.15, 2000.0];

/// Why a text or a range gives no axis or setting.
#[expect(missing_docs, reason = "the message of a variant says what its fields are")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AxisError {
    /// The text lacks the equals sign; with the form that it should have.
    #[error("write {0}")]
    Form(&'static str),
    /// The range is not of two or three parts.
    #[error("`{range}`: write LOW:HIGH or LOW:HIGH:POINTS, such as {name}=0.1:30")]
    Range { name: String, range: String },
    /// No input has this name; with the nearest known one.
    #[error("{0}")]
    Unknown(String),
    /// The text is not a number.
    #[error("`{0}` is not a number")]
    Number(String),
    /// The text is not a whole number of points.
    #[error("`{0}` is not a whole number of points")]
    PointsText(String),
    /// The input cannot have the value.
    #[error(transparent)]
    Value(#[from] ImpactError),
    /// The range is empty.
    #[error("{name}: the low end {low} is not below the high end {high}")]
    Empty { name: String, low: f64, high: f64 },
    /// The number of points is out of bounds.
    #[error("{name}: {points} points; give 2 to {MOST_POINTS}")]
    Points { name: String, points: usize },
}

/// An input of an impact over a range. As text: `INPUT=LOW:HIGH` or `INPUT=LOW:HIGH:POINTS`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputAxis {
    /// Place in [`INPUTS`].
    input: usize,
    low: f64,
    high: f64,
    points: usize,
}

impl InputAxis {
    /// An axis over the input of this name.
    ///
    /// # Errors
    /// [`AxisError`] for an unknown input, a range that it cannot have, or a number of points outside 2 to 1001.
    pub fn new(name: &str, low: f64, high: f64, points: usize) -> Result<Self, AxisError> {
        let input = place(name)?;
        check(input, low)?;
        check(input, high)?;
        if low >= high {
            return Err(AxisError::Empty { name: name.to_owned(), low, high });
        }
        if !(2..=MOST_POINTS).contains(&points) {
            return Err(AxisError::Points { name: name.to_owned(), points });
        }
        Ok(Self { input, low, high, points })
    }

    /// The input of this name over a range that laws and property tables cover; `None` for an input
    /// without such a range.
    pub(super) fn over_default_range(name: &str, model: &Model, wall: usize, points: usize) -> Option<Self> {
        let known = model.temperature_ranges(wall).ok();
        let [low, high] = match name {
            "v_n" => [0.1, 100.0],
            "v_t" => [0.0, 50.0],
            "d" => [1e-6, 1e-3],
            "conversion" => [0.0, 1.0],
            "T_p" => overlap(DEFAULT_TEMPERATURES, known.map(|ranges| ranges.particle)),
            "T_w" => overlap(DEFAULT_TEMPERATURES, known.map(|ranges| ranges.wall)),
            _ => return None,
        };
        let input = place(name).ok()?;
        let fitted = model.terms().iter().flat_map(|term| term.valid());
        let fitted = fitted.filter(|(place, _)| *place == input);
        let [low, high] = fitted.fold([low, high], |range, (_, valid)| overlap(range, Some(*valid)));
        Self::new(name, low, high, points).ok()
    }

    /// The same range with another number of points.
    pub(super) fn with_points(self, points: usize) -> Self {
        Self { points, ..self }
    }

    /// The input.
    pub fn input(&self) -> &'static Input {
        &INPUTS[self.input]
    }

    /// Lowest and highest value.
    pub fn ends(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// Number of values.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Whether the values are evenly spaced in their logarithm.
    pub fn is_logarithmic(&self) -> bool {
        self.low > 0.0 && self.high >= LOGARITHMIC_RATIO * self.low
    }

    /// The values, from the lowest to the highest.
    pub fn values(&self) -> Vec<f64> {
        let value = |point: usize| {
            let share = point as f64 / (self.points - 1) as f64;
            match point {
                0 => self.low,
                last if last + 1 == self.points => self.high,
                _ if self.is_logarithmic() => self.low * (self.high / self.low).powf(share),
                _ => self.low + share * (self.high - self.low),
            }
        };
        (0..self.points).map(value).collect()
    }
}

impl InputAxis {
    /// Reads a third input, which has fewer values than an axis.
    ///
    /// # Errors
    /// As [`Self::new`], and for a text of another form.
    pub fn slider(text: &str) -> Result<Self, AxisError> {
        Self::read(text, SLIDER_POINTS)
    }

    fn read(text: &str, default_points: usize) -> Result<Self, AxisError> {
        let (name, range) = parts(text, "INPUT=LOW:HIGH or INPUT=LOW:HIGH:POINTS, such as v_n=0.1:30")?;
        let parts: Vec<&str> = range.split(':').collect();
        let (low, high, points) = match parts[..] {
            [low, high] => (low, high, None),
            [low, high, points] => (low, high, Some(points)),
            _ => return Err(AxisError::Range { name: name.to_owned(), range: range.to_owned() }),
        };
        let points = match points {
            Some(text) => text.trim().parse().map_err(|_| AxisError::PointsText(text.to_owned()))?,
            None => default_points,
        };
        Self::new(name, number(low)?, number(high)?, points)
    }
}

impl FromStr for InputAxis {
    type Err = AxisError;

    fn from_str(text: &str) -> Result<Self, AxisError> {
        Self::read(text, DEFAULT_POINTS)
    }
}

/// A fixed value of an input. As text: `INPUT=VALUE`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Place in [`INPUTS`].
    input: usize,
    value: f64,
}

impl Setting {
    /// The input.
    pub fn input(&self) -> &'static Input {
        &INPUTS[self.input]
    }

    /// Sets the input in an impact.
    pub fn apply(&self, impact: &mut Impact) {
        (self.input().set)(impact, self.value);
    }
}

impl FromStr for Setting {
    type Err = AxisError;

    fn from_str(text: &str) -> Result<Self, AxisError> {
        let (name, value) = parts(text, "INPUT=VALUE, such as T_p=1500")?;
        let (input, value) = (place(name)?, number(value)?);
        check(input, value)?;
        Ok(Self { input, value })
    }
}

/// The name and the rest around the equals sign.
fn parts<'a>(text: &'a str, form: &'static str) -> Result<(&'a str, &'a str), AxisError> {
    let (name, rest) = text.split_once('=').ok_or(AxisError::Form(form))?;
    Ok((name.trim(), rest))
}

/// The place of an input in [`INPUTS`].
fn place(name: &str) -> Result<usize, AxisError> {
    let names: Vec<&str> = INPUTS.iter().map(|input| input.name).collect();
    names
        .iter()
        .position(|known| *known == name)
        .ok_or_else(|| AxisError::Unknown(unknown(name, "input", &names)))
}

fn number(text: &str) -> Result<f64, AxisError> {
    text.trim().parse().map_err(|_| AxisError::Number(text.to_owned()))
}

/// Checks that an input may have a value.
fn check(input: usize, value: f64) -> Result<(), ImpactError> {
    let mut impact = Impact { normal_speed: 1.0, ..Impact::default() };
    (INPUTS[input].set)(&mut impact, value);
    impact.check()
}

/// The part that two ranges have in common; the first one where there is none.
fn overlap(range: [f64; 2], other: Option<[f64; 2]>) -> [f64; 2] {
    let [low, high] = other.unwrap_or(range);
    let common = [range[0].max(low), range[1].min(high)];
    if common[0] < common[1] { common } else { range }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_evenly_spaced_or_in_decades() {
        let axis: InputAxis = "T_w=300:1500:4".parse().unwrap();
        assert_eq!((axis.values(), axis.is_logarithmic()), (vec![300.0, 700.0, 1100.0, 1500.0], false));
        let axis: InputAxis = "v_n=0.1:100:4".parse().unwrap();
        assert!(axis.is_logarithmic());
        for (value, expected) in axis.values().into_iter().zip([0.1, 1.0, 10.0, 100.0]) {
            assert!((value / expected - 1.0).abs() < 1e-14, "{value}");
        }
        assert_eq!("v_t=0:100".parse::<InputAxis>().unwrap().points(), DEFAULT_POINTS);
        assert!(!"v_n=0:100".parse::<InputAxis>().unwrap().is_logarithmic());
    }

    #[test]
    fn faults_name_the_remedy() {
        let fault = |text: &str| text.parse::<InputAxis>().unwrap_err().to_string();
        for (text, part) in [
            ("v_n", "INPUT=LOW:HIGH"),
            ("v_n=1", "LOW:HIGH:POINTS"),
            ("coverge=0:1", "did you mean `coverage`"),
            ("v_n=2:1", "not below"),
            ("v_n=1:1", "not below"),
            ("v_n=a:1", "`a` is not a number"),
            ("v_n=0:1:1", "2 to 1001"),
            ("v_n=0:1:x", "whole number"),
            ("conversion=0:2", "between 0 and 1"),
            ("v_n=nan:2", "must be finite"),
            ("d=0:1e-3", "must be positive"),
        ] {
            assert!(fault(text).contains(part), "{text}: {}", fault(text));
        }
        assert!("T_p=-5".parse::<Setting>().unwrap_err().to_string().contains("must be positive"));
        assert!("T_p".parse::<Setting>().unwrap_err().to_string().contains("INPUT=VALUE"));
        let mut impact = Impact::default();
        "T_p=1500".parse::<Setting>().unwrap().apply(&mut impact);
        assert_eq!(impact.particle_temperature, 1500.0);
    }
}
