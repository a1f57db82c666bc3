//! Axes: numbers that can be drawn, round steps, tick labels.

use std::sync::Arc;

use kuva::render::layout::TickFormat;

use super::super::format::number;

/// Larger numbers are not drawn and smaller ones are drawn as zero: steps, ranges and powers of the
/// plotting crate's axes would overflow, and a tick for each power of ten up to infinity would fill
/// the memory.
const MOST_DRAWN: f64 = 1e100;
const LEAST_DRAWN: f64 = 1e-100;

/// The number as it can be drawn.
pub(super) fn drawable(value: f64) -> Option<f64> {
    match value.abs() {
        size if size < LEAST_DRAWN => Some(0.0),
        size => (size <= MOST_DRAWN).then_some(value),
    }
}

/// Numbers that belong together as they can be drawn; `None` where one of them cannot.
pub(super) fn all_drawable<const N: usize>(values: [f64; N]) -> Option<[f64; N]> {
    let drawn = values.map(drawable);
    drawn.iter().all(Option::is_some).then(|| drawn.map(Option::unwrap_or_default))
}

/// The points that can be drawn.
pub(super) fn finite(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().copied().filter_map(all_drawable).collect()
}

/// The ends of an axis; `None` unless they can be drawn and differ.
pub(super) fn ends(low: f64, high: f64) -> Option<[f64; 2]> {
    all_drawable([low, high]).filter(|[low, high]| low < high)
}

/// Short numbers at the ticks, those of the data times a factor.
pub(super) fn tick_format(factor: f64) -> TickFormat {
    // Rounding leaves numbers near 1e-17 where a zero is meant.
    let text = move |value: f64| number(if value.abs() < 1e-14 { 0.0 } else { factor * value });
    TickFormat::Custom(Arc::new(text))
}

/// Round edges of about `count` bins that cover `low` to `high`.
pub fn round_edges(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = round_step((high - low).max(1e-300) / count.max(1) as f64);
    let (from, to) = ((low / step).floor(), (high / step).ceil());
    let bins = ((to - from) as usize).clamp(1, 10_000);
    (0..=bins).map(|i| (from + i as f64) * step).collect()
}

/// The next of 1, 2, 2.5, 5, 10 times a power of ten.
pub(super) fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let digit = step / power;
    [1.0, 2.0, 2.5, 5.0].into_iter().find(|round| digit <= round * (1.0 + 1e-9)).unwrap_or(10.0) * power
}
