//! Columns that are not inputs of the model: possible causes of its residuals.

use std::collections::{BTreeSet, HashMap};

use super::any_unit::AnyUnit;
use super::number::is_blank;

/// A column that is not an input of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct DataColumn {
    /// Its name in the file; `wall` and `series` by nearwall's name.
    pub name: String,
    /// SI unit of its numbers; empty where the heading states none.
    pub unit: &'static str,
    /// One value for each usable row.
    pub values: ColumnValues,
}

/// The cells of a [`DataColumn`].
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnValues {
    /// Numbers in SI units where the heading states a unit, NaN where the cell is blank.
    Numbers(Vec<f64>),
    /// Categories.
    Labels {
        /// The different labels, sorted.
        levels: Vec<String>,
        /// Index of each row's label, `None` where the cell is blank.
        of_row: Vec<Option<usize>>,
    },
}

/// Largest number of labels of rows that are not kept.
const MOST_LABELS: usize = 1000;

/// The cells of a column while the file is read; whether all are numbers is known at the end.
#[derive(Debug, Clone)]
pub(super) struct ColumnCells {
    name: String,
    /// The heading, and the unit that it states.
    heading: String,
    unit: Option<AnyUnit>,
    /// Whether its numbers are labels.
    as_labels: bool,
    /// Number of cells that are not blank, and of numbers among them; of all rows, kept or not.
    filled: usize,
    numbers: usize,
    /// Line and text of the first cell that is no number.
    invalid: Option<(u64, String)>,
    /// Labels of rows that are not kept, at most [`MOST_LABELS`].
    others: BTreeSet<String>,
    /// All cells, one after the other: an allocation for each cell would be slower than reading it.
    text: String,
    /// Where each cell ends in `text`.
    ends: Vec<usize>,
}

impl ColumnCells {
    /// An empty column.
    pub(super) fn new(name: &str, as_labels: bool) -> Self {
        Self {
            name: name.to_owned(),
            heading: name.to_owned(),
            unit: None,
            as_labels,
            filled: 0,
            numbers: 0,
            invalid: None,
            others: BTreeSet::new(),
            text: String::new(),
            ends: Vec::new(),
        }
    }

    /// The same with the name and the unit that its heading states.
    pub(super) fn with_unit(self, (name, unit): (&str, Option<AnyUnit>)) -> Self {
        Self { name: name.to_owned(), unit, ..self }
    }

    /// Takes note of the cell of a usable row; `parse` reads one number.
    pub(super) fn note(&mut self, line: u64, cell: &str, parse: impl Fn(&str) -> Option<f64>) {
        if self.as_labels || is_blank(cell) {
            return;
        }
        self.filled += 1;
        match parse(cell) {
            Some(_) => self.numbers += 1,
            None if self.invalid.is_none() => self.invalid = Some((line, cell.to_owned())),
            None => {}
        }
    }

    /// Appends the cell of the next row that is kept.
    pub(super) fn push(&mut self, cell: &str) {
        self.text.push_str(if is_blank(cell) { "" } else { cell });
        self.ends.push(self.text.len());
    }

    /// Takes note of the label of a row that is not kept.
    pub(super) fn leave_out(&mut self, cell: &str) {
        let is_label = (self.as_labels || self.invalid.is_some()) && !is_blank(cell);
        if is_label && self.others.len() < MOST_LABELS && !self.others.contains(cell) {
            self.others.insert(cell.to_owned());
        }
    }

    /// Removes the rows that are not kept.
    pub(super) fn retain(&mut self, kept: &[bool]) {
        let (text, ends) = (std::mem::take(&mut self.text), std::mem::take(&mut self.ends));
        for (cell, kept) in cells(&text, &ends).zip(kept) {
            if *kept { self.push(cell) } else { self.leave_out(cell) }
        }
    }

    fn cells(&self) -> impl Iterator<Item = &str> {
        cells(&self.text, &self.ends)
    }

    /// The column; and if most cells are numbers, the line and the text of the first one that is not. `parse` reads one
    /// number.
    pub(super) fn finish(
        mut self,
        parse: impl Fn(&str) -> Option<f64>,
    ) -> (DataColumn, Option<(u64, String)>) {
        let invalid = self.invalid.take();
        let is_number = self.filled > 0 && invalid.is_none();
        let invalid = invalid.filter(|_| 2 * self.numbers > self.filled);
        if is_number {
            let (values, unit) = (self.numbers(parse), self.unit.map_or("", |unit| unit.si));
            return (DataColumn { name: self.name, unit, values }, invalid);
        }
        // Words have no unit.
        let values = self.labels();
        (DataColumn { name: self.heading, unit: "", values }, invalid)
    }

    /// All cells as numbers.
    fn numbers(&self, parse: impl Fn(&str) -> Option<f64>) -> ColumnValues {
        let si = |number: f64| self.unit.map_or(number, |unit| unit.conversion.to_si(number));
        ColumnValues::Numbers(self.cells().map(|cell| parse(cell).map_or(f64::NAN, si)).collect())
    }

    /// Labels that only rows have that are not kept, and whether there may be more.
    pub(super) fn lost_labels(&self) -> (Vec<String>, bool) {
        let kept: BTreeSet<&str> = self.cells().collect();
        let is_label = self.as_labels || self.invalid.is_some();
        let lost = self.others.iter().filter(|label| is_label && !kept.contains(label.as_str()));
        (lost.cloned().collect(), self.others.len() >= MOST_LABELS)
    }

    fn labels(&self) -> ColumnValues {
        let mut place: HashMap<&str, usize> =
            self.cells().filter(|cell| !cell.is_empty()).map(|cell| (cell, 0)).collect();
        let mut levels: Vec<&str> = place.keys().copied().collect();
        levels.sort_unstable();
        for (index, level) in levels.iter().enumerate() {
            place.insert(level, index);
        }
        let of_row = self.cells().map(|cell| place.get(cell).copied()).collect();
        ColumnValues::Labels { levels: levels.into_iter().map(str::to_owned).collect(), of_row }
    }
}

/// The parts of a text that end at these places.
fn cells<'a>(text: &'a str, ends: &'a [usize]) -> impl Iterator<Item = &'a str> {
    let starts = std::iter::once(0).chain(ends.iter().copied());
    starts.zip(ends).map(|(start, end)| text.get(start..*end).unwrap_or(""))
}

impl ColumnValues {
    /// The cells of these rows.
    pub(crate) fn at(&self, rows: &[usize]) -> Self {
        match self {
            Self::Numbers(numbers) => Self::Numbers(rows.iter().map(|&row| numbers[row]).collect()),
            Self::Labels { levels, of_row } => {
                Self::Labels { levels: levels.clone(), of_row: rows.iter().map(|&row| of_row[row]).collect() }
            }
        }
    }
}

impl DataColumn {
    /// The cells of these rows.
    pub(super) fn at(&self, rows: &[usize]) -> Self {
        Self { name: self.name.clone(), unit: self.unit, values: self.values.at(rows) }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::dataset::names_groups;

    /// A column of labels.
    pub fn words(levels: &[&str], of_row: &[Option<usize>]) -> ColumnValues {
        ColumnValues::Labels {
            levels: levels.iter().map(|l| (*l).to_owned()).collect(),
            of_row: of_row.to_vec(),
        }
    }

    #[test]
    fn groups_have_names_in_any_case() {
        assert!(["series", "Day", "BATCH", "laboratory"].into_iter().all(names_groups));
        assert!(!["days", "humidity", "", "wall"].into_iter().any(names_groups));
    }

    #[test]
    fn labels_are_sorted_and_kept_as_written() {
        let finish = |cells: &[&str], labels: bool| {
            let mut column = ColumnCells::new("c", labels);
            let parse = |cell: &str| cell.parse().ok();
            for (line, cell) in (1..).zip(cells) {
                column.note(line, cell, parse);
                column.push(cell);
            }
            let (column, invalid) = column.finish(parse);
            assert_eq!(invalid, None);
            column.values
        };
        let expected = words(&["1.0", "Ann", "Bob"], &[Some(2), None, Some(1), Some(0), Some(2)]);
        assert_eq!(finish(&["Bob", "", "Ann", "1.0", "Bob"], false), expected);
        assert_eq!(finish(&["01", "1"], true), words(&["01", "1"], &[Some(0), Some(1)]));
        assert_eq!(finish(&["", "NA"], false), words(&[], &[None, None]));
        assert_eq!(finish(&[], false), words(&[], &[]));
    }
}
