//! Comparison: several models ranked on one file of measured impacts.
//!
//! No parameter of a model is fitted here. Only the scatter of `e_n` and `e_t` about each model is
//! estimated, always on other rows than those that it scores. Rows that fitted a model before are
//! counted, if its file states them. Intervals are
//! those of a bootstrap over groups with the same resamples for all models. On the readings of a rig
//! ([`compare_rig`]) the groups are experiments. Method for users: `docs/how-to/compare.md`.

mod bootstrap;
mod groups;
mod measure;
mod record;
mod rig;
mod score;

use std::collections::{BTreeMap, BTreeSet};
use std::io::Read;

use super::constants::LEAST_ROWS;
use super::fault;
use super::fitted_rows::{FittedRows, first_line};
use crate::dataset::{ColumnMap, DatasetError, MOST_ROWS, Measurement, Measurements, WallChoice};
use bootstrap::Bootstrap;
use groups::RowGroups;
use measure::Totals;
use nearwall::model::Model;
use score::ScoredRows;

pub use rig::{RigComparisonError, compare_rig};

pub use record::{Comparison, Difference, GroupedRows, Interval, ModelErrors, ModelResult, ModelRows};

/// A model under comparison, with the data as its walls read them.
#[derive(Debug)]
pub struct ComparedModel<'a> {
    /// Its name in the results: that of its file.
    name: String,
    model: &'a Model,
    /// The data; of a large file a selection of its rows.
    data: Measurements,
    /// What of the whole file it cannot use.
    rows: ModelRows,
    /// The rows that fitted it.
    fitted: FittedRows,
}

impl<'a> ComparedModel<'a> {
    /// Reads the data in bounded memory: of a file with more than [`MOST_ROWS`] usable rows a
    /// selection. `model` is that of `walls`, `name` its name in the results, and `file` names the
    /// source in messages.
    ///
    /// # Errors
    /// As [`Measurements::read`].
    pub fn read(
        name: String,
        model: &'a Model,
        file: &str,
        source: impl Read,
        map: Option<&ColumnMap>,
        walls: &WallChoice<'_>,
    ) -> Result<Self, DatasetError> {
        Self::read_at_most(MOST_ROWS, name, model, file, source, map, walls)
    }

    /// The same with another largest number of rows.
    fn read_at_most(
        most: usize,
        name: String,
        model: &'a Model,
        file: &str,
        source: impl Read,
        map: Option<&ColumnMap>,
        walls: &WallChoice<'_>,
    ) -> Result<Self, DatasetError> {
        let mut counts = RowCounts::default();
        let mut unselected = |row| counts.add(model, &row);
        let data = Measurements::read_at_most(file, source, map, walls, most, &mut unselected)?;
        data.rows.iter().for_each(|row| counts.add(model, row));
        Ok(Self { name, model, rows: counts.finish(&data), data, fitted: FittedRows::default() })
    }

    /// The same with the rows that its file states as those that fitted it; `text` is that of the file.
    #[must_use]
    pub fn with_fitted_rows(self, text: &str) -> Self {
        Self { fitted: FittedRows::stated(text), ..self }
    }

    /// The notes on the data.
    pub fn notes(&self) -> &[String] {
        &self.data.notes
    }
}

/// Counts of the rows of a file under a model.
#[derive(Default)]
struct RowCounts {
    refused: usize,
    /// The first refused row, with the reason.
    first: Option<(u64, String)>,
    outside_range: usize,
}

impl RowCounts {
    /// Counts a row; rows come in any order.
    fn add(&mut self, model: &Model, row: &Measurement) {
        if let Some(reason) = fault(model, row) {
            self.refused += 1;
            self.first = self.first.take().into_iter().chain([(row.line, reason)]).min();
        }
        let outcome = model.resolve_with(row.wall, &row.impact, |_| 0.5);
        self.outside_range += usize::from(outcome.is_ok_and(|outcome| outcome.outside_range));
    }

    /// The counts, with the rows that could not be read.
    fn finish(self, data: &Measurements) -> ModelRows {
        let unread = data.rejected.first().map(|bad| (bad.line, bad.reason.clone()));
        let first = self.first.into_iter().chain(unread).min();
        ModelRows {
            undecided: self.refused + data.read - data.rows.len() - data.unselected.rows,
            first_reason: first.map(|(line, reason)| format!("line {line}: {reason}")),
            outside_range: self.outside_range,
            fitted: 0,
        }
    }
}

/// Why models cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum ComparisonError {
    /// Too few rows that every model decides.
    #[error(
        "{common} of {read} rows can be decided by every model; a comparison needs at least {LEAST_ROWS}. {reasons}"
    )]
    TooFewRows {
        /// Rows that every model decides.
        common: usize,
        /// Rows in the file.
        read: usize,
        /// Why the first rows cannot be used.
        reasons: String,
    },
}

/// Ranks models on one file by log likelihood of a row; the same seed gives the same bytes.
///
/// # Errors
/// [`ComparisonError`].
pub fn compare(candidates: &[ComparedModel<'_>], seed: u64) -> Result<Comparison, ComparisonError> {
    let lines = common_lines(candidates, |model, row| fault(model, row).is_none());
    let read = candidates.first().map_or(0, |candidate| candidate.data.read);
    if lines.len() < LEAST_ROWS {
        let reasons = first_reasons(candidates);
        return Err(ComparisonError::TooFewRows { common: lines.len(), read, reasons });
    }
    let common: Vec<Measurements> = candidates
        .iter()
        .map(|candidate| candidate.data.without(|row| (!lines.contains(&row.line)).then(String::new)))
        .collect();
    let groups = RowGroups::of(&common[0]);
    let folds = groups.folds(seed);
    let scored = candidates.iter().zip(&common);
    let scored: Vec<ScoredRows> =
        scored.map(|(candidate, data)| ScoredRows::new(candidate.model, &data.rows, &folds)).collect();
    let totals: Vec<Totals> = scored.iter().map(|rows| Totals::new(rows, &groups)).collect();
    let bootstrap = Bootstrap::new(&totals, groups.count, seed);
    let rows = candidates.iter().zip(&common).map(|(candidate, data)| {
        let first = first_line(&candidate.data);
        let fitted = data.rows.iter().filter(|row| candidate.fitted.contains(row, first)).count();
        ModelRows { fitted, ..candidate.rows.clone() }
    });
    let rows = rows.collect();
    let is_selection = candidates.iter().any(|candidate| candidate.data.unselected.rows > 0);
    let selected = is_selection.then(|| common_lines(candidates, |_, _| true).len());
    let used = common[0].rows.len();
    let grouped = GroupedRows { read, selected, used, groups: groups.count, group_by: groups.by };
    let names: Vec<&str> = candidates.iter().map(|candidate| candidate.name.as_str()).collect();
    let scatter = scored.iter().map(|rows| rows.scatter).collect();
    Ok(record::comparison(&names, &bootstrap, grouped, rows, scatter, seed))
}

/// The lines of the rows that every model uses.
fn common_lines(
    candidates: &[ComparedModel<'_>],
    uses: impl Fn(&Model, &Measurement) -> bool,
) -> BTreeSet<u64> {
    let mut counts: BTreeMap<u64, usize> = BTreeMap::new();
    for candidate in candidates {
        for row in candidate.data.rows.iter().filter(|row| uses(candidate.model, row)) {
            *counts.entry(row.line).or_default() += 1;
        }
    }
    let in_all = counts.into_iter().filter(|(_, count)| *count == candidates.len());
    in_all.map(|(line, _)| line).collect()
}

/// The first reason of each model.
fn first_reasons(candidates: &[ComparedModel<'_>]) -> String {
    let reason = |candidate: &ComparedModel<'_>| {
        Some(format!("{}: {}.", candidate.name, candidate.rows.first_reason.as_ref()?))
    };
    candidates.iter().filter_map(reason).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use nearwall::impact::Impact;
    use nearwall::rng::ImpactRng;
    use std::fmt::Write;

    const MODEL: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
        [normal]\nmodel = \"thornton-ning\"\nyield_ratio = 0.7\n[tangential]\nmodel = \"constant\"\ne_t = 0.76\n";

    /// Rows of the model with some scatter; of ten one cannot be read and one is implausible, and
    /// both kinds stand at the end, too.
    fn rows(count: u64, model: &Model) -> String {
        let mut text = "v_n,d,e_n\n".to_owned();
        for row in 0..count {
            let draw = |stream| ImpactRng::new(7, row).uniform(stream);
            let impact = Impact { normal_speed: 0.5 + 3.0 * draw(0), diameter: 5e-5, ..Impact::default() };
            let e_n = model.expect(0, &impact, 1).unwrap().normal_restitution + 0.05 * (draw(1) - 0.5);
            let (speed, d) = match row % 10 {
                8 => ("fast".to_owned(), 5e-5),
                9 => (impact.normal_speed.to_string(), 1e-16),
                _ => (impact.normal_speed.to_string(), 5e-5),
            };
            writeln!(text, "{speed},{d:e},{e_n}").unwrap();
        }
        text
    }

    #[test]
    fn a_selection_ranks_the_models_and_all_rows_are_counted() {
        let [right, softer] = ["0.7", "1.4"].map(|ratio| {
            Model::from_toml("m.toml", &MODEL.replace("yield_ratio = 0.7", &format!("yield_ratio = {ratio}")))
                .unwrap()
        });
        let text = rows(4000, &right);
        let compared = |most: usize| {
            let candidate = |(name, model): (&str, _)| {
                let walls = WallChoice::new(model, None).unwrap();
                ComparedModel::read_at_most(
                    most,
                    name.to_owned(),
                    model,
                    "t.csv",
                    text.as_bytes(),
                    None,
                    &walls,
                )
                .unwrap()
            };
            let candidates = [("softer", &softer), ("right", &right)].map(candidate);
            (compare(&candidates, 1).unwrap(), candidates[0].notes().to_vec())
        };
        let [(all, quiet), (part, notes)] = [usize::MAX, 1000].map(compared);
        assert_eq!((all.rows.read, all.rows.selected, all.rows.used), (4000, None, 3200));
        let selected = part.rows.selected.unwrap();
        assert!((800..=1000).contains(&selected), "{selected}");
        assert!(part.rows.used < selected && part.rows.used > 650, "{}", part.rows.used);
        for (comparison, place) in [(&all, 0), (&all, 1), (&part, 0), (&part, 1)] {
            let result = &comparison.models[place];
            assert_eq!(result.model, ["right", "softer"][place]);
            assert_eq!(result.rows.undecided, 800);
            assert_eq!(result.rows.first_reason.as_deref(), Some("line 10: v_n `fast` is not a number"));
            assert_eq!(result.rows.outside_range, all.models[0].rows.outside_range);
        }
        // The error of all rows lies in the interval of the selected ones, which is about twice as wide.
        let [of_all, of_part] = [&all, &part].map(|comparison| comparison.models[0].errors.rmse_e_n.unwrap());
        let [low, high] = of_part.ci95.unwrap();
        assert!((low..=high).contains(&of_all.value), "{low} to {high}, not {}", of_all.value);
        let [least, most] = of_all.ci95.unwrap();
        assert!((1.5..2.7).contains(&((high - low) / (most - least))));
        assert!(
            notes.iter().any(|note| note.contains("of 3600 usable rows were selected at random")),
            "{notes:?}"
        );
        assert!(!quiet.iter().any(|note| note.contains("selected")), "{quiet:?}");
    }
}
