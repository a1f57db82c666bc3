//! A wall or a camera that is tilted against the frame in which speeds are measured.
//!
//! Speeds of arrival `v_n` (towards the wall) and `v_t`, and of the rebound `-e_n v_n` and `e_t v_t`,
//! are rotated by the angle `α` [rad] into the frame of the wall:
//! `v_n' = v_n cos α + v_t sin α`, `v_t' = v_t cos α - v_n sin α`,
//! `e_n' = (e_n v_n cos α - e_t v_t sin α)/v_n'`, `e_t' = (e_t v_t cos α + e_n v_n sin α)/v_t'`.
//! The slope of the two readings is `v_n v_t/(v_n' v_t')`. It needs `v_t`, and `e_t` in every row with
//! `e_n`.

use super::super::data_split::DataSplit;
use super::super::likelihood::Offset;
use super::super::reading::OtherReading;
use super::values;
use crate::dataset::{Measurement, Reading};

/// Largest angle [degrees].
const LARGEST: f64 = 15.0;

pub(super) fn reading(data: &DataSplit) -> Option<OtherReading> {
    data.range("v_t")?;
    let rebounds = || data.search.iter().map(|&row| &data.rows[row]).filter(|row| row.e_n.is_some());
    (rebounds().next().is_some() && rebounds().all(|row| row.e_t.is_some())).then(|| OtherReading {
        id: "artefact:tilt".to_owned(),
        question: Box::new(|angle: f64| {
            format!(
                "These numbers fit if wall and measured frame were tilted by {:.1} degrees: is the camera \
                 aligned with the wall?",
                angle.abs()
            )
        }),
        change: Box::new(rotate),
        values: values(-LARGEST, LARGEST, 21),
        freedom: 1.0,
        model: None,
    })
}

fn rotate(row: &mut Measurement, _: &mut Offset, angle: f64) -> Option<f64> {
    let (sin, cos) = angle.to_radians().sin_cos();
    let [v_n, v_t] = [row.impact.normal_speed, row.impact.tangential_speed];
    let [n, t] = [v_n * cos + v_t * sin, v_t * cos - v_n * sin];
    if n <= 0.0 {
        return None;
    }
    row.impact.normal_speed = n;
    row.impact.tangential_speed = t.abs();
    let (Some(e_n), Some(e_t)) = (row.e_n, row.e_t) else { return Some(0.0) };
    let out = [e_n.value * v_n * cos - e_t.value * v_t * sin, e_t.value * v_t * cos + e_n.value * v_n * sin];
    let slope = [v_n / n, v_t / t];
    let error = |reading: Reading, slope: f64| reading.error.map(|error| error * slope.abs());
    row.e_n = Some(Reading { value: out[0] / n, error: error(e_n, slope[0]) });
    row.e_t = Some(Reading { value: out[1] / t, error: error(e_t, slope[1]) });
    let slope = (slope[0] * slope[1]).abs();
    (slope > 0.0 && slope.is_finite()).then(|| slope.ln())
}
