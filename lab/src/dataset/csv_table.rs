//! A CSV file as records of cells, with a checked header.

use std::io::Read;

use super::lines::Lines;
use super::{BadRow, DatasetError};

/// The layout of a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    /// Separator of the cells.
    pub(super) separator: u8,
    /// First character of a comment line.
    pub(super) comment: Option<u8>,
    /// Line of the header, counted from 1.
    pub(super) header_line: u64,
}

impl Default for Layout {
    fn default() -> Self {
        Self { separator: b',', comment: Some(b'#'), header_line: 1 }
    }
}

/// Largest number of characters of column names in a message.
const LONGEST_LIST: usize = 1000;

/// A reader of records with as many cells as the header.
pub(super) struct CsvTable<R> {
    reader: csv::Reader<Lines<R>>,
    file: String,
    headers: csv::StringRecord,
    /// Number of lines before the header.
    skipped: u64,
    /// Stands in for a record while its bytes are read, so that no memory is allocated.
    spare: Option<csv::StringRecord>,
}

impl<R: Read> CsvTable<R> {
    /// Reads the header; `file` names the source in messages. Names for which `unused` holds may be repeated.
    ///
    /// # Errors
    /// [`DatasetError`] for a source that cannot be read, is empty or repeats a name.
    pub(super) fn open(
        file: &str,
        source: R,
        layout: Layout,
        unused: impl Fn(&str) -> bool,
    ) -> Result<Self, DatasetError> {
        let skipped = layout.header_line - 1;
        let reader = csv::ReaderBuilder::new()
            .delimiter(layout.separator)
            .trim(csv::Trim::Headers)
            .comment(layout.comment)
            .flexible(true)
            .from_reader(Lines::new(source, skipped));
        let headers = csv::StringRecord::new();
        let mut table = Self { reader, file: file.to_owned(), headers, skipped, spare: None };
        table.headers = table.read_headers()?;
        if table.headers.iter().all(str::is_empty) {
            let problem = "there is no header; the first line that is no comment must name the columns";
            let (file, problem) = (file.to_owned(), problem.to_owned());
            return Err(DatasetError::Header { file, line: layout.header_line, problem });
        }
        for (index, name) in table.headers.iter().enumerate() {
            if !unused(name) && table.headers.iter().take(index).any(|earlier| earlier == name) {
                return Err(table.header_fault(format!("column `{name}` occurs twice; rename one")));
            }
        }
        Ok(table)
    }

    fn read_headers(&mut self) -> Result<csv::StringRecord, DatasetError> {
        match self.reader.headers() {
            Ok(names) => Ok(names.iter().map(|name| name.trim_start_matches('\u{feff}')).collect()),
            Err(error) if matches!(error.kind(), csv::ErrorKind::Utf8 { .. }) => {
                Err(self.header_fault("the header is not UTF-8; save the file as UTF-8"))
            }
            Err(error) => Err(self.unreadable(&error)),
        }
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
        let before = self.reader.position().line().saturating_sub(1).max(1);
        DatasetError::Header { file: self.file.clone(), line: before + self.skipped, problem: problem.into() }
    }

    /// An error of the header with a list of its columns; `mapped` tells whether a column map is possible.
    pub(super) fn column_fault(&self, problem: &str, mapped: bool) -> DatasetError {
        let found = self.headers.iter().collect::<Vec<_>>().join(", ");
        let mark =
            found.chars().find(|mark| [';', '\t', '|'].contains(mark)).filter(|_| self.headers.len() == 1);
        let separator = match mark {
            None => String::new(),
            Some(_) if !mapped => " Cells must be separated by commas.".to_owned(),
            Some(mark) => {
                let mark = if mark == '\t' { "tab".to_owned() } else { mark.to_string() };
                format!(" Cells are separated by commas unless the column map sets separator = \"{mark}\".")
            }
        };
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
        self.header_fault(format!("{problem}. The columns are: {found}. {remedy}{separator}"))
    }

    /// Reads the next record into `cells`; returns its first line, or `None` at the end.
    ///
    /// # Errors
    /// [`DatasetError::Unreadable`] when the source fails.
    pub(super) fn next_into(
        &mut self,
        cells: &mut csv::StringRecord,
    ) -> Result<Option<Result<u64, BadRow>>, DatasetError> {
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
        Ok(Some(match csv::StringRecord::from_byte_record(record) {
            Ok(read) => {
                self.spare = Some(std::mem::replace(cells, read));
                trim(cells);
                self.check_width(cells, line)
            }
            Err(_) => Err(BadRow { line, reason: "the row is not UTF-8".to_owned() }),
        }))
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
        let mut table = CsvTable::open("t.csv", text.as_bytes(), layout, |_| false).unwrap();
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
            CsvTable::open("t.csv", bytes, Layout::default(), |_| false).err().unwrap().to_string()
        };
        for empty in ["", "\n\n", "\u{feff}", "# only this\r\n", ",,\n"] {
            assert!(fault(empty.as_bytes()).contains("there is no header"), "{empty:?}");
        }
        assert_eq!(fault(b"#\n#\na,b,a\n"), "t.csv:3: column `a` occurs twice; rename one");
        let utf16: Vec<u8> = "\u{feff}v_n,e_n\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
        for bytes in [b"d [\xb5m]\n1\n".as_slice(), &utf16] {
            assert_eq!(fault(bytes), "t.csv:1: the header is not UTF-8; save the file as UTF-8");
        }
    }

    #[test]
    fn rows_that_are_not_utf8_are_named() {
        let mut table =
            CsvTable::open("t.csv", b"a\n\xb5\n1\n".as_slice(), Layout::default(), |_| false).unwrap();
        let mut cells = csv::StringRecord::new();
        let bad = table.next_into(&mut cells).unwrap().unwrap().unwrap_err();
        assert_eq!((bad.line, bad.reason.as_str()), (2, "the row is not UTF-8"));
        assert_eq!(table.next_into(&mut cells).unwrap(), Some(Ok(3)));
        let mut lines = |text: &[u8]| {
            let mut table = CsvTable::open("t.csv", text, Layout::default(), |_| false).unwrap();
            let mut next =
                || table.next_into(&mut cells).unwrap().map(|row| row.unwrap_or_else(|bad| bad.line));
            [next(), next(), next()]
        };
        assert_eq!(lines(b"a\n\"\xff"), [Some(2), None, None], "with an unterminated quotation mark");
        assert_eq!(lines(b"a\n\"x\n\n\xff\n\"\n1\n"), [Some(2), Some(6), None], "over several lines");
    }
}
