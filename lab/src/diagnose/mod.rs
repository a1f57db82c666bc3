//! Diagnosis: the effects that a model lacks to explain measured impacts, the extended model and its gain.
//!
//! Data flow: measurements → [`Model::resolve`] on every row → residuals → candidates, tested and
//! fitted → forward selection → extended model → gain of its file on held-out rows → record.
//! Effects are known only through their [`nearwall::effect::EffectInfo`], so every effect of the
//! list is a candidate. Method and limits: `docs/how-to/diagnosis.md`. [`ImpactDiagnosis`] does all this
//! for the files of a user; [`comparison`] ranks several models with the same likelihood,
//! [`benchmark`] scores laws on all measured sets.

mod advice;
pub mod benchmark;
mod beside_laws;
mod candidate;
mod candidate_list;
mod chi_square;
mod choice;
mod closed_form;
mod column_product;
pub mod comparison;
mod constant_capture;
mod constants;
mod copies;
mod covariance;
mod curve;
mod data_split;
mod data_view;
mod draws;
mod evaluation;
mod explanation;
mod explanations;
mod extend;
mod few_rows;
mod finding;
mod fitted_rows;
mod fitting;
mod forecast;
mod form_finding;
mod gain;
mod goodness_of_fit;
mod ground;
mod group_column;
mod groups;
mod hidden_laws;
mod hypothesis;
mod impact_diagnosis;
mod impact_search;
mod inexact;
mod input_error;
mod instrument;
mod interval;
mod likelihood;
mod missing_inputs;
mod named_causes;
mod observable;
mod part;
mod probability;
mod profile;
mod reach;
mod reading;
mod record;
pub mod rig;
mod rounding;
mod score_test;
mod search;
mod sentences;
mod shapes;
mod shared_error;
mod skew;
mod slip;
mod smooth;
mod study;
mod unselected;
mod verdict;

pub use impact_diagnosis::{FileDiagnosisError, ImpactDiagnosis};
pub use reach::{Reach, ReachError};
pub use record::{
    Alternative, Calibration, CauseCurve, CauseForm, CauseSurface, DataView, Diagnosis, Errors, Estimate,
    ExplanationFound, Finding, Fit, FitTest, FormPoint, Gain, GroupsFound, LargeMisfit, Misfit,
    NextMeasurement, NotExamined, Options, OtherForm, Rival, Rows, Sample, SampleRow, ScatterFound,
    Unexplained,
};
pub use unselected::read_measurements;

use crate::dataset::{BadRow, Measurement, Measurements};
use choice::Task;
use constants::{LEAST_ROWS, THOROUGH};
use data_split::DataSplit;
pub use fitted_rows::FittedRows;
use groups::GroupColumn;
use hypothesis::Hypothesis;
use nearwall::impact::{INPUTS, Impact, Input};
use nearwall::model::Model;
use observable::Observable;
use study::Study;

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
    /// A range for the next measurement of something that is no input.
    #[error("the next measurement cannot vary `{name}`: the inputs of an impact are {inputs}")]
    NoInput {
        /// The name.
        name: String,
        /// The names of the inputs.
        inputs: String,
    },
}

/// Bounds of a plausible input [SI units], far beyond any laboratory; the lower one for inputs that laws divide by.
const LARGEST_INPUT: f64 = 1e12;
const SMALLEST_DIVISOR: f64 = 1e-15;
/// Inputs that laws divide by.
const DIVISORS: [&str; 5] = ["v_n", "v_t", "d", "T_p", "T_w"];

/// Diagnoses `data` against the model `base` whose file has the text `text`. `progress` is told each candidate.
/// Returns the diagnosis and the text of the extended model.
///
/// # Errors
/// [`DiagnosisError`].
pub fn diagnose(
    base: &Model,
    text: &str,
    data: &Measurements,
    options: &Options,
    progress: &(dyn Fn(&str) + Sync),
) -> Result<(Diagnosis, String), DiagnosisError> {
    let (diagnosis, extended, _) = diagnose_with_draws(base, text, data, options, 0, progress)?;
    Ok((diagnosis, extended))
}

/// As [`diagnose`], with the texts of `draws` model files whose parameters are drawn from the fit;
/// none where nothing is fitted.
///
/// # Errors
/// [`DiagnosisError`].
pub fn diagnose_with_draws(
    base: &Model,
    text: &str,
    data: &Measurements,
    options: &Options,
    draws: usize,
    progress: &(dyn Fn(&str) + Sync),
) -> Result<(Diagnosis, String, Vec<String>), DiagnosisError> {
    if let Some(reach) = options.reach.iter().find(|one| INPUTS.iter().all(|input| input.name != one.name)) {
        let inputs = INPUTS.map(|input| input.name).join(", ");
        return Err(DiagnosisError::NoInput { name: reach.name.clone(), inputs });
    }
    let data = usable(base, data)?;
    let groups = GroupColumn::all(&data, options.group.as_deref());
    let whole = DataSplit::new(base, &data, &groups);
    let groups = [GroupColumn::noticed(&data, &groups), groups].concat();
    let task = Task { text, groups: &groups, effort: THOROUGH, progress };
    let study = Study::new(&whole, task, options.seed);
    let found = examined(&study, &data, &whole, task, options, draws)?;
    if !is_worse(&found.0) {
        return Ok(found);
    }
    // What unseen rows refute is not named.
    let Diagnosis { findings, gain, gains, .. } = found.0;
    let (mut diagnosis, extended, draws) =
        examined(&study.without_causes(), &data, &whole, task, options, draws)?;
    diagnosis.refuted = findings.into_iter().map(|finding| finding.cause).collect();
    (diagnosis.gain, diagnosis.gains) = (gain, gains);
    diagnosis.verdict = sentences::sentences(&diagnosis);
    Ok((diagnosis, extended, draws))
}

/// Whether the model with its causes predicts rows that it has not seen worse than without.
fn is_worse(diagnosis: &Diagnosis) -> bool {
    let worse = |gain: &Gain| gain.log_score_after < gain.log_score_before;
    !diagnosis.findings.is_empty() && diagnosis.gain.as_ref().or(diagnosis.gains.first()).is_some_and(worse)
}

/// The record, the extended model and drawn ones of a study.
fn examined(
    study: &Study,
    data: &Measurements,
    whole: &DataSplit,
    task: Task<'_>,
    options: &Options,
    draws: usize,
) -> Result<(Diagnosis, String, Vec<String>), DiagnosisError> {
    let fine = study.file.fine();
    let hypothesis = study.file.fitted(&fine);
    let plain = Hypothesis::base(&fine);
    let models = [&plain, &hypothesis];
    let mut diagnosis = verdict::record(&hypothesis, &study.choice, options);
    diagnosis.rows = rows(data, study);
    diagnosis.fit = goodness_of_fit::fit(&plain, &hypothesis, study.choice.structure);
    diagnosis.groups = study.choice.groups_found();
    if diagnosis.undecided.is_empty() {
        diagnosis.undecided = verdict::possible_causes(&diagnosis.fit, &study.choice);
    }
    diagnosis.misfit = verdict::misfit(&hypothesis, &study.choice, options.level);
    diagnosis.base = gain::errors(&gain::evaluate(&plain, &fine.all()), &data.unselected);
    let views = data_view::views(models, &diagnosis.findings);
    diagnosis.sample = Sample { views, notes: data.notes.clone(), ..gain::sample(&plain, &hypothesis) };
    let extended = extend::extended(task.text, &hypothesis).map_err(unextendable)?;
    if !diagnosis.findings.is_empty() || !diagnosis.calibration.is_empty() {
        let measured = study.held_out(data, whole, task, models, &extended).map_err(unextendable)?;
        let noise = |observable| gain::noise_floor(data, hypothesis.scatter, observable);
        let of = |observable| measured.gain(observable, noise(observable), options.seed);
        set_gains(&mut diagnosis, Observable::ALL.into_iter().filter_map(of).collect());
    }
    diagnosis.verdict = sentences::sentences(&diagnosis);
    if hypothesis.curves.iter().any(|curve| !extend::contains(&extended, curve, &fine)) {
        diagnosis.verdict +=
            " extended.toml lacks the curve over a column whose name cannot be that of an input: rename it.";
    }
    let is_changed = extended.trim_end() != task.text.trim_end();
    let fitted = is_changed.then(|| FittedRows::add_to(&extended, data, &fine.fit));
    let extended = fitted.transpose().map_err(unextendable)?.unwrap_or(extended);
    let draws = draws::draws(task.text, &hypothesis, draws, options.seed).map_err(unextendable)?;
    Ok((diagnosis, extended, draws))
}

/// The gains in each observable, and that of the first finding.
fn set_gains(diagnosis: &mut Diagnosis, gains: Vec<Gain>) {
    let first = diagnosis.findings.first().map_or("", |finding| finding.observable);
    diagnosis.gain = gains.iter().find(|gain| gain.observable == first).cloned();
    diagnosis.rows.held_out = gains.iter().map(|gain| gain.held_out_rows).max().unwrap_or(0);
    diagnosis.gains = gains;
}

fn unextendable(error: impl std::fmt::Display) -> DiagnosisError {
    DiagnosisError::Unextendable(error.to_string())
}

/// The data without rows that the base model refuses, as at a temperature outside a property's range, and without
/// implausible rows and copies.
///
/// # Errors
/// [`DiagnosisError::TooFewRows`].
fn usable(base: &Model, data: &Measurements) -> Result<Measurements, DiagnosisError> {
    let data = copies::without_copies(&data.without(|row| fault(base, row)));
    if data.rows.len() < LEAST_ROWS {
        let (used, read) = (data.rows.len(), data.read);
        let reasons = first_reasons(&data.rejected);
        return Err(DiagnosisError::TooFewRows { used, read, least: LEAST_ROWS, reasons });
    }
    Ok(data)
}

/// Why the first rows were rejected.
fn first_reasons(rejected: &[BadRow]) -> String {
    let reason = |bad: &BadRow| format!("Line {}: {}.", bad.line, bad.reason.trim_end_matches('.'));
    rejected.iter().take(3).map(reason).collect::<Vec<_>>().join(" ")
}

/// Rows read and used.
fn rows(data: &Measurements, study: &Study) -> Rows {
    let selected = data.rows.len();
    let used = selected + data.unselected.rows;
    Rows {
        read: data.read,
        used,
        selected: (selected < used).then_some(selected),
        held_out: 0,
        held_out_lines: study.unseen_lines(data),
        rejected: data.rejected.clone(),
    }
}

/// Why a row cannot be used with this base model.
fn fault(base: &Model, row: &Measurement) -> Option<String> {
    let refused = base.check(row.wall, &row.impact).err().map(|error| error.to_string());
    refused.or_else(|| implausible(&row.impact))
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
