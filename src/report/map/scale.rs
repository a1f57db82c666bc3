//! Colours of a map's cells.

use kuva::plot::ColorMap;

use crate::impact::Regime;

/// Number of colours of a scale.
const LEVELS: f64 = 64.0;

/// A range of values as colours of cividis, which reads the same with every kind of colour vision.
pub(super) struct ColourScale {
    low: f64,
    high: f64,
}

impl ColourScale {
    pub fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    pub fn ends(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// The colour of a value, in one of 64 levels.
    pub fn colour(&self, value: f64) -> String {
        let share = ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0);
        ColorMap::Cividis.map((share * LEVELS).round() / LEVELS)
    }
}

/// The colour of a regime; by Okabe and Ito, in shades that differ in black and white, too.
pub(super) fn regime_colour(regime: Regime) -> &'static str {
    match regime {
        Regime::NspNsw => "#e3e3e3",
        Regime::NspSw => "#56b4e9",
        Regime::SpNsw => "#f0e442",
        Regime::SpSw => "#d55e00",
    }
}
