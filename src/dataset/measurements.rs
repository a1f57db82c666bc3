//! Measured impacts from any laboratory's file, with every column that may be a cause.

use std::io::Read;

use super::assembly::Assembly;
use super::column::Column;
use super::column_map::ColumnMap;
use super::observed::Reading;
use super::table::Table;
use super::{BadRow, DatasetError, WallChoice};
use crate::impact::{INPUTS, Impact};

/// Everything read from a file of measured impacts.
#[derive(Debug, Clone)]
pub struct Measurements {
    /// The file's name as the user gave it.
    pub file: String,
    /// The rows that can be used, in the order of the file. All may have been rejected.
    pub rows: Vec<Measurement>,
    /// The columns that are no inputs, in the order of the file.
    pub columns: Vec<Column>,
    /// The inputs that a column gives, or two columns together.
    pub given: Vec<&'static str>,
    /// How many rows were read: those that can be used and those that cannot.
    pub read: usize,
    /// The rows that cannot be used, with the reason.
    pub rejected: Vec<BadRow>,
    /// What was assumed, and what looks like a mistake but is allowed.
    pub notes: Vec<String>,
}

/// One row: one impact, or the average of several.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measurement {
    /// Line in the file, counted from 1.
    pub line: u64,
    /// The impact; inputs that the row does not state have their default.
    pub impact: Impact,
    /// For each of [`INPUTS`] whether the row states it.
    pub stated: [bool; INPUTS.len()],
    /// Index of the model's wall that is hit.
    pub wall: usize,
    /// How many impacts the row stands for, 1 for a single one.
    pub impacts: f64,
    /// How many rebounds `e_n` and `e_t` stand for: the impacts that were not captured, all where that is not known.
    pub rebounds: f64,
    /// Normal restitution [1]; not negative.
    pub e_n: Option<Reading>,
    /// Tangential restitution [1]; negative where the particle comes back along the wall.
    pub e_t: Option<Reading>,
    /// Share of the impacts that was captured [1]; 0 or 1 for a single one.
    pub captured: Option<f64>,
}

impl Measurements {
    /// The data without the rows for which `fault` has a reason; those are listed among the rejected.
    #[must_use]
    pub fn without(&self, fault: impl Fn(&Measurement) -> Option<String>) -> Self {
        let faults: Vec<Option<String>> = self.rows.iter().map(fault).collect();
        let keep: Vec<usize> = (0..self.rows.len()).filter(|&row| faults[row].is_none()).collect();
        let mut rejected = self.rejected.clone();
        let bad =
            |(row, reason): (&Measurement, Option<String>)| Some(BadRow { line: row.line, reason: reason? });
        rejected.extend(self.rows.iter().zip(faults).filter_map(bad));
        rejected.sort_by_key(|bad| bad.line);
        Self {
            rows: keep.iter().map(|&row| self.rows[row]).collect(),
            columns: self.columns.iter().map(|column| column.at(&keep)).collect(),
            rejected,
            ..self.clone()
        }
    }

    /// Reads a file to its end; `file` stands for the source in messages. A row that cannot be used is listed with its
    /// reason, never dropped in silence.
    ///
    /// # Errors
    /// [`DatasetError`] for a source that cannot be read, a header in which something is missing or stands twice, a
    /// file without rows, and rows that do not say which wall they hit.
    pub fn read(
        file: &str,
        source: impl Read,
        map: Option<&ColumnMap>,
        walls: &WallChoice<'_>,
    ) -> Result<Self, DatasetError> {
        let own = ColumnMap::default();
        let map = map.unwrap_or(&own);
        let mut table = Table::open(file, source, map.layout, |name| map.ignores(name))?;
        let mut assembly = Assembly::new(&table, map, walls)?;
        let mut cells = csv::StringRecord::new();
        while let Some(next) = table.next_into(&mut cells)? {
            assembly.take(next, &cells);
        }
        assembly.finish(file, table.headers())
    }
}
