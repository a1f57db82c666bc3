//! Columns that are not inputs of the model: possible causes of its residuals.

use std::collections::HashMap;

use super::number::is_blank;

/// A column that is not an input of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name in the file; `wall` and `series` by nearwall's name.
    pub name: String,
    /// One value for each usable row.
    pub values: Values,
}

/// The cells of a [`Column`].
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers in the file's own unit, NaN where the cell is blank.
    Numbers(Vec<f64>),
    /// Categories.
    Labels {
        /// The different labels, sorted.
        levels: Vec<String>,
        /// Index of each row's label, `None` where the cell is blank.
        of_row: Vec<Option<usize>>,
    },
}

/// Names of columns that tell groups of rows apart.
const GROUPS: [&str; 10] =
    ["series", "day", "date", "batch", "burst", "lab", "laboratory", "session", "run", "campaign"];

/// The columns of OpenFOAM's record that identify a parcel, order its impacts and weigh them: the rank that made it, its
/// number there, its age [s] and its number of particles. A file with all of them is such a record; they are no causes.
pub const PARCEL_COLUMNS: [&str; 4] = ["origProcId", "origId", "parcel_age", "n_particles"];

/// Whether a column of this name tells groups of rows apart that may share an error: `series`, `day`, `date`, `batch`,
/// `burst`, `lab`, `laboratory`, `session`, `run` or `campaign`, in upper or lower case. Its numbers are labels.
pub fn names_groups(name: &str) -> bool {
    GROUPS.iter().any(|group| group.eq_ignore_ascii_case(name))
}

/// The cells of a column while the file is read; whether all are numbers is known at the end.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    name: String,
    /// Whether its numbers are labels.
    as_labels: bool,
    /// All cells, one after the other: an allocation for each cell would be slower than reading it.
    text: String,
    /// Where each cell ends in `text`.
    ends: Vec<usize>,
}

impl Cells {
    /// An empty column.
    pub(super) fn new(name: &str, as_labels: bool) -> Self {
        Self { name: name.to_owned(), as_labels, text: String::new(), ends: Vec::new() }
    }

    /// Appends the cell of the next row.
    pub(super) fn push(&mut self, cell: &str) {
        self.text.push_str(if is_blank(cell) { "" } else { cell });
        self.ends.push(self.text.len());
    }

    fn cells(&self) -> impl Iterator<Item = &str> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| self.text.get(start..*end).unwrap_or(""))
    }

    /// The column; and if most cells are numbers, the row and the text of the first one that is not. `parse` reads one
    /// number.
    pub(super) fn finish(self, parse: impl Fn(&str) -> Option<f64>) -> (Column, Option<(usize, String)>) {
        let (values, invalid) = match (!self.as_labels).then(|| self.numbers(&parse)) {
            Some(Ok(numbers)) => (Values::Numbers(numbers), None),
            Some(Err(row)) => (self.labels(), self.invalid(row, &parse)),
            None => (self.labels(), None),
        };
        (Column { name: self.name, values }, invalid)
    }

    /// All cells as numbers, or the first row that is not a number; a column of blanks has no numbers.
    fn numbers(&self, parse: &impl Fn(&str) -> Option<f64>) -> Result<Vec<f64>, usize> {
        if self.text.is_empty() {
            return Err(0);
        }
        let number = |(row, cell): (usize, &str)| match cell {
            "" => Ok(f64::NAN),
            cell => parse(cell).ok_or(row),
        };
        self.cells().enumerate().map(number).collect()
    }

    fn invalid(&self, row: usize, parse: &impl Fn(&str) -> Option<f64>) -> Option<(usize, String)> {
        let filled = self.cells().filter(|cell| !cell.is_empty());
        let (numbers, all) = filled
            .fold((0, 0), |(numbers, all), cell| (numbers + usize::from(parse(cell).is_some()), all + 1));
        let cell = self.cells().nth(row)?.to_owned();
        (2 * numbers > all).then_some((row, cell))
    }

    fn labels(&self) -> Values {
        let mut place: HashMap<&str, usize> =
            self.cells().filter(|cell| !cell.is_empty()).map(|cell| (cell, 0)).collect();
        let mut levels: Vec<&str> = place.keys().copied().collect();
        levels.sort_unstable();
        for (index, level) in levels.iter().enumerate() {
            place.insert(level, index);
        }
        let of_row = self.cells().map(|cell| place.get(cell).copied()).collect();
        Values::Labels { levels: levels.into_iter().map(str::to_owned).collect(), of_row }
    }
}

impl Values {
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

impl Column {
    /// The cells of these rows.
    pub(super) fn at(&self, rows: &[usize]) -> Self {
        Self { name: self.name.clone(), values: self.values.at(rows) }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A column of labels.
    pub fn words(levels: &[&str], of_row: &[Option<usize>]) -> Values {
        Values::Labels { levels: levels.iter().map(|l| (*l).to_owned()).collect(), of_row: of_row.to_vec() }
    }

    #[test]
    fn groups_have_names_in_any_case() {
        assert!(["series", "Day", "BATCH", "laboratory"].into_iter().all(names_groups));
        assert!(!["days", "humidity", "", "wall"].into_iter().any(names_groups));
    }

    #[test]
    fn labels_are_sorted_and_kept_as_written() {
        let finish = |cells: &[&str], labels: bool| {
            let mut column = Cells::new("c", labels);
            cells.iter().for_each(|cell| column.push(cell));
            let (column, invalid) = column.finish(|cell| cell.parse().ok());
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
