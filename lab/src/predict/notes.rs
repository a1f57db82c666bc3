//! Notes about the predicted rows of a file: assumptions, likely mistakes and numbers of rows.

use std::io::Read;

use super::{PredictedRow, Predictor};
use crate::dataset::{BadRow, ImpactReader, ImpactRow, assumed, unlikely};
use crate::range::RangeCounts;
use nearwall::Model;
use nearwall::impact::ExtraInput;

/// Notes about the columns of a file: unused ones that resemble an input, and the assumed values of absent inputs.
pub fn file_notes(file: &str, reader: &ImpactReader<impl Read>) -> Vec<String> {
    let near_miss = |(column, input): (&str, &str)| {
        format!("{file}: column `{column}` is not used; rename it if it is the input `{input}` in SI units")
    };
    let mut notes: Vec<String> = reader.notes().iter().map(|note| format!("{file}: {note}")).collect();
    notes.extend(reader.near_misses().into_iter().map(near_miss));
    let own = reader.absent_extra().filter_map(ExtraInput::describe_default);
    let assumed: Vec<String> = assumed(&reader.absent()).into_iter().chain(own).collect();
    if !assumed.is_empty() {
        notes.push(format!("not in {file}, assumed: {}", assumed.join(", ")));
    }
    notes
}

/// Numbers of rows, and the first warning of each kind.
#[derive(Debug, Clone, Default)]
pub struct RowNotes {
    predicted: u64,
    left_out: u64,
    ranges: RangeCounts,
    /// About an input that is probably in another unit.
    unit: Option<String>,
    /// About a word that the model file does not list.
    label: Option<String>,
}

impl RowNotes {
    /// Predicts the next row of a file and counts it.
    ///
    /// # Errors
    /// Why the row cannot be read or predicted.
    pub fn predict<'r>(
        &mut self,
        predictor: &Predictor<'_>,
        next: Result<&'r ImpactRow, &BadRow>,
    ) -> Result<(&'r ImpactRow, PredictedRow), BadRow> {
        let predicted = next.map_err(Clone::clone).and_then(|row| {
            self.warn(predictor.model(), row);
            Ok((row, predictor.row(row)?))
        });
        match &predicted {
            Ok((_, row)) => {
                self.predicted += 1;
                self.ranges.add(&row.beyond);
            }
            Err(_) => self.left_out += 1,
        }
        predicted
    }

    fn warn(&mut self, model: &Model, row: &ImpactRow) {
        if self.unit.is_none() {
            self.unit = unlikely(row.line, &row.impact);
        }
        if self.label.is_none() {
            self.label = unknown_label(model, row);
        }
    }

    /// Adds the notes about later rows.
    pub fn add(&mut self, later: Self) {
        self.predicted += later.predicted;
        self.left_out += later.left_out;
        self.ranges.merge(later.ranges);
        self.unit = self.unit.take().or(later.unit);
        self.label = self.label.take().or(later.label);
    }

    /// Number of predicted rows.
    pub fn predicted(&self) -> u64 {
        self.predicted
    }

    /// Number of rows that cannot be used.
    pub fn left_out(&self) -> u64 {
        self.left_out
    }

    /// The first warning of each kind.
    pub fn warnings(&self) -> impl Iterator<Item = &str> {
        self.unit.iter().chain(&self.label).map(String::as_str)
    }

    /// How many rows lie outside a stated range, and a line for each range; empty if there are none.
    pub fn outside_range(&self) -> Vec<String> {
        self.ranges.lines("rows")
    }
}

/// A warning if a row has a word that the model file does not list.
fn unknown_label(model: &Model, row: &ImpactRow) -> Option<String> {
    let mut extra = model.extra_inputs().iter().zip(row.impact.extra.iter());
    let (input, _) = extra.find(|(input, value)| input.is_unknown(**value))?;
    let (line, name, known) = (row.line, &input.name, input.labels.join(", "));
    Some(format!("line {line}: {name} is none of {known}; such rows are predicted without it"))
}
