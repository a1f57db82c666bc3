//! The sentences of a verdict. Those of impacts and of a rig differ in some words.

use super::constants::{LISTED, NAMED, REFUTED};
use super::curve::LEVEL_SHIFT;
use super::explanations::distinct;
use super::record::{
    Calibration, Diagnosis, ExplanationFound, Finding, Fit, FitTest, Gain, LargeMisfit, Rival, Unexplained,
};

/// Smaller chances are not told apart.
const SMALLEST_CHANCE: f64 = 1e-12;
/// Share of chi-square from which on a single reading is nearly all of it [1].
const NEARLY_ALL: f64 = 0.8;
/// From this share of the captures on, a ceiling is none for a reader [1].
const NO_CEILING: f64 = 0.995;
/// With fewer rows the verdict warns that effects may go undetected.
const WARNED_ROWS: usize = 60;

/// The words for what was diagnosed.
pub(super) struct Words {
    /// What lacks causes.
    pub subject: &'static str,
    /// What cannot tell causes apart.
    pub data: &'static str,
    /// What is predicted without having been seen.
    pub unseen: &'static str,
    /// Where nothing carries a misfit.
    pub carries: &'static str,
}

/// The words for measured impacts.
const IMPACTS: Words = Words {
    subject: "model",
    data: "data",
    unseen: "rows",
    carries: "No effect of the library and no column carries the misfit: either the stated errors are too small, or \
        the cause is none of these.",
};

/// Whether the base model is refuted by its own errors.
pub(super) fn is_refuted(fit: &Fit) -> bool {
    fit.base.against != "structure" && fit.base.p_value.is_some_and(|p| p < REFUTED)
}

/// The verdict on impacts: the result in a few sentences.
pub(super) fn sentences(diagnosis: &Diagnosis) -> String {
    let rows = diagnosis.rows.used;
    let mut text = fit_sentence(diagnosis, "");
    if let Some(rival) = diagnosis.rivals.first().filter(|rival| is_best(rival, diagnosis)) {
        let Rival { explanation, .. } = rival;
        text +=
            &format!("{explanation} No physics is named before this is checked.{}", beside(rival, diagnosis));
        return text;
    }
    text += &found(diagnosis, &IMPACTS, || nothing_found(diagnosis, &IMPACTS, &format!("{rows} rows")));
    if let Some(Rival { explanation, probability, .. }) = diagnosis.rivals.first() {
        text += &format!(" Check this, too ({}): {explanation}", probability_words(*probability));
    }
    if let Some(gain) = &diagnosis.gain {
        let seen = format!("{} {} rows", gain.held_out_rows, gain.measured);
        text += &if diagnosis.refuted.is_empty() { gain_sentence(gain) } else { worse_sentence(gain, &seen) };
    }
    if let Some(Unexplained { measured, expected }) = &diagnosis.unexplained_capture {
        text += &format!(
            " {:.1} % of the impacts were captured, but the model predicts {:.1} %; no column explains the difference.",
            100.0 * measured,
            100.0 * expected
        );
    }
    if let Some(ceiling) = diagnosis.capture_ceiling.filter(|ceiling| *ceiling < NO_CEILING) {
        text += &format!(
            " Of the captures that the model predicts {:.1} % happen, whatever the impact: the others are missed, or \
             bounce for another reason.",
            100.0 * ceiling
        );
    }
    let of = match diagnosis.outliers_of[..] {
        [one] => format!(" of {one}"),
        _ => String::new(),
    };
    if let Some(share) = diagnosis.gross_errors {
        text += &format!(
            " Some {:.0} % of the readings{of} lie far from any smooth model: gross errors, or a cause that acts on \
             some impacts and that no column tells. Look at the largest residuals.",
            100.0 * share
        );
    }
    if diagnosis.heavy_tails {
        text += &format!(
            " The scatter has heavy tails: about a quarter of the readings{of} lie some four times as far from the \
             model as the others. Look at the largest residuals."
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

/// Whether the most probable explanation is a rival of physics.
fn is_best(rival: &Rival, diagnosis: &Diagnosis) -> bool {
    diagnosis.explanations.first().is_some_and(|best| best.causes.contains(&rival.id))
}

/// The causes that are probable beside a rival, if it is right.
fn beside(rival: &Rival, diagnosis: &Diagnosis) -> String {
    let with = || diagnosis.explanations.iter().filter(|one| one.causes.contains(&rival.id));
    let share = |cause: &String| {
        let both = with().filter(|one| one.causes.contains(cause)).map(|one| one.probability);
        both.sum::<f64>() / with().map(|one| one.probability).sum::<f64>()
    };
    let others = with().flat_map(|one| &one.causes).filter(|cause| **cause != rival.id);
    let probable =
        distinct(others).into_iter().map(|cause| (share(&cause), cause)).filter(|one| one.0 >= NAMED);
    let causes: Vec<String> =
        probable.map(|(share, cause)| format!("{cause} ({})", probability_words(share))).collect();
    if causes.is_empty() {
        return String::new();
    }
    format!(" If it is so, the data also need {}: correct them and diagnose again.", causes.join(" and "))
}

/// The causes and the changed numbers, or what `nothing` says.
pub(super) fn found(diagnosis: &Diagnosis, words: &Words, nothing: impl FnOnce() -> String) -> String {
    let Words { subject, data, .. } = words;
    let cause = |finding: &Finding| {
        let probability = probability_words(finding.probability);
        let name = match finding.cause.split_once(':') {
            Some(("unknown", column)) => format!("a dependence on {}", column.replace('*', " and ")),
            Some(("level", what)) => format!("a shift of {what}"),
            None if finding.cause == LEVEL_SHIFT => format!("a constant shift of {}", finding.observable),
            _ => finding.cause.clone(),
        };
        match finding.indistinguishable_from.as_slice() {
            [] => format!("{name} ({probability})"),
            others => {
                format!("{name} ({probability}; these {data} do not exclude {})", others.join(" or "))
            }
        }
    };
    let causes: Vec<String> = diagnosis.findings.iter().map(cause).collect();
    let value = |c: &Calibration| format!("{} = {} instead of {}", c.key, c.value, c.from);
    let values = diagnosis.calibration.iter().map(value).collect::<Vec<_>>().join(", ");
    let lacks = match (causes.as_slice(), values.is_empty()) {
        ([], true) => return nothing(),
        ([], false) => {
            return match further(diagnosis, words) {
                Some(further) => format!("The data support {values}.{further}"),
                None => format!("The data support {values}; no further effect is significant."),
            };
        }
        ([one], _) => format!("The {subject} lacks {one}."),
        (several, _) => format!("The {subject} lacks {} effects: {}.", several.len(), several.join(", ")),
    };
    let formulas = formulas(&diagnosis.findings);
    let formula = if formulas.is_empty() { formulas } else { format!(" As a formula: {formulas}.") };
    let numbers = if values.is_empty() { values } else { format!(" The data also support {values}.") };
    let further = further(diagnosis, words).unwrap_or_default();
    format!("{lacks}{formula}{numbers}{further}")
}

/// That a cause is missing beside the named ones, where it is more likely than not and cannot be told.
fn further(diagnosis: &Diagnosis, words: &Words) -> Option<String> {
    let findings = diagnosis.findings.iter().map(|one| one.cause.as_str());
    let named: Vec<&str> =
        findings.chain(diagnosis.calibration.iter().map(|number| number.key.as_str())).collect();
    let is_named = |cause: &String| named.contains(&cause.as_str());
    let has_all = |one: &&ExplanationFound| named.iter().all(|name| one.causes.iter().any(|own| own == name));
    let with: Vec<&ExplanationFound> = diagnosis.explanations.iter().filter(has_all).collect();
    let sum = |of: &dyn Fn(&ExplanationFound) -> bool| -> f64 {
        with.iter().filter(|one| of(one)).map(|one| one.probability).sum()
    };
    let share = sum(&|one| one.causes.len() > named.len()) / sum(&|_| true);
    let mut open: Vec<(f64, &String)> = Vec::new();
    for cause in with.iter().flat_map(|one| &one.causes).filter(|cause| !is_named(cause)) {
        if open.iter().all(|(_, known)| *known != cause) {
            open.push((sum(&|one| one.causes.contains(cause)), cause));
        }
    }
    open.sort_by(|a, b| b.0.total_cmp(&a.0));
    let causes: Vec<String> =
        open.iter().map(|(p, cause)| format!("{cause} ({})", probability_words(*p))).collect();
    (share > 0.5).then(|| {
        format!(
            " A further cause is there ({}), but these {} cannot tell {}.",
            probability_words(share),
            words.data,
            which(&causes)
        )
    })
}

/// What data cannot tell of these causes.
fn which(causes: &[String]) -> String {
    match causes {
        [only] => format!("whether the cause is {only}"),
        several => format!("which of {}", several.join(", ")),
    }
}

/// The equations of all closed forms.
fn formulas(findings: &[Finding]) -> String {
    let forms = findings.iter().flat_map(|finding| &finding.forms);
    forms.map(|form| form.equation.as_str()).collect::<Vec<_>>().join("; ")
}

/// A probability in words.
pub(super) fn probability_words(probability: f64) -> String {
    if probability > 0.995 {
        "probability above 0.99".to_owned()
    } else {
        format!("probability {probability:.2}")
    }
}

/// What the test of fit says of the base model, where there are stated errors or replicates; `beside` says which
/// errors count beside those of the readings.
pub(super) fn fit_sentence(diagnosis: &Diagnosis, beside: &str) -> String {
    let Fit { base: FitTest { against, chi_square, degrees_of_freedom, p_value }, largest, .. } =
        &diagnosis.fit;
    let (Some(chi_square), Some(freedom), Some(p)) = (chi_square, degrees_of_freedom, p_value) else {
        return String::new();
    };
    let against = if *against == "replicates" { "scatter of the replicates" } else { "stated errors" };
    if *p >= REFUTED {
        let Diagnosis { findings, calibration, undecided, .. } = diagnosis;
        let agree = if findings.is_empty() && calibration.is_empty() && undecided.is_empty() {
            "agree with the base model"
        } else {
            "alone do not refute the base model, but the misfit has the shape of a cause"
        };
        return format!("The {against}{beside} {agree} (chi-square {chi_square:.1} for {freedom}). ");
    }
    let misfit = |one: &LargeMisfit| format!("line {} by {:+.1}", one.line, one.standard_errors);
    let misfits: Vec<String> = largest.iter().take(3).map(misfit).collect();
    let listed: f64 = largest.iter().map(|one| one.standard_errors.powi(2)).sum();
    // Errors of a case lower chi-square, but not the misfits of the others.
    let all = listed.max(*chi_square);
    let alone = largest.first().is_some_and(|one| one.standard_errors.powi(2) > NEARLY_ALL * all);
    let misfits = match misfits.as_slice() {
        [] => String::new(),
        [first, ..] if alone => {
            format!("; nearly all of it is one reading, {first} standard errors: check it first")
        }
        some => format!("; the largest misfits in standard errors of the readings: {}", some.join(", ")),
    };
    let chance = match 1.0 / p.max(SMALLEST_CHANCE) {
        times if *p < SMALLEST_CHANCE => format!("less than once in {times:.0e}"),
        times if times < 1e4 => format!("once in {times:.0}"),
        times => format!("once in {times:.0e}"),
    };
    format!(
        "The {against}{beside} speak against the base model: chi-square {chi_square:.1} for {freedom} readings, by \
            chance {chance}{misfits}. "
    )
}

/// The verdict without a cause; `seen` is what was diagnosed, as "40 rows".
pub(super) fn nothing_found(diagnosis: &Diagnosis, words: &Words, seen: &str) -> String {
    let Words { subject, unseen, carries, .. } = words;
    if !diagnosis.refuted.is_empty() {
        let causes = diagnosis.refuted.join(", ");
        return format!(
            "With {causes} the model predicts unseen {unseen} no better than without: nothing is named."
        );
    }
    let as_it_is = |one: &&ExplanationFound| one.causes.is_empty();
    let base: f64 = diagnosis.explanations.iter().filter(as_it_is).map(|one| one.probability).sum();
    if !diagnosis.undecided.is_empty() {
        return cannot_tell(diagnosis, words, base);
    }
    if diagnosis.unexplained_capture.is_some() || diagnosis.capture_ceiling.is_some() {
        return format!("In {seen} no effect is significant, but the model does not reproduce the captures.");
    }
    if is_refuted(&diagnosis.fit) && base >= NAMED {
        return (*carries).to_owned();
    }
    // The test of the residuals' shape names no cause.
    let misfit = match diagnosis.fit.base.p_value {
        Some(p) if p < REFUTED => ", but its misfit is larger than chance allows",
        _ => "",
    };
    if base >= NAMED {
        return format!("In {seen} no deviation from the {subject} is significant{misfit}.");
    }
    format!(
        "In {seen} no cause is probable enough to be named: the base model as it is has the {}{misfit}.",
        probability_words(base)
    )
}

/// That one of several causes is there; the base model as it is has the probability `base`.
fn cannot_tell(diagnosis: &Diagnosis, words: &Words, base: f64) -> String {
    let Words { subject, data, .. } = words;
    let one = |name: &String| {
        let with = diagnosis.explanations.iter().filter(|one| one.causes.contains(name));
        match with.map(|one| one.probability).sum::<f64>() {
            0.0 => name.clone(),
            probability => format!("{name} ({})", probability_words(probability)),
        }
    };
    let causes = which(&diagnosis.undecided.iter().map(one).collect::<Vec<_>>());
    if base <= 1.0 - LISTED {
        return format!("These {data} speak against the {subject}, but cannot tell {causes}.");
    }
    format!(
        "The {subject} probably lacks something ({}), but these {data} cannot tell {causes}.",
        probability_words(1.0 - base)
    )
}

/// Why what was found is not named though an error may fall; `seen` is what was predicted, as "40 rows".
pub(super) fn worse_sentence(gain: &Gain, seen: &str) -> String {
    let Gain { observable, rmse_before, rmse_after, log_score_before, log_score_after, .. } = gain;
    format!(
        " On {seen} the mean log score goes from {log_score_before:.3} to {log_score_after:.3}, and the root mean \
         square error in {observable} from {rmse_before:.3} to {rmse_after:.3}."
    )
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
