//! Other readings of the rows: what an instrument or a geometry does to the numbers, each with at most one parameter.

use super::data_split::DataSplit;
use super::instrument;
use super::likelihood::Offset;
use crate::dataset::Measurement;
use nearwall::model::Model;

/// Changes a row and what is known of its noise for a value of the parameter. Returns the logarithm
/// of the slope of its readings [nats]; `None` where there is no such reading.
pub(super) type Change = Box<dyn Fn(&mut Measurement, &mut Offset, f64) -> Option<f64> + Send + Sync>;

/// Another reading of the rows.
pub(super) struct OtherReading {
    /// `slip:...` for a mistake in the numbers, `artefact:...` for an instrument or a geometry.
    pub id: String,
    /// The question to the user, for a value of the parameter.
    pub question: Box<dyn Fn(f64) -> String + Send + Sync>,
    pub change: Change,
    /// Values of the parameter that are tried first, ascending; one value where there is none to fit.
    pub values: Vec<f64>,
    /// Number of fitted parameters.
    pub freedom: f64,
    /// The model with other numbers, if these are in the model file.
    pub model: Option<Model>,
}

impl OtherReading {
    /// The value with the largest score among those that are tried first, and the score.
    pub fn best_value(&self, score: impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
        largest(&self.values, score)
    }

    /// That value, or one near it with a larger score.
    pub fn finer(&self, best: (f64, f64), score: impl Fn(f64) -> Option<f64>) -> (f64, f64) {
        largest(&self.near(best.0), score).filter(|finer| finer.1 > best.1).unwrap_or(best)
    }

    /// Values between the neighbours of a value.
    fn near(&self, value: f64) -> Vec<f64> {
        let Some(place) = self.values.iter().position(|one| *one == value) else { return Vec::new() };
        let before = self.values[place.saturating_sub(1)];
        let after = self.values[(place + 1).min(self.values.len() - 1)];
        let between = |from: f64, to: f64| (1..4).map(move |step| from + (to - from) * f64::from(step) / 4.0);
        between(before, value).chain(between(value, after)).filter(|one| *one != value).collect()
    }
}

/// The value with the largest finite score, and the score.
fn largest(values: &[f64], score: impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
    let scored = values.iter().filter_map(|value| Some((*value, score(*value)?)));
    scored.filter(|(_, score)| score.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// All readings that the rows allow, beside slips.
pub(super) fn readings(data: &DataSplit) -> Vec<OtherReading> {
    instrument::ALL.iter().filter_map(|reading| reading(data)).collect()
}
