//! Uniform gas: the same velocity everywhere, `u = velocity` [m/s]; `[0, 0, 0]` is gas at rest.

use nalgebra::Vector3;

use super::VelocityField;
use crate::simulate::geometry::required_vector;
use nearwall::input::{InputError, Section};

/// A gas that moves at one velocity.
#[derive(Debug)]
pub struct Uniform {
    velocity: Vector3<f64>,
}

impl Uniform {
    /// Reads `velocity` [m/s].
    ///
    /// # Errors
    /// [`InputError::Fault`] when it is missing or no vector.
    pub fn read(section: &Section<'_>) -> Result<Self, InputError> {
        Ok(Self { velocity: required_vector(section, "velocity")? })
    }
}

impl Uniform {
    /// Gas at rest.
    pub(super) fn at_rest() -> Self {
        Self { velocity: Vector3::zeros() }
    }
}

impl VelocityField for Uniform {
    fn velocity(&self, _position: &Vector3<f64>) -> Vector3<f64> {
        self.velocity
    }
}
