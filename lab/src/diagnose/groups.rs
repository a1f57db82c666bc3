//! Rows that share an error: bursts, days, series, laboratories.
//!
//! *Units* are what tests and bootstraps draw: rows of one averaged row, or with equal cells, count
//! once; so do the rows of a group that shares an error. A *shared error* is a random offset of
//! `e_n` and `e_t` of each group, normal with a standard deviation that is estimated; it enters the
//! likelihood where the residuals of the model show it (random intercept; Laird and Ware 1982).

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::dataset::{ColumnValues, DataColumn, Measurement, Measurements, names_groups};

/// So many batches are few.
const FEW_BATCHES: usize = 8;

/// Numbers of neighbouring rows that may share an error, as while a lamp drifts.
const BLOCKS: [usize; 3] = [5, 12, 30];
/// Least number of groups that are noticed without a name.
const LEAST_NOTICED: usize = 5;

/// The column that groups rows.
#[derive(Debug, Clone)]
pub(super) struct GroupColumn {
    /// Its name.
    pub name: String,
    /// Whether the user named it.
    pub declared: bool,
    /// Index of the group of each row; a row with a blank cell is a group of its own.
    pub of_row: Arc<[usize]>,
    /// Number of groups.
    pub count: usize,
}

impl GroupColumn {
    /// The column that the user names, else every one whose name says that it groups rows; none
    /// with fewer than two groups.
    pub fn all(data: &Measurements, declared: Option<&str>) -> Vec<Self> {
        let named = |column: &&DataColumn| match declared {
            Some(name) => column.name == name,
            None => groups_by_default(column),
        };
        data.columns.iter().filter(named).filter_map(|column| Self::of(column, declared.is_some())).collect()
    }

    /// Groups that no name tells: columns of labels, equal inputs, and neighbours in the file.
    pub fn noticed(data: &Measurements, known: &[Self]) -> Vec<Self> {
        let rows = data.rows.len();
        let unknown = |column: &&DataColumn| known.iter().all(|groups| groups.name != column.name);
        let columns = data.columns.iter().filter(unknown).filter(|one| !one.name.is_empty());
        let mut all: Vec<Self> = columns.filter_map(|column| Self::of(column, false)).collect();
        all.extend(Self::of_inputs(data, "equal inputs", 1));
        all.extend(Self::of_inputs(data, "inputs that repeat", 2));
        for size in BLOCKS {
            let of_row = (0..rows).map(|row| row / size).collect::<Vec<_>>();
            let name = format!("every {size} rows of the file");
            all.push(Self { name, declared: false, of_row: of_row.into(), count: rows.div_ceil(size) });
        }
        all.retain(|groups| groups.count >= LEAST_NOTICED && 2 * groups.count <= rows);
        all
    }

    /// Rows with equal values of all inputs that have at most one value for so many rows.
    fn of_inputs(data: &Measurements, name: &str, rows_a_value: usize) -> Option<Self> {
        let inputs = nearwall::impact::INPUTS.iter().filter(|input| data.given.contains(&input.name));
        let values = |input: &nearwall::impact::Input| -> Vec<u64> {
            data.rows.iter().map(|row| (input.value)(&row.impact).to_bits()).collect()
        };
        let repeats = |values: &Vec<u64>| {
            let different = values.iter().collect::<std::collections::BTreeSet<_>>().len();
            different > 1 && different * rows_a_value <= values.len()
        };
        let columns: Vec<Vec<u64>> = inputs.map(values).filter(repeats).collect();
        if columns.len() < 2 {
            return None;
        }
        let key = |row: usize| Some(columns.iter().map(|column| column[row]).collect::<Vec<u64>>());
        let (of_row, count) = numbered((0..data.rows.len()).map(key));
        Some(Self { name: name.to_owned(), declared: false, of_row: of_row.into(), count })
    }

    /// The groups of these rows alone.
    pub fn of_rows(&self, rows: &[usize]) -> Self {
        let (of_row, count) = numbered(rows.iter().map(|&row| Some(self.of_row[row])));
        Self { of_row: of_row.into(), count, ..self.clone() }
    }

    fn of(column: &DataColumn, declared: bool) -> Option<Self> {
        let labels: Vec<Option<u64>> = match &column.values {
            ColumnValues::Labels { of_row, .. } => {
                of_row.iter().map(|label| label.map(|l| l as u64)).collect()
            }
            ColumnValues::Numbers(numbers) => {
                numbers.iter().map(|number| number.is_finite().then(|| number.to_bits())).collect()
            }
        };
        let (of_row, count) = numbered(labels.into_iter());
        (count > 1).then(|| Self {
            name: column.name.clone(),
            declared: declared || column.name == "series",
            of_row: of_row.into(),
            count,
        })
    }
}

/// Whether a column groups rows unless the user says otherwise. Few batches with many rows each are
/// a material that may differ, so a possible cause; many are a random choice.
fn groups_by_default(column: &DataColumn) -> bool {
    let few = matches!(&column.values, ColumnValues::Labels { levels, .. } if levels.len() <= FEW_BATCHES);
    names_groups(&column.name) && !(column.name.eq_ignore_ascii_case("batch") && few)
}

/// The unit of each row, and their number: rows of one line of the file, or with equal cells, count once.
pub(super) fn units(data: &Measurements) -> (Arc<[usize]>, usize) {
    let (of_row, count) =
        numbered(data.rows.iter().enumerate().map(|(row, one)| Some(content(data, row, one))));
    (of_row.into(), count)
}

/// What tells a row from its copies: all its numbers. Rows of one averaged row share the line.
fn content(data: &Measurements, row: usize, one: &Measurement) -> Vec<u64> {
    if data.rows.len() > 1 && one.impacts > 1.0 {
        return vec![one.line];
    }
    let neighbour = |other: Option<&Measurement>| other.is_some_and(|other| other.line == one.line);
    let before = row.checked_sub(1).and_then(|before| data.rows.get(before));
    if neighbour(before) || neighbour(data.rows.get(row + 1)) {
        return vec![one.line];
    }
    let inputs = nearwall::impact::INPUTS.iter().map(|input| (input.value)(&one.impact).to_bits());
    let readings = [one.e_n, one.e_t].into_iter().map(|r| r.map_or(u64::MAX, |r| r.value.to_bits()));
    let captured = one.captured.map_or(u64::MAX, f64::to_bits);
    let exact = inputs.chain(readings).chain([captured]).collect::<Vec<u64>>();
    // A capture has no reading: equal inputs alone do not make a copy.
    if one.e_n.is_none() && one.e_t.is_none() { vec![one.line] } else { exact }
}

/// Numbers from 0 for equal keys, in the order of their first appearance; `None` is equal to nothing.
fn numbered<K: Ord>(keys: impl Iterator<Item = Option<K>>) -> (Vec<usize>, usize) {
    let mut known: BTreeMap<K, usize> = BTreeMap::new();
    let mut count = 0;
    let of_row = keys
        .map(|key| {
            let fresh = count;
            let number = key.map_or(fresh, |key| *known.entry(key).or_insert(fresh));
            count += usize::from(number == fresh);
            number
        })
        .collect();
    (of_row, count)
}
