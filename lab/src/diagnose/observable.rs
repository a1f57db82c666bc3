//! The observables of an impact.

use super::likelihood::Mean;
use crate::dataset::Measurement;

/// A measured quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Observable {
    NormalRestitution,
    TangentialRestitution,
    Capture,
}

impl Observable {
    pub const ALL: [Self; 3] = [Self::NormalRestitution, Self::TangentialRestitution, Self::Capture];

    /// The name in the data file.
    pub fn name(self) -> &'static str {
        ["e_n", "e_t", "outcome"][self as usize]
    }

    /// The name in sentences.
    pub fn title(self) -> &'static str {
        ["normal restitution e_n", "tangential restitution e_t", "capture"][self as usize]
    }

    /// The measured value of a row.
    pub fn measured(self, row: &Measurement) -> Option<f64> {
        match self {
            Self::NormalRestitution => row.e_n.map(|reading| reading.value),
            Self::TangentialRestitution => row.e_t.map(|reading| reading.value),
            Self::Capture => row.captured,
        }
    }

    /// The predicted mean.
    pub fn predicted(self, mean: &Mean) -> f64 {
        mean.restitution.get(self as usize).copied().unwrap_or(mean.capture)
    }
}
