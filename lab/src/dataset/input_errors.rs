//! Standard errors of the inputs of an impact.

use super::column_names::{ANGLE_ERROR, INPUT_ERRORS, SPEED_ERROR};
use super::impact_velocity::ImpactVelocity;
use super::number::{NamedColumns, NumberColumn};
use super::row_error::RowFault;
use nearwall::impact::{INPUTS, Impact, Input};

/// Every input, with a lifetime that an iterator may return.
static ALL_INPUTS: &[Input; INPUTS.len()] = &INPUTS;

/// Places of the speeds in [`INPUT_ERRORS`].
const SPEED_PLACES: [usize; 2] = [0, 1];

/// Standard errors of the inputs of a row, in the units of the inputs; 0 where none is stated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InputErrors {
    of: [f64; INPUT_ERRORS.len()],
}

impl InputErrors {
    /// The inputs with a standard error above 0, each with that error in the unit of the input.
    pub fn each(&self) -> impl Iterator<Item = (&'static Input, f64)> + use<> {
        let inputs = INPUT_ERRORS.iter().map(|(_, place)| &ALL_INPUTS[*place]);
        inputs.zip(self.of).filter(|(_, error)| *error > 0.0)
    }

    /// The standard error of the input of this name, in its unit; 0 where none is stated.
    pub fn of(&self, input: &str) -> f64 {
        self.each().find(|(known, _)| known.name == input).map_or(0.0, |(_, error)| error)
    }
}

/// The columns of standard errors of inputs.
pub(super) struct InputErrorColumns {
    columns: [Option<NumberColumn>; INPUT_ERRORS.len()],
    speed: Option<NumberColumn>,
    /// In degrees once read.
    angle: Option<NumberColumn>,
}

impl InputErrorColumns {
    pub(super) fn new(named: &NamedColumns) -> Self {
        Self {
            columns: INPUT_ERRORS.map(|(name, _)| named.column(name)),
            speed: named.column(SPEED_ERROR),
            angle: named.column(ANGLE_ERROR),
        }
    }

    /// Reads the errors of a row. Those of speed and angle are propagated to the speeds whose own error is blank.
    ///
    /// # Errors
    /// The reason, for a cell that is not a number, is negative or infinite.
    pub(super) fn read(
        &self,
        cells: &csv::StringRecord,
        impact: &Impact,
        velocity: &ImpactVelocity,
    ) -> Result<InputErrors, RowFault> {
        let mut stated = [None; INPUT_ERRORS.len()];
        for (stated, column) in stated.iter_mut().zip(&self.columns) {
            *stated = read_error(column.as_ref(), cells)?;
        }
        let speed = read_error(self.speed.as_ref(), cells)?.unwrap_or(0.0);
        let angle = read_error(self.angle.as_ref(), cells)?.unwrap_or(0.0).to_radians();
        let known = SPEED_PLACES.map(|place| stated[place].unwrap_or(0.0));
        let propagated = velocity.propagate(impact, known, speed, angle);
        let mut of = stated.map(|error| error.unwrap_or(0.0));
        for (place, propagated) in SPEED_PLACES.into_iter().zip(propagated) {
            of[place] = stated[place].unwrap_or(propagated);
        }
        Ok(InputErrors { of })
    }
}

fn read_error(column: Option<&NumberColumn>, cells: &csv::StringRecord) -> Result<Option<f64>, RowFault> {
    let Some(column) = column else { return Ok(None) };
    match column.read_finite(cells)? {
        Some(error) if error < 0.0 => Err(RowFault::Negative(column.name)),
        error => Ok(error),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_named_like_their_inputs() {
        for (name, place) in INPUT_ERRORS {
            assert_eq!(name, format!("{}_err", INPUTS[place].name));
        }
    }
}
