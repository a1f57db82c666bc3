//! Groups of rows: the series of measurements where the file names them, else single rows.

use std::collections::BTreeMap;

use super::super::data_split::shuffled;
use crate::dataset::{ColumnValues, Measurements};

/// The column that names groups.
const SERIES: &str = "series";
/// Parts of the rows: the scatter for one is estimated on the others.
const FOLDS: usize = 5;
/// Largest number of groups; single rows beyond it are bundled.
const MOST_GROUPS: usize = 20_000;

/// The group of every row.
pub(super) struct RowGroups {
    /// `series`, or `row`.
    pub by: &'static str,
    /// Number of the group of each row.
    pub of_row: Vec<usize>,
    pub count: usize,
}

impl RowGroups {
    /// The series of the rows, if there are at least two; a row without one is a group of its own.
    pub fn of(data: &Measurements) -> Self {
        let rows = data.rows.len();
        let series = data.columns.iter().find(|column| column.name == SERIES).and_then(|column| {
            let ColumnValues::Labels { of_row, .. } = &column.values else { return None };
            let mut numbers: BTreeMap<Option<usize>, usize> = BTreeMap::new();
            let mut count = 0;
            let mut number = |label: &Option<usize>| {
                let known = numbers.get(label).filter(|_| label.is_some()).copied();
                known.unwrap_or_else(|| {
                    numbers.insert(*label, count);
                    count += 1;
                    count - 1
                })
            };
            let of_row = of_row.iter().map(&mut number).collect();
            (count > 1).then_some((of_row, count))
        });
        match series {
            Some((of_row, count)) => Self { by: SERIES, of_row, count },
            None => {
                let count = rows.min(MOST_GROUPS);
                Self { by: "row", of_row: (0..rows).map(|row| row % MOST_GROUPS).collect(), count }
            }
        }
    }

    /// The part of every row, whole groups together.
    pub fn folds(&self, seed: u64) -> Vec<usize> {
        let mut fold = vec![0; self.count];
        for (place, group) in shuffled(self.count, seed).into_iter().enumerate() {
            fold[group] = place % FOLDS.min(self.count);
        }
        self.of_row.iter().map(|group| fold[*group]).collect()
    }
}
