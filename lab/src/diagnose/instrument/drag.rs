//! Drag between the window of the instrument and the wall.
//!
//! In gas at rest a small particle loses `Δ = x 18 μ/(ρ d²) = c/d²` of its speed over the distance `x`
//! between window and wall (Stokes): it arrives with `v_n - Δ`, and its rebound, seen as `e_n v_n`, left
//! the wall with `e_n v_n + Δ`; tangential speeds change by the same factors. The parameter is
//! `c` [m³/s], tried from a thousandth to a half of the least `v_n d²`. The slope of `e_n` is
//! `v_n/(v_n - Δ)`.

use super::super::data_split::DataSplit;
use super::super::likelihood::Offset;
use super::super::reading::OtherReading;
use crate::dataset::{Measurement, Reading};

/// Values tried.
const VALUES: usize = 16;

pub(super) fn reading(data: &DataSplit) -> Option<OtherReading> {
    data.range("d")?;
    let product = |&row: &usize| {
        let impact = &data.rows[row].impact;
        impact.normal_speed * impact.diameter * impact.diameter
    };
    let least = data.search.iter().map(product).fold(f64::INFINITY, f64::min);
    (least > 0.0 && least.is_finite()).then(|| OtherReading {
        id: "artefact:drag".to_owned(),
        question: Box::new(|constant: f64| {
            format!(
                "These numbers fit if particles were slowed down by the gas between the window and the \
                 wall (by {constant:.1e} m³/s over d²): how far from the wall are speeds measured?"
            )
        }),
        change: Box::new(slow_down),
        values: (0..VALUES)
            .map(|place| 0.5 * least * 500_f64.powf(place as f64 / (VALUES - 1) as f64 - 1.0))
            .collect(),
        freedom: 1.0,
        model: None,
    })
}

fn slow_down(row: &mut Measurement, _: &mut Offset, constant: f64) -> Option<f64> {
    let before = row.impact.normal_speed;
    let lost = constant / row.impact.diameter.powi(2);
    let arrives = (before - lost) / before;
    if arrives <= 0.0 {
        return None;
    }
    row.impact.normal_speed *= arrives;
    row.impact.tangential_speed *= arrives;
    let Some(e_n) = row.e_n else { return Some(0.0) };
    if e_n.value <= 0.0 {
        return None;
    }
    let leaves = 1.0 + lost / (e_n.value * before);
    let scaled = |one: Reading, slope: f64| Reading {
        value: one.value * leaves / arrives,
        error: one.error.map(|error| error * slope),
    };
    row.e_n = Some(scaled(e_n, 1.0 / arrives));
    let slope = if row.e_t.is_some() { leaves / arrives.powi(2) } else { 1.0 / arrives };
    row.e_t = row.e_t.map(|e_t| scaled(e_t, leaves / arrives));
    Some(slope.ln())
}
