//! Which rows choose causes, which fit the extended model, and which measure its gain.
//!
//! All rows are searched for explanations. If three quarters alone name the same of what was visited,
//! the extended model is fitted to those, and its file is run on the rest. Of a large file three
//! quarters are searched. In all other cases the gain is cross-validated: for each part of the units
//! the other parts choose among the explanations that were visited, fit, and write a model file.
//! Where groups share an error, whole groups are held out: other rows of the same group would tell
//! its error.

use std::sync::Arc;

use rayon::prelude::*;

use super::choice::{CauseChoice, Task};
use super::data_split::{DataSplit, shuffled};
use super::gain::{CROSS_VALIDATED, HELD_OUT, HeldOutRows, ModelFile};
use super::hypothesis::Hypothesis;
use super::likelihood::Scatter;
use super::named_causes::NamedCauses;
use super::observable::Observable;
use super::record::Gain;
use crate::dataset::Measurements;
use nearwall::input::InputError;
use nearwall::model::Model;

/// With fewer units the gain is cross-validated.
const LEAST_UNITS: usize = 40;
/// With fewer unseen rows, too: they tell a root mean square to no better than a tenth.
const LEAST_UNSEEN: usize = 50;
/// With fewer groups their rows are held out one by one: so few groups say nothing of others.
const LEAST_HELD_OUT_GROUPS: usize = 5;
/// Parts of the cross-validation.
const PARTS: usize = 10;
/// Largest number of unseen lines that are listed.
const LISTED_LINES: usize = 1000;
/// Largest number of rows on which the gain is measured.
const GAIN_ROWS: usize = 20_000;

/// The rows that measure the gain.
pub(super) struct MeasuredGain {
    /// [`HELD_OUT`] or [`CROSS_VALIDATED`].
    pub how: &'static str,
    pub rows: HeldOutRows,
    /// After a cross-validation, all rows under the file that is written, which has seen them.
    pub seen: Option<HeldOutRows>,
}

impl MeasuredGain {
    /// The gain in an observable; `noise` is the scatter that no model removes [1].
    pub fn gain(&self, observable: Observable, noise: Option<f64>, seed: u64) -> Option<Gain> {
        self.rows.gain(observable, self.how, noise, seed, self.seen.as_ref())
    }
}

/// The choice of causes, and the choice whose fit is written.
pub(super) struct Study {
    /// On all rows; on three quarters of a large file.
    pub choice: CauseChoice,
    /// What is named, by all its rows or by three quarters.
    pub file: NamedCauses,
    /// Rows that the file has not seen; empty for a cross-validation.
    unseen: Vec<usize>,
    /// What is held out as a whole.
    units: Units,
    seed: u64,
}

impl Study {
    pub fn new(whole: &DataSplit, task: Task<'_>, seed: u64) -> Self {
        let units = Units { of_row: whole.units.clone(), count: whole.unit_count };
        if whole.is_large() {
            let (fitted, unseen) = units.quarter(seed);
            let choice = CauseChoice::new(&whole.fitting(&fitted), task);
            if units.of_groups(&choice).is_none() {
                return Self { file: choice.causes.clone(), choice, unseen, units, seed };
            }
        }
        let choice = CauseChoice::new(whole, task);
        let units = units.of_groups(&choice).unwrap_or(units);
        if !choice.causes.names.is_empty() && units.count >= LEAST_UNITS {
            let (fitted, unseen) = units.quarter(seed);
            let file = (unseen.len() >= LEAST_UNSEEN).then(|| choice.again(&fitted));
            if let Some(file) = file.filter(|file| file.names == choice.causes.names) {
                return Self { choice, file, unseen, units, seed };
            }
        }
        Self { file: choice.causes.clone(), choice, unseen: Vec::new(), units, seed }
    }

    /// The same without causes, because something else explains more.
    pub fn without_causes(self) -> Self {
        let choice = self.choice.without_causes();
        Self { file: choice.causes.clone(), choice, unseen: Vec::new(), ..self }
    }

    /// Lines of the rows that the file has not seen.
    pub fn unseen_lines(&self, data: &Measurements) -> Vec<u64> {
        let mut lines: Vec<u64> = self.unseen.iter().map(|&row| data.rows[row].line).collect();
        lines.sort_unstable();
        lines.dedup();
        lines.truncate(LISTED_LINES);
        lines
    }

    /// The rows that measure the gain, and how; `models` are the base and the extended hypothesis,
    /// `text` is the extended model.
    pub fn held_out(
        &self,
        rows: &Measurements,
        whole: &DataSplit,
        task: Task<'_>,
        models: [&Hypothesis<'_>; 2],
        text: &str,
    ) -> Result<MeasuredGain, InputError> {
        let mut held_out = HeldOutRows::default();
        let base =
            ModelFile { model: &whole.base, scatter: models[0].scatter, tails: models[0].data.tails() };
        if !self.unseen.is_empty() {
            let model = Model::from_toml("extended.toml", text)?;
            let extended =
                ModelFile { model: &model, scatter: models[1].scatter, tails: models[1].data.tails() };
            let unseen = &self.unseen[..self.unseen.len().min(GAIN_ROWS)];
            held_out.add(rows, &self.units.of_row, unseen, [&base, &extended]);
            return Ok(MeasuredGain { how: HELD_OUT, rows: held_out, seen: None });
        }
        let parts = self.units.parts(self.seed);
        let file = |part: &Vec<usize>| self.file_without(part, task);
        let files: Vec<(Model, _, _)> = parts.par_iter().map(file).collect::<Result<_, InputError>>()?;
        for (part, (model, scatter, tails)) in parts.iter().zip(&files) {
            held_out.add(
                rows,
                &self.units.of_row,
                part,
                [&base, &ModelFile { model, scatter: *scatter, tails: *tails }],
            );
        }
        let model = Model::from_toml("extended.toml", text)?;
        let mut seen = HeldOutRows::default();
        let extended = ModelFile { model: &model, scatter: models[1].scatter, tails: models[1].data.tails() };
        seen.add(rows, &self.units.of_row, &whole.all(), [&base, &extended]);
        Ok(MeasuredGain { how: CROSS_VALIDATED, rows: held_out, seen: Some(seen) })
    }

    /// The model that the rows beside this part choose and fit, with its scatter and the shares of heavy tails [1].
    fn file_without(&self, part: &[usize], task: Task<'_>) -> Result<(Model, Scatter, [f64; 2]), InputError> {
        let mut inside = vec![false; self.units.of_row.len()];
        part.iter().for_each(|&row| inside[row] = true);
        let others: Vec<usize> = (0..inside.len()).filter(|&row| !inside[row]).collect();
        let causes = self.choice.again(&others);
        let text = causes.model_text(task).unwrap_or_else(|_| task.text.to_owned());
        Ok((Model::from_toml("extended.toml", &text)?, causes.scatter(), causes.data.tails()))
    }
}

/// Rows that are held out together.
struct Units {
    /// The unit of each row.
    of_row: Arc<[usize]>,
    count: usize,
}

impl Units {
    /// The groups that share an error in a choice, if there are enough of them and they are not the units already.
    fn of_groups(&self, choice: &CauseChoice) -> Option<Self> {
        let groups = choice.causes.data.shared.as_ref()?;
        let fewer = (LEAST_HELD_OUT_GROUPS..self.count).contains(&groups.count);
        fewer.then(|| Self { of_row: groups.of_row.clone(), count: groups.count })
    }

    /// The rows of three quarters of the units, and the others.
    fn quarter(&self, seed: u64) -> (Vec<usize>, Vec<usize>) {
        let mut held = vec![false; self.count];
        shuffled(self.count, seed).iter().take(self.count / 4).for_each(|&unit| held[unit] = true);
        (0..self.of_row.len()).partition(|&row| !held[self.of_row[row]])
    }

    /// The rows in parts.
    fn parts(&self, seed: u64) -> Vec<Vec<usize>> {
        let count = PARTS.min(self.count);
        let mut part_of = vec![0; self.count];
        let order = shuffled(self.count, seed);
        order.iter().enumerate().for_each(|(place, &unit)| part_of[unit] = place % count);
        let mut parts = vec![Vec::new(); count];
        (0..self.of_row.len()).for_each(|row| parts[part_of[self.of_row[row]]].push(row));
        parts
    }
}
