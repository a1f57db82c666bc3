//! The result of a diagnosis: the content of `diagnosis.json` and the rows of its figures.

use std::collections::BTreeMap;

use serde::Serialize;

use super::reach::Reach;
use crate::dataset::BadRow;

/// Options of a diagnosis.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Seed of the data split; the same seed gives the same bytes.
    pub seed: u64,
    /// Accepted share of false discoveries [1].
    pub level: f64,
    /// The column of labels that tells groups of rows apart; `None` for those that
    /// [`crate::dataset::names_groups`] accepts.
    pub group: Option<String>,
    /// What can be varied in the next measurement; none for all inputs that vary, up to twice their range.
    pub reach: Vec<Reach>,
}

impl Default for Options {
    fn default() -> Self {
        Self { seed: 1, level: 0.05, group: None, reach: Vec::new() }
    }
}

/// The result of a diagnosis.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Diagnosis {
    /// `nearwall.diagnosis/2`.
    pub schema: &'static str,
    /// Seed of the data split.
    pub seed: u64,
    /// Accepted share of false discoveries [1].
    pub level: f64,
    /// The result in a few sentences.
    pub verdict: String,
    /// Rows read and used.
    pub rows: Rows,
    /// Errors of the base model on all used rows.
    pub base: Errors,
    /// Goodness of fit of the base and of the extended model.
    pub fit: Fit,
    /// Rows that share an error, if any.
    pub groups: Option<GroupsFound>,
    /// The columns with which the base model's residuals vary, the largest gain first.
    pub misfit: Vec<Misfit>,
    /// The causes, in the order in which they were found.
    pub findings: Vec<Finding>,
    /// The smallest set of explanations that holds 95 %, the most probable first.
    pub explanations: Vec<ExplanationFound>,
    /// Causes of which one takes part, if these data cannot tell which; then there is no finding for them.
    pub undecided: Vec<String>,
    /// The measurements that would decide between the explanations, where none is named.
    pub measure_next: Vec<NextMeasurement>,
    /// Causes that were left out: with them the model predicts rows that it has not seen worse.
    pub refuted: Vec<String>,
    /// Slips of input and artefacts of measurement that explain the misfit as well as a cause does.
    pub rivals: Vec<Rival>,
    /// Parameters of the base model's own laws with a significantly different value.
    pub calibration: Vec<Calibration>,
    /// Scatter about the extended model.
    pub scatter: ScatterFound,
    /// Effects that these data cannot show.
    pub not_examined: Vec<NotExamined>,
    /// Share [1] of the captures that the model predicts which happen, where some never do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capture_ceiling: Option<f64>,
    /// Share of the readings that lie far from any model, about which nothing is known [1]; `None` where it is small.
    pub gross_errors: Option<f64>,
    /// Whether the readings scatter with heavy tails: about a quarter of them four times as far as the others.
    pub heavy_tails: bool,
    /// The quantities that have these gross errors or tails: `e_n`, `e_t` or both.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outliers_of: Vec<&'static str>,
    /// Captures that neither the base model nor a cause nor a column explains.
    pub unexplained_capture: Option<Unexplained>,
    /// The gain on held-out rows in the observable of the first finding.
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
#[derive(Debug, Clone, Serialize, Default)]
pub struct Rows {
    /// Rows in the file.
    pub read: usize,
    /// Rows that the diagnosis used.
    pub used: usize,
    /// Number of rows that represent all used rows of a large file in choices, fits and gain; `None` for all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub selected: Option<usize>,
    /// Impacts and readings that the model file was not fitted to; an average counts as the captures and rebounds it
    /// states.
    pub held_out: usize,
    /// Lines of the file that the model file was not fitted to, at most 1000; none if the gain is cross-validated.
    pub held_out_lines: Vec<u64>,
    /// Rows that were not used; some of them where `read` less `used` is larger.
    pub rejected: Vec<BadRow>,
}

impl Rows {
    /// Number of rows that were not used.
    pub fn left_out(&self) -> usize {
        self.read - self.used
    }
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

/// The dependence of an observable's residuals on one column.
#[derive(Debug, Clone, Serialize)]
pub struct Misfit {
    /// The column.
    pub column: String,
    /// `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// Gain in log likelihood of a curve over the column, beyond that of a level shift and less its parameters [nats].
    pub gain: f64,
    /// Corrected for the number of candidates.
    pub q_value: f64,
}

/// An explanation of the data.
#[derive(Debug, Clone, Serialize)]
pub struct ExplanationFound {
    /// Its causes, changed numbers and rivals of physics; none for the base model as it is.
    pub causes: Vec<String>,
    /// Its probability [1].
    pub probability: f64,
}

/// A cause.
#[derive(Debug, Clone, Serialize)]
pub struct Finding {
    /// An effect's id, or `unknown:<column>`.
    pub cause: String,
    /// The observable that gains most: `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// The columns that it depends on.
    pub variables: Vec<String>,
    /// Gain in log likelihood on the rows of the search, less the number of parameters [nats].
    pub gain: f64,
    /// Fall of chi-square: twice the gain in log likelihood [1].
    pub chi_square: f64,
    /// Significance in standard deviations of a normal distribution, after correction for the number of candidates [1].
    pub sigma: f64,
    /// Probability that the cause takes part in the explanation [1]; at a rig the Akaike weight in its
    /// round, which was not compared with planted sets.
    pub probability: f64,
    /// Share of resampled data sets, or of random weights of the rows, in which an explanation with this
    /// cause is the best [1].
    pub certainty: f64,
    /// p-value of the test that a free curve over its inputs fits no better; small values speak
    /// against the law's shape.
    pub lack_of_fit: Option<f64>,
    /// Pairs of parameters of which the data determine only a product or a ratio, as sentences.
    pub not_separable: Vec<String>,
    /// Of the test against the model without the cause.
    pub p_value: f64,
    /// Corrected for the number of candidates.
    pub q_value: f64,
    /// Its parameters by name.
    pub parameters: BTreeMap<&'static str, Estimate>,
    /// Other causes, the best first.
    pub alternatives: Vec<Alternative>,
    /// Causes that these data cannot distinguish from this one.
    pub indistinguishable_from: Vec<String>,
    /// Measurements that would distinguish them.
    pub measure_next: Vec<NextMeasurement>,
    /// The fitted curve, for a column that no effect explains.
    pub curve: Option<CauseCurve>,
    /// The closed forms in the place of curves, if the data bear any: one an observable.
    pub forms: Vec<CauseForm>,
    /// The surface, if this is an unknown dependence on two columns.
    pub surface: Option<CauseSurface>,
    /// The finding in a few sentences.
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

/// A cause that was not chosen.
#[derive(Debug, Clone, Serialize)]
pub struct Alternative {
    /// An effect's id, a number's key or `unknown:<column>`.
    pub cause: String,
    /// Difference in gain to the chosen cause [nats].
    pub score_difference: f64,
    /// Probability of the explanations in which it stands in the stead of the cause [1].
    pub probability: f64,
}

/// A measurement that would distinguish two causes.
#[derive(Debug, Clone, Serialize)]
pub struct NextMeasurement {
    /// The cause that is probable; empty for the base model as it is.
    pub cause: String,
    /// The other cause.
    pub against: String,
    /// The input to vary.
    pub vary: String,
    /// The two values to measure at, in SI units.
    pub range: [f64; 2],
    /// The input's unit.
    pub unit: &'static str,
    /// The observable to measure.
    pub observable: &'static str,
    /// Approximate number of impacts, half of them at each value.
    pub impacts: u64,
}

/// A fitted curve over a column.
#[derive(Debug, Clone, Serialize)]
pub struct CauseCurve {
    /// Whether it is multiplied with the prediction rather than added.
    pub factor: bool,
    /// Its knots in the column's unit, or the labels.
    pub at: Vec<String>,
    /// Its heights there: added to the observable, as a share of it if `factor`, in log odds for capture.
    pub adds: Vec<f64>,
}

/// A closed form over a column.
#[derive(Debug, Clone, Serialize)]
pub struct CauseForm {
    /// `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// Its name in model files.
    pub form: &'static str,
    /// Whether it replaces the prediction (`set`), is added to it (`add`) or multiplied with it (`times`).
    pub acts: &'static str,
    /// The equation with numbers; `base` is the prediction of the base model.
    pub equation: String,
    /// Its fitted parameters.
    pub parameters: BTreeMap<&'static str, Estimate>,
    /// The range of the column over which it was seen, in the column's unit.
    pub seen: Option<[f64; 2]>,
    /// Its value with a 95 % band, within that range and beyond it.
    pub line: Vec<FormPoint>,
    /// Probability among the forms [1], each with equal odds before the data.
    pub probability: f64,
    /// The other forms that the data leave open, the most probable first.
    pub others: Vec<OtherForm>,
    /// The law that it resembles.
    pub resembles: Option<&'static str>,
}

/// The value of a form at one place of its column.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct FormPoint {
    /// The place, in the column's unit.
    pub at: f64,
    /// What it sets, adds or multiplies with [1].
    pub value: f64,
    /// Ends of the 95 % band [1].
    pub low: f64,
    /// See `low`.
    pub high: f64,
}

/// Another form.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct OtherForm {
    /// Its name in model files.
    pub form: &'static str,
    /// Its probability [1].
    pub probability: f64,
}

/// A fitted surface over two columns.
#[derive(Debug, Clone, Serialize)]
pub struct CauseSurface {
    /// Whether it is multiplied with the prediction rather than added.
    pub factor: bool,
    /// The knots of each column in its unit, or its labels.
    pub at: [Vec<String>; 2],
    /// The heights there, a row for each knot of the first column: as of a [`CauseCurve`].
    pub adds: Vec<Vec<f64>>,
}

/// A parameter of the base model's laws with a significantly different value.
#[derive(Debug, Clone, Serialize)]
pub struct Calibration {
    /// Its key in the model file.
    pub key: String,
    /// Value in the base model.
    pub from: f64,
    /// Most likely value.
    pub value: f64,
    /// Lower end of its 95 % interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Of the test against the model without it.
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

/// Share of captured impacts [1].
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Unexplained {
    /// Measured.
    pub measured: f64,
    /// Predicted with the named causes.
    pub expected: f64,
}

/// An effect that was no candidate.
#[derive(Debug, Clone, Serialize)]
pub struct NotExamined {
    /// Its id.
    pub cause: &'static str,
    /// The reason.
    pub reason: String,
}

/// Errors on held-out rows.
#[derive(Debug, Clone, Serialize)]
pub struct Gain {
    /// Number of rows.
    pub held_out_rows: usize,
    /// `held-out` if `extended.toml` itself was run on rows that it was not fitted to, and without which the same
    /// causes are chosen; `cross-validated` where each row is predicted by a model file that was chosen, of the
    /// explanations that all rows led to, and fitted without it.
    pub measured: &'static str,
    /// `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// Root mean square error of the base model [1]; for `outcome` of the probability of capture.
    pub rmse_before: f64,
    /// Root mean square error of the extended model [1].
    pub rmse_after: f64,
    /// 95 % interval of `rmse_after / rmse_before`, by a bootstrap over groups of rows.
    pub ci95: [f64; 2],
    /// Scatter of the measurements that no model removes [1]; `None` where it is not known.
    pub noise_floor: Option<f64>,
    /// Mean log score of a row under the base model, all observables together [nats].
    pub log_score_before: f64,
    /// The same under the extended model [nats].
    pub log_score_after: f64,
}

/// Goodness of fit before and after.
#[derive(Debug, Clone, Serialize, Default)]
pub struct Fit {
    /// Of the base model.
    pub base: FitTest,
    /// Of the extended model.
    pub extended: FitTest,
    /// The rows with the largest misfits of the base model, in stated standard errors, the largest first.
    pub largest: Vec<LargeMisfit>,
}

/// A goodness-of-fit test.
#[derive(Debug, Clone, Serialize, Default)]
pub struct FitTest {
    /// What the misfit is compared with: `stated errors`, `replicates`, `structure` (does any
    /// column shape the residuals) or `none`.
    pub against: &'static str,
    /// Chi-square [1]; `None` for a test of structure.
    pub chi_square: Option<f64>,
    /// Degrees of freedom.
    pub degrees_of_freedom: Option<usize>,
    /// Probability of a misfit at least as large by chance.
    pub p_value: Option<f64>,
}

/// A row far from the model.
#[derive(Debug, Clone, Serialize)]
pub struct LargeMisfit {
    /// Line in the file.
    pub line: u64,
    /// `e_n` or `e_t`.
    pub observable: &'static str,
    /// Measured value [1].
    pub measured: f64,
    /// Predicted value [1].
    pub predicted: f64,
    /// Measured minus predicted value in standard errors [1].
    pub standard_errors: f64,
}

/// Rows that share an error.
#[derive(Debug, Clone, Serialize)]
pub struct GroupsFound {
    /// The column that tells the groups apart.
    pub column: String,
    /// Number of groups.
    pub count: usize,
    /// Whether the user or the format declares the column as groups; otherwise it was noticed.
    pub declared: bool,
    /// Standard deviation of the shared error of `e_n` and `e_t` [1].
    pub scatter: [f64; 2],
    /// Its share of the variance of the residuals of `e_n` and `e_t` [1].
    pub share: [f64; 2],
}

/// A slip of input or an artefact of measurement that explains the misfit.
#[derive(Debug, Clone, Serialize)]
pub struct Rival {
    /// For instance `slip:diameter-is-radius`, `artefact:truncation`.
    pub id: String,
    /// `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// Gain in log likelihood on the rows of the search [nats].
    pub gain: f64,
    /// Gain minus that of the best explanation by physics [nats]; positive if it explains more.
    pub lead: f64,
    /// Probability of the explanations in which it stands in the stead of the cause [1].
    pub probability: f64,
    /// What it says, in one sentence: "These numbers fit if d were twice as large: is the radius given?".
    pub explanation: String,
}

/// Rows for figures.
#[derive(Debug, Clone, Default)]
pub struct Sample {
    /// Columns that vary: name and unit.
    pub columns: Vec<(String, String)>,
    /// The labels of each column of labels, by column.
    pub words: Vec<Option<Vec<String>>>,
    /// A sample of the rows.
    pub rows: Vec<SampleRow>,
    /// What to show of the measured values, by observable.
    pub views: Vec<DataView>,
    /// What was assumed about the data file, and what looks like a mistake in it.
    pub notes: Vec<String>,
}

/// Measured values of one observable against one column, for a figure.
#[derive(Debug, Clone)]
pub struct DataView {
    /// `e_n`, `e_t` or `outcome`.
    pub observable: &'static str,
    /// The column along the x axis.
    pub column: String,
    /// A second column and the range of it that selects the rows; `None` for all rows.
    pub within: Option<(String, [f64; 2])>,
    /// Value of the column, base model and extended model there: the models' means over the rows whose values are
    /// nearest, weighted by distance, with the other inputs as measured. Empty for a column of words.
    pub curve: Vec<[f64; 3]>,
}

/// A row for figures.
#[derive(Debug, Clone)]
pub struct SampleRow {
    /// Whether the model file was not fitted to it.
    pub held_out: bool,
    /// Its cells, by column; the index of the label for a column of labels; NaN where blank.
    pub cells: Vec<f64>,
    /// Stated standard errors of `e_n` and `e_t`.
    pub errors: [Option<f64>; 2],
    /// `e_n`, `e_t` and share captured: measured, base model, extended model.
    pub values: [Option<[f64; 3]>; 3],
}
