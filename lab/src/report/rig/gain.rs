//! What the extended model gains on experiments that no fit saw.

use super::super::diagnosis::gain::{table, what_is_left};
use super::super::format::number;
use super::super::page::{Page, Table};
use super::words;
use crate::diagnose::Gain;
use crate::diagnose::rig::{KindErrors, RigDiagnosis};

pub(super) fn add(page: &mut Page, found: &RigDiagnosis) {
    let gains: Vec<Gain> = found
        .diagnosis
        .gains
        .iter()
        .map(|gain| Gain { observable: words::kind(gain.observable), ..gain.clone() })
        .collect();
    page.heading("Gain on held-out experiments");
    if gains.is_empty() {
        page.text(match super::super::diagnosis::fit::extends(&found.diagnosis) {
            true => "The experiments are too few to hold some of them back: the errors below are those of the fit, \
                not of a prediction.",
            false => "Nothing was added to the model. Its errors as it is:",
        });
    } else {
        page.text(
            "Whole experiments were held out in turn. For each part of them a model file was chosen and fitted on the \
                other experiments and predicted those held out; extended.toml itself is fitted to all.",
        );
        let mut table = table(&gains);
        if let Some(head) = table.header.get_mut(1) {
            "experiments".clone_into(head);
        }
        page.table(table);
        for gain in &gains {
            page.text(sentence(gain));
        }
        page.note(
            "A ratio below 1 means a smaller error; if the whole interval is below 1, chance does not explain it. The \
                noise floor is the error of the readings themselves, which no model removes.",
        );
    }
    add_errors(page, &found.errors);
}

fn add_errors(page: &mut Page, errors: &[KindErrors]) {
    let row = |one: &KindErrors| {
        let [base, extended] = [one.rmse_base, one.rmse_extended].map(number);
        vec![words::kind(one.observable).to_owned(), one.readings.to_string(), base, extended]
    };
    page.table(Table::new(
        "Root mean square errors on all readings, which the extended model was fitted to [1].",
        1,
        &["observable", "readings", "base model", "extended model"],
        errors.iter().map(row).collect(),
    ));
}

/// What an observable gains, in words.
fn sentence(gain: &Gain) -> String {
    let name = gain.observable;
    let [before, after] = [gain.rmse_before, gain.rmse_after].map(number);
    if gain.rmse_after == gain.rmse_before {
        return format!("{name}: unchanged.");
    }
    if gain.ci95[1] < 1.0 {
        return format!(
            "{name}: on experiments that it has not seen, the extended model is off by {after} instead of {before} \
                (root mean square).{}",
            what_is_left(gain)
        );
    }
    if gain.ci95[0] > 1.0 {
        return format!(
            "{name}: the error rises from {before} to {after}. The extended model predicts it worse."
        );
    }
    format!(
        "{name}: {before} before, {after} after. The interval of the ratio holds 1, so these experiments are too few \
            to say whether the prediction improves."
    )
}
