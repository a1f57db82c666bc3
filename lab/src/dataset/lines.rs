//! Converts the line ends of any system to line feeds.

use std::io::Read;

/// A text with each line end (CR LF, CR, LF) as one line feed, so that the number of line feeds
/// gives the line of a record. [`Self::EXTRA`] line feeds follow the end: the first ends the last
/// line; a record that contains the second has an unterminated quotation mark.
pub(super) struct Lines<R> {
    source: R,
    /// Lines still to be skipped at the beginning.
    skip: u64,
    /// Whether the last byte was a carriage return.
    after_return: bool,
    /// Line feeds still to follow the end.
    extra: u8,
    /// Number of bytes returned.
    passed: u64,
}

impl<R> Lines<R> {
    /// Line feeds after the end.
    const EXTRA: u8 = 2;

    /// Skips the first `skip` lines.
    pub(super) fn new(source: R, skip: u64) -> Self {
        Self { source, skip, after_return: false, extra: Self::EXTRA, passed: 0 }
    }

    /// Whether the text has ended after this many bytes.
    pub(super) fn ends_at(&self, bytes: u64) -> bool {
        self.extra == 0 && self.passed == bytes
    }

    /// Rewrites the bytes in place; returns the number that is left.
    fn rewrite(&mut self, bytes: &mut [u8]) -> usize {
        if self.skip == 0 && !self.after_return && !bytes.contains(&b'\r') {
            return bytes.len();
        }
        let mut kept = 0;
        for index in 0..bytes.len() {
            let byte = bytes[index];
            let second_of_two = byte == b'\n' && self.after_return;
            self.after_return = byte == b'\r';
            if second_of_two {
                continue;
            }
            let byte = if byte == b'\r' { b'\n' } else { byte };
            if self.skip > 0 {
                self.skip -= u64::from(byte == b'\n');
                continue;
            }
            bytes[kept] = byte;
            kept += 1;
        }
        kept
    }
}

impl<R: Read> Read for Lines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        while self.extra > 0 && !buffer.is_empty() {
            // After its end the source is not read again.
            let size = if self.extra < Self::EXTRA { 0 } else { self.source.read(buffer)? };
            if size == 0 {
                self.extra -= 1;
                self.passed += 1;
                buffer[0] = b'\n';
                return Ok(1);
            }
            let kept = self.rewrite(&mut buffer[..size]);
            // Returning 0 would mean the end.
            if kept > 0 {
                self.passed += kept as u64;
                return Ok(kept);
            }
        }
        Ok(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns one byte at a time.
    struct Trickle<'a>(&'a [u8]);

    impl Read for Trickle<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let size = self.0.len().min(1);
            buffer[..size].copy_from_slice(&self.0[..size]);
            self.0 = &self.0[size..];
            Ok(size)
        }
    }

    #[test]
    fn every_line_end_becomes_one_line_feed() {
        let mixed = b"a\r\nb\rc\n\r\nd";
        for skip in [0, 2] {
            let mut whole = String::new();
            Lines::new(mixed.as_slice(), skip).read_to_string(&mut whole).unwrap();
            let mut bytewise = String::new();
            Lines::new(Trickle(mixed), skip).read_to_string(&mut bytewise).unwrap();
            let expected = "a\nb\nc\n\nd\n\n";
            assert_eq!(whole, expected[2 * skip as usize..]);
            assert_eq!(bytewise, whole);
        }
    }
}
