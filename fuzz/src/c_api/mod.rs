//! The C interface: the bytes are a program of calls with hostile pointers, sizes, numbers and texts.
//!
//! The calls meet the header's requirements: a pointer that is not null is valid, at any alignment where the header
//! requires none, and an array is as long as its count if the count is accepted.

use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

use nearwall::c_api::*;

mod deposit;
mod guarded_buffer;
mod impacts;

use super::bytes::Bytes;
use guarded_buffer::{GuardedBuffer, known};

const MODELS: [&str; 4] = [
    include_str!("../../../tutorials/slaggingGasifier/constant/nearWall.toml"),
    "[particle]\nmaterial = \"montan-wax\"\n[walls.\"w.*\"]\nmaterial = \"pyrex\"\n[walls.hot]\nmaterial = \
     \"stainless-steel\"\n[walls.hot.shedding]\ntensile_strength = 200\nshear_strength = 100\nspread = 2\n\
     [walls.hot.resuspension]\nwork_of_adhesion = 0.5\n[normal]\nmodel = \"thornton-ning\"\nyield_ratio = 0.7\n[tangential]\nmodel = \
     \"sliding-rolling\"\nfriction = 0.3\n[[effects]]\nkind = \"melting-transition\"\ntemperature = 360\nwidth = 7\n",
    include_str!("../models/lying.toml"),
    include_str!("../models/extra-inputs.toml"),
];

/// Runs the program and asserts: no crash, no panic, nothing written on failure, nothing written outside the buffers.
pub fn c_api(bytes: &[u8]) {
    let mut bytes = Bytes(bytes);
    let mut model = parsed(MODELS[bytes.below(MODELS.len())]);
    let mut wall = deposit::KeptWall::default();
    let mut steps = 0;
    while !bytes.is_empty() && steps < 100 {
        steps += 1;
        match bytes.byte() % 17 {
            0 => parse(&mut bytes),
            1 => load(&mut bytes),
            2 => find_wall(&mut bytes, model),
            3 => impacts::one(&mut bytes, model),
            4 => impacts::speeds(&mut bytes, model),
            5 => impacts::ranges(&mut bytes, model),
            6 => impacts::batch(&mut bytes, model),
            7 => texts(&mut bytes),
            11 => impacts::key(&mut bytes),
            9 => impacts::of_particles(&mut bytes, model),
            10 => impacts::extra(&mut bytes, model),
            12..16 => wall.call(&mut bytes, model),
            16 => impacts::walk(&mut bytes),
            _ => {
                // SAFETY: our own model, freed once.
                unsafe { nw_model_free(model) };
                model = parsed(MODELS[bytes.below(MODELS.len())]);
            }
        }
    }
    // SAFETY: as above.
    unsafe { nw_model_free(model) };
}

fn parsed(toml: &str) -> *mut nw_model {
    let mut model = null_mut();
    // SAFETY: the size is that of the text.
    let status =
        unsafe { nw_model_parse(toml.as_ptr().cast(), toml.len(), null(), &raw mut model, null_mut(), 0) };
    assert_eq!(status, NW_OK);
    model
}

/// A call that makes a model and may leave a message.
fn making(
    bytes: &mut Bytes<'_>,
    call: impl FnOnce(*mut *mut nw_model, *mut c_char, usize) -> nw_status,
) -> nw_status {
    let size = [0, 1, 2, 3, 40, 400][bytes.below(6)];
    let mut message = GuardedBuffer::new(bytes, size);
    let mut handle = GuardedBuffer::new(bytes, size_of::<*mut nw_model>());
    let (to, text) = (handle.start_or_null(bytes), message.start_or_null(bytes));
    let status = call(to, text, size);
    known(status);
    message.assert_guard_intact();
    handle.assert_guard_intact();
    if status == NW_OK {
        message.assert_untouched();
        // SAFETY: a model was written there.
        unsafe { nw_model_free(to.read_unaligned()) };
    } else {
        handle.assert_untouched();
        if text.is_null() || size == 0 {
            message.assert_untouched();
        } else {
            let text = CStr::from_bytes_until_nul(message.inside()).expect("a closing zero");
            text.to_str().expect("whole characters");
        }
    }
    status
}

/// A model with some of its bytes replaced.
fn parse(bytes: &mut Bytes<'_>) {
    let mut toml = MODELS[bytes.below(MODELS.len())].as_bytes().to_vec();
    let at = bytes.word() as u16 as usize % toml.len();
    let (cut, put) = (bytes.below(8), bytes.below(12));
    let end = (at + cut).min(toml.len());
    toml.splice(at..end, bytes.take(put).iter().copied());
    let name = c_text(bytes);
    let name = if bytes.byte() == 0 { null() } else { name.as_ptr() };
    let (text, size) = match bytes.byte() {
        0 => (null(), toml.len()),
        1 => (toml.as_ptr().cast(), usize::MAX),
        2 => (toml.as_ptr().cast(), isize::MAX as usize + 1),
        3 => (toml.as_ptr().cast(), 0),
        4 => (null(), 0),
        cut if cut < 128 => (toml.as_ptr().cast(), toml.len() - usize::from(cut).min(toml.len())),
        _ => (toml.as_ptr().cast(), toml.len()),
    };
    // SAFETY: no more bytes than the text has, or a size that is refused.
    making(bytes, |model, message, buffer| unsafe {
        nw_model_parse(text, size, name, model, message, buffer)
    });
}

/// Some bytes, not always UTF-8, up to their first zero.
fn c_text(bytes: &mut Bytes<'_>) -> CString {
    let count = bytes.below(40);
    let text: Vec<u8> = bytes.take(count).iter().copied().take_while(|byte| *byte != 0).collect();
    CString::new(text).expect("no zero is left")
}

fn load(bytes: &mut Bytes<'_>) {
    let text = c_text(bytes);
    let nowhere = CString::new([b"/nowhere/", text.as_bytes()].concat()).expect("no zero");
    let path = match bytes.byte() {
        0 => null(),
        1 => c"".as_ptr(),
        2 => c"/".as_ptr(),
        3 => c"/dev/null".as_ptr(),
        4 => c"/proc/self/cmdline".as_ptr(),
        _ => nowhere.as_ptr(),
    };
    // SAFETY: zero-terminated or null.
    let status =
        making(bytes, |model, message, buffer| unsafe { nw_model_load(path, model, message, buffer) });
    assert_ne!(status, NW_OK, "none of these is a model");
}

fn find_wall(bytes: &mut Bytes<'_>, model: *const nw_model) {
    let name = c_text(bytes);
    let mut wall = GuardedBuffer::new(bytes, 4);
    let to = wall.start_or_null(bytes);
    let model = if bytes.byte() == 0 { null() } else { model };
    let name = if bytes.byte() == 0 { null() } else { name.as_ptr() };
    // SAFETY: a live model, a zero-terminated text, a number that can be written, or null.
    let status = unsafe { nw_model_find_wall(model, name, to) };
    known(status);
    wall.assert_guard_intact();
    if status != NW_OK {
        wall.assert_untouched();
    }
}

fn texts(bytes: &mut Bytes<'_>) {
    let number = bytes.word();
    // SAFETY: static texts.
    let (status, regime) = unsafe {
        (CStr::from_ptr(nw_status_text(number as i32)), CStr::from_ptr(nw_regime_name(number as u32)))
    };
    assert!(status.to_bytes().len() > 3 && regime.to_bytes().len() > 3);
    // SAFETY: a static text.
    let version = unsafe { CStr::from_ptr(nw_version()) };
    assert!(nw_abi_version() == NW_ABI_VERSION && version.to_bytes().contains(&b'.'));
    let mut buffer = GuardedBuffer::new(bytes, size_of::<nw_impact>());
    let to = buffer.start_or_null(bytes);
    // SAFETY: null or a buffer of the size of an impact.
    known(unsafe { nw_impact_init(to) });
    buffer.assert_guard_intact();
    let mut buffer = GuardedBuffer::new(bytes, size_of::<nw_outcome>());
    let to = buffer.start_or_null(bytes);
    // SAFETY: null or a buffer of the size of an outcome.
    known(unsafe { nw_outcome_init(to) });
    buffer.assert_guard_intact();
}
