//! The C interface: `nearwall.h`.
//!
//! Conventions: inputs come first, outputs last; `const` arguments stay unchanged; every call returns a status, and
//! its outputs are untouched unless that is `NW_OK` (except a message and the index of an invalid impact). A model
//! never changes after it is loaded, so any number of threads may share it. No panic reaches the caller, and its
//! floating-point control and flags stay as they are. This is the only module with `unsafe`: it turns C pointers into
//! references.
#![allow(unsafe_code)]

mod batch;
mod boundary;
mod cooled_wall;
mod deposit;
mod extra;
mod impact;
mod processes;
mod transport;
mod types;

use std::ffi::{CStr, c_char};
use std::path::Path;

use crate::impact::Regime;
use crate::key::key_of_values;
use crate::model::{Beyond, Model};
use crate::rng::ImpactRng;

pub use batch::*;
use boundary::{
    Fault, check_size, guarded, guarded_status, initialise, put, put_text, reader, report, sized,
};
pub use cooled_wall::*;
pub use deposit::*;
pub use extra::*;
pub use impact::*;
pub use processes::*;
pub use transport::*;
use types::status_text;
pub use types::*;

/// Version of the binary interface; it rises when a struct, a function or a constant changes.
pub const NW_ABI_VERSION: u32 = 1;

/// Returns the interface version of the loaded library; compare it with `NW_ABI_VERSION` of the header.
#[unsafe(no_mangle)]
pub extern "C" fn nw_abi_version() -> u32 {
    NW_ABI_VERSION
}

/// Returns the version of the library, for instance `0.1.0`, as a static string.
#[unsafe(no_mangle)]
pub extern "C" fn nw_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// Returns the text of a status, or of an unknown number, as a static string.
#[unsafe(no_mangle)]
pub extern "C" fn nw_status_text(status: nw_status) -> *const c_char {
    status_text(status).as_ptr()
}

/// Returns the name of a regime, for instance `NSP-SW`, as a static string.
#[unsafe(no_mangle)]
pub extern "C" fn nw_regime_name(regime: nw_regime) -> *const c_char {
    let text: &'static CStr = match regime {
        NW_NSP_NSW => c"NSP-NSW",
        NW_NSP_SW => c"NSP-SW",
        NW_SP_NSW => c"SP-NSW",
        NW_SP_SW => c"SP-SW",
        _ => c"unknown regime",
    };
    text.as_ptr()
}

/// Loads a model file. On success `*model` is the model; free it with `nw_model_free`.
///
/// On failure `message` (may be null) receives the reason with file, line, column, key and remedy: at most
/// `message_size` bytes with the closing zero, cut between characters. On success `message` is untouched.
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

/// Parses a model from TOML text of `toml_size` bytes, which needs no closing zero. Messages name it `name` (may be
/// null). Otherwise as `nw_model_load`.
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

/// Frees a model; does nothing for null.
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

/// Finds the wall of a patch: the wall of that name, otherwise the last one whose name is a regular expression that
/// matches. Returns `NW_UNKNOWN_WALL` if there is none, even if the model has a wall `default`.
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

/// Initialises an impact: its size and the default of every input; wall, seed and key 0.
///
/// # Safety
/// `impact` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_impact_init(impact: *mut nw_impact) -> nw_status {
    // SAFETY: the caller's promise.
    unsafe { initialise(impact) }
}

/// Initialises an outcome for `nw_resolve`: its size and zeros.
///
/// # Safety
/// `outcome` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_outcome_init(outcome: *mut nw_outcome) -> nw_status {
    // SAFETY: the caller's promise.
    unsafe { initialise(outcome) }
}

/// Resolves one impact. The same model and impact give the same bits, on any thread and in any order.
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

/// Says why an impact cannot be decided: the status of `nw_resolve`, and in `message` (may be null)
/// the input and its value, or the material, property, temperature and range: at most
/// `message_size` bytes with the closing zero. `NW_OK` if it can be decided.
///
/// # Safety
/// `model` is a loaded model; `impact` begins with its `struct_size`; `message` has room for
/// `message_size` bytes or is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_explain(
    model: *const nw_model,
    impact: *const nw_impact,
    message: *mut c_char,
    message_size: usize,
) -> nw_status {
    let explain = || -> Result<(), Fault> {
        // SAFETY: the caller's promises.
        let (model, impact) = unsafe { (reader(model)?, sized(impact)?) };
        let checked = model.inner().check(impact.wall as usize, &impact.to_impact());
        checked.map_err(|error| {
            let text = error.to_string();
            Fault::new(error.into(), &text)
        })
    };
    // SAFETY: the caller's promise on `message`.
    unsafe { report(guarded(explain), message, message_size) }
}

/// Says what an impact marked `NW_OUTSIDE_VALID_RANGE` uses outside of its stated range, one thing a
/// line: the property or law and its range, without the impact's own value, so that impacts can be
/// counted by line. `text` receives at most `text_size` bytes with the closing zero, an empty text
/// if all ranges are kept. Random draws are at their median.
///
/// # Safety
/// `model` is a loaded model; `impact` begins with its `struct_size`; `text` has room for `text_size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_beyond(
    model: *const nw_model,
    impact: *const nw_impact,
    text: *mut c_char,
    text_size: usize,
) -> nw_status {
    let found = || {
        // SAFETY: the caller's promises.
        let (model, impact) = unsafe { (reader(model)?, sized(impact)?) };
        if text.is_null() || text_size == 0 {
            return Err(NW_NULL_POINTER);
        }
        let beyond = model.inner().beyond(impact.wall as usize, &impact.to_impact())?;
        let lines: Vec<String> = beyond.iter().map(Beyond::stated).collect();
        // SAFETY: not null, with room for `text_size` bytes by the caller's promise.
        unsafe { put_text(&lines.join("\n"), text, text_size) };
        Ok(())
    };
    guarded_status(found)
}

/// Says which input of an impact is probably in another unit: a temperature below 150 K (in degrees
/// Celsius?), a diameter above 5 cm. `text` receives at most `text_size` bytes with the closing
/// zero, an empty text if nothing is unlikely. Call it for the first impacts of a run: a
/// temperature in degrees Celsius above 150 cannot be told from one in kelvin.
///
/// # Safety
/// `impact` begins with its `struct_size`, `text` has room for `text_size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_unlikely(
    impact: *const nw_impact,
    text: *mut c_char,
    text_size: usize,
) -> nw_status {
    let found = || {
        // SAFETY: the caller's promise.
        let impact = unsafe { sized(impact)? };
        if text.is_null() || text_size == 0 {
            return Err(NW_NULL_POINTER);
        }
        let unlikely = impact.to_impact().unlikely().unwrap_or_default();
        // SAFETY: not null, with room for `text_size` bytes by the caller's promise.
        unsafe { put_text(&unlikely, text, text_size) };
        Ok(())
    };
    guarded_status(found)
}

/// Computes a key for an impact of a code that does not number its particles, from `count` values
/// that tell this impact from all others on any number of ranks, such as place and time of the
/// particle's release, its diameter, and the number of its hits. Equal values have equal keys, -0
/// equals 0. `NW_BAD_STATE` if `count` is 0 or a value is not finite. The key is XXH64 with seed 0
/// of the values' bytes, the lowest first.
///
/// # Safety
/// `values` has `count` entries, `key` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_key_of_values(values: *const f64, count: usize, key: *mut u64) -> nw_status {
    let found = || {
        if values.is_null() || key.is_null() {
            return Err(NW_NULL_POINTER);
        }
        if count > isize::MAX as usize / size_of::<f64>() {
            return Err(NW_STRUCT_SIZE);
        }
        // SAFETY: not null, and `count` entries by the caller's promise; they need not be aligned.
        let values = (0..count).map(|index| unsafe { values.add(index).read_unaligned() });
        let found = key_of_values(values).ok_or(NW_BAD_STATE)?;
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { key.write_unaligned(found) };
        Ok(())
    };
    guarded_status(found)
}

/// Computes the adhesive, yield and sticking velocity [m/s] of an impact's particle and wall, with random draws at
/// their median. They depend on the diameter, the temperatures, and the inputs of effects on the contact. Outputs may
/// be null.
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
        // SAFETY: the caller's promise.
        unsafe {
            put(adhesive, 0, found.adhesive);
            put(yielding, 0, found.yielding);
            put(sticking, 0, found.sticking);
        }
        Ok(())
    };
    guarded_status(speeds)
}

/// Computes the density [kg/m3] of the particle's material for an impact, which is taken where its `rho_p` is 0.
///
/// # Safety
/// `model` is a loaded model, `impact` begins with its `struct_size`, `density` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_particle_density(
    model: *const nw_model,
    impact: *const nw_impact,
    density: *mut f64,
) -> nw_status {
    let found = || {
        // SAFETY: the caller's promises.
        let (model, impact) = unsafe { (reader(model)?, sized(impact)?) };
        if density.is_null() {
            return Err(NW_NULL_POINTER);
        }
        let impact = impact.to_impact();
        impact.check()?;
        let found = model.inner().particle_density(&impact)?;
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { density.write_unaligned(found) };
        Ok(())
    };
    guarded_status(found)
}

/// Computes the volume of wall [m3] that particles of a total `mass` [kg] remove by impacts like
/// this one; 0 if the model file gives the wall no erosion law. Independent of what becomes of the
/// particles.
///
/// # Safety
/// `model` is a loaded model, `impact` begins with its `struct_size`, `volume` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_erosion(
    model: *const nw_model,
    impact: *const nw_impact,
    mass: f64,
    volume: *mut f64,
) -> nw_status {
    let erode = || {
        // SAFETY: the caller's promises.
        let (model, impact) = unsafe { (reader(model)?, sized(impact)?) };
        if volume.is_null() {
            return Err(NW_NULL_POINTER);
        }
        let found = model.inner().erosion(impact.wall as usize, &impact.to_impact(), mass)?;
        if !found.is_finite() {
            return Err(NW_BAD_STATE);
        }
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { volume.write_unaligned(found) };
        Ok(())
    };
    guarded_status(erode)
}

/// Returns the temperatures [K] of particle and wall for which all property tables of a wall are defined: lowest and
/// highest, 0 and infinity without a limit. Outputs may be null.
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
        // SAFETY: the caller's promise.
        unsafe {
            put(particle_low, 0, found.particle[0]);
            put(particle_high, 0, found.particle[1]);
            put(wall_low, 0, found.wall[0]);
            put(wall_high, 0, found.wall[1]);
        }
        Ok(())
    };
    guarded_status(ranges)
}

const _: () = assert!(Regime::SpSw as u32 == NW_SP_SW);
