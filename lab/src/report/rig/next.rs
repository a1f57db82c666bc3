//! What to measure next.

use super::super::diagnosis::cause_title;
use super::super::format::number;
use super::super::page::{Page, Table};
use super::readings::short;
use crate::diagnose::rig::{NextExperiment, RigDiagnosis};

/// Factors beyond this are not written out.
const LARGEST_SHOWN: f64 = 1000.0;

/// Adds the proposed experiments, if there are any.
pub(super) fn add(page: &mut Page, found: &RigDiagnosis) {
    if found.next.is_empty() {
        return;
    }
    page.heading("What to measure next");
    page.text(
        "These experiments are expected to tell most; next_experiments.csv has them with the columns of the data \
            file, to be filled in. Settings that are not named are as in the case.",
    );
    let rows = found.next.iter().enumerate().map(|(place, next)| row(place, next)).collect();
    let header = [
        "",
        "settings",
        "observable",
        "what each cause predicts [1]",
        "separates the causes by a factor",
        "narrows the prediction by a factor",
        "particles or repeats",
    ];
    page.table(Table::new("", 4, &header, rows));
    page.note(
        "The first factor is the expected ratio of the likelihoods of the causes, the second the ratio of the errors \
            of the extended model's prediction before and after, each for a reading with the usual count or error of \
            the file. Particles or repeats: how many decide between the two leading causes; none where these predict \
            nearly the same.",
    );
}

fn row(place: usize, next: &NextExperiment) -> Vec<String> {
    let settings: Vec<String> =
        next.settings.iter().map(|(key, cell)| format!("{key} = {}", short(cell))).collect();
    let predicted: Vec<String> = next
        .predicted
        .iter()
        .map(|(cause, value)| format!("{}: {}", cause_title(cause), number((1e3 * value).round() / 1e3)))
        .collect();
    vec![
        (place + 1).to_string(),
        if settings.is_empty() { "as in the case".to_owned() } else { settings.join(", ") },
        next.observable.clone(),
        predicted.join(", "),
        factor(next.tells_causes),
        factor(next.pins_numbers),
        next.repeats.map_or(String::new(), |repeats| repeats.to_string()),
    ]
}

/// The factor with this logarithm.
fn factor(logarithm: f64) -> String {
    if logarithm < LARGEST_SHOWN.ln() {
        format!("{:.1}", logarithm.exp())
    } else {
        format!("> {LARGEST_SHOWN}")
    }
}
