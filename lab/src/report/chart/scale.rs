//! Colours of a map's cells, and the bar that explains them.

use kuva::plot::ColorMap;

use super::super::format::number;
use super::axis::round_edges;
use nearwall::impact::Regime;

/// Number of colours of a scale.
const LEVELS: f64 = 64.0;

/// Light yellow to dark red: the colours YlOrRd of ColorBrewer (Harrower and Brewer,
/// doi:10.1179/000870403235002042), lightened.
const YELLOW_TO_RED: [[f64; 3]; 6] = [
    [255.0, 252.0, 224.0],
    [255.0, 237.0, 160.0],
    [254.0, 204.0, 92.0],
    [253.0, 161.0, 80.0],
    [244.0, 110.0, 67.0],
    [222.0, 74.0, 56.0],
];
/// Black by blue to white: fresh coal is dark, ash is light. Every shade stands out from [`YELLOW_TO_RED`].
const CHAR_TO_ASH: [[f64; 3]; 5] =
    [[0.0, 0.0, 0.0], [8.0, 48.0, 120.0], [33.0, 113.0, 200.0], [120.0, 196.0, 245.0], [255.0, 255.0, 255.0]];

/// Colour of a cell without a value.
pub(in crate::report) const NO_VALUE: &str = "#9a9a9a";

/// The colours of a scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::report) enum Palette {
    /// Blue to yellow; reads the same with every kind of colour vision.
    Cividis,
    /// Light yellow to red, for gas behind other things.
    Heat,
    /// Black by blue to white, for small things on [`Self::Heat`].
    CharToAsh,
}

impl Palette {
    /// The colour at a share of the way [1].
    fn colour(self, share: f64) -> String {
        match self {
            Self::Cividis => ColorMap::Cividis.map(share),
            Self::Heat => between(&YELLOW_TO_RED, share),
            Self::CharToAsh => between(&CHAR_TO_ASH, share),
        }
    }
}

/// The colour at a share of the way through evenly spaced ones.
fn between(stops: &[[f64; 3]], share: f64) -> String {
    let way = share * (stops.len() - 1) as f64;
    let from = (way as usize).min(stops.len().saturating_sub(2));
    let [red, green, blue] = [0, 1, 2].map(|part| {
        (stops[from][part] + (way - from as f64) * (stops[from + 1][part] - stops[from][part])).round() as u8
    });
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A range of values as colours: by default those of cividis.
pub(in crate::report) struct ColourScale {
    low: f64,
    high: f64,
    palette: Palette,
}

impl ColourScale {
    pub fn new(low: f64, high: f64) -> Self {
        Self { low, high, palette: Palette::Cividis }
    }

    /// The same range with other colours.
    pub fn with(self, palette: Palette) -> Self {
        Self { palette, ..self }
    }

    /// The colour of a value, in one of 64 levels.
    pub fn colour(&self, value: f64) -> String {
        let share = ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0);
        self.palette.colour((share * LEVELS).round() / LEVELS)
    }

    /// The colour of a value, grey for one that is none.
    pub fn colour_or_grey(&self, value: f64) -> String {
        if value.is_finite() { self.colour(value) } else { NO_VALUE.to_owned() }
    }

    /// The scale as an upright bar with numbers on its right; its upper left corner and its size are in px.
    pub fn bar(&self, [x, top]: [f64; 2], [width, height]: [f64; 2]) -> String {
        let range = self.high - self.low;
        let step = height / LEVELS;
        let mut svg = "<g shape-rendering=\"crispEdges\">".to_owned();
        for place in 0..LEVELS as usize {
            let colour = self.colour(self.low + range * (place as f64 + 0.5) / LEVELS);
            let y = top + height - (place + 1) as f64 * step;
            let tall = step + 0.3;
            svg += &format!(
                "<rect x=\"{x}\" y=\"{y:.2}\" width=\"{width}\" height=\"{tall:.2}\" fill=\"{colour}\"/>"
            );
        }
        svg += "</g>";
        svg += &format!(
            "<rect x=\"{x}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"black\"/>"
        );
        for (share, text) in ticks(self.low, self.high, 5) {
            let y = top + height * (1.0 - share);
            svg += &format!("<path d=\"M{} {y:.2}h5\" stroke=\"black\"/>", x + width);
            svg += &format!("<text x=\"{}\" y=\"{:.2}\">{text}</text>", x + width + 9.0, y + 4.0);
        }
        svg
    }
}

/// Round numbers from `low` to `high`, about `count`: the share of the way, and the number with the
/// digits that tell it from its neighbours.
pub(super) fn ticks(low: f64, high: f64, count: usize) -> Vec<(f64, String)> {
    let edges = round_edges(low, high, count);
    let step = edges[1] - edges[0];
    let tolerance = 1e-9 * (high - low);
    let inside = edges.into_iter().filter(|value| (low - tolerance..=high + tolerance).contains(value));
    inside.map(|value| ((value - low) / (high - low), tick_text(value, step))).collect()
}

/// A number at a tick.
fn tick_text(value: f64, step: f64) -> String {
    // Rounding leaves numbers near 1e-17 where a zero is meant.
    if value.abs() < 1e-9 * step {
        return "0".to_owned();
    }
    if step < 1e-3 || value.abs() >= 1e6 || step > 0.01 * value.abs() {
        return number(value);
    }
    // Four digits would not tell it from the next tick.
    format!("{value:.*}", (1.0 - step.log10().floor()).max(0.0) as usize)
}

/// The colour of a regime; by Okabe and Ito, in shades that differ in black and white, too.
pub(in crate::report) fn regime_colour(regime: Regime) -> &'static str {
    match regime {
        Regime::NspNsw => "#d0d0d0",
        Regime::NspSw => "#56b4e9",
        Regime::SpNsw => "#f0e442",
        Regime::SpSw => "#d55e00",
    }
}
