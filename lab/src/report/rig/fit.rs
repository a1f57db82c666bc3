//! The box "Does the simulation fit?".

use super::super::diagnosis::fit::{TOO_GOOD, extends, refuted, two_digits};
use super::super::format::{by_chance, number};
use super::super::page::{Callout, Page, RowStatus, Table};
use super::words;
use crate::diagnose::rig::RigDiagnosis;
use crate::diagnose::{FitTest, LargeMisfit};

pub(super) fn add(page: &mut Page, found: &RigDiagnosis) {
    let fit = &found.diagnosis.fit;
    let (status, answer) = answer(found);
    let mut lines = vec![answer.to_owned(), sentence("base", &fit.base)];
    if extends(&found.diagnosis) {
        lines.push(sentence("extended", &fit.extended));
    }
    if fit.extended.chi_square.is_some() && fit.extended.p_value.is_some_and(|p| p > TOO_GOOD) {
        lines.push(
            "The misfit is smaller than chance allows. The stated errors are probably too large: are they standard \
                errors of each reading, not the spread of single impacts or a 95 % interval?"
                .to_owned(),
        );
    }
    let title = "Does the simulation fit?".into();
    page.callout(Callout { status, title, lines, table: largest(found) });
}

fn answer(found: &RigDiagnosis) -> (RowStatus, &'static str) {
    let fit = &found.diagnosis.fit;
    let tested = fit.base.chi_square.is_some();
    match (refuted(&fit.base), extends(&found.diagnosis)) {
        (false, false) if !tested => (
            RowStatus::Good,
            "As far as these data can tell: no candidate explains the differences. Whether they are those of the \
                measurement cannot be said, because not every reading has a count or a standard error.",
        ),
        (false, false) => {
            (RowStatus::Good, "Yes. The misfit of the base model is no larger than chance allows.")
        }
        (false, true) => (
            RowStatus::Good,
            "The misfit of the base model as a whole is no larger than chance allows, but part of it has a cause that \
                is significant by itself.",
        ),
        (true, false) => {
            (RowStatus::Watch, "No. The base model misses the readings by more than chance allows.")
        }
        (true, true) if refuted(&fit.extended) => (
            RowStatus::Watch,
            "No, and the extended model does not fit either: something is still missing, or the errors are larger \
                than stated.",
        ),
        (true, true) => (RowStatus::Good, "The base model does not; the extended model does."),
    }
}

fn sentence(model: &str, test: &FitTest) -> String {
    let chance = test.p_value.map(by_chance);
    match (test.chi_square, test.degrees_of_freedom, chance) {
        (Some(chi_square), Some(freedom), chance) if freedom > 0 => {
            let chance = chance
                .map_or(String::new(), |chance| format!(" A misfit this large happens by chance {chance}."));
            format!(
                "The {model} model: chi-square is {} with {freedom} degree{} of freedom, {} for each, where about 1 \
                    is expected.{chance}",
                two_digits(chi_square),
                if freedom == 1 { "" } else { "s" },
                two_digits(chi_square / freedom as f64)
            )
        }
        (_, _, Some(chance)) => format!(
            "The {model} model: not every reading has a count or a standard error, so the test asks whether any \
                candidate explains what is left. What the best one gains happens by chance {chance}."
        ),
        _ => format!("The {model} model was not tested: there is nothing to compare its misfit with."),
    }
}

fn largest(found: &RigDiagnosis) -> Option<Table> {
    let row = |one: &LargeMisfit| {
        let same = |row: &&crate::diagnose::rig::RigRow| row.line == one.line && row.measured == one.measured;
        let reading = found.readings.iter().find(same);
        vec![
            one.line.to_string(),
            reading.map_or(String::new(), |row| row.experiment.clone()),
            reading.map_or(words::kind(one.observable).to_owned(), |row| row.observable.clone()),
            number(one.measured),
            number(one.predicted),
            format!("{:+.1}", one.standard_errors),
        ]
    };
    let rows: Vec<_> = found.diagnosis.fit.largest.iter().map(row).collect();
    let header =
        ["line", "experiment", "observable", "measured [1]", "base model [1]", "off by [standard errors]"];
    let caption = "The largest misfits of the base model; the header of the data file is line 1.";
    (!rows.is_empty()).then(|| Table::new(caption, 3, &header, rows))
}
