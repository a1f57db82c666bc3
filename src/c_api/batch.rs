//! Many impacts in one call: arrays in, arrays out.
#![allow(non_camel_case_types)]

use super::boundary::{Fault, guarded, reader};
use super::sized;
use super::types::{
    NW_NULL_POINTER, NW_OK, NW_OUTSIDE_VALID_RANGE, NW_STRUCT_SIZE, nw_impact, nw_model, nw_status,
};
use crate::draw::Draw;
use crate::impact::Impact;

/// Arrays of impacts, each with `count` entries. Only `v_n` is required; a null array stands for the value that
/// `nw_impact_init` gives, and for `key` the entry's own index.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
#[allow(non_snake_case)]
pub struct nw_impacts {
    /// `sizeof(nw_impacts)`.
    pub struct_size: u32,
    /// Wall of every impact where `walls` is null.
    pub wall: u32,
    /// Number of impacts.
    pub count: usize,
    /// Seed of all draws.
    pub seed: u64,
    /// Index of each impact's wall.
    pub walls: *const u32,
    /// Speed towards the wall [m/s].
    pub v_n: *const f64,
    /// Speed along the wall [m/s].
    pub v_t: *const f64,
    /// Particle diameter [m].
    pub d: *const f64,
    /// Particle temperature [K].
    pub T_p: *const f64,
    /// Wall temperature [K].
    pub T_w: *const f64,
    /// Carbon conversion.
    pub conversion: *const f64,
    /// Thickness of powder on the wall [m].
    pub layer_thickness: *const f64,
    /// Thickness of the liquid film [m].
    pub film_thickness: *const f64,
    /// Speed of the gas along the wall [m/s].
    pub v_gas: *const f64,
    /// Roughness of the wall [m].
    pub roughness: *const f64,
    /// Spin [rad/s].
    pub omega: *const f64,
    /// Share of the wall covered by non-sticky char.
    pub coverage: *const f64,
    /// Key of each impact's draws.
    pub key: *const u64,
    /// Thickness of the melt that earlier particles left on the wall [m].
    pub melt_thickness: *const f64,
}

/// Arrays for the outcomes, each with room for as many entries as there are impacts; null where not wanted. They must
/// not overlap the inputs or each other.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct nw_outcomes {
    /// `sizeof(nw_outcomes)`.
    pub struct_size: u32,
    /// Normal restitution.
    pub e_n: *mut f64,
    /// Tangential restitution.
    pub e_t: *mut f64,
    /// Probability of capture.
    pub p_stick: *mut f64,
    /// Spin after a rebound [rad/s].
    pub omega: *mut f64,
    /// Which of particle and wall is sticky.
    pub regime: *mut u32,
    /// 1 captured, 0 rebounds.
    pub stuck: *mut u32,
    /// Bits as in `nw_outcome`.
    pub flags: *mut u32,
}

/// Decides many impacts: the same bits as `nw_resolve` one by one.
///
/// All impacts are checked first. If one cannot be resolved nothing is written to the outcomes, the status is that of
/// the first such impact, and its index goes to `first_bad` (may be null).
///
/// # Safety
/// `model` is a loaded model; `impacts` and `outcomes` begin with their `struct_size`; every array that is not null has
/// `count` entries; `first_bad` can be written or is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_resolve_batch(
    model: *const nw_model,
    impacts: *const nw_impacts,
    outcomes: *const nw_outcomes,
    first_bad: *mut usize,
) -> nw_status {
    let resolve = || {
        // SAFETY: the caller's promises.
        let (model, impacts, outcomes) = unsafe { (reader(model)?, sized(impacts)?, sized(outcomes)?) };
        if impacts.count > isize::MAX as usize / size_of::<f64>() {
            return Err(Fault::plain(NW_STRUCT_SIZE));
        }
        if impacts.v_n.is_null() && impacts.count > 0 {
            return Err(Fault::plain(NW_NULL_POINTER));
        }
        let model = model.inner();
        for index in 0..impacts.count {
            // SAFETY: `index < count`.
            let (wall, impact, _) = unsafe { impacts.entry(index) };
            model.check(wall, &impact).inspect_err(|_| {
                if !first_bad.is_null() {
                    // SAFETY: not null, and writable by the caller's promise.
                    unsafe { first_bad.write_unaligned(index) };
                }
            })?;
        }
        for index in 0..impacts.count {
            // SAFETY: `index < count`, for the inputs and for the outputs.
            let (wall, impact, draw) = unsafe { impacts.entry(index) };
            let outcome = model.resolve(wall, &impact, draw)?;
            let flags = if outcome.outside_range { NW_OUTSIDE_VALID_RANGE } else { 0 };
            unsafe {
                put(outcomes.e_n, index, outcome.normal_restitution);
                put(outcomes.e_t, index, outcome.tangential_restitution);
                put(outcomes.p_stick, index, outcome.sticking_probability);
                put(outcomes.omega, index, outcome.spin);
                put(outcomes.regime, index, outcome.regime as u32);
                put(outcomes.stuck, index, u32::from(outcome.stuck));
                put(outcomes.flags, index, flags);
            }
        }
        Ok(())
    };
    guarded(resolve).map_or_else(|fault| fault.status, |()| NW_OK)
}

impl nw_impacts {
    /// One impact with its wall and its draws.
    ///
    /// # Safety
    /// `index < count`, and every array that is not null has `count` entries.
    unsafe fn entry(&self, index: usize) -> (usize, Impact, Draw) {
        let default = nw_impact::default();
        // SAFETY: the caller's promise.
        unsafe {
            let impact = nw_impact {
                v_n: get(self.v_n, index, default.v_n),
                v_t: get(self.v_t, index, default.v_t),
                d: get(self.d, index, default.d),
                T_p: get(self.T_p, index, default.T_p),
                T_w: get(self.T_w, index, default.T_w),
                conversion: get(self.conversion, index, default.conversion),
                layer_thickness: get(self.layer_thickness, index, default.layer_thickness),
                film_thickness: get(self.film_thickness, index, default.film_thickness),
                v_gas: get(self.v_gas, index, default.v_gas),
                roughness: get(self.roughness, index, default.roughness),
                omega: get(self.omega, index, default.omega),
                coverage: get(self.coverage, index, default.coverage),
                melt_thickness: get(self.melt_thickness, index, default.melt_thickness),
                ..default
            };
            let wall = get(self.walls, index, self.wall) as usize;
            let key = get(self.key, index, index as u64);
            (wall, impact.to_impact(), Draw::new(self.seed, key))
        }
    }
}

/// An entry of an array that may be null.
///
/// # Safety
/// The array is null or has more than `index` entries.
unsafe fn get<T: Copy>(array: *const T, index: usize, default: T) -> T {
    // SAFETY: not null, and long enough by the caller's promise.
    if array.is_null() { default } else { unsafe { array.add(index).read_unaligned() } }
}

/// Writes an entry of an array that may be null.
///
/// # Safety
/// The array is null or has room for more than `index` entries.
unsafe fn put<T>(array: *mut T, index: usize, value: T) {
    if !array.is_null() {
        // SAFETY: not null, and long enough by the caller's promise.
        unsafe { array.add(index).write_unaligned(value) };
    }
}
