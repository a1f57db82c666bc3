//! Warnings about a file: assumptions and likely mistakes.

use super::column_names::INPUT_ERRORS;
use super::detection::Detection;
use super::input_errors::InputErrors;
use super::measurements::{Measurement, Reading};
use super::observed::Remarks;
use nearwall::impact::{INPUTS, Impact, Input};
use nearwall::input::alike;

/// Columns whose name resembles one of `absent`, each with that name. A column of standard errors is none of them.
pub(super) fn near_misses<'a>(
    columns: impl Iterator<Item = &'a str>,
    absent: &[&'static str],
) -> Vec<(&'a str, &'static str)> {
    let bare = |name: &str| name.split(['[', '(']).next().unwrap_or(name).trim().to_owned();
    let meant = |column| absent.iter().copied().find(|name| alike(&bare(column), name));
    let is_error = |column: &&str| INPUT_ERRORS.iter().any(|(name, _)| name == column);
    columns.filter(|column| !is_error(column)).filter_map(|column| Some((column, meant(column)?))).collect()
}

/// The default values of the absent inputs that are not 0; `None` if there are none.
pub fn assumed(absent: &[&str]) -> Option<String> {
    let of_input = |input: &Input| match (input.value)(&Impact::default()) {
        0.0 => None,
        value => Some(format!("{} = {}", input.name, value_text(input, value))),
    };
    let absent = INPUTS.iter().filter(|input| absent.contains(&input.name));
    let texts: Vec<String> = absent.filter_map(of_input).collect();
    (!texts.is_empty()).then(|| texts.join(", "))
}

/// A warning if an input is probably in another unit; `line` is the impact's line in the file.
pub fn unlikely(line: u64, impact: &Impact) -> Option<String> {
    impact.unlikely().map(|text| format!("line {line}: {text}"))
}

/// Counts of rows with a warning.
#[derive(Debug, Clone, Default)]
pub(super) struct NoteCounts {
    /// Rows without each of [`INPUTS`].
    blank: [usize; INPUTS.len()],
    /// Rows with `e_n` above 1.
    above_one: usize,
    /// Rows with a captured share of an unknown number of impacts.
    uncounted: usize,
    /// Rows with a standard error of 0.
    no_error: usize,
    /// Rows with `e_n` below the detection limit.
    invisible: usize,
    /// Rows with `e_n` and with `e_t`: with a standard error, without one.
    readings: [[usize; 2]; 2],
    /// Rows that state each of [`INPUT_ERRORS`].
    input_errors: [usize; INPUT_ERRORS.len()],
    /// Rows with an input error above the input.
    large_errors: [usize; INPUT_ERRORS.len()],
    /// Rows with a limit of `e_n` or `e_t` in place of a value.
    censored: usize,
    /// The first warning about a unit.
    unlikely: Option<String>,
}

impl NoteCounts {
    /// Counts one usable row.
    pub(super) fn count(&mut self, row: &Measurement, remarks: Remarks, detection: Detection) {
        for (blank, stated) in self.blank.iter_mut().zip(row.stated) {
            *blank += usize::from(!stated);
        }
        self.above_one += usize::from(row.e_n.is_some_and(|e_n| e_n.value > 1.0));
        self.censored += usize::from(row.limits.iter().any(Option::is_some));
        self.uncounted += usize::from(remarks.uncounted);
        self.no_error += usize::from(remarks.no_error);
        let least = detection.least_e_n(&row.impact);
        self.invisible += usize::from(row.e_n.is_some_and(|e_n| e_n.value < least));
        for ([with, without], reading) in self.readings.iter_mut().zip([row.e_n, row.e_t]) {
            let has = |known| usize::from(reading.is_some_and(|r: Reading| r.error.is_some() == known));
            *with += has(true);
            *without += has(false);
        }
        self.count_input_errors(&row.impact, row.input_errors);
        if self.unlikely.is_none() {
            self.unlikely = unlikely(row.line, &row.impact);
        }
    }

    fn count_input_errors(&mut self, impact: &Impact, errors: InputErrors) {
        for (input, error) in errors.each() {
            let places = INPUT_ERRORS.iter().position(|(_, place)| INPUTS[*place].name == input.name);
            if let Some(place) = places {
                self.input_errors[place] += 1;
                self.large_errors[place] += usize::from(error > (input.value)(impact));
            }
        }
    }

    /// The warnings about `rows` usable rows of a file with these inputs.
    pub(super) fn notes(&self, given: &[&str], rows: usize) -> Vec<String> {
        let absent: Vec<&str> = INPUTS.iter().map(|i| i.name).filter(|name| !given.contains(name)).collect();
        let mut notes: Vec<String> =
            assumed(&absent).map(|text| format!("not in the file, assumed: {text}")).into_iter().collect();
        for (input, blank) in INPUTS.iter().zip(self.blank) {
            if blank > 0 && given.contains(&input.name) {
                let taken = match rows - blank {
                    0 | 1 => format!("taken as {}", value_text(input, (input.value)(&Impact::default()))),
                    _ => "which count with the mean over its stated values".to_owned(),
                };
                notes.push(format!("{} is blank in {blank} of {rows} rows, {taken}", input.name));
            }
        }
        notes.extend(self.unlikely.clone());
        let counted = [
            (self.above_one, "e_n is above 1; check its unit unless the wall is rough or the particle spins"),
            (
                self.censored,
                "a restitution is a limit, as <0.2; it counts in the likelihood, not in errors and figures",
            ),
            (self.uncounted, "capture_efficiency is given without n_impacts; each row counts as one impact"),
            (self.no_error, "a standard error is 0; it is treated as unknown"),
            (self.invisible, "e_n is below the detection limit of the column map; check the limit"),
        ];
        let counted = counted.into_iter().filter(|(count, _)| *count > 0);
        notes.extend(counted.map(|(count, text)| format!("in {count} of {rows} rows {text}")));
        notes.extend(self.error_notes(rows));
        notes
    }

    /// The warnings about standard errors.
    fn error_notes(&self, rows: usize) -> Vec<String> {
        let mut notes = Vec::new();
        for (name, [with, without]) in ["e_n", "e_t"].into_iter().zip(self.readings) {
            if with > 0 && without > 0 {
                let all = with + without;
                notes.push(format!(
                    "{name}_err is given in {with} of {all} rows with {name}, unknown in the others"
                ));
            }
        }
        for (place, (name, input)) in INPUT_ERRORS.into_iter().enumerate() {
            let (stated, large, input) =
                (self.input_errors[place], self.large_errors[place], INPUTS[input].name);
            if stated > 0 && stated < rows {
                notes.push(format!(
                    "the standard error of {input} is given in {stated} of {rows} rows; in the others {input} counts \
                        as exact"
                ));
            }
            // A tangential speed near 0 may well have a larger error.
            if large > 0 && input != "v_t" {
                notes.push(format!("in {large} of {rows} rows {name} is above {input}; check its unit"));
            }
        }
        notes
    }
}

fn value_text(input: &Input, value: f64) -> String {
    if input.unit == "1" { value.to_string() } else { format!("{value} {}", input.unit) }
}
