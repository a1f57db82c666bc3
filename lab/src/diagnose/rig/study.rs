//! What all choices among explanations of a rig share: the readings, and the predictions of candidates.

use super::super::search::descend;
use super::addition::{RigAddition, moved};
use super::inputs::RigInputs;
use super::noise::Data;
use super::prediction_table::{PredictionTable, predict};
use crate::rig::{Forward, PredictedReading, PredictionError};

/// Distance of a number of the case over which its effect on the readings is taken as linear, in its
/// standard errors.
const LINEAR: f64 = 3.0;
/// First size of the simplex of a fit, and iterations a parameter.
const FIT_SIMPLEX: f64 = 0.04;
const FIT_ITERATIONS: u64 = 25;

/// The readings of a rig and the predictions of candidates.
pub(super) struct RigStudy<'a> {
    pub forward: &'a dyn Forward,
    pub data: Data,
    pub seed: u64,
    pub progress: &'a (dyn Fn(&str) + Sync),
    /// What varies over the impacts.
    pub inputs: RigInputs,
    /// Predictions of the candidates beside the base model.
    pub table: PredictionTable,
}

/// What the model of a rig predicts for all readings.
///
/// # Errors
/// Why it cannot decide an impact.
pub(in crate::diagnose) fn predictions(
    forward: &dyn Forward,
) -> Result<Vec<PredictedReading>, PredictionError> {
    predict(forward, &[])
}

/// The readings with the errors of the case, and their predictions by the base model.
///
/// # Errors
/// Why the base model cannot decide an impact.
pub(in crate::diagnose) fn readings(
    forward: &dyn Forward,
) -> Result<(Data, Vec<PredictedReading>), PredictionError> {
    let base = predictions(forward)?;
    let mut data = Data::new(forward.experiments(), &base);
    let prepared = data.prepare(&base);
    let mut moved = Vec::new();
    for (place, number) in forward.case_numbers().iter().enumerate() {
        let one = RigAddition::case(place, number.clone());
        let Some(axis) = one.axes.first() else {
            // A force is missing or not: no instrument errs.
            moved.push([prepared.clone(), prepared.clone()]);
            continue;
        };
        let at = |widths: f64| predict(forward, &[one.moved(&[axis.coordinate(widths)])]);
        moved.push([data.prepare(&at(-LINEAR)?), data.prepare(&at(LINEAR)?)]);
    }
    data.set_case_errors(&prepared, &moved, LINEAR);
    Ok((data, base))
}

impl<'a> RigStudy<'a> {
    /// The study of the readings of a forward model.
    ///
    /// # Errors
    /// Why the base model cannot decide an impact.
    pub fn new(
        forward: &'a dyn Forward,
        seed: u64,
        progress: &'a (dyn Fn(&str) + Sync),
    ) -> Result<Self, PredictionError> {
        let (data, base) = readings(forward)?;
        let inputs = RigInputs::new(forward);
        let table = PredictionTable::new(forward, &inputs, (&data, base), progress);
        Ok(Self { forward, data, seed, progress, inputs, table })
    }

    /// Log likelihood of the measured values with these additions [nats]; minus infinity where the
    /// model refuses an impact.
    pub fn score(&self, additions: &[RigAddition], weights: &[f64]) -> f64 {
        let Ok(predicted) = predict(self.forward, additions) else { return f64::NEG_INFINITY };
        self.score_of(&predicted, weights)
    }

    pub fn score_of(&self, predicted: &[PredictedReading], weights: &[f64]) -> f64 {
        self.data.score(&self.data.prepare(predicted), self.data.values(), weights)
    }

    /// All parameters fitted together, from their present values.
    pub fn fit(&self, additions: &[RigAddition], weights: &[f64]) -> Vec<RigAddition> {
        let start: Vec<f64> = additions.iter().flat_map(|addition| addition.at.clone()).collect();
        if start.is_empty() {
            return additions.to_vec();
        }
        let cost = |at: &[f64]| -self.score(&moved(additions, at), weights);
        let (at, _) = descend(cost, &start, FIT_SIMPLEX, FIT_ITERATIONS * start.len() as u64);
        moved(additions, &at)
    }
}
