//! Writes the record of a diagnosis and its verdict.

use super::candidate::{Addition, ScoredCandidate};
use super::curve::ColumnCurve;
use super::finding::FindingBuilder;
use super::gain::captured_shares;
use super::hypothesis::Hypothesis;
use super::model_selection::Discovery;
use super::observable::Observable;
use super::part::Part;
use super::record::{
    Calibration, Diagnosis, Finding, Gain, Misfit, NotExamined, Options, ScatterFound, Unexplained,
};
use crate::effect::{EFFECTS, EffectInfo};

/// Largest number of misfits listed.
const MISFITS: usize = 12;
/// With fewer rows the verdict warns that effects may go undetected.
const MANY_ROWS: usize = 60;

/// The misfits of the base model: the significant curves of the first round.
pub(super) fn misfit(
    hypothesis: &Hypothesis<'_>,
    first_round: &[ScoredCandidate],
    level: f64,
) -> Vec<Misfit> {
    let one = |scored: &ScoredCandidate| {
        let Addition::Curve(ColumnCurve { form, .. }) = &scored.addition else { return None };
        let column = hypothesis.data.covariates[form.covariate].name.clone();
        let (gain, q_value) = (scored.own_gain, scored.q_value);
        (q_value <= level).then(|| Misfit { column, observable: form.observable.name(), gain, q_value })
    };
    let mut all: Vec<Misfit> = first_round.iter().filter_map(one).collect();
    let name = |misfit: &Misfit| (misfit.column.clone(), misfit.observable);
    all.sort_by(|a, b| b.gain.total_cmp(&a.gain).then_with(|| name(a).cmp(&name(b))));
    all.truncate(MISFITS);
    all
}

/// The record without rows, errors, misfits, gains, verdict and sample.
pub(super) fn record(hypothesis: &Hypothesis<'_>, discoveries: &[Discovery], options: &Options) -> Diagnosis {
    let data = hypothesis.data;
    let builder = FindingBuilder { hypothesis, level: options.level };
    let mut findings: Vec<Finding> = Vec::new();
    let mut calibration = Vec::new();
    for discovery in discoveries {
        if discovery.winner.addition.is_calibration() {
            calibration.extend(builder.calibration(&discovery.winner));
            continue;
        }
        let finding = builder.finding(discovery);
        // A column that acts on two observables is one cause.
        if findings.iter().all(|earlier| earlier.cause != finding.cause) {
            findings.push(finding);
        }
    }
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
        scatter: ScatterFound {
            e_n: scatter(Observable::NormalRestitution),
            e_t: scatter(Observable::TangentialRestitution),
            changes_with: trends.map(|trend| data.covariates[trend.covariate].name.clone()).collect(),
        },
        not_examined: EFFECTS.iter().filter_map(|effect| not_examined(hypothesis, effect)).collect(),
        unexplained_capture: (hypothesis.background_capture != 0.0).then(|| {
            let [measured, expected] = captured_shares(hypothesis);
            Unexplained { measured, expected }
        }),
        extended_model: "extended.toml",
        ..Diagnosis::default()
    }
}

/// Why an effect was no candidate, if it was none.
fn not_examined(hypothesis: &Hypothesis<'_>, effect: &'static EffectInfo) -> Option<NotExamined> {
    let data = hypothesis.data;
    let cause = effect.id;
    if data.base.terms().iter().any(|term| term.kind().id == cause) {
        return Some(NotExamined { cause, reason: "the base model contains it".to_owned() });
    }
    if Part::Effect(effect).axes(data, false).is_some() {
        return None;
    }
    let constant = effect.inputs.iter().copied().filter(|input| data.range(input).is_none());
    let reason = format!("{} does not vary in the data", constant.collect::<Vec<_>>().join(", "));
    Some(NotExamined { cause, reason })
}

/// The verdict: the result in a few sentences.
pub(super) fn sentences(diagnosis: &Diagnosis) -> String {
    let rows = diagnosis.rows.used;
    let cause = |finding: &Finding| match finding.cause.strip_prefix("unknown:") {
        Some(column) => format!("a dependence on {column}"),
        None => finding.cause.clone(),
    };
    let causes: Vec<String> = diagnosis.findings.iter().map(cause).collect();
    let value = |c: &Calibration| format!("{} = {} instead of {}", c.key, c.value, c.from);
    let values = diagnosis.calibration.iter().map(value).collect::<Vec<_>>().join(", ");
    let mut text = match (causes.as_slice(), values.is_empty()) {
        ([], true) if diagnosis.unexplained_capture.is_some() => {
            format!("In {rows} rows no effect is significant, but the model does not reproduce the captures.")
        }
        ([], true) => format!("In {rows} rows no deviation from the model is significant."),
        ([], false) => format!("The data support {values}; no further effect is significant."),
        ([one], _) => format!("The model lacks {one}."),
        (several, _) => format!("The model lacks {} effects: {}.", several.len(), several.join(", ")),
    };
    if !causes.is_empty() && !values.is_empty() {
        text += &format!(" The data also support {values}.");
    }
    text += &diagnosis.gain.as_ref().map_or(String::new(), gain_sentence);
    if let Some(Unexplained { measured, expected }) = &diagnosis.unexplained_capture {
        text += &format!(
            " {:.1} % of the impacts were captured, but the model predicts {:.1} %; no column explains the difference.",
            100.0 * measured,
            100.0 * expected
        );
    }
    if diagnosis.findings.iter().any(|finding| finding.curve.is_some()) {
        text += " A model file cannot contain a curve over a column, so extended.toml lacks it.";
    }
    if rows < MANY_ROWS {
        text += &format!(" With only {rows} rows, an effect of usual size may go undetected.");
    }
    text
}

fn gain_sentence(gain: &Gain) -> String {
    let Gain { held_out_rows, observable, rmse_before, rmse_after, ci95, .. } = gain;
    let errors = format!("the root mean square error in {observable}");
    if ci95[1] < 1.0 {
        return format!(
            " On {held_out_rows} held-out rows {errors} falls from {rmse_before:.3} to {rmse_after:.3}."
        );
    }
    format!(
        " On {held_out_rows} held-out rows {errors} does not fall significantly ({rmse_before:.3} before, \
         {rmse_after:.3} after); the mean log score of a row is {:.3} before and {:.3} after.",
        gain.log_score_before, gain.log_score_after
    )
}

/// The findings that a model file cannot contain, as comments for its end.
pub(super) fn notes_for_model(diagnosis: &Diagnosis) -> Vec<String> {
    let curves = diagnosis.findings.iter().filter(|finding| finding.curve.is_some());
    let note = |finding: &Finding| {
        format!("not in this model: {} acts on {}; see diagnosis.json", finding.cause, finding.observable)
    };
    curves.map(note).collect()
}
