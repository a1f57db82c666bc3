//! Diagnosis of a simulation from what the whole rig measures.
//!
//! Data flow: readings → predictions of every candidate at places of its range (`prediction_table`)
//! → search among explanations and their probabilities (`rig_search`, `choice`; both engines share
//! `explanation` and `explanations`) → draws of the parameters (`posterior`) → gain on held-out
//! experiments (`gain`) → record with the model file. The predictions come from a [`Forward`]:
//! particles followed anew or recorded impacts decided again. Candidates are those of the diagnosis of impacts.
//! Method and limits: `docs/how-to/rig-diagnosis.md`.

mod addition;
mod blame;
mod candidates;
mod choice;
mod form;
mod gain;
mod inputs;
mod next;
mod noise;
mod places;
mod posterior;
mod prediction_table;
mod proposals;
mod report;
mod rig_search;
mod scatter;
mod significance;
mod study;

pub use blame::{Blame, BlamedNumber, Parties};
pub use next::NextExperiment;
pub(super) use noise::Data as Readings;
pub use report::{KindErrors, RigDiagnosis, RigRow};
pub(super) use study::{predictions, readings};

use super::constants::THOROUGH_RIG;
use super::first_reasons;
use super::form_finding::places;
use super::reach::Reach;
use super::record::{FormPoint, Options};
use crate::dataset::RigMeasurements;
use crate::rig::{CaseNumber, CaseText, Forward, PredictionError};
use addition::{RigAddition, extended_text, moved};
use choice::{Named, RigChoice};
use gain::HeldOutExperiments;
use posterior::Posterior;
use study::RigStudy;

/// Why there is no diagnosis.
#[derive(Debug, thiserror::Error)]
pub enum RigError {
    /// Too few readings.
    #[error(
        "{usable} of {read} rows can be used; a diagnosis of a rig needs at least {LEAST_READINGS} readings. {reasons}"
    )]
    TooFew {
        /// Usable rows.
        usable: usize,
        /// Rows in the file.
        read: usize,
        /// Why the first rows were rejected.
        reasons: String,
    },
    /// The model cannot decide an impact of an experiment.
    #[error(transparent)]
    Undecided(#[from] PredictionError),
    /// A range for the next measurement of what is no number of the case.
    #[error(
        "the next experiment cannot vary `{0}`: it is no number of the case; write a dotted key, as particles.speed"
    )]
    NoNumber(String),
    /// The text of the base model cannot be edited.
    #[error("the model file cannot be extended: {0}")]
    Unextendable(String),
}

/// Least number of readings.
const LEAST_READINGS: usize = 3;

/// Diagnoses the readings of `forward` against the model file with the text `model`. `draws` model
/// files are drawn from the fit; `case` simulates experiments that nobody has made yet, where there
/// is one; `progress` is told each candidate.
///
/// # Errors
/// [`RigError`].
pub fn diagnose_rig(
    forward: &dyn Forward,
    data: &RigMeasurements,
    model: &str,
    options: &Options,
    draws: usize,
    case: Option<&CaseText>,
    progress: &(dyn Fn(&str) + Sync),
) -> Result<RigDiagnosis, RigError> {
    check(data, options, case)?;
    let study = RigStudy::new(forward, options.seed, progress)?;
    let all = vec![1.0; study.data.experiments];
    let valid = study.inputs.valid();
    let write = |additions: &[RigAddition]| extended_text(model, additions, &valid).ok();
    let mut choice = RigChoice::new(&study, THOROUGH_RIG);
    let mut posterior = Posterior::new(&study, &choice.additions(), &all);
    let held_out = HeldOutExperiments::new(&study, &choice, &posterior, &write)?;
    let mut refuted = Vec::new();
    if held_out.as_ref().is_some_and(HeldOutExperiments::is_worse) {
        // What unseen experiments refute is not named.
        refuted = choice.named.iter().map(|one| one.addition.name()).collect();
        choice = choice.without_causes();
        posterior = Posterior::default();
    }
    set_intervals(&mut choice.named, &posterior);
    let additions = blame::settled(&study, choice.additions(), &all)?;
    let text = extended_text(model, &additions, &valid);
    let text = text.map_err(|error| RigError::Unextendable(error.to_string()))?;
    let next = match case {
        Some(case) => next::next_experiments(&study, &choice, &posterior, (data, case), &options.reach)?,
        None => Vec::new(),
    };
    let drawn = posterior.draws(draws, options.seed);
    let draws = drawn.iter().filter_map(|at| write(&moved(&additions, at))).collect();
    let extended_case = case.and_then(|case| extended_case(case, &additions));
    choice.named.iter_mut().zip(additions).for_each(|(named, settled)| named.addition = settled);
    let found =
        report::RigFindings { study: &study, choice, refuted, held_out, text, extended_case, draws, next };
    Ok(found.record(data, options)?)
}

/// The text of the case with the numbers that were found wrong; `None` without such a number.
fn extended_case(case: &CaseText, additions: &[RigAddition]) -> Option<String> {
    let moves = additions.iter().filter_map(|one| one.case_number());
    let moves: Vec<(&CaseNumber, f64)> = moves.map(|(_, number, widths)| (number, widths)).collect();
    (!moves.is_empty()).then(|| case.extended(&moves, "extended.toml"))
}

/// Refuses too few readings, and a reach of something that is no number of the case.
fn check(data: &RigMeasurements, options: &Options, case: Option<&CaseText>) -> Result<(), RigError> {
    if data.count() < LEAST_READINGS {
        let reasons = first_reasons(&data.rejected);
        let usable = data.read - data.rejected.len();
        return Err(RigError::TooFew { usable, read: data.read, reasons });
    }
    let is_no_number = |one: &&Reach| case.is_some_and(|case| case.number(&one.name).is_none());
    match options.reach.iter().find(is_no_number) {
        Some(reach) => Err(RigError::NoNumber(reach.name.clone())),
        None => Ok(()),
    }
}

/// Sets the parameters' intervals, and the bands of closed forms, to those of the draws.
fn set_intervals(named: &mut [Named], posterior: &Posterior) {
    let mut first = 0;
    for Named { addition, line, .. } in named {
        let own = first..first + addition.axes.len();
        first = own.end;
        let of = |number: &dyn Fn(&RigAddition) -> f64| {
            let now = number(addition);
            let drawn = posterior.interval(|at| number(&addition.moved(&at[own.clone()])));
            let [low, high] = drawn.unwrap_or([now; 2]);
            [low.min(now), high.max(now)]
        };
        let value =
            |place: usize| move |one: &RigAddition| one.values().get(place).copied().unwrap_or(f64::NAN);
        let intervals = (0..addition.values().len()).map(|place| of(&value(place))).collect();
        let places = addition.as_form().map(|form| places(form.over.seen)).unwrap_or_default();
        let value_at = |at: f64| move |one: &RigAddition| one.value_of_form(at).unwrap_or(f64::NAN);
        let point = |at: f64| {
            let [low, high] = of(&value_at(at));
            let value = addition.value_of_form(at)?;
            (low.is_finite() && high.is_finite()).then_some(FormPoint { at, value, low, high })
        };
        *line = places.into_iter().filter_map(point).collect();
        addition.intervals = intervals;
    }
}
