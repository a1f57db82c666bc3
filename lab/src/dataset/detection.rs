//! What an apparatus does not see: slow rebounds.

use super::unit::{Dimension, read_quantity};
use nearwall::impact::Impact;
use nearwall::input::{InputError, Section};

/// The detection limit of an apparatus: it records no rebound below any stated limit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Detection {
    /// Least visible normal restitution [1].
    pub e_n: Option<f64>,
    /// Least visible normal speed after the rebound [m/s].
    pub rebound_speed: Option<f64>,
}

impl Detection {
    /// Reads `[detection]` of a column map.
    pub(super) fn read(top: &Section<'_>) -> Result<Self, InputError> {
        let Some(section) = top.section("detection")? else { return Ok(Self::default()) };
        let limit = |key: &str, dimension: Dimension| -> Result<Option<f64>, InputError> {
            match read_quantity(&section, key, dimension)? {
                Some(value) if !(value > 0.0 && value.is_finite()) => {
                    Err(section.fault(key, "must be above 0 and finite"))
                }
                value => Ok(value),
            }
        };
        let limits = Self {
            e_n: limit("e_n", Dimension::Share)?,
            rebound_speed: limit("rebound_speed", Dimension::Speed)?,
        };
        section.finish()?;
        match limits {
            Self { e_n: None, rebound_speed: None } => {
                Err(section.missing("e_n", "the least visible e_n, or give rebound_speed [m/s]"))
            }
            limits => Ok(limits),
        }
    }

    /// The least normal restitution [1] that is visible for this impact: 0 without a limit, infinite for a normal speed
    /// of 0 under a limit of `rebound_speed`.
    pub fn least_e_n(&self, impact: &Impact) -> f64 {
        let by_speed = self.rebound_speed.map_or(0.0, |speed| speed / impact.normal_speed.abs());
        self.e_n.unwrap_or(0.0).max(by_speed)
    }
}
