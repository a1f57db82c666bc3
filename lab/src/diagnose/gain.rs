//! The gain of the extended model, measured by running its file on rows that it was not fitted to; and
//! the rows of the figures.

use std::sync::Arc;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::constants::{BOOTSTRAP_RESAMPLES, LEAST_ROWS, ROW_DRAWS};
use super::data_split::DataSplit;
use super::evaluation::Evaluation;
use super::hypothesis::Hypothesis;
use super::likelihood::{Mean, Offset, Outliers, Scatter};
use super::missing_inputs::MissingInputs;
use super::observable::Observable;
use super::record::{Errors, Gain, Sample, SampleRow};
use super::rounding::Rounding;
use crate::dataset::{ColumnValues, Measurement, Measurements, Unselected};
use nearwall::Model;
use nearwall::impact::ExtraInput;

/// Largest number of rows in figures.
const SAMPLE_ROWS: usize = 1500;
/// How the gain is measured where the file has not seen some rows.
pub(super) const HELD_OUT: &str = "held-out";
/// How the gain is measured where no row is left that the file has not seen.
pub(super) const CROSS_VALIDATED: &str = "cross-validated";
/// Factor on the standard error of a cross-validated gain: its models share rows.
pub(super) const SHARED_FITS: f64 = 1.4;

/// Root mean square of the noise of the readings [1], the scatter and the stated errors together; `None` for captures.
pub(super) fn noise_floor(data: &Measurements, scatter: Scatter, observable: Observable) -> Option<f64> {
    let own = scatter.get(observable as usize)?.powi(2);
    let reading = |row: &Measurement| [row.e_n, row.e_t].get(observable as usize).copied().flatten();
    let variance = |row: &Measurement| match reading(row)?.error {
        Some(error) => Some(own + error * error),
        None => Some(own / row.rebounds.max(1.0)),
    };
    average(data.rows.iter().filter_map(variance)).map(f64::sqrt)
}

/// The rows under a hypothesis without its discrepancy, which a model file cannot contain.
pub(super) fn evaluate<'b>(hypothesis: &Hypothesis<'b>, rows: &[usize]) -> Evaluation<'b> {
    let bare = hypothesis.without_discrepancy();
    bare.evaluate(rows.to_vec(), bare.offsets())
}

/// Some rows under the base model and under an extended model file, one entry a row.
#[derive(Default)]
pub(super) struct HeldOutRows {
    units: Vec<usize>,
    /// Squared errors before and after, by observable; of captures summed over the impacts of the row.
    squares: [Vec<Option<[f64; 2]>>; 3],
    /// Number of impacts of each row.
    impacts: Vec<f64>,
    /// Log scores before and after [nats].
    scores: Vec<[f64; 2]>,
}

/// A model file with the noise about it.
pub(super) struct ModelFile<'a> {
    pub model: &'a Model,
    pub scatter: Scatter,
    /// Shares of the readings of `e_n` and `e_t` in a heavy tail, beside which the scatter was fitted [1].
    pub tails: [f64; 2],
}

impl HeldOutRows {
    /// Adds these rows of the file, predicted by the two models as a user would.
    pub fn add(&mut self, data: &Measurements, units: &[usize], rows: &[usize], models: [&ModelFile<'_>; 2]) {
        let [before, after] = models.map(|file| PredictedRows::new(file, data, rows));
        let pairs = before.scores.into_iter().zip(after.scores);
        self.scores.extend(pairs.map(|(before, after)| [before, after]));
        self.units.extend(rows.iter().map(|&row| units[row]));
        self.impacts.extend(rows.iter().map(|&row| data.rows[row].impacts));
        for ((squares, before), after) in self.squares.iter_mut().zip(before.squares).zip(after.squares) {
            squares.extend(before.into_iter().zip(after).map(|(before, after)| Some([before?, after?])));
        }
    }

    /// Number of readings of an observable; of captures every impact of a class is one.
    fn count(&self, observable: Observable) -> f64 {
        let measured = self.squares[observable as usize].iter().zip(&self.impacts);
        let counted = measured.filter(|(squares, _)| squares.is_some());
        counted.map(|(_, impacts)| if observable == Observable::Capture { *impacts } else { 1.0 }).sum()
    }

    /// The gain in one observable; `None` where too few rows have it. `noise` is the scatter that no model removes.
    pub fn gain(
        &self,
        observable: Observable,
        measured: &'static str,
        noise: Option<f64>,
        seed: u64,
        optimistic: Option<&Self>,
    ) -> Option<Gain> {
        let of_row = |(squares, &unit): (&Option<[f64; 2]>, &usize)| squares.map(|squares| (unit, squares));
        let rows: Vec<(usize, [f64; 2])> =
            self.squares[observable as usize].iter().zip(&self.units).filter_map(of_row).collect();
        if rows.len() < LEAST_ROWS {
            return None;
        }
        let count = self.count(observable);
        let rmse =
            |which: usize| (rows.iter().map(|(_, squares)| squares[which]).sum::<f64>() / count).sqrt();
        let score = |which: usize| average(self.scores.iter().map(|pair| pair[which])).unwrap_or(f64::NAN);
        let units = sums_by_unit(&rows);
        let widened = if measured == CROSS_VALIDATED { SHARED_FITS } else { 1.0 };
        let [one, other] = [bootstrap(&units, seed), student_interval(&units, widened)];
        // The file itself has seen all rows: it is better than its parts, but not better than it looks on those rows.
        let seen = optimistic.and_then(|seen| seen.gain(observable, measured, noise, seed, None));
        let least = seen.map_or(f64::INFINITY, |seen| seen.ci95[0]);
        Some(Gain {
            held_out_rows: rows.len(),
            measured,
            noise_floor: noise,
            observable: observable.name(),
            rmse_before: rmse(0),
            rmse_after: rmse(1),
            ci95: [one[0].min(other[0]).min(least), one[1].max(other[1])],
            log_score_before: score(0),
            log_score_after: score(1),
        })
    }
}

/// Rows under one model file.
struct PredictedRows {
    squares: [Vec<Option<f64>>; 3],
    scores: Vec<f64>,
}

impl PredictedRows {
    fn new(file: &ModelFile<'_>, data: &Measurements, rows: &[usize]) -> Self {
        let some = rows_for(file.model, data, rows);
        let mut split = DataSplit::bare(file.model, &some, ROW_DRAWS);
        split.missing = Arc::new(MissingInputs::of(&data.rows));
        let outliers = file.tails.map(|tails| Outliers { tails, ..Outliers::EXPECTED });
        let mut offsets = vec![Offset { outliers, ..Offset::default() }; some.len()];
        Rounding::of(&data.rows).note(&some, &mut offsets);
        let evaluation = Evaluation::new(&split, file.model, split.all(), offsets, file.scatter);
        let squares = Observable::ALL.map(|observable| {
            let pairs = evaluation.pairs(observable).zip(&some);
            pairs.map(|(pair, row)| pair.map(|pair| summed_square(observable, pair, row))).collect()
        });
        Self { squares, scores: evaluation.scores() }
    }
}

/// Rows of the file as a model reads them: with the inputs that it declares.
fn rows_for(model: &Model, data: &Measurements, rows: &[usize]) -> Vec<Measurement> {
    let mut some: Vec<Measurement> = rows.iter().map(|&row| data.rows[row]).collect();
    for (place, input) in model.extra_inputs().iter().enumerate() {
        let Some(column) = data.columns.iter().find(|column| column.name == input.name) else { continue };
        for (one, &row) in some.iter_mut().zip(rows) {
            one.impact.extra[place] = extra_value(input, &column.values, row);
        }
    }
    some
}

/// The cell of a row as an input of a model; NaN where blank.
fn extra_value(input: &ExtraInput, values: &ColumnValues, row: usize) -> f64 {
    match values {
        ColumnValues::Numbers(numbers) => numbers[row],
        ColumnValues::Labels { levels, of_row } => {
            of_row[row].and_then(|level| input.value_of_text(&levels[level])).unwrap_or(f64::NAN)
        }
    }
}

/// The sums of squared errors before and after, by independent unit.
pub(super) fn sums_by_unit(rows: &[(usize, [f64; 2])]) -> Vec<[f64; 2]> {
    let mut sums: std::collections::BTreeMap<usize, [f64; 2]> = std::collections::BTreeMap::new();
    for (unit, squares) in rows {
        let sum = sums.entry(*unit).or_default();
        sum.iter_mut().zip(squares).for_each(|(sum, square)| *sum += square);
    }
    sums.into_values().collect()
}

/// 95 % interval of the ratio of the root mean squares, by a bootstrap over units.
pub(super) fn bootstrap(units: &[[f64; 2]], seed: u64) -> [f64; 2] {
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x6761_696e);
    let mut ratios: Vec<f64> = (0..BOOTSTRAP_RESAMPLES)
        .map(|_| {
            let mut sums = [0.0; 2];
            for _ in 0..units.len() {
                let [before, after] = units[(random.next_u64() % units.len() as u64) as usize];
                sums[0] += before;
                sums[1] += after;
            }
            if sums[0] > 0.0 { (sums[1] / sums[0]).sqrt() } else { 1.0 }
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    [ratios[BOOTSTRAP_RESAMPLES / 40], ratios[BOOTSTRAP_RESAMPLES - 1 - BOOTSTRAP_RESAMPLES / 40]]
}

/// The same by Student's t of the linearised logarithm of the ratio, which is wider for few units;
/// `widened` multiplies its error.
pub(super) fn student_interval(units: &[[f64; 2]], widened: f64) -> [f64; 2] {
    let count = units.len() as f64;
    let sums = units.iter().fold([0.0; 2], |[b, a], [before, after]| [b + before, a + after]);
    let logarithm = 0.5 * (sums[1] / sums[0]).ln();
    if !logarithm.is_finite() || count < 2.0 {
        return [0.0, f64::INFINITY];
    }
    let term = |[before, after]: &[f64; 2]| (0.5 * (after / sums[1] - before / sums[0])).powi(2);
    let error = (units.iter().map(term).sum::<f64>() * count / (count - 1.0)).sqrt() * widened;
    let quantile = StudentsT::new(0.0, 1.0, count - 1.0).map_or(2.0, |law| law.inverse_cdf(0.975));
    [-1.0, 1.0].map(|sign| (logarithm + sign * quantile * error).exp())
}

/// The squared error of a reading, or those of all captures and rebounds of a row together.
fn summed_square(observable: Observable, [measured, predicted]: [f64; 2], row: &Measurement) -> f64 {
    match observable {
        Observable::Capture => {
            row.impacts * (measured * (1.0 - predicted).powi(2) + (1.0 - measured) * predicted * predicted)
        }
        _ => squared([measured, predicted]),
    }
}

/// Squared difference of a measured and a predicted value.
fn squared([measured, predicted]: [f64; 2]) -> f64 {
    (measured - predicted).powi(2)
}

fn average(values: impl Iterator<Item = f64>) -> Option<f64> {
    mean_of(total(values))
}

/// The sum and the number of some values.
fn total(values: impl Iterator<Item = f64>) -> (f64, usize) {
    let values: Vec<f64> = values.collect();
    (values.iter().sum(), values.len())
}

fn mean_of((sum, count): (f64, usize)) -> Option<f64> {
    (count > 0).then(|| sum / count as f64)
}

/// Sum and number of the squared errors of `e_n` and `e_t` and of the log losses of captures [nats] on these rows.
pub(super) fn misfits(rows: &Evaluation<'_>) -> [(f64, usize); 3] {
    let loss = |[share, p]: [f64; 2]| -(share * p.ln() + (1.0 - share) * (1.0 - p).ln());
    Observable::ALL.map(|observable| {
        let pairs = rows.pairs(observable).flatten();
        match observable {
            Observable::Capture => total(pairs.map(loss)),
            _ => total(pairs.map(squared)),
        }
    })
}

/// The errors of the base model on these rows and on those that were not selected.
pub(super) fn errors(rows: &Evaluation<'_>, unselected: &Unselected) -> Errors {
    let mut misfits = misfits(rows);
    for (own, more) in misfits.iter_mut().zip(unselected.misfits) {
        *own = (own.0 + more.0, own.1 + more.1);
    }
    let [e_n, e_t, loss] = misfits.map(mean_of);
    Errors { rmse_e_n: e_n.map(f64::sqrt), rmse_e_t: e_t.map(f64::sqrt), log_loss_stick: loss }
}

/// Mean measured and predicted share of captures, without offsets.
pub(super) fn captured_shares(hypothesis: &Hypothesis<'_>) -> [f64; 2] {
    let model = Hypothesis::with_parts(hypothesis.data, hypothesis.parts.clone(), hypothesis.scatter);
    let rows = model.evaluate(&model.data.search, model.offsets());
    let pairs: Vec<[f64; 2]> = rows.pairs(Observable::Capture).flatten().collect();
    [0, 1].map(|which| pairs.iter().map(|pair| pair[which]).sum::<f64>() / pairs.len().max(1) as f64)
}

/// Rows of the figures: held-out rows first, then fitted ones.
pub(super) fn sample(base: &Hypothesis<'_>, extended: &Hypothesis<'_>) -> Sample {
    let data = base.data;
    let some = |rows: &[usize]| rows[..rows.len().min(SAMPLE_ROWS / 2)].to_vec();
    let (held_out, fitted) = (some(&data.held_out), some(&data.search));
    let rows = [held_out.as_slice(), &fitted].concat();
    let (before, after) = (evaluate(base, &rows), evaluate(extended, &rows));
    let value = |((measured, base), (_, extended)): ((&Measurement, Mean), (&Measurement, Mean))| {
        Observable::ALL.map(|observable| {
            let predicted = [&base, &extended].map(|mean| observable.predicted(mean));
            observable.measured(measured).map(|value| [value, predicted[0], predicted[1]])
        })
    };
    let values: Vec<[Option<[f64; 3]>; 3]> = before.means().zip(after.means()).map(value).collect();
    let row = |(place, &row): (usize, &usize)| {
        let cells = data.covariates.iter().map(|column| column.cell(row)).collect();
        let Measurement { e_n, e_t, .. } = data.rows[row];
        let errors = [e_n, e_t].map(|reading| reading.and_then(|reading| reading.error));
        SampleRow { held_out: place < held_out.len(), cells, errors, values: values[place] }
    };
    let words = data.covariates.iter().map(|column| match &column.values {
        ColumnValues::Labels { levels, .. } => Some(levels.clone()),
        ColumnValues::Numbers(_) => None,
    });
    Sample {
        columns: data.covariates.iter().map(|c| (c.name.clone(), c.unit.to_owned())).collect(),
        words: words.collect(),
        rows: rows.iter().enumerate().map(row).collect(),
        ..Sample::default()
    }
}
