//! The rows that fitted a model: what `extended.toml` states of them, so that `compare` knows them.
//!
//! The table `[fitted]` has a digest of each: the first 40 bits of the key ([`nearwall::key`]) of the
//! row's numbers, inputs as far as stated. Where two rows of the data have the same numbers, as with
//! nominal inputs and captures, the digests are those of the numbers and the line, counted from the
//! first row: a frame has no comments above it. At most 10,000
//! rows fit a model; a row that did not fit it is taken for one of them with a probability of 1e-8.

use std::collections::BTreeSet;

use nearwall::impact::INPUTS;
use nearwall::key::key_of_values;
use toml_edit::{Array, DocumentMut, Item, Table, TomlError, Value, value};

use crate::dataset::{Limit, Measurement, Measurements, Reading};

/// Table and key of the model file.
const TABLE: &str = "fitted";
const KEY: &str = "rows";
/// Number of bits of a key that are no part of the digest.
const LEFT_OUT: u32 = 24;
/// Digests in a line of the file.
const A_LINE: usize = 8;
/// Stands for what was not measured.
const ABSENT: f64 = f64::MAX;

/// Digests of rows.
#[derive(Debug, Clone, Default)]
pub struct FittedRows(BTreeSet<String>);

impl FittedRows {
    /// Those that the text of a model file states.
    pub fn stated(text: &str) -> Self {
        let Ok(document) = text.parse::<DocumentMut>() else { return Self::default() };
        let rows = document.get(TABLE).and_then(|table| table.get(KEY)).and_then(Item::as_array);
        let lines = rows.into_iter().flatten().filter_map(Value::as_str);
        Self(lines.flat_map(str::split_whitespace).map(str::to_owned).collect())
    }

    /// The text of a model file that states these rows of the data, too.
    ///
    /// # Errors
    /// When the text cannot be edited.
    pub fn add_to(text: &str, data: &Measurements, rows: &[usize]) -> Result<String, TomlError> {
        let plain: BTreeSet<String> = data.rows.iter().map(|row| digest(row, None)).collect();
        let differ = plain.len() == data.rows.len();
        let first = first_line(data);
        let one = |&row: &usize| {
            let row = &data.rows[row];
            digest(row, (!differ).then_some(row.line - first))
        };
        let mut all = Self::stated(text).0;
        all.extend(rows.iter().map(one));
        let all: Vec<String> = all.into_iter().collect();
        let mut lines: Array = all.chunks(A_LINE).map(|line| line.join(" ")).collect();
        lines.iter_mut().for_each(|line| line.decor_mut().set_prefix("\n  "));
        lines.set_trailing("\n");
        let mut document: DocumentMut = text.parse()?;
        document.insert(TABLE, Item::Table(Table::from_iter([(KEY, value(lines))])));
        Ok(document.to_string())
    }

    /// The text of a model file without them, for a reader.
    pub fn removed_from(text: &str) -> String {
        let Ok(mut document) = text.parse::<DocumentMut>() else { return text.to_owned() };
        document.remove(TABLE);
        document.to_string()
    }

    /// Whether a row of a file, whose first row has this line, is one of them.
    pub fn contains(&self, row: &Measurement, first: u64) -> bool {
        let places = [None, row.line.checked_sub(first)];
        !self.0.is_empty() && places.into_iter().any(|place| self.0.contains(&digest(row, place)))
    }
}

/// The line of the first row.
pub(super) fn first_line(data: &Measurements) -> u64 {
    data.rows.iter().map(|row| row.line).min().unwrap_or(0)
}

/// The digest of a row's numbers, and of its place.
fn digest(row: &Measurement, place: Option<u64>) -> String {
    let stated = INPUTS.iter().zip(&row.stated).filter(|(_, stated)| **stated);
    let reading = |one: Option<Reading>| one.map_or(ABSENT, |reading| reading.value);
    let limit = |one: Option<Limit>| one.map_or(ABSENT, |limit| limit.reading.value);
    let mut numbers: Vec<f64> = stated.map(|(input, _)| (input.value)(&row.impact)).collect();
    numbers.extend([reading(row.e_n), reading(row.e_t), limit(row.limits[0]), limit(row.limits[1])]);
    numbers.extend([row.captured.unwrap_or(ABSENT), row.impacts]);
    numbers.extend(place.map(|place| place as f64));
    let numbers: Vec<f64> =
        numbers.into_iter().map(|one| if one.is_finite() { one } else { ABSENT }).collect();
    format!("{:010x}", key_of_values(numbers.into_iter()).unwrap_or_default() >> LEFT_OUT)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::WallChoice;
    use nearwall::model::Model;

    const MODEL: &str = "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n\
        [normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.76\n";

    fn read(text: &str) -> Measurements {
        let model = Model::from_toml("m.toml", MODEL).unwrap();
        let walls = WallChoice::new(&model, None).unwrap();
        Measurements::read("t.csv", text.as_bytes(), None, &walls).unwrap()
    }

    /// New impacts at the same nominal inputs with the same outcome are other impacts.
    #[test]
    fn rows_with_the_numbers_of_others_are_known_by_their_line() {
        for (rows, known_elsewhere) in
            [("1,stick\n2,rebound\n3,rebound\n", true), ("1,stick\n1,stick\n2,rebound\n", false)]
        {
            let data = read(&format!("v_n,outcome\n{rows}"));
            let text = FittedRows::add_to(MODEL, &data, &[1, 2]).unwrap();
            let fitted = FittedRows::stated(&text);
            let known: Vec<bool> = data.rows.iter().map(|row| fitted.contains(row, 2)).collect();
            assert_eq!(known, [false, true, true]);
            let moved = read(&format!("v_n,outcome\n5,stick\n{rows}"));
            assert_eq!(fitted.contains(&moved.rows[3], 2), known_elsewhere, "{text}");
            let more = FittedRows::stated(&FittedRows::add_to(&text, &moved, &[0]).unwrap());
            assert_eq!(more.0.len(), 3);
        }
    }
}
