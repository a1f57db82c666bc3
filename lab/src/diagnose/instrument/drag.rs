//! Drag between the window of the instrument and the wall.
//!
//! In gas at rest a small particle loses `Δ = x 18 μ/(ρ d²) = c/d²` of its speed over the distance `x`
//! between window and wall (Stokes): it arrives with `v_n - Δ`, and its rebound, seen as `e_n v_n`, left
//! the wall with `e_n v_n + Δ`. The parameter is `c` [m³/s], tried from a thousandth to a half of
//! the least `v_n d²`. The slope of the reading is `v_n/(v_n - Δ)`.

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
    let after = before - lost;
    if after <= 0.0 {
        return None;
    }
    row.impact.normal_speed = after;
    let Some(e_n) = row.e_n else { return Some(0.0) };
    let slope = before / after;
    let value = (e_n.value * before + lost) / after;
    row.e_n = Some(Reading { value, error: e_n.error.map(|error| error * slope), ..e_n });
    Some(slope.ln())
}
