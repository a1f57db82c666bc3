//! The page of a diagnosis.

pub(super) mod axis;
pub(super) mod cause;
mod curve;
mod data;
pub(super) mod fit;
pub(super) mod form;
pub(super) mod gain;
mod groups;
mod misfit;
pub(super) mod plot;
pub(super) mod rivals;
mod spread;
#[cfg(test)]
mod tests;
pub(super) mod usage;

use super::format::{number, once_in, whole_percent};
use super::page::{Page, Table};
use crate::dataset::BadRow;
use crate::diagnose::{Calibration, Diagnosis, ExplanationFound, Finding, Rows};

/// Most rejected rows listed.
const REJECTED: usize = 50;

/// The page: verdict, what to check in the data file, fit, rivals, measured values with both models, residuals, causes,
/// gain, what to measure next, how to run the extended model.
///
/// `names` are those of the data and the model file, `extended` is the text of the extended model.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(diagnosis: &Diagnosis, names: &[String; 2], extended: &str) -> Result<String, askama::Error> {
    let [data, model] = names;
    let mut page = Page::new(&format!("Diagnosis of {}", data.rsplit(['/', '\\']).next().unwrap_or(data)));
    page.verdict(vec![diagnosis.verdict.clone(), rows(diagnosis)]);
    rivals::add_notes(&mut page, diagnosis);
    fit::add(&mut page, diagnosis);
    rivals::add(&mut page, diagnosis);
    rivals::add_undecided(&mut page, diagnosis);
    add_explanations(&mut page, diagnosis);
    add_overview(&mut page, &diagnosis.findings);
    groups::add(&mut page, diagnosis);
    data::add(&mut page, diagnosis);
    misfit::add(&mut page, diagnosis);
    for (place, finding) in diagnosis.findings.iter().enumerate() {
        cause::add(&mut page, diagnosis, finding, place);
    }
    add_numbers(&mut page, diagnosis);
    gain::add(&mut page, diagnosis);
    usage::add_next(&mut page, diagnosis);
    usage::add_commands(&mut page, diagnosis, extended);
    add_rejected(&mut page, &diagnosis.rows);
    add_method(&mut page, diagnosis, data, model);
    page.foot(&format!("Made from {data} and {model} with seed {}.", diagnosis.seed));
    page.html()
}

fn rows(diagnosis: &Diagnosis) -> String {
    let rows = &diagnosis.rows;
    let left_out = match rows.left_out() {
        0 => String::new(),
        1 => " 1 row was left out, see \"Rows left out\".".to_owned(),
        count => format!(" {count} rows were left out, see \"Rows left out\"."),
    };
    // With few rows each is left out in turn, and all are fitted.
    let in_turn = diagnosis.gains.iter().any(|gain| gain.measured == "cross-validated");
    let held_out = match rows.held_out {
        0 => String::new(),
        _ if in_turn => String::new(),
        count => format!("; {count} observations were held out of the fit"),
    };
    let selected = rows.selected.map_or(String::new(), |count| {
        format!("; {count} of them, selected at random, stand for all in choices, fits and gain")
    });
    format!("{} rows read, {} used{selected}{held_out}.{left_out}", rows.read, rows.used)
}

/// A cause's name on the page; that of a surface is `unknown:a*b`, that of a constant shift `level:what`.
pub(super) fn cause_title(cause: &str) -> String {
    match cause.split_once(':') {
        Some(("unknown", columns)) => format!("curve over {}", columns.replace('*', " and ")),
        Some(("level", what)) => format!("shift of {what}"),
        _ => cause.to_owned(),
    }
}

/// A probability with two digits, never 0 or 1.
pub(super) fn probability(probability: f64) -> String {
    match probability {
        p if p > 0.995 => "> 0.99".to_owned(),
        p if p < 0.005 => "< 0.01".to_owned(),
        p => format!("{p:.2}"),
    }
}

/// The explanations that hold 95 %, with their probabilities.
pub(super) fn add_explanations(page: &mut Page, diagnosis: &Diagnosis) {
    if diagnosis.explanations.is_empty() {
        return;
    }
    let row = |one: &ExplanationFound| {
        let causes: Vec<String> = one.causes.iter().map(|cause| cause_title(cause)).collect();
        let causes =
            if causes.is_empty() { "the base model as it is".to_owned() } else { causes.join(" and ") };
        vec![causes, probability(one.probability)]
    };
    page.heading("How likely is which explanation?");
    page.text("These explanations together have a probability of 95 %. A cause is named from 0.8 on.");
    page.table(Table::new(
        "",
        1,
        &["explanation", "probability"],
        diagnosis.explanations.iter().map(row).collect(),
    ));
}

/// The causes with their certainty, and what they cannot be told from.
pub(super) fn add_overview(page: &mut Page, findings: &[Finding]) {
    let row = |finding: &Finding| {
        let others: Vec<String> =
            finding.indistinguishable_from.iter().map(|other| cause_title(other)).collect();
        let others = if others.is_empty() { "–".to_owned() } else { others.join(", ") };
        vec![
            cause_title(&finding.cause),
            plot::title(finding.observable).to_owned(),
            others,
            cause::significance(finding),
            once_in(finding.q_value),
            whole_percent(finding.certainty),
            probability(finding.probability),
        ]
    };
    if findings.is_empty() {
        return;
    }
    let header = [
        "cause",
        "acts on",
        "cannot be told from",
        "significance [sigma]",
        "by chance once in",
        "named in resampled data sets",
        "probability",
    ];
    page.heading("Causes at a glance");
    page.table(Table::new("", 3, &header, findings.iter().map(row).collect()));
}

/// Recalibrated parameters of the base model, and the scatter.
fn add_numbers(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading("Recalibrated parameters and scatter");
    add_calibration(page, &diagnosis.calibration);
    let scatter = &diagnosis.scatter;
    let stated = |place: usize| {
        let mut rows = diagnosis.sample.rows.iter();
        rows.any(|row| row.errors.get(place).copied().flatten().is_some())
    };
    let values = ["e_n", "e_t"].into_iter().zip([scatter.e_n, scatter.e_t]).enumerate();
    let values = values.filter(|(_, (_, value))| *value > 0.0).map(|(place, (name, value))| {
        let beyond = if stated(place) { " beyond the stated errors" } else { "" };
        format!("{} in {name}{beyond}", number(value))
    });
    let values: Vec<String> = values.collect();
    if values.is_empty() {
        return;
    }
    let mut text = format!(
        "Single values scatter about the model with a standard deviation of {}. This is the error of measurement \
            where none is stated, and everything that no column of the file accounts for.",
        values.join(" and ")
    );
    if !scatter.changes_with.is_empty() {
        text += &format!(
            " The scatter changes with {}. This is not a cause, but it was accounted for; check the rig if it is a \
                column of the rig.",
            scatter.changes_with.join(", ")
        );
    }
    page.text(text);
}

pub(super) fn add_calibration(page: &mut Page, calibration: &[Calibration]) {
    if calibration.is_empty() {
        page.text("No parameter of the base model's own laws has a significantly different value.");
        return;
    }
    let row = |one: &Calibration| {
        let [from, value, low, high] = [one.from, one.value, one.low, one.high].map(number);
        vec![one.key.clone(), from, value, format!("{low} to {high}"), once_in(one.q_value)]
    };
    page.table(Table::new(
        "Parameters of the base model's laws, in the units of the model file.",
        1,
        &["key", "model file", "fitted", "95 % interval", "by chance once in"],
        calibration.iter().map(row).collect(),
    ));
}

pub(super) fn add_rejected(page: &mut Page, rows: &Rows) {
    let (rejected, all) = (&rows.rejected, rows.left_out());
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
    if all > REJECTED {
        let listed =
            if all > rejected.len() { format!("{} of them", rejected.len()) } else { "them all".to_owned() };
        page.text(format!("… and {} more; diagnosis.json lists {listed}.", all - REJECTED));
    }
}

fn add_method(page: &mut Page, diagnosis: &Diagnosis, data: &str, model: &str) {
    let Diagnosis { seed, level, .. } = diagnosis;
    page.heading("How it was judged");
    page.note(format!(
        "Candidates are every effect of the library, every parameter of the base model's laws, and a free curve over \
            every column. Chi-square is minus twice the log likelihood; its fall is reduced by what the number of \
            parameters gains by chance. Explanations are compared by their evidence, which counts parameters and \
            prior probabilities; a cause is named from a probability of 0.8 on, unless rows that it has not seen are \
            predicted worse. Seed {seed} draws the rows that are held out. \
         docs/how-to/diagnosis.md of nearwall describes the method and its limits."
    ));
    let [data, model] = [data, model].map(quoted);
    page.code(format!(
        "nearwall diagnose {data} \\\n  --model {model} \\\n  --seed {seed} --level {level} --out DIR"
    ));
}

/// A path quoted for a shell.
pub(super) fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=:,@%".contains(c);
    if !path.is_empty() && path.chars().all(plain) {
        path.to_owned()
    } else {
        format!("'{}'", path.replace('\'', "'\\''"))
    }
}
