//! Rig-level data: a row is an experiment, or one bin of it.
//!
//! Columns: `experiment` (text), settings (dotted keys of a case file), observables `NAME@WALL`
//! ([`RigQuantity`]) with `NAME@WALL_err` (standard error) and `NAME@WALL_n` (the count it rests
//! on). Other columns are notes. Rows with the same `experiment` are readings of one run and have
//! the same settings.

use std::collections::BTreeMap;
use std::io::Read;

use super::csv_table::{CsvTable, Layout};
use super::number::{NumberStyle, is_blank};
use super::rig_observable::{OBSERVABLE_NAMES, RigQuantity};
use super::{BadRow, DatasetError};

/// Tables of a case file with which a setting begins.
const SETTING_TABLES: [&str; 8] =
    ["gas", "particles", "walls", "exits", "run", "conversion", "deposit", "model"];

/// One measured number.
#[derive(Debug, Clone, PartialEq)]
pub struct RigReading {
    /// Line in the file.
    pub line: u64,
    /// The column, as in `captured@target`.
    pub column: String,
    /// What was measured.
    pub quantity: RigQuantity,
    /// The wall.
    pub wall: String,
    /// The value [1].
    pub value: f64,
    /// Its stated standard error [1].
    pub error: Option<f64>,
    /// The number of particles or rebounds on which it rests.
    pub count: Option<f64>,
}

/// One run of a rig.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// Its name; that of the row where the file gives none.
    pub name: String,
    /// Line of its first row.
    pub line: u64,
    /// Dotted keys of the case and the cells, where not blank.
    pub settings: Vec<(String, String)>,
    /// What was measured.
    pub readings: Vec<RigReading>,
}

/// The readings of a rig.
#[derive(Debug, Clone, PartialEq)]
pub struct RigMeasurements {
    /// The name of the file.
    pub file: String,
    /// The experiments, in the order of the file.
    pub experiments: Vec<Experiment>,
    /// Names of the settings that the file has.
    pub settings: Vec<String>,
    /// Rows read.
    pub read: usize,
    /// Rows that cannot be used.
    pub rejected: Vec<BadRow>,
    /// What was assumed and what looks like a mistake.
    pub notes: Vec<String>,
}

/// A column of observables.
struct ObservableColumn {
    name: String,
    quantity: RigQuantity,
    wall: String,
    value: usize,
    error: Option<usize>,
    count: Option<usize>,
}

/// The columns that set a number of the case, with their places.
fn settings(headers: &csv::StringRecord) -> Vec<(usize, String)> {
    let is_setting = |name: &str| {
        let (first, rest) = name.split_once('.').unwrap_or((name, ""));
        !rest.is_empty() && SETTING_TABLES.contains(&first) && !name.contains('@')
    };
    let named = headers.iter().enumerate().filter(|(_, name)| is_setting(name));
    named.map(|(place, name)| (place, name.to_owned())).collect()
}

impl RigMeasurements {
    /// Reads rig-level data; `file` names the source in messages.
    ///
    /// # Errors
    /// [`DatasetError`] for a source that cannot be read, has no observable, or names one that is not known.
    pub fn read(file: &str, source: impl Read) -> Result<Self, DatasetError> {
        let mut table = CsvTable::open(file, source, Layout::default(), |_| false, |_| false)?;
        let columns = observables(&table)?;
        let settings = settings(table.headers());
        let experiment = table.column("experiment");
        let mut data = Self {
            file: file.to_owned(),
            experiments: Vec::new(),
            settings: settings.iter().map(|(_, name)| name.clone()).collect(),
            read: 0,
            rejected: Vec::new(),
            notes: notes(&table, &columns, &data_columns(&settings, experiment)),
        };
        let mut cells = csv::StringRecord::new();
        let mut odd: Vec<BadRow> = Vec::new();
        while let Some(next) = table.next_into(&mut cells)? {
            data.read += 1;
            let row = next.and_then(|line| {
                let cell = |place: usize| table.style().with_point(cells.get(place).unwrap_or(""));
                let own = settings.iter().map(|(place, name)| (name.clone(), cell(*place)));
                let own: Vec<(String, String)> = own.filter(|(_, cell)| !cell.is_empty()).collect();
                let name = experiment.map(cell).filter(|name| !name.is_empty());
                let (readings, own_odd) = readings(&cells, &columns, table.style(), line)?;
                odd.extend(own_odd);
                data.add(line, name, own, readings)
            });
            if let Err(bad) = row {
                data.rejected.push(bad);
            }
        }
        data.notes.splice(0..0, table.notes());
        data.notes.extend(odd_note(&odd));
        if data.read == 0 {
            let reason = "has a header and no rows".to_owned();
            return Err(DatasetError::Unreadable { file: file.to_owned(), reason });
        }
        Ok(data)
    }

    /// Adds a row to its experiment.
    fn add(
        &mut self,
        line: u64,
        name: Option<String>,
        settings: Vec<(String, String)>,
        readings: Vec<RigReading>,
    ) -> Result<(), BadRow> {
        let same = name.as_ref().and_then(|name| self.experiments.iter_mut().find(|one| one.name == *name));
        let Some(earlier) = same else {
            let name = name.unwrap_or_else(|| format!("line {line}"));
            self.experiments.push(Experiment { name, line, settings, readings });
            return Ok(());
        };
        if earlier.settings != settings {
            let reason = format!(
                "experiment `{}` has other settings on line {}; give it another name",
                earlier.name, earlier.line
            );
            return Err(BadRow { line, reason });
        }
        earlier.readings.extend(readings);
        Ok(())
    }

    /// Number of readings.
    pub fn count(&self) -> usize {
        self.experiments.iter().map(|experiment| experiment.readings.len()).sum()
    }
}

/// Columns that are read beside the observables.
fn data_columns(settings: &[(usize, String)], experiment: Option<usize>) -> Vec<usize> {
    settings.iter().map(|(place, _)| *place).chain(experiment).collect()
}

fn observables<R: Read>(table: &CsvTable<R>) -> Result<Vec<ObservableColumn>, DatasetError> {
    let mut columns = Vec::new();
    for (value, name) in table.headers().iter().enumerate() {
        let Some((quantity, wall)) = name.split_once('@') else { continue };
        let base = ["_err", "_n"].iter().find_map(|ending| name.strip_suffix(ending));
        if base.is_some_and(|base| table.column(base).is_some()) {
            continue;
        }
        let Some(quantity) = RigQuantity::parse(quantity) else {
            return Err(table
                .header_fault(format!("`{name}`: the observables are {OBSERVABLE_NAMES}, each with @WALL")));
        };
        columns.push(ObservableColumn {
            name: name.to_owned(),
            quantity,
            wall: wall.to_owned(),
            value,
            error: table.column(&format!("{name}_err")),
            count: table.column(&format!("{name}_n")),
        });
    }
    if columns.is_empty() {
        let fault =
            format!("no column is an observable of a rig, as captured@WALL: they are {OBSERVABLE_NAMES}");
        return Err(table.column_fault(&fault, false));
    }
    Ok(columns)
}

/// What the file has that is not read.
fn notes<R: Read>(table: &CsvTable<R>, columns: &[ObservableColumn], read: &[usize]) -> Vec<String> {
    let mut known: Vec<usize> = read.to_vec();
    known.extend(columns.iter().flat_map(|c| [Some(c.value), c.error, c.count]).flatten());
    let others: Vec<&str> =
        table.headers().iter().enumerate().filter(|(p, _)| !known.contains(p)).map(|(_, n)| n).collect();
    if others.is_empty() {
        return Vec::new();
    }
    vec![format!(
        "Columns taken as notes: {}. A setting is a dotted key of the case file, as gas.temperature.",
        others.join(", ")
    )]
}

/// What is said of single readings that no reading can be.
fn odd_note(odd: &[BadRow]) -> Option<String> {
    let BadRow { line, reason } = odd.first()?;
    let of = match odd.len() {
        1 => "One reading is left out".to_owned(),
        count => format!("{count} readings are left out, the first"),
    };
    Some(format!("{of} on line {line}: {reason}. The others of the row are read."))
}

/// The readings of a row, and those that are none.
///
/// # Errors
/// Why the row has no reading.
fn readings(
    cells: &csv::StringRecord,
    columns: &[ObservableColumn],
    style: NumberStyle,
    line: u64,
) -> Result<(Vec<RigReading>, Vec<BadRow>), BadRow> {
    let one = |column: &ObservableColumn| -> Result<Option<RigReading>, BadRow> {
        let number = |place: Option<usize>, what: &str, low: f64, high: f64| {
            let text = place.and_then(|place| cells.get(place)).unwrap_or("");
            if is_blank(text) {
                return Ok(None);
            }
            let value = style.parse(text).filter(|value| (low..=high).contains(value));
            value.map(Some).ok_or_else(|| BadRow {
                line,
                reason: format!("{}{what} = {text}: a number from {low} to {high} is needed", column.name),
            })
        };
        let Some(value) = number(Some(column.value), "", 0.0, column.quantity.largest())? else {
            return Ok(None);
        };
        Ok(Some(RigReading {
            line,
            column: column.name.clone(),
            quantity: column.quantity,
            wall: column.wall.clone(),
            value,
            error: number(column.error, "_err", 1e-9, 10.0)?,
            count: number(column.count, "_n", 1.0, 1e12)?,
        }))
    };
    let (found, odd): (Vec<_>, Vec<_>) = columns.iter().map(one).partition(Result::is_ok);
    let readings: Vec<RigReading> = found.into_iter().flatten().flatten().collect();
    let odd: Vec<BadRow> = odd.into_iter().filter_map(Result::err).collect();
    if readings.is_empty() {
        let none = || BadRow { line, reason: "no observable has a value".to_owned() };
        return Err(odd.into_iter().next().unwrap_or_else(none));
    }
    Ok((readings, odd))
}

/// For each setting the cells that occur, in order.
pub fn settings_of(experiments: &[Experiment]) -> BTreeMap<String, Vec<String>> {
    let mut all: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (key, cell) in experiments.iter().flat_map(|experiment| &experiment.settings) {
        let cells = all.entry(key.clone()).or_default();
        if !cells.contains(cell) {
            cells.push(cell.clone());
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<RigMeasurements, DatasetError> {
        RigMeasurements::read("rig.csv", text.as_bytes())
    }

    #[test]
    fn rows_of_one_experiment_are_joined() {
        let data = read(
            "experiment,gas.temperature,captured@plate,captured@plate_n,mean_e_n@plate,mean_e_n@plate_err,remark\n\
             a,300,0.1,50,,,x\na,300,,,0.4,0.01,y\nb,400,0.5,50,0.3,,z\nb,500,0.5,50,,,z\n",
        )
        .unwrap();
        assert_eq!(data.experiments.len(), 2);
        assert_eq!(data.experiments[0].readings.len(), 2);
        assert_eq!(data.experiments[0].readings[0].count, Some(50.0));
        assert_eq!(data.experiments[0].readings[1].error, Some(0.01));
        assert_eq!(data.rejected.len(), 1);
        assert!(data.rejected[0].reason.contains("other settings on line 4"));
        assert!(data.notes[0].contains("remark"));
    }

    /// An odd cell costs its own reading, and the row only where nothing else is read in it.
    #[test]
    fn an_odd_cell_costs_its_own_reading() {
        let data = read(
            "captured@a,captured@a_n,mean_e_n@a,mean_e_n@a_err\n0.5,50,0.3,0.01\n50,50,0.3,0.01\nn/a,,0.4,x\n\
             0.1,-3,NA,\n",
        )
        .unwrap();
        let readings: Vec<usize> = data.experiments.iter().map(|one| one.readings.len()).collect();
        assert_eq!(readings, [2, 1]);
        assert_eq!(data.rejected.len(), 2);
        assert!(
            data.notes[0]
                .starts_with("One reading is left out on line 3: captured@a = 50: a number from 0 to 1")
        );
    }

    #[test]
    fn wrong_files_say_what_is_wrong() {
        assert!(read("v_n,e_n\n1,0.5\n").unwrap_err().to_string().contains("captured@WALL"));
        assert!(read("captred@a\n1\n").unwrap_err().to_string().contains("captred@a"));
        let percent = read("captured@a\n12\n0.5\n").unwrap();
        assert!(percent.rejected[0].reason.contains("from 0 to 1"));
    }
}
