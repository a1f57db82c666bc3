//! Diagnosis: what a model gets wrong about measured impacts, the cause, the extended model and what it gains.
//!
//! The walk of a measurement: rows → [`Model`] on every row → residuals → candidates, each fitted to training rows →
//! contest on unseen rows → verdict → extended model → gain on rows that nothing saw → page, JSON, TOML. `diagnose` knows
//! effects only through their [`crate::effect::EffectInfo`]: a new effect is a candidate as soon as it is in the list. How the
//! judgement works, and where it ends, is one page: `docs/diagnosis.md`.

mod advice;
mod data_split;
mod extend;
mod forecast;
mod gain;
mod hypothesis;
mod interval;
mod likelihood;
mod model_selection;
mod part;
mod record;
mod search;
mod smooth;
mod unknown;
mod verdict;

pub use record::{
    Alternative, Calibration, Diagnosis, Errors, Estimate, Finding, Gain, Measure, Misfit, NotExamined,
    Rejected, Rows, Sample, SampleRow, ScatterFound, Shape, Unexplained,
};

use crate::dataset::Measurements;
use crate::impact::{INPUTS, Impact, Input};
use crate::model::Model;
use data_split::DataSplit;
use gain::Answers;
use hypothesis::{Hypothesis, Observable};
use likelihood::Scatter;
use model_selection::{Added, Round, ScoredCandidate};
use part::Part;

/// What a diagnosis may be told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Deals the rows out; the same seed gives the same bytes.
    pub seed: u64,
    /// Accepted share of false discoveries [1].
    pub level: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { seed: 1, level: 0.05 }
    }
}

/// Why there is no diagnosis.
#[derive(Debug, thiserror::Error)]
pub enum DiagnosisError {
    /// Too few usable rows for any judgement.
    #[error("{used} of {read} rows can be used; a diagnosis needs at least {least}. {reasons}")]
    TooFewRows {
        /// Usable rows.
        used: usize,
        /// Rows in the file.
        read: usize,
        /// Rows needed.
        least: usize,
        /// Why rows were left out.
        reasons: String,
    },
    /// The base model's text cannot be extended.
    #[error("the model file cannot be extended: {0}")]
    Unextendable(String),
}

/// Fewer rows than this cannot be split into fits, tests and a gain.
const LEAST_ROWS: usize = 8;
/// An average of more impacts than this is one observation of its captured share.
const MOST_UNFOLDED: f64 = 1000.0;
/// Causes looked for at most.
const MOST_CAUSES: usize = 6;
/// No input of an impact is larger than this or, where laws divide by it, smaller [SI units]; far beyond any laboratory.
const MOST_MEASURED: f64 = 1e12;
const LEAST_MEASURED: f64 = 1e-15;
/// Inputs that laws divide by.
const DIVISORS: [&str; 5] = ["v_n", "v_t", "d", "T_p", "T_w"];
/// A further cause has to gain this share of the first one's gain; less is put down to the shape of the laws.
const WORTH: f64 = 0.05;
/// Least gain of any cause [nats].
const LEAST_GAIN: f64 = 3.0;
/// A curve over a column has to owe this share of its gain to the column rather than to its level.
const OWN: f64 = 0.25;
/// An effect that explains this share of what a curve over an input does goes first.
const ENOUGH: f64 = 0.1;
/// Standard errors by which one candidate has to lead another to be told apart from it (5 %, one-sided).
const CLEAR: f64 = 1.645;

/// A discovery on the way: what was added, and the round it won.
struct Discovery {
    winner: ScoredCandidate,
    /// The others of its round.
    others: Vec<ScoredCandidate>,
}

/// Diagnoses `data` against the model `base` whose file has the text `text`. `progress` is called after
/// each candidate. Returns the diagnosis and the text of the extended model.
///
/// # Errors
/// [`DiagnosisError`].
pub fn diagnose(
    base: &Model,
    text: &str,
    data: &Measurements,
    options: Options,
    progress: &(dyn Fn() + Sync),
) -> Result<(Diagnosis, String), DiagnosisError> {
    let data = &within_tables(base, data);
    if data.rows.len() < LEAST_ROWS {
        let reasons: Vec<String> =
            data.rejected.iter().take(3).map(|bad| format!("Line {}: {}.", bad.line, bad.reason)).collect();
        let (used, read) = (data.rows.len(), data.read);
        return Err(DiagnosisError::TooFewRows { used, read, least: LEAST_ROWS, reasons: reasons.join(" ") });
    }
    let used = data.rows.len();
    let data = &data.unfolded(MOST_UNFOLDED);
    let study = DataSplit::new(base, data, options.seed);
    let plain = Hypothesis::default();
    let first =
        plain.fit(&study, &study.search, &plain.shifts(&study), Scatter { e_n: 0.1, e_t: 0.1 }).scatter;

    let mut hypothesis = plain.clone();
    let mut discoveries: Vec<Discovery> = Vec::new();
    let mut misfit = None;
    let mut scatter = first;
    for _ in 0..2 * MOST_CAUSES {
        let round = Round::new(&study, &hypothesis, scatter);
        scatter = round.scatter();
        let contenders = round.contenders(progress);
        misfit.get_or_insert_with(|| verdict::misfit(&study, &contenders, options.level));
        let first_gain = first_gain(&discoveries);
        let Some(winner) = choose(&study, &contenders, options.level, LEAST_GAIN.max(WORTH * first_gain))
        else {
            break;
        };
        let others = contenders.into_iter().filter(|c| !same(&c.added, &winner.added)).collect();
        scatter = adopt(&mut hypothesis, &study, &winner, scatter);
        if !matches!(winner.added, Added::Noise(..) | Added::BackgroundCapture(_)) {
            discoveries.push(Discovery { winner, others });
        }
        scatter = drop_superfluous(&mut hypothesis, &study, &mut discoveries, scatter);
        if discoveries.len() >= MOST_CAUSES {
            break;
        }
    }

    hypothesis.shape = None;
    let study = study.fine(hypothesis.parts.iter().any(|fitted| fitted.part.scatters()));
    let scatter = hypothesis.polish(&study, &study.fit, scatter);
    let shifts = hypothesis.shifts(&study);
    let intervals = interval::intervals(&hypothesis, &study, &study.fit, &shifts, scatter);
    let mut diagnosis =
        verdict::record(&study, data, &hypothesis, &discoveries, &intervals, scatter, options);
    diagnosis.rows.used = used;
    diagnosis.misfit = misfit.unwrap_or_default();
    measure_gain(&mut diagnosis, &study, &plain, first, &hypothesis, scatter, options.seed);
    diagnosis.verdict = verdict::sentence(&diagnosis);
    let notes = verdict::notes_for_model(&diagnosis);
    let extended = extend::extended(text, &study, &hypothesis.parts, &intervals, &notes)
        .map_err(|error| DiagnosisError::Unextendable(error.to_string()))?;
    Ok((diagnosis, extended))
}

/// The data without rows that the base model cannot answer (a temperature outside a property's table) and those that nobody
/// has measured.
fn within_tables(base: &Model, data: &Measurements) -> Measurements {
    data.without(|row| {
        let refused = base.check(row.wall, &row.impact).err().map(|error| error.to_string());
        refused.or_else(|| beyond_measure(&row.impact))
    })
}

/// The input whose value nobody has measured; squares of what laws make of it would overflow, and one such row would spoil
/// all that is summed over rows.
fn beyond_measure(impact: &Impact) -> Option<String> {
    INPUTS.iter().find_map(|Input { name, unit, value, .. }| {
        let value = value(impact);
        let tiny = DIVISORS.contains(name) && value != 0.0 && value.abs() < LEAST_MEASURED;
        (tiny || value.abs() > MOST_MEASURED)
            .then(|| format!("{name} = {value:e} {unit} cannot have been measured; look at its unit"))
    })
}

/// The candidate to adopt, or none that stands above chance.
fn choose(
    study: &DataSplit,
    contenders: &[ScoredCandidate],
    level: f64,
    least: f64,
) -> Option<ScoredCandidate> {
    let significant = contenders.iter().filter(|c| c.q_value <= level && c.gain() >= least);
    let (mut parts, mut unknowns, mut noises) = (Vec::new(), Vec::new(), Vec::new());
    for contender in significant {
        match contender.added {
            Added::Part(..) => parts.push(contender),
            Added::Unknown(_) => unknowns.push(contender),
            Added::Noise(..) | Added::BackgroundCapture(_) => noises.push(contender),
        }
    }
    let part = simplest_of_best(&parts);
    let unknown = most(unknowns.into_iter().filter(|unknown| !waits(study, unknown, &parts)));
    let cause = match (part, unknown) {
        (Some(part), Some(unknown))
            if unknown.lead(part) > CLEAR && unknown.own_gain > OWN * unknown.gain() =>
        {
            Some(unknown)
        }
        (Some(part), _) => Some(part),
        (None, unknown) => unknown,
    };
    let noise = most(noises.into_iter());
    match (cause, noise) {
        (Some(cause), Some(noise)) => {
            // Scatter that an effect makes is no noise, unless a plain change of noise says it clearly better.
            let scatters = matches!(&cause.added, Added::Part(fitted, _) if fitted.part.scatters());
            let share = if scatters { 0.85 } else { 1.0 };
            Some(if cause.gain() >= share * noise.gain() { cause.clone() } else { noise.clone() })
        }
        (cause, noise) => cause.or(noise).cloned(),
    }
}

fn most<'a>(contenders: impl Iterator<Item = &'a ScoredCandidate>) -> Option<&'a ScoredCandidate> {
    contenders.max_by(|a, b| a.gain().total_cmp(&b.gain()))
}

/// Among parts that do about as well as the best, the one with the fewest parameters.
fn simplest_of_best<'a>(parts: &[&'a ScoredCandidate]) -> Option<&'a ScoredCandidate> {
    let best = most(parts.iter().copied())?;
    let about_as_good = |part: &&&ScoredCandidate| {
        (best.lead(part) < CLEAR || best.at_an_end())
            && (part.gain() > 0.9 * best.gain() || best.gain() - part.gain() < LEAST_GAIN)
    };
    let key = |part: &&&ScoredCandidate| (part.parameters(), -part.gain());
    parts
        .iter()
        .filter(about_as_good)
        .min_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal))
        .copied()
}

/// Whether a curve over an input has to wait: effects of the library turn on it, and some part explains a good deal.
///
/// Several causes together may shape what the residuals show over one input; they are looked for first.
fn waits(study: &DataSplit, unknown: &ScoredCandidate, parts: &[&ScoredCandidate]) -> bool {
    let Added::Unknown(curve) = &unknown.added else { return false };
    let factor = &study.factors[curve.factor];
    let turned_on = crate::effect::EFFECTS.iter().any(|kind| kind.inputs.contains(&factor.name.as_str()));
    factor.input && turned_on && parts.iter().any(|part| part.gain() > ENOUGH * unknown.gain())
}

fn same(a: &Added, b: &Added) -> bool {
    match (a, b) {
        (Added::Part(a, _), Added::Part(b, _)) => a.part.name() == b.part.name(),
        (Added::Unknown(a), Added::Unknown(b)) => a.factor == b.factor,
        (Added::Noise(a, _), Added::Noise(b, _)) => a == b,
        (Added::BackgroundCapture(_), Added::BackgroundCapture(_)) => true,
        _ => false,
    }
}

/// Adds the winner and fits everything together.
fn adopt(
    hypothesis: &mut Hypothesis,
    study: &DataSplit,
    winner: &ScoredCandidate,
    scatter: Scatter,
) -> Scatter {
    match &winner.added {
        Added::Part(fitted, others) => {
            hypothesis.parts.clone_from(others);
            hypothesis.parts.push(fitted.clone());
        }
        Added::Unknown(unknown) => hypothesis.unknowns.push(unknown.clone()),
        Added::Noise(factor, change) => hypothesis.noise.push((*factor, *change)),
        Added::BackgroundCapture(odds) => hypothesis.lapses = *odds,
    }
    settle(hypothesis, study, scatter)
}

/// Fits all parameters together and takes up what is left of the laws' shape.
fn settle(hypothesis: &mut Hypothesis, study: &DataSplit, scatter: Scatter) -> Scatter {
    hypothesis.shape = None;
    let scatter = hypothesis.polish(study, &study.search, scatter);
    hypothesis.absorb_shape(study, scatter);
    scatter
}

/// The gain of the first cause [nats]; another value for a number of the base is none.
fn first_gain(discoveries: &[Discovery]) -> f64 {
    discoveries.iter().find(|d| !is_number(&d.winner.added)).map_or(0.0, |d| d.winner.gain())
}

/// Drops parts that a later one made superfluous.
fn drop_superfluous(
    hypothesis: &mut Hypothesis,
    study: &DataSplit,
    discoveries: &mut Vec<Discovery>,
    mut scatter: Scatter,
) -> Scatter {
    let mut place = 0;
    while hypothesis.parts.len() > 1 && place + 1 < hypothesis.parts.len() {
        let score = |h: &Hypothesis, scatter| h.fit(study, &study.search, &h.shifts(study), scatter).score;
        let mut whole = Hypothesis { shape: None, ..hypothesis.clone() };
        let with = score(&whole, scatter);
        let dropped = whole.parts.remove(place);
        let without_scatter = whole.polish(study, &study.search, scatter);
        let first = first_gain(discoveries);
        let worth = (LEAST_GAIN + dropped.at.len() as f64).max(WORTH * first);
        if with - score(&whole, without_scatter) < worth {
            discoveries.retain(
                |d| !matches!(&d.winner.added, Added::Part(f, _) if f.part.name() == dropped.part.name()),
            );
            *hypothesis = whole;
            hypothesis.absorb_shape(study, without_scatter);
            scatter = without_scatter;
        } else {
            place += 1;
        }
    }
    scatter
}

/// Errors before and after, on all rows and on those held out.
fn measure_gain(
    diagnosis: &mut Diagnosis,
    study: &DataSplit,
    plain: &Hypothesis,
    first: Scatter,
    hypothesis: &Hypothesis,
    scatter: Scatter,
    seed: u64,
) {
    let used: Vec<usize> = (0..study.rows.len()).collect();
    diagnosis.base = gain::errors(study, &used, &Answers::new(plain, study, &used, first));
    diagnosis.sample = gain::sample(study, plain, hypothesis, scatter);
    if diagnosis.findings.is_empty() && diagnosis.calibration.is_empty() {
        return;
    }
    let before = Answers::new(plain, study, &study.held_out, first);
    let after = Answers::new(hypothesis, study, &study.held_out, scatter);
    let of = |observable| gain::gain(study, &before, &after, observable, seed);
    diagnosis.gains = Observable::ALL.into_iter().filter_map(of).collect();
    let first = diagnosis.findings.first().map_or("", |finding| finding.observable);
    diagnosis.gain = diagnosis.gains.iter().find(|gain| gain.observable == first).cloned();
}

/// The id or name of what was added.
fn cause_of(study: &DataSplit, added: &Added) -> String {
    match added {
        Added::Part(fitted, _) => fitted.part.name(),
        Added::Unknown(unknown) => format!("unknown:{}", study.factors[unknown.factor].name),
        Added::Noise(factor, _) => format!("scatter:{}", study.factors[*factor].name),
        Added::BackgroundCapture(_) => "lapses".to_owned(),
    }
}

/// Whether something added is a number of the base rather than a cause.
fn is_number(added: &Added) -> bool {
    matches!(added, Added::Part(fitted, _) if matches!(fitted.part, Part::Number(_)))
}
