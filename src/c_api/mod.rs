//! The C boundary: `nearwall.h`.
//!
//! Conventions: inputs come first, outputs last; `const` means it is not changed; every call returns a status, and
//! its outputs are untouched unless that is `NW_OK` (but for a message, and the index of the impact at fault); text
//! goes to the caller's buffer. A model never changes after it is loaded, so any number of threads may share it. No
//! panic crosses, and the caller's floating-point control and flags are as before. This is the only module with
//! `unsafe`: it turns C pointers into references, nothing else.
#![allow(unsafe_code)]

mod batch;
mod boundary;
mod deposit;
mod types;

use std::ffi::{CStr, c_char};
use std::path::Path;

use crate::impact::Regime;
use crate::model::Model;
use crate::rng::ImpactRng;

pub use batch::{nw_impacts, nw_outcomes, nw_resolve_batch};
use boundary::{Fault, guarded, guarded_status, reader, report};
pub use deposit::{
    nw_deposit, nw_deposit_add, nw_deposit_apply, nw_deposit_init, nw_deposit_initial, nw_deposit_source,
    nw_deposit_source_add, nw_deposit_source_init, nw_film_velocity,
};
use types::status_text;
pub use types::*;

/// Number of the binary interface; it changes when a struct, a function or a constant does.
pub const NW_ABI_VERSION: u32 = 1;

/// The interface version of the library that is loaded; compare with `NW_ABI_VERSION` of the header.
#[unsafe(no_mangle)]
pub extern "C" fn nw_abi_version() -> u32 {
    NW_ABI_VERSION
}

/// The version of the library, for instance `0.1.0`. Static text.
#[unsafe(no_mangle)]
pub extern "C" fn nw_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// A status in words. Static text, also for numbers that are no status.
#[unsafe(no_mangle)]
pub extern "C" fn nw_status_text(status: nw_status) -> *const c_char {
    status_text(status).as_ptr()
}

/// A regime by name, for instance `NSP-SW`. Static text.
#[unsafe(no_mangle)]
pub extern "C" fn nw_regime_name(regime: nw_regime) -> *const c_char {
    let text: &'static CStr = match regime {
        NW_NSP_NSW => c"NSP-NSW",
        NW_NSP_SW => c"NSP-SW",
        NW_SP_NSW => c"SP-NSW",
        NW_SP_SW => c"SP-SW",
        _ => c"not a regime",
    };
    text.as_ptr()
}

/// Reads a model file. On success `*model` is the model; free it with `nw_model_free`.
///
/// On failure the reason, with file, line, column, key and remedy, goes to `message` (at most `message_size` bytes with
/// the closing zero, cut at a character; may be null). On success `message` is left as it is.
///
/// # Safety
/// `path` is a zero-terminated text, `model` can be written, `message` has room for `message_size` bytes or is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_model_load(
    path: *const c_char,
    model: *mut *mut nw_model,
    message: *mut c_char,
    message_size: usize,
) -> nw_status {
    let load = || -> Result<(), Fault> {
        if path.is_null() || model.is_null() {
            return Err(NW_NULL_POINTER.into());
        }
        // SAFETY: not null, and zero-terminated by the caller's promise.
        let path = unsafe { CStr::from_ptr(path) };
        let path = path.to_str().map_err(|_| NW_NOT_UTF8)?;
        let loaded = Model::from_file(Path::new(path))?;
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { model.write_unaligned(nw_model::into_handle(loaded)) };
        Ok(())
    };
    // SAFETY: the caller's promise on `message`.
    unsafe { report(guarded(load), message, message_size) }
}

/// Reads a model from TOML text of `toml_size` bytes (no closing zero needed). `name` stands for the file in messages;
/// it may be null. Otherwise as `nw_model_load`.
///
/// # Safety
/// `toml` has `toml_size` bytes, `name` is zero-terminated or null, the rest as in `nw_model_load`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_model_parse(
    toml: *const c_char,
    toml_size: usize,
    name: *const c_char,
    model: *mut *mut nw_model,
    message: *mut c_char,
    message_size: usize,
) -> nw_status {
    let parse = || -> Result<(), Fault> {
        if toml.is_null() || model.is_null() {
            return Err(NW_NULL_POINTER.into());
        }
        if toml_size > isize::MAX as usize {
            return Err(NW_STRUCT_SIZE.into());
        }
        // SAFETY: not null, of a size that a slice may have, and readable by the caller's promise.
        let bytes = unsafe { std::slice::from_raw_parts(toml.cast::<u8>(), toml_size) };
        let text = std::str::from_utf8(bytes).map_err(|_| NW_NOT_UTF8)?;
        let name = if name.is_null() {
            c"model"
        } else {
            // SAFETY: not null, and zero-terminated by the caller's promise.
            unsafe { CStr::from_ptr(name) }
        };
        let parsed = Model::from_toml(&name.to_string_lossy(), text)?;
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { model.write_unaligned(nw_model::into_handle(parsed)) };
        Ok(())
    };
    // SAFETY: the caller's promise on `message`.
    unsafe { report(guarded(parse), message, message_size) }
}

/// Frees a model; null is allowed.
///
/// # Safety
/// `model` came from `nw_model_load` or `nw_model_parse` and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_model_free(model: *mut nw_model) {
    let free = || {
        if !model.is_null() {
            // SAFETY: by the caller's promise the pointer came from `into_handle` and is freed once.
            drop(unsafe { Box::from_raw(model) });
        }
        Ok(())
    };
    // Freeing has no failure to report.
    guarded_status(free);
}

/// The index of the wall that a patch name belongs to: the wall of that name, else the last whose name is a regular
/// expression that fits. `NW_UNKNOWN_WALL` when there is none; the wall called `default` is not implied.
///
/// # Safety
/// `model` is a loaded model, `name` is zero-terminated, `wall` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_model_find_wall(
    model: *const nw_model,
    name: *const c_char,
    wall: *mut u32,
) -> nw_status {
    let find = || {
        if model.is_null() || name.is_null() || wall.is_null() {
            return Err(NW_NULL_POINTER);
        }
        // SAFETY: not null; a live model, a zero-terminated text and a writable number by the caller's promise.
        let (model, name) = unsafe { (&*model, CStr::from_ptr(name)) };
        let name = name.to_str().map_err(|_| NW_NOT_UTF8)?;
        let index = model.inner().find_wall(name).and_then(|index| u32::try_from(index).ok());
        let index = index.ok_or(NW_UNKNOWN_WALL)?;
        // SAFETY: as above.
        unsafe { wall.write_unaligned(index) };
        Ok(())
    };
    guarded_status(find)
}

/// Fills an impact with its size and the values assumed for unknown inputs: wall 0, 1e-4 m, 293.15 K, conversion 1, all
/// else 0.
///
/// # Safety
/// `impact` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_impact_init(impact: *mut nw_impact) -> nw_status {
    if impact.is_null() {
        return NW_NULL_POINTER;
    }
    // SAFETY: not null, and writable by the caller's promise.
    unsafe { impact.write_unaligned(nw_impact::default()) };
    NW_OK
}

/// Fills an outcome with its size and zeros, ready for `nw_resolve`.
///
/// # Safety
/// `outcome` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_outcome_init(outcome: *mut nw_outcome) -> nw_status {
    if outcome.is_null() {
        return NW_NULL_POINTER;
    }
    // SAFETY: not null, and writable by the caller's promise.
    unsafe { outcome.write_unaligned(nw_outcome::default()) };
    NW_OK
}

/// Decides one impact. The same model and impact give the same bits, on any thread and in any order.
///
/// # Safety
/// `model` is a loaded model; `impact` and `outcome` begin with their `struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_resolve(
    model: *const nw_model,
    impact: *const nw_impact,
    outcome: *mut nw_outcome,
) -> nw_status {
    let resolve = || {
        // SAFETY: the caller's promises.
        let (model, impact) = unsafe { (reader(model)?, sized(impact)?) };
        // SAFETY: the caller's promise. The rest of an outcome may be unset, so it is not read.
        unsafe { check_size(outcome.cast_const())? };
        let draw = ImpactRng::new(impact.seed, impact.key);
        let result = model.inner().resolve(impact.wall as usize, &impact.to_impact(), draw)?;
        // SAFETY: checked just above.
        unsafe { outcome.write_unaligned(nw_outcome::from_outcome(&result)) };
        Ok(())
    };
    guarded_status(resolve)
}

/// Adhesive, yield and sticking velocity [m/s] of an impact's particle and wall: size and temperatures count,
/// and what effects on the contact look at; chance is at its median. Outputs may be null.
///
/// # Safety
/// `model` is a loaded model, `impact` begins with its `struct_size`, each output can be written or is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_speeds(
    model: *const nw_model,
    impact: *const nw_impact,
    adhesive: *mut f64,
    yielding: *mut f64,
    sticking: *mut f64,
) -> nw_status {
    let speeds = || {
        // SAFETY: the caller's promises.
        let (model, impact) = unsafe { (reader(model)?, sized(impact)?) };
        let found = model.inner().speeds(impact.wall as usize, &impact.to_impact())?;
        let outputs = [(adhesive, found.adhesive), (yielding, found.yielding), (sticking, found.sticking)];
        for (output, value) in outputs.into_iter().filter(|(output, _)| !output.is_null()) {
            // SAFETY: not null, and writable by the caller's promise.
            unsafe { output.write_unaligned(value) };
        }
        Ok(())
    };
    guarded_status(speeds)
}

/// Temperatures [K] between which impacts on a wall can be decided, from the tables of all properties: lowest and
/// highest of the particle and of the wall, 0 and infinity where nothing limits them. Outputs may be null.
///
/// # Safety
/// `model` is a loaded model, each output can be written or is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_temperature_ranges(
    model: *const nw_model,
    wall: u32,
    particle_low: *mut f64,
    particle_high: *mut f64,
    wall_low: *mut f64,
    wall_high: *mut f64,
) -> nw_status {
    let ranges = || {
        // SAFETY: the caller's promise.
        let model = unsafe { reader(model)? };
        let found = model.inner().temperature_ranges(wall as usize)?;
        let outputs = [particle_low, particle_high, wall_low, wall_high];
        let values = [found.particle[0], found.particle[1], found.wall[0], found.wall[1]];
        for (output, value) in outputs.into_iter().zip(values).filter(|(output, _)| !output.is_null()) {
            // SAFETY: not null, and writable by the caller's promise.
            unsafe { output.write_unaligned(value) };
        }
        Ok(())
    };
    guarded_status(ranges)
}

/// A copy of a struct that begins with its own size. Foreign languages do not always align what they pass: nothing here
/// needs it.
///
/// # Safety
/// The pointer is null or points to at least a `u32`, and to a whole `T` if that `u32` is the size of `T`.
unsafe fn sized<T: Copy>(pointer: *const T) -> Result<T, nw_status> {
    // SAFETY: the caller's promise, and then the size says that it is a whole `T`.
    unsafe {
        check_size(pointer)?;
        Ok(pointer.read_unaligned())
    }
}

/// Refuses null and a struct of another size. Reads nothing but the size.
///
/// # Safety
/// The pointer is null or points to at least a `u32`.
unsafe fn check_size<T>(pointer: *const T) -> Result<(), nw_status> {
    if pointer.is_null() {
        return Err(NW_NULL_POINTER);
    }
    // SAFETY: not null, so a `u32` can be read by the caller's promise.
    let size = unsafe { pointer.cast::<u32>().read_unaligned() };
    if size as usize == size_of::<T>() { Ok(()) } else { Err(NW_STRUCT_SIZE) }
}

const _: () = assert!(Regime::SpSw as u32 == NW_SP_SW);
