//! How well a model's forecast of a measured row fits it: the log score, and the scatter it implies.
//!
//! A rebound's `e_n` and `e_t` scatter normally about the forecast, except that one row in fifty may be anything (a gross
//! error of measurement): the density is `0.98 N(residual; s) + 0.02 · 0.4`, the second term even over 2.5 wide. So a few
//! outliers cannot make or break a cause. A capture scores `ln p`, a rebound `ln (1-p)` besides, with `p` kept 0.005 off 0
//! and 1. Where a model leaves something to chance, the row's probability is the mean over [`Forecast::draws`] draws. An
//! average of `n` impacts scatters with `s/sqrt(n)`, or with its stated standard error and the common scatter `s` together.
//!
//! `s` is estimated from the rows at hand for every forecast anew (expectation–maximisation).

use super::forecast::{Forecast, Prediction};
use crate::dataset::{Measurement, Reading};

/// Share of rows that may be gross errors [1].
const GROSS_SHARE: f64 = 0.02;
/// Density of a gross error [1].
const GROSS_DENSITY: f64 = 0.4;
/// Beyond this many times the scatter the normal density is nothing beside that of a gross error.
const FAR: f64 = 8.0;
/// Rounds of the estimate of the scatter.
const ROUNDS: usize = 6;
/// It is near enough where a round changes it by this share.
const NEAR: f64 = 3e-3;
/// No outcome is ever held to be certain.
const DOUBT: f64 = 0.005;
/// Largest shift of the log odds of capture.
const LARGEST_ODDS: f64 = 10.0;
/// Smallest scatter of a restitution [1].
const SMALLEST_SCATTER: f64 = 1e-3;

/// What is added to a forecast of one row, besides what the model says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Offset {
    /// To `e_n` [1].
    pub e_n: f64,
    /// To `e_t` [1].
    pub e_t: f64,
    /// To the log odds of capture [1].
    pub capture: f64,
    /// Factor on the scatter [1].
    pub spread: f64,
}

impl Default for Offset {
    fn default() -> Self {
        Self { e_n: 0.0, e_t: 0.0, capture: 0.0, spread: 1.0 }
    }
}

/// Scatter of single measurements about the forecast [1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scatter {
    pub e_n: f64,
    pub e_t: f64,
}

/// The probability of capture after a shift, kept off 0 and 1: no curve may win by claiming to be certain.
pub(super) fn capture(said: &Prediction, shift: &Offset) -> f64 {
    let doubted = |share: f64| DOUBT + (1.0 - 2.0 * DOUBT) * share;
    let plain = doubted(said.capture);
    if shift.capture == 0.0 {
        return plain;
    }
    let odds = plain / (1.0 - plain) * shift.capture.clamp(-LARGEST_ODDS, LARGEST_ODDS).exp();
    doubted(odds / (1.0 + odds))
}

/// Mean `e_n`, `e_t` of the rebounds, their variances over chance, and the mean probability of capture.
pub(super) struct Mean {
    pub e_n: f64,
    pub e_t: f64,
    pub variance_e_n: f64,
    pub variance_e_t: f64,
    pub capture: f64,
}

/// The forecast's mean over chance.
pub(super) fn mean(said: &[Prediction], shift: &Offset) -> Mean {
    let (mut weight, mut held, mut all) = (0.0, 0.0, 0.0);
    let (mut n, mut nn, mut t, mut tt) = (0.0, 0.0, 0.0, 0.0);
    for one in said {
        let p = capture(one, shift);
        let rebounds = (1.0 - p) * one.weight;
        held += p * one.weight;
        all += one.weight;
        weight += rebounds;
        n += rebounds * one.e_n;
        nn += rebounds * one.e_n * one.e_n;
        t += rebounds * one.e_t;
        tt += rebounds * one.e_t * one.e_t;
    }
    let (e_n, e_t) = (n / weight, t / weight);
    Mean {
        e_n: e_n + shift.e_n,
        e_t: e_t + shift.e_t,
        variance_e_n: (nn / weight - e_n * e_n).max(0.0),
        variance_e_t: (tt / weight - e_t * e_t).max(0.0),
        capture: held / all,
    }
}

/// One quantity's scatter in one row [1].
fn row_scatter(scatter: f64, spread: f64, reading: &Reading, rebounds: f64, chance: f64) -> f64 {
    let own = match reading.error {
        Some(error) => (scatter * spread).powi(2) + error * error + chance / rebounds.max(1.0),
        None => ((scatter * spread).powi(2) + chance) / rebounds.max(1.0),
    };
    own.sqrt().max(SMALLEST_SCATTER)
}

fn normal_density(residual: f64, scatter: f64) -> f64 {
    let z = residual / scatter;
    if z.abs() > FAR {
        return 0.0;
    }
    (-0.5 * z * z).exp() / (scatter * (2.0 * std::f64::consts::PI).sqrt())
}

/// Density of a residual, and the part of it that is ordinary scatter.
fn densities(residual: f64, scatter: f64) -> (f64, f64) {
    let normal = (1.0 - GROSS_SHARE) * normal_density(residual, scatter);
    (normal + GROSS_SHARE * GROSS_DENSITY, normal)
}

/// Whether a residual is ordinary scatter rather than a gross error, 0 to 1.
pub(super) fn ordinary(residual: f64, scatter: f64) -> f64 {
    let (density, normal) = densities(residual, scatter);
    normal / density
}

/// Log score of one row.
pub(super) fn score(row: &Measurement, said: &[Prediction], shift: &Offset, scatter: Scatter) -> f64 {
    if row.impacts > 1.0 {
        score_average(row, said, shift, scatter)
    } else {
        score_single(row, said, shift, scatter)
    }
}

fn score_single(row: &Measurement, said: &[Prediction], shift: &Offset, scatter: Scatter) -> f64 {
    let (mut sum, mut rebounds, mut all) = (0.0, 0.0, 0.0);
    for one in said {
        let p = capture(one, shift);
        all += one.weight;
        if row.captured.is_some_and(|share| share > 0.5) {
            sum += p * one.weight;
            continue;
        }
        sum += (1.0 - p) * one.weight * rebound_density(row, one, shift, scatter);
        rebounds += (1.0 - p) * one.weight;
    }
    // Where captures are not recorded, the row speaks of rebounds alone.
    if row.captured.is_some() { (sum / all).ln() } else { (sum / rebounds).ln() }
}

/// Density of the restitutions of a single rebound under one draw.
fn rebound_density(row: &Measurement, one: &Prediction, shift: &Offset, scatter: Scatter) -> f64 {
    let of = |reading: &Option<Reading>, said: f64, scatter: f64, reach: f64| {
        reading.as_ref().map_or(1.0, |reading| {
            let scatter = row_scatter(scatter, shift.spread, reading, 1.0, reach * reach);
            densities(reading.value - said, scatter).0
        })
    };
    of(&row.e_n, one.e_n + shift.e_n, scatter.e_n, one.reach[0])
        * of(&row.e_t, one.e_t + shift.e_t, scatter.e_t, one.reach[1])
}

fn score_average(row: &Measurement, said: &[Prediction], shift: &Offset, scatter: Scatter) -> f64 {
    let mean = mean(said, shift);
    let of = |reading: &Option<Reading>, said: f64, scatter: f64, chance: f64| {
        reading.as_ref().map_or(0.0, |reading| {
            let scatter = row_scatter(scatter, shift.spread, reading, row.rebounds, chance);
            densities(reading.value - said, scatter).0.ln()
        })
    };
    let captured = row.captured.map_or(0.0, |share| {
        row.impacts * (share * mean.capture.ln() + (1.0 - share) * (1.0 - mean.capture).ln())
    });
    captured
        + of(&row.e_n, mean.e_n, scatter.e_n, mean.variance_e_n)
        + of(&row.e_t, mean.e_t, scatter.e_t, mean.variance_e_t)
}

/// The scatter that makes the rows most likely, from a first guess; `rows` are indices.
pub(super) fn fit_scatter(
    all: &[Measurement],
    rows: &[usize],
    forecast: &Forecast,
    shifts: &[Offset],
    first: Scatter,
) -> Scatter {
    let mut scatter = first;
    for _ in 0..ROUNDS {
        let mut sums = [[0.0; 2]; 2];
        for (place, &index) in rows.iter().enumerate() {
            add_row(&mut sums, &all[index], forecast.of(place), &shifts[index], scatter);
        }
        let root = |[sum, weight]: [f64; 2], before: f64| {
            if weight > 0.0 { (sum / weight).max(SMALLEST_SCATTER.powi(2)).sqrt() } else { before }
        };
        let next = Scatter { e_n: root(sums[0], scatter.e_n), e_t: root(sums[1], scatter.e_t) };
        let done = (next.e_n - scatter.e_n).abs() < NEAR * next.e_n
            && (next.e_t - scatter.e_t).abs() < NEAR * next.e_t;
        scatter = next;
        if done {
            break;
        }
    }
    scatter
}

/// Adds a row's squared residuals and weights, of `e_n` and `e_t`.
fn add_row(
    sums: &mut [[f64; 2]; 2],
    row: &Measurement,
    said: &[Prediction],
    shift: &Offset,
    scatter: Scatter,
) {
    if row.captured.is_some_and(|share| share >= 1.0) {
        return;
    }
    let single = row.impacts <= 1.0;
    let average;
    let (said, chance) = if single || said.len() == 1 {
        (said, [0.0; 2])
    } else {
        let mean = mean(said, shift);
        average = [Prediction {
            e_n: mean.e_n - shift.e_n,
            e_t: mean.e_t - shift.e_t,
            capture: mean.capture,
            weight: 1.0,
            reach: [0.0; 2],
        }];
        (&average[..], [mean.variance_e_n, mean.variance_e_t])
    };
    // Each draw counts by how likely it makes the row; the sum of these weights is not known before the last draw.
    let (mut own, mut whole) = ([[0.0; 2]; 2], 0.0);
    for one in said {
        let readings =
            [(&row.e_n, one.e_n + shift.e_n, scatter.e_n), (&row.e_t, one.e_t + shift.e_t, scatter.e_t)];
        let mut likely = (1.0 - capture(one, shift)) * one.weight;
        let mut terms = [[0.0; 2]; 2];
        for (quantity, (reading, said, scatter)) in readings.into_iter().enumerate() {
            let Some(reading) = reading else { continue };
            let residual = reading.value - said;
            let chance = chance[quantity] + one.reach[quantity].powi(2);
            let width = row_scatter(scatter, shift.spread, reading, row.rebounds, chance);
            let (density, normal) = densities(residual, width);
            let (foreign, count) = match reading.error {
                Some(error) => (error * error, 1.0),
                None => (chance / row.rebounds.max(1.0), row.rebounds.max(1.0)),
            };
            let squared = (residual * residual - foreign).max(0.0) * count / (shift.spread * shift.spread);
            likely *= density;
            terms[quantity] = [squared * normal / density, normal / density];
        }
        for (sum, term) in own.iter_mut().flatten().zip(terms.as_flattened()) {
            *sum += likely * term;
        }
        whole += likely;
    }
    if whole > 0.0 {
        for (sum, own) in sums.iter_mut().flatten().zip(own.as_flattened()) {
            *sum += own / whole;
        }
    }
}
