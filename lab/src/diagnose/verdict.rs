//! Writes the record of a diagnosis of impacts.

use super::candidate::{Addition, ScoredCandidate};
use super::choice::CauseChoice;
use super::constant_capture::CaptureConstant;
use super::curve::ColumnCurve;
use super::explanations::distinct;
use super::finding::FindingBuilder;
use super::gain::captured_shares;
use super::hypothesis::Hypothesis;
use super::likelihood::GROSS_SHARE;
use super::observable::Observable;
use super::part::Part;
use super::record::{Diagnosis, Finding, Fit, Misfit, NotExamined, Options, ScatterFound, Unexplained};
use super::sentences::is_refuted;
use nearwall::effect::{EFFECTS, EffectInfo};
use nearwall::model::Model;

/// Largest number of misfits listed.
const MOST_MISFITS: usize = 12;
/// p-value, without correction, of candidates that may carry a misfit; and how many of them are named.
const POSSIBLE: f64 = 0.05;
const MOST_UNDECIDED: usize = 6;

/// The misfits of the base model: the significant curves of the first round.
pub(super) fn misfit(hypothesis: &Hypothesis<'_>, choice: &CauseChoice, level: f64) -> Vec<Misfit> {
    let one = |scored: &ScoredCandidate| {
        let Addition::Curve(ColumnCurve { form, .. }) = &scored.addition else { return None };
        let column = match form.columns(hypothesis.data).as_slice() {
            [column] => column.clone(),
            _ => return None,
        };
        let (gain, q_value) = (scored.own_gain, scored.q_value);
        (q_value <= level && gain > 0.0).then(|| Misfit {
            column,
            observable: form.observable.name(),
            gain,
            q_value,
        })
    };
    let mut all: Vec<Misfit> = choice.explanations.singles().filter_map(one).collect();
    let name = |misfit: &Misfit| (misfit.column.clone(), misfit.observable);
    all.sort_by(|a, b| b.gain.total_cmp(&a.gain).then_with(|| name(a).cmp(&name(b))));
    // The same curve beside another noise.
    let mut seen = std::collections::BTreeSet::new();
    all.retain(|misfit| seen.insert(name(misfit)));
    all.truncate(MOST_MISFITS);
    all
}

/// The record without rows, errors, misfits, gains, verdict and sample.
pub(super) fn record(hypothesis: &Hypothesis<'_>, choice: &CauseChoice, options: &Options) -> Diagnosis {
    let data = hypothesis.data;
    let builder = FindingBuilder { hypothesis, choice, reach: &options.reach };
    let (numbers, causes): (Vec<_>, Vec<_>) =
        choice.discoveries.iter().partition(|one| one.addition.is_calibration());
    let calibration = numbers.into_iter().flat_map(|one| builder.calibration(one)).collect();
    let findings = joined(causes.into_iter().map(|one| builder.finding(one)));
    let undecided = if choice.discoveries.is_empty() { choice.explanations.undecided() } else { Vec::new() };
    let scatter = |observable: Observable| {
        let observed = data.rows.iter().any(|row| observable.measured(row).is_some());
        if observed { hypothesis.scatter[observable as usize] } else { 0.0 }
    };
    let trends = hypothesis.scatter_trends.iter();
    Diagnosis {
        schema: "nearwall.diagnosis/2",
        seed: options.seed,
        level: options.level,
        findings,
        calibration,
        explanations: choice.explanations.record(),
        rivals: choice.explanations.rivals(main_observable(choice)),
        measure_next: if undecided.is_empty() { Vec::new() } else { builder.separating() },
        undecided,
        scatter: ScatterFound {
            e_n: scatter(Observable::NormalRestitution),
            e_t: scatter(Observable::TangentialRestitution),
            changes_with: trends.map(|trend| data.covariates[trend.covariate].name.clone()).collect(),
        },
        not_examined: not_examined(&data.base, |input| data.range(input), "in the data"),
        capture_ceiling: hypothesis.captures.ceiling,
        gross_errors: choice.outliers.map(|more| more.shares.gross).filter(|share| *share > GROSS_SHARE),
        heavy_tails: choice.outliers.is_some_and(|more| more.shares.tails > 0.0),
        outliers_of: choice.outliers.map_or_else(Vec::new, |more| more.names().collect()),
        unexplained_capture: hypothesis.captures.has(CaptureConstant::Rate).then(|| {
            let [measured, expected] = captured_shares(hypothesis);
            Unexplained { measured, expected }
        }),
        extended_model: "extended.toml",
        ..Diagnosis::default()
    }
}

/// The findings, of which a column that acts on two observables is one.
fn joined(all: impl Iterator<Item = Finding>) -> Vec<Finding> {
    let mut findings: Vec<Finding> = Vec::new();
    for finding in all {
        match findings.iter_mut().find(|earlier| earlier.cause == finding.cause) {
            Some(earlier) => earlier.join(finding),
            None => findings.push(finding),
        }
    }
    findings
}

/// Why effects were no candidates: `range` gives the least and largest value of an input that
/// varies, `here` says where it does not.
pub(super) fn not_examined(
    base: &Model,
    range: impl Fn(&str) -> Option<[f64; 2]>,
    here: &str,
) -> Vec<NotExamined> {
    let reason = |effect: &'static EffectInfo| {
        if base.terms().iter().any(|term| term.kind().id == effect.id) {
            return Some("the base model contains it".to_owned());
        }
        if Part::Effect(effect).axes(&range, false).is_some() {
            return None;
        }
        let constant = effect.inputs.iter().copied().filter(|input| range(input).is_none());
        Some(format!("{} does not vary {here}", constant.collect::<Vec<_>>().join(", ")))
    };
    EFFECTS
        .into_iter()
        .filter_map(|effect| Some(NotExamined { cause: effect.id, reason: reason(effect)? }))
        .collect()
}

/// The observable with most measurements.
fn main_observable(choice: &CauseChoice) -> &'static str {
    let data = &choice.causes.data;
    let count =
        |o: &Observable| data.search.iter().filter(|&&row| o.measured(&data.rows[row]).is_some()).count();
    let best = Observable::ALL.into_iter().rev().max_by_key(count);
    best.map_or("e_n", Observable::name)
}

/// Candidates that may carry a misfit which the errors show, if none is significant by itself.
pub(super) fn possible_causes(fit: &Fit, choice: &CauseChoice) -> Vec<String> {
    if !choice.discoveries.is_empty() || !is_refuted(fit) {
        return Vec::new();
    }
    let mut possible: Vec<&ScoredCandidate> = choice
        .explanations
        .singles()
        .filter(|c| c.addition.is_systematic() && c.p_value < POSSIBLE)
        .collect();
    possible.sort_by(|a, b| b.gain().total_cmp(&a.gain()));
    // A column may explain e_n and e_t.
    let names: Vec<String> = possible.iter().map(|one| one.addition.name(&choice.causes.data)).collect();
    let mut names = distinct(names.iter());
    names.truncate(MOST_UNDECIDED);
    names
}
