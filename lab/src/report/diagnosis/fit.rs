//! The box "Does the model fit?": chi-square of both models, in words, and the rows that are farthest off.

use super::super::format::{by_chance, number};
use super::super::page::{Callout, Page, RowStatus, Table};
use crate::diagnose::{Diagnosis, FitTest, LargeMisfit};

/// A model whose misfit is less likely than this does not fit.
const REFUTED_BELOW: f64 = 0.01;
/// Misfits that are smaller than those of all but this share of data sets are too small for the stated errors.
pub(in crate::report) const TOO_GOOD: f64 = 0.999;
/// Most rows listed.
const LISTED_MISFITS: usize = 8;
/// Points beyond this many of their stated errors are off, whatever a test says.
const FAR_ERRORS: f64 = 3.0;

/// Adds the box, if the fit was tested.
pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    let fit = &diagnosis.fit;
    if fit.base.against.is_empty() {
        return;
    }
    let (status, answer) = answer(diagnosis);
    let mut lines = vec![answer, sentence("base", &fit.base)];
    if let Some((far, all)) = far_points(diagnosis).filter(|(far, _)| *far > 0) {
        lines.push(format!(
            "{far} of {all} points lie more than 3 stated standard errors from the base model."
        ));
    }
    if extends(diagnosis) && !fit.extended.against.is_empty() {
        lines.push(sentence("extended", &fit.extended));
    }
    if fit.base.against == "stated errors" && fit.extended.p_value.is_some_and(|p| p > TOO_GOOD) {
        lines.push(
            "The misfit is smaller than chance allows. The stated errors are probably too large: are they standard \
                errors of each value, not the spread of single impacts or a 95 % interval?"
                .to_owned(),
        );
    }
    page.callout(Callout {
        status,
        title: "Does the model fit?".into(),
        lines,
        table: largest(&fit.largest),
    });
}

/// Whether the base model is refuted: by the test of fit, or because most points lie far beyond their stated errors.
pub(super) fn base_is_refuted(diagnosis: &Diagnosis) -> bool {
    refuted(&diagnosis.fit.base) || most_points_are_far(diagnosis)
}

pub(in crate::report) fn refuted(test: &FitTest) -> bool {
    test.p_value.is_some_and(|p| p < REFUTED_BELOW)
}

fn most_points_are_far(diagnosis: &Diagnosis) -> bool {
    far_points(diagnosis).is_some_and(|(far, all)| 2 * far > all)
}

/// Number of points far from the base model, and of all points with a stated error; `None` where none has one.
fn far_points(diagnosis: &Diagnosis) -> Option<(usize, usize)> {
    let rows = diagnosis.sample.rows.iter();
    let points = rows.flat_map(|row| row.values.iter().zip(row.errors));
    let deviations = points.filter_map(|(numbers, error)| {
        let ([measured, base, _], error) = ((*numbers)?, error?);
        Some((measured - base).abs() / error)
    });
    let (far, near): (Vec<f64>, Vec<f64>) = deviations.partition(|deviation| *deviation > FAR_ERRORS);
    let all = far.len() + near.len();
    (all > 0).then_some((far.len(), all))
}

/// Whether the extended model differs from the base model.
pub(in crate::report) fn extends(diagnosis: &Diagnosis) -> bool {
    !(diagnosis.findings.is_empty() && diagnosis.calibration.is_empty())
}

/// The answer in a sentence and its colour.
fn answer(diagnosis: &Diagnosis) -> (RowStatus, String) {
    let fit = &diagnosis.fit;
    let known = fit.base.p_value.is_some() || most_points_are_far(diagnosis);
    let (status, text) = match (known, base_is_refuted(diagnosis), extends(diagnosis)) {
        (false, ..) => (
            RowStatus::Open,
            "This cannot be said: the file states no standard errors and repeats no setting, so there is nothing to \
                compare the misfit with.",
        ),
        (true, false, false) if fit.base.against == "structure" => (
            RowStatus::Good,
            "As far as these data can tell: no column shapes the residuals. Whether their scatter is that of the \
                measurement cannot be said without stated errors or repeated settings.",
        ),
        (true, false, false) => {
            (RowStatus::Good, "Yes. The misfit of the base model is no larger than chance allows.")
        }
        (true, false, true) => (
            RowStatus::Good,
            "The misfit of the base model as a whole is no larger than chance allows, but part of it has a cause that \
                is significant by itself.",
        ),
        (true, true, false) => {
            (RowStatus::Watch, "No. The base model misses the data by more than chance allows.")
        }
        (true, true, true) if refuted(&fit.extended) => (
            RowStatus::Watch,
            "No, and the extended model does not fit either: something is still missing, or the errors are larger than \
             stated.",
        ),
        (true, true, true) if fit.extended.p_value.is_none() => {
            (RowStatus::Watch, "The base model does not. The extended model was not tested.")
        }
        (true, true, true) => (RowStatus::Good, "The base model does not; the extended model does."),
    };
    (status, text.to_owned())
}

/// "Base model against the stated errors: chi-square is 412 with 8 degrees of freedom (51.5 each; …)".
fn sentence(model: &str, test: &FitTest) -> String {
    let against = match test.against {
        "stated errors" => "against the stated errors",
        "replicates" => "against the scatter of repeated measurements",
        "structure" => "the residuals over each column",
        _ => {
            return format!("The {model} model was not tested: there is nothing to compare its misfit with.");
        }
    };
    let mut text = format!("The {model} model, {against}: ");
    match (test.chi_square, test.degrees_of_freedom) {
        (Some(chi_square), Some(freedom)) if freedom > 0 => {
            text += &format!(
                "chi-square is {} with {freedom} degree{} of freedom, {} for each, where about 1 is expected.",
                two_digits(chi_square),
                if freedom == 1 { "" } else { "s" },
                two_digits(chi_square / freedom as f64)
            );
        }
        _ => {
            text += "no errors are stated and no setting is repeated, so the test asks whether any column shapes them."
        }
    }
    if let Some(p_value) = test.p_value {
        let misfit =
            if test.against == "structure" { "A pattern this strong" } else { "A misfit this large" };
        text += &format!(" {misfit} happens by chance {}.", by_chance(p_value));
    }
    text
}

/// A number with at most two decimals, whole from 100 on.
pub(in crate::report) fn two_digits(value: f64) -> String {
    number(if value < 100.0 { (100.0 * value).round() / 100.0 } else { value.round() })
}

fn largest(rows: &[LargeMisfit]) -> Option<Table> {
    let row = |one: &LargeMisfit| {
        vec![
            one.line.to_string(),
            one.observable.to_owned(),
            number(one.measured),
            number(one.predicted),
            format!("{:+.1}", one.standard_errors),
        ]
    };
    let header = ["line", "observable", "measured [1]", "base model [1]", "off by [standard errors]"];
    let rows: Vec<_> = rows.iter().take(LISTED_MISFITS).map(row).collect();
    let caption = "The largest misfits of the base model; the header of the data file is line 1.";
    (!rows.is_empty()).then(|| Table::new(caption, 2, &header, rows))
}
