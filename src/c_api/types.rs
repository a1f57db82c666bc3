//! Types and numbers of the C interface.
#![allow(non_camel_case_types)]

use std::ffi::CStr;

use crate::impact::{ImpactError, Outcome};
use crate::model::Model;
use crate::model::WallHeatError;

/// The default of C structs: their size, and zero or null in every other field.
macro_rules! zero_by_default {
    ($($name:ident),*) => {$(
        impl Default for $name {
            fn default() -> Self {
                // SAFETY: every field is a number or a pointer, which all may be zero.
                let zero = unsafe { std::mem::zeroed::<Self>() };
                Self { struct_size: size_of::<Self>() as u32, ..zero }
            }
        }
    )*};
}
pub(super) use zero_by_default;

/// A loaded model: opaque, immutable, shareable between threads.
pub struct nw_model(Model);

impl nw_model {
    pub(super) fn into_handle(model: Model) -> *mut Self {
        Box::into_raw(Box::new(Self(model)))
    }

    pub(super) fn inner(&self) -> &Model {
        &self.0
    }
}

/// The compiler checks that threads may share a model.
const _: () = {
    const fn shareable<T: Send + Sync>() {}
    shareable::<nw_model>();
};

/// Status returned by every call.
pub type nw_status = i32;
/// Success.
pub const NW_OK: nw_status = 0;
/// A required pointer is null.
pub const NW_NULL_POINTER: nw_status = 1;
/// `struct_size` is not the size that this library expects, or a count is too large.
pub const NW_STRUCT_SIZE: nw_status = 2;
/// A string is not valid UTF-8.
pub const NW_NOT_UTF8: nw_status = 3;
/// The model file cannot be read.
pub const NW_FILE: nw_status = 4;
/// The model is invalid; the message names file, line, column, key and remedy.
pub const NW_MODEL: nw_status = 5;
/// The model has no wall with this name or index.
pub const NW_UNKNOWN_WALL: nw_status = 6;
/// An input is not finite or violates its bounds.
pub const NW_BAD_STATE: nw_status = 7;
/// A property is needed at a temperature outside its table; `nw_temperature_ranges` returns the limits of a wall.
pub const NW_OUT_OF_RANGE: nw_status = 8;
/// An internal error; please report it.
pub const NW_PANIC: nw_status = 9;
/// The model file declares no input with this index; `nw_extra_input_count` returns their number.
pub const NW_UNKNOWN_INPUT: nw_status = 10;
/// The material of a layer of the deposit has no `thermal_conductivity` in the model file or the library.
pub const NW_NO_CONDUCTIVITY: nw_status = 11;
/// The material of the particles has no `heat_capacity`, and the caller gives none.
pub const NW_NO_HEAT_CAPACITY: nw_status = 12;

/// The text of a status.
pub(super) fn status_text(status: nw_status) -> &'static CStr {
    match status {
        NW_OK => c"success",
        NW_NULL_POINTER => c"a required pointer is null",
        NW_STRUCT_SIZE => {
            c"struct_size does not match this library; set it to sizeof, and rebuild with its header"
        }
        NW_NOT_UTF8 => c"a string is not valid UTF-8",
        NW_FILE => c"the model file cannot be read",
        NW_MODEL => c"the model is invalid",
        NW_UNKNOWN_WALL => c"the model has no such wall",
        NW_BAD_STATE => c"an input is not finite or outside its bounds",
        NW_OUT_OF_RANGE => {
            c"a material property is not defined at the temperature of the impact; see nw_temperature_ranges"
        }
        NW_PANIC => c"internal error; please report it",
        NW_UNKNOWN_INPUT => c"the model file declares no such input",
        NW_NO_CONDUCTIVITY => {
            c"the material of the particle, its ash or the wall's slag has no thermal_conductivity; give it one"
        }
        NW_NO_HEAT_CAPACITY => c"the material of the particles has no heat_capacity; give it one",
        _ => c"unknown status",
    }
}

/// Which of particle and wall is sticky.
pub type nw_regime = u32;
/// Non-sticky particle, non-sticky wall.
pub const NW_NSP_NSW: nw_regime = 0;
/// Non-sticky particle, sticky wall.
pub const NW_NSP_SW: nw_regime = 1;
/// Sticky particle, non-sticky wall.
pub const NW_SP_NSW: nw_regime = 2;
/// Sticky particle, sticky wall.
pub const NW_SP_SW: nw_regime = 3;

/// Bit of `flags`: a property or a fitted term was used outside its stated range.
pub const NW_OUTSIDE_VALID_RANGE: u32 = 1;

/// Result of an impact.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_outcome {
    /// `sizeof(nw_outcome)`.
    pub struct_size: u32,
    /// Which of particle and wall is sticky.
    pub regime: nw_regime,
    /// 1 when this particle is captured (drawn from `p_stick`), 0 when it rebounds.
    pub stuck: u32,
    /// Bits: `NW_OUTSIDE_VALID_RANGE`.
    pub flags: u32,
    /// Normal restitution [1] if the particle rebounds.
    pub e_n: f64,
    /// Tangential restitution [1] if the particle rebounds.
    pub e_t: f64,
    /// Probability of capture [1].
    pub p_stick: f64,
    /// Spin after a rebound [rad/s].
    pub omega: f64,
}

zero_by_default!(nw_outcome);

impl nw_outcome {
    pub(super) fn from_outcome(outcome: &Outcome) -> Self {
        Self {
            regime: outcome.regime as u32,
            stuck: u32::from(outcome.stuck),
            flags: flags(outcome),
            e_n: outcome.normal_restitution,
            e_t: outcome.tangential_restitution,
            p_stick: outcome.sticking_probability,
            omega: outcome.spin,
            ..Self::default()
        }
    }
}

/// The bits of `flags`.
pub(super) fn flags(outcome: &Outcome) -> u32 {
    if outcome.outside_range { NW_OUTSIDE_VALID_RANGE } else { 0 }
}

/// The status of an impact that cannot be resolved.
impl From<ImpactError> for nw_status {
    fn from(error: ImpactError) -> Self {
        match error {
            ImpactError::Unusable { .. } => NW_BAD_STATE,
            ImpactError::OutOfRange { .. } => NW_OUT_OF_RANGE,
            ImpactError::NoSuchWall(_) => NW_UNKNOWN_WALL,
        }
    }
}

/// The status of a wall without temperatures.
impl From<WallHeatError> for nw_status {
    fn from(error: WallHeatError) -> Self {
        match error {
            WallHeatError::NoConductivity(_) => NW_NO_CONDUCTIVITY,
            WallHeatError::Deposit(error) => error.into(),
            WallHeatError::Conduction(_) => NW_BAD_STATE,
        }
    }
}
