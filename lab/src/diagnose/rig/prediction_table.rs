//! What every candidate predicts at places of its search range, computed once for all uses.
//!
//! The predictions depend on the wall law but not on the measured values. The same table therefore
//! serves the test of the data, of thousands of data sets drawn without an effect, of resampled
//! experiments and of every part of a cross-validation.

use rayon::prelude::*;

use super::addition::{RigAddition, apply_all};
use super::noise::{Data, PreparedReadings, ReadingValues};
use crate::rig::{Forward, PredictedReading, PredictionError};

/// A candidate at one place.
#[derive(Debug)]
pub(super) struct TabledPlace {
    pub at: Vec<f64>,
    pub prepared: PreparedReadings,
}

/// A candidate with its places.
#[derive(Debug)]
pub(super) struct TabledCandidate {
    pub addition: RigAddition,
    pub places: Vec<TabledPlace>,
}

/// All candidates beside what a model already has.
#[derive(Debug)]
pub(super) struct PredictionTable {
    /// Predictions without a candidate.
    pub base: Vec<PredictedReading>,
    pub base_prepared: PreparedReadings,
    pub candidates: Vec<TabledCandidate>,
}

/// Predictions of all readings by the base model with additions.
///
/// # Errors
/// Why an impact cannot be decided.
pub(super) fn predict(
    forward: &dyn Forward,
    additions: &[RigAddition],
) -> Result<Vec<PredictedReading>, PredictionError> {
    let one = |experiment: usize| forward.predict(experiment, &|model| apply_all(additions, model));
    let all = (0..forward.experiments().len()).into_par_iter().map(one).collect::<Result<Vec<_>, _>>()?;
    Ok(all.into_iter().flatten().collect())
}

impl PredictionTable {
    /// Computes the predictions of all candidates beside `additions`; those that the impacts refuse
    /// or that change nothing are left out.
    ///
    /// # Errors
    /// Why the model with the additions cannot decide an impact.
    pub fn new(
        forward: &dyn Forward,
        data: &Data,
        additions: &[RigAddition],
        candidates: Vec<RigAddition>,
        progress: &(dyn Fn() + Sync),
    ) -> Result<Self, PredictionError> {
        let base = predict(forward, additions)?;
        let of = |addition: RigAddition| {
            let places = addition.places(addition.present(forward.base(0)));
            let at = |at: Vec<f64>| {
                let mut all = additions.to_vec();
                all.push(addition.moved(&at));
                let predicted = predict(forward, &all).ok()?;
                let changed = predicted
                    .iter()
                    .zip(&base)
                    .any(|(a, b)| a.value != b.value && !(a.value.is_nan() && b.value.is_nan()));
                changed.then(|| TabledPlace { at, prepared: data.prepare(&predicted) })
            };
            let places: Vec<TabledPlace> = places.into_par_iter().filter_map(at).collect();
            progress();
            (!places.is_empty()).then_some(TabledCandidate { addition, places })
        };
        let candidates = candidates.into_par_iter().filter_map(of).collect();
        let base_prepared = data.prepare(&base);
        Ok(Self { base, base_prepared, candidates })
    }
}

impl TabledCandidate {
    /// The best place and its log likelihood [nats].
    pub fn best(&self, data: &Data, values: &ReadingValues, weights: &[f64]) -> (f64, &TabledPlace) {
        let weighted = data.weighted(values, weights);
        let scored = self.places.iter().map(|place| (data.score_weighted(&place.prepared, &weighted), place));
        scored.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::NEG_INFINITY, &self.places[0]))
    }

    /// What the number of its parameters gains by chance [nats].
    pub fn cost(&self) -> f64 {
        self.addition.axes.len() as f64
    }
}
