//! What is scored: a law with the numbers that are fitted to it, a model, or another program.

use nearwall::model::Model;
use toml_edit::DocumentMut;

use super::super::fitted_rows::FittedRows;
use super::super::forecast::{Forecast, Prediction};
use super::super::likelihood::{Offset, mean};
use super::super::observable::Observable;
use super::external::{ExternalAnswer, ask};
use super::laws::{NamedLaw, Numbers, with_laws};
use super::read_set::ReadSet;
use super::{BenchmarkError, EntryKind};
use crate::diagnose::fault;
use crate::rig::Band;

/// Captured shares that differ by less are the same [1].
const SAME_SHARE: f64 = 1e-9;

/// The answers of a law with certain numbers to every set.
pub(super) struct Trial {
    /// The fitted numbers.
    pub numbers: Numbers,
    pub forecasts: Vec<Forecast>,
}

/// One of the laws, models and programs that are scored.
pub(super) struct Contestant {
    pub name: String,
    pub kind: EntryKind,
    /// With several, that of the highest score on the other sources answers for a source.
    pub trials: Vec<Trial>,
    /// By set and reading: whether it has an answer.
    pub decided: Vec<Vec<bool>>,
    /// By set and reading: its own 95 % bands of `e_n` and `e_t`; NaN without any.
    pub bands: Option<Vec<Vec<[[f64; 2]; 2]>>>,
    /// Why the first set that it cannot answer is not decided.
    pub refusal: Option<String>,
}

impl Contestant {
    /// A law of the library.
    pub fn law(law: &NamedLaw, sets: &[ReadSet]) -> Result<Self, BenchmarkError> {
        let kind = EntryKind::Law(law.side as usize);
        let text = |base: &str, numbers: &Numbers| law.model_text(base, numbers);
        let mut whole = Self::empty(law.name(), kind);
        for numbers in law.trials() {
            let one = models_of(sets, |base| text(base, &numbers).map_err(BenchmarkError::from))?;
            whole.decided = one.iter().zip(sets).map(|(model, set)| decided(model, set)).collect();
            whole.trials.push(Trial { numbers, forecasts: forecasts(&one, sets) });
        }
        Ok(whole)
    }

    /// The laws of a model file with its own numbers, and the materials of each set.
    pub fn model(name: &str, text: &str, sets: &[ReadSet]) -> Result<Self, BenchmarkError> {
        let laws: DocumentMut = text.parse()?;
        let mut whole = Self::empty(name.to_owned(), EntryKind::Whole);
        let models = models_of(sets, |base| Ok(with_laws(base, &laws)?))?;
        let reason =
            |(model, set): (&SetModel, &ReadSet)| Some(format!("{}: {}", set.name, model.as_ref().err()?));
        whole.refusal = models.iter().zip(sets).find_map(reason);
        whole.decided = models.iter().zip(sets).map(|(model, set)| decided(model, set)).collect();
        whole.leave_out_fitted(text, sets);
        whole.trials.push(Trial { numbers: Numbers::new(), forecasts: forecasts(&models, sets) });
        Ok(whole)
    }

    /// Decides nothing of the sources of which some rows fitted the model, as its text states.
    fn leave_out_fitted(&mut self, text: &str, sets: &[ReadSet]) {
        let rows = FittedRows::stated(text);
        let fitted: Vec<&ReadSet> = sets.iter().filter(|set| set.fitted(&rows)).collect();
        for (decided, set) in self.decided.iter_mut().zip(sets) {
            if fitted.iter().any(|one| one.source == set.source) {
                decided.fill(false);
            }
        }
        let reason =
            |set: &&ReadSet| format!("{}: its rows fitted the model, so its source is left out", set.name);
        let reasons: Vec<String> = fitted.iter().map(reason).chain(self.refusal.take()).collect();
        self.refusal = (!reasons.is_empty()).then(|| reasons.join("; "));
    }

    /// The same with the bands of drawn models, whose texts these are.
    pub fn with_draws(self, texts: &[String], sets: &[ReadSet]) -> Result<Self, BenchmarkError> {
        let forecasts_of = |text: &String| {
            let laws: DocumentMut = text.parse()?;
            Ok(forecasts(&models_of(sets, |base| Ok(with_laws(base, &laws)?))?, sets))
        };
        let drawn = texts.iter().map(forecasts_of).collect::<Result<Vec<_>, BenchmarkError>>()?;
        let band = |set: usize, row: usize| {
            let means: Vec<[f64; 2]> =
                drawn.iter().map(|one| mean(one[set].of(row), &Offset::default()).restitution).collect();
            [0, 1].map(|which| {
                let Band { low, high, .. } = Band::of(means.iter().map(|mean| mean[which]).collect());
                [low, high]
            })
        };
        let of_set = |(place, set): (usize, &ReadSet)| (0..set.count()).map(|row| band(place, row)).collect();
        Ok(Self { bands: Some(sets.iter().enumerate().map(of_set).collect()), ..self })
    }

    /// Whether it captures another share of a reading than `other`, with some of its numbers.
    pub fn captures_otherwise(&self, other: &Self, set: usize, row: usize) -> bool {
        let capture = |trial: &Trial| mean(trial.forecasts[set].of(row), &Offset::default()).capture;
        let is_other =
            |of: &Trial| other.trials.iter().any(|one| (capture(one) - capture(of)).abs() > SAME_SHARE);
        self.decided[set][row] && other.decided[set][row] && self.trials.iter().any(is_other)
    }

    /// Another program, which answers all readings in one run.
    pub fn external(command: &str, sets: &[ReadSet]) -> Result<Self, BenchmarkError> {
        let fault = |problem| BenchmarkError::External { command: command.to_owned(), problem };
        let count = sets.iter().map(ReadSet::count).sum();
        let answers = ask(command, super::read_set::impacts(sets)?, count).map_err(fault)?;
        let mut rest = answers.as_slice();
        let mut whole = Self::empty(command.to_owned(), EntryKind::Whole);
        let (mut forecasts, mut bands) = (Vec::new(), Vec::new());
        for set in sets {
            let (own, others) = rest.split_at(set.count());
            rest = others;
            let known = |(answer, observable): (&ExternalAnswer, &Observable)| {
                answer.values[*observable as usize].is_finite()
            };
            whole.decided.push(own.iter().zip(&set.observables).map(known).collect());
            forecasts.push(Forecast::stated(own.iter().map(|answer| prediction(answer.values)).collect()));
            bands.push(own.iter().map(|answer| answer.bands).collect::<Vec<_>>());
        }
        let has_bands = bands.iter().flatten().flatten().flatten().any(|end| end.is_finite());
        whole.bands = has_bands.then_some(bands);
        whole.trials.push(Trial { numbers: Numbers::new(), forecasts });
        Ok(whole)
    }

    fn empty(name: String, kind: EntryKind) -> Self {
        Self { name, kind, trials: Vec::new(), decided: Vec::new(), bands: None, refusal: None }
    }
}

/// A prediction of these values; what is not known is no statement: a rebound.
pub(super) fn prediction([e_n, e_t, p]: [f64; 3]) -> Prediction {
    let known = |value: f64| if value.is_finite() { value } else { 0.0 };
    Prediction {
        restitution: [known(e_n), known(e_t)],
        capture: known(p),
        weight: 1.0,
        reach: [0.0; 2],
        filling: 0,
    }
}

/// The model of each set, or why the materials of the set do not suffice for the laws.
type SetModel = Result<Model, String>;

fn models_of(
    sets: &[ReadSet],
    text: impl Fn(&str) -> Result<String, BenchmarkError>,
) -> Result<Vec<SetModel>, BenchmarkError> {
    let one = |set: &ReadSet| {
        let text = text(&set.base)?;
        Ok(Model::from_toml(&format!("the laws on {}", set.name), &text).map_err(|error| error.to_string()))
    };
    sets.iter().map(one).collect()
}

fn decided(model: &SetModel, set: &ReadSet) -> Vec<bool> {
    let decides = |row| model.as_ref().is_ok_and(|model| fault(model, row).is_none());
    set.data.rows.iter().map(decides).collect()
}

fn forecasts(models: &[SetModel], sets: &[ReadSet]) -> Vec<Forecast> {
    let one = |(model, set): (&SetModel, &ReadSet)| match model {
        Ok(model) => Forecast::of_data(model, &set.data, &set.data.all()),
        Err(_) => Forecast::stated(vec![prediction([f64::NAN; 3]); set.count()]),
    };
    models.iter().zip(sets).map(one).collect()
}
