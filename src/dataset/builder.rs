//! Puts a file of measurements together, row by row.

use std::io::Read;

use super::column::{Cells, Column, Values};
use super::column_map::{Bound, ColumnMap};
use super::impact_velocity::{AngleColumn, Incidence};
use super::inputs::InputColumns;
use super::measurements::{Measurement, Measurements};
use super::notes::{self, Tally};
use super::number::is_blank;
use super::observed::{DETAILS, OBSERVATIONS, ObservedColumns};
use super::table::Table;
use super::{BadRow, DatasetError, WallChoice};
use crate::impact::INPUTS;

/// A file that is being read.
pub(super) struct Builder<'a> {
    map: &'a ColumnMap,
    walls: &'a WallChoice<'a>,
    bound: Bound,
    inputs: InputColumns,
    incidence: Incidence,
    observed: ObservedColumns,
    /// The columns that may be causes, each with its place in a row.
    causes: Vec<(usize, Cells)>,
    rows: Vec<Measurement>,
    rejected: Vec<BadRow>,
    tally: Tally,
}

impl<'a> Builder<'a> {
    /// Finds out what the columns mean.
    ///
    /// # Errors
    /// [`DatasetError`] for a header in which something is missing or stands twice, and for an undecided wall.
    pub(super) fn new<R: Read>(
        table: &Table<R>,
        map: &'a ColumnMap,
        walls: &'a WallChoice<'a>,
    ) -> Result<Self, DatasetError> {
        let headers = table.headers();
        let fault = |problem: String| table.header_fault(problem);
        let bound = map.bind(headers).map_err(fault)?;
        let inputs = InputColumns::new(|name| bound.column(name));
        let angle = bound.column("angle").zip(map.from).map(|(column, from)| AngleColumn { column, from });
        let incidence = Incidence::of(&inputs, bound.column("speed"), angle)
            .map_err(|problem| fault(with_columns(&problem, headers)))?;
        let observed = ObservedColumns::new(&bound, map.words.clone()).ok_or_else(|| {
            let problem = format!("nothing observed: no column {}", OBSERVATIONS.join(", "));
            fault(with_columns(&problem, headers))
        })?;
        walls.check(bound.index("wall").is_some())?;
        let causes = causes(headers, map, &bound);
        let (rows, rejected, tally) = Default::default();
        Ok(Self { map, walls, bound, inputs, incidence, observed, causes, rows, rejected, tally })
    }

    /// Takes the next record: its line, or why it is none.
    pub(super) fn take(&mut self, next: Result<u64, BadRow>, cells: &csv::StringRecord) {
        let next = next.map_err(|bad| with_lines(bad, cells));
        let row = next.and_then(|line| self.read(line, cells).map_err(|reason| BadRow { line, reason }));
        match row {
            Ok(row) => {
                self.rows.push(row);
                for (index, cause) in &mut self.causes {
                    cause.push(cells.get(*index).unwrap_or(""));
                }
            }
            Err(bad) => self.rejected.push(bad),
        }
    }

    fn read(&mut self, line: u64, cells: &csv::StringRecord) -> Result<Measurement, String> {
        self.check_quotes(cells)?;
        let (mut impact, mut stated) = self.inputs.read(cells)?;
        self.incidence.complete(cells, &mut impact, &mut stated)?;
        impact.check().map_err(|error| error.to_string())?;
        let wall = self.bound.index("wall").and_then(|index| cells.get(index)).filter(|cell| !is_blank(cell));
        let wall = self.walls.of(wall).map_err(|error| error.to_string())?;
        let seen = self.observed.read(cells)?;
        let row = Measurement {
            line,
            impact,
            stated,
            wall,
            impacts: seen.impacts,
            rebounds: seen.rebounds,
            e_n: seen.e_n,
            e_t: seen.e_t,
            captured: seen.captured,
        };
        self.tally.count(&row, &seen);
        Ok(row)
    }

    /// A quotation mark that is never closed makes one cell of the rows that follow.
    fn check_quotes(&self, cells: &csv::StringRecord) -> Result<(), String> {
        if !cells.as_slice().contains('\n') {
            return Ok(());
        }
        let separator = char::from(self.map.layout.separator);
        let is_row = |line: &str| line.matches(separator).count() + 1 >= cells.len();
        match cells.iter().any(|cell| cell.lines().skip(1).any(is_row)) {
            true => {
                Err("a cell in quotation marks swallows the rows that follow; is one not closed?".to_owned())
            }
            false => Ok(()),
        }
    }

    /// Everything that was read from `file`.
    ///
    /// # Errors
    /// [`DatasetError::NoRows`].
    pub(super) fn finish(
        self,
        file: &str,
        headers: &csv::StringRecord,
    ) -> Result<Measurements, DatasetError> {
        let read = self.rows.len() + self.rejected.len();
        if read == 0 {
            return Err(DatasetError::NoRows { file: file.to_owned() });
        }
        let given: Vec<&'static str> =
            INPUTS.iter().map(|input| input.name).filter(|name| self.gives(name)).collect();
        let mut notes = self.header_notes(headers, &given);
        notes.extend(self.tally.notes(&given, self.rows.len()));
        let mut columns = Vec::new();
        for (_, cells) in self.causes {
            let (column, spoilt) = cells.finish(|cell| self.map.parse(cell));
            let line = spoilt.as_ref().and_then(|spoilt| self.rows.get(spoilt.row)).map(|row| row.line);
            if let (Some(spoilt), Some(line)) = (spoilt, line) {
                notes.push(format!(
                    "column `{}` is read as words, for `{}` on line {line} is not a number",
                    column.name, spoilt.cell
                ));
            }
            if says_something(&column) {
                columns.push(column);
            }
        }
        let file = file.to_owned();
        Ok(Measurements { file, rows: self.rows, columns, given, read, rejected: self.rejected, notes })
    }

    fn gives(&self, input: &str) -> bool {
        self.inputs.gives(input) || self.incidence.gives(input)
    }

    fn header_notes(&self, headers: &csv::StringRecord, given: &[&str]) -> Vec<String> {
        let mut notes = Vec::new();
        let observable =
            OBSERVATIONS.into_iter().chain(DETAILS).filter(|name| self.bound.index(name).is_none());
        let inputs = INPUTS.iter().map(|input| input.name);
        let absent: Vec<&'static str> =
            inputs.filter(|name| !given.contains(name)).chain(observable).collect();
        let unused = self.causes.iter().filter_map(|(index, _)| headers.get(*index));
        for (column, name) in notes::near_misses(unused.clone(), &absent) {
            notes.push(format!(
                "column `{column}` is only a possible cause; if it is `{name}` in SI units, call it so"
            ));
        }
        for column in unused.filter(|column| ["speed", "angle"].contains(column)) {
            notes.push(format!(
                "column `{column}` is only a possible cause; a column map can make v_n and v_t of it"
            ));
        }
        let missing = |name: &&String| !headers.iter().any(|header| header == name.as_str());
        for name in self.map.ignored.iter().chain(&self.map.labels).filter(missing) {
            notes.push(format!("the column map speaks of a column `{name}`, which is not there"));
        }
        match headers.iter().filter(|header| header.is_empty()).count() {
            0 => {}
            1 => notes.push("a column without a name is not used".to_owned()),
            count => notes.push(format!("{count} columns without a name are not used")),
        }
        notes
    }
}

/// The columns that may be causes: all without another meaning, and the labels `wall` and `series`.
fn causes(headers: &csv::StringRecord, map: &ColumnMap, bound: &Bound) -> Vec<(usize, Cells)> {
    let cause = |(index, header): (usize, &str)| match bound.name_of(index) {
        Some(name @ ("wall" | "series")) => Some((index, Cells::new(name, true))),
        Some(_) => None,
        None if map.ignores(header) => None,
        None => Some((index, Cells::new(header, map.labels.iter().any(|label| label == header)))),
    };
    headers.iter().enumerate().filter_map(cause).collect()
}

/// A `wall` column that names one wall has done its work.
fn says_something(column: &Column) -> bool {
    match &column.values {
        Values::Words { levels, .. } if column.name == "wall" => levels.len() > 1,
        _ => true,
    }
}

/// A record of the wrong length that runs over several lines has most likely swallowed some.
fn with_lines(bad: BadRow, cells: &csv::StringRecord) -> BadRow {
    match cells.as_slice().matches('\n').count() {
        0 => bad,
        more => {
            let reason = format!(
                "{}, and a cell in quotation marks goes on for {more} more lines; is one not closed?",
                bad.reason
            );
            BadRow { reason, ..bad }
        }
    }
}

/// Most characters of column names in a message.
const LONGEST_LIST: usize = 1000;

/// A fault of the header, with what the header has and the remedy.
fn with_columns(problem: &str, headers: &csv::StringRecord) -> String {
    let found = headers.iter().collect::<Vec<_>>().join(", ");
    let separator = found.chars().find(|mark| [';', '\t', '|'].contains(mark)).filter(|_| headers.len() == 1);
    let separator = separator.map_or(String::new(), |mark| {
        let mark = if mark == '\t' { "tab".to_owned() } else { mark.to_string() };
        format!("; cells are separated by commas unless it says separator = \"{mark}\"")
    });
    // A quotation mark that is not closed makes a header of the whole file.
    let found = match found.char_indices().nth(LONGEST_LIST) {
        Some((end, _)) => format!("{} ...", found.get(..end).unwrap_or_default()),
        None => found,
    };
    format!("{problem}; the columns are: {found}. A column map (--columns) says which is which{separator}")
}
