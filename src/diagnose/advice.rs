//! Which measurement would tell two causes apart.
//!
//! One input after the other is moved over its range and a quarter of it beyond, all others at their medians. Where the
//! two fitted models' forecasts part most, relative to the scatter, is where to measure: the number of impacts is that of
//! a comparison of two groups, one at each end, with 5 % false alarms and 80 % power,
//! `n = 2 · 2 (1.96 + 0.84)² (scatter / difference)²`.

use super::data_split::DataSplit;
use super::forecast::Forecast;
use super::hypothesis::{Hypothesis, Observable};
use super::likelihood::{Offset, Scatter, mean};
use super::record::Measure;
use crate::dataset::Measurement;
use crate::impact::INPUTS;

/// Places along an input.
const STEPS: usize = 9;
/// (1.96 + 0.84)².
const POWER: f64 = 7.85;
/// More impacts than this are no advice.
const TOO_MANY: f64 = 1e5;

/// The measurement that parts the two best; `None` where no single input does.
pub(super) fn advise(
    study: &DataSplit,
    found: &Hypothesis,
    other: &Hypothesis,
    name: &str,
    scatter: Scatter,
) -> Option<Measure> {
    let middle = median_row(study)?;
    let candidates = INPUTS.iter().filter_map(|input| {
        let [low, high] = study.range(input.name)?;
        let beyond = 0.25 * (high - low);
        let ends = [
            if low > 0.0 { (low - beyond).max(0.5 * low) } else { low },
            if input.unit == "1" { high } else { high + beyond },
        ];
        let rows: Vec<Measurement> = (0..STEPS)
            .map(|step| {
                let mut row = middle;
                let share = step as f64 / (STEPS - 1) as f64;
                (input.set)(&mut row.impact, ends[0] + share * (ends[1] - ends[0]));
                row
            })
            .collect();
        let (impacts, observable, [low, high]) = best_contrast(study, &rows, found, other, scatter)?;
        let at = |step: usize| (input.value)(&rows[step].impact);
        let range = [at(low), at(high)];
        Some(Measure {
            against: name.to_owned(),
            vary: input.name.to_owned(),
            range,
            unit: input.unit,
            observable: observable.name(),
            impacts: (impacts.ceil() as u64).max(10),
        })
    });
    candidates.min_by_key(|measure| measure.impacts)
}

/// Fewest impacts, the observable to watch and the two places to measure at.
fn best_contrast(
    study: &DataSplit,
    rows: &[Measurement],
    found: &Hypothesis,
    other: &Hypothesis,
    scatter: Scatter,
) -> Option<(f64, Observable, [usize; 2])> {
    let places: Vec<usize> = (0..rows.len()).collect();
    let says = |hypothesis: &Hypothesis| {
        let forecast = Forecast::new(&hypothesis.model(study), rows, &places, study.draws);
        let one = |&place: &usize| mean(forecast.of(place), &Offset::default());
        places.iter().map(one).collect::<Vec<_>>()
    };
    let (ours, theirs) = (says(found), says(other));
    let mut best: Option<(f64, Observable, [usize; 2])> = None;
    for low in 0..rows.len() {
        for high in low + 1..rows.len() {
            let change = |of: fn(&super::likelihood::Mean) -> f64| {
                (of(&ours[high]) - of(&ours[low])) - (of(&theirs[high]) - of(&theirs[low]))
            };
            let contrasts = [
                (Observable::NormalRestitution, change(|m| m.e_n), scatter.e_n),
                (Observable::TangentialRestitution, change(|m| m.e_t), scatter.e_t),
                (Observable::Capture, change(|m| m.capture), 0.5),
            ];
            for (observable, difference, scatter) in contrasts {
                let impacts = 4.0 * POWER * (scatter / difference).powi(2);
                if impacts < TOO_MANY && best.is_none_or(|b| impacts < b.0) {
                    best = Some((impacts, observable, [low, high]));
                }
            }
        }
    }
    best
}

/// A row with every input at its median.
fn median_row(study: &DataSplit) -> Option<Measurement> {
    let mut row = *study.rows.first()?;
    for input in &INPUTS {
        let mut values: Vec<f64> =
            study.fit.iter().map(|&row| (input.value)(&study.rows[row].impact)).collect();
        values.sort_by(f64::total_cmp);
        (input.set)(&mut row.impact, values[values.len() / 2]);
    }
    Some(row)
}
