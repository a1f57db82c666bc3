//! Forward models of a rig: what a wall law predicts for what the whole rig measures.
//!
//! A [`Forward`] predicts every reading of [`crate::dataset::RigMeasurements`] for a changed wall
//! law. [`SimulatedRig`] follows particles as `nearwall simulate` does; [`ReplayedRig`] decides
//! again the impacts that OpenFOAM recorded. Both hand their hits to a [`tally`], which sums them
//! up to the observables. `diagnose::rig` compares the predictions with the measurements.
//!
//! For forecasts, [`add_capture_bands`] gives what models drawn from a fit capture, and
//! [`sensitivity`] the numbers on which captures depend.

mod captures;
mod case_change;
mod case_number;
mod case_text;
mod draws;
mod missing_force;
mod noisy_change;
mod number_name;
mod recorded_flight;
mod recording;
mod replay_error;
mod replayed;
pub mod sensitivity;
mod simulated;
pub mod tally;

pub use captures::{Captures, Flights, run_captures};
pub use case_change::{FARTHEST, PRESENT, changed, slope};
pub use case_number::CaseNumber;
pub use case_text::{CaseText, SettingError, SettingFault};
pub use draws::{Band, CaptureBand, DrawnModels, DrawsError, add_capture_bands};
pub(crate) use number_name::name_of;
pub use recording::ReplayAccount;
pub use replay_error::ReplayError;
pub use replayed::ReplayedRig;
pub use simulated::{RigCase, SimulatedRig};
pub use tally::PredictedReading;
pub(crate) use tally::away_from_edges;

use crate::dataset::Experiment;
use crate::simulate::SimulationError;
use nearwall::effect::CurveInput;
use nearwall::model::Model;

/// Why a model cannot predict what a rig measures.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PredictionError {
    /// A particle cannot be followed, or an impact cannot be decided.
    #[error("{place}: {reason}")]
    Impact {
        /// File, line and name of the experiment, or the line of a record.
        place: String,
        /// The reason.
        reason: String,
    },
    /// The case of an experiment cannot be made.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The case cannot have a value of its sweep.
    #[error(transparent)]
    Sweep(#[from] SimulationError),
    /// No particle of a case can be used, for this reason.
    #[error("{0}")]
    NoParticle(String),
}

impl PredictionError {
    fn new(place: &str, reason: &impl std::fmt::Display) -> Self {
        Self::Impact { place: place.to_owned(), reason: reason.to_string() }
    }
}

/// A change of an experiment's base model.
pub type ModelChange<'a> = dyn Fn(&Model) -> Model + Sync + 'a;

/// A forward model.
pub trait Forward: Sync {
    /// The experiments, in the order of the predictions.
    fn experiments(&self) -> &[Experiment];

    /// The base model of an experiment.
    fn base(&self, experiment: usize) -> &Model;

    /// What the changed model predicts for the readings of an experiment, in their order.
    ///
    /// # Errors
    /// [`PredictionError`] where the changed model cannot decide an impact.
    fn predict(
        &self,
        experiment: usize,
        change: &ModelChange<'_>,
    ) -> Result<Vec<PredictedReading>, PredictionError>;

    /// Most causes that one diagnosis may name: one where predictions are only approximate beside
    /// the law of the record.
    fn most_causes(&self) -> usize {
        usize::MAX
    }

    /// The numbers of the case that may be wrong: none where particles cannot be followed anew.
    fn case_numbers(&self) -> &[CaseNumber] {
        &[]
    }

    /// How the base law's readings of an experiment change with such a number moved by so many of its
    /// standard errors, and the variance of that: of a share in log odds. Empty where nothing is known.
    fn case_change(&self, _experiment: usize, _number: usize, _widths: f64) -> Vec<[f64; 2]> {
        Vec::new()
    }

    /// The value of an input or group over the first impacts of an experiment under its base model, NaN where it has
    /// none, with weights [input's unit, 1].
    fn input_values(&self, experiment: usize, input: CurveInput) -> Vec<(f64, f64)>;
}
