//! The gain on experiments that no choice and no fit has seen.
//!
//! Experiments are held out as a whole. For each part of them, causes are chosen and fitted on the
//! others, the model file is written and read again, and predicts the part. The
//! predictions of the candidates were computed once for all parts; they do not depend on the data.
//!
//! Whether unseen experiments refute what is named is asked of all explanations of the others, each with its
//! probability `p_k`: `ln Σ p_k exp(l_k)`, with `l_k = ln P(all | k) - ln P(others | k)`, beside `l` of the base
//! model. Parts that take different causes for the most probable one do not refute what they share.

use super::super::constants::QUICK_RIG;
use super::super::data_split::shuffled;
use super::super::explanations::{Explanations, FoundExplanation};
use super::super::gain::{CROSS_VALIDATED, SHARED_FITS, bootstrap, student_interval, sums_by_unit};
use super::super::part::{LawParameter, Part};
use super::super::record::Gain;
use super::addition::{Kind, RigAddition, moved, shapes};
use super::blame::settled;
use super::choice::RigChoice;
use super::noise::{FittedScatter, PreparedReadings};
use super::posterior::Posterior;
use super::prediction_table::change_case;
use super::rig_search::RigExplanation;
use super::study::RigStudy;
use crate::rig::{PredictedReading, PredictionError, SettingError};
use nearwall::model::Model;

/// Parts of the cross-validation; with as many experiments or fewer each is left out in turn.
const EXPERIMENT_PARTS: usize = 6;
/// Least number of experiments for a gain.
const LEAST_EXPERIMENTS: usize = 4;

/// Predictions of experiments by models that have not seen them.
pub(super) struct HeldOutExperiments {
    /// By reading: the base model and the extended one.
    pub predicted: Vec<[PredictedReading; 2]>,
    /// Log likelihood of the held-out experiments averaged over all explanations of the others, over that of the base
    /// model [nats].
    lead: f64,
}

impl HeldOutExperiments {
    /// Cross-validates a choice. `posterior`, the draws of the whole choice, serves as places of a fit.
    /// `write` gives the text of a model file with additions. `None` with too few experiments.
    ///
    /// # Errors
    /// Why a model cannot decide an impact.
    pub fn new(
        study: &RigStudy<'_>,
        whole: &RigChoice,
        posterior: &Posterior,
        write: &dyn Fn(&[RigAddition]) -> Option<String>,
    ) -> Result<Option<Self>, PredictionError> {
        let count = study.data.experiments;
        if count < LEAST_EXPERIMENTS || whole.named.is_empty() {
            return Ok(None);
        }
        let order = shuffled(count, study.seed);
        let parts = EXPERIMENT_PARTS.min(count);
        let mut predicted: Vec<[PredictedReading; 2]> =
            study.table.base.iter().map(|one| [*one, *one]).collect();
        let mut lead = 0.0;
        for part in 0..parts {
            let mut weights = vec![1.0; count];
            order.iter().skip(part).step_by(parts).for_each(|&one| weights[one] = 0.0);
            let (explanations, visited) = whole.again(study, QUICK_RIG, &weights);
            let additions = fitted_again(study, whole, posterior, explanations.best_additions(), &weights);
            let additions = settled(study, additions, &weights)?;
            let text = write(&additions).filter(|_| !additions.is_empty());
            let file = text.map(|text| Model::from_toml("extended.toml", &text).map_err(SettingError::from));
            let after = file.transpose()?.map(|file| predict_file(study, &file, &additions)).transpose()?;
            lead += lead_of(study, &explanations, &visited, after.as_deref(), &weights);
            let Some(after) = after else { continue };
            for (index, datum) in study.data.readings.iter().enumerate() {
                if weights[datum.experiment] == 0.0 {
                    predicted[index][1] = after[index];
                }
            }
            (study.progress)("experiments held out");
        }
        Ok(Some(Self { predicted, lead }))
    }

    /// Whether experiments that the explanations have not seen are predicted worse than by the base model.
    pub fn is_worse(&self) -> bool {
        self.lead < 0.0
    }

    /// The gains in all kinds of readings that enough experiments have.
    pub fn gains(&self, study: &RigStudy<'_>) -> Vec<Gain> {
        (0..study.data.kinds.len()).filter_map(|kind| self.gain(study, kind)).collect()
    }

    /// The gain in one kind of readings; `None` where too few experiments have it.
    fn gain(&self, study: &RigStudy<'_>, kind: usize) -> Option<Gain> {
        let data = &study.data;
        let of_kind = |(index, datum): (usize, &super::noise::Datum)| {
            let [before, after] = self.predicted[index].map(|one| (datum.value - one.value).powi(2));
            let usable = datum.kind == kind && before.is_finite() && after.is_finite();
            usable.then_some((datum.experiment, [before, after]))
        };
        let rows: Vec<(usize, [f64; 2])> = data.readings.iter().enumerate().filter_map(of_kind).collect();
        let units = sums_by_unit(&rows);
        if units.len() < LEAST_EXPERIMENTS {
            return None;
        }
        let rmse = |which: usize| {
            (rows.iter().map(|(_, squares)| squares[which]).sum::<f64>() / rows.len() as f64).sqrt()
        };
        let [one, other] = [bootstrap(&units, study.seed), student_interval(&units, SHARED_FITS)];
        let weights = vec![1.0; data.experiments];
        let mean_score = |which: usize| {
            let all: Vec<PredictedReading> = self.predicted.iter().map(|pair| pair[which]).collect();
            study.score_of(&all, &weights) / data.readings.len() as f64
        };
        Some(Gain {
            held_out_rows: units.len(),
            measured: CROSS_VALIDATED,
            observable: data.kinds[kind],
            rmse_before: rmse(0),
            rmse_after: rmse(1),
            ci95: [one[0].min(other[0]), one[1].max(other[1])],
            noise_floor: self.noise(study, kind),
            log_score_before: mean_score(0),
            log_score_after: mean_score(1),
        })
    }

    /// Root mean square of the known errors of a kind of readings [1].
    fn noise(&self, study: &RigStudy<'_>, kind: usize) -> Option<f64> {
        let data = &study.data;
        let of = |(index, datum): (usize, &super::noise::Datum)| {
            let known = !matches!(datum.noise, super::noise::Noise::Shared { .. });
            let variance = data.variance(index, &self.predicted[index][1], &FittedScatter::default());
            (datum.kind == kind && known).then_some(variance)
        };
        let known: Vec<f64> = data.readings.iter().enumerate().filter_map(of).collect();
        (!known.is_empty()).then(|| (known.iter().sum::<f64>() / known.len() as f64).sqrt())
    }
}

/// Additions, fitted to experiments with these weights.
fn fitted_again(
    study: &RigStudy<'_>,
    whole: &RigChoice,
    posterior: &Posterior,
    additions: &[RigAddition],
    weights: &[f64],
) -> Vec<RigAddition> {
    let same = shapes(additions) == shapes(&whole.additions());
    match posterior.best(study, weights).filter(|_| same) {
        Some(at) => moved(additions, &at),
        None => study.fit(additions, weights),
    }
}

/// Log likelihood of the experiments without a weight, averaged over the explanations of the others, over that of
/// the base model [nats]. `after` are the predictions by the file of the most probable one.
fn lead_of(
    study: &RigStudy<'_>,
    explanations: &Explanations<RigAddition>,
    visited: &[RigExplanation],
    after: Option<&[PredictedReading]>,
    weights: &[f64],
) -> f64 {
    let (data, all) = (&study.data, vec![1.0; weights.len()]);
    let of = |prepared: &PreparedReadings| {
        let [all, seen] = [&all, weights].map(|weights| data.score(prepared, data.values(), weights));
        all - seen
    };
    let base = of(&study.table.base_prepared);
    let likelihood = |(rank, one): (usize, &FoundExplanation<RigAddition>)| {
        let held_out = match after {
            Some(predicted) if rank == 0 => of(&data.prepare(predicted)),
            _ => of(&visited[one.place].fitted.prepared),
        };
        one.probability * (held_out - base).exp()
    };
    explanations.all().iter().enumerate().map(likelihood).sum::<f64>().ln()
}

/// Predictions of all readings by a model file: its terms and changed numbers on the model of each
/// experiment, whose settings may change other keys of the model.
pub(super) fn predict_file(
    study: &RigStudy<'_>,
    file: &Model,
    additions: &[RigAddition],
) -> Result<Vec<PredictedReading>, PredictionError> {
    let numbers: Vec<(LawParameter, f64)> = additions
        .iter()
        .filter_map(|addition| match addition.kind {
            Kind::Part(Part::LawParameter(parameter)) => Some((parameter, parameter.of(file)?)),
            _ => None,
        })
        .collect();
    let change = |model: &Model| {
        let with_terms = model.with_terms(file.terms().to_vec());
        numbers.iter().fold(with_terms, |model, (parameter, value)| parameter.set(&model, *value))
    };
    let mut all = Vec::new();
    for experiment in 0..study.data.experiments {
        let mut predicted = study.forward.predict(experiment, &change)?;
        change_case(study.forward, experiment, additions, &mut predicted);
        all.extend(predicted);
    }
    Ok(all)
}
