//! Measured values of readings with the values of both models, as points, lines and sentences.

use super::super::chart::{Chart, ErrorBars};
use super::super::diagnosis::plot::{FEW_DRAWN, Window, share_axis};
use super::setting::Placed;
use crate::dataset::RigQuantity;
use crate::diagnose::rig::RigRow;

/// A reading farther from a model than this many of its errors is off.
const OFF: f64 = 2.0;

/// The name of a model and its value for a reading.
pub(super) type ModelValue = (&'static str, fn(&RigRow) -> Option<f64>);

/// Both models; the base model only where nothing was added.
pub(super) fn models(extended: bool) -> Vec<ModelValue> {
    let all: [ModelValue; 2] = [("base model", |row| row.base), ("extended model", |row| row.extended)];
    all[..if extended { 2 } else { 1 }].to_vec()
}

/// The largest value of a share [1].
const WHOLE_SHARE: f64 = 1.0;
/// Shares beyond this have an axis from 0 to 1.
const LARGE_SHARE: f64 = 0.8;

fn is_share(row: &RigRow) -> bool {
    row.observable.split('@').next().and_then(RigQuantity::parse).is_some_and(|quantity| quantity.is_share())
}

/// Length of the error bar of a reading; it ends at zero, and that of a share at one.
pub(super) fn bar(row: &RigRow) -> (f64, f64) {
    let most = if is_share(row) { (WHOLE_SHARE - row.measured).max(0.0) } else { f64::INFINITY };
    (row.error.min(row.measured), row.error.min(most))
}

/// The chart with the readings and the models; lines where `lines`.
pub(super) fn draw(chart: Chart, placed: &Placed<'_>, models: &[ModelValue], lines: bool) -> Option<Chart> {
    let axis = placed.axis()?;
    let places = placed.sample.rows.iter().map(|row| axis.at(row));
    let mut all: Vec<(f64, &RigRow)> =
        places.zip(&placed.rows).filter_map(|(x, row)| Some((x?, *row))).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let measured: Vec<[f64; 2]> = all.iter().map(|(x, row)| [*x, row.measured]).collect();
    // Many bars would hide the readings.
    let bars: ErrorBars =
        all.iter().map(|(_, row)| if all.len() <= FEW_DRAWN { bar(row) } else { (0.0, 0.0) }).collect();
    let ends = measured.iter().zip(&bars).flat_map(|(at, bar)| [at[1] - bar.0, at[1] + bar.1]);
    let of = |value: fn(&RigRow) -> Option<f64>| {
        all.iter().filter_map(|(x, row)| Some([*x, value(row)?])).collect::<Vec<[f64; 2]>>()
    };
    let predicted: Vec<(&str, Vec<[f64; 2]>)> =
        models.iter().map(|(name, value)| (*name, of(*value))).collect();
    let reach: Vec<f64> =
        ends.chain(predicted.iter().flat_map(|(_, points)| points).map(|at| at[1])).collect();
    let shares = all.iter().all(|(_, row)| is_share(row)) && reach.iter().any(|y| *y > LARGE_SHARE);
    let chart =
        if shares { share_axis(chart) } else { Window::new(&[], reach.into_iter()).draw(chart, "", &[]).0 };
    let add = |chart: Chart, (name, points): &(&str, Vec<[f64; 2]>)| match (points.is_empty(), lines) {
        (true, _) => chart,
        (false, true) => chart.line(name, points),
        (false, false) => chart.points(name, points),
    };
    Some(predicted.iter().fold(chart, add).measured("measured", &measured, &bars))
}

/// What the error bars are.
pub(super) fn bars(rows: &[&RigRow]) -> &'static str {
    if rows.len() <= FEW_DRAWN { " Bars are standard errors." } else { "" }
}

/// How many readings each model misses.
pub(super) fn missed(rows: &[&RigRow], models: &[ModelValue]) -> String {
    let of = |(name, value): &ModelValue| {
        let known: Vec<f64> =
            rows.iter().filter_map(|row| Some((row.measured - value(row)?).abs() / row.error)).collect();
        let off = known.iter().filter(|off| **off > OFF).count();
        let nothing = rows.len() - known.len();
        let nothing = if nothing > 0 { format!(" (and has no value for {nothing})") } else { String::new() };
        format!("the {name} {off} of {}{nothing}", known.len())
    };
    let all: Vec<String> = models.iter().map(of).collect();
    format!(" More than 2 standard errors off: {}; by chance 1 in 20.", all.join(", "))
}

/// Sum of squares of measured minus base model, in standard errors.
pub(super) fn misfit(rows: &[&RigRow]) -> f64 {
    rows.iter().filter_map(|row| Some(((row.measured - row.base?) / row.error).powi(2))).sum()
}
