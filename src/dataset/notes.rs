//! Warnings about a file: assumptions and likely mistakes.

use super::measurements::Measurement;
use super::observed::Remarks;
use crate::impact::{INPUTS, Impact, Input};
use crate::input::alike;

/// Columns whose name resembles one of `absent`, each with that name.
pub(super) fn near_misses<'a>(
    columns: impl Iterator<Item = &'a str>,
    absent: &[&'static str],
) -> Vec<(&'a str, &'static str)> {
    let bare = |name: &str| name.split(['[', '(']).next().unwrap_or(name).trim().to_owned();
    let meant = |column| absent.iter().copied().find(|name| alike(&bare(column), name));
    columns.filter_map(|column| Some((column, meant(column)?))).collect()
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
    let Impact { diameter, particle_temperature, wall_temperature, .. } = *impact;
    if diameter > 0.05 {
        return Some(format!("line {line}: d = {diameter} m is unusually large; check its unit"));
    }
    let coldest = particle_temperature.min(wall_temperature);
    (coldest < 150.0).then(|| format!("line {line}: a temperature of {coldest} K; is that °C?"))
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
    /// The first warning about a unit.
    unlikely: Option<String>,
}

impl NoteCounts {
    /// Counts one usable row.
    pub(super) fn count(&mut self, row: &Measurement, remarks: Remarks) {
        for (blank, stated) in self.blank.iter_mut().zip(row.stated) {
            *blank += usize::from(!stated);
        }
        self.above_one += usize::from(row.e_n.is_some_and(|e_n| e_n.value > 1.0));
        self.uncounted += usize::from(remarks.uncounted);
        self.no_error += usize::from(remarks.no_error);
        if self.unlikely.is_none() {
            self.unlikely = unlikely(row.line, &row.impact);
        }
    }

    /// The warnings about `rows` usable rows of a file with these inputs.
    pub(super) fn notes(&self, given: &[&str], rows: usize) -> Vec<String> {
        let absent: Vec<&str> = INPUTS.iter().map(|i| i.name).filter(|name| !given.contains(name)).collect();
        let mut notes: Vec<String> =
            assumed(&absent).map(|text| format!("not in the file, assumed: {text}")).into_iter().collect();
        for (input, blank) in INPUTS.iter().zip(self.blank) {
            if blank > 0 && given.contains(&input.name) {
                let value = value_text(input, (input.value)(&Impact::default()));
                notes.push(format!("{} is blank in {blank} of {rows} rows, taken as {value}", input.name));
            }
        }
        notes.extend(self.unlikely.clone());
        let counted = [
            (self.above_one, "e_n is above 1; check its unit unless the wall is rough or the particle spins"),
            (self.uncounted, "capture_efficiency is given without n_impacts; each row counts as one impact"),
            (self.no_error, "a standard error is 0; it is treated as unknown"),
        ];
        let counted = counted.into_iter().filter(|(count, _)| *count > 0);
        notes.extend(counted.map(|(count, text)| format!("in {count} of {rows} rows {text}")));
        notes
    }
}

fn value_text(input: &Input, value: f64) -> String {
    if input.unit == "1" { value.to_string() } else { format!("{value} {}", input.unit) }
}
