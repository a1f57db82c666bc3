//! The inputs that a model file declares: names, words and defaults.

use std::ffi::{CStr, c_char};

use super::boundary::{Fault, guarded, guarded_status, put_text, reader, report};
use super::types::{NW_BAD_STATE, NW_NOT_UTF8, NW_NULL_POINTER, NW_UNKNOWN_INPUT, nw_model, nw_status};
use crate::impact::{EXTRA_INPUTS, ExtraInput};
use crate::input::unknown;

/// Length of the arrays `extra`: a model file declares at most this many inputs.
pub const NW_EXTRA_INPUTS: usize = 8;

const _: () = assert!(NW_EXTRA_INPUTS == EXTRA_INPUTS);

/// Counts the inputs that the model file declares under `[inputs]`. Their values are the first entries of `extra`.
///
/// # Safety
/// `model` is a loaded model, `count` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_extra_input_count(model: *const nw_model, count: *mut u32) -> nw_status {
    let found = || {
        // SAFETY: the caller's promise.
        let model = unsafe { reader(model)? };
        if count.is_null() {
            return Err(NW_NULL_POINTER);
        }
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { count.write_unaligned(model.inner().extra_inputs().len() as u32) };
        Ok(())
    };
    guarded_status(found)
}

/// Returns the name of an input that the model file declares: at most `name_size` bytes with the closing zero, cut
/// between characters. `index` is its place in `extra`.
///
/// # Safety
/// `model` is a loaded model, `name` has room for `name_size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_extra_input_name(
    model: *const nw_model,
    index: u32,
    name: *mut c_char,
    name_size: usize,
) -> nw_status {
    let found = || {
        // SAFETY: the caller's promise.
        let input = unsafe { input(model, index)? };
        if name.is_null() || name_size == 0 {
            return Err(NW_NULL_POINTER);
        }
        // SAFETY: not null, with room for `name_size` bytes by the caller's promise.
        unsafe { put_text(&input.name, name, name_size) };
        Ok(())
    };
    guarded_status(found)
}

/// Returns the value that an impact takes where its entry of `extra` is NaN; NaN if the model file states no default. A
/// curve over an input without value changes nothing.
///
/// # Safety
/// `model` is a loaded model, `value` can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_extra_input_default(
    model: *const nw_model,
    index: u32,
    value: *mut f64,
) -> nw_status {
    let found = || {
        // SAFETY: the caller's promise.
        let input = unsafe { input(model, index)? };
        if value.is_null() {
            return Err(NW_NULL_POINTER);
        }
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { value.write_unaligned(input.default) };
        Ok(())
    };
    guarded_status(found)
}

/// Returns a word of an input of words: at most `text_size` bytes with the closing zero, cut between characters. The
/// input's value for it is `word`, from 0. The status is `NW_UNKNOWN_INPUT` beyond the last one, and for a number.
///
/// # Safety
/// `model` is a loaded model, `text` has room for `text_size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_extra_input_word(
    model: *const nw_model,
    index: u32,
    word: u32,
    text: *mut c_char,
    text_size: usize,
) -> nw_status {
    let found = || {
        // SAFETY: the caller's promise.
        let label = unsafe { input(model, index)? }.labels.get(word as usize).ok_or(NW_UNKNOWN_INPUT)?;
        if text.is_null() || text_size == 0 {
            return Err(NW_NULL_POINTER);
        }
        // SAFETY: not null, with room for `text_size` bytes by the caller's promise.
        unsafe { put_text(label, text, text_size) };
        Ok(())
    };
    guarded_status(found)
}

/// Converts a text to the value of an input that the model file declares: a number, or one of the input's words. On
/// failure `message` (may be null) receives the reason with the known words, as in `nw_model_load`.
///
/// # Safety
/// `model` is a loaded model, `text` is zero-terminated, `value` can be written, `message` has room for `message_size`
/// bytes or is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nw_extra_input_value(
    model: *const nw_model,
    index: u32,
    text: *const c_char,
    value: *mut f64,
    message: *mut c_char,
    message_size: usize,
) -> nw_status {
    let convert = || -> Result<(), Fault> {
        // SAFETY: the caller's promise.
        let input = unsafe { input(model, index)? };
        if text.is_null() || value.is_null() {
            return Err(NW_NULL_POINTER.into());
        }
        // SAFETY: not null, and zero-terminated by the caller's promise.
        let text = unsafe { CStr::from_ptr(text) };
        let text = text.to_str().map_err(|_| NW_NOT_UTF8)?;
        let found = value_of(input, text)?;
        // SAFETY: not null, and writable by the caller's promise.
        unsafe { value.write_unaligned(found) };
        Ok(())
    };
    // SAFETY: the caller's promise on `message`.
    unsafe { report(guarded(convert), message, message_size) }
}

/// The input with this index.
///
/// # Safety
/// `model` is null or a loaded model.
unsafe fn input<'a>(model: *const nw_model, index: u32) -> Result<&'a ExtraInput, nw_status> {
    // SAFETY: the caller's promise.
    let model = unsafe { reader(model)? };
    model.inner().extra_inputs().get(index as usize).ok_or(NW_UNKNOWN_INPUT)
}

/// The number in `text`, or the value of the word; otherwise the reason with the known words.
fn value_of(input: &ExtraInput, text: &str) -> Result<f64, Fault> {
    let known: Vec<&str> = input.labels.iter().map(String::as_str).collect();
    let reason = match input.value_of_text(text) {
        Some(value) if known.is_empty() || known.contains(&text) => return Ok(value),
        _ if known.is_empty() => format!("`{text}` is not a finite number"),
        _ => unknown(text, &format!("word of {}", input.name), &known),
    };
    Err(Fault::new(NW_BAD_STATE, &reason))
}
