//! Reads a file of measurements, row by row.

use std::io::Read;

use super::column::{Cells, PARCEL_COLUMNS, Values};
use super::column_map::{ColumnMap, ONLY_MAPPED};
use super::csv_table::CsvTable;
use super::impact_velocity::{AngleColumn, ImpactVelocity};
use super::input_errors::InputErrorColumns;
use super::inputs::InputColumns;
use super::measurements::{Measurement, Measurements};
use super::notes::{self, NoteCounts};
use super::number::{NamedColumns, NumberStyle, is_blank};
use super::observed::{DETAILS, OBSERVATIONS, ObservedCells};
use super::{BadRow, DatasetError, WallChoice};
use crate::impact::INPUTS;

/// The state of a file while it is read.
struct Builder<'a> {
    map: &'a ColumnMap,
    walls: &'a WallChoice<'a>,
    named: NamedColumns,
    inputs: InputColumns,
    velocity: ImpactVelocity,
    errors: InputErrorColumns,
    /// The possible causes, each with its index in a row.
    causes: Vec<(usize, Cells)>,
    rows: Vec<Measurement>,
    rejected: Vec<BadRow>,
    counts: NoteCounts,
}

impl<'a> Builder<'a> {
    /// Assigns the columns.
    ///
    /// # Errors
    /// [`DatasetError`] for a header with a missing or repeated column, and for an undetermined wall.
    fn new<R: Read>(
        table: &CsvTable<R>,
        map: &'a ColumnMap,
        walls: &'a WallChoice<'a>,
    ) -> Result<Self, DatasetError> {
        let headers = table.headers();
        let named = map.name_columns(headers).map_err(|problem| table.header_fault(problem))?;
        let inputs = InputColumns::new(|name| named.column(name));
        let style = NumberStyle { markers: true, ..map.style };
        let unnamed = |name: &str| {
            let own = |(index, header): &(usize, &str)| *header == name && named.name_of(*index).is_none();
            headers.iter().enumerate().find(own).map(|(index, _)| index).filter(|_| !map.ignores(name))
        };
        let inputs = inputs.with_extra(walls.model().extra_inputs(), style, |name| {
            named.index(name).or_else(|| unnamed(name))
        });
        let angle = named.column("angle").zip(map.from).map(|(column, from)| AngleColumn { column, from });
        let velocity = ImpactVelocity::of(&inputs, named.column("speed"), angle)
            .map_err(|problem| table.column_fault(&problem, true))?;
        if OBSERVATIONS.iter().all(|name| named.index(name).is_none()) {
            let problem = format!("the file has no observation; add a column {}", OBSERVATIONS.join(", "));
            return Err(table.column_fault(&problem, true));
        }
        walls.check(named.index("wall").is_some())?;
        let mut causes = causes(headers, map, &named);
        // A column of groups tells rows apart also where the model has an input of its name.
        let groups = |index: usize| headers.get(index).is_some_and(|header| map.reads_labels(header));
        let is_series = |index: usize| named.name_of(index) == Some("series");
        causes.retain(|(index, _)| !inputs.is_extra(*index) || is_series(*index) || groups(*index));
        let errors = InputErrorColumns::new(&named);
        let (rows, rejected, counts) = Default::default();
        Ok(Self { map, walls, named, inputs, velocity, errors, causes, rows, rejected, counts })
    }

    /// Adds the next record: its line, or why it cannot be used.
    fn take(&mut self, next: Result<u64, BadRow>, cells: &csv::StringRecord) {
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
        self.velocity.complete(cells, &mut impact, &mut stated)?;
        impact.check().map_err(|error| error.to_string())?;
        let input_errors = self.errors.read(cells, &impact, &self.velocity)?;
        let wall = self.named.index("wall").and_then(|index| cells.get(index)).filter(|cell| !is_blank(cell));
        let wall = self.walls.of(wall).map_err(|error| error.to_string())?;
        let (e_n, e_t, captured) = (None, None, None);
        let (impacts, rebounds) = (1.0, 1.0);
        let mut row =
            Measurement { line, impact, input_errors, stated, wall, impacts, rebounds, e_n, e_t, captured };
        let observed = ObservedCells { columns: &self.named, words: &self.map.words, cells };
        let remarks = observed.read_into(&mut row)?;
        self.counts.count(&row, remarks, self.map.detection);
        Ok(row)
    }

    /// Refuses a quoted cell that contains whole rows: its quotation mark is not closed.
    fn check_quotes(&self, cells: &csv::StringRecord) -> Result<(), String> {
        if !cells.as_slice().contains('\n') {
            return Ok(());
        }
        let separator = char::from(self.map.layout.separator);
        let is_row = |line: &str| line.matches(separator).count() + 1 >= cells.len();
        match cells.iter().any(|cell| cell.lines().skip(1).any(is_row)) {
            true => Err("unterminated quotation mark: a quoted cell contains the following rows".to_owned()),
            false => Ok(()),
        }
    }

    /// The measurements of `file`.
    ///
    /// # Errors
    /// [`DatasetError::Unreadable`] without rows.
    fn finish(self, file: &str, headers: &csv::StringRecord) -> Result<Measurements, DatasetError> {
        let read = self.rows.len() + self.rejected.len();
        if read == 0 {
            let reason = "there is no row under the header; write one row per impact".to_owned();
            return Err(DatasetError::Unreadable { file: file.to_owned(), reason });
        }
        let gives = |name: &&'static str| self.inputs.gives(name) || self.velocity.gives(name);
        let given: Vec<&'static str> = INPUTS.iter().map(|input| input.name).filter(gives).collect();
        let mut notes = self.header_notes(headers, &given);
        notes.extend(self.counts.notes(&given, self.rows.len()));
        notes.extend(self.extra_notes());
        let extra = self.inputs.extra().enumerate().filter(|(_, (_, given))| *given);
        let given_extra: Vec<usize> = extra.map(|(place, _)| place).collect();
        let mut columns = Vec::new();
        for (_, cells) in self.causes {
            let (column, invalid) = cells.finish(|cell| self.map.parse(cell));
            if let Some((row, cell)) = invalid {
                let (name, line) = (&column.name, self.rows[row].line);
                notes.push(format!(
                    "column `{name}` is read as text because `{cell}` on line {line} is not a number"
                ));
            }
            // A `wall` column with a single wall does not vary in meaning.
            let one_wall = column.name == "wall"
                && matches!(&column.values, Values::Labels { levels, .. } if levels.len() < 2);
            if !one_wall {
                columns.push(column);
            }
        }
        let (file, detection) = (file.to_owned(), self.map.detection);
        let (rows, rejected) = (self.rows, self.rejected);
        Ok(Measurements { file, rows, columns, given, given_extra, detection, read, rejected, notes })
    }

    /// The assumed values of the inputs that the model declares.
    fn extra_notes(&self) -> Vec<String> {
        let absent: Vec<String> = self
            .inputs
            .extra()
            .filter_map(|(i, given)| if given { None } else { i.describe_default() })
            .collect();
        let mut notes = Vec::new();
        if !absent.is_empty() {
            notes.push(format!("not in the file, assumed: {}", absent.join(", ")));
        }
        for (place, (input, _)) in self.inputs.extra().enumerate().filter(|(_, (_, given))| *given) {
            let count = |test: &dyn Fn(f64) -> bool| {
                self.rows.iter().filter(|row| test(row.impact.extra[place])).count()
            };
            let (blank, unknown) = (count(&f64::is_nan), count(&|value| input.is_unknown(value)));
            let (name, rows) = (&input.name, self.rows.len());
            if blank > 0 {
                let taken =
                    if input.default.is_nan() { "without a correction" } else { "taken as the default" };
                notes.push(format!("{name} is blank in {blank} of {rows} rows, {taken}"));
            }
            if unknown > 0 {
                notes.push(format!(
                    "{name} is no label of the model in {unknown} of {rows} rows, without a correction"
                ));
            }
        }
        notes
    }

    fn header_notes(&self, headers: &csv::StringRecord, given: &[&str]) -> Vec<String> {
        let mut notes = Vec::new();
        let observable =
            OBSERVATIONS.into_iter().chain(DETAILS).filter(|name| self.named.index(name).is_none());
        let inputs = INPUTS.iter().map(|input| input.name);
        let absent: Vec<&'static str> =
            inputs.filter(|name| !given.contains(name)).chain(observable).collect();
        let unused = self.causes.iter().filter_map(|(index, _)| headers.get(*index));
        for (column, name) in notes::near_misses(unused.clone(), &absent) {
            notes.push(format!(
                "column `{column}` is only a possible cause; rename it if it is the input `{name}` in SI units"
            ));
        }
        for column in unused.filter(|column| ONLY_MAPPED.contains(column)) {
            notes.push(format!(
                "column `{column}` is only a possible cause; a column map can convert it to v_n and v_t"
            ));
        }
        let missing = |name: &&String| !headers.iter().any(|header| header == name.as_str());
        for name in self.map.ignored.iter().chain(&self.map.labels).filter(missing) {
            notes.push(format!("the column map names a column `{name}`, which does not exist"));
        }
        if is_record(headers) {
            let columns = PARCEL_COLUMNS.join(", ");
            notes.push(format!("the columns {columns} identify parcels; they are no possible causes"));
        }
        match headers.iter().filter(|header| header.is_empty()).count() {
            0 => {}
            1 => notes.push("a column without a name is not used".to_owned()),
            count => notes.push(format!("{count} columns without a name are not used")),
        }
        notes
    }
}

impl Measurements {
    /// Reads a whole file; `file` names the source in messages. A row that cannot be used is listed with its reason.
    ///
    /// # Errors
    /// [`DatasetError`] for a source that cannot be read, a header with a missing or repeated column, a file without
    /// rows, and an undetermined wall.
    pub fn read(
        file: &str,
        source: impl Read,
        map: Option<&ColumnMap>,
        walls: &WallChoice<'_>,
    ) -> Result<Self, DatasetError> {
        let own = ColumnMap::default();
        let map = map.unwrap_or(&own);
        let mut table = CsvTable::open(file, source, map.layout, |name| map.ignores(name))?;
        let mut builder = Builder::new(&table, map, walls)?;
        let mut cells = csv::StringRecord::new();
        while let Some(next) = table.next_into(&mut cells)? {
            builder.take(next, &cells);
        }
        builder.finish(file, table.headers())
    }
}

/// The possible causes: all columns without another meaning, and the labels `wall` and `series`. The numbers of a column
/// that tells groups apart are labels too.
fn causes(headers: &csv::StringRecord, map: &ColumnMap, named: &NamedColumns) -> Vec<(usize, Cells)> {
    let of_parcels = |header: &str| PARCEL_COLUMNS.contains(&header) && is_record(headers);
    let cause = |(index, header): (usize, &str)| match named.name_of(index) {
        Some(name @ ("wall" | "series")) => Some((index, Cells::new(name, true))),
        Some(_) => None,
        None if map.ignores(header) => None,
        None if of_parcels(header) && !map.reads_labels(header) => None,
        None => Some((index, Cells::new(header, map.reads_labels(header)))),
    };
    headers.iter().enumerate().filter_map(cause).collect()
}

/// Whether the file is a record of OpenFOAM's parcels.
fn is_record(headers: &csv::StringRecord) -> bool {
    PARCEL_COLUMNS.iter().all(|column| headers.iter().any(|header| header == *column))
}

/// Explains a record of the wrong length over several lines.
fn with_lines(bad: BadRow, cells: &csv::StringRecord) -> BadRow {
    match cells.as_slice().matches('\n').count() {
        0 => bad,
        more => {
            let cause =
                format!("a quoted cell continues for {more} more lines: unterminated quotation mark?");
            BadRow { reason: format!("{}; {cause}", bad.reason), ..bad }
        }
    }
}
