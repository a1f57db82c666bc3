//! Forward models of a rig: what a wall law predicts for what the whole rig measures.
//!
//! A [`Forward`] predicts every reading of [`crate::dataset::RigMeasurements`] for a changed wall law. [`Simulated`] follows
//! particles as `nearwall simulate` does; [`Replayed`] decides again the impacts that OpenFOAM recorded. Both hand their hits to a
//! [`tally`], which sums them up to the observables. `diagnose::rig` compares the predictions with the measurements.
//!
//! For forecasts, [`add_capture_bands`] gives what models drawn from a fit capture, and [`sensitivity`] the numbers on which captures
//! depend.

mod captures;
mod case_text;
mod draws;
mod recorded_flight;
mod replayed;
pub mod sensitivity;
mod simulated;
pub mod tally;

pub use captures::{Captures, Flights, run_captures};
pub use case_text::{CaseText, SettingError};
pub use draws::{Band, CaptureBand, DrawnModels, DrawsError, add_capture_bands};
pub use replayed::{ReplayAccount, ReplayError, Replayed};
pub use simulated::{RigCase, Simulated, particles_for};
pub use tally::Predicted;

use crate::dataset::Experiment;
use nearwall::model::Model;

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
    /// Why the changed model cannot decide an impact.
    fn predict(&self, experiment: usize, change: &ModelChange<'_>) -> Result<Vec<Predicted>, String>;

    /// Most causes that one diagnosis may name: one where predictions are only approximate beside the law of the record.
    fn most_causes(&self) -> usize {
        usize::MAX
    }

    /// The value of an input over the first impacts of an experiment, with weights [input's unit, 1].
    fn input_values(&self, experiment: usize, input: usize) -> Vec<(f64, f64)>;
}
