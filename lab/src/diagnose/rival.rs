//! Explanations other than physics: mistakes in the input, and artefacts of measurement.
//!
//! A slip is the base model with another reading of the numbers, for instance with the diameter
//! doubled; it has no free parameter. An artefact is another distribution of the readings about the
//! base model: truncated where the instrument sees nothing, or skewed. Each is scored by its gain
//! in log likelihood beside that of the extended model.

use super::artefact;
use super::data_split::DataSplit;
use super::hypothesis::Hypothesis;
use super::observable::Observable;
use super::record::Rival;
use super::slip::{Slip, slips};
use crate::dataset::{Measurement, Reading};
use nearwall::model::Model;

/// A rival that gains this much less than the extended model is not listed [nats].
const BEHIND: f64 = 3.0;
/// Least gain of a rival [nats].
const LEAST_RIVAL_GAIN: f64 = 6.0;
/// Least lead over the extended model at which a rival takes the place of the causes, and a slip
/// that of one cause [nats]: without parameters it is a little ahead of a cause that it imitates.
const DECISIVE: f64 = 0.0;
const DECISIVE_SLIP: f64 = 3.0;

/// The rivals that explain the misfit of `base` about as well as `extended` does, the best first;
/// `text` is the base model's file. Both hypotheses are on the rows of the search.
pub(super) fn rivals(base: &Hypothesis<'_>, extended: &Hypothesis<'_>, text: &str) -> Vec<Rival> {
    let before = base.search_score();
    let after = extended.without_discrepancy().search_score();
    let explained = (after - before - extended.freedom()).max(0.0);
    let observable = main_observable(base.data);
    let mut all: Vec<Rival> = Vec::new();
    let mut add = |id: String, gain: f64, explanation: String| {
        let lead = gain - explained;
        if gain >= LEAST_RIVAL_GAIN && lead >= -BEHIND {
            all.push(Rival { id, observable, gain, lead, explanation });
        }
    };
    for slip in slips(&base.data.base, text) {
        if let Some(gain) = slip_gain(base.data, &slip, before) {
            add(format!("slip:{}", slip.id), gain, slip.explanation);
        }
    }
    for (id, gain, explanation) in artefact::artefacts(base) {
        add(format!("artefact:{id}"), gain, explanation);
    }
    all.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    all
}

/// Whether a rival explains more than these causes: a slip much more than one cause, or as much as several.
pub(super) fn decisive(rivals: &[Rival], causes: usize) -> Option<&Rival> {
    let is_slip = |rival: &Rival| rival.id.starts_with("slip:") && causes < 2;
    let least = |rival: &Rival| if is_slip(rival) { DECISIVE_SLIP } else { DECISIVE };
    rivals.iter().find(|rival| rival.lead > least(rival))
}

/// The observable with most measurements.
fn main_observable(data: &DataSplit) -> &'static str {
    let count =
        |o: &Observable| data.search.iter().filter(|&&row| o.measured(&data.rows[row]).is_some()).count();
    let best = Observable::ALL.into_iter().rev().max_by_key(count);
    best.map_or("e_n", Observable::name)
}

/// Gain of a slip on the rows of the search [nats]; `None` where it changes nothing, or the model
/// cannot decide its rows.
fn slip_gain(data: &DataSplit, slip: &Slip, before: f64) -> Option<f64> {
    let model: Model = slip.model.clone().unwrap_or_else(|| data.base.clone());
    let mut rows: Vec<Measurement> = data.rows.to_vec();
    let mut jacobian = 0.0;
    for &place in &data.search {
        let row = &mut rows[place];
        (slip.change)(row);
        if slip.energy {
            for reading in [&mut row.e_n, &mut row.e_t].into_iter().flatten() {
                jacobian += root(reading)?;
            }
        }
        model.check(row.wall, &row.impact).ok()?;
    }
    let changed = DataSplit { base: model, rows: rows.into(), ..data.clone() };
    let gain = Hypothesis::base(&changed).search_score() + jacobian - before;
    gain.is_finite().then_some(gain)
}

/// Takes the square root of a reading; returns the logarithm of the slope. `None` for a reading that is no square.
fn root(reading: &mut Reading) -> Option<f64> {
    if reading.value <= 0.0 {
        return None;
    }
    let value = reading.value.sqrt();
    *reading = Reading { value, error: reading.error.map(|error| error / (2.0 * value)) };
    Some(-(2.0 * value).ln())
}
