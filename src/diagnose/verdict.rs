//! Puts what was found into words and numbers for a reader.

use std::collections::BTreeMap;

use super::advice::advise;
use super::data_split::DataSplit;
use super::extend::rounded;
use super::forecast::Forecast;
use super::hypothesis::{Hypothesis, Observable, changes};
use super::likelihood::Scatter;
use super::model_selection::{Added, ScoredCandidate};
use super::part::{Fitted, Part};
use super::record::{
    Alternative, Calibration, Diagnosis, Errors, Estimate, Finding, Gain, Misfit, NotExamined, Rejected,
    Rows, Sample, ScatterFound, Shape, Unexplained,
};
use super::smooth::Basis;
use super::unknown::Unknown;
use super::{CLEAR, Discovery, Options, cause_of, is_number};
use crate::dataset::{Measurements, Values};
use crate::effect::EFFECTS;

/// Alternatives listed at most.
const ALTERNATIVES: usize = 6;
/// Misfits listed at most.
const MISFITS: usize = 12;

/// Where the base model fails: curves over single columns in the first round, the best of each column and observable.
pub(super) fn misfit(study: &DataSplit, contenders: &[ScoredCandidate], level: f64) -> Vec<Misfit> {
    let mut best: BTreeMap<(String, &'static str), Misfit> = BTreeMap::new();
    for contender in contenders.iter().filter(|c| c.q_value <= level) {
        let Added::Unknown(unknown) = &contender.added else { continue };
        let column = study.factors[unknown.factor].name.clone();
        let observable = unknown.observable.name();
        let one = Misfit {
            column: column.clone(),
            observable,
            gain: contender.own_gain,
            q_value: contender.q_value,
        };
        let kept = best.entry((column, observable)).or_insert_with(|| one.clone());
        if one.gain > kept.gain {
            *kept = one;
        }
    }
    let mut all: Vec<Misfit> = best.into_values().collect();
    all.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    all.truncate(MISFITS);
    all
}

/// Everything but gain, misfit, verdict and sample.
pub(super) fn record(
    study: &DataSplit,
    data: &Measurements,
    hypothesis: &Hypothesis,
    discoveries: &[Discovery],
    intervals: &[Vec<[f64; 2]>],
    scatter: Scatter,
    options: Options,
) -> Diagnosis {
    let teller = FindingBuilder { study, hypothesis, intervals, scatter, level: options.level };
    let mut findings: Vec<Finding> = Vec::new();
    let mut calibration = Vec::new();
    for discovery in discoveries {
        if is_number(&discovery.winner.added) {
            calibration.extend(teller.calibration(&discovery.winner));
            continue;
        }
        let finding = teller.finding(discovery);
        // A column may act on two observables; it is one cause.
        if findings.iter().all(|earlier| earlier.cause != finding.cause) {
            findings.push(finding);
        }
    }
    let observed = |of: fn(&crate::dataset::Measurement) -> bool| study.rows.iter().any(of);
    Diagnosis {
        schema: "nearwall.diagnosis/1",
        seed: options.seed,
        level: options.level,
        verdict: String::new(),
        rows: Rows {
            read: data.read,
            used: data.rows.len(),
            held_out: study.held_out.len(),
            rejected: data
                .rejected
                .iter()
                .map(|bad| Rejected { line: bad.line, reason: bad.reason.clone() })
                .collect(),
        },
        base: Errors::default(),
        misfit: Vec::new(),
        findings,
        calibration,
        scatter: ScatterFound {
            e_n: if observed(|row| row.e_n.is_some()) { scatter.e_n } else { 0.0 },
            e_t: if observed(|row| row.e_t.is_some()) { scatter.e_t } else { 0.0 },
            changes_with: hypothesis.noise.iter().map(|(f, _)| study.factors[*f].name.clone()).collect(),
        },
        not_examined: not_examined(study),
        unexplained_capture: unexplained_capture(study, hypothesis),
        gain: None,
        gains: Vec::new(),
        extended_model: "extended.toml",
        sample: Sample::default(),
    }
}

/// Captured share, measured and by the named parts, where a constant rate had to be taken into account.
fn unexplained_capture(study: &DataSplit, hypothesis: &Hypothesis) -> Option<Unexplained> {
    if hypothesis.lapses == 0.0 {
        return None;
    }
    let forecast = Forecast::new(&hypothesis.model(study), &study.rows, &study.search, study.draws);
    let pairs: Vec<[f64; 2]> = study
        .search
        .iter()
        .enumerate()
        .filter_map(|(place, &row)| {
            let said = super::likelihood::mean(forecast.of(place), &super::likelihood::Offset::default());
            Some([study.rows[row].captured?, said.capture])
        })
        .collect();
    let mean = |which: usize| pairs.iter().map(|pair| pair[which]).sum::<f64>() / pairs.len().max(1) as f64;
    Some(Unexplained { measured: mean(0), expected: mean(1) })
}

/// Effects that the data cannot speak of, with what is missing.
fn not_examined(study: &DataSplit) -> Vec<NotExamined> {
    let one = |kind: &&'static crate::effect::EffectInfo| {
        if study.base.terms().iter().any(|term| term.kind().id == kind.id) {
            return Some(NotExamined { cause: kind.id, reason: "the base model has it".to_owned() });
        }
        if Part::Effect(kind).axes(study, false).is_some() {
            return None;
        }
        let missing: Vec<&str> =
            kind.inputs.iter().copied().filter(|input| study.range(input).is_none()).collect();
        Some(NotExamined {
            cause: kind.id,
            reason: format!("{} does not vary in the data", missing.join(", ")),
        })
    };
    EFFECTS.iter().filter_map(one).collect()
}

/// What every sentence draws on.
struct FindingBuilder<'a> {
    study: &'a DataSplit,
    hypothesis: &'a Hypothesis,
    intervals: &'a [Vec<[f64; 2]>],
    scatter: Scatter,
    level: f64,
}

impl FindingBuilder<'_> {
    /// A part after the last fit, with its intervals.
    fn final_part(&self, name: &str) -> Option<(&Fitted, &[[f64; 2]])> {
        let place = self.hypothesis.parts.iter().position(|fitted| fitted.part.name() == name)?;
        Some((&self.hypothesis.parts[place], self.intervals.get(place)?))
    }

    fn calibration(&self, winner: &ScoredCandidate) -> Option<Calibration> {
        let key = cause_of(self.study, &winner.added);
        let (fitted, ends) = self.final_part(&key)?;
        let Part::Number(number) = fitted.part else { return None };
        let [low, high] = *ends.first()?;
        Some(Calibration {
            key,
            from: number.of(&self.study.base)?,
            value: rounded(*fitted.values().first()?),
            low: rounded(low),
            high: rounded(high),
            p_value: winner.p_value,
            q_value: winner.q_value,
        })
    }

    fn finding(&self, Discovery { winner, others }: &Discovery) -> Finding {
        let cause = cause_of(self.study, &winner.added);
        let observable = self.observable(winner);
        let twins = self.twins(winner, others);
        let name = |other: &ScoredCandidate| cause_of(self.study, &other.added);
        let measure_next = twins.iter().filter_map(|twin| {
            let (found, other) = (self.alone(winner), self.alone(twin));
            advise(self.study, &found, &other, &name(twin), self.scatter)
        });
        let mut finding = Finding {
            observable: observable.name(),
            variables: self.variables(winner),
            gain: winner.gain(),
            p_value: winner.p_value,
            q_value: winner.q_value,
            parameters: self.parameters(&cause),
            alternatives: self.alternatives(winner, others),
            measure_next: measure_next.collect(),
            indistinguishable_from: twins.iter().map(|twin| name(twin)).collect(),
            curve: self.unknown(winner).map(|unknown| self.shape(unknown)),
            explanation: String::new(),
            cause,
        };
        finding.explanation = explain(&finding, observable);
        finding
    }

    fn unknown(&self, winner: &ScoredCandidate) -> Option<&Unknown> {
        let Added::Unknown(first) = &winner.added else { return None };
        let of_last_fit = |u: &&Unknown| u.factor == first.factor && u.observable == first.observable;
        self.hypothesis.unknowns.iter().find(of_last_fit)
    }

    /// The observable in which base and cause differ most, in units of the scatter.
    fn observable(&self, winner: &ScoredCandidate) -> Observable {
        if let Added::Unknown(unknown) = &winner.added {
            return unknown.observable;
        }
        let rows = &self.study.search;
        let says = |hypothesis: &Hypothesis| {
            Forecast::new(&hypothesis.model(self.study), &self.study.rows, rows, self.study.draws)
        };
        let (before, after) = (says(&Hypothesis::default()), says(&self.alone(winner)));
        let changes = changes(self.study, &before, &after, self.scatter);
        let larger = |a: &Observable, b: &Observable| changes[*a as usize].total_cmp(&changes[*b as usize]);
        // The first of equals: a file may hold one observable only.
        Observable::ALL.into_iter().rev().max_by(larger).unwrap_or(Observable::NormalRestitution)
    }

    fn alone(&self, contender: &ScoredCandidate) -> Hypothesis {
        let mut hypothesis = Hypothesis::default();
        if let Added::Part(fitted, _) = &contender.added {
            hypothesis.parts.push(fitted.clone());
        }
        hypothesis
    }

    fn variables(&self, winner: &ScoredCandidate) -> Vec<String> {
        match &winner.added {
            Added::Part(fitted, _) => fitted.part.inputs().iter().map(|&input| input.to_owned()).collect(),
            Added::Unknown(unknown) => vec![self.study.factors[unknown.factor].name.clone()],
            Added::Noise(..) | Added::BackgroundCapture(_) => Vec::new(),
        }
    }

    fn parameters(&self, cause: &str) -> BTreeMap<&'static str, Estimate> {
        let Some((fitted, ends)) = self.final_part(cause) else { return BTreeMap::new() };
        let Part::Effect(kind) = fitted.part else { return BTreeMap::new() };
        let estimates = kind.parameters.iter().zip(fitted.values()).zip(ends);
        estimates
            .map(|((parameter, value), [low, high])| {
                let estimate = Estimate {
                    value: rounded(value),
                    low: rounded(*low),
                    high: rounded(*high),
                    unit: parameter.unit,
                };
                (parameter.name, estimate)
            })
            .collect()
    }

    /// The best of each other cause in the round.
    fn alternatives(&self, winner: &ScoredCandidate, others: &[ScoredCandidate]) -> Vec<Alternative> {
        let mut best: BTreeMap<String, f64> = BTreeMap::new();
        let variables = self.variables(winner);
        let rival = |other: &&ScoredCandidate| match &other.added {
            Added::Part(..) => true,
            // A curve over the winner's own inputs is no other cause, and one that owes all to its level is none.
            Added::Unknown(curve) => {
                other.q_value <= self.level && !variables.contains(&self.study.factors[curve.factor].name)
            }
            Added::Noise(..) | Added::BackgroundCapture(_) => false,
        };
        for other in others.iter().filter(rival) {
            let difference = winner.gain() - other.gain();
            let kept = best.entry(cause_of(self.study, &other.added)).or_insert(difference);
            *kept = kept.min(difference);
        }
        let of = |(cause, score_difference)| Alternative { cause, score_difference };
        let mut all: Vec<Alternative> = best.into_iter().map(of).collect();
        all.sort_by(|a, b| a.score_difference.total_cmp(&b.score_difference));
        all.truncate(ALTERNATIVES);
        all
    }

    /// Causes that do about as well without more freedom.
    fn twins<'a>(&self, winner: &ScoredCandidate, others: &'a [ScoredCandidate]) -> Vec<&'a ScoredCandidate> {
        let as_good = |other: &&ScoredCandidate| {
            let cause = match &other.added {
                Added::Part(..) => {
                    other.parameters() <= winner.parameters().max(2) || other.gain() > winner.gain()
                }
                Added::Unknown(unknown) => !self.study.factors[unknown.factor].input,
                Added::Noise(..) | Added::BackgroundCapture(_) => false,
            };
            cause && !is_number(&other.added) && other.q_value <= self.level && winner.lead(other) < CLEAR
        };
        let mut twins: Vec<&ScoredCandidate> = others.iter().filter(as_good).collect();
        twins.sort_by(|a, b| b.gain().total_cmp(&a.gain()));
        twins.dedup_by_key(|twin| cause_of(self.study, &twin.added));
        twins
    }

    fn shape(&self, unknown: &Unknown) -> Shape {
        let at = match (&unknown.curve.basis, &self.study.factors[unknown.factor].values) {
            (Basis::Hats(knots), _) => knots.iter().map(|knot| rounded(*knot).to_string()).collect(),
            (Basis::Words(_), Values::Words { levels, .. }) => levels.clone(),
            _ => Vec::new(),
        };
        let adds = unknown.curve.heights.iter().map(|height| rounded(*height)).collect();
        Shape { factor: unknown.factorwise, at, adds }
    }
}

/// One sentence on a finding.
fn explain(finding: &Finding, observable: Observable) -> String {
    let quantity = observable.title();
    if let Some(column) = finding.cause.strip_prefix("unknown:") {
        return format!(
            "The {quantity} depends on the column `{column}` in a way that no effect of the library explains."
        );
    }
    let about = EFFECTS.iter().find(|kind| kind.id == finding.cause).map_or("", |kind| kind.about);
    let mut text = format!("The {quantity} shows `{}`: {about}", finding.cause);
    if !finding.variables.is_empty() {
        text += &format!(" (it turns on {})", finding.variables.join(", "));
    }
    text += ".";
    if !finding.indistinguishable_from.is_empty() {
        text += &format!(" These data cannot tell it from {}.", finding.indistinguishable_from.join(", "));
    }
    text
}

/// The answer in a sentence or two.
pub(super) fn sentence(diagnosis: &Diagnosis) -> String {
    let rows = diagnosis.rows.used;
    let causes: Vec<&str> = diagnosis.findings.iter().map(|finding| finding.cause.as_str()).collect();
    let numbers: Vec<String> = diagnosis
        .calibration
        .iter()
        .map(|c| format!("{} = {} instead of {}", c.key, c.value, c.from))
        .collect();
    let mut text = match (causes.as_slice(), numbers.is_empty()) {
        ([], true) if diagnosis.unexplained_capture.is_some() => {
            format!("In {rows} rows no cause stands out, but the model is wrong about captures.")
        }
        ([], true) => format!("In {rows} rows nothing beyond noise speaks against the model."),
        ([], false) => format!("{rows} rows ask for {}, and for no further cause.", numbers.join(", ")),
        ([one], _) => format!("The model lacks {one}."),
        (several, _) => format!("The model lacks {} causes: {}.", several.len(), several.join(", ")),
    };
    if !causes.is_empty() && !numbers.is_empty() {
        text += &format!(" Besides, the data ask for {}.", numbers.join(", "));
    }
    if let Some(gain) = &diagnosis.gain {
        let Gain { held_out_rows, observable, rmse_before, rmse_after, ci95, .. } = gain;
        text += &if ci95[1] < 1.0 {
            format!(
                " On {held_out_rows} rows that no fit saw, the error in {observable} falls from {rmse_before:.3} to \
                 {rmse_after:.3}."
            )
        } else {
            format!(
                " The mean error in {observable} on {held_out_rows} rows that no fit saw stays as it is ({rmse_before:.3} \
                 before, {rmse_after:.3} after); mean log score of a row {:.3} before, {:.3} after.",
                gain.log_score_before, gain.log_score_after
            )
        };
    }
    if let Some(unexplained) = &diagnosis.unexplained_capture {
        text += &format!(
            " {:.1} % of the impacts were captured where the model says {:.1} %, and no column says when.",
            100.0 * unexplained.measured,
            100.0 * unexplained.expected
        );
    }
    if diagnosis.findings.iter().any(|finding| finding.curve.is_some()) {
        text += " A model file cannot carry a column that the library does not know; extended.toml is without it.";
    }
    if rows < 60 {
        text += &format!(" {rows} rows are few: a cause of usual size may be there and not be seen.");
    }
    text
}

/// What a model file cannot carry, as comments at its end.
pub(super) fn notes_for_model(diagnosis: &Diagnosis) -> Vec<String> {
    let unknown = diagnosis.findings.iter().filter(|finding| finding.curve.is_some());
    unknown
        .map(|finding| {
            format!("not in this model: {} acts on {}; see diagnosis.json", finding.cause, finding.observable)
        })
        .collect()
}
