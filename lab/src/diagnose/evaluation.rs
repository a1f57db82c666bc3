//! Rows under a model: predictions, offsets and scatter, with everything that follows from them.

use std::borrow::Cow;
use std::sync::Arc;

use super::constant_capture::ConstantCapture;
use super::data_split::DataSplit;
use super::forecast::{Forecast, Prediction};
use super::likelihood::{
    Mean, Offset, SMALLEST_SCATTER, Scatter, Weight, add_squares, censored, mean, reading_noise, score,
};
use super::observable::Observable;
use super::shared_error::{GroupSums, SharedErrors};
use super::smooth::WeightedResidual;
use crate::dataset::{Limit, Measurement, Reading};
use nearwall::model::Model;

/// Largest number of steps of the scatter's estimate.
const SCATTER_STEPS: usize = 8;
/// Largest slope of the log score of one impact by the probability of capture [1].
const STEEPEST: f64 = 20.0;
/// The estimate ends when a step changes it by less than this share.
const SCATTER_TOLERANCE: f64 = 3e-3;

/// A reading of `e_n` or `e_t` about its prediction.
struct Residual {
    /// 0 for `e_n`, 1 for `e_t`.
    which: usize,
    /// Measured minus predicted value [1].
    value: f64,
    /// Inverse variance, less where it looks like a gross error [1].
    weight: f64,
}

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
    /// What the captures of all rows have in common.
    pub captures: ConstantCapture,
    /// Errors that groups of rows share, as of the last fit of the scatter.
    pub shared: Arc<SharedErrors>,
}

/// The slope of a row's log score by the predictions.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Slope {
    /// By `e_n` and `e_t` [1].
    pub restitution: [f64; 2],
    /// By the probability of capture [1].
    pub capture: f64,
    /// Information on each observable: minus the expected second derivative [1].
    pub information: [f64; 3],
}

/// A reading beside its prediction.
#[derive(Debug, Clone, Copy)]
pub(super) struct StatedResidual {
    pub line: u64,
    pub observable: Observable,
    pub measured: f64,
    pub predicted: f64,
    /// Measured minus predicted value in stated standard errors [1].
    pub standard_errors: f64,
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
        let forecast = Arc::new(Forecast::of_data(model, data, &rows));
        Self::of_forecast(data, forecast, rows, offsets, scatter)
    }

    /// These rows with predictions that are known, in their order.
    pub fn of_forecast(
        data: &'a DataSplit,
        forecast: Arc<Forecast>,
        rows: impl Into<Cow<'a, [usize]>>,
        offsets: impl Into<Cow<'a, [Offset]>>,
        scatter: Scatter,
    ) -> Self {
        let rows = rows.into();
        let (shared, captures) = (Arc::new(SharedErrors::default()), ConstantCapture::default());
        Self { data, rows, forecast, offsets: offsets.into(), scatter, captures, shared }
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

    pub fn with_captures(self, captures: ConstantCapture) -> Self {
        Self { captures, ..self }
    }

    /// The scatter and the ceiling of captures of largest likelihood, by scoring from the present ones,
    /// with the errors that groups share.
    pub fn with_fitted_scatter(mut self) -> Self {
        for _ in 0..SCATTER_STEPS {
            self.fit_shared_errors();
            let mut sums = [[0.0; 2]; 2];
            for (_, row, predictions, offset) in self.each() {
                add_squares(&mut sums, row, predictions, &offset, self.scatter);
            }
            let ceiling = self.captures.ceiling;
            self.captures = self.captures.stepped(self.outcomes());
            let before = self.scatter;
            self.scatter = [0, 1].map(|which| {
                let [sum, weight] = sums[which];
                if weight > 0.0 { (sum / weight).max(SMALLEST_SCATTER.powi(2)).sqrt() } else { before[which] }
            });
            let changes = self.scatter.iter().zip(before);
            let mut changes = changes.chain(self.captures.ceiling.as_ref().zip(ceiling));
            if changes.all(|(next, before)| (next - before).abs() < SCATTER_TOLERANCE * next) {
                break;
            }
        }
        self
    }

    /// The same rows without the errors that groups share.
    pub fn without_shared_errors(self) -> Self {
        Self { shared: Arc::default(), ..self }
    }

    /// Estimates the errors that groups of rows share, if any do.
    fn fit_shared_errors(&mut self) {
        let Some(groups) = &self.data.shared else { return };
        let mut sums = vec![GroupSums::default(); groups.count];
        for (place, &index) in self.rows.iter().enumerate() {
            let row = &self.data.rows[index];
            let group = groups.of_row[index];
            let own = &mut sums[group];
            own.rows += 1.0;
            if row.captured.is_some_and(|share| share >= 1.0) {
                continue;
            }
            let offset = self.offset(index);
            let mean = mean(self.forecast.of(place), &offset);
            let known = self.shared.offset(group);
            for Residual { which, value, weight } in self.row_residuals(row, &mean, &offset) {
                own.weight[which] += weight;
                own.residual[which] += weight * (value + known[which]);
            }
        }
        self.shared = Arc::new(SharedErrors::fit(sums));
    }

    /// The offset of a row, with the shared error of its group.
    #[inline]
    fn offset(&self, index: usize) -> Offset {
        let mut offset = self.captures.beside(&self.offsets[index]);
        if let Some(groups) = &self.data.shared {
            let group = groups.of_row[index];
            let shared = self.shared.offset(group);
            offset.restitution.iter_mut().zip(shared).for_each(|(sum, shared)| *sum += shared);
            offset.uncertainty = self.shared.variance(group);
        }
        offset
    }

    /// Index, measurement, predictions and offset of every row.
    #[inline]
    fn each(&self) -> impl Iterator<Item = (usize, &Measurement, &[Prediction], Offset)> {
        let one = |(place, &index): (usize, &usize)| {
            (index, &self.data.rows[index], self.forecast.of(place), self.offset(index))
        };
        self.rows.iter().enumerate().map(one)
    }

    /// The readings of a row about their predicted means; of a censored one the step to the summit of its likelihood.
    #[inline]
    fn row_residuals(
        &self,
        row: &Measurement,
        mean: &Mean,
        offset: &Offset,
    ) -> impl Iterator<Item = Residual> {
        let one = |(which, reading): (usize, Option<Reading>)| {
            let reading = reading?;
            let (width, shift) = reading_noise(self.scatter[which], offset, which, row, &reading, mean);
            let value = reading.value - mean.restitution[which] - shift;
            Some(Residual {
                which,
                value,
                weight: Weight::of(value, width, offset.outliers[which]).precision / (width * width),
            })
        };
        let limit = |(which, limit): (usize, Option<Limit>)| {
            let seen = censored(self.scatter[which], offset, which, row, &limit?, mean);
            let weight = seen.information;
            (weight > 0.0).then(|| Residual { which, value: seen.slope / weight, weight })
        };
        let readings = [row.e_n, row.e_t].into_iter().enumerate().filter_map(one);
        readings.chain(row.limits.into_iter().enumerate().filter_map(limit))
    }

    /// Log score of every row [nats].
    pub fn scores(&self) -> Vec<f64> {
        let cost = |index: usize| {
            self.data.shared.as_ref().map_or(0.0, |groups| self.shared.cost(groups.of_row[index]))
        };
        self.each()
            .map(|(index, row, predictions, offset)| {
                score(row, predictions, &offset, self.scatter) - cost(index)
            })
            .collect()
    }

    /// Log score of all rows [nats].
    pub fn score(&self) -> f64 {
        self.scores().iter().sum()
    }

    /// Every row with its predicted means, without what its group shares.
    pub fn means(&self) -> impl Iterator<Item = (&Measurement, Mean)> {
        let one = |(place, &index): (usize, &usize)| {
            (
                &self.data.rows[index],
                mean(self.forecast.of(place), &self.captures.beside(&self.offsets[index])),
            )
        };
        self.rows.iter().enumerate().map(one)
    }

    /// Measured and predicted value of every row, `None` where it was not measured.
    pub fn pairs(&self, observable: Observable) -> impl Iterator<Item = Option<[f64; 2]>> {
        self.means().map(move |(row, mean)| Some([observable.measured(row)?, observable.predicted(&mean)]))
    }

    /// The first reading of every row about its predicted mean, in standard deviations; `None` without one.
    pub fn standardised(&self) -> Vec<Option<f64>> {
        let one = |(_, row, predictions, offset): (usize, &Measurement, &[Prediction], Offset)| {
            let mean = mean(predictions, &offset);
            let (which, reading) =
                [row.e_n, row.e_t].into_iter().enumerate().find_map(|(which, one)| Some((which, one?)))?;
            let (width, shift) = reading_noise(self.scatter[which], &offset, which, row, &reading, &mean);
            Some((reading.value - mean.restitution[which] - shift) / width)
        };
        self.each().map(one).collect()
    }

    /// Index and predicted value of every row, without its offset.
    pub fn plain(&self, observable: Observable) -> impl Iterator<Item = (usize, f64)> {
        self.each().map(move |(index, _, predictions, _)| {
            (index, observable.predicted(&mean(predictions, &Offset::default())))
        })
    }

    /// Predicted minus measured number of captures if `added` is added to the log odds; `None`
    /// without measured captures.
    pub fn excess_captures(&self, added: f64) -> Option<f64> {
        let one = |(_, row, predictions, offset): (usize, &Measurement, &[Prediction], Offset)| {
            let offset = Offset { capture: offset.capture + added, ..offset };
            Some(row.impacts * (mean(predictions, &offset).capture - row.captured?))
        };
        self.each().filter_map(one).fold(None, |sum, one| Some(sum.unwrap_or(0.0) + one))
    }

    /// Number of impacts, share captured and predicted share of the rows whose outcome is known, each [1].
    fn outcomes(&self) -> impl Iterator<Item = [f64; 3]> {
        self.means().filter_map(|(row, mean)| Some([row.impacts, known_share(row)?, mean.capture]))
    }

    /// Index, number of impacts and share captured [1] of the rows whose outcome is known.
    pub fn shares(&self) -> impl Iterator<Item = (usize, [f64; 2])> {
        self.rows.iter().filter_map(|&index| {
            let row = &self.data.rows[index];
            Some((index, [row.impacts, known_share(row)?]))
        })
    }

    /// The slope of every row's log score by the predictions, without draws.
    pub fn slopes(&self) -> Vec<Slope> {
        let one = |(_, row, predictions, offset): (usize, &Measurement, &[Prediction], Offset)| {
            let mean = mean(predictions, &offset);
            let mut slope = Slope::default();
            if let Some(captured) = row.captured {
                let information = row.impacts / (mean.capture * (1.0 - mean.capture));
                // Where the model is certain, one row must not outweigh all others.
                let most = STEEPEST * row.impacts;
                slope.capture = (information * (captured - mean.capture)).clamp(-most, most);
                slope.information[2] = information;
            } else if row.is_unstated_rebound() {
                // It speaks against captures, but is no measured share of them.
                slope.capture = -1.0 / (1.0 - mean.capture).max(1.0 / STEEPEST);
            }
            for Residual { which, value, weight } in self.row_residuals(row, &mean, &offset) {
                slope.restitution[which] = weight * value;
                slope.information[which] = weight;
            }
            slope
        };
        self.each().map(one).collect()
    }

    /// Chi-square of the stated errors and the number of readings; `None` unless all readings have a stated error.
    pub fn stated_chi_square(&self) -> Option<(f64, usize)> {
        let (mut sum, mut count) = (0.0, 0);
        for residual in self.stated_residuals()? {
            sum += residual.standard_errors.powi(2);
            count += 1;
        }
        (count > 0).then_some((sum, count))
    }

    /// Pearson's chi-square of captures in classes, and the number of classes.
    pub fn dispersion(&self) -> (f64, usize) {
        let (mut sum, mut count) = (0.0, 0);
        for (_, row, predictions, offset) in self.each().filter(|(_, row, ..)| row.impacts > 1.0) {
            let Some(captured) = row.captured else { continue };
            let p = mean(predictions, &offset).capture;
            sum += row.impacts * (captured - p).powi(2) / (p * (1.0 - p));
            count += 1;
        }
        (sum, count)
    }

    /// Pearson's chi-square of all captures and readings, and their number.
    pub fn pearson(&self) -> (f64, usize) {
        let (mut sum, mut count) = (0.0, 0);
        for slope in self.slopes() {
            for (slope, information) in [
                (slope.restitution[0], slope.information[0]),
                (slope.restitution[1], slope.information[1]),
                (slope.capture, slope.information[2]),
            ] {
                if information > 0.0 {
                    sum += slope * slope / information;
                    count += 1;
                }
            }
        }
        (sum, count)
    }

    /// The residuals in stated standard errors; `None` unless all readings have one.
    pub fn stated_residuals(&self) -> Option<Vec<StatedResidual>> {
        let mut all = Vec::new();
        for (_, row, predictions, offset) in self.each() {
            let mean = mean(predictions, &offset);
            for (which, reading) in [row.e_n, row.e_t].into_iter().enumerate() {
                let Some(reading) = reading else { continue };
                let error = reading.error?;
                let variance =
                    error * error + offset.variance[which] + mean.variance[which] / row.rebounds.max(1.0);
                let predicted = mean.restitution[which];
                let standard_errors = (reading.value - predicted) / variance.sqrt();
                let observable = Observable::ALL[which];
                all.push(StatedResidual {
                    line: row.line,
                    observable,
                    measured: reading.value,
                    predicted,
                    standard_errors,
                });
            }
        }
        Some(all)
    }

    /// The residuals of an observable; a curve through them is multiplied with the prediction if `multiplicative`.
    pub fn residuals(&self, observable: Observable, multiplicative: bool) -> Vec<WeightedResidual> {
        let which = observable as usize;
        let point = |(index, row, predictions, offset): (usize, &Measurement, &[Prediction], Offset)| {
            let mean = mean(predictions, &offset);
            if observable == Observable::Capture {
                let variance = mean.capture * (1.0 - mean.capture);
                // One step of a logistic fit: the residual in log odds and its information.
                let (residual, weight) = ((row.captured? - mean.capture) / variance, variance * row.impacts);
                return Some(WeightedResidual { row: index, residual, weight, scale: 1.0 });
            }
            let own = self.row_residuals(row, &mean, &offset).find(|residual| residual.which == which)?;
            let scale =
                if multiplicative { mean.restitution[which] - offset.restitution[which] } else { 1.0 };
            Some(WeightedResidual { row: index, residual: own.value, weight: own.weight, scale })
        };
        self.each().filter_map(point).collect()
    }
}

/// The share of a row's impacts that were captured [1]; `None` where the outcome is not known.
fn known_share(row: &Measurement) -> Option<f64> {
    row.captured.or_else(|| row.is_unstated_rebound().then_some(0.0))
}
