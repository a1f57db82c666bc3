//! Carbon conversion of what is captured and of what arrives.

use super::RunComparison;
use crate::report::{Chart, Figure};
use crate::results::{ByConversion, CONVERSION_BINS, share};

/// Captured mass by conversion at capture.
pub(super) fn captured(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let single = comparison.is_single();
    let quantity = if single { "captured mass [% of injected]" } else { "share of the captured mass [%]" };
    let chart = chart("Carbon conversion at capture", quantity);
    let caption = ["conversion", "1 is without carbon. Each tenth of the conversion is one class."];
    comparison.histogram(caption, chart, &edges(), |series| {
        let masses = series.run.captured_by_conversion(&series.walls, comparison.time)?;
        let whole = if single { comparison.injected(series.run) } else { masses.iter().sum() };
        Some(masses.map(|mass| 100.0 * share(mass, whole)).to_vec())
    })
}

/// Mass of recorded arrivals by conversion.
pub(super) fn arriving(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let chart = chart("Carbon conversion of arrivals", "share of the arriving mass [%]");
    let caption =
        ["arriving", "All recorded arrivals at walls; a parcel that rebounds may arrive many times."];
    comparison.histogram(caption, chart, &edges(), |series| {
        let mut masses = ByConversion::default();
        for arrivals in series.walls.iter().filter_map(|wall| series.run.recorded(wall)) {
            masses.iter_mut().zip(arrivals.conversions).for_each(|(sum, mass)| *sum += mass);
        }
        let all = masses.iter().sum();
        Some(masses.map(|mass| 100.0 * share(mass, all)).to_vec())
    })
}

fn chart(title: &str, y_label: &str) -> Chart {
    Chart::new(title, "carbon conversion [1]", y_label).x_range(0.0, 1.0)
}

fn edges() -> Vec<f64> {
    (0..=CONVERSION_BINS).map(|i| i as f64 / CONVERSION_BINS as f64).collect()
}
