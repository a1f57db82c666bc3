//! Rows under a model: predictions, offsets and scatter, with everything that follows from them.

use std::borrow::Cow;
use std::sync::Arc;

use super::data_split::DataSplit;
use super::forecast::{Forecast, Prediction};
use super::likelihood::{Mean, Offset, SMALLEST_SCATTER, Scatter, add_squares, mean, regular, score};
use super::observable::Observable;
use super::smooth::Point;
use crate::dataset::Measurement;
use crate::model::Model;

/// Largest number of steps of the scatter's estimate.
const STEPS: usize = 6;
/// The estimate ends when a step changes it by less than this share.
const TOLERANCE: f64 = 3e-3;

/// Some rows of the data under a model.
#[derive(Debug, Clone)]
pub(super) struct Evaluation<'a> {
    pub data: &'a DataSplit,
    /// Indices of the rows.
    pub rows: Cow<'a, [usize]>,
    /// Predictions of `rows`, in their order.
    forecast: Arc<Forecast>,
    /// Offsets of all rows of the data, by index.
    pub offsets: Cow<'a, [Offset]>,
    pub scatter: Scatter,
}

impl<'a> Evaluation<'a> {
    /// Predicts these rows with the model.
    pub fn new(
        data: &'a DataSplit,
        model: &Model,
        rows: impl Into<Cow<'a, [usize]>>,
        offsets: impl Into<Cow<'a, [Offset]>>,
        scatter: Scatter,
    ) -> Self {
        let rows = rows.into();
        let forecast = Arc::new(Forecast::new(model, &data.rows, &rows, data.draws));
        Self { data, rows, forecast, offsets: offsets.into(), scatter }
    }

    /// The rows at these places alone.
    pub fn select(&self, places: &[usize]) -> Self {
        let rows: Vec<usize> = places.iter().map(|&place| self.rows[place]).collect();
        Self { rows: rows.into(), forecast: Arc::new(self.forecast.select(places)), ..self.clone() }
    }

    pub fn with_offsets(&self, offsets: Vec<Offset>) -> Self {
        Self { offsets: offsets.into(), ..self.clone() }
    }

    pub fn with_scatter(self, scatter: Scatter) -> Self {
        Self { scatter, ..self }
    }

    /// The scatter of largest likelihood, by expectation–maximisation from the present one.
    pub fn with_fitted_scatter(mut self) -> Self {
        for _ in 0..STEPS {
            let mut sums = [[0.0; 2]; 2];
            for (_, row, predictions, offset) in self.each() {
                add_squares(&mut sums, row, predictions, offset, self.scatter);
            }
            let before = self.scatter;
            self.scatter = [0, 1].map(|which| {
                let [sum, weight] = sums[which];
                if weight > 0.0 { (sum / weight).max(SMALLEST_SCATTER.powi(2)).sqrt() } else { before[which] }
            });
            let changes = self.scatter.iter().zip(before);
            if changes.into_iter().all(|(next, before)| (next - before).abs() < TOLERANCE * next) {
                break;
            }
        }
        self
    }

    /// Index, measurement, predictions and offset of every row.
    fn each(&self) -> impl Iterator<Item = (usize, &Measurement, &[Prediction], &Offset)> {
        let one = |(place, &index): (usize, &usize)| {
            (index, &self.data.rows[index], self.forecast.of(place), &self.offsets[index])
        };
        self.rows.iter().enumerate().map(one)
    }

    /// Log score of every row [nats].
    pub fn scores(&self) -> Vec<f64> {
        self.each()
            .map(|(_, row, predictions, offset)| score(row, predictions, offset, self.scatter))
            .collect()
    }

    /// Log score of all rows [nats].
    pub fn score(&self) -> f64 {
        self.scores().iter().sum()
    }

    /// Every row with its predicted means.
    pub fn means(&self) -> impl Iterator<Item = (&Measurement, Mean)> {
        self.each().map(|(_, row, predictions, offset)| (row, mean(predictions, offset)))
    }

    /// Measured and predicted value of every row, `None` where it was not measured.
    pub fn pairs(&self, observable: Observable) -> impl Iterator<Item = Option<[f64; 2]>> {
        self.means().map(move |(row, mean)| Some([observable.measured(row)?, observable.predicted(&mean)]))
    }

    /// Index and predicted value of every row, without its offset.
    pub fn plain(&self, observable: Observable) -> impl Iterator<Item = (usize, f64)> {
        self.each().map(move |(index, _, predictions, _)| {
            (index, observable.predicted(&mean(predictions, &Offset::default())))
        })
    }

    /// Predicted minus measured number of captures if `added` is added to the log odds; `None` without measured captures.
    pub fn excess_captures(&self, added: f64) -> Option<f64> {
        let one = |(_, row, predictions, offset): (usize, &Measurement, &[Prediction], &Offset)| {
            let offset = Offset { capture: offset.capture + added, ..*offset };
            Some(row.impacts * (mean(predictions, &offset).capture - row.captured?))
        };
        self.each().filter_map(one).fold(None, |sum, one| Some(sum.unwrap_or(0.0) + one))
    }

    /// The residuals of an observable; a curve through them is multiplied with the prediction if `multiplicative`.
    pub fn residuals(&self, observable: Observable, multiplicative: bool) -> Vec<Point> {
        let which = observable as usize;
        let point = |(index, row, predictions, offset): (usize, &Measurement, &[Prediction], &Offset)| {
            let mean = mean(predictions, offset);
            if observable == Observable::Capture {
                let variance = mean.capture * (1.0 - mean.capture);
                // One step of a logistic fit: the residual in log odds and its information.
                let (residual, weight) = ((row.captured? - mean.capture) / variance, variance * row.impacts);
                return Some(Point { row: index, residual, weight, scale: 1.0 });
            }
            let reading = [row.e_n, row.e_t][which]?;
            let expected = mean.restitution[which];
            let residual = reading.value - expected;
            let own = (self.scatter[which] * offset.spread).powi(2) + mean.variance[which];
            let variance = reading.error.map_or(own / row.rebounds.max(1.0), |error| own + error * error);
            let weight = regular(residual, variance.sqrt()) / variance;
            Some(Point { row: index, residual, weight, scale: if multiplicative { expected } else { 1.0 } })
        };
        self.each().filter_map(point).collect()
    }
}
