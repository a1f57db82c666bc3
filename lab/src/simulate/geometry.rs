//! Reads numbers, vectors and directions from a case file.

use nalgebra::Vector3;

use nearwall::input::{InputError, Section};

/// Three numbers `[x, y, z]`; `None` when the key is absent.
pub(super) fn vector(section: &Section<'_>, key: &str) -> Result<Option<Vector3<f64>>, InputError> {
    match section.numbers(key)?.as_deref() {
        None => Ok(None),
        Some(&[x, y, z]) => Ok(Some(Vector3::new(x, y, z))),
        Some(_) => Err(section.fault(key, "expected three numbers [x, y, z]")),
    }
}

/// Three numbers that must be there.
pub(super) fn required_vector(section: &Section<'_>, key: &str) -> Result<Vector3<f64>, InputError> {
    vector(section, key)?.ok_or_else(|| section.missing(key, "three numbers [x, y, z]"))
}

/// A direction that must be there, brought to length 1.
pub(super) fn direction(section: &Section<'_>, key: &str) -> Result<Vector3<f64>, InputError> {
    let given = required_vector(section, key)?;
    given.try_normalize(1e-12).ok_or_else(|| section.fault(key, "a direction needs a length above zero"))
}

/// A number in `low..=high` that must be there.
pub(super) fn required_within(
    section: &Section<'_>,
    key: &str,
    low: f64,
    high: f64,
) -> Result<f64, InputError> {
    section.number_within(key, low, high)?.ok_or_else(|| section.missing(key, "a number"))
}

/// A whole number that is not negative; `None` when the key is absent.
pub(super) fn whole(section: &Section<'_>, key: &str, high: f64) -> Result<Option<u64>, InputError> {
    match section.number_within(key, 0.0, high)? {
        Some(value) if value.fract() != 0.0 => Err(section.fault(key, "a whole number")),
        value => Ok(value.map(|value| value as u64)),
    }
}

/// Two directions across `along`, each of length 1 and at right angles to it and to each other.
pub(super) fn across(along: &Vector3<f64>) -> [Vector3<f64>; 2] {
    // Starting from the axis that lies least along `along` keeps the cross product long.
    let least = along.map(f64::abs).imin();
    let first = along.cross(&Vector3::ith(least, 1.0)).normalize();
    [first, along.cross(&first)]
}
