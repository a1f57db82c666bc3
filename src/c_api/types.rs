//! Types and numbers of the C interface.
#![allow(non_camel_case_types)]

use std::ffi::CStr;

use crate::impact::{Impact, ImpactError, Outcome};
use crate::model::Model;

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

/// Threads may share a model because the type says so, not because we promise it.
const _: () = {
    const fn shareable<T: Send + Sync>() {}
    shareable::<nw_model>();
};

/// What a call came to.
pub type nw_status = i32;
/// Done.
pub const NW_OK: nw_status = 0;
/// A required pointer is null.
pub const NW_NULL_POINTER: nw_status = 1;
/// `struct_size` (or a count) is not one that this library knows.
pub const NW_STRUCT_SIZE: nw_status = 2;
/// A text is not UTF-8.
pub const NW_NOT_UTF8: nw_status = 3;
/// The model file cannot be read.
pub const NW_FILE: nw_status = 4;
/// The model is at fault; the message names file, line, column, key and remedy.
pub const NW_MODEL: nw_status = 5;
/// The model has no such wall.
pub const NW_UNKNOWN_WALL: nw_status = 6;
/// A number has no physical meaning: it is not finite or out of its bounds.
pub const NW_BAD_STATE: nw_status = 7;
/// A property is not known at the temperature of the impact.
pub const NW_OUT_OF_RANGE: nw_status = 8;
/// An internal fault was stopped at the boundary.
pub const NW_PANIC: nw_status = 9;

/// A status in words.
pub(super) fn status_text(status: nw_status) -> &'static CStr {
    match status {
        NW_OK => c"done",
        NW_NULL_POINTER => c"a required pointer is null",
        NW_STRUCT_SIZE => {
            c"struct_size does not match this library; set it to sizeof, and rebuild with its header"
        }
        NW_NOT_UTF8 => c"a text is not UTF-8",
        NW_FILE => c"the model file cannot be read",
        NW_MODEL => c"the model is at fault",
        NW_UNKNOWN_WALL => c"the model has no such wall",
        NW_BAD_STATE => c"a number has no physical meaning (not finite, or out of its bounds)",
        NW_OUT_OF_RANGE => c"a property is not known at the temperature of the impact",
        NW_PANIC => c"internal fault, stopped at the boundary; please report it",
        _ => c"not a status of this library",
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

/// Bit of `flags`: a property or a fitted term was used outside the range it is stated for.
pub const NW_OUTSIDE_VALID_RANGE: u32 = 1;

/// One particle as it reaches a wall. Fill it with `nw_impact_init`, then set what you know.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
#[allow(non_snake_case)]
pub struct nw_impact {
    /// `sizeof(nw_impact)`.
    pub struct_size: u32,
    /// Index of the wall, from `nw_model_find_wall`.
    pub wall: u32,
    /// Speed towards the wall [m/s], not negative.
    pub v_n: f64,
    /// Speed along the wall [m/s], not negative.
    pub v_t: f64,
    /// Particle diameter [m], positive.
    pub d: f64,
    /// Particle temperature [K], positive.
    pub T_p: f64,
    /// Wall temperature [K], positive.
    pub T_w: f64,
    /// Carbon conversion 0 to 1; 1 where there is no carbon.
    pub conversion: f64,
    /// Thickness of powder on the wall [m].
    pub layer_thickness: f64,
    /// Thickness of the liquid film on the wall [m].
    pub film_thickness: f64,
    /// Speed of the gas along the wall [m/s].
    pub v_gas: f64,
    /// Roughness of the wall [m].
    pub roughness: f64,
    /// Spin [rad/s], positive when rolling forward along `v_t`.
    pub omega: f64,
    /// Share of the wall covered by non-sticky char, 0 to 1.
    pub coverage: f64,
    /// Seed of the run's random draws.
    pub seed: u64,
    /// What tells this impact from all others: the draws depend on `seed` and `key` only.
    pub key: u64,
    /// Thickness of the melt that earlier particles left on the wall [m].
    pub melt_thickness: f64,
}

impl Default for nw_impact {
    fn default() -> Self {
        Self::from(&Impact::default())
    }
}

/// Wall 0, seed and key 0.
impl From<&Impact> for nw_impact {
    fn from(impact: &Impact) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            wall: 0,
            v_n: impact.normal_speed,
            v_t: impact.tangential_speed,
            d: impact.diameter,
            T_p: impact.particle_temperature,
            T_w: impact.wall_temperature,
            conversion: impact.conversion,
            layer_thickness: impact.layer_thickness,
            film_thickness: impact.film_thickness,
            v_gas: impact.gas_speed,
            roughness: impact.roughness,
            omega: impact.spin,
            coverage: impact.coverage,
            seed: 0,
            key: 0,
            melt_thickness: impact.melt_thickness,
        }
    }
}

impl nw_impact {
    pub(super) fn to_impact(self) -> Impact {
        Impact {
            normal_speed: self.v_n,
            tangential_speed: self.v_t,
            diameter: self.d,
            particle_temperature: self.T_p,
            wall_temperature: self.T_w,
            conversion: self.conversion,
            layer_thickness: self.layer_thickness,
            film_thickness: self.film_thickness,
            gas_speed: self.v_gas,
            roughness: self.roughness,
            spin: self.omega,
            coverage: self.coverage,
            melt_thickness: self.melt_thickness,
        }
    }
}

/// What leaves the wall.
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
    /// Normal restitution of a particle that rebounds.
    pub e_n: f64,
    /// Tangential restitution of a particle that rebounds.
    pub e_t: f64,
    /// Probability of capture.
    pub p_stick: f64,
    /// Spin after a rebound [rad/s].
    pub omega: f64,
}

impl Default for nw_outcome {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            regime: NW_NSP_NSW,
            stuck: 0,
            flags: 0,
            e_n: 0.0,
            e_t: 0.0,
            p_stick: 0.0,
            omega: 0.0,
        }
    }
}

impl nw_outcome {
    pub(super) fn from_outcome(outcome: &Outcome) -> Self {
        Self {
            regime: outcome.regime as u32,
            stuck: u32::from(outcome.stuck),
            flags: if outcome.outside_range { NW_OUTSIDE_VALID_RANGE } else { 0 },
            e_n: outcome.normal_restitution,
            e_t: outcome.tangential_restitution,
            p_stick: outcome.sticking_probability,
            omega: outcome.spin,
            ..Self::default()
        }
    }
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
