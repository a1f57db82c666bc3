//! Models ranked on the readings of a rig, which a case simulates with each of them.
//!
//! All models follow the same particles with the same random numbers. The likelihood is that of
//! `nearwall diagnose --case`: errors of counts, stated errors, scatter between runs, and the errors
//! of the case's own numbers, over which it is averaged. The effect of the latter is that on the
//! first model's readings.

use super::super::rig::{Readings, predictions, readings};
use super::bootstrap::Bootstrap;
use super::measure::{ComparisonMeasure, MEASURES, Totals};
use super::record::{self, Comparison, GroupedRows, ModelRows};
use crate::dataset::RigMeasurements;
use crate::rig::{CaseText, PredictedReading, PredictionError, RigCase, SettingError, SimulatedRig};
use nearwall::input::Document;

/// Least number of readings of a comparison.
const LEAST_READINGS: usize = 3;

/// Why models cannot be compared on a rig.
#[derive(Debug, thiserror::Error)]
pub enum RigComparisonError {
    /// Too few usable readings.
    #[error("{usable} usable readings; a comparison needs at least {LEAST_READINGS}")]
    TooFew {
        /// Usable readings.
        usable: usize,
    },
    /// The case cannot be read with a model, or with the settings of an experiment.
    #[error("{model}: {error}")]
    Setting {
        /// The model file.
        model: String,
        /// The reason.
        error: Box<SettingError>,
    },
    /// A model cannot decide an impact.
    #[error("{model}: {error}")]
    Prediction {
        /// The model file.
        model: String,
        /// The reason.
        error: Box<PredictionError>,
    },
}

/// Ranks models, two or more, by the log likelihood of the readings `data` of the rig `case`; `progress` is told
/// each model. The same seed gives the same bytes.
///
/// # Errors
/// [`RigComparisonError`].
pub fn compare_rig(
    case: &CaseText,
    data: &RigMeasurements,
    models: &[Document],
    seed: u64,
    progress: &(dyn Fn(&str) + Sync),
) -> Result<Comparison, RigComparisonError> {
    if data.count() < LEAST_READINGS {
        return Err(RigComparisonError::TooFew { usable: data.count() });
    }
    let mut first: Option<Readings> = None;
    let mut totals = Vec::new();
    for model in models {
        let name = || model.name().to_owned();
        let cases = case.clone().with_model(model.clone()).and_then(|text| RigCase::all(&text, data));
        let cases =
            cases.map_err(|error| RigComparisonError::Setting { model: name(), error: Box::new(error) })?;
        let of_model = |error| RigComparisonError::Prediction { model: name(), error: Box::new(error) };
        let forward = SimulatedRig::new(&cases).map_err(of_model)?;
        let (readings, predicted) = match first.take() {
            Some(readings) => (readings, predictions(&forward).map_err(of_model)?),
            None => readings(&forward.with_told_numbers()).map_err(of_model)?,
        };
        totals.push(scored(&readings, &predicted));
        first = Some(readings);
        progress(model.name());
    }
    let groups = data.experiments.len();
    let bootstrap = Bootstrap::new(&totals, groups, seed);
    let names: Vec<&str> = models.iter().map(Document::name).collect();
    let used = data.count();
    let read = used + data.rejected.len();
    let rows = GroupedRows { read, selected: None, used, groups, group_by: "experiment" };
    let (of_model, scatter) = (vec![ModelRows::default(); models.len()], vec![[0.0; 2]; models.len()]);
    Ok(record::comparison(&names, &bootstrap, rows, of_model, scatter, seed))
}

/// Sum and weight of each measure, by experiment.
fn scored(readings: &Readings, predicted: &[PredictedReading]) -> Totals {
    let scores = readings.shares(&readings.prepare(predicted), &vec![1.0; readings.experiments]);
    let mut of_group = vec![[[0.0; 2]; MEASURES]; readings.experiments];
    for (group, score) in of_group.iter_mut().zip(scores) {
        group[ComparisonMeasure::LogLikelihood as usize][0] = score;
    }
    for (datum, one) in readings.readings.iter().zip(predicted) {
        let group = &mut of_group[datum.experiment];
        group[ComparisonMeasure::LogLikelihood as usize][1] += 1.0;
        // Where nothing arrives, there is no value.
        if one.value.is_finite() {
            let measure = match readings.kinds[datum.kind] {
                "mean_e_n" => ComparisonMeasure::NormalRestitution,
                "mean_e_t" => ComparisonMeasure::TangentialRestitution,
                _ => ComparisonMeasure::Share,
            };
            let [sum, weight] = &mut group[measure as usize];
            (*sum, *weight) = (*sum + (datum.value - one.value).powi(2), *weight + 1.0);
        }
    }
    Totals { of_group }
}
