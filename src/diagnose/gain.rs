//! What the extended model gains, on rows that no fit and no choice saw.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::data_split::DataSplit;
use super::forecast::Forecast;
use super::hypothesis::{Hypothesis, Observable};
use super::likelihood::{Mean, Scatter, mean, score};
use super::record::{Errors, Gain, Sample, SampleRow};
use crate::dataset::{Measurement, Values};

/// Resamples of the bootstrap.
const RESAMPLES: usize = 1000;
/// Rows in figures at most.
const SAMPLE_ROWS: usize = 1500;

/// What a hypothesis says of some rows.
pub(super) struct Answers {
    means: Vec<Mean>,
    scores: Vec<f64>,
}

impl Answers {
    /// Asks without the correction of the laws' shape: a model file cannot carry it.
    pub fn new(hypothesis: &Hypothesis, study: &DataSplit, rows: &[usize], scatter: Scatter) -> Self {
        let bare = Hypothesis { shape: None, ..hypothesis.clone() };
        let shifts = bare.shifts(study);
        let forecast = Forecast::new(&bare.model(study), &study.rows, rows, study.draws);
        let each = || rows.iter().enumerate();
        Self {
            means: each().map(|(place, &row)| mean(forecast.of(place), &shifts[row])).collect(),
            scores: each()
                .map(|(place, &row)| score(&study.rows[row], forecast.of(place), &shifts[row], scatter))
                .collect(),
        }
    }
}

/// Measured and expected, where the row has it.
fn pair(row: &Measurement, said: &Mean, observable: Observable) -> Option<[f64; 2]> {
    match observable {
        Observable::NormalRestitution => row.e_n.as_ref().map(|reading| [reading.value, said.e_n]),
        Observable::TangentialRestitution => row.e_t.as_ref().map(|reading| [reading.value, said.e_t]),
        Observable::Capture => row.captured.map(|share| [share, said.capture]),
    }
}

/// The gain in one observable; `None` where nothing was observed.
pub(super) fn gain(
    study: &DataSplit,
    before: &Answers,
    after: &Answers,
    observable: Observable,
    seed: u64,
) -> Option<Gain> {
    let rows = study.held_out.iter().enumerate();
    let squares: Vec<[f64; 2]> = rows
        .filter_map(|(place, &row)| {
            let of = |answers: &Answers| pair(&study.rows[row], &answers.means[place], observable);
            let squared = |[measured, said]: [f64; 2]| (measured - said).powi(2);
            Some([squared(of(before)?), squared(of(after)?)])
        })
        .collect();
    if squares.len() < 3 {
        return None;
    }
    let sum = |which: usize| squares.iter().map(|pair| pair[which]).sum::<f64>();
    let root = |sum: f64| (sum / squares.len() as f64).sqrt();
    let mean_score = |answers: &Answers| answers.scores.iter().sum::<f64>() / answers.scores.len() as f64;
    Some(Gain {
        held_out_rows: squares.len(),
        observable: observable.name(),
        rmse_before: root(sum(0)),
        rmse_after: root(sum(1)),
        ci95: bootstrap(&squares, seed),
        log_score_before: mean_score(before),
        log_score_after: mean_score(after),
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

/// Errors of a hypothesis on all rows of `answers`.
pub(super) fn errors(study: &DataSplit, rows: &[usize], answers: &Answers) -> Errors {
    let pairs = |observable| {
        let all = rows.iter().zip(&answers.means);
        all.filter_map(|(&row, said)| pair(&study.rows[row], said, observable)).collect::<Vec<_>>()
    };
    let average =
        |losses: Vec<f64>| (!losses.is_empty()).then(|| losses.iter().sum::<f64>() / losses.len() as f64);
    let rmse = |observable| {
        let squares = pairs(observable).iter().map(|[measured, said]| (measured - said).powi(2)).collect();
        average(squares).map(f64::sqrt)
    };
    let loss = |[share, said]: &[f64; 2]| -(share * said.ln() + (1.0 - share) * (1.0 - said).ln());
    Errors {
        rmse_e_n: rmse(Observable::NormalRestitution),
        rmse_e_t: rmse(Observable::TangentialRestitution),
        log_loss_stick: average(pairs(Observable::Capture).iter().map(loss).collect()),
    }
}

/// Rows for the figures: those held out first, then those that were fitted.
pub(super) fn sample(
    study: &DataSplit,
    base: &Hypothesis,
    extended: &Hypothesis,
    scatter: Scatter,
) -> Sample {
    let held_out = study.held_out.iter().take(SAMPLE_ROWS / 2).map(|&row| (row, true));
    let fitted = study.search.iter().take(SAMPLE_ROWS / 2).map(|&row| (row, false));
    let chosen: Vec<(usize, bool)> = held_out.chain(fitted).collect();
    let rows: Vec<usize> = chosen.iter().map(|(row, _)| *row).collect();
    let (before, after) =
        (Answers::new(base, study, &rows, scatter), Answers::new(extended, study, &rows, scatter));
    let cell = |values: &Values, row: usize| match values {
        Values::Numbers(numbers) => numbers[row],
        Values::Words { of_row, .. } => of_row[row].map_or(f64::NAN, |level| level as f64),
    };
    let triple = |place: usize, observable| {
        let row = &study.rows[rows[place]];
        let [measured, base] = pair(row, &before.means[place], observable)?;
        let [_, extended] = pair(row, &after.means[place], observable)?;
        Some([measured, base, extended])
    };
    let row = |(place, &(row, held_out)): (usize, &(usize, bool))| SampleRow {
        held_out,
        cells: study.factors.iter().map(|factor| cell(&factor.values, row)).collect(),
        e_n: triple(place, Observable::NormalRestitution),
        e_t: triple(place, Observable::TangentialRestitution),
        captured: triple(place, Observable::Capture),
    };
    Sample {
        columns: study.factors.iter().map(|f| (f.name.clone(), f.unit.to_owned())).collect(),
        words: study
            .factors
            .iter()
            .map(|factor| match &factor.values {
                Values::Words { levels, .. } => Some(levels.clone()),
                Values::Numbers(_) => None,
            })
            .collect(),
        rows: chosen.iter().enumerate().map(row).collect(),
    }
}
