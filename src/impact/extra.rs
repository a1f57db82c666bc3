//! The values of inputs that a model file declares.

use std::ops::{Deref, DerefMut};

/// Most inputs that a model file may declare.
pub const EXTRA_INPUTS: usize = 8;

/// The values of the inputs that a model file declares, in its order; NaN where the caller does not state one.
///
/// Two are equal if their bits are: a value that is not stated equals itself.
#[derive(Debug, Clone, Copy)]
pub struct ExtraInputs(pub [f64; EXTRA_INPUTS]);

impl Default for ExtraInputs {
    fn default() -> Self {
        Self([f64::NAN; EXTRA_INPUTS])
    }
}

impl PartialEq for ExtraInputs {
    fn eq(&self, other: &Self) -> bool {
        self.0.map(f64::to_bits) == other.0.map(f64::to_bits)
    }
}

impl Deref for ExtraInputs {
    type Target = [f64; EXTRA_INPUTS];

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl DerefMut for ExtraInputs {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_that_are_not_stated_are_equal() {
        let mut one = ExtraInputs::default();
        assert_eq!(one, ExtraInputs::default());
        one[3] = 0.5;
        assert_ne!(one, ExtraInputs::default());
        assert_eq!(one.iter().filter(|value| value.is_nan()).count(), EXTRA_INPUTS - 1);
    }
}
