//! What a diagnosis comes to: the content of `diagnosis.json`, and the rows behind its figures.

use std::collections::BTreeMap;

use serde::Serialize;

/// The answer to a file of measured impacts.
#[derive(Debug, Clone, Serialize)]
pub struct Diagnosis {
    /// `nearwall.diagnosis/1`.
    pub schema: &'static str,
    /// What dealt the rows out.
    pub seed: u64,
    /// Accepted share of false discoveries [1].
    pub level: f64,
    /// The answer in a sentence or two.
    pub verdict: String,
    /// Rows read and used.
    pub rows: Rows,
    /// Errors of the base model on all used rows.
    pub base: Errors,
    /// Where the base model fails, the worst first.
    pub misfit: Vec<Misfit>,
    /// The causes, in the order in which they were found.
    pub findings: Vec<Finding>,
    /// Numbers of the base model's own laws that the data want otherwise.
    pub calibration: Vec<Calibration>,
    /// Scatter that changes with a column: no cause, but taken into account.
    pub scatter: ScatterFound,
    /// Effects that these data cannot speak of.
    pub not_examined: Vec<NotExamined>,
    /// Captures that neither the base nor a cause accounts for, at a rate that no column explains.
    pub unexplained_capture: Option<Unexplained>,
    /// The gain on rows that no fit and no choice saw.
    pub gain: Option<Gain>,
    /// The same for every observable.
    pub gains: Vec<Gain>,
    /// File name of the extended model.
    pub extended_model: &'static str,
    /// Rows for figures.
    #[serde(skip)]
    pub sample: Sample,
}

/// Rows of the file.
#[derive(Debug, Clone, Serialize)]
pub struct Rows {
    /// Rows in the file.
    pub read: usize,
    /// Rows that the diagnosis used.
    pub used: usize,
    /// Impacts and readings that no fit and no choice saw; an average counts as the captures and rebounds it states.
    pub held_out: usize,
    /// Rows left out.
    pub rejected: Vec<Rejected>,
}

/// A row left out.
#[derive(Debug, Clone, Serialize)]
pub struct Rejected {
    /// Line in the file, counted from 1.
    pub line: u64,
    /// Why.
    pub reason: String,
}

/// Root mean square errors [1] and mean log loss [nats]; `None` where nothing was observed.
#[derive(Debug, Clone, Copy, Serialize, Default)]
pub struct Errors {
    /// Of `e_n`.
    pub rmse_e_n: Option<f64>,
    /// Of `e_t`.
    pub rmse_e_t: Option<f64>,
    /// Of capture.
    pub log_loss_stick: Option<f64>,
}

/// How much of one observable's misfit a curve over one column explains.
#[derive(Debug, Clone, Serialize)]
pub struct Misfit {
    /// The column.
    pub column: String,
    /// `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// Gain in log score on rows that the curve was not fitted to, beyond what an error that is the same everywhere
    /// would give [nats].
    pub gain: f64,
    /// Corrected for the number of candidates.
    pub q_value: f64,
}

/// A cause.
#[derive(Debug, Clone, Serialize)]
pub struct Finding {
    /// An effect's id, or `unknown:<column>`.
    pub cause: String,
    /// The observable that gains most: `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// The inputs that it turns on.
    pub variables: Vec<String>,
    /// Gain in log score on rows that its fit did not see [nats].
    pub gain: f64,
    /// Of the paired test on unseen rows.
    pub p_value: f64,
    /// Corrected for the number of candidates.
    pub q_value: f64,
    /// Its parameters by name.
    pub parameters: BTreeMap<&'static str, Estimate>,
    /// Why the others lost, the best of them first.
    pub alternatives: Vec<Alternative>,
    /// Causes that these data cannot tell from this one.
    pub indistinguishable_from: Vec<String>,
    /// What to measure to tell them apart.
    pub measure_next: Vec<Measure>,
    /// A fitted curve, for a column that no effect explains.
    pub curve: Option<Shape>,
    /// One sentence.
    pub explanation: String,
}

/// A parameter with its 95 % interval.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Estimate {
    /// Most likely value.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// SI unit.
    pub unit: &'static str,
}

/// A cause that lost.
#[derive(Debug, Clone, Serialize)]
pub struct Alternative {
    /// An effect's id, a number's key or `unknown:<column>`.
    pub cause: String,
    /// How much better the winner predicts unseen rows [nats].
    pub score_difference: f64,
}

/// A measurement that would tell two causes apart.
#[derive(Debug, Clone, Serialize)]
pub struct Measure {
    /// The other cause.
    pub against: String,
    /// The input to vary.
    pub vary: String,
    /// From where to where, in SI units.
    pub range: [f64; 2],
    /// The input's unit.
    pub unit: &'static str,
    /// What to watch.
    pub observable: &'static str,
    /// About how many impacts, half of them at each end.
    pub impacts: u64,
}

/// A curve over a column.
#[derive(Debug, Clone, Serialize)]
pub struct Shape {
    /// Whether it multiplies the forecast instead of adding to it.
    pub factor: bool,
    /// Positions of its bends in the column's unit, or its words.
    pub at: Vec<String>,
    /// What it adds to the observable there (as a share of it if `factor`; in log odds for capture).
    pub adds: Vec<f64>,
}

/// A number of the base's laws that the data want otherwise.
#[derive(Debug, Clone, Serialize)]
pub struct Calibration {
    /// Its key in the model file.
    pub key: String,
    /// The base model's.
    pub from: f64,
    /// Most likely value.
    pub value: f64,
    /// Lower end of its 95 % interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Of the paired test on unseen rows.
    pub p_value: f64,
    /// Corrected for the number of candidates.
    pub q_value: f64,
}

/// Scatter about the extended model.
#[derive(Debug, Clone, Serialize, Default)]
pub struct ScatterFound {
    /// Of single values of `e_n` [1].
    pub e_n: f64,
    /// Of single values of `e_t` [1].
    pub e_t: f64,
    /// Columns with which it changes.
    pub changes_with: Vec<String>,
}

/// Captured share [1].
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Unexplained {
    /// In the rows.
    pub measured: f64,
    /// By the named causes.
    pub expected: f64,
}

/// An effect that the data cannot speak of.
#[derive(Debug, Clone, Serialize)]
pub struct NotExamined {
    /// Its id.
    pub cause: &'static str,
    /// What is missing.
    pub reason: String,
}

/// Errors on rows that no fit and no choice saw.
#[derive(Debug, Clone, Serialize)]
pub struct Gain {
    /// How many.
    pub held_out_rows: usize,
    /// `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// Of the base model; for `outcome` of the probability of capture.
    pub rmse_before: f64,
    /// Of the extended model.
    pub rmse_after: f64,
    /// 95 % interval of `rmse_after / rmse_before` (bootstrap over rows).
    pub ci95: [f64; 2],
    /// Mean log score of a row before, all observables together [nats].
    pub log_score_before: f64,
    /// After.
    pub log_score_after: f64,
}

/// Rows for figures.
#[derive(Debug, Clone, Default)]
pub struct Sample {
    /// Columns that vary: name and unit.
    pub columns: Vec<(String, String)>,
    /// Words of columns of words, by column.
    pub words: Vec<Option<Vec<String>>>,
    /// Some of the rows.
    pub rows: Vec<SampleRow>,
}

/// A row for figures.
#[derive(Debug, Clone)]
pub struct SampleRow {
    /// Whether no fit and no choice saw it.
    pub held_out: bool,
    /// Its cells, by column; the place of the word for columns of words; NaN where blank.
    pub cells: Vec<f64>,
    /// `e_n`: measured, base model, extended model.
    pub e_n: Option<[f64; 3]>,
    /// `e_t`: measured, base model, extended model.
    pub e_t: Option<[f64; 3]>,
    /// Share captured: measured, base model, extended model.
    pub captured: Option<[f64; 3]>,
}
