//! The page of a diagnosis of a rig.

mod blame;
mod cause;
mod fit;
mod gain;
mod next;
mod over_setting;
mod parity;
mod readings;
mod series;
mod setting;
#[cfg(test)]
mod tests;
mod usage;
mod words;

use super::diagnosis::{add_calibration, add_explanations, add_overview, add_rejected, quoted, rivals};
use super::page::{Callout, Page, RowStatus};
use crate::diagnose::Diagnosis;
use crate::diagnose::rig::RigDiagnosis;

/// What a page needs beside the diagnosis.
pub struct RigPage<'a> {
    /// Path of the data file.
    pub data: &'a str,
    /// What predicts the readings.
    pub source: RigSource<'a>,
}

/// What predicts the readings of a rig.
pub enum RigSource<'a> {
    /// `nearwall simulate` with a case.
    Case {
        /// Path of the case file.
        file: &'a str,
        /// The number of a setting in the case, for experiments that do not change it.
        number: &'a dyn Fn(&str) -> Option<f64>,
    },
    /// Impacts that OpenFOAM recorded.
    Recorded {
        /// Path of the folder with the cases.
        folder: &'a str,
        /// Path of their model file.
        model: &'a str,
    },
}

/// The page: verdict, fit, measured against predicted values, causes, changed numbers, gain, what
/// to measure next, what cannot be seen, all readings, rows left out, method, how to run the
/// extended model.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(found: &RigDiagnosis, from: &RigPage<'_>) -> Result<String, askama::Error> {
    let diagnosis = &found.diagnosis;
    let file = from.data.rsplit(['/', '\\']).next().unwrap_or(from.data);
    let mut page = Page::new(&format!("Diagnosis of the rig in {file}"));
    page.verdict(vec![diagnosis.verdict.clone(), used(found)]);
    add_notes(&mut page, &found.notes);
    fit::add(&mut page, found);
    rivals::add_undecided(&mut page, diagnosis);
    blame::add(&mut page, found);
    page.heading("Measured against predicted");
    let in_case: &dyn Fn(&str) -> Option<f64> = match from.source {
        RigSource::Case { number, .. } => number,
        RigSource::Recorded { .. } => &|_| None,
    };
    let over = over_setting::figures(&mut page, found, in_case);
    page.figures(over.into_iter().chain(parity::figures(found)));
    add_explanations(&mut page, diagnosis);
    add_overview(&mut page, &words::findings(&diagnosis.findings));
    for (place, finding) in diagnosis.findings.iter().enumerate() {
        cause::add(&mut page, finding, place);
    }
    page.heading("Changed numbers of the base model");
    add_calibration(&mut page, &diagnosis.calibration);
    gain::add(&mut page, found);
    next::add(&mut page, found);
    usage::add_not_examined(&mut page, diagnosis);
    readings::add(&mut page, found);
    add_rejected(&mut page, &diagnosis.rows);
    add_method(&mut page, diagnosis, from);
    usage::add_commands(&mut page, found, from);
    let source = match from.source {
        RigSource::Case { file, .. } => format!("{} and {file}", from.data),
        RigSource::Recorded { folder, model } => format!("{}, {folder} and {model}", from.data),
    };
    page.foot(&format!("Made from {source} with seed {}.", diagnosis.seed));
    page.html()
}

/// "20 rows read, 19 used: 12 experiments with 31 readings."
fn used(found: &RigDiagnosis) -> String {
    let rows = &found.diagnosis.rows;
    let [experiments, readings] =
        [(readings::experiments(found), "experiment"), (found.readings.len(), "reading")]
            .map(|(count, name)| format!("{count} {name}{}", if count == 1 { "" } else { "s" }));
    let left_out = match rows.rejected.len() {
        0 => String::new(),
        1 => " 1 row was left out, see \"Rows left out\".".to_owned(),
        count => format!(" {count} rows were left out, see \"Rows left out\"."),
    };
    format!("{} rows read, {} used: {experiments} with {readings}.{left_out}", rows.read, rows.used)
}

fn add_notes(page: &mut Page, notes: &[String]) {
    if notes.is_empty() {
        return;
    }
    let lines = notes.iter().map(|note| rivals::as_sentence(note)).collect();
    let title = "How the data file was read".to_owned();
    page.callout(Callout { status: RowStatus::Open, title, lines, table: None });
}

fn add_method(page: &mut Page, diagnosis: &Diagnosis, from: &RigPage<'_>) {
    let Diagnosis { seed, level, .. } = diagnosis;
    page.heading("How it was judged");
    let (does, options) = match from.source {
        RigSource::Case { file, .. } => ("simulates every experiment", format!("--case {}", quoted(file))),
        RigSource::Recorded { folder, model } => (
            "decides again every impact that OpenFOAM recorded",
            format!("--impacts {} --model {}", quoted(folder), quoted(model)),
        ),
    };
    page.note(format!(
        "The base model {does}; a candidate changes its wall law, or with --case a number of the case. Candidates are \
            every effect of the library whose inputs vary over the impacts, the numbers of the base model's own laws, \
            and free curves over the inputs whose mean changes from experiment to experiment. Explanations are \
            compared by their evidence, which counts parameters and prior probabilities, beside a scatter between \
            runs that all of them share; a cause is named from a probability of 0.8 on, unless experiments that it \
            has not seen are predicted worse. Intervals hold 95 % of draws from the likelihood of all parameters \
            together. The gain is cross-validated over whole experiments. Seed {seed} decides the draws and the parts \
            of the cross-validation. docs/how-to/rig-diagnosis.md of nearwall describes the method and its limits."
    ));
    let data = quoted(from.data);
    page.code(format!(
        "nearwall diagnose {data} \\\n  {options} \\\n  --seed {seed} --level {level} --out DIR"
    ));
}
