//! The gain of the extended model on held-out rows, and the rows of the figures.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::evaluation::Evaluation;
use super::hypothesis::Hypothesis;
use super::likelihood::Mean;
use super::observable::Observable;
use super::record::{Errors, Gain, Sample, SampleRow};
use crate::dataset::{Measurement, Values};

/// Resamples of the bootstrap.
const RESAMPLES: usize = 1000;
/// Largest number of rows in figures.
const SAMPLE_ROWS: usize = 1500;
/// Least number of held-out rows for a gain.
const LEAST_ROWS: usize = 3;

/// The rows under a hypothesis without its discrepancy, which a model file cannot contain.
pub(super) fn evaluate<'b>(hypothesis: &Hypothesis<'b>, rows: &[usize]) -> Evaluation<'b> {
    let bare = Hypothesis { discrepancy: None, ..hypothesis.clone() };
    bare.evaluate(rows.to_vec(), bare.offsets())
}

/// The gain in one observable; `None` where too few rows have it.
pub(super) fn gain(
    before: &Evaluation<'_>,
    after: &Evaluation<'_>,
    observable: Observable,
    seed: u64,
) -> Option<Gain> {
    let pairs = before.pairs(observable).zip(after.pairs(observable));
    let squares: Vec<[f64; 2]> =
        pairs.filter_map(|(before, after)| Some([squared(before?), squared(after?)])).collect();
    if squares.len() < LEAST_ROWS {
        return None;
    }
    let rmse = |which: usize| average(squares.iter().map(|pair| pair[which])).map_or(f64::NAN, f64::sqrt);
    let log_score = |rows: &Evaluation<'_>| average(rows.scores().into_iter()).unwrap_or(f64::NAN);
    Some(Gain {
        held_out_rows: squares.len(),
        measured: "held-out",
        noise_floor: None,
        observable: observable.name(),
        rmse_before: rmse(0),
        rmse_after: rmse(1),
        ci95: bootstrap(&squares, seed),
        log_score_before: log_score(before),
        log_score_after: log_score(after),
    })
}

/// 95 % interval of the ratio of the root mean squares.
fn bootstrap(squares: &[[f64; 2]], seed: u64) -> [f64; 2] {
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x6761_696e);
    let mut ratios: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            let mut sums = [0.0; 2];
            for _ in 0..squares.len() {
                let [before, after] = squares[(random.next_u64() % squares.len() as u64) as usize];
                sums[0] += before;
                sums[1] += after;
            }
            if sums[0] > 0.0 { (sums[1] / sums[0]).sqrt() } else { 1.0 }
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    [ratios[RESAMPLES / 40], ratios[RESAMPLES - 1 - RESAMPLES / 40]]
}

/// Squared difference of a measured and a predicted value.
fn squared([measured, predicted]: [f64; 2]) -> f64 {
    (measured - predicted).powi(2)
}

fn average(values: impl Iterator<Item = f64>) -> Option<f64> {
    let values: Vec<f64> = values.collect();
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The errors of a hypothesis on these rows.
pub(super) fn errors(rows: &Evaluation<'_>) -> Errors {
    let rmse = |observable| average(rows.pairs(observable).flatten().map(squared)).map(f64::sqrt);
    let loss = |[share, p]: [f64; 2]| -(share * p.ln() + (1.0 - share) * (1.0 - p).ln());
    Errors {
        rmse_e_n: rmse(Observable::NormalRestitution),
        rmse_e_t: rmse(Observable::TangentialRestitution),
        log_loss_stick: average(rows.pairs(Observable::Capture).flatten().map(loss)),
    }
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
        Values::Labels { levels, .. } => Some(levels.clone()),
        Values::Numbers(_) => None,
    });
    Sample {
        columns: data.covariates.iter().map(|c| (c.name.clone(), c.unit.to_owned())).collect(),
        words: words.collect(),
        rows: rows.iter().enumerate().map(row).collect(),
        ..Sample::default()
    }
}
