//! The table of all readings.

use super::super::diagnosis::fit::extends;
use super::super::format::number;
use super::super::page::{Page, Table};
use crate::diagnose::rig::{RigDiagnosis, RigRow};

/// Most readings listed.
const LISTED_READINGS: usize = 500;

/// Number of experiments.
pub(super) fn experiments(found: &RigDiagnosis) -> usize {
    let mut names: Vec<&str> = found.readings.iter().map(|row| row.experiment.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names.len()
}

pub(super) fn add(page: &mut Page, found: &RigDiagnosis) {
    page.heading("All readings");
    let extended = extends(&found.diagnosis);
    let held_out = extended && found.readings.iter().any(|row| row.held_out.is_some());
    let columns = 5 + usize::from(extended) + usize::from(held_out);
    let mut last = "";
    let rows = found.readings.iter().take(LISTED_READINGS).map(|row| {
        let first = row.experiment != last;
        last = &row.experiment;
        let mut cells = cells(row, first);
        cells.truncate(columns);
        cells
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let header = [
        "experiment",
        "settings that differ from the case",
        "observable",
        "measured [1]",
        "base model [1]",
        "extended model [1]",
        "held out [1]",
    ];
    let caption = match (extended, held_out) {
        (false, _) => "Measured value ± standard error and the value of the base model.",
        (true, false) => "Measured value ± standard error and the values of both models.",
        (true, true) => {
            "Measured value ± standard error, the values of both models, and that of a model chosen and fitted \
                without the experiment."
        }
    };
    page.table(Table::new(caption, 3, &header[..columns], rows));
    if found.readings.len() > LISTED_READINGS {
        page.text(format!(
            "… and {} more; diagnosis.json lists them all.",
            found.readings.len() - LISTED_READINGS
        ));
    }
}

/// The cells of a reading; the settings only at the first one of an experiment.
fn cells(row: &RigRow, first: bool) -> Vec<String> {
    let settings: Vec<String> =
        row.settings.iter().map(|(key, cell)| format!("{key} = {}", short(cell))).collect();
    let settings = if first { settings.join(", ") } else { String::new() };
    let of = |value: Option<f64>| value.map_or("–".to_owned(), three_digits);
    let measured = format!("{} ± {}", three_digits(row.measured), three_digits(row.error));
    let experiment = row.experiment.clone();
    vec![
        experiment,
        settings,
        row.observable.clone(),
        measured,
        of(row.base),
        of(row.extended),
        of(row.held_out),
    ]
}

/// A cell as a short number, or as it is.
pub(super) fn short(cell: &str) -> String {
    cell.parse().map_or_else(|_| cell.to_owned(), number)
}

/// A value with up to four digits after the point.
fn three_digits(value: f64) -> String {
    number((1e4 * value).round() / 1e4)
}
