//! The rows under one model: log likelihood and errors.

use super::super::constants::{FIRST_SCATTER, ROW_DRAWS};
use super::super::data_split::DataSplit;
use super::super::evaluation::Evaluation;
use super::super::likelihood::{Offset, Scatter};
use super::super::observable::Observable;
use crate::dataset::Measurement;
use nearwall::model::Model;

/// The rows under one model.
pub(super) struct ScoredRows {
    /// Log likelihood of each row [nats], with a scatter that was estimated on other rows.
    pub likelihood: Vec<f64>,
    /// Measured and predicted `e_n`, `e_t` and share captured of each row.
    pub pairs: [Vec<Option<[f64; 2]>>; 3],
    /// Number of impacts of each row.
    pub impacts: Vec<f64>,
    /// Scatter of `e_n` and `e_t`, estimated on all rows [1].
    pub scatter: Scatter,
}

impl ScoredRows {
    /// Predicts the rows; `folds` is the part of each row.
    pub fn new(model: &Model, rows: &[Measurement], folds: &[usize]) -> Self {
        let all: Vec<usize> = (0..rows.len()).collect();
        let data = DataSplit::bare(model, rows, ROW_DRAWS);
        let offsets = vec![Offset::default(); rows.len()];
        let whole = Evaluation::new(&data, model, all.clone(), offsets, FIRST_SCATTER);
        let mut likelihood = vec![0.0; rows.len()];
        let parts = folds.iter().max().map_or(0, |last| last + 1);
        for part in 0..parts {
            let (inside, outside): (Vec<usize>, Vec<usize>) =
                all.iter().copied().partition(|row| folds[*row] == part);
            let scatter = whole.select(&outside).with_fitted_scatter().scatter;
            let scores = whole.select(&inside).with_scatter(scatter).scores();
            inside.into_iter().zip(scores).for_each(|(row, score)| likelihood[row] = score);
        }
        let pairs = Observable::ALL.map(|observable| whole.pairs(observable).collect());
        let impacts = rows.iter().map(|row| row.impacts).collect();
        Self { likelihood, pairs, impacts, scatter: whole.with_fitted_scatter().scatter }
    }
}
