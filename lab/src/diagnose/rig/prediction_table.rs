//! What every candidate predicts at places of its search range beside the base model, computed once.
//!
//! The predictions depend on the wall law but not on the measured values. The same table therefore
//! serves the search on all experiments, on every part of a cross-validation, and the data sets drawn
//! without an effect. Beside other additions a candidate is first looked at as if it changed the
//! predictions as it changes those of the base model; those that are promising are then computed.

use std::sync::Arc;

use rayon::prelude::*;

use super::addition::{RigAddition, apply_all};
use super::candidates::candidates;
use super::inputs::RigInputs;
use super::noise::{Data, PreparedReadings, WeightedValues};
use crate::rig::{Forward, PredictedReading, PredictionError, changed, slope};

/// A candidate at one place.
#[derive(Debug)]
pub(super) struct TabledPlace {
    pub at: Vec<f64>,
    pub prepared: Arc<PreparedReadings>,
}

/// A candidate with its places.
#[derive(Debug)]
pub(super) struct TabledCandidate {
    pub addition: RigAddition,
    pub places: Vec<TabledPlace>,
}

/// All candidates beside the base model.
#[derive(Debug)]
pub(super) struct PredictionTable {
    /// Predictions without a candidate.
    pub base: Vec<PredictedReading>,
    pub base_prepared: Arc<PreparedReadings>,
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
    let one = |experiment: usize| -> Result<Vec<PredictedReading>, PredictionError> {
        let mut predicted = forward.predict(experiment, &|model| apply_all(additions, model))?;
        change_case(forward, experiment, additions, &mut predicted);
        Ok(predicted)
    };
    let all = (0..forward.experiments().len()).into_par_iter().map(one).collect::<Result<Vec<_>, _>>()?;
    Ok(all.into_iter().flatten().collect())
}

/// Adds what numbers of the case change about the readings of an experiment under the base law.
pub(super) fn change_case(
    forward: &dyn Forward,
    experiment: usize,
    additions: &[RigAddition],
    predicted: &mut [PredictedReading],
) {
    let readings = &forward.experiments()[experiment].readings;
    for (place, _, widths) in additions.iter().filter_map(RigAddition::case_number) {
        let changes = forward.case_change(experiment, place, widths);
        for ((one, reading), [change, variance]) in predicted.iter_mut().zip(readings).zip(changes) {
            if one.value.is_finite() {
                let is_share = reading.quantity.is_share();
                one.value = changed(is_share, one.value, change);
                one.doubt += variance * slope(is_share, one.value).powi(2);
            }
        }
    }
}

impl PredictionTable {
    /// Computes the predictions of all candidates; those that the impacts refuse or that change nothing
    /// are left out.
    pub fn new(
        forward: &dyn Forward,
        inputs: &RigInputs,
        (data, base): (&Data, Vec<PredictedReading>),
        progress: &(dyn Fn(&str) + Sync),
    ) -> Self {
        let of = |addition: RigAddition| {
            let places = addition.places(addition.present(forward.base(0)));
            let at = |at: Vec<f64>| {
                let predicted = predict(forward, &[addition.moved(&at)]).ok()?;
                let same = |(a, b): (&PredictedReading, &PredictedReading)| {
                    a.value == b.value || a.value.is_nan() && b.value.is_nan()
                };
                let changed = !predicted.iter().zip(&base).all(same);
                changed.then(|| TabledPlace { at, prepared: Arc::new(data.prepare(&predicted)) })
            };
            let places: Vec<TabledPlace> = places.into_par_iter().filter_map(at).collect();
            progress(&addition.name());
            (!places.is_empty()).then_some(TabledCandidate { addition, places })
        };
        let candidates = candidates(forward, inputs, data).into_par_iter().filter_map(of).collect();
        let base_prepared = Arc::new(data.prepare(&base));
        Self { base, base_prepared, candidates }
    }
}

impl TabledCandidate {
    /// The log likelihood of its best place [nats].
    pub fn best(&self, data: &Data, values: &WeightedValues<'_>) -> f64 {
        let scores = self.places.iter().map(|place| data.score_weighted(&place.prepared, values));
        scores.fold(f64::NEG_INFINITY, f64::max)
    }

    /// What the number of its parameters gains by chance [nats].
    pub fn cost(&self) -> f64 {
        self.addition.axes.len() as f64
    }
}
