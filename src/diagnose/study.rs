//! Which rows choose causes, which fit the extended model, and which measure its gain.
//!
//! The gain needs rows that neither a choice nor a fit has seen. With many units, three quarters of them choose; only if they name
//! nothing, all do. With fewer units all rows choose the causes, and if three quarters alone name the same, the extended model is
//! fitted to those; its file is then run on the rest. In all other cases the gain is cross-validated: a choice, a fit and a model file
//! for each part of the units without that part.

use rayon::prelude::*;

use super::choice::{Choice, Task};
use super::data_split::{DataSplit, shuffled};
use super::gain::{CROSS_VALIDATED, HeldOut, ModelFile};
use super::hypothesis::Hypothesis;
use crate::dataset::Measurements;
use crate::input::InputError;
use crate::model::Model;

/// With so many units a quarter is held out from the start.
const MANY_UNITS: usize = 200;
/// Shares of the accepted level of the first choice, on three quarters, and of the second, on all units.
const FIRST_SHARE: f64 = 0.7;
const SECOND_SHARE: f64 = 0.5;
/// With fewer units the gain is cross-validated.
const LEAST_UNITS: usize = 40;
/// Parts of the cross-validation with many units, and with few.
const PARTS: usize = 5;
const MANY_PARTS: usize = 10;
/// Largest number of unseen lines that are listed.
const LISTED_LINES: usize = 1000;
/// Largest number of rows on which the gain is measured.
const GAIN_ROWS: usize = 20_000;

/// The rows that measure the gain.
pub(super) struct Measured {
    /// `held-out` or `cross-validated`.
    pub how: &'static str,
    pub rows: HeldOut,
    /// After a cross-validation, all rows under the file that is written, which has seen them.
    pub seen: Option<HeldOut>,
}

/// The choice of causes, and the choice whose fit is written.
pub(super) struct Study {
    /// On all rows; on three quarters of a large file.
    pub choice: Choice,
    /// The same, or the choice on three quarters.
    pub file: Choice,
    /// Rows that the file has not seen; empty for a cross-validation.
    unseen: Vec<usize>,
    seed: u64,
}

impl Study {
    pub fn new(whole: &DataSplit, mut task: Task<'_>, seed: u64) -> Self {
        let (fitted, unseen) = quarter(whole, seed);
        if whole.unit_count >= MANY_UNITS {
            let share = if whole.is_large() { 1.0 } else { FIRST_SHARE };
            let choice = Choice::new(&whole.fitting(&fitted), Task { level: share * task.level, ..task });
            if whole.is_large() || !choice.names().is_empty() {
                return Self { file: choice.clone(), choice, unseen, seed };
            }
            task.level *= SECOND_SHARE;
        }
        let choice = Choice::new(whole, task);
        if !choice.names().is_empty() && (LEAST_UNITS..MANY_UNITS).contains(&whole.unit_count) {
            let file = Choice::new(&whole.fitting(&fitted), task);
            if file.names() == choice.names() {
                return Self { choice, file, unseen, seed };
            }
        }
        Self { file: choice.clone(), choice, unseen: Vec::new(), seed }
    }

    /// The same without causes, because something else explains more.
    pub fn without_causes(self) -> Self {
        let choice = self.choice.without_causes();
        Self { file: choice.clone(), choice, unseen: Vec::new(), ..self }
    }

    /// Lines of the rows that the file has not seen.
    pub fn unseen_lines(&self, data: &Measurements) -> Vec<u64> {
        let mut lines: Vec<u64> = self.unseen.iter().map(|&row| data.rows[row].line).collect();
        lines.sort_unstable();
        lines.dedup();
        lines.truncate(LISTED_LINES);
        lines
    }

    /// The rows that measure the gain, and how; `models` are the base and the extended hypothesis, `text` is the extended model.
    pub fn held_out(
        &self,
        rows: &Measurements,
        whole: &DataSplit,
        task: Task<'_>,
        models: [&Hypothesis<'_>; 2],
        text: &str,
    ) -> Result<Measured, InputError> {
        let mut held_out = HeldOut::default();
        let base = ModelFile { model: &whole.base, scatter: models[0].scatter };
        if !self.unseen.is_empty() {
            let model = Model::from_toml("extended.toml", text)?;
            let extended = ModelFile { model: &model, scatter: models[1].scatter };
            let unseen = &self.unseen[..self.unseen.len().min(GAIN_ROWS)];
            held_out.add(rows, &whole.units, unseen, [&base, &extended]);
            return Ok(Measured { how: "held-out", rows: held_out, seen: None });
        }
        let parts = parts(whole, self.seed);
        let file = |part: &Vec<usize>| {
            let mut inside = vec![false; whole.rows.len()];
            part.iter().for_each(|&row| inside[row] = true);
            let others: Vec<usize> = (0..whole.rows.len()).filter(|&row| !inside[row]).collect();
            let choice = Choice::new(&whole.fitting(&others), task);
            let text = choice.model_text(task).unwrap_or_else(|_| task.text.to_owned());
            Ok((Model::from_toml("extended.toml", &text)?, choice.scatter()))
        };
        let files: Vec<(Model, _)> = parts.par_iter().map(file).collect::<Result<_, InputError>>()?;
        for (part, (model, scatter)) in parts.iter().zip(&files) {
            held_out.add(rows, &whole.units, part, [&base, &ModelFile { model, scatter: *scatter }]);
        }
        let model = Model::from_toml("extended.toml", text)?;
        let mut seen = HeldOut::default();
        let extended = ModelFile { model: &model, scatter: models[1].scatter };
        seen.add(rows, &whole.units, &whole.all(), [&base, &extended]);
        Ok(Measured { how: CROSS_VALIDATED, rows: held_out, seen: Some(seen) })
    }
}

/// The rows of three quarters of the units, and the others.
fn quarter(whole: &DataSplit, seed: u64) -> (Vec<usize>, Vec<usize>) {
    let mut held = vec![false; whole.unit_count];
    let order = shuffled(whole.unit_count, seed);
    order.iter().take(whole.unit_count / 4).for_each(|&unit| held[unit] = true);
    whole.all().into_iter().partition(|&row| !held[whole.units[row]])
}

/// The rows in parts, whole units together.
fn parts(whole: &DataSplit, seed: u64) -> Vec<Vec<usize>> {
    let count = if whole.unit_count < LEAST_UNITS { MANY_PARTS } else { PARTS }.min(whole.unit_count);
    let mut part_of = vec![0; whole.unit_count];
    shuffled(whole.unit_count, seed)
        .iter()
        .enumerate()
        .for_each(|(place, &unit)| part_of[unit] = place % count);
    let mut parts = vec![Vec::new(); count];
    whole.all().into_iter().for_each(|row| parts[part_of[whole.units[row]]].push(row));
    parts
}
