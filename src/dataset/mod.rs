//! Measured or planned impacts in a CSV file: one row an impact, columns by name, SI units.
//!
//! The columns named in [`crate::impact::INPUTS`] are the inputs; only `v_n` has to be there, a blank or absent one
//! takes the value of [`Impact::default`]. All other columns are kept as they are. Rows are read one at a time, so a
//! file may be larger than memory. A row that cannot be used is returned as a [`BadRow`] with its line and the reason.

use std::io::Read;

use crate::impact::{INPUTS, Impact};
use crate::input::alike;

/// Why a file cannot be read as impacts at all.
#[derive(Debug, thiserror::Error)]
pub enum DatasetError {
    /// The file cannot be opened or read.
    #[error("{file}: {reason}")]
    Unreadable {
        /// The file's name as the user gave it.
        file: String,
        /// What the operating system or the CSV reader said.
        reason: String,
    },
    /// The header is at fault.
    #[error("{file}:1: {problem}")]
    Header {
        /// The file's name as the user gave it.
        file: String,
        /// What is wrong and the remedy.
        problem: String,
    },
}

/// A row that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BadRow {
    /// Line in the file, counted from 1.
    pub line: u64,
    /// What is wrong with it.
    pub reason: String,
}

/// One row of the file.
#[derive(Debug, Clone)]
pub struct Row {
    /// Line in the file, counted from 1.
    pub line: u64,
    /// Every cell as it stands.
    pub cells: csv::StringRecord,
    /// The impact that the cells describe.
    pub impact: Impact,
}

/// Reads impacts from CSV text.
pub struct ImpactReader<R> {
    reader: csv::Reader<R>,
    file: String,
    headers: csv::StringRecord,
    /// For each of [`INPUTS`] the column it is in.
    columns: [Option<usize>; INPUTS.len()],
}

impl<R: Read> ImpactReader<R> {
    /// Reads the header; `file` stands for the source in messages. Lines that begin with `#` are comments.
    ///
    /// # Errors
    /// [`DatasetError`] for a source that cannot be read, a missing `v_n` or a column that stands there twice.
    pub fn new(file: &str, source: R) -> Result<Self, DatasetError> {
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .comment(Some(b'#'))
            .flexible(true)
            .from_reader(source);
        let unreadable =
            |error: csv::Error| DatasetError::Unreadable { file: file.to_owned(), reason: error.to_string() };
        let headers: csv::StringRecord =
            reader.headers().map_err(unreadable)?.iter().map(|h| h.trim_start_matches('\u{feff}')).collect();
        let header_fault = |problem: String| DatasetError::Header { file: file.to_owned(), problem };
        for (index, name) in headers.iter().enumerate() {
            if headers.iter().take(index).any(|earlier| earlier == name) {
                return Err(header_fault(format!("column `{name}` stands there twice; rename one")));
            }
        }
        let column = |name: &str| headers.iter().position(|header| header == name);
        if column("v_n").is_none() {
            let found = headers.iter().collect::<Vec<_>>().join(", ");
            let separator = if headers.len() == 1 && found.contains([';', '\t']) {
                " Cells have to be separated by commas."
            } else {
                ""
            };
            let problem = format!(
                "no column `v_n` (speed towards the wall, m/s); the columns are: {found}. \
                 Rename the one that holds it.{separator}"
            );
            return Err(header_fault(problem));
        }
        let columns = std::array::from_fn(|input: usize| column(INPUTS[input].name));
        Ok(Self { reader, file: file.to_owned(), headers, columns })
    }

    /// The column names.
    pub fn headers(&self) -> &csv::StringRecord {
        &self.headers
    }

    /// The column of this name.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.headers.iter().position(|header| header == name)
    }

    /// The inputs that no column gives.
    pub fn absent(&self) -> Vec<&'static str> {
        INPUTS.iter().zip(&self.columns).filter(|(_, c)| c.is_none()).map(|(i, _)| i.name).collect()
    }

    /// Columns that are not used but look like an input that is absent, each with that input's name.
    pub fn near_misses(&self) -> Vec<(&str, &'static str)> {
        let absent = self.absent();
        let bare = |name: &str| name.split(['[', '(']).next().unwrap_or(name).trim().to_owned();
        let meant = |column| absent.iter().copied().find(|input| alike(&bare(column), input));
        self.headers.iter().filter_map(|column| Some((column, meant(column)?))).collect()
    }

    /// The next row, or `None` at the end.
    ///
    /// # Errors
    /// [`DatasetError::Unreadable`] when the source fails.
    pub fn next_row(&mut self) -> Result<Option<Result<Row, BadRow>>, DatasetError> {
        let mut cells = csv::StringRecord::new();
        match self.reader.read_record(&mut cells) {
            Ok(false) => Ok(None),
            Ok(true) => Ok(Some(self.read_row(cells))),
            Err(error) => match error.kind() {
                csv::ErrorKind::Utf8 { pos, .. } => {
                    let line = pos.as_ref().map_or(0, csv::Position::line);
                    Ok(Some(Err(BadRow { line, reason: "not UTF-8".to_owned() })))
                }
                _ => Err(DatasetError::Unreadable { file: self.file.clone(), reason: error.to_string() }),
            },
        }
    }

    fn read_row(&self, cells: csv::StringRecord) -> Result<Row, BadRow> {
        let line = cells.position().map_or(0, csv::Position::line);
        let bad = |reason: String| BadRow { line, reason };
        if cells.len() != self.headers.len() {
            return Err(bad(format!("{} cells under {} columns", cells.len(), self.headers.len())));
        }
        let mut impact = Impact::default();
        for (input, column) in INPUTS.iter().zip(self.columns) {
            let cell = column.and_then(|column| cells.get(column)).unwrap_or("");
            if cell.is_empty() {
                if input.name == "v_n" {
                    return Err(bad("v_n is blank".to_owned()));
                }
                continue;
            }
            let value: f64 =
                cell.parse().map_err(|_| bad(format!("{} `{cell}` is not a number", input.name)))?;
            (input.set)(&mut impact, value);
        }
        impact.check().map_err(|error| bad(error.to_string()))?;
        Ok(Row { line, cells, impact })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Vec<Row>, Vec<BadRow>) {
        let mut reader = ImpactReader::new("t.csv", text.as_bytes()).unwrap();
        let (mut rows, mut bad) = (Vec::new(), Vec::new());
        while let Some(next) = reader.next_row().unwrap() {
            match next {
                Ok(row) => rows.push(row),
                Err(row) => bad.push(row),
            }
        }
        (rows, bad)
    }

    #[test]
    fn blanks_take_defaults_and_other_columns_are_kept() {
        let (rows, bad) = read("\u{feff}operator, v_n ,T_p\nAnn, 2.5 ,\nBob,1,350\n");
        assert!(bad.is_empty());
        assert_eq!(rows[0].impact, Impact { normal_speed: 2.5, ..Impact::default() });
        assert_eq!(rows[1].impact.particle_temperature, 350.0);
        assert_eq!(&rows[1].cells[0], "Bob");
    }

    #[test]
    fn bad_rows_have_line_and_reason() {
        let text = "# a comment\nv_n,d\n1,1e-4\nfast,1e-4\n1,-2\n1\n,1e-4\nnan,1e-4\n";
        let (rows, bad) = read(text);
        assert_eq!(rows.len(), 1);
        let said: Vec<String> = bad.iter().map(|b| format!("{}: {}", b.line, b.reason)).collect();
        assert_eq!(
            said,
            [
                "4: v_n `fast` is not a number",
                "5: d = -2: must be positive and finite",
                "6: 1 cells under 2 columns",
                "7: v_n is blank",
                "8: v_n = NaN: must be finite and not negative",
            ]
        );
    }

    #[test]
    fn columns_that_look_like_inputs_are_named() {
        let reader = ImpactReader::new("t.csv", "v_n,Tp,v_t [m/s],operator\n".as_bytes()).unwrap();
        assert_eq!(reader.near_misses(), [("Tp", "T_p"), ("v_t [m/s]", "v_t")]);
    }

    #[test]
    fn header_faults_are_named() {
        let message = ImpactReader::new("t.csv", "speed,d\n".as_bytes()).err().unwrap().to_string();
        assert!(message.contains("no column `v_n`") && message.contains("speed, d"), "{message}");
        assert!(ImpactReader::new("t.csv", "v_n,d,d\n".as_bytes()).is_err());
    }
}
