//! Reads a file of measurements, row by row.

use std::io::Read;

use super::column::{ColumnCells, ColumnValues, DataColumn};
use super::column_map::ColumnMap;
use super::column_names::{CAPTURES, DETAILS, OBSERVATIONS, ONLY_MAPPED, PARCEL_COLUMNS};
use super::csv_table::CsvTable;
use super::headings::{self, FoundColumn};
use super::impact_velocity::{AngleColumn, ImpactVelocity};
use super::input_errors::InputErrorColumns;
use super::inputs::InputColumns;
use super::measurements::{Measurement, Measurements, Unselected};
use super::notes::{self, NoteCounts};
use super::number::{NamedColumns, is_blank};
use super::observed::ObservedCells;
use super::row_error::RowFault;
use super::selection::{RowSelection, Ticket};
use super::unit::Unit;
use super::{BadRow, DatasetError, WallChoice};
use nearwall::impact::{INPUTS, Impact};

/// Largest number of labels in a note.
const SHOWN_LABELS: usize = 5;

/// The state of a file while it is read.
struct Builder<'a> {
    map: &'a ColumnMap,
    separator: u8,
    walls: &'a WallChoice<'a>,
    named: NamedColumns,
    inputs: InputColumns,
    velocity: ImpactVelocity,
    errors: InputErrorColumns,
    /// The possible causes, each with its index in a row.
    causes: Vec<(usize, ColumnCells)>,
    /// Columns that tell groups of rows apart, by index in a row.
    groups: Vec<usize>,
    selection: RowSelection,
    rows: Vec<Measurement>,
    /// Number of records.
    read: usize,
    /// Whether a column may state captures, and the number of rows that do.
    records_captures: bool,
    outcomes: usize,
    /// Number of usable rows, selected or not.
    usable: usize,
    rejected: Vec<BadRow>,
    counts: NoteCounts,
    /// Blank and unknown cells of each input that the model declares.
    extra_counts: Vec<[usize; 2]>,
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
        most: usize,
    ) -> Result<Self, DatasetError> {
        let headers = table.headers();
        let named = map.name_columns(headers).map_err(|problem| table.header_fault(problem.to_string()))?;
        let inputs = InputColumns::new(|name| named.column(name));
        let inputs = inputs.with_extra(walls.model().extra_inputs(), table.style(), |name| {
            extra_column(name, headers, map, &named)
        });
        let angle = named.column("angle").zip(map.from).map(|(column, from)| AngleColumn { column, from });
        let velocity = ImpactVelocity::of(&inputs, named.column("speed"), angle)
            .map_err(|problem| table.column_fault(&problem.to_string(), true))?;
        if OBSERVATIONS.iter().all(|name| named.index(name).is_none()) {
            let problem = format!("the file has no observation; add a column {}", OBSERVATIONS.join(", "));
            return Err(table.column_fault(&problem, true));
        }
        let records_captures = CAPTURES.iter().any(|name| named.index(name).is_some());
        walls.check(named.index("wall").is_some())?;
        let tells_groups = |index: &usize| tells_groups(*index, headers, map, &named);
        let mut causes = causes(headers, map, &named);
        causes.retain(|(index, _)| !inputs.is_extra(*index) || tells_groups(index));
        let errors = InputErrorColumns::new(&named);
        Ok(Self {
            groups: causes.iter().map(|(index, _)| *index).filter(tells_groups).collect(),
            extra_counts: vec![[0; 2]; inputs.extra().count()],
            selection: RowSelection::new(most),
            map,
            separator: table.separator(),
            walls,
            named,
            inputs,
            velocity,
            errors,
            causes,
            rows: Vec::new(),
            read: 0,
            records_captures,
            outcomes: 0,
            usable: 0,
            rejected: Vec::new(),
            counts: NoteCounts::default(),
        })
    }

    /// Adds the next record: its line, or why it cannot be used. Rows that are not kept go to `unselected`.
    ///
    /// # Errors
    /// A row with which the file cannot be used.
    fn take(
        &mut self,
        next: Result<u64, BadRow>,
        cells: &csv::StringRecord,
        unselected: &mut dyn FnMut(Measurement),
    ) -> Result<(), BadRow> {
        self.read += 1;
        let row = match next.map_err(|bad| with_lines(bad, cells)) {
            Ok(line) => match self.read(line, cells) {
                Err(error) if error.is_of_file() => return Err(BadRow { line, reason: error.to_string() }),
                read => read.map_err(|error| BadRow { line, reason: error.to_string() }),
            },
            Err(bad) => Err(bad),
        };
        match row {
            Ok(row) => self.add(row, cells, unselected),
            Err(bad) if self.rejected.len() < self.selection.most() => self.rejected.push(bad),
            Err(_) => {}
        }
        Ok(())
    }

    fn add(&mut self, row: Measurement, cells: &csv::StringRecord, unselected: &mut dyn FnMut(Measurement)) {
        let cell = |index: usize| cells.get(index).unwrap_or("");
        self.usable += 1;
        self.count_extra(&row);
        let groups =
            self.groups.iter().map(|&index| cell(index)).map(|cell| if is_blank(cell) { "" } else { cell });
        let kept = self.selection.keeps(Ticket::new(row.line, groups));
        for (index, cause) in &mut self.causes {
            cause.note(row.line, cell(*index), |cell| self.map.parse(cell));
            if kept { cause.push(cell(*index)) } else { cause.leave_out(cell(*index)) }
        }
        if kept {
            self.rows.push(row);
        } else {
            self.selection.count(&row);
            unselected(row);
        }
        if let Some(kept) = self.selection.shrink() {
            self.retain(&kept, unselected);
        }
    }

    /// Removes the rows that are not kept.
    fn retain(&mut self, kept: &[bool], unselected: &mut dyn FnMut(Measurement)) {
        self.causes.iter_mut().for_each(|(_, cause)| cause.retain(kept));
        let rows = std::mem::take(&mut self.rows);
        for (row, kept) in rows.into_iter().zip(kept) {
            if *kept {
                self.rows.push(row);
            } else {
                self.selection.count(&row);
                unselected(row);
            }
        }
    }

    fn count_extra(&mut self, row: &Measurement) {
        for ((place, (input, _)), [blank, unknown]) in
            self.inputs.extra().enumerate().zip(&mut self.extra_counts)
        {
            let value = row.impact.extra[place];
            *blank += usize::from(value.is_nan());
            *unknown += usize::from(input.is_unknown(value));
        }
    }

    fn read(&mut self, line: u64, cells: &csv::StringRecord) -> Result<Measurement, RowFault> {
        self.check_quotes(cells)?;
        let mut impact = Impact::default();
        let mut stated = self.inputs.read(cells, &mut impact)?;
        self.velocity.complete(cells, &mut impact, &mut stated)?;
        impact.check()?;
        let input_errors = self.errors.read(cells, &impact, &self.velocity)?;
        let wall = self.named.index("wall").and_then(|index| cells.get(index)).filter(|cell| !is_blank(cell));
        let wall = self.walls.of(wall)?;
        let mut row = Measurement { line, impact, input_errors, stated, wall, ..Measurement::default() };
        let observed = ObservedCells { columns: &self.named, words: &self.map.words, cells };
        let remarks = observed.read_into(&mut row)?;
        self.outcomes += usize::from(row.captured.is_some());
        if self.records_captures && row.is_unstated_rebound() {
            row.captured = Some(0.0);
        }
        self.counts.count(&row, remarks, self.map.detection);
        Ok(row)
    }

    /// Refuses a quoted cell that contains whole rows: its quotation mark is not closed.
    fn check_quotes(&self, cells: &csv::StringRecord) -> Result<(), RowFault> {
        if !cells.as_slice().contains('\n') {
            return Ok(());
        }
        let separator = char::from(self.separator);
        let is_row = |line: &str| line.matches(separator).count() + 1 >= cells.len();
        match cells.iter().any(|cell| cell.lines().skip(1).any(is_row)) {
            true => Err(RowFault::OpenQuote),
            false => Ok(()),
        }
    }

    /// The measurements of `file`.
    ///
    /// # Errors
    /// [`DatasetError::Unreadable`] without rows.
    fn finish(mut self, file: &str, headers: &csv::StringRecord) -> Result<Measurements, DatasetError> {
        if self.read == 0 {
            let reason = "there is no row under the header; write one row per impact".to_owned();
            return Err(DatasetError::Unreadable { file: file.to_owned(), reason });
        }
        self.settle_captures();
        let gives = |name: &&'static str| self.inputs.gives(name) || self.velocity.gives(name);
        let given: Vec<&'static str> = INPUTS.iter().map(|input| input.name).filter(gives).collect();
        let mut notes = self.header_notes(headers, &given);
        notes.extend(self.counts.notes(&given, self.usable));
        notes.extend(self.extra_notes());
        notes.extend(self.selection_notes(headers));
        let extra = self.inputs.extra().enumerate().filter(|(_, (_, given))| *given);
        let given_extra: Vec<usize> = extra.map(|(place, _)| place).collect();
        let columns = columns(self.causes, self.map, &mut notes);
        Ok(Measurements {
            file: file.to_owned(),
            rows: self.rows,
            unselected: Unselected { rows: self.selection.others(), ..Unselected::default() },
            columns,
            given,
            given_extra,
            detection: self.map.detection,
            read: self.read,
            rejected: self.rejected,
            notes,
        })
    }

    /// Where captures are recorded at all, a row with `e_n` above 0 is one of the rebounds.
    fn settle_captures(&mut self) {
        if self.outcomes > 0 {
            let unstated = self.rows.iter_mut().filter(|row| row.is_unstated_rebound());
            unstated.for_each(|row| row.captured = Some(0.0));
        } else {
            self.rows.iter_mut().for_each(|row| row.captured = None);
        }
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
            let [blank, unknown] = self.extra_counts[place];
            let (name, rows) = (&input.name, self.usable);
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

    /// What the selection of a large file leaves out.
    fn selection_notes(&self, headers: &csv::StringRecord) -> Vec<String> {
        if self.selection.others() == 0 {
            return Vec::new();
        }
        let name = |index: &usize| headers.get(*index).unwrap_or("").to_owned();
        let groups: Vec<String> = self.groups.iter().map(name).collect();
        let mut notes = self.selection.notes(&self.rows, &groups);
        for (index, cells) in self.causes.iter().filter(|(index, _)| !self.groups.contains(index)) {
            let (lost, more) = cells.lost_labels();
            if !lost.is_empty() {
                let shown = lost.iter().take(SHOWN_LABELS).map(String::as_str).collect::<Vec<_>>().join(", ");
                let (least, name) = (if more { "at least " } else { "" }, name(index));
                notes.push(format!(
                    "column `{name}`: {least}{} labels are rare and in no selected row: {shown}{}",
                    lost.len(),
                    if lost.len() > SHOWN_LABELS { ", ..." } else { "" }
                ));
            }
        }
        notes
    }

    fn header_notes(&self, headers: &csv::StringRecord, given: &[&str]) -> Vec<String> {
        let own =
            self.named.columns.iter().filter(|c| headers.get(c.index).is_some_and(|h| !self.map.maps(h)));
        let mut notes = headings::notes(own.map(|column| (column.name, column.index, column.unit)), headers);
        let is_cause = |index: usize| self.causes.iter().any(|(own, _)| *own == index);
        notes
            .extend(headings::further_notes(headers, |index| is_cause(index) || self.inputs.is_extra(index)));
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
        Self::read_at_most(file, source, map, walls, usize::MAX, &mut |_| {})
    }

    /// As [`Self::read`], with at most so many rows and rejected rows. Of a file with more usable
    /// rows a selection is kept; the others go to `unselected` one by one, not in the order of the
    /// file.
    pub(crate) fn read_at_most(
        file: &str,
        source: impl Read,
        map: Option<&ColumnMap>,
        walls: &WallChoice<'_>,
        most: usize,
        unselected: &mut dyn FnMut(Measurement),
    ) -> Result<Self, DatasetError> {
        let own = ColumnMap::default();
        let map = map.unwrap_or(&own);
        let mut table =
            CsvTable::open(file, source, map.layout, |name| map.ignores(name), |name| map.maps(name))?;
        let map = map.with_style(table.style());
        let mut builder = Builder::new(&table, &map, walls, most)?;
        let mut cells = csv::StringRecord::new();
        while let Some(next) = table.next_into(&mut cells)? {
            builder.take(next, &cells, unselected).map_err(|bad| table.fault(bad.line, bad.reason))?;
        }
        let mut data = builder.finish(file, table.headers())?;
        data.notes.splice(0..0, table.notes());
        Ok(data)
    }
}

/// Whether a column tells rows apart: groups do also where the model has an input of their name.
fn tells_groups(index: usize, headers: &csv::StringRecord, map: &ColumnMap, named: &NamedColumns) -> bool {
    let is_group = headers.get(index).is_some_and(|header| map.reads_labels(header));
    is_group || named.name_of(index) == Some("series")
}

/// The possible causes: all columns without another meaning, and the labels `wall` and `series`.
/// The numbers of a column that tells groups apart are labels too.
fn causes(headers: &csv::StringRecord, map: &ColumnMap, named: &NamedColumns) -> Vec<(usize, ColumnCells)> {
    let of_parcels = |header: &str| PARCEL_COLUMNS.contains(&header) && is_record(headers);
    let cause = |(index, header): (usize, &str)| match named.name_of(index) {
        Some(name @ ("wall" | "series")) => Some((index, ColumnCells::new(name, true))),
        Some(_) => None,
        None if map.ignores(header) => None,
        None if of_parcels(header) && !map.reads_labels(header) => None,
        None if map.reads_labels(header) => Some((index, ColumnCells::new(header, true))),
        None => {
            let cells = ColumnCells::new(header, false).with_unit(headings::further(header, headers));
            Some((index, cells))
        }
    };
    headers.iter().enumerate().filter_map(cause).collect()
}

/// The column of an input that the model declares: of the map, else one of that name which nothing else reads.
fn extra_column(
    name: &str,
    headers: &csv::StringRecord,
    map: &ColumnMap,
    named: &NamedColumns,
) -> Option<FoundColumn> {
    if let Some(index) = named.index(name) {
        return Some(FoundColumn { index, unit: Unit::SI });
    }
    let found = headings::find_further(name, headers)?;
    let is_free = named.name_of(found.index).is_none() && !map.ignores(&headers[found.index]);
    is_free.then_some(found)
}

/// The columns of possible causes with their values. A `wall` column with a single wall does not vary in meaning.
fn columns(causes: Vec<(usize, ColumnCells)>, map: &ColumnMap, notes: &mut Vec<String>) -> Vec<DataColumn> {
    let mut columns = Vec::new();
    for (_, cells) in causes {
        let (column, invalid) = cells.finish(|cell| map.parse(cell));
        if let Some((line, cell)) = invalid {
            let name = &column.name;
            notes.push(format!(
                "column `{name}` is read as text because `{cell}` on line {line} is not a number"
            ));
        }
        let one_wall = column.name == "wall"
            && matches!(&column.values, ColumnValues::Labels { levels, .. } if levels.len() < 2);
        if !one_wall {
            columns.push(column);
        }
    }
    columns
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
