//! Reads a file of any size in bounded memory. Rows that are not selected still count in the errors of the base model.

use std::io::Read;

use super::data_split::{COARSE_DRAWS, DataSplit};
use super::evaluation::Evaluation;
use super::{fault, gain};
use crate::dataset::{ColumnMap, DatasetError, Measurement, Measurements, Unselected, WallChoice};
use crate::model::Model;

/// Rows that are evaluated together.
const BLOCK: usize = 25_000;

/// Reads measured impacts in bounded memory: of a file with more than [`crate::dataset::MOST_ROWS`] usable rows a selection,
/// and the sums of the others that [`super::diagnose`] needs. `base` is the model of `walls`.
///
/// # Errors
/// As [`Measurements::read`].
pub fn read_measurements(
    file: &str,
    source: impl Read,
    map: Option<&ColumnMap>,
    walls: &WallChoice<'_>,
    base: &Model,
) -> Result<Measurements, DatasetError> {
    let mut sums =
        UnselectedSums { base, block: Vec::new(), sums: Unselected::default(), stated_errors: false };
    let mut data = Measurements::read_selected(file, source, map, walls, &mut |row| sums.add(row))?;
    sums.evaluate();
    if sums.stated_errors {
        // The errors of the selected rows are those at the expected inputs, which depend on all rows.
        sums.sums.misfits = Default::default();
        data.notes.push("the errors of the base model are those of the selected rows".to_owned());
    }
    data.unselected = sums.sums;
    Ok(data)
}

struct UnselectedSums<'a> {
    base: &'a Model,
    block: Vec<Measurement>,
    sums: Unselected,
    /// Whether a row states errors of its inputs.
    stated_errors: bool,
}

impl UnselectedSums<'_> {
    fn add(&mut self, row: Measurement) {
        if fault(self.base, &row).is_some() {
            return;
        }
        self.sums.rows += 1;
        self.stated_errors |= row.input_errors.each().next().is_some();
        self.block.push(row);
        if self.block.len() == BLOCK {
            self.evaluate();
        }
    }

    /// Adds the errors of the block.
    fn evaluate(&mut self) {
        let split = DataSplit::bare(self.base, &self.block, COARSE_DRAWS);
        let rows = Evaluation::new(&split, self.base, split.all(), split.noise.to_vec(), [0.0; 2]);
        for (sum, more) in self.sums.misfits.iter_mut().zip(gain::misfits(&rows)) {
            *sum = (sum.0 + more.0, sum.1 + more.1);
        }
        self.block.clear();
    }
}
