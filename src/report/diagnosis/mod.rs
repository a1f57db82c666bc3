//! The page of a diagnosis: verdict, what was wrong, the cause, the gain, what to measure next, how to run the extended
//! model.

mod axis;
mod cause;
mod curve;
mod gain;
mod misfit;
mod plot;
mod spread;
mod usage;

use super::format::number;
use super::page::{Page, Table};
use crate::diagnose::{Calibration, Diagnosis};

/// Rejected rows listed at most.
const REJECTED: usize = 50;

/// The page: verdict, what was wrong, the cause, the gain, what to measure next, how to run the extended model.
///
/// `names` are those of the data and the model file, `extended` the text of the extended model.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(diagnosis: &Diagnosis, names: &[String; 2], extended: &str) -> Result<String, askama::Error> {
    let [data, model] = names;
    let mut page = Page::new(&format!("Diagnosis of {}", file_name(data)));
    page.verdict(vec![diagnosis.verdict.clone(), rows(diagnosis)]);
    misfit::add(&mut page, diagnosis);
    for (place, finding) in diagnosis.findings.iter().enumerate() {
        cause::add(&mut page, diagnosis, finding, place);
    }
    add_numbers(&mut page, diagnosis);
    gain::add(&mut page, diagnosis);
    usage::add_next(&mut page, diagnosis);
    usage::add_commands(&mut page, diagnosis, extended);
    add_rejected(&mut page, diagnosis);
    add_judgement(&mut page, diagnosis, data, model);
    page.foot(&format!("Made from {data} and {model} with seed {}.", diagnosis.seed));
    page.html()
}

fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

fn rows(diagnosis: &Diagnosis) -> String {
    let rows = &diagnosis.rows;
    let left_out = match rows.rejected.len() {
        0 => String::new(),
        1 => "; 1 was left out, see \"Rows left out\"".to_owned(),
        count => format!("; {count} were left out, see \"Rows left out\""),
    };
    format!(
        "{} rows read, {} used, of which {} were held out: no fit and no choice saw them{left_out}.",
        rows.read, rows.used, rows.held_out
    )
}

/// What a cause is called on the page.
fn cause_title(cause: &str) -> String {
    match cause.strip_prefix("unknown:") {
        Some(column) => format!("curve over {column}"),
        None => cause.to_owned(),
    }
}

fn strings<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

/// A number with its unit; shares have none.
fn with_unit(value: f64, unit: &str) -> String {
    if unit == "1" || unit.is_empty() { number(value) } else { format!("{} {unit}", number(value)) }
}

/// A chance for a reader: a number too small for one is a bound.
fn chance(value: f64) -> String {
    match value {
        small if small < 1e-12 => "< 1e-12".to_owned(),
        small if small < 1e-3 => format!("{small:.1e}"),
        _ => format!("{value:.3}"),
    }
}

/// Numbers of the base that the data want otherwise, and the scatter.
fn add_numbers(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading("Recalibrated numbers and scatter");
    if diagnosis.calibration.is_empty() {
        page.text("The data ask for no other value of the base model's own numbers.");
    } else {
        let row = |number_found: &Calibration| {
            vec![
                number_found.key.clone(),
                number(number_found.from),
                number(number_found.value),
                format!("{} to {}", number(number_found.low), number(number_found.high)),
                chance(number_found.q_value),
            ]
        };
        page.table(Table {
            caption: "Numbers of the base model's laws, in the units of the model file.".into(),
            header: strings(["key", "model file", "the data want", "95 % interval", "q"]),
            rows: diagnosis.calibration.iter().map(row).collect(),
            text_columns: 1,
        });
    }
    let scatter = &diagnosis.scatter;
    let one = |name: &str, value: f64| (value > 0.0).then(|| format!("{} in {name}", number(value)));
    let all: Vec<String> = [one("e_n", scatter.e_n), one("e_t", scatter.e_t)].into_iter().flatten().collect();
    if !all.is_empty() {
        let mut text = format!(
            "Single values scatter about the model by {} (standard deviation): what no column of the file accounts for, the \
             rig's own error included.",
            all.join(" and ")
        );
        if !scatter.changes_with.is_empty() {
            text += &format!(
                " The scatter changes with {}: that is no cause, but it was taken into account. Where a column of the \
                 rig does this, look at the rig.",
                scatter.changes_with.join(", ")
            );
        }
        page.text(text);
    }
}

fn add_rejected(page: &mut Page, diagnosis: &Diagnosis) {
    let rejected = &diagnosis.rows.rejected;
    if rejected.is_empty() {
        return;
    }
    page.heading("Rows left out");
    page.table(Table {
        caption: "Lines of the data file, counted from 1 with the header.".into(),
        header: strings(["line", "reason"]),
        rows: rejected
            .iter()
            .take(REJECTED)
            .map(|row| vec![row.line.to_string(), row.reason.clone()])
            .collect(),
        text_columns: 2,
    });
    if rejected.len() > REJECTED {
        page.text(format!("… and {} more; diagnosis.json names them all.", rejected.len() - REJECTED));
    }
}

fn add_judgement(page: &mut Page, diagnosis: &Diagnosis, data: &str, model: &str) {
    page.heading("How it was judged");
    page.note(format!(
        "Seed {} dealt the rows out: three quarters for fits and choices, one quarter held out until the gain was measured. \
         Candidates (every effect, every number of the laws, a free curve over every column) were fitted on four fifths of \
         the first part and scored on the remaining fifth, five times over. q is the chance of so large a gain by luck, \
         corrected for the number of candidates; up to {} is accepted. Intervals of parameters hold 95 %. docs/diagnosis.md \
         of nearwall says how the judgement works and where it ends.",
        diagnosis.seed, diagnosis.level
    ));
    page.code(format!(
        "nearwall diagnose {} \\\n  --model {} \\\n  --seed {} --level {} --out DIR",
        quoted(data),
        quoted(model),
        diagnosis.seed,
        diagnosis.level
    ));
}

/// A path as a shell takes it.
fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=:,@%".contains(c);
    if !path.is_empty() && path.chars().all(plain) {
        path.to_owned()
    } else {
        format!("'{}'", path.replace('\'', "'\\''"))
    }
}
