//! The syntax of OpenFOAM's files of meshes, fields and parcels: header, dictionaries, and lists in ASCII and binary.
//!
//! A binary list is its length, `(`, the bytes of its numbers and `)`. The widths of labels and
//! scalars and the order of their bytes are in the header (`arch`); without it they are 32 bits, 64
//! bits and little-endian.

use std::path::{Path, PathBuf};

/// Why a file of a case cannot be read: file, fault and remedy.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FoamError {
    /// Only a compressed file is there.
    #[error("{0}.gz is compressed, which is not read; run gunzip on it")]
    Compressed(String),
    /// The system refuses to read it.
    #[error("{0} cannot be read ({1}); copy it from where the case ran")]
    Unreadable(String, String),
    /// Its text is not what it should be at a byte.
    #[error("{0} {1} (byte {2}); write it again with the solver or copy it again from where the case ran")]
    Damaged(String, String, usize),
    /// The files of the mesh do not fit together.
    #[error("{0}; copy constant/polyMesh again from where the case ran")]
    Mesh(String),
    /// A file of parcels.
    #[error("{0} is absent, compressed or no list")]
    NoList(String),
    /// A list of parcels has another length than their places.
    #[error("{0} has {1} values for {2} parcels")]
    Parcels(String, usize, usize),
    /// Places that only the mesh can turn into coordinates.
    #[error("{0} has barycentric coordinates")]
    Barycentric(String),
    /// The parcels are elsewhere than the mesh.
    #[error("{0}: the parcels are in cells that the mesh does not have")]
    NoCell(String),
}

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
struct Arch {
    /// Bytes of a label.
    label: usize,
    /// Bytes of a scalar.
    scalar: usize,
    big_endian: bool,
}

impl Arch {
    /// From the text of the entry; without a width, 32 bits of a label and 64 of a scalar.
    fn of(text: &str) -> Self {
        let width = |name: &str| Some(text.split_once(name)?.1.get(..2)?.parse::<usize>().ok()? / 8);
        Self {
            label: width("label=").unwrap_or(4),
            scalar: width("scalar=").unwrap_or(8),
            big_endian: text.contains("MSB"),
        }
    }

    fn width(&self, is_label: bool) -> usize {
        if is_label { self.label } else { self.scalar }
    }

    /// The number that these bytes are; `None` for an unknown width.
    fn number(&self, bytes: &[u8], is_label: bool) -> Option<f64> {
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

/// A file while it is read.
pub(super) struct FoamFile {
    path: String,
    bytes: Vec<u8>,
    at: usize,
    binary: bool,
    arch: Arch,
    /// The entry `class` of the header.
    class: String,
}

impl FoamFile {
    /// Reads a file and its header.
    ///
    /// # Errors
    /// [`FoamError`].
    pub fn open(path: &Path) -> Result<Self, FoamError> {
        let shown = path.display().to_string();
        if !path.is_file() && compressed(path).is_file() {
            return Err(FoamError::Compressed(shown));
        }
        let bytes = std::fs::read(path);
        let bytes = bytes.map_err(|error| FoamError::Unreadable(shown.clone(), error.to_string()))?;
        let mut file =
            Self { path: shown, bytes, at: 0, binary: false, arch: Arch::of(""), class: String::new() };
        if file.word().as_deref() != Some("FoamFile") {
            return Err(file.fault("has no header FoamFile"));
        }
        file.expect("{")?;
        loop {
            match file.some_word()?.as_str() {
                "}" => return Ok(file),
                "format" => file.binary = file.some_word()? == "binary",
                "arch" => file.arch = Arch::of(&file.word().unwrap_or_default()),
                "class" => file.class = file.some_word()?,
                _ => {}
            }
        }
    }

    /// A fault of the file at the present place, with a remedy.
    pub fn fault(&self, what: impl Into<String>) -> FoamError {
        FoamError::Damaged(self.path.clone(), what.into(), self.at)
    }

    /// Whether its lists are bytes.
    pub fn is_binary(&self) -> bool {
        self.binary
    }

    /// What the list of a `labelField` or a `scalarField` holds.
    pub fn entries(&self) -> Entries {
        if self.class.starts_with("label") { Entries::Labels } else { Entries::Scalars(1) }
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
    pub fn some_word(&mut self) -> Result<String, FoamError> {
        self.word().ok_or_else(|| self.fault("ends too early"))
    }

    /// Skips the next word.
    ///
    /// # Errors
    /// When it is another one.
    pub fn expect(&mut self, word: &str) -> Result<(), FoamError> {
        match self.some_word()? {
            found if found == word => Ok(()),
            found => Err(self.fault(format!("has `{found}` where `{word}` should be"))),
        }
    }

    /// The next word as a number of a kind, whose name is `what`.
    fn parsed<T: std::str::FromStr>(&mut self, what: &str) -> Result<T, FoamError> {
        let word = self.some_word()?;
        word.parse().map_err(|_| self.fault(format!("has `{word}` where a {what} should be")))
    }

    /// The next number.
    ///
    /// # Errors
    /// When it is none.
    pub fn number(&mut self) -> Result<f64, FoamError> {
        self.parsed("number")
    }

    /// The next whole number.
    ///
    /// # Errors
    /// When it is none.
    pub fn count(&mut self) -> Result<usize, FoamError> {
        self.parsed("whole number")
    }

    /// The list that begins here.
    ///
    /// # Errors
    /// When there is none, or when it is cut off.
    pub fn list(&mut self, entries: Entries) -> Result<Numbers, FoamError> {
        let count = self.count()?;
        match self.peek() {
            Some(b'{') => {
                self.expect("{")?;
                let entry = self.entry(entries)?;
                self.expect("}")?;
                Ok(Numbers::Same(count, entry))
            }
            Some(b'(') if self.binary && count > 0 => self.bytes_of(count, entries),
            Some(b'(') => {
                self.expect("(")?;
                let mut numbers = Vec::new();
                for _ in 0..count {
                    numbers.extend(self.entry(entries)?);
                }
                self.expect(")")?;
                Ok(Numbers::Each(numbers))
            }
            // A binary list without entries has no brackets.
            _ if count == 0 => Ok(Numbers::Each(Vec::new())),
            _ => Err(self.fault("has no bracket after the length of a list")),
        }
    }

    /// The labels of a list.
    ///
    /// # Errors
    /// As [`Self::list`].
    pub fn labels(&mut self) -> Result<Vec<usize>, FoamError> {
        let most = self.bytes.len();
        let numbers = self.list(Entries::Labels)?.all(most);
        let numbers = numbers.ok_or_else(|| self.fault("has a list that is too long"))?;
        if numbers.iter().any(|number| *number < 0.0) {
            return Err(self.fault("has a negative label"));
        }
        Ok(numbers.into_iter().map(|number| number as usize).collect())
    }

    /// The vectors of a list; none where all are equal.
    ///
    /// # Errors
    /// As [`Self::list`].
    pub fn vectors(&mut self) -> Result<Vec<[f64; 3]>, FoamError> {
        let numbers = self.list(Entries::Scalars(3))?.all(0).unwrap_or_default();
        Ok(numbers.chunks_exact(3).map(|place| [place[0], place[1], place[2]]).collect())
    }

    /// The values of a field in `count` cells or on faces, which `name` counts: `uniform 1;`,
    /// `uniform (1 2 3);` or `nonuniform List<scalar> 2(1 2);`, which may lack the type where the
    /// list is empty. The `parts` of an entry, 1 of a scalar and 3 of a vector, stand side by side.
    ///
    /// # Errors
    /// Another form, or another number of values.
    pub fn field_values(&mut self, parts: usize, count: usize, name: &str) -> Result<Vec<f64>, FoamError> {
        let found = match self.some_word()?.as_str() {
            "uniform" => self.entry(Entries::Scalars(parts))?.repeat(count),
            "nonuniform" => {
                if self.peek() == Some(b'L') {
                    self.expect(if parts == 1 { "List<scalar>" } else { "List<vector>" })?;
                }
                self.list(Entries::Scalars(parts))?.all(count).unwrap_or_default()
            }
            other => {
                let fault = format!("has a value `{other}`, which is neither uniform nor nonuniform");
                return Err(self.fault(fault));
            }
        };
        if found.len() != parts * count {
            return Err(self.fault(format!("has {} values for {count} {name}", found.len() / parts)));
        }
        self.expect(";")?;
        Ok(found)
    }

    /// Goes to the value of an entry of the file.
    ///
    /// # Errors
    /// Without such an entry.
    pub fn seek(&mut self, key: &str) -> Result<(), FoamError> {
        while let Some(found) = self.word() {
            if found == key {
                return Ok(());
            }
            self.skip_value()?;
        }
        Err(self.fault(format!("has no {key}")))
    }

    /// An entry in ASCII.
    fn entry(&mut self, entries: Entries) -> Result<Vec<f64>, FoamError> {
        let Entries::Scalars(parts @ 2..) = entries else { return Ok(vec![self.number()?]) };
        self.expect("(")?;
        let entry: Result<Vec<f64>, FoamError> = (0..parts).map(|_| self.number()).collect();
        self.expect(")")?;
        entry
    }

    fn bytes_of(&mut self, count: usize, entries: Entries) -> Result<Numbers, FoamError> {
        let is_label = entries == Entries::Labels;
        let width = self.arch.width(is_label);
        let parts = if let Entries::Scalars(parts) = entries { parts } else { 1 };
        let length = count.checked_mul(parts * width).and_then(|length| length.checked_add(self.at + 1));
        let body = length.and_then(|end| self.bytes.get(self.at + 1..end));
        let body = body.ok_or_else(|| self.fault("ends within a list"))?;
        let read = |bytes: &[u8]| self.arch.number(bytes, is_label);
        let numbers: Option<Vec<f64>> = body.chunks_exact(width.max(1)).map(read).collect();
        let numbers = numbers.ok_or_else(|| self.fault("has numbers of an unknown width (arch)"))?;
        self.at += 1 + body.len();
        self.expect(")")?;
        Ok(Numbers::Each(numbers))
    }

    /// The rows of a list of places: scalars between brackets, then labels, `(x y z) cell` for
    /// instance. In binary each row has brackets of its own, around one of these `forms`: so many
    /// scalars and so many labels.
    ///
    /// # Errors
    /// When there are no such rows, or when the list is cut off.
    pub fn rows(&mut self, forms: &[[usize; 2]]) -> Result<Vec<Vec<f64>>, FoamError> {
        let count = self.count()?;
        if self.binary && count > 0 {
            let rows = forms.iter().find_map(|form| self.binary_rows(count, *form));
            return rows.ok_or_else(|| self.fault("has no list of places"));
        }
        if count > 0 {
            self.expect("(")?;
        }
        let mut rows = Vec::new();
        for _ in 0..count {
            let mut row = Vec::new();
            self.expect("(")?;
            while self.peek() != Some(b')') {
                row.push(self.number()?);
            }
            self.expect(")")?;
            while !matches!(self.peek(), Some(b'(' | b')')) {
                row.push(self.number()?);
            }
            rows.push(row);
        }
        Ok(rows)
    }

    /// Binary rows of one form; `None` when they are of another one.
    fn binary_rows(&mut self, count: usize, [scalars, labels]: [usize; 2]) -> Option<Vec<Vec<f64>>> {
        self.skip_blank();
        let body = self.bytes.get(self.at..)?;
        let [scalar, label] = [self.arch.scalar, self.arch.label];
        let length = scalars * scalar + labels * label;
        let first = 1 + body.iter().skip(1).position(|byte| *byte == b'(')?;
        let row = |place: usize| {
            let row = body.get(first + place * (length + 3)..)?.get(..length + 2)?;
            let inside = row.strip_prefix(b"(")?.strip_suffix(b")")?;
            let (scalars, labels) = inside.split_at(scalars * scalar);
            let scalars = scalars.chunks_exact(scalar).map(|bytes| self.arch.number(bytes, false));
            scalars.chain(labels.chunks_exact(label).map(|bytes| self.arch.number(bytes, true))).collect()
        };
        // The bracket that closes the list tells rows of this form from longer ones, also where there is but one.
        let end = count.checked_mul(length + 3)?.checked_add(first)?;
        (body.get(end) == Some(&b')')).then(|| (0..count).map(row).collect())?
    }

    /// Skips the value of a dictionary's entry: up to its semicolon, or a whole dictionary.
    ///
    /// # Errors
    /// When the file ends too early.
    pub fn skip_value(&mut self) -> Result<(), FoamError> {
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
    fn skip_list(&mut self, list: &str) -> Result<(), FoamError> {
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
