//! What instruments and geometry do to readings, one file each.

mod drag;
mod drift;
mod projection;
mod tilt;
mod unseen;

use super::data_split::DataSplit;
use super::reading::OtherReading;

/// One reading for some rows; `None` where they do not have what it needs.
type Reading = fn(&DataSplit) -> Option<OtherReading>;

/// All of them.
pub(super) const ALL: [Reading; 8] = [
    tilt::reading,
    projection::reading,
    drag::reading,
    drift::of_e_n,
    drift::of_e_t,
    unseen::by_ratio,
    unseen::by_speed,
    unseen::noted_as_stuck,
];

/// Even values from `low` to `high`, without 0.
fn values(low: f64, high: f64, count: usize) -> Vec<f64> {
    let value = |place: usize| low + (high - low) * place as f64 / (count - 1) as f64;
    (0..count).map(value).filter(|value| *value != 0.0).collect()
}
