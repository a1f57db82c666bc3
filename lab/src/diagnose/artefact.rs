//! Artefacts of measurement: an instrument that does not see slow rebounds, and scatter to one side.

use super::hypothesis::Hypothesis;
use super::likelihood::{GROSS_DENSITY, GROSS_SHARE, Offset, SMALLEST_SCATTER};
use super::observable::Observable;

/// Steps of each width of a skewed distribution, and the factor between them.
const WIDTHS: i32 = 20;
const WIDTH_STEP: f64 = 1.3;
/// Narrowest side of a skewed distribution, as a share of the scatter.
const NARROWEST: f64 = 0.03;
/// Least number of readings for a distribution.
const READINGS: usize = 30;
/// Gain that pays for one parameter [nats].
const PARAMETER: f64 = 1.0;

/// Id, gain [nats] and explanation of each artefact of `e_n`.
pub(super) fn artefacts(base: &Hypothesis<'_>) -> Vec<(&'static str, f64, String)> {
    truncation(base).into_iter().chain(skewness(base)).collect()
}

/// Readings of `e_n` in the search: value, prediction.
fn readings(base: &Hypothesis<'_>) -> Vec<[f64; 2]> {
    let rows = base.evaluate(&*base.data.search, base.offsets());
    rows.pairs(Observable::NormalRestitution).flatten().collect()
}

/// Rebounds below the smallest reading are not seen.
fn truncation(base: &Hypothesis<'_>) -> Option<(&'static str, f64, String)> {
    let stated = base.data.noise.iter().any(|offset| offset.visible_from > 0.0);
    let readings = readings(base);
    let least = readings.iter().map(|pair| pair[0]).fold(f64::INFINITY, f64::min);
    if stated || readings.len() < READINGS || least <= 0.0 || !least.is_finite() {
        return None;
    }
    let evaluate = |limit: f64| {
        let visible = |offset: Offset| Offset { visible_from: limit, ..offset };
        let offsets: Vec<Offset> = base.offsets().into_iter().map(visible).collect();
        base.evaluate(&*base.data.search, offsets).with_fitted_scatter().score()
    };
    let gain = evaluate(0.9999 * least) - evaluate(f64::NEG_INFINITY) - PARAMETER;
    let text = format!(
        "These numbers fit if rebounds with e_n below {least:.3} were not seen: what is the slowest rebound that the \
         instrument detects? State it as [detection] in the column map."
    );
    Some(("truncation", gain, text))
}

/// The scatter is wider below the prediction than above it, and no shift of the level describes the readings as well.
fn skewness(base: &Hypothesis<'_>) -> Option<(&'static str, f64, String)> {
    let rows = base.evaluate(&*base.data.search, base.offsets()).with_fitted_scatter();
    let of = |observable| {
        let residual = |[measured, predicted]: [f64; 2]| measured - predicted;
        let residuals: Vec<f64> = rows.pairs(observable).flatten().map(residual).collect();
        let enough = residuals.len() >= READINGS;
        if enough { skewness_of(residuals, rows.scatter[observable as usize]) } else { 0.0 }
    };
    let gain = of(Observable::NormalRestitution) + of(Observable::TangentialRestitution);
    let text = "These numbers fit if the scatter were one-sided, downwards only: does the model give the upper bound of the \
                rebounds, or do some impacts lose energy in another way?";
    (gain > 0.0).then(|| ("skewed-scatter", gain, text.to_owned()))
}

/// A width of one side [1]: the narrowest is step 0.
fn width(scatter: f64, step: i32) -> f64 {
    scatter.max(SMALLEST_SCATTER) * NARROWEST * WIDTH_STEP.powi(step)
}

/// Largest log likelihood of residuals with widths of these steps below and above [nats].
fn best(residuals: &[f64], scatter: f64, steps: impl Iterator<Item = [i32; 2]>) -> f64 {
    steps
        .map(|sides| likelihood(residuals, sides.map(|step| width(scatter, step))))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// The same with one width on both sides.
fn best_even(residuals: &[f64], scatter: f64) -> f64 {
    best(residuals, scatter, (0..WIDTHS).map(|step| [step; 2]))
}

/// Gain of two widths over one [nats]; 0 where the wider side is above, or where a shifted distribution is as good.
fn skewness_of(mut residuals: Vec<f64>, scatter: f64) -> f64 {
    let wider_below = (0..WIDTHS).flat_map(|one| (0..one).map(move |two| [one, two]));
    let skewed = best(&residuals, scatter, wider_below);
    let plain = best_even(&residuals, scatter);
    residuals.sort_by(f64::total_cmp);
    let median = residuals[residuals.len() / 2];
    let shifted: Vec<f64> = residuals.iter().map(|residual| residual - median).collect();
    let beats_shift = skewed > best_even(&shifted, scatter) + PARAMETER;
    if beats_shift { (skewed - plain - PARAMETER).max(0.0) } else { 0.0 }
}

/// Gain of a scatter with two widths, the wider one on either side, over one width [nats]: what a
/// stochastic effect must exceed.
pub(super) fn lopsided_gain(residuals: &[f64], scatter: f64) -> f64 {
    if residuals.len() < READINGS {
        return 0.0;
    }
    let all = (0..WIDTHS).flat_map(|one| (0..WIDTHS).map(move |two| [one, two]));
    (best(residuals, scatter, all) - best_even(residuals, scatter)).max(0.0)
}

/// Log likelihood of residuals about 0 with one width below and another above [nats].
fn likelihood(residuals: &[f64], [below, above]: [f64; 2]) -> f64 {
    let height = 2.0 / ((below + above) * std::f64::consts::TAU.sqrt());
    let one = |residual: &f64| {
        let z = residual / if *residual < 0.0 { below } else { above };
        ((1.0 - GROSS_SHARE) * height * (-0.5 * z * z).exp() + GROSS_SHARE * GROSS_DENSITY).ln()
    };
    residuals.iter().map(one).sum()
}
