//! Many impacts in one call: arrays in, arrays out.
#![allow(non_camel_case_types)]

use super::boundary::{guarded_status, reader};
use super::sized;
use super::types::{NW_NULL_POINTER, NW_OUTSIDE_VALID_RANGE, NW_STRUCT_SIZE, nw_impact, nw_model, nw_status};
use crate::impact::{BOUNDS, Bounds, Impact, Outcome};
use crate::model::Model;
use crate::model::block::{BLOCK, Block, Outcomes};
use crate::rng::ImpactRng;

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
    /// Checks all impacts; the index of the first at fault.
    ///
    /// # Safety
    /// Every array that is not null has `count` entries.
    unsafe fn check(&self, model: &Model) -> Result<(), (usize, nw_status)> {
        // SAFETY: the caller's promise.
        let prepared = unsafe {
            let wall = |index| get(self.walls, index, self.wall) as usize;
            let differing = if self.walls.is_null() { self.count.min(1) } else { self.count };
            (0..differing).all(|index| model.is_prepared(wall(index)))
        };
        let allowed = |(column, bounds): (*const f64, &Bounds)| {
            let in_bounds = |all, index| all & bounds.allow(unsafe { get(column, index, f64::NAN) });
            // SAFETY: as above. Without branches, so that it runs as fast as memory gives it.
            column.is_null() || (0..self.count).fold(true, in_bounds)
        };
        if prepared && self.columns().into_iter().zip(&BOUNDS).all(allowed) {
            return Ok(());
        }
        (0..self.count).try_for_each(|index| {
            // SAFETY: `index < count`.
            let (wall, impact, _) = unsafe { self.entry(index) };
            model.check(wall, &impact).map_err(|error| (index, error.into()))
        })
    }

    /// Decides all impacts, block by block.
    ///
    /// # Safety
    /// Every array that is not null has `count` entries.
    unsafe fn resolve(&self, model: &Model, outcomes: &nw_outcomes) -> Result<(), nw_status> {
        let (mut block, mut results) = (Block::default(), Outcomes::default());
        for start in (0..self.count).step_by(BLOCK) {
            block.length = (self.count - start).min(BLOCK);
            // SAFETY: `start + length <= count`.
            unsafe {
                let wall = get(self.walls, start, self.wall);
                let walls = start..start + block.length;
                if walls.clone().all(|index| get(self.walls, index, wall) == wall) {
                    self.load(start, &mut block);
                    model.resolve_block(wall as usize, &block, self.seed, &mut results)?;
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

    /// Fills a block with the impacts from `start` on. What has no array stays as it is.
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

    /// The arrays of the inputs, in the order of [`INPUTS`](crate::impact::INPUTS).
    fn columns(&self) -> [*const f64; BOUNDS.len()] {
        [
            self.v_n,
            self.v_t,
            self.d,
            self.T_p,
            self.T_w,
            self.conversion,
            self.layer_thickness,
            self.film_thickness,
            self.v_gas,
            self.roughness,
            self.omega,
            self.coverage,
            self.melt_thickness,
        ]
    }

    /// One impact with its wall and its draws.
    ///
    /// # Safety
    /// `index < count`, and every array that is not null has `count` entries.
    unsafe fn entry(&self, index: usize) -> (usize, Impact, ImpactRng) {
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
            (wall, impact.to_impact(), ImpactRng::new(self.seed, key))
        }
    }
}

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
            put(self.flags, index, if outcome.outside_range { NW_OUTSIDE_VALID_RANGE } else { 0 });
        }
    }

    /// Writes a block of outcomes.
    ///
    /// # Safety
    /// Every array that is not null has room for `start + length` entries.
    unsafe fn store(&self, start: usize, length: usize, outcomes: &Outcomes) {
        const { assert!(NW_OUTSIDE_VALID_RANGE == 1, "what a block calls outside is the flag") };
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

/// Copies `count` entries, of which the caller's need not be aligned.
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
