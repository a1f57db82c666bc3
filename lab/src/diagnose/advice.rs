//! The measurement that would distinguish two causes.
//!
//! Each input in turn varies over the range that the laboratory states, or over twice that of the data,
//! with all others at their medians.
//! The best place to measure is where the predictions of the two fitted models differ most,
//! relative to the scatter. The number of impacts is that of a comparison of two groups, one at
//! each end, with 5 % false alarms and 80 % power: `n = 2 · 2 (1.96 + 0.84)² (scatter /
//! difference)²`.

use super::forecast::Forecast;
use super::hypothesis::Hypothesis;
use super::likelihood::{Offset, mean};
use super::observable::Observable;
use super::reach::Reach;
use super::record::NextMeasurement;
use crate::dataset::Measurement;
use nearwall::impact::{INPUTS, Input};

/// Places along an input.
const INPUT_STEPS: usize = 9;
/// (1.96 + 0.84)².
const POWER: f64 = 7.85;
/// Largest number of impacts in an advice.
const MOST_ADVISED_IMPACTS: f64 = 1e5;
/// Scatter of a capture [1].
const CAPTURE_SCATTER: f64 = 0.5;

/// The measurement that best distinguishes two hypotheses with their names; `None` if no single input does.
pub(super) fn advise(
    [found, other]: [&Hypothesis<'_>; 2],
    [cause, against]: [&str; 2],
    reach: &[Reach],
) -> Option<NextMeasurement> {
    let middle = median_row(found)?;
    let candidates = INPUTS.iter().filter_map(|input| {
        let [first, last] = range(input, found, reach)?;
        let row = |step: usize| {
            let mut row = middle;
            (input.set)(&mut row.impact, first + step as f64 / (INPUT_STEPS - 1) as f64 * (last - first));
            row
        };
        let rows: Vec<Measurement> = (0..INPUT_STEPS).map(row).collect();
        let (impacts, observable, ends) = best_contrast(&rows, found, other)?;
        Some(NextMeasurement {
            cause: cause.to_owned(),
            against: against.to_owned(),
            vary: input.name.to_owned(),
            range: ends.map(|step| (input.value)(&rows[step].impact)),
            unit: input.unit,
            observable: observable.name(),
            impacts: (impacts.ceil() as u64).max(10),
        })
    });
    candidates.min_by_key(|measure| measure.impacts)
}

/// The range of an input in the next measurement; `None` where it cannot be varied.
fn range(input: &Input, found: &Hypothesis<'_>, reach: &[Reach]) -> Option<[f64; 2]> {
    if !reach.is_empty() {
        return reach.iter().find(|one| one.name == input.name).map(|one| one.range);
    }
    let [low, high] = found.data.range(input.name)?;
    let beyond = 0.5 * (high - low);
    let first = if low > 0.0 { (low - beyond).max(0.5 * low) } else { low };
    Some([first, if input.unit == "1" { high } else { high + beyond }])
}

/// Least number of impacts, the observable to measure and the two rows to compare.
fn best_contrast(
    rows: &[Measurement],
    found: &Hypothesis<'_>,
    other: &Hypothesis<'_>,
) -> Option<(f64, Observable, [usize; 2])> {
    let places: Vec<usize> = (0..rows.len()).collect();
    let [ours, theirs] = [found, other].map(|hypothesis| {
        let forecast = Forecast::new(&hypothesis.model(), rows, &places, hypothesis.data.draws);
        places.iter().map(|&place| mean(forecast.of(place), &Offset::default())).collect::<Vec<_>>()
    });
    let [e_n, e_t] = found.scatter;
    let mut best: Option<(f64, Observable, [usize; 2])> = None;
    for low in 0..rows.len() {
        for high in low + 1..rows.len() {
            for (observable, scatter) in Observable::ALL.into_iter().zip([e_n, e_t, CAPTURE_SCATTER]) {
                let of = |mean| observable.predicted(mean);
                let difference = (of(&ours[high]) - of(&ours[low])) - (of(&theirs[high]) - of(&theirs[low]));
                let impacts = 4.0 * POWER * (scatter / difference).powi(2);
                if impacts < MOST_ADVISED_IMPACTS && best.is_none_or(|b| impacts < b.0) {
                    best = Some((impacts, observable, [low, high]));
                }
            }
        }
    }
    best
}

/// A row with every input at its median.
fn median_row(hypothesis: &Hypothesis<'_>) -> Option<Measurement> {
    let data = hypothesis.data;
    let mut row = *data.rows.first()?;
    for input in &INPUTS {
        let mut values: Vec<f64> =
            data.fit.iter().map(|&row| (input.value)(&data.rows[row].impact)).collect();
        values.sort_by(f64::total_cmp);
        (input.set)(&mut row.impact, values[values.len() / 2]);
    }
    Some(row)
}
