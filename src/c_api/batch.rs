//! Many impacts in one call: arrays in, arrays out.
#![allow(non_camel_case_types)]

use super::boundary::{get, guarded_status, put, reader, sized};
use super::impact::nw_impacts;
use super::types::{
    NW_NULL_POINTER, NW_OUTSIDE_VALID_RANGE, NW_STRUCT_SIZE, flags, nw_model, nw_status, zero_by_default,
};
use crate::impact::{INPUTS, Impact, Input, Outcome};
use crate::model::block::{BLOCK, Block, Outcomes, Workspace};
use crate::model::{Model, TemperatureRanges};

/// Arrays that receive the outcomes, each with room for `count` entries of `nw_impacts`; null if not wanted. They must
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

/// Resolves many impacts, with the same bits as `nw_resolve` for each.
///
/// All impacts are checked first. If one of them is invalid, no outcome is written, the status is that of the first
/// invalid impact, and `first_bad` (may be null) receives its index.
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
            return Err(NW_STRUCT_SIZE);
        }
        if impacts.v_n.is_null() && impacts.count > 0 {
            return Err(NW_NULL_POINTER);
        }
        let model = model.inner();
        // SAFETY: the caller's promises.
        unsafe {
            impacts.check(model).map_err(|(index, fault)| {
                if !first_bad.is_null() {
                    first_bad.write_unaligned(index);
                }
                fault
            })?;
            impacts.resolve(model, &outcomes)?;
        }
        Ok(())
    };
    guarded_status(resolve)
}

impl nw_impacts {
    /// Checks all impacts; returns index and status of the first invalid one.
    ///
    /// # Safety
    /// Every array that is not null has `count` entries.
    unsafe fn check(&self, model: &Model) -> Result<(), (usize, nw_status)> {
        let within = |value: f64, [low, high]: [f64; 2]| (value >= low) & (value <= high);
        let usual = Impact::default();
        // SAFETY: the caller's promise, here and below.
        let wall = |index| unsafe { get(self.walls, index, self.wall) as usize };
        let known = |ranges: TemperatureRanges, index| unsafe {
            within(get(self.T_p, index, usual.particle_temperature), ranges.particle)
                & within(get(self.T_w, index, usual.wall_temperature), ranges.wall)
                & (get(self.T_under, index, 0.0) == 0.0)
                & (get(self.melt_thickness, index, 0.0) == 0.0)
        };
        let decided = if self.walls.is_null() {
            let all_known = |ranges| {
                let each = |all, index| all & known(ranges, index);
                ranges == TemperatureRanges::ALL || (0..self.count).fold(true, each)
            };
            self.count == 0 || model.decided_temperatures(wall(0)).is_some_and(all_known)
        } else {
            let is_known = |index| model.decided_temperatures(wall(index)).is_some_and(|r| known(r, index));
            (0..self.count).all(is_known)
        };
        let allowed = |(column, Input { bounds, .. }): (*const f64, &Input)| {
            // SAFETY: as above. Without branches, so that memory limits the speed.
            let in_bounds = |all, index| all & bounds.allow(unsafe { get(column, index, f64::NAN) });
            column.is_null() || (0..self.count).fold(true, in_bounds)
        };
        if decided && self.columns().into_iter().zip(&INPUTS).all(allowed) {
            return Ok(());
        }
        (0..self.count).try_for_each(|index| {
            // SAFETY: `index < count`.
            let (wall, impact, _) = unsafe { self.entry(index) };
            model.check(wall, &impact).map_err(|error| (index, error.into()))
        })
    }

    /// Resolves all impacts, block by block.
    ///
    /// # Safety
    /// Every array that is not null has `count` entries.
    unsafe fn resolve(&self, model: &Model, outcomes: &nw_outcomes) -> Result<(), nw_status> {
        let (mut block, mut results, mut workspace) =
            (Block::default(), Outcomes::default(), Workspace::default());
        for start in (0..self.count).step_by(BLOCK) {
            block.length = (self.count - start).min(BLOCK);
            // SAFETY: `start + length <= count`.
            unsafe {
                let wall = get(self.walls, start, self.wall);
                let walls = start..start + block.length;
                // A block has no columns for the inputs that the model file declares.
                let plain = self.extra.iter().all(|array| array.is_null());
                if plain && walls.clone().all(|index| get(self.walls, index, wall) == wall) {
                    self.load(start, &mut block);
                    model.resolve_block(wall as usize, &block, self.seed, &mut results, &mut workspace)?;
                    outcomes.store(start, block.length, &results);
                } else {
                    for index in walls {
                        let (wall, impact, draw) = self.entry(index);
                        outcomes.put(index, &model.resolve(wall, &impact, draw)?);
                    }
                }
            }
        }
        Ok(())
    }

    /// Fills a block with the impacts from `start` on. Columns without an array keep their values.
    ///
    /// # Safety
    /// `start + block.length <= count`, and every array that is not null has `count` entries.
    unsafe fn load(&self, start: usize, block: &mut Block) {
        // SAFETY: the caller's promise.
        unsafe {
            for (column, array) in block.inputs.iter_mut().zip(self.columns()) {
                if !array.is_null() {
                    copy(array.add(start), column.as_mut_ptr(), block.length);
                }
            }
            if self.key.is_null() {
                block.keys.iter_mut().zip(start as u64..).for_each(|(key, index)| *key = index);
            } else {
                copy(self.key.add(start), block.keys.as_mut_ptr(), block.length);
            }
        }
    }
}

zero_by_default!(nw_outcomes);

impl nw_outcomes {
    /// Writes one outcome.
    ///
    /// # Safety
    /// Every array that is not null has room for more than `index` entries.
    unsafe fn put(&self, index: usize, outcome: &Outcome) {
        // SAFETY: the caller's promise.
        unsafe {
            put(self.e_n, index, outcome.normal_restitution);
            put(self.e_t, index, outcome.tangential_restitution);
            put(self.p_stick, index, outcome.sticking_probability);
            put(self.omega, index, outcome.spin);
            put(self.regime, index, outcome.regime as u32);
            put(self.stuck, index, u32::from(outcome.stuck));
            put(self.flags, index, flags(outcome));
        }
    }

    /// Writes a block of outcomes.
    ///
    /// # Safety
    /// Every array that is not null has room for `start + length` entries.
    unsafe fn store(&self, start: usize, length: usize, outcomes: &Outcomes) {
        const { assert!(NW_OUTSIDE_VALID_RANGE == 1, "a block writes 1 for outside") };
        // SAFETY: the caller's promise.
        unsafe {
            put_all(self.e_n, start, &outcomes.normal_restitution[..length]);
            put_all(self.e_t, start, &outcomes.tangential_restitution[..length]);
            put_all(self.p_stick, start, &outcomes.sticking_probability[..length]);
            put_all(self.omega, start, &outcomes.spin[..length]);
            put_all(self.regime, start, &outcomes.regime[..length]);
            put_all(self.stuck, start, &outcomes.stuck[..length]);
            put_all(self.flags, start, &outcomes.outside_range[..length]);
        }
    }
}

/// Copies `count` entries; neither side needs alignment.
///
/// # Safety
/// `from` can be read and `to` written for `count` entries; they do not overlap.
unsafe fn copy<T>(from: *const T, to: *mut T, count: usize) {
    // SAFETY: the caller's promise; bytes need no alignment.
    unsafe { std::ptr::copy_nonoverlapping(from.cast::<u8>(), to.cast::<u8>(), count * size_of::<T>()) };
}

/// Writes entries of an array that may be null.
///
/// # Safety
/// The array is null or has room for `start + values.len()` entries, none of them in `values`.
unsafe fn put_all<T>(array: *mut T, start: usize, values: &[T]) {
    if !array.is_null() {
        // SAFETY: not null, and long enough by the caller's promise.
        unsafe { copy(values.as_ptr(), array.add(start), values.len()) };
    }
}
