//! Whose fault the misfit is.

use super::super::format::{number, whole_percent, with_interval};
use super::super::page::{Page, Table};
use crate::diagnose::rig::{Blame, RigDiagnosis};

/// Adds the parties and their shares, if there is a misfit.
pub(super) fn add(page: &mut Page, found: &RigDiagnosis) {
    if found.blame.is_empty() {
        return;
    }
    let parties = &found.parties;
    let [law, case, both, neither] =
        [parties.wall_law, parties.case, parties.both, parties.neither].map(whole_percent);
    page.heading("Wall law or case");
    page.text(format!(
        "Probability that the wall law is at fault: {law}; the case: {case}; both: {both}; neither, beyond the errors \
            of readings and case: {neither}."
    ));
    let header = [
        "party",
        "what measures it again",
        "share of the misfit",
        "in the case",
        "its error",
        "as the readings show it",
    ];
    page.table(Table::new("", 2, &header, found.blame.iter().map(row).collect()));
}

fn row(one: &Blame) -> Vec<String> {
    let mut cells = vec![one.party.trim_start_matches("case:").to_owned()];
    let Some(found) = &one.number else {
        cells.extend([String::new(), whole_percent(one.share)]);
        cells.extend([(); 3].map(|()| String::new()));
        return cells;
    };
    let (value, interval) = with_interval(found.value, [found.low, found.high]);
    let assumed = if found.stated { "" } else { " (assumed)" };
    cells.extend([
        found.measure.to_owned(),
        whole_percent(one.share),
        format!("{} {}", number(found.from), found.unit),
        format!("{}{assumed}", number(found.error)),
        format!("{value} ({interval})"),
    ]);
    cells
}
