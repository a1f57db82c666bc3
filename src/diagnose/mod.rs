//! Diagnosis: the effects that a model lacks to explain measured impacts, the extended model and its gain.
//!
//! Data flow: measurements → [`Model::resolve`] on every row → residuals → candidates, fitted and cross-validated →
//! forward selection → extended model → gain on held-out rows → record. Effects are known only through their
//! [`crate::effect::EffectInfo`], so every effect of the list is a candidate. Method and limits: `docs/diagnosis.md`.
//! [`comparison`] ranks several models with the same likelihood.

mod advice;
mod candidate;
pub mod comparison;
mod cross_validation;
mod curve;
mod data_split;
mod data_view;
mod evaluation;
mod extend;
mod finding;
mod forecast;
mod gain;
mod hypothesis;
mod interval;
mod likelihood;
mod model_selection;
mod observable;
mod part;
mod record;
mod search;
mod smooth;
mod verdict;

pub use record::{
    Alternative, Calibration, DataView, Diagnosis, Errors, Estimate, Finding, Fit, FitTest, FittedCurve,
    Gain, GroupsFound, LargeMisfit, Measure, Misfit, NotExamined, Options, Rival, Rows, Sample, SampleRow,
    ScatterFound, Unexplained,
};

use crate::dataset::{BadRow, Measurements};
use crate::impact::{INPUTS, Impact, Input};
use crate::model::Model;
use data_split::DataSplit;
use hypothesis::Hypothesis;
use model_selection::{Selection, select};
use observable::Observable;

/// Why there is no diagnosis.
#[derive(Debug, thiserror::Error)]
pub enum DiagnosisError {
    /// Too few usable rows.
    #[error("{used} of {read} rows can be used; a diagnosis needs at least {least}. {reasons}")]
    TooFewRows {
        /// Usable rows.
        used: usize,
        /// Rows in the file.
        read: usize,
        /// Rows needed.
        least: usize,
        /// Why the first rows were rejected.
        reasons: String,
    },
    /// The text of the base model cannot be edited.
    #[error("the model file cannot be extended: {0}")]
    Unextendable(String),
}

/// Least number of rows.
const LEAST_ROWS: usize = 8;
/// Captures of an average of more impacts than this are one observation.
const MOST_UNFOLDED: f64 = 1000.0;
/// Bounds of a plausible input [SI units], far beyond any laboratory; the lower one for inputs that laws divide by.
const LARGEST_INPUT: f64 = 1e12;
const SMALLEST_DIVISOR: f64 = 1e-15;
/// Inputs that laws divide by.
const DIVISORS: [&str; 5] = ["v_n", "v_t", "d", "T_p", "T_w"];

/// Diagnoses `data` against the model `base` whose file has the text `text`. `progress` is called after each candidate.
/// Returns the diagnosis and the text of the extended model.
///
/// # Errors
/// [`DiagnosisError`].
pub fn diagnose(
    base: &Model,
    text: &str,
    data: &Measurements,
    options: &Options,
    progress: &(dyn Fn() + Sync),
) -> Result<(Diagnosis, String), DiagnosisError> {
    let data = plausible(base, data);
    let (used, read) = (data.rows.len(), data.read);
    if used < LEAST_ROWS {
        let reason = |bad: &BadRow| format!("Line {}: {}.", bad.line, bad.reason);
        let reasons = data.rejected.iter().take(3).map(reason).collect::<Vec<_>>().join(" ");
        return Err(DiagnosisError::TooFewRows { used, read, least: LEAST_ROWS, reasons });
    }
    let split = DataSplit::new(base, data.unfolded(MOST_UNFOLDED), options.seed);
    let plain = Hypothesis::base(&split);
    let Selection { hypothesis, discoveries, first_round } = select(&plain, options.level, progress);

    let fine = split.fine(hypothesis.parts.iter().any(|fitted| fitted.part.is_stochastic()));
    let plain = Hypothesis { data: &fine, ..plain };
    let mut hypothesis = Hypothesis { data: &fine, discrepancy: None, ..hypothesis };
    hypothesis.fit(&fine.fit);
    interval::set_intervals(&mut hypothesis, &fine.fit);

    let mut diagnosis = verdict::record(&hypothesis, &discoveries, options);
    diagnosis.rows = Rows { read, used, held_out: fine.held_out.len(), rejected: data.rejected };
    diagnosis.misfit = verdict::misfit(&hypothesis, &first_round, options.level);
    diagnosis.base = gain::errors(&gain::evaluate(&plain, &fine.all()));
    diagnosis.sample = gain::sample(&plain, &hypothesis);
    diagnosis.sample.views = data_view::views([&plain, &hypothesis], &diagnosis.findings);
    diagnosis.sample.notes.clone_from(&data.notes);
    if !(diagnosis.findings.is_empty() && diagnosis.calibration.is_empty()) {
        let [before, after] = [&plain, &hypothesis].map(|h| gain::evaluate(h, &fine.held_out));
        let of = |observable| gain::gain(&before, &after, observable, options.seed);
        diagnosis.gains = Observable::ALL.into_iter().filter_map(of).collect();
        let first = diagnosis.findings.first().map_or("", |finding| finding.observable);
        diagnosis.gain = diagnosis.gains.iter().find(|gain| gain.observable == first).cloned();
    }
    diagnosis.verdict = verdict::sentences(&diagnosis);
    let notes = verdict::notes_for_model(&diagnosis);
    let extended = extend::extended(text, &hypothesis, &notes)
        .map_err(|error| DiagnosisError::Unextendable(error.to_string()))?;
    Ok((diagnosis, extended))
}

/// The data without rows that the base model refuses, as at a temperature outside a property's range, and without
/// implausible rows.
fn plausible(base: &Model, data: &Measurements) -> Measurements {
    data.without(|row| {
        let refused = base.check(row.wall, &row.impact).err().map(|error| error.to_string());
        refused.or_else(|| implausible(&row.impact))
    })
}

/// The input with an implausible value: its squares would overflow in a law and invalidate all sums over rows.
fn implausible(impact: &Impact) -> Option<String> {
    INPUTS.iter().find_map(|Input { name, unit, value, .. }| {
        let value = value(impact);
        let tiny = DIVISORS.contains(name) && value != 0.0 && value.abs() < SMALLEST_DIVISOR;
        (tiny || value.abs() > LARGEST_INPUT)
            .then(|| format!("{name} = {value:e} {unit} is not plausible; check the unit"))
    })
}
