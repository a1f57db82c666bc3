//! Slow rebounds that the instrument does not see, below a ratio `e_n` or below a speed `e_n v_n`, or that
//! are noted as stuck.
//!
//! The limit is just below the least one that was seen, which is its most likely value. A limit that
//! the user states is in the noise of the rows already.

use super::super::data_split::DataSplit;
use super::super::reading::OtherReading;
use crate::dataset::Measurement;

/// The limit as a share of the least reading.
const BELOW: f64 = 0.9999;

pub(super) fn by_ratio(data: &DataSplit) -> Option<OtherReading> {
    let limit = least(data, |_| 1.0)?;
    let question = |limit: f64| {
        format!(
            "These numbers fit if rebounds with e_n below {limit:.3} were not seen: what is the slowest rebound that \
             the instrument detects? State it as [detection] in the column map."
        )
    };
    Some(limited("artefact:truncation", limit, Box::new(question), |_| 1.0, false))
}

pub(super) fn by_speed(data: &DataSplit) -> Option<OtherReading> {
    data.range("v_n")?;
    let limit = least(data, |row| row.impact.normal_speed)?;
    let question = |limit: f64| {
        format!(
            "These numbers fit if rebounds slower than {limit:.3} m/s were not seen: what is the slowest rebound that \
             the instrument detects? State it as [detection] in the column map."
        )
    };
    Some(limited("artefact:truncation", limit, Box::new(question), |row| row.impact.normal_speed, false))
}

pub(super) fn noted_as_stuck(data: &DataSplit) -> Option<OtherReading> {
    data.search.iter().find(|&&row| data.rows[row].captured.is_some_and(|share| share > 0.5))?;
    let limit = least(data, |row| row.impact.normal_speed)?;
    let question = |limit: f64| {
        format!(
            "These numbers fit if rebounds slower than {limit:.3} m/s were noted as stuck: how is sticking told?"
        )
    };
    Some(limited("artefact:noted-as-stuck", limit, Box::new(question), |row| row.impact.normal_speed, true))
}

/// Just below the least reading of `e_n` times `factor`; `None` where a limit is stated, or where smaller values are
/// noted as such.
fn least(data: &DataSplit, factor: fn(&Measurement) -> f64) -> Option<f64> {
    let rows = data.search.iter().map(|&row| &data.rows[row]);
    let noted = rows.clone().any(|row| row.limits[0].is_some_and(|limit| limit.below));
    if noted || data.noise.iter().any(|offset| offset.visible_from > 0.0) {
        return None;
    }
    let limits = rows.filter_map(|row| Some(row.e_n?.value * factor(row)));
    let least = limits.fold(f64::INFINITY, f64::min);
    (least > 0.0 && least.is_finite()).then_some(BELOW * least)
}

fn limited(
    id: &str,
    limit: f64,
    question: Box<dyn Fn(f64) -> String + Send + Sync>,
    factor: fn(&Measurement) -> f64,
    noted: bool,
) -> OtherReading {
    OtherReading {
        id: id.to_owned(),
        question,
        change: Box::new(move |row, offset, limit| {
            offset.visible_from = limit / factor(row);
            offset.noted = noted;
            Some(0.0)
        }),
        values: vec![limit],
        // The end of a range is known to 1/n rather than 1/sqrt(n), which costs twice as much.
        freedom: 2.0,
        model: None,
    }
}
