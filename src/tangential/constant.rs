//! Constant tangential restitution: `e_t` is one number, 0 to 1.
//!
//! MIGRAINE used 1 and measured 0.8 for tungsten; Troiano et al. fit 0.76 to wax over all angles.

use crate::input::{InputError, Section};

/// Reads `e_t` [1], 0 to 1.
pub(super) fn read(section: &Section<'_>) -> Result<f64, InputError> {
    section.number_within("e_t", 0.0, 1.0)?.ok_or_else(|| section.missing("e_t", "a number 0 to 1"))
}
