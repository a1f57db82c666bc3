//! Writes the record of a diagnosis and its verdict.

use super::candidate::{Addition, ScoredCandidate};
use super::choice::CauseChoice;
use super::constants::{LEAST_CERTAINTY, REFUTED};
use super::curve::ColumnCurve;
use super::finding::FindingBuilder;
use super::gain::captured_shares;
use super::hypothesis::Hypothesis;
use super::observable::Observable;
use super::part::Part;
use super::record::{
    Calibration, Diagnosis, Finding, Fit, FitTest, Gain, LargeMisfit, Misfit, NotExamined, Options,
    ScatterFound, Unexplained,
};
use nearwall::effect::{EFFECTS, EffectInfo};

/// Largest number of misfits listed.
const MOST_MISFITS: usize = 12;
/// With fewer rows the verdict warns that effects may go undetected.
const WARNED_ROWS: usize = 60;
/// With fewer rows, causes that cannot be told apart are undecided.
const UNDECIDED_ROWS: usize = 12;
/// Share of resamples below which a cause is never named.
const HARDLY_EVER: f64 = 0.2;
/// p-value, without correction, of candidates that may carry a misfit; and how many of them are named.
const POSSIBLE: f64 = 0.05;
const MOST_UNDECIDED: usize = 6;

/// The misfits of the base model: the significant curves of the first round.
pub(super) fn misfit(
    hypothesis: &Hypothesis<'_>,
    first_round: &[ScoredCandidate],
    level: f64,
) -> Vec<Misfit> {
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
    let mut all: Vec<Misfit> = first_round.iter().filter_map(one).collect();
    let name = |misfit: &Misfit| (misfit.column.clone(), misfit.observable);
    all.sort_by(|a, b| b.gain.total_cmp(&a.gain).then_with(|| name(a).cmp(&name(b))));
    all.truncate(MOST_MISFITS);
    all
}

/// The record without rows, errors, misfits, gains, verdict and sample.
pub(super) fn record(hypothesis: &Hypothesis<'_>, choice: &CauseChoice, options: &Options) -> Diagnosis {
    let data = hypothesis.data;
    let builder = FindingBuilder { hypothesis, level: options.level };
    let mut findings: Vec<Finding> = Vec::new();
    let mut calibration = Vec::new();
    for discovery in &choice.discoveries {
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
    if choice.data.search.len() < UNDECIDED_ROWS {
        for finding in &mut findings {
            finding.indistinguishable_from.extend(possible_laws(finding));
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
    if Part::Effect(effect).axes(|input| data.range(input), false).is_some() {
        return None;
    }
    let constant = effect.inputs.iter().copied().filter(|input| data.range(input).is_none());
    let reason = format!("{} does not vary in the data", constant.collect::<Vec<_>>().join(", "));
    Some(NotExamined { cause, reason })
}

/// Effects that depend on the column of an unknown cause. Few readings do not tell a law from a curve.
fn possible_laws(finding: &Finding) -> Vec<String> {
    let Some(column) = finding.cause.strip_prefix("unknown:") else { return Vec::new() };
    let effects = EFFECTS.iter().filter(|effect| effect.inputs.contains(&column));
    effects.map(|effect| effect.id.to_owned()).collect()
}

/// With few rows, a cause that the data cannot tell from others is no finding, nor ever one that resampled data hardly name: all of them
/// are undecided.
pub(super) fn undecided(findings: &[Finding], choice: &CauseChoice) -> Vec<String> {
    let Some(first) = findings.first() else { return Vec::new() };
    let mut all = vec![first.cause.clone()];
    all.extend(first.indistinguishable_from.iter().cloned());
    let few = choice.data.search.len() < UNDECIDED_ROWS;
    let unsure = few && all.len() > 1 && first.certainty < LEAST_CERTAINTY;
    if unsure || first.certainty < HARDLY_EVER { all } else { Vec::new() }
}

/// Candidates that may carry a misfit which the errors show, if none is significant by itself.
pub(super) fn possible_causes(fit: &Fit, choice: &CauseChoice) -> Vec<String> {
    if !choice.discoveries.is_empty() || !is_refuted(fit) {
        return Vec::new();
    }
    let mut possible: Vec<&ScoredCandidate> =
        choice.first_round.iter().filter(|c| c.addition.is_systematic() && c.p_value < POSSIBLE).collect();
    possible.sort_by(|a, b| b.gain().total_cmp(&a.gain()));
    let mut names: Vec<String> = Vec::new();
    for name in possible.iter().map(|candidate| candidate.addition.name(&choice.data)) {
        // A column may explain e_n and e_t.
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.truncate(MOST_UNDECIDED);
    names
}

/// Whether the base model is refuted by its own errors.
pub(super) fn is_refuted(fit: &Fit) -> bool {
    fit.base.against != "structure" && fit.base.p_value.is_some_and(|p| p < REFUTED)
}

/// The verdict: the result in a few sentences.
pub(super) fn sentences(diagnosis: &Diagnosis) -> String {
    let rows = diagnosis.rows.used;
    let mut text = fit_sentence(&diagnosis.fit);
    if let Some(rival) = diagnosis.rivals.first().filter(|_| diagnosis.findings.is_empty()) {
        text += &format!("{} No physics is named before this is checked.", rival.explanation);
        return text;
    }
    let cause = |finding: &Finding| {
        let name = match finding.cause.strip_prefix("unknown:") {
            Some(column) => format!("a dependence on {}", column.replace('*', " and ")),
            None => finding.cause.clone(),
        };
        match finding.indistinguishable_from.as_slice() {
            [] => name,
            others => format!("{name} (or, as these data cannot tell, {})", others.join(" or ")),
        }
    };
    let causes: Vec<String> = diagnosis.findings.iter().map(cause).collect();
    let value = |c: &Calibration| format!("{} = {} instead of {}", c.key, c.value, c.from);
    let values = diagnosis.calibration.iter().map(value).collect::<Vec<_>>().join(", ");
    text += &match (causes.as_slice(), values.is_empty()) {
        ([], true) => nothing_found(diagnosis),
        ([], false) => format!("The data support {values}; no further effect is significant."),
        ([one], _) => format!("The model lacks {one}."),
        (several, _) => format!("The model lacks {} effects: {}.", several.len(), several.join(", ")),
    };
    if !causes.is_empty() && !values.is_empty() {
        text += &format!(" The data also support {values}.");
    }
    if let Some(finding) = diagnosis.findings.first().filter(|finding| finding.certainty < LEAST_CERTAINTY) {
        text += &format!(
            " {} is named in only {:.0} % of resampled data sets: take it as a hint.",
            finding.cause,
            100.0 * finding.certainty
        );
    }
    if let Some(rival) = diagnosis.rivals.first() {
        text += &format!(" Check this first: {}", rival.explanation);
    }
    text += &diagnosis.gain.as_ref().map_or(String::new(), gain_sentence);
    if let Some(Unexplained { measured, expected }) = &diagnosis.unexplained_capture {
        text += &format!(
            " {:.1} % of the impacts were captured, but the model predicts {:.1} %; no column explains the difference.",
            100.0 * measured,
            100.0 * expected
        );
    }
    if let Some(groups) = &diagnosis.groups {
        text += &format!(
            " Rows of one {} share an error ({} groups): an effect must be seen beside it.",
            groups.column, groups.count
        );
    }
    if rows < WARNED_ROWS {
        text += &format!(" With only {rows} rows, an effect of usual size may go undetected.");
    }
    text
}

/// What the test of fit says of the base model, where there are stated errors or replicates.
pub(super) fn fit_sentence(fit: &Fit) -> String {
    let FitTest { against, chi_square, degrees_of_freedom, p_value } = &fit.base;
    let (Some(chi_square), Some(freedom), Some(p)) = (chi_square, degrees_of_freedom, p_value) else {
        return String::new();
    };
    let against = if *against == "replicates" { "scatter of the replicates" } else { "stated errors" };
    if *p >= REFUTED {
        return format!(
            "The {against} agree with the base model (chi-square {chi_square:.1} for {freedom}). "
        );
    }
    let misfit = |one: &LargeMisfit| format!("line {} by {:+.1}", one.line, one.standard_errors);
    let misfits: Vec<String> = fit.largest.iter().take(3).map(misfit).collect();
    let misfits = match misfits.as_slice() {
        [] => String::new(),
        some => format!("; the largest misfits in standard errors: {}", some.join(", ")),
    };
    format!(
        "The {against} speak against the base model: chi-square {chi_square:.1} for {freedom} readings, by chance once in \
         {:.0e}{misfits}. ",
        1.0 / p.max(1e-300)
    )
}

/// The verdict without a cause.
fn nothing_found(diagnosis: &Diagnosis) -> String {
    let rows = diagnosis.rows.used;
    if !diagnosis.undecided.is_empty() {
        let causes = diagnosis.undecided.join(", ");
        return format!("These data speak against the model, but cannot tell which of {causes}.");
    }
    if diagnosis.unexplained_capture.is_some() {
        return format!(
            "In {rows} rows no effect is significant, but the model does not reproduce the captures."
        );
    }
    if is_refuted(&diagnosis.fit) {
        return "No effect of the library and no column carries the misfit: either the stated errors are too small, or the \
                cause is none of these."
            .to_owned();
    }
    format!("In {rows} rows no deviation from the model is significant.")
}

fn gain_sentence(gain: &Gain) -> String {
    let Gain { held_out_rows, observable, rmse_before, rmse_after, ci95, measured, .. } = gain;
    let errors = format!("the root mean square error in {observable}");
    if ci95[1] < 1.0 {
        return format!(
            " On {held_out_rows} {measured} rows {errors} falls from {rmse_before:.3} to {rmse_after:.3}."
        );
    }
    format!(
        " On {held_out_rows} {measured} rows {errors} does not fall significantly ({rmse_before:.3} before, \
         {rmse_after:.3} after); the mean log score of a row is {:.3} before and {:.3} after.",
        gain.log_score_before, gain.log_score_after
    )
}
