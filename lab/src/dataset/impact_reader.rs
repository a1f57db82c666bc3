//! Reads impacts one at a time.

use std::io::Read;

use super::column_names::names;
use super::csv_table::{CsvTable, Layout};
use super::headings::{self, FoundColumn};
use super::inputs::InputColumns;
use super::notes;
use super::number::{NumberColumn, NumberStyle};
use super::row_error::{HeaderError, RowFault};
use super::{BadRow, DatasetError};
use nearwall::impact::{ExtraInput, INPUTS, Impact};

/// One row of the file.
#[derive(Debug, Clone, Default)]
pub struct ImpactRow {
    /// Line in the file, counted from 1.
    pub line: u64,
    /// Every cell as written, but with decimal points.
    pub cells: csv::StringRecord,
    /// The impact that the cells describe.
    pub impact: Impact,
}

/// Reads impacts from CSV text.
pub struct ImpactReader<R> {
    table: CsvTable<R>,
    inputs: InputColumns,
}

impl<R: Read> ImpactReader<R> {
    /// Reads the header; `file` names the source in messages. Lines that begin with `#` are comments.
    ///
    /// # Errors
    /// [`DatasetError`] for a source that cannot be read, a missing `v_n`, a repeated column or an unknown unit.
    pub fn new(file: &str, source: R) -> Result<Self, DatasetError> {
        let table = CsvTable::open(file, source, Layout::default(), |_| false, |_| false)?;
        let style = NumberStyle { markers: false, ..table.style() };
        let mut columns = Vec::new();
        for (name, dimension) in names().filter(|(name, _)| INPUTS.iter().any(|input| input.name == *name)) {
            let found = headings::find(name, dimension, table.headers(), |_| true);
            let found = found.map_err(|problem| table.header_fault(problem.to_string()))?;
            columns.extend(found.map(|FoundColumn { index, unit }| NumberColumn {
                name,
                index,
                unit,
                style,
            }));
        }
        let inputs = InputColumns::new(|name| columns.iter().find(|column| column.name == name).copied());
        if !inputs.gives("v_n") {
            return Err(table.column_fault(&HeaderError::NoNormalSpeed.to_string(), false));
        }
        Ok(Self { table, inputs })
    }

    /// The same with the inputs that a model declares.
    #[must_use]
    pub fn with_extra_inputs(self, inputs: &[ExtraInput]) -> Self {
        let Self { table, inputs: known } = self;
        let style = NumberStyle { markers: false, ..table.style() };
        let inputs = known.with_extra(inputs, style, |name| headings::find_further(name, table.headers()));
        Self { table, inputs }
    }

    /// How the file is read where that is not nearwall's own format.
    pub fn notes(&self) -> Vec<String> {
        let columns = self.inputs.columns().map(|column| (column.name, column.index, column.unit));
        let further = headings::further_notes(self.headers(), |index| self.inputs.is_extra(index));
        [self.table.notes(), headings::notes(columns, self.headers()), further].concat()
    }

    /// The column names.
    pub fn headers(&self) -> &csv::StringRecord {
        self.table.headers()
    }

    /// The column of this name.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.table.column(name)
    }

    /// The inputs without a column.
    pub fn absent(&self) -> Vec<&'static str> {
        INPUTS.iter().map(|input| input.name).filter(|name| !self.inputs.gives(name)).collect()
    }

    /// The inputs that the model declares without a column.
    pub fn absent_extra(&self) -> impl Iterator<Item = &ExtraInput> {
        self.inputs.extra().filter(|(_, given)| !given).map(|(input, _)| input)
    }

    /// Unused columns whose name resembles an absent input, each with that input's name.
    pub fn near_misses(&self) -> Vec<(&str, &'static str)> {
        let unused = self.headers().iter().enumerate().filter(|(index, _)| !self.inputs.is_extra(*index));
        notes::near_misses(unused.map(|(_, name)| name), &self.absent())
    }

    /// The next row, or `None` at the end.
    ///
    /// # Errors
    /// [`DatasetError`] when the source fails, and for a length that must be in another unit.
    pub fn next_row(&mut self) -> Result<Option<Result<ImpactRow, BadRow>>, DatasetError> {
        let mut row = ImpactRow::default();
        Ok(self.next_into(&mut row)?.map(|read| read.map(|()| row)))
    }

    /// As [`Self::next_row`], into a row whose memory is used again. A bad row leaves it in any state.
    ///
    /// # Errors
    /// As [`Self::next_row`].
    pub fn next_into(&mut self, row: &mut ImpactRow) -> Result<Option<Result<(), BadRow>>, DatasetError> {
        let line = match self.table.next_into(&mut row.cells)? {
            None => return Ok(None),
            Some(Err(bad)) => return Ok(Some(Err(bad))),
            Some(Ok(line)) => line,
        };
        match self.read_row(line, row) {
            Err(error) if error.is_of_file() => Err(self.table.fault(line, error.to_string())),
            read => Ok(Some(read.map_err(|error| BadRow { line, reason: error.to_string() }))),
        }
    }

    fn read_row(&self, line: u64, row: &mut ImpactRow) -> Result<(), RowFault> {
        row.line = line;
        self.inputs.read(&row.cells, &mut row.impact)?;
        if self.table.style().decimal_comma {
            row.cells = row.cells.iter().map(|cell| self.table.style().with_point(cell)).collect();
        }
        Ok(row.impact.check()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Vec<ImpactRow>, Vec<BadRow>) {
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
        let reasons: Vec<String> = bad.iter().map(|b| format!("{}: {}", b.line, b.reason)).collect();
        assert_eq!(
            reasons,
            [
                "4: v_n `fast` is not a number",
                "5: d = -2: must be positive and finite",
                "6: the row has 1 cells, the header 2",
                "7: v_n is blank",
                "8: v_n = NaN: must be finite and not negative",
            ]
        );
    }

    #[test]
    fn columns_that_resemble_inputs_are_named() {
        let reader = ImpactReader::new("t.csv", "v_n,Tp,v_t (of the bed),operator\n".as_bytes()).unwrap();
        assert_eq!(reader.near_misses(), [("Tp", "T_p"), ("v_t (of the bed)", "v_t")]);
    }

    #[test]
    fn standard_errors_resemble_no_input() {
        let reader = ImpactReader::new("t.csv", "v_n,v_n_err,T_p_err,d_err\n".as_bytes()).unwrap();
        assert!(reader.near_misses().is_empty(), "{:?}", reader.near_misses());
    }

    #[test]
    fn header_faults_are_named() {
        let message = ImpactReader::new("t.csv", "speed,d\n".as_bytes()).err().unwrap().to_string();
        assert!(message.contains("no column `v_n`") && message.contains("speed, d"), "{message}");
        assert!(ImpactReader::new("t.csv", "v_n,d,d\n".as_bytes()).is_err());
    }
}
