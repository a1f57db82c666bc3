//! The page of a diagnosis.

mod axis;
mod cause;
mod curve;
mod data;
mod gain;
mod misfit;
mod plot;
mod spread;
mod usage;

use super::format::{number, once_in};
use super::page::{Page, Table};
use crate::dataset::BadRow;
use crate::diagnose::{Calibration, Diagnosis};

/// Most rejected rows listed.
const REJECTED: usize = 50;

/// The page: verdict, measured values with both models, residuals, causes, gain, what to measure next, how to run the
/// extended model.
///
/// `names` are those of the data and the model file, `extended` is the text of the extended model.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(diagnosis: &Diagnosis, names: &[String; 2], extended: &str) -> Result<String, askama::Error> {
    let [data, model] = names;
    let mut page = Page::new(&format!("Diagnosis of {}", data.rsplit(['/', '\\']).next().unwrap_or(data)));
    page.verdict(vec![diagnosis.verdict.clone(), rows(diagnosis)]);
    for note in &diagnosis.sample.notes {
        page.note(format!("About the data file: {note}."));
    }
    data::add(&mut page, diagnosis);
    misfit::add(&mut page, diagnosis);
    for (place, finding) in diagnosis.findings.iter().enumerate() {
        cause::add(&mut page, diagnosis, finding, place);
    }
    add_numbers(&mut page, diagnosis);
    gain::add(&mut page, diagnosis);
    usage::add_next(&mut page, diagnosis);
    usage::add_commands(&mut page, diagnosis, extended);
    add_rejected(&mut page, &diagnosis.rows.rejected);
    add_method(&mut page, diagnosis, data, model);
    page.foot(&format!("Made from {data} and {model} with seed {}.", diagnosis.seed));
    page.html()
}

fn rows(diagnosis: &Diagnosis) -> String {
    let rows = &diagnosis.rows;
    let left_out = match rows.rejected.len() {
        0 => String::new(),
        1 => " 1 row was left out, see \"Rows left out\".".to_owned(),
        count => format!(" {count} rows were left out, see \"Rows left out\"."),
    };
    format!(
        "{} rows read, {} used; {} observations were held out of every fit and choice.{left_out}",
        rows.read, rows.used, rows.held_out
    )
}

/// A cause's name on the page.
fn cause_title(cause: &str) -> String {
    match cause.strip_prefix("unknown:") {
        Some(column) => format!("curve over {column}"),
        None => cause.to_owned(),
    }
}

/// Recalibrated parameters of the base model, and the scatter.
fn add_numbers(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading("Recalibrated parameters and scatter");
    if diagnosis.calibration.is_empty() {
        page.text("The data support the base model's own parameters as they are.");
    } else {
        let row = |one: &Calibration| {
            let [from, value, low, high] = [one.from, one.value, one.low, one.high].map(number);
            vec![one.key.clone(), from, value, format!("{low} to {high}"), once_in(one.q_value)]
        };
        page.table(Table::new(
            "Parameters of the base model's laws, in the units of the model file.",
            1,
            &["key", "model file", "fitted", "95 % interval", "by chance once in"],
            diagnosis.calibration.iter().map(row).collect(),
        ));
    }
    let scatter = &diagnosis.scatter;
    let values = [("e_n", scatter.e_n), ("e_t", scatter.e_t)].into_iter().filter(|(_, value)| *value > 0.0);
    let values: Vec<String> = values.map(|(name, value)| format!("{} in {name}", number(value))).collect();
    if values.is_empty() {
        return;
    }
    let mut text = format!(
        "Single values scatter about the model with a standard deviation of {}. It includes the error of measurement and \
         everything that no column of the file accounts for.",
        values.join(" and ")
    );
    if !scatter.changes_with.is_empty() {
        text += &format!(
            " The scatter changes with {}. This is not a cause, but it was accounted for; check the rig if it is a column of \
             the rig.",
            scatter.changes_with.join(", ")
        );
    }
    page.text(text);
}

fn add_rejected(page: &mut Page, rejected: &[BadRow]) {
    if rejected.is_empty() {
        return;
    }
    page.heading("Rows left out");
    let row = |row: &BadRow| vec![row.line.to_string(), row.reason.clone()];
    page.table(Table::new(
        "Lines of the data file; the header is line 1.",
        2,
        &["line", "reason"],
        rejected.iter().take(REJECTED).map(row).collect(),
    ));
    if rejected.len() > REJECTED {
        page.text(format!("… and {} more; diagnosis.json lists them all.", rejected.len() - REJECTED));
    }
}

fn add_method(page: &mut Page, diagnosis: &Diagnosis, data: &str, model: &str) {
    let Diagnosis { seed, level, .. } = diagnosis;
    page.heading("How it was judged");
    page.note(format!(
        "Seed {seed} split the rows at random: three quarters for fits and choices, one quarter held out until the gain was \
         measured. Candidates (every effect, every parameter of the laws, a free curve over every column) were fitted to four \
         fifths of the first part and scored on the remaining fifth, five times over. sigma is the root of twice the gain in \
         log likelihood on those rows. A candidate is accepted if its gain would happen by chance in at most a share of \
         {level} of data sets, corrected for the number of candidates. docs/diagnosis.md of nearwall describes the method and \
         its limits."
    ));
    let [data, model] = [data, model].map(quoted);
    page.code(format!(
        "nearwall diagnose {data} \\\n  --model {model} \\\n  --seed {seed} --level {level} --out DIR"
    ));
}

/// A path quoted for a shell.
fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=:,@%".contains(c);
    if !path.is_empty() && path.chars().all(plain) {
        path.to_owned()
    } else {
        format!("'{}'", path.replace('\'', "'\\''"))
    }
}
