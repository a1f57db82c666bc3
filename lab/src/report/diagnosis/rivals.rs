//! Boxes above the causes: what to check in the data file, rivals of a cause, and causes that cannot be told apart.

use super::super::format::{listed, number};
use super::super::page::{Callout, Page, RowStatus, Table};
use super::{cause_title, plot::title, probability};
use crate::diagnose::{Diagnosis, Rival};
use nearwall::effect::EFFECTS;

/// What was assumed about the data file, and what looks like a mistake in it.
pub(super) fn add_notes(page: &mut Page, diagnosis: &Diagnosis) {
    let notes = &diagnosis.sample.notes;
    if notes.is_empty() {
        return;
    }
    let first = "The result rests on this reading of the data file; check it first.".to_owned();
    let lines = std::iter::once(first).chain(notes.iter().map(|note| as_sentence(note))).collect();
    let title = "How the data file was read".to_owned();
    page.callout(Callout { status: RowStatus::Open, title, lines, table: None });
}

/// A note with a capital and a full stop; a name of a column keeps its small letter.
pub(in crate::report) fn as_sentence(note: &str) -> String {
    let word: String = note.chars().take_while(|letter| letter.is_alphanumeric() || *letter == '_').collect();
    let name = word.contains('_') || word.chars().count() < 2;
    let mut letters = note.chars();
    let first: String = match letters.next() {
        Some(first) if !name => first.to_uppercase().collect(),
        first => first.into_iter().collect(),
    };
    let stop = if note.ends_with(['.', '?', '!']) { "" } else { "." };
    format!("{first}{}{stop}", letters.as_str())
}

/// Slips of input and artefacts of measurement.
pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    if diagnosis.rivals.is_empty() {
        return;
    }
    let first = "A slip in the data file or an artefact of the measurement may explain the misfit without a new \
        effect. Rule these out first; if one is true, correct the file or its column map and run the diagnosis again.";
    let sentences = diagnosis.rivals.iter().map(|rival| sentence(rival, diagnosis));
    let lines = std::iter::once(first.to_owned()).chain(sentences).collect();
    page.callout(Callout {
        status: RowStatus::Watch,
        title: "Before physics is blamed".into(),
        lines,
        table: None,
    });
}

fn sentence(rival: &Rival, diagnosis: &Diagnosis) -> String {
    let kind = match rival.id.split(':').next() {
        Some("slip") => "Input: ",
        Some("artefact") => "Measurement: ",
        _ => "",
    };
    let fall = number((2.0 * rival.gain).round());
    let mut text = format!(
        "{kind}{} With it chi-square of {} falls by {fall}",
        as_sentence(&rival.explanation),
        title(rival.observable)
    );
    if !(diagnosis.findings.is_empty() && diagnosis.undecided.is_empty()) {
        let lead = 2.0 * rival.lead;
        text += &match (lead.abs().round(), lead > 0.0) {
            (0.0, _) => ", as much as with the best cause".to_owned(),
            (size, true) => format!(", {} more than with the best cause", number(size)),
            (size, false) => format!(", {} less than with the best cause", number(size)),
        };
    }
    text + &format!("; its probability is {}.", probability(rival.probability))
}

/// The title of the box with these causes.
pub(super) fn undecided_title(causes: &[String]) -> &'static str {
    if causes.len() == 1 { "A cause that may be missing" } else { "One of several causes" }
}

/// Causes of which one is significant, if the data cannot tell which.
pub(in crate::report) fn add_undecided(page: &mut Page, diagnosis: &Diagnosis) {
    let causes = &diagnosis.undecided;
    if causes.is_empty() {
        return;
    }
    let names: Vec<String> = causes.iter().map(|cause| cause_title(cause)).collect();
    let first = match names.as_slice() {
        [only] => {
            format!("The data cannot tell whether the model lacks {only}. It is not in the extended model.")
        }
        several => format!(
            "The data cannot tell which of {} the model lacks. None is in the extended model.",
            listed(several, "or")
        ),
    };
    let lines = vec![first, to_separate(causes)];
    page.callout(Callout {
        status: RowStatus::Open,
        title: undecided_title(causes).into(),
        lines,
        table: Some(candidates(causes)),
    });
}

pub(in crate::report) fn candidates(causes: &[String]) -> Table {
    let row = |cause: &String| {
        let effect = EFFECTS.iter().find(|effect| effect.id == cause);
        vec![
            cause_title(cause),
            effect.map_or_else(|| without_effect(cause), |effect| effect.about).to_owned(),
            inputs(cause).join(", "),
        ]
    };
    Table::new("", 3, &["cause", "what it does", "depends on"], causes.iter().map(row).collect())
}

/// What a cause does that is no effect of the library.
fn without_effect(cause: &str) -> &'static str {
    match cause.split(':').next() {
        Some("level" | "level-shift") => "shifts all readings alike",
        Some("capture-ceiling") => "lets a share of what the law captures bounce",
        Some("unknown") => "acts by no law of the library",
        Some("case") => "is wrong in the case",
        _ => "",
    }
}

/// The inputs of a cause.
fn inputs(cause: &str) -> Vec<&str> {
    let effect = EFFECTS.iter().find(|effect| effect.id == cause);
    match (cause.strip_prefix("unknown:"), effect) {
        (Some(columns), _) => columns.split('*').collect(),
        (None, Some(effect)) => effect.inputs.to_vec(),
        (None, None) => Vec::new(),
    }
}

/// The inputs to vary: those on which some of the causes depend and others do not.
pub(in crate::report) fn to_separate(causes: &[String]) -> String {
    let mut all: Vec<&str> = causes.iter().flat_map(|cause| inputs(cause)).collect();
    all.sort_unstable();
    all.dedup();
    if let [_] = causes {
        return format!("Measure over a wider range of {}, or with smaller errors.", listed(&all, "and"));
    }
    let phrase = |input: &str| {
        let depends: Vec<String> = causes
            .iter()
            .filter(|cause| inputs(cause).contains(&input))
            .map(|cause| cause_title(cause))
            .collect();
        let verb = if depends.len() == 1 { "depends" } else { "depend" };
        (depends.len() < causes.len())
            .then(|| format!("{input} (only {} {verb} on it)", listed(&depends, "and")))
    };
    let phrases: Vec<String> = all.into_iter().filter_map(phrase).collect();
    if phrases.is_empty() {
        return "All depend on the same inputs: measure over a wider range of them, or with smaller errors."
            .to_owned();
    }
    format!("To tell them apart, vary one of these with everything else constant: {}.", phrases.join(", "))
}
