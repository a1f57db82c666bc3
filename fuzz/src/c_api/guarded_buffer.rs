//! Output buffers at any alignment, with guard bytes on both sides.

use std::ptr::null_mut;

use nearwall::c_api::*;

use super::super::bytes::Bytes;

/// Value of guard bytes, which no call may overwrite.
const POISON: u8 = 0xA5;

/// A buffer at any alignment, with guard bytes on both sides.
pub struct GuardedBuffer {
    pub bytes: Vec<u8>,
    offset: usize,
    size: usize,
}

impl GuardedBuffer {
    pub fn new(bytes: &mut Bytes<'_>, size: usize) -> Self {
        let offset = bytes.below(16);
        Self { bytes: vec![POISON; offset + size + 16], offset, size }
    }

    pub fn holding<T: Copy>(bytes: &mut Bytes<'_>, value: T) -> Self {
        let mut buffer = Self::new(bytes, size_of::<T>());
        // SAFETY: as large as a `T`.
        unsafe { buffer.start::<T>().write_unaligned(value) };
        buffer
    }

    pub fn start<T>(&mut self) -> *mut T {
        self.bytes[self.offset..].as_mut_ptr().cast()
    }

    /// The start of the buffer, or null.
    pub fn start_or_null<T>(&mut self, bytes: &mut Bytes<'_>) -> *mut T {
        if bytes.byte() == 0 { null_mut() } else { self.start() }
    }

    pub fn inside(&self) -> &[u8] {
        &self.bytes[self.offset..self.offset + self.size]
    }

    /// Asserts that nothing outside the buffer was written.
    pub fn assert_guard_intact(&self) {
        let end = self.offset + self.size;
        let around = self.bytes[..self.offset].iter().chain(&self.bytes[end..]);
        assert!(around.copied().all(|byte| byte == POISON), "written outside the buffer");
    }

    pub fn assert_untouched(&self) {
        assert!(!self.is_changed(), "written on failure");
    }

    pub fn is_changed(&self) -> bool {
        self.bytes.iter().any(|byte| *byte != POISON)
    }

    pub fn f64(&mut self) -> f64 {
        // SAFETY: as large as a number.
        unsafe { self.start::<f64>().read_unaligned() }
    }
}

pub fn known(status: nw_status) {
    let others = [NW_UNKNOWN_INPUT, NW_NO_CONDUCTIVITY, NW_NO_HEAT_CAPACITY];
    assert!((NW_OK..NW_PANIC).contains(&status) || others.contains(&status), "status {status}");
}
