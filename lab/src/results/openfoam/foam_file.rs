//! The syntax of OpenFOAM's files of meshes and fields: header, dictionaries, and lists in ASCII and binary.
//!
//! A binary list is its length, `(`, the bytes of its numbers and `)`. The widths of labels and scalars and the order of
//! their bytes are in the header (`arch`); without it they are 32 bits, 64 bits and little-endian.

use std::path::{Path, PathBuf};

/// Whether a file is there, compressed or not.
pub(super) fn is_written(path: &Path) -> bool {
    path.is_file() || compressed(path).is_file()
}

/// The same file as OpenFOAM compresses it.
fn compressed(path: &Path) -> PathBuf {
    path.with_file_name(format!("{}.gz", super::file_name(path)))
}

/// How a binary file writes numbers: `arch` of its header, for instance `"LSB;label=32;scalar=64"`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arch {
    /// Bytes of a label.
    pub label: usize,
    /// Bytes of a scalar.
    pub scalar: usize,
    big_endian: bool,
}

impl Arch {
    /// From the text of the entry; without a width, 32 bits of a label and 64 of a scalar.
    pub fn of(text: &str) -> Self {
        let width = |name: &str| {
            let bits: usize = text.split_once(name)?.1.get(..2)?.parse().ok()?;
            Some(bits / 8)
        };
        Self {
            label: width("label=").unwrap_or(4),
            scalar: width("scalar=").unwrap_or(8),
            big_endian: text.contains("MSB"),
        }
    }

    /// The number that these bytes are; `None` for an unknown width.
    pub fn number(&self, bytes: &[u8], is_label: bool) -> Option<f64> {
        let mut number = [0; 8];
        let number = number.get_mut(..bytes.len())?;
        number.copy_from_slice(bytes);
        if self.big_endian {
            number.reverse();
        }
        Some(match (bytes.len(), is_label) {
            (4, true) => f64::from(i32::from_le_bytes((&*number).try_into().ok()?)),
            (8, true) => i64::from_le_bytes((&*number).try_into().ok()?) as f64,
            (4, false) => f64::from(f32::from_le_bytes((&*number).try_into().ok()?)),
            (8, false) => f64::from_le_bytes((&*number).try_into().ok()?),
            _ => return None,
        })
    }
}

/// A file while it is read.
pub(super) struct FoamFile {
    path: String,
    bytes: Vec<u8>,
    at: usize,
    binary: bool,
    arch: Arch,
}

/// What a list holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Entries {
    Labels,
    /// So many scalars an entry: 1, or 3 of a vector.
    Scalars(usize),
}

/// The numbers of a list.
#[derive(Debug, PartialEq)]
pub(super) enum Numbers {
    Each(Vec<f64>),
    /// So many entries, all with these numbers.
    Same(usize, Vec<f64>),
}

impl Numbers {
    /// All numbers of at most so many entries; `None` when there are more.
    pub fn all(self, most: usize) -> Option<Vec<f64>> {
        match self {
            Self::Each(numbers) => Some(numbers),
            Self::Same(count, entry) => (count <= most).then(|| entry.repeat(count)),
        }
    }
}

impl FoamFile {
    /// Reads a file and its header.
    ///
    /// # Errors
    /// File, fault and remedy.
    pub fn open(path: &Path) -> Result<Self, String> {
        let shown = path.display().to_string();
        if !path.is_file() && compressed(path).is_file() {
            return Err(format!("{shown}.gz is compressed, which is not read; run gunzip on it"));
        }
        let bytes = std::fs::read(path)
            .map_err(|error| format!("{shown} cannot be read ({error}); copy it from where the case ran"))?;
        Self::of(shown, bytes)
    }

    fn of(path: String, bytes: Vec<u8>) -> Result<Self, String> {
        let mut file = Self { path, bytes, at: 0, binary: false, arch: Arch::of("") };
        if file.word().as_deref() != Some("FoamFile") {
            return Err(file.fault("has no header FoamFile"));
        }
        file.expect("{")?;
        loop {
            match file.some_word()?.as_str() {
                "}" => return Ok(file),
                "format" => file.binary = file.some_word()? == "binary",
                "arch" => file.arch = Arch::of(&file.word().unwrap_or_default()),
                _ => {}
            }
        }
    }

    /// A fault of the file at the present place, with a remedy.
    pub fn fault(&self, what: &str) -> String {
        format!(
            "{} {what} (byte {}); write it again with the solver or copy it again from where the case ran",
            self.path, self.at
        )
    }

    /// Whether its lists are bytes.
    pub fn is_binary(&self) -> bool {
        self.binary
    }

    /// Skips spaces and comments.
    fn skip_blank(&mut self) {
        loop {
            let rest = self.bytes.get(self.at..).unwrap_or_default();
            let length = |end: &[u8]| {
                let place = rest.windows(end.len()).position(|part| part == end);
                place.map_or(rest.len(), |place| place + end.len())
            };
            self.at += match rest {
                [b'/', b'/', ..] => length(b"\n"),
                [b'/', b'*', ..] => length(b"*/"),
                [first, ..] if first.is_ascii_whitespace() => 1,
                _ => return,
            };
        }
    }

    /// The next byte that is neither space nor comment.
    pub fn peek(&mut self) -> Option<u8> {
        self.skip_blank();
        self.bytes.get(self.at).copied()
    }

    /// The next bracket, semicolon, quoted text or word; `None` at the end.
    pub fn word(&mut self) -> Option<String> {
        let first = self.peek()?;
        let rest = &self.bytes[self.at..];
        if first == b'"' {
            let length = rest[1..].iter().position(|byte| *byte == b'"')?;
            self.at += length + 2;
            return Some(String::from_utf8_lossy(&rest[1..=length]).into_owned());
        }
        let is_end = |byte: &u8| byte.is_ascii_whitespace() || b"(){};\"".contains(byte);
        let length = rest.iter().position(is_end).unwrap_or(rest.len()).max(1);
        self.at += length;
        Some(String::from_utf8_lossy(&rest[..length]).into_owned())
    }

    /// The next word.
    ///
    /// # Errors
    /// At the end of the file.
    pub fn some_word(&mut self) -> Result<String, String> {
        self.word().ok_or_else(|| self.fault("ends too early"))
    }

    /// Skips the next word.
    ///
    /// # Errors
    /// When it is another one.
    pub fn expect(&mut self, word: &str) -> Result<(), String> {
        match self.some_word()? {
            found if found == word => Ok(()),
            found => Err(self.fault(&format!("has `{found}` where `{word}` should be"))),
        }
    }

    /// The next number.
    ///
    /// # Errors
    /// When it is none.
    pub fn number(&mut self) -> Result<f64, String> {
        let word = self.some_word()?;
        word.parse().map_err(|_| self.fault(&format!("has `{word}` where a number should be")))
    }

    /// The next whole number.
    ///
    /// # Errors
    /// When it is none.
    pub fn count(&mut self) -> Result<usize, String> {
        let word = self.some_word()?;
        word.parse().map_err(|_| self.fault(&format!("has `{word}` where a whole number should be")))
    }

    /// The list that begins here.
    ///
    /// # Errors
    /// When there is none, or when it is cut off.
    pub fn list(&mut self, entries: Entries) -> Result<Numbers, String> {
        let count = self.count()?;
        match self.peek() {
            Some(b'{') => self.same(count, entries),
            Some(b'(') if self.binary && count > 0 => self.bytes_of(count, entries),
            Some(b'(') => self.texts_of(count, entries),
            // A binary list without entries has no brackets.
            _ if count == 0 => Ok(Numbers::Each(Vec::new())),
            _ => Err(self.fault("has no bracket after the length of a list")),
        }
    }

    /// The labels of a list.
    ///
    /// # Errors
    /// As [`Self::list`].
    pub fn labels(&mut self) -> Result<Vec<usize>, String> {
        let most = self.bytes.len();
        let numbers = self.list(Entries::Labels)?.all(most);
        let numbers = numbers.ok_or_else(|| self.fault("has a list that is too long"))?;
        if numbers.iter().any(|number| *number < 0.0) {
            return Err(self.fault("has a negative label"));
        }
        Ok(numbers.into_iter().map(|number| number as usize).collect())
    }

    /// `{entry}` after the number of equal entries.
    fn same(&mut self, count: usize, entries: Entries) -> Result<Numbers, String> {
        self.expect("{")?;
        let entry = self.entry(entries)?;
        self.expect("}")?;
        Ok(Numbers::Same(count, entry))
    }

    /// An entry in ASCII.
    ///
    /// # Errors
    /// When it is none.
    pub fn entry(&mut self, entries: Entries) -> Result<Vec<f64>, String> {
        let Entries::Scalars(parts @ 2..) = entries else { return Ok(vec![self.number()?]) };
        self.expect("(")?;
        let entry: Result<Vec<f64>, String> = (0..parts).map(|_| self.number()).collect();
        self.expect(")")?;
        entry
    }

    fn texts_of(&mut self, count: usize, entries: Entries) -> Result<Numbers, String> {
        self.expect("(")?;
        let mut numbers = Vec::new();
        for _ in 0..count {
            numbers.extend(self.entry(entries)?);
        }
        self.expect(")")?;
        Ok(Numbers::Each(numbers))
    }

    fn bytes_of(&mut self, count: usize, entries: Entries) -> Result<Numbers, String> {
        let (parts, width) = match entries {
            Entries::Labels => (1, self.arch.label),
            Entries::Scalars(parts) => (parts, self.arch.scalar),
        };
        let length = count.checked_mul(parts * width).and_then(|length| length.checked_add(self.at + 1));
        let body = length.and_then(|end| self.bytes.get(self.at + 1..end));
        let body = body.ok_or_else(|| self.fault("ends within a list"))?;
        let read = |bytes: &[u8]| self.arch.number(bytes, entries == Entries::Labels);
        let numbers: Option<Vec<f64>> = body.chunks_exact(width.max(1)).map(read).collect();
        let numbers = numbers.ok_or_else(|| self.fault("has numbers of an unknown width (arch)"))?;
        self.at += 1 + body.len();
        self.expect(")")?;
        Ok(Numbers::Each(numbers))
    }

    /// Skips the value of a dictionary's entry: up to its semicolon, or a whole dictionary.
    ///
    /// # Errors
    /// When the file ends too early.
    pub fn skip_value(&mut self) -> Result<(), String> {
        let is_dictionary = self.peek() == Some(b'{');
        let mut depth = 0_usize;
        loop {
            let word = self.some_word()?;
            match word.as_str() {
                ";" if depth == 0 => return Ok(()),
                "{" | "(" => depth += 1,
                "}" | ")" => {
                    depth = depth.saturating_sub(1);
                    if is_dictionary && depth == 0 {
                        return Ok(());
                    }
                }
                list if list.starts_with("List<") => self.skip_list(list)?,
                _ => {}
            }
        }
    }

    /// Skips a list of this type, whose bytes may look like brackets.
    fn skip_list(&mut self, list: &str) -> Result<(), String> {
        let entries = match list {
            "List<label>" => Entries::Labels,
            "List<scalar>" | "List<sphericalTensor>" => Entries::Scalars(1),
            "List<vector>" => Entries::Scalars(3),
            "List<symmTensor>" => Entries::Scalars(6),
            "List<tensor>" => Entries::Scalars(9),
            _ => return Ok(()),
        };
        self.list(entries).map(drop)
    }
}
