//! Comparison: several models ranked on one file of measured impacts.
//!
//! No parameter of a model is fitted, so every row is held out. Only the scatter of `e_n` and `e_t` about each model is
//! estimated, always on other rows than those that it scores. Intervals are those of a bootstrap over groups with the same
//! resamples for all models. Method for users: `docs/compare.md`.

mod bootstrap;
mod groups;
mod measure;
mod record;
mod score;

use std::collections::{BTreeMap, BTreeSet};

use super::fault;
use crate::dataset::{Measurement, Measurements};
use crate::model::Model;
use bootstrap::Bootstrap;
use groups::Groups;
use measure::Totals;
use score::ScoredRows;

pub use record::{Comparison, Difference, GroupedRows, Interval, ModelErrors, ModelResult, ModelRows};

/// Least number of rows that every model decides.
const LEAST_ROWS: usize = 3;

/// A model under comparison, with the data as its walls read them.
#[derive(Debug)]
pub struct Candidate<'a> {
    /// Its name in the results: that of its file.
    pub name: String,
    /// The model.
    pub model: &'a Model,
    /// The data.
    pub data: Measurements,
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
pub fn compare(candidates: &[Candidate<'_>], seed: u64) -> Result<Comparison, ComparisonError> {
    let lines = common_lines(candidates);
    let read = candidates.first().map_or(0, |candidate| candidate.data.read);
    if lines.len() < LEAST_ROWS {
        let reasons = first_reasons(candidates);
        return Err(ComparisonError::TooFewRows { common: lines.len(), read, reasons });
    }
    let common: Vec<Measurements> = candidates
        .iter()
        .map(|candidate| candidate.data.without(|row| (!lines.contains(&row.line)).then(String::new)))
        .collect();
    let groups = Groups::of(&common[0]);
    let folds = groups.folds(seed);
    let scored = candidates.iter().zip(&common);
    let scored: Vec<ScoredRows> =
        scored.map(|(candidate, data)| ScoredRows::new(candidate.model, &data.rows, &folds)).collect();
    let totals: Vec<Totals> = scored.iter().map(|rows| Totals::new(rows, &groups)).collect();
    let bootstrap = Bootstrap::new(&totals, groups.count, seed);
    let rows = candidates.iter().map(model_rows).collect();
    let grouped = GroupedRows { read, used: common[0].rows.len(), groups: groups.count, group_by: groups.by };
    let names: Vec<&str> = candidates.iter().map(|candidate| candidate.name.as_str()).collect();
    let scatter = scored.iter().map(|rows| rows.scatter).collect();
    Ok(record::comparison(&names, &bootstrap, grouped, rows, scatter, seed))
}

/// The lines of the rows that every model decides.
fn common_lines(candidates: &[Candidate<'_>]) -> BTreeSet<u64> {
    let mut counts: BTreeMap<u64, usize> = BTreeMap::new();
    for candidate in candidates {
        for row in candidate.data.rows.iter().filter(|row| fault(candidate.model, row).is_none()) {
            *counts.entry(row.line).or_default() += 1;
        }
    }
    let in_all = counts.into_iter().filter(|(_, count)| *count == candidates.len());
    in_all.map(|(line, _)| line).collect()
}

/// What a model could not use, and what lies outside its range.
fn model_rows(candidate: &Candidate<'_>) -> ModelRows {
    let Candidate { model, data, .. } = candidate;
    let mut refused: Vec<(u64, String)> =
        data.rejected.iter().map(|bad| (bad.line, bad.reason.clone())).collect();
    refused.extend(data.rows.iter().filter_map(|row| Some((row.line, fault(model, row)?))));
    refused.sort_unstable();
    let outside = |row: &&Measurement| {
        model.resolve_with(row.wall, &row.impact, |_| 0.5).is_ok_and(|outcome| outcome.outside_range)
    };
    ModelRows {
        undecided: refused.len(),
        first_reason: refused.first().map(|(line, reason)| format!("line {line}: {reason}")),
        outside_range: data.rows.iter().filter(outside).count(),
    }
}

/// The first reason of each model.
fn first_reasons(candidates: &[Candidate<'_>]) -> String {
    let reason = |candidate: &Candidate<'_>| {
        Some(format!("{}: {}.", candidate.name, model_rows(candidate).first_reason?))
    };
    candidates.iter().filter_map(reason).collect::<Vec<_>>().join(" ")
}
