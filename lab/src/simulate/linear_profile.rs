//! A number that may change along one axis of the case, for instance the temperature of a wall.

use nalgebra::Vector3;

use nearwall::input::{InputError, Section};

/// `key = 1700`, or `key = { axis = "z", at = [0, 0.8, 1.0], value = [1800, 1700, 1100] }`: linear between the places
/// [m], the end values beyond them.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearProfile {
    axis: usize,
    places: Vec<f64>,
    values: Vec<f64>,
}

impl LinearProfile {
    /// The same number everywhere.
    pub fn constant(value: f64) -> Self {
        Self { axis: 2, places: vec![0.0], values: vec![value] }
    }

    /// Reads `key`, whose values have to lie in `low..=high`; `None` when it is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] for lists that do not fit together or values out of bounds.
    pub fn read(section: &Section<'_>, key: &str, low: f64, high: f64) -> Result<Option<Self>, InputError> {
        if !section.is_section(key) {
            return Ok(section.number_within(key, low, high)?.map(Self::constant));
        }
        let table = section.required_section(key)?;
        let axis = match table.choice("axis", &["x", "y", "z"])?.as_deref() {
            Some("x") => 0,
            Some("y") => 1,
            _ => 2,
        };
        let list = |key: &str| table.numbers(key)?.ok_or_else(|| table.missing(key, "a list of numbers"));
        let (places, values) = (list("at")?, list("value")?);
        table.finish()?;
        if places.is_empty() || places.len() != values.len() {
            return Err(table.fault("value", "`at` and `value` need the same number of entries"));
        }
        if places.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(table.fault("at", "the places have to increase"));
        }
        if let Some(value) = values.iter().find(|value| !(low..=high).contains(*value)) {
            return Err(table.fault("value", format!("{value} is outside {low} to {high}")));
        }
        Ok(Some(Self { axis, places, values }))
    }

    /// The value at a position [m].
    pub fn at(&self, position: &Vector3<f64>) -> f64 {
        let place = position[self.axis];
        let after = self.places.partition_point(|p| *p <= place);
        if after == 0 || after == self.places.len() {
            return self.values[after.min(self.values.len() - 1)];
        }
        let share = (place - self.places[after - 1]) / (self.places[after] - self.places[after - 1]);
        self.values[after - 1] + share * (self.values[after] - self.values[after - 1])
    }

    /// The change of the value over length [1/m] at a position [m].
    pub fn gradient(&self, position: &Vector3<f64>) -> Vector3<f64> {
        let after = self.places.partition_point(|p| *p <= position[self.axis]);
        if after == 0 || after == self.places.len() {
            return Vector3::zeros();
        }
        let rise = self.values[after] - self.values[after - 1];
        Vector3::ith(self.axis, rise / (self.places[after] - self.places[after - 1]))
    }

    /// Smallest and largest value.
    pub fn extremes(&self) -> [f64; 2] {
        let fold = |start: f64, pick: fn(f64, f64) -> f64| self.values.iter().copied().fold(start, pick);
        [fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_between_the_places_and_flat_beyond() {
        let profile = LinearProfile { axis: 2, places: vec![0.0, 1.0], values: vec![10.0, 30.0] };
        let at = |z: f64| profile.at(&Vector3::new(5.0, 5.0, z));
        assert_eq!([at(-1.0), at(0.25), at(1.0), at(9.0)], [10.0, 15.0, 30.0, 30.0]);
        assert_eq!(profile.gradient(&Vector3::new(5.0, 5.0, 0.25)), Vector3::new(0.0, 0.0, 20.0));
        assert_eq!(profile.gradient(&Vector3::new(0.0, 0.0, 2.0)), Vector3::zeros());
        assert_eq!(profile.extremes(), [10.0, 30.0]);
        assert_eq!(LinearProfile::constant(7.0).at(&Vector3::zeros()), 7.0);
    }
}
