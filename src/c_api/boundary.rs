//! The boundary between C and Rust: stops panics, saves the floating-point state, reads and writes the caller's memory.
//!
//! Pointers of callers need no alignment: Fortran, Python and packed structs do not always align.

use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::types::{
    NW_FILE, NW_MODEL, NW_NULL_POINTER, NW_OK, NW_PANIC, NW_STRUCT_SIZE, nw_status, status_text,
};
use crate::input::InputError;

/// A status, and the message for the caller's buffer if it differs from the text of the status.
#[derive(Debug)]
pub(super) struct Fault {
    status: nw_status,
    message: Option<String>,
}

impl Fault {
    /// A status with a message. A zero in it would end the text in C.
    pub(super) fn new(status: nw_status, message: &str) -> Self {
        Self { status, message: Some(without_zero(message)) }
    }
}

/// The text with a visible sign for each zero, which a TOML key or word may hold ("\u0000").
fn without_zero(text: &str) -> String {
    text.replace('\0', "\u{2400}")
}

impl From<nw_status> for Fault {
    fn from(status: nw_status) -> Self {
        Self { status, message: None }
    }
}

impl From<InputError> for Fault {
    fn from(error: InputError) -> Self {
        let status = match error {
            InputError::Unreadable { .. } => NW_FILE,
            InputError::Fault { .. } => NW_MODEL,
        };
        Self::new(status, &error.to_string())
    }
}

/// Runs `body` with the default floating-point control (round to nearest, no traps), stops panics, and restores the
/// caller's control and flags.
///
/// Optimised code may compute both sides of a branch, and one of them may divide by zero harmlessly: this would kill a
/// caller that traps division by zero, as OpenFOAM does.
pub(super) fn guarded<E: From<nw_status>>(body: impl FnOnce() -> Result<(), E>) -> Result<(), E> {
    let _state = FloatingPointState::save();
    out_of_line(|| catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|_| Err(NW_PANIC.into())))
}

/// As [`guarded`], for calls without a message.
pub(super) fn guarded_status(body: impl FnOnce() -> Result<(), nw_status>) -> nw_status {
    guarded(body).err().unwrap_or(NW_OK)
}

/// A call that is never inlined, so that no arithmetic moves out of the guarded section.
#[inline(never)]
fn out_of_line<T>(body: impl FnOnce() -> T) -> T {
    body()
}

/// The caller's floating-point control and flags, restored on drop.
struct FloatingPointState {
    #[cfg(target_arch = "x86_64")]
    mxcsr: u32,
}

impl FloatingPointState {
    #[cfg(target_arch = "x86_64")]
    fn save() -> Self {
        /// All exceptions masked, round to nearest, denormals kept: the state a process starts with.
        static DEFAULT: u32 = 0x1F80;
        let mut mxcsr = 0_u32;
        // SAFETY: stores and loads the control register of SSE, which every x86-64 has; touches nothing else.
        unsafe {
            std::arch::asm!(
                "stmxcsr [{saved}]",
                "ldmxcsr [{default}]",
                saved = in(reg) &raw mut mxcsr,
                default = in(reg) &raw const DEFAULT,
                options(nostack)
            );
        }
        Self { mxcsr }
    }

    /// Hardware traps are rare on other processors: the state stays as it is.
    #[cfg(not(target_arch = "x86_64"))]
    fn save() -> Self {
        Self {}
    }
}

#[cfg(target_arch = "x86_64")]
impl Drop for FloatingPointState {
    fn drop(&mut self) {
        // SAFETY: loads back the value that was stored by `save`.
        unsafe {
            std::arch::asm!("ldmxcsr [{saved}]", saved = in(reg) &raw const self.mxcsr, options(nostack));
        }
    }
}

/// The caller's pointer as a reference.
///
/// # Safety
/// The pointer is null or points to a live, initialised `T`.
pub(super) unsafe fn reader<'a, T>(pointer: *const T) -> Result<&'a T, nw_status> {
    // SAFETY: the caller's promise.
    unsafe { pointer.as_ref() }.ok_or(NW_NULL_POINTER)
}

/// Writes the default of a struct.
///
/// # Safety
/// The pointer is null or can be written.
pub(super) unsafe fn initialise<T: Default>(pointer: *mut T) -> nw_status {
    if pointer.is_null() {
        return NW_NULL_POINTER;
    }
    // SAFETY: not null, and writable by the caller's promise.
    unsafe { pointer.write_unaligned(T::default()) };
    NW_OK
}

/// A copy of a struct that begins with its own size.
///
/// # Safety
/// The pointer is null or points to at least a `u32`, and to a whole `T` if that `u32` is the size of `T`.
pub(super) unsafe fn sized<T: Copy>(pointer: *const T) -> Result<T, nw_status> {
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
pub(super) unsafe fn check_size<T>(pointer: *const T) -> Result<(), nw_status> {
    if pointer.is_null() {
        return Err(NW_NULL_POINTER);
    }
    // SAFETY: not null, so a `u32` can be read by the caller's promise.
    let size = unsafe { pointer.cast::<u32>().read_unaligned() };
    if size as usize == size_of::<T>() { Ok(()) } else { Err(NW_STRUCT_SIZE) }
}

/// An entry of an array that may be null.
///
/// # Safety
/// The array is null or has more than `index` entries.
pub(super) unsafe fn get<T: Copy>(array: *const T, index: usize, default: T) -> T {
    // SAFETY: not null, and long enough by the caller's promise.
    if array.is_null() { default } else { unsafe { array.add(index).read_unaligned() } }
}

/// Writes an entry of an array that may be null.
///
/// # Safety
/// The array is null or has room for more than `index` entries.
pub(super) unsafe fn put<T>(array: *mut T, index: usize, value: T) {
    if !array.is_null() {
        // SAFETY: not null, and long enough by the caller's promise.
        unsafe { array.add(index).write_unaligned(value) };
    }
}

/// Turns the result into a status and copies the message of a fault to the caller's buffer.
///
/// # Safety
/// `message` is null or has room for `size` bytes.
pub(super) unsafe fn report(result: Result<(), Fault>, message: *mut c_char, size: usize) -> nw_status {
    let Err(fault) = result else { return NW_OK };
    if !message.is_null() && size > 0 {
        let plain = status_text(fault.status).to_str().unwrap_or_default();
        let text = fault.message.as_deref().unwrap_or(plain);
        // SAFETY: not null, with room for `size` bytes by the caller's promise.
        unsafe { put_text(text, message, size) };
    }
    fault.status
}

/// Copies a text without a zero inside, cut between characters to fit with its closing zero.
///
/// # Safety
/// `buffer` has room for `size` bytes, which is not 0.
pub(super) unsafe fn put_text(text: &str, buffer: *mut c_char, size: usize) {
    let text = without_zero(text);
    let mut length = text.len().min(size - 1);
    while !text.is_char_boundary(length) {
        length -= 1;
    }
    // SAFETY: `length + 1 <= size` bytes, which the caller's promise covers; the texts do not overlap.
    unsafe {
        std::ptr::copy_nonoverlapping(text.as_ptr(), buffer.cast::<u8>(), length);
        buffer.add(length).write(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_status() {
        let fault = guarded::<Fault>(|| panic!("this panic belongs to the test")).unwrap_err();
        assert_eq!(fault.status, NW_PANIC);
        let mut message = [0; 16];
        let status = unsafe { report(Err(fault), message.as_mut_ptr(), message.len()) };
        assert_eq!((status, message[0], message[15]), (NW_PANIC, b'i' as c_char, 0));
    }

    #[test]
    #[cfg(target_arch = "x86_64")]
    fn a_panic_gives_the_floating_point_state_back() {
        let control = || {
            let mut mxcsr = 0_u32;
            // SAFETY: stores the control register, touches nothing else.
            unsafe { std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut mxcsr, options(nostack)) };
            mxcsr
        };
        let set = |mxcsr: u32| {
            // SAFETY: loads a valid state, which the end of the test takes back.
            unsafe { std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const mxcsr, options(nostack)) };
        };
        let before = control();
        // Round up, flush to zero, some flags raised, nothing trapped.
        let odd = 0xDFA5;
        set(odd);
        let inside = std::cell::Cell::new(0);
        let result = guarded::<Fault>(|| {
            inside.set(control());
            panic!("this panic belongs to the test")
        });
        let after = control();
        set(before);
        assert!(result.is_err());
        assert_eq!((inside.get(), after), (0x1F80, odd));
    }
}
