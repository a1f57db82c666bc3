//! Text in the encodings that laboratories' programs write: UTF-8, UTF-16 and windows-1252.
//!
//! A byte order mark names the encoding. Without one, text whose every other byte is mostly zero is
//! UTF-16 (in a table most characters are ASCII), and what is not UTF-8 is windows-1252, which
//! contains latin-1 (encoding.spec.whatwg.org).

use std::io::{Chain, Cursor, Read, Result};

/// Bytes at the beginning of a file from which its notation is told.
const HEAD: usize = 1 << 16;
/// Bytes of UTF-16 that are decoded together.
const BLOCK: usize = 1 << 13;
/// Least share of zeros among the high bytes of UTF-16, and largest one among its low bytes [1].
const ZERO_SHARES: [f64; 2] = [0.5, 0.05];
/// Byte order marks.
const UTF8_MARK: [u8; 3] = [0xef, 0xbb, 0xbf];
const LITTLE_ENDIAN_MARK: [u8; 2] = [0xff, 0xfe];
const BIG_ENDIAN_MARK: [u8; 2] = [0xfe, 0xff];
/// What windows-1252 has at 0x80 to 0x9f; all other bytes are those of latin-1.
const WINDOWS_1252: &str = "€\u{81}‚ƒ„…†‡ˆ‰Š‹Œ\u{8d}Ž\u{8f}\u{90}‘’“”•–—˜™š›œ\u{9d}žŸ";

/// The text of a source as UTF-8, except for windows-1252, which [`windows_1252`] decodes cell by cell.
pub(super) struct Text<R> {
    source: Chain<Cursor<Vec<u8>>, R>,
    /// For UTF-16: whether the high byte comes first.
    big_endian: Option<bool>,
    /// Bytes that are not decoded yet, fewer than a character.
    rest: Vec<u8>,
    /// Decoded bytes, and the number of those that were returned.
    decoded: Vec<u8>,
    returned: usize,
}

impl<R: Read> Text<R> {
    /// Reads the beginning of the source.
    ///
    /// # Errors
    /// When the source fails.
    pub(super) fn new(mut source: R) -> Result<Self> {
        let mut head = Vec::new();
        source.by_ref().take(HEAD as u64).read_to_end(&mut head)?;
        let big_endian = utf16(&head);
        let mark = if big_endian.is_some() { 2 } else { UTF8_MARK.len() };
        if [&UTF8_MARK[..], &LITTLE_ENDIAN_MARK, &BIG_ENDIAN_MARK].contains(&&head[..mark.min(head.len())]) {
            head.drain(..mark);
        }
        let source = Cursor::new(head).chain(source);
        Ok(Self { source, big_endian, rest: Vec::new(), decoded: Vec::new(), returned: 0 })
    }

    /// The beginning of the text without its last line, which may be cut; and whether it is windows-1252.
    pub(super) fn head(&self) -> (String, bool) {
        let bytes = self.source.get_ref().0.get_ref();
        let (mut text, other) = match (self.big_endian, std::str::from_utf8(bytes)) {
            (Some(big_endian), _) => (decoded(bytes, big_endian).0, false),
            (None, Ok(text)) => (text.to_owned(), false),
            (None, Err(error)) => (windows_1252(bytes), error.error_len().is_some()),
        };
        if bytes.len() + UTF8_MARK.len() > HEAD
            && let Some(end) = text.rfind(['\n', '\r'])
        {
            text.truncate(end);
        }
        (text, other)
    }

    /// Whether the text is UTF-16.
    pub(super) fn is_utf16(&self) -> bool {
        self.big_endian.is_some()
    }

    /// Decodes the next block of UTF-16; nothing at the end.
    fn decode(&mut self, big_endian: bool) -> Result<()> {
        let mut block = [0; BLOCK];
        self.decoded.clear();
        self.returned = 0;
        while self.decoded.is_empty() {
            let size = self.source.read(&mut block)?;
            self.rest.extend_from_slice(&block[..size]);
            let (text, used) = decoded(&self.rest, big_endian);
            self.decoded = text.into_bytes();
            self.rest.drain(..used);
            if size == 0 {
                if !self.rest.is_empty() {
                    self.decoded.extend_from_slice("\u{fffd}".as_bytes());
                    self.rest.clear();
                }
                break;
            }
        }
        Ok(())
    }
}

impl<R: Read> Read for Text<R> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let Some(big_endian) = self.big_endian else { return self.source.read(buffer) };
        if self.returned == self.decoded.len() {
            self.decode(big_endian)?;
        }
        let left = &self.decoded[self.returned..];
        let size = left.len().min(buffer.len());
        buffer[..size].copy_from_slice(&left[..size]);
        self.returned += size;
        Ok(size)
    }
}

/// Whether a file that begins so is UTF-16, and whether its high bytes come first.
fn utf16(head: &[u8]) -> Option<bool> {
    if head.starts_with(&LITTLE_ENDIAN_MARK) || head.starts_with(&BIG_ENDIAN_MARK) {
        return Some(head.starts_with(&BIG_ENDIAN_MARK));
    }
    let zeros = |first: usize| {
        let bytes = head.iter().skip(first).step_by(2);
        bytes.clone().filter(|byte| **byte == 0).count() as f64 / bytes.count().max(1) as f64
    };
    let high_first = [zeros(0), zeros(1)];
    let is = |[high, low]: [f64; 2]| high > ZERO_SHARES[0] && low < ZERO_SHARES[1];
    match (is(high_first), is([high_first[1], high_first[0]])) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

/// The characters of UTF-16, and the number of bytes that they take: a pair at the end may be incomplete.
fn decoded(bytes: &[u8], big_endian: bool) -> (String, usize) {
    let unit = |pair: &[u8]| match *pair {
        [one, two] if big_endian => u16::from_be_bytes([one, two]),
        [one, two] => u16::from_le_bytes([one, two]),
        _ => 0,
    };
    let mut units: Vec<u16> = bytes.chunks_exact(2).map(unit).collect();
    if units.last().is_some_and(|last| (0xd800..0xdc00).contains(last)) {
        units.pop();
    }
    (String::from_utf16_lossy(&units), 2 * units.len())
}

/// Decodes windows-1252.
pub(super) fn windows_1252(bytes: &[u8]) -> String {
    let one = |byte: &u8| match byte {
        0x80..=0x9f => WINDOWS_1252.chars().nth(usize::from(byte - 0x80)).unwrap_or('\u{fffd}'),
        byte => char::from(*byte),
    };
    bytes.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const WRITTEN: &str = "v_n;Größe [µm];note\n1,5;75;€ 𝛿\n";

    fn read(bytes: &[u8]) -> (String, bool) {
        let mut text = Text::new(bytes).unwrap();
        let mut all = String::new();
        text.read_to_string(&mut all).unwrap();
        (all, text.is_utf16())
    }

    #[test]
    fn utf16_is_decoded_with_and_without_a_mark() {
        let long = WRITTEN.repeat(3000);
        for mark in ["", "\u{feff}"] {
            let marked = format!("{mark}{long}");
            let little: Vec<u8> = marked.encode_utf16().flat_map(u16::to_le_bytes).collect();
            let big: Vec<u8> = marked.encode_utf16().flat_map(u16::to_be_bytes).collect();
            assert_eq!(read(&little), (long.clone(), true));
            assert_eq!(read(&big), (long.clone(), true));
            assert_eq!(read(marked.as_bytes()), (long.clone(), false));
        }
        let odd: Vec<u8> = "v_n\n1".encode_utf16().flat_map(u16::to_le_bytes).chain([b'2']).collect();
        assert_eq!(read(&odd).0, "v_n\n1\u{fffd}");
    }

    #[test]
    fn windows_1252_is_decoded() {
        assert_eq!(windows_1252(b"d [\xb5m] \x80 \x96 \xe4"), "d [µm] € – ä");
        assert_eq!(WINDOWS_1252.chars().count(), 32);
        assert!(Text::new(b"\xb5".as_slice()).unwrap().head().1);
        assert!(!Text::new("µ".as_bytes()).unwrap().head().1);
    }
}
