//! One panel of a map as SVG: coloured cells over two axes, hatching, named areas, scale and legend.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::map::{InputAxis, Map};
use crate::report::chart::{
    ColourScale, Figure, LabelledAxis, NO_VALUE, PlanePicture, hatching, round_edges, swatch,
};
use crate::report::format::{number, shown_unit};
use nearwall::impact::Regime;

/// Width of the drawing, and size of its plot [px].
const PANEL_WIDTH: f64 = 480.0;
const PANEL_PLOT: [f64; 2] = [320.0, 260.0];
/// Height of the legend below the axis, and of an entry of that beside the plot [px].
const LEGEND_BELOW: f64 = 22.0;
const LEGEND_ENTRY: f64 = 36.0;
/// Half the size that the name of an area needs [px].
const NAME_SIZE: [f64; 2] = [36.0, 11.0];

/// What a cell shows.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fill {
    Colour(String),
    /// No particle rebounds.
    NoRebound,
    /// The impact cannot be decided.
    Undecided,
}

/// A panel under construction.
pub(super) struct Panel<'a> {
    map: &'a Map,
    id: &'a str,
    title: &'a str,
    caption: &'a str,
    fills: Vec<Fill>,
    /// Names and places of areas.
    names: Vec<(&'static str, [f64; 2])>,
}

impl<'a> Panel<'a> {
    pub fn new(map: &'a Map, id: &'a str, title: &'a str, fills: Vec<Fill>, caption: &'a str) -> Self {
        Self { map, id, title, caption, fills, names: Vec::new() }
    }

    /// Names the widest place of each regime, where the name fits.
    pub fn with_areas(mut self, regimes: &[Option<Regime>]) -> Self {
        let (columns, rows) = (self.map.x.points(), self.map.y.points());
        let size = self.cell_size();
        for regime in Regime::ALL {
            let inside: Vec<bool> = regimes.iter().map(|other| *other == Some(regime)).collect();
            if let Some(cell) = widest_place(&inside, columns, size) {
                let (column, row) = (cell % columns, rows - 1 - cell / columns);
                let place = [(column as f64 + 0.5) / columns as f64, (row as f64 + 0.5) / rows as f64];
                self.names.push((regime.name(), place));
            }
        }
        self
    }

    /// The figure, with swatches and their meaning beside the plot, or a scale of colours.
    pub fn figure(self, swatches: &[(&str, [String; 2])], scale: Option<&ColourScale>) -> Figure {
        let counts = [self.map.x.points(), self.map.y.points()];
        let ends = counts.map(|count| [0.0, count as f64]);
        let mut picture = PlanePicture::new([self.id, self.title], ends, PANEL_PLOT);
        picture.add(&hatching(self.id));
        picture.paths(&self.outlines(&picture, |cell| match &self.fills[cell] {
            Fill::Colour(colour) => Some(colour.clone()),
            Fill::NoRebound => Some(NO_VALUE.to_owned()),
            Fill::Undecided => None,
        }));
        let hatch = format!("url(#{}-hatch)", self.id);
        picture.paths(&self.outlines(&picture, |cell| {
            self.map.cells[cell].filter(|cell| cell.beyond).map(|_| hatch.clone())
        }));
        let [across, up] = [&self.map.x, &self.map.y].map(labelled);
        picture.labelled_axes(&across, &up, true);
        self.add_names(&mut picture);
        let [x, y] = picture.beside();
        for (place, (colour, lines)) in swatches.iter().enumerate() {
            let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
            picture.add(&swatch(colour, [x, y + LEGEND_ENTRY * place as f64], &lines));
        }
        if let Some(scale) = scale {
            picture.bar(scale, "", 0, PANEL_PLOT[1]);
        }
        let height = self.add_marks(&mut picture);
        picture.figure(self.caption, [PANEL_WIDTH, height], PANEL_WIDTH)
    }

    /// Adds the marks that occur and their meaning below the axis; where all ends [px].
    fn add_marks(&self, picture: &mut PlanePicture<'_>) -> f64 {
        let [left, mut bottom] = picture.below();
        let mut x = PANEL_WIDTH;
        for (fill, text) in self.marks() {
            let width = 36.0 + 7.3 * text.len() as f64;
            if x + width > PANEL_WIDTH {
                (x, bottom) = (left, bottom + LEGEND_BELOW);
            }
            picture.add(&swatch(&fill, [x, bottom + 4.0 - LEGEND_BELOW], &[text]));
            x += width;
        }
        bottom
    }

    fn add_names(&self, picture: &mut PlanePicture) {
        for (name, place) in &self.names {
            let [x, y] = picture.at(*place);
            picture.add(&format!(
                "<text x=\"{x:.2}\" y=\"{:.2}\" text-anchor=\"middle\" font-size=\"13\" font-weight=\"bold\" \
                 stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\">{name}</text>",
                y + 4.5
            ));
        }
    }

    /// Width and height of a cell [px].
    fn cell_size(&self) -> [f64; 2] {
        [PANEL_PLOT[0] / self.map.x.points() as f64, PANEL_PLOT[1] / self.map.y.points() as f64]
    }

    /// The outlines of all cells that `key` gives the same text, joined along rows.
    fn outlines(
        &self,
        picture: &PlanePicture<'_>,
        key: impl Fn(usize) -> Option<String>,
    ) -> BTreeMap<String, String> {
        let (columns, rows) = (self.map.x.points(), self.map.y.points());
        let [width, height] = self.cell_size();
        let mut paths: BTreeMap<String, String> = BTreeMap::new();
        let keys: Vec<Option<String>> = (0..self.fills.len()).map(key).collect();
        for (row, cells) in keys.chunks(columns).enumerate() {
            let mut begin = 0;
            while begin < cells.len() {
                let length = cells[begin..].iter().take_while(|key| **key == cells[begin]).count();
                if let Some(key) = &cells[begin] {
                    let [x, y] =
                        picture.at([begin as f64 / columns as f64, (rows - 1 - row) as f64 / rows as f64]);
                    let path = paths.entry(key.clone()).or_default();
                    let right = length as f64 * width;
                    // Writing to a text cannot fail.
                    let _ = write!(path, "M{x:.2} {y:.2}h{right:.2}v{height:.2}h-{right:.2}z");
                }
                begin += length;
            }
        }
        paths
    }

    /// The marks that occur in this panel, with their meaning.
    fn marks(&self) -> Vec<(String, &'static str)> {
        let marks = [
            (self.map.beyond() > 0, format!("url(#{}-hatch)", self.id), "outside a stated range, may matter"),
            (self.fills.contains(&Fill::NoRebound), NO_VALUE.to_owned(), "no particle rebounds"),
            (self.fills.contains(&Fill::Undecided), "white".to_owned(), "not decided"),
        ];
        marks.into_iter().filter(|(occurs, ..)| *occurs).map(|(_, fill, text)| (fill, text)).collect()
    }
}

/// An axis with its ticks; the first and the last value are in the middle of the outermost cells.
fn labelled(axis: &InputAxis) -> LabelledAxis {
    let cell = 1.0 / axis.points() as f64;
    let place = |(share, text): (f64, String)| (0.5 * cell + share * (1.0 - cell), text);
    (label(axis), ticks_of(axis).into_iter().map(place).collect())
}

/// The name of an input for a reader.
pub(super) fn name(axis: &InputAxis) -> String {
    let input = axis.input();
    format!("{}, {}", input.words(), input.name)
}

/// The same with its unit, for an axis.
fn label(axis: &InputAxis) -> String {
    let spacing = if axis.is_logarithmic() { ", logarithmic" } else { "" };
    format!("{} [{}]{spacing}", name(axis), shown(axis).1)
}

/// How the values of an axis are shown: a factor and the name of the unit.
fn shown(axis: &InputAxis) -> (f64, String) {
    shown_unit(axis.input().unit, axis.ends()[1])
}

/// A number without the rounding errors of zero.
fn short(value: f64) -> String {
    number(if value.abs() < 1e-14 { 0.0 } else { value })
}

/// Ticks of an axis: the share of its length, and the number; no number at minor ticks.
fn ticks_of(axis: &InputAxis) -> Vec<(f64, String)> {
    let [low, high] = axis.ends().map(|end| shown(axis).0 * end);
    let tolerance = 1e-9 * (high - low);
    if !axis.is_logarithmic() {
        let inside = |value: &f64| (low - tolerance..=high + tolerance).contains(value);
        let edges = round_edges(low, high, 6).into_iter().filter(inside);
        return edges.map(|value| ((value - low) / (high - low), short(value))).collect();
    }
    let decades = (high / low).log10();
    let named: &[u32] = if decades < 2.5 { &[1, 2, 5] } else { &[1] };
    // Beyond eight decades the numbers would touch.
    let every = (decades / 8.0).ceil() as i32;
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let mut ticks = Vec::new();
    for power in first..=last {
        for digit in 1..10 {
            let value = f64::from(digit) * 10f64.powi(power);
            let share = (value / low).log10() / decades;
            if (-1e-9..=1.0 + 1e-9).contains(&share) {
                let has_name = named.contains(&digit) && power % every == 0;
                ticks.push((share, if has_name { number(value) } else { String::new() }));
            }
        }
    }
    ticks
}

/// The cell that is farthest from the edge of an area; `None` where a name does not fit around it.
fn widest_place(inside: &[bool], columns: usize, [width, height]: [f64; 2]) -> Option<usize> {
    let rows = inside.len() / columns;
    // Half the side of the largest square of cells around each cell, by steps from all edges.
    let mut depth = vec![0_usize; inside.len()];
    let around = |depth: &[usize], cell: usize| {
        let (row, column) = (cell / columns, cell % columns);
        if row == 0 || column == 0 || row + 1 == rows || column + 1 == columns {
            return 0;
        }
        let near = |row: usize| (column - 1..=column + 1).map(move |column| row * columns + column);
        (row - 1..=row + 1).flat_map(near).map(|other| depth[other]).min().unwrap_or(0)
    };
    for _ in 0..rows.max(columns) {
        let next: Vec<usize> =
            (0..inside.len()).map(|cell| if inside[cell] { 1 + around(&depth, cell) } else { 0 }).collect();
        if next == depth {
            break;
        }
        depth = next;
    }
    let most = depth.iter().copied().max().filter(|most| *most > 0)?;
    let reach = most as f64 - 0.5;
    if reach * height < NAME_SIZE[1] || (2.0 * reach + 1.0) * width < NAME_SIZE[0] {
        return None;
    }
    // Of several such cells, the one nearest to their middle.
    let widest: Vec<usize> = (0..inside.len()).filter(|cell| depth[*cell] == most).collect();
    let place = |cell: usize| [(cell % columns) as f64, (cell / columns) as f64];
    let middle =
        |axis: usize| widest.iter().map(|cell| place(*cell)[axis]).sum::<f64>() / widest.len() as f64;
    let middle = [middle(0), middle(1)];
    let distance = |cell: usize| (place(cell)[0] - middle[0]).hypot(place(cell)[1] - middle[1]);
    widest.iter().copied().min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers_at_their_places() {
        let named = |text: &str| {
            let axis: InputAxis = text.parse().unwrap();
            let ticks = ticks_of(&axis).into_iter().filter(|(_, text)| !text.is_empty());
            ticks.map(|(share, text)| (format!("{share:.3}"), text)).collect::<Vec<_>>()
        };
        let pairs = |pairs: &[(&str, &str)]| {
            pairs.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect::<Vec<_>>()
        };
        assert_eq!(
            named("v_n=0.1:100"),
            pairs(&[("0.000", "0.1"), ("0.333", "1"), ("0.667", "10"), ("1.000", "100")])
        );
        assert_eq!(
            named("conversion=0:1"),
            pairs(&[
                ("0.000", "0"),
                ("0.200", "0.2"),
                ("0.400", "0.4"),
                ("0.600", "0.6"),
                ("0.800", "0.8"),
                ("1.000", "1")
            ])
        );
    }

    #[test]
    fn an_area_is_named_in_its_middle() {
        let area: Vec<bool> = (0..81).map(|cell| cell % 9 < 5).collect();
        let place = widest_place(&area, 9, [20.0, 20.0]).unwrap();
        assert_eq!(place % 9, 2);
        assert!((2..7).contains(&(place / 9)));
        assert_eq!(widest_place(&area, 9, [1.0, 1.0]), None);
        assert_eq!(widest_place(&[false; 9], 3, [100.0; 2]), None);
    }
}
