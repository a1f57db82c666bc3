//! Constant normal restitution, as in most codes; for comparison.
//!
//! `e_n` is one number, 0 to 1, for every impact; adhesion holds no particle.

use crate::input::{InputError, Section};

/// Reads `e_n` [1], 0 to 1.
pub(super) fn read(section: &Section<'_>) -> Result<f64, InputError> {
    section.number_within("e_n", 0.0, 1.0)?.ok_or_else(|| section.missing("e_n", "a number 0 to 1"))
}
