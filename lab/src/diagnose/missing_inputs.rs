//! Inputs that a row does not state although the file has a column of them.
//!
//! Missing is missing: the probability of such a row is the mean over what the file shows of the
//! column, here over eight of its stated values, at the quantiles 1/16, 3/16, …, each with the same
//! weight. Where a row lacks several inputs, each of the eight occurs once for each input, in
//! different orders (Latin hypercube; McKay, Beckman and Conover 1979). Correlations between columns
//! are ignored. A column with fewer than two stated values tells nothing: its blanks have the default.

use crate::dataset::Measurement;
use nearwall::impact::{INPUTS, Impact};

/// Number of values of a missing input: a power of two.
const FILLINGS: usize = 8;
/// Least number of stated values that show something of a column.
const LEAST_STATED: usize = 2;

/// The values of inputs that some rows lack.
#[derive(Debug, Clone, Default)]
pub(super) struct MissingInputs {
    /// Place in [`INPUTS`] and values, in ascending order; a single one if they are all the same.
    shown: Vec<(usize, Vec<f64>)>,
}

impl MissingInputs {
    /// What these rows show of the inputs that some of them lack.
    pub fn of(rows: &[Measurement]) -> Self {
        let shown = (0..INPUTS.len()).filter_map(|place| {
            let mut stated: Vec<f64> = rows
                .iter()
                .filter(|row| row.stated[place])
                .map(|row| (INPUTS[place].value)(&row.impact))
                .collect();
            if stated.len() < LEAST_STATED || stated.len() == rows.len() {
                return None;
            }
            stated.sort_by(f64::total_cmp);
            let quantile = |filling: usize| stated[(2 * filling + 1) * stated.len() / (2 * FILLINGS)];
            let mut values: Vec<f64> = (0..FILLINGS).map(quantile).collect();
            if values.iter().all(|value| *value == values[0]) {
                values.truncate(1);
            }
            Some((place, values))
        });
        Self { shown: shown.collect() }
    }

    /// The inputs that this row lacks, with their values.
    fn lacking<'a>(&'a self, row: &'a Measurement) -> impl Iterator<Item = &'a (usize, Vec<f64>)> {
        self.shown.iter().filter(|(place, _)| !row.stated[*place])
    }

    /// Whether the row lacks an input of which the file shows something.
    pub fn lacks(&self, row: &Measurement) -> bool {
        self.lacking(row).next().is_some()
    }

    /// The values of the input at this place in [`INPUTS`]; none if no row lacks it.
    pub fn values(&self, input: usize) -> &[f64] {
        self.shown.iter().find(|(place, _)| *place == input).map_or(&[], |(_, values)| values)
    }

    /// Number of impacts that stand for the row: 1 if it lacks nothing.
    pub fn fillings(&self, row: &Measurement) -> usize {
        self.lacking(row).map(|(_, values)| values.len()).max().unwrap_or(1)
    }

    /// The impact of a row with one choice of the inputs that it lacks.
    pub fn filled(&self, row: &Measurement, filling: usize) -> Impact {
        let mut filled = row.impact;
        for (order, (place, values)) in self.lacking(row).enumerate() {
            let value = values[(2 * order + 1) * filling % values.len()];
            (INPUTS[*place].set)(&mut filled, value);
        }
        filled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(temperature: Option<f64>, diameter: Option<f64>) -> Measurement {
        let mut row = Measurement { stated: [true; INPUTS.len()], ..Measurement::default() };
        for (place, value) in [(Impact::PARTICLE_TEMPERATURE, temperature), (Impact::DIAMETER, diameter)] {
            row.stated[place] = value.is_some();
            (INPUTS[place].set)(&mut row.impact, value.unwrap_or(7.0));
        }
        row
    }

    #[test]
    fn a_missing_input_has_the_mean_of_the_stated_ones() {
        let mut rows: Vec<Measurement> =
            (0..80).map(|i| row(Some(300.0 + f64::from(i)), Some(1.0))).collect();
        rows.push(row(None, Some(1.0)));
        rows.push(row(None, None));
        let missing = MissingInputs::of(&rows);
        assert_eq!((missing.fillings(&rows[0]), missing.fillings(&rows[80])), (1, FILLINGS));
        let values: Vec<f64> =
            (0..FILLINGS).map(|filling| missing.filled(&rows[80], filling).particle_temperature).collect();
        // The mean of 300 to 379 is 339.5.
        assert!((values.iter().sum::<f64>() / 8.0 - 339.5).abs() <= 1.0, "{values:?}");
        assert!(values[0] < 306.0 && values[7] > 373.0);
        assert!(rows.iter().take(80).all(|row| missing.filled(row, 0) == row.impact));
        // The other missing input of the last row is 1 wherever it is stated.
        assert!((0..8).all(|filling| missing.filled(&rows[81], filling).diameter == 1.0));
    }

    #[test]
    fn one_stated_value_shows_nothing() {
        let rows = [row(Some(400.0), Some(1.0)), row(None, Some(1.0)), row(None, Some(1.0))];
        assert_eq!(MissingInputs::of(&rows).filled(&rows[1], 0), rows[1].impact);
    }
}
