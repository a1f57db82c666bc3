//! A CSV file as records of cells, with a checked header.

use std::io::Read;

use super::encoding::{Text, windows_1252};
use super::headings::{self, UnitRow};
use super::lines::Lines;
use super::notation::Notation;
use super::number::NumberStyle;
use super::{BadRow, DatasetError};

/// The layout of a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    /// Separator of the cells, if it is stated.
    pub(super) separator: Option<u8>,
    /// Whether the decimal separator is a comma, if it is stated.
    pub(super) decimal_comma: Option<bool>,
    /// First character of a comment line.
    pub(super) comment: Option<u8>,
    /// Line of the header, counted from 1.
    pub(super) header_line: u64,
}

impl Default for Layout {
    fn default() -> Self {
        Self { separator: None, decimal_comma: None, comment: Some(b'#'), header_line: 1 }
    }
}

/// Largest number of characters of column names in a message.
const LONGEST_LIST: usize = 1000;

/// A reader of records with as many cells as the header.
pub(super) struct CsvTable<R> {
    reader: csv::Reader<Lines<Text<R>>>,
    file: String,
    notation: Notation,
    utf16: bool,
    /// Whether a cell was not UTF-8.
    windows_1252: bool,
    /// The line of a row of units under the header.
    unit_line: Option<u64>,
    /// The first record, if it is no row of units.
    first: Option<(csv::StringRecord, Result<u64, BadRow>)>,
    headers: csv::StringRecord,
    /// Number of lines before that in which the header is looked for.
    skipped: u64,
    /// Line of the header.
    header_line: u64,
    /// Stands in for a record while its bytes are read, so that no memory is allocated.
    spare: Option<csv::StringRecord>,
}

impl<R: Read> CsvTable<R> {
    /// Reads the header and a row of units under it; `file` names the source in messages. Names for
    /// which `unused` holds may be repeated; `mapped` tells the columns whose unit a column map states.
    ///
    /// # Errors
    /// [`DatasetError`] for a source that cannot be read, is empty, repeats a name, or whose notation or
    /// units are not clear.
    pub(super) fn open(
        file: &str,
        source: R,
        layout: Layout,
        unused: impl Fn(&str) -> bool,
        mapped: impl Fn(&str) -> bool,
    ) -> Result<Self, DatasetError> {
        let skipped = layout.header_line - 1;
        let text = Text::new(source)
            .map_err(|error| DatasetError::Unreadable { file: file.to_owned(), reason: error.to_string() })?;
        let (head, windows_1252) = text.head();
        let notation = Notation::of(&head, &layout).map_err(|(line, problem)| DatasetError::Header {
            file: file.to_owned(),
            line,
            problem,
        })?;
        let utf16 = text.is_utf16();
        let reader = csv::ReaderBuilder::new()
            .delimiter(notation.separator)
            .trim(csv::Trim::Headers)
            .comment(layout.comment)
            .flexible(true)
            .from_reader(Lines::new(text, skipped));
        let mut table = Self {
            reader,
            file: file.to_owned(),
            notation,
            utf16,
            windows_1252,
            unit_line: None,
            first: None,
            headers: csv::StringRecord::new(),
            skipped,
            header_line: layout.header_line,
            spare: None,
        };
        table.headers = table.read_headers()?;
        table.check_headers(unused)?;
        table.read_units(mapped)?;
        Ok(table)
    }

    /// Refuses a missing header and repeated names.
    fn check_headers(&self, unused: impl Fn(&str) -> bool) -> Result<(), DatasetError> {
        if self.headers.iter().all(str::is_empty) {
            let problem = "there is no header; the first line that is no comment must name the columns";
            return Err(self.header_fault(problem.to_owned()));
        }
        for (index, name) in self.headers.iter().enumerate() {
            if !unused(name) && self.headers.iter().take(index).any(|earlier| earlier == name) {
                return Err(self.header_fault(format!("column `{name}` occurs twice; rename one")));
            }
        }
        Ok(())
    }

    /// Writes the units of a row under the header into the headings, or keeps the row as the first one.
    fn read_units(&mut self, mapped: impl Fn(&str) -> bool) -> Result<(), DatasetError> {
        let mut cells = csv::StringRecord::new();
        let Some(next) = self.next_into(&mut cells)? else { return Ok(()) };
        match (headings::unit_row(&self.headers, &cells, self.style(), mapped), &next) {
            (UnitRow::Units(headers), Ok(line)) => {
                (self.headers, self.unit_line) = (headers, Some(*line));
            }
            (UnitRow::Unknown(problem), Ok(line)) => return Err(self.fault(*line, problem)),
            _ => self.first = Some((cells, next)),
        }
        Ok(())
    }

    /// The notation of its numbers.
    pub(super) fn style(&self) -> NumberStyle {
        NumberStyle { decimal_comma: self.notation.decimal_comma, markers: true }
    }

    /// Separator of its cells.
    pub(super) fn separator(&self) -> u8 {
        self.notation.separator
    }

    /// What was found out about the file, other than in nearwall's own format.
    pub(super) fn notes(&self) -> Vec<String> {
        let encoding = match (self.utf16, self.windows_1252) {
            (true, _) => Some("read as UTF-16".to_owned()),
            (_, true) => Some("read as windows-1252, because it is not UTF-8".to_owned()),
            _ => None,
        };
        let units = self.unit_line.map(|line| format!("line {line} states units"));
        [encoding, self.notation.note(), units].into_iter().flatten().collect()
    }

    /// An error of this line.
    pub(super) fn fault(&self, line: u64, problem: impl Into<String>) -> DatasetError {
        DatasetError::Header { file: self.file.clone(), line, problem: problem.into() }
    }

    fn read_headers(&mut self) -> Result<csv::StringRecord, DatasetError> {
        let names = match self.reader.byte_headers() {
            Ok(names) => decode(names.clone()).0,
            Err(error) => return Err(self.unreadable(&error)),
        };
        let before = self.reader.position().line().saturating_sub(1).max(1);
        self.header_line = before + self.skipped;
        if names.iter().any(|name| name.contains(|mark: char| mark.is_control() && !mark.is_whitespace())) {
            return Err(self.header_fault("the file is no text; save it as CSV"));
        }
        Ok(names.iter().map(str::trim).collect())
    }

    /// The column names.
    pub(super) fn headers(&self) -> &csv::StringRecord {
        &self.headers
    }

    /// The column of this name.
    pub(super) fn column(&self, name: &str) -> Option<usize> {
        self.headers.iter().position(|header| header == name)
    }

    /// An error of the header.
    pub(super) fn header_fault(&self, problem: impl Into<String>) -> DatasetError {
        self.fault(self.header_line, problem)
    }

    /// An error of the header with a list of its columns; `mapped` tells whether a column map is possible.
    pub(super) fn column_fault(&self, problem: &str, mapped: bool) -> DatasetError {
        let found = self.headers.iter().collect::<Vec<_>>().join(", ");
        let remedy = if mapped {
            "A column map (--columns) assigns them."
        } else {
            "Rename the column of the normal speed."
        };
        // With an unterminated quotation mark the header is the whole file.
        let found = match found.char_indices().nth(LONGEST_LIST) {
            Some((end, _)) => format!("{} ...", found.get(..end).unwrap_or_default()),
            None => found,
        };
        self.header_fault(format!("{problem}. The columns are: {found}. {remedy}"))
    }

    /// Reads the next record into `cells`; returns its first line, or `None` at the end.
    ///
    /// # Errors
    /// [`DatasetError::Unreadable`] when the source fails.
    pub(super) fn next_into(
        &mut self,
        cells: &mut csv::StringRecord,
    ) -> Result<Option<Result<u64, BadRow>>, DatasetError> {
        if let Some((first, line)) = self.first.take() {
            *cells = first;
            return Ok(Some(line));
        }
        // As bytes, so that the lines of a row that is not UTF-8 are counted.
        let spare = self.spare.take().unwrap_or_default();
        let mut record = std::mem::replace(cells, spare).into_byte_record();
        let start = self.reader.position().line();
        if !self.reader.read_byte_record(&mut record).map_err(|error| self.unreadable(&error))? {
            return Ok(None);
        }
        let end = self.reader.position();
        // Every record ends with its line feed, except one with an unterminated quotation mark.
        let open = self.reader.get_ref().ends_at(end.byte());
        let last = self.skipped + end.line() - u64::from(!open);
        // The CSV reader reports the line of a preceding comment as the start of a record, but its end is correct.
        let inside = match end.line() - start {
            0 | 1 => 0,
            _ => record.as_slice().iter().filter(|byte| **byte == b'\n').count(),
        };
        let line = last.saturating_sub(inside as u64);
        let (read, other) = decode(record);
        self.windows_1252 |= other;
        self.spare = Some(std::mem::replace(cells, read));
        trim(cells);
        Ok(Some(self.check_width(cells, line)))
    }

    fn check_width(&self, cells: &csv::StringRecord, line: u64) -> Result<u64, BadRow> {
        if cells.len() == self.headers.len() {
            return Ok(line);
        }
        let reason = format!("the row has {} cells, the header {}", cells.len(), self.headers.len());
        Err(BadRow { line, reason })
    }

    fn unreadable(&self, error: &csv::Error) -> DatasetError {
        DatasetError::Unreadable { file: self.file.clone(), reason: error.to_string() }
    }
}

/// The record as text, and whether it is not UTF-8.
fn decode(record: csv::ByteRecord) -> (csv::StringRecord, bool) {
    match csv::StringRecord::from_byte_record(record) {
        Ok(read) => (read, false),
        Err(error) => (error.into_byte_record().iter().map(windows_1252).collect(), true),
    }
}

/// Trims the cells; most records need no copy.
fn trim(cells: &mut csv::StringRecord) {
    let is_space = |byte: Option<&u8>| byte.is_some_and(|byte| *byte <= b' ' || !byte.is_ascii());
    let has_ends = |cell: &str| is_space(cell.as_bytes().first()) || is_space(cell.as_bytes().last());
    if cells.iter().any(has_ends) {
        cells.trim();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first lines of the records.
    fn lines(text: &str, layout: Layout) -> Vec<u64> {
        let mut table = CsvTable::open("t.csv", text.as_bytes(), layout, |_| false, |_| false).unwrap();
        let mut cells = csv::StringRecord::new();
        let mut found = Vec::new();
        while let Some(next) = table.next_into(&mut cells).unwrap() {
            found.push(next.unwrap_or_else(|bad| bad.line));
        }
        found
    }

    #[test]
    fn records_have_their_line_whatever_precedes() {
        let plain = "a,b\n# comment\n1,2\n\n\n\"x\ny\",2\n3\n4,5";
        assert_eq!(lines(plain, Layout::default()), [3, 6, 8, 9]);
        let windows = plain.replace('\n', "\r\n");
        assert_eq!(lines(&windows, Layout::default()), [3, 6, 8, 9]);
        let old = plain.replace('\n', "\r");
        assert_eq!(lines(&old, Layout::default()), [3, 6, 8, 9]);
        let preamble = format!("Rig 3\n\"weird\n{plain}");
        assert_eq!(lines("a,b\n# c\n1,\"x\ny\n", Layout::default()), [3]);
        assert_eq!(lines("a,b\n1,\" x\n \"\n1,2\n", Layout::default()), [2, 4]);
        assert_eq!(lines(&preamble, Layout { header_line: 3, ..Layout::default() }), [5, 8, 10, 11]);
    }

    #[test]
    fn empty_headers_are_refused() {
        let fault = |bytes: &[u8]| {
            CsvTable::open("t.csv", bytes, Layout::default(), |_| false, |_| false).err().unwrap().to_string()
        };
        for empty in ["", "\n\n", "\u{feff}", "# only this\r\n", ",,\n"] {
            assert!(fault(empty.as_bytes()).contains("there is no header"), "{empty:?}");
        }
        assert_eq!(fault(b"#\n#\na,b,a\n"), "t.csv:3: column `a` occurs twice; rename one");
        assert_eq!(fault(b"PK\x03\x04\n"), "t.csv:1: the file is no text; save it as CSV");
    }

    #[test]
    fn rows_that_are_not_utf8_are_windows_1252() {
        let text = b"a\n\xb5\n1\n".as_slice();
        let mut table = CsvTable::open("t.csv", text, Layout::default(), |_| false, |_| false).unwrap();
        let mut cells = csv::StringRecord::new();
        assert_eq!(table.next_into(&mut cells).unwrap(), Some(Ok(2)));
        assert_eq!(&cells[0], "µ");
        assert_eq!(table.next_into(&mut cells).unwrap(), Some(Ok(3)));
        assert_eq!(table.notes(), ["read as windows-1252, because it is not UTF-8"]);
        let mut lines = |text: &[u8]| {
            let mut table = CsvTable::open("t.csv", text, Layout::default(), |_| false, |_| false).unwrap();
            let mut next =
                || table.next_into(&mut cells).unwrap().map(|row| row.unwrap_or_else(|bad| bad.line));
            [next(), next(), next()]
        };
        assert_eq!(lines(b"a\n\"\xff"), [Some(2), None, None], "with an unterminated quotation mark");
        assert_eq!(lines(b"a\n\"x\n\n\xff\n\"\n1\n"), [Some(2), Some(6), None], "over several lines");
    }
}
