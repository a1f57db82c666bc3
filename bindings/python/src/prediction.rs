//! `predict`: what the command `nearwall predict` adds to a table of impacts.

use std::path::{Path, PathBuf};

use nearwall::Model;
use nearwall_lab::dataset::{BadRow, ImpactReader, ImpactRow};
use nearwall_lab::predict::{BANDS, PredictedRow, Predictor, RowNotes, VALUES, file_notes};
use pyo3::prelude::*;

use crate::table::{ForPython, TableCells, TableSource, floats};
use crate::work::{Failure, run};

/// Columns of the file, if it was one; added columns of numbers; regimes; ranges that are left; rows left out, with their lines; notes.
type ForCaller = (
    Option<Vec<ForPython>>,
    Vec<ForPython>,
    Vec<Option<&'static str>>,
    Vec<String>,
    Vec<(u64, String)>,
    Vec<String>,
);

/// The same before it becomes Python's.
struct Predictions {
    /// The rows of a file; none of a frame, which the caller has.
    cells: Option<TableCells>,
    /// Columns of [`VALUES`], then of [`BANDS`] if there are drawn models.
    numbers: Vec<Vec<f64>>,
    regimes: Vec<Option<&'static str>>,
    beyond: Vec<String>,
    left_out: Vec<BadRow>,
    notes: Vec<String>,
}

/// Predicts each row of a table. A row that cannot be used has NaN.
#[pyfunction]
pub fn predict(
    py: Python<'_>,
    model: (String, String),
    data: TableSource,
    wall: Option<String>,
    draws: Option<PathBuf>,
) -> PyResult<ForCaller> {
    let Predictions { cells, numbers, regimes, beyond, left_out, notes } =
        run(py, |tick| predict_rows(&model, &data, wall.as_deref(), draws.as_deref(), tick))?;
    let names = VALUES.iter().chain(&BANDS);
    let columns = names.zip(&numbers).map(|(name, values)| ((*name).to_owned(), floats(py, values)));
    let columns = columns.collect();
    let cells = cells.map(|cells| cells.for_python(py)).transpose()?;
    let left_out = left_out.into_iter().map(|bad| (bad.line, bad.reason)).collect();
    Ok((cells, columns, regimes, beyond, left_out, notes))
}

fn predict_rows(
    (name, text): &(String, String),
    data: &TableSource,
    wall: Option<&str>,
    draws: Option<&Path>,
    tick: &(dyn Fn() + Sync),
) -> Result<Predictions, Failure> {
    let model = Model::from_toml(name, text)?;
    let file = data.name();
    let mut reader = ImpactReader::new(file, data.open()?)?.with_extra_inputs(model.extra_inputs());
    let mut predictor = Predictor::new(&model, wall, &reader)?;
    if let Some(folder) = draws {
        predictor.read_draws(folder)?;
    }
    let header = reader.headers().iter().map(str::to_owned);
    let cells = matches!(data, TableSource::File(_)).then(|| TableCells::new(header));
    let mut found = Predictions::new(cells, predictor.has_bands(), file_notes(file, &reader));
    let mut notes = RowNotes::default();
    let mut row = ImpactRow::default();
    while let Some(next) = reader.next_into(&mut row)? {
        tick();
        match notes.predict(&predictor, next.as_ref().map(|()| &row)) {
            Ok((row, predicted)) => found.add(row, &predicted),
            Err(bad) => found.leave_out(bad),
        }
    }
    found.finish(&notes)?;
    Ok(found)
}

impl Predictions {
    fn new(cells: Option<TableCells>, bands: bool, notes: Vec<String>) -> Self {
        let columns = VALUES.len() + if bands { BANDS.len() } else { 0 };
        Self {
            cells,
            numbers: vec![Vec::new(); columns],
            regimes: Vec::new(),
            beyond: Vec::new(),
            left_out: Vec::new(),
            notes,
        }
    }

    fn add(&mut self, row: &ImpactRow, predicted: &PredictedRow) {
        if let Some(cells) = &mut self.cells {
            cells.push(&row.cells);
        }
        let numbers = predicted.values.iter().chain(predicted.bands.as_flattened());
        self.numbers.iter_mut().zip(numbers).for_each(|(column, number)| column.push(*number));
        self.regimes.push(Some(predicted.regime));
        self.beyond.push(predicted.beyond_text());
    }

    /// The rows of a frame keep their places; those of a file are left out, as by the command.
    fn leave_out(&mut self, bad: BadRow) {
        if self.cells.is_none() {
            self.numbers.iter_mut().for_each(|column| column.push(f64::NAN));
            self.regimes.push(None);
            self.beyond.push(String::new());
        }
        self.left_out.push(bad);
    }

    /// Adds the notes about the rows, of which at least one must be predicted.
    fn finish(&mut self, notes: &RowNotes) -> Result<(), Failure> {
        self.notes.extend(notes.warnings().map(str::to_owned).chain(notes.outside_range()));
        if notes.predicted() == 0 {
            let reason = |bad: &BadRow| format!("; line {}: {}", bad.line, bad.reason);
            let first = self.left_out.first().map(reason).unwrap_or_default();
            return Err(format!("no row could be used{first}").into());
        }
        Ok(())
    }
}
