//! One panel of a map as SVG: coloured cells over two axes, hatching, named areas, scale and legend.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::map::{InputAxis, Map};
use crate::report::chart::{ColourScale, Figure, round_edges};
use crate::report::format::number;
use nearwall::impact::Regime;

/// Size of the drawing and of its plot [px].
const WIDTH: f64 = 620.0;
const LEFT: f64 = 78.0;
const TOP: f64 = 14.0;
const PLOT: [f64; 2] = [430.0, 330.0];
/// Height of the axis below the plot, and of a row of the legend [px].
const BELOW: f64 = 56.0;
const LEGEND_ROW: f64 = 22.0;
/// Half the size that the name of an area needs [px].
const NAME: [f64; 2] = [36.0, 11.0];
/// Colour of cells in which no particle rebounds.
const GREY: &str = "#9a9a9a";

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
        let inside = |own: Regime| regimes.iter().map(|regime| *regime == Some(own)).collect::<Vec<_>>();
        let size = self.cell_size();
        for regime in Regime::ALL {
            if let Some(cell) = widest_place(&inside(regime), self.map.x.points(), size) {
                let [column, row] = self.corner(cell);
                self.names.push((regime.name(), [column + 0.5 * size[0], row + 0.5 * size[1]]));
            }
        }
        self
    }

    /// The figure, with swatches and their meaning beside the plot, or a scale of colours.
    pub fn figure(self, swatches: &[(&str, String)], scale: Option<&ColourScale>) -> Figure {
        let marks = self.marks();
        let height = TOP + PLOT[1] + BELOW + if marks.is_empty() { 0.0 } else { LEGEND_ROW };
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{}\" \
             font-family=\"DejaVu Sans, Verdana, Liberation Sans, Arial, sans-serif\" font-size=\"12\" fill=\"black\">",
            self.title
        );
        svg += &self.hatching();
        svg += &self.cells();
        svg += &self.axes();
        svg += &self.area_names();
        svg += &beside(swatches);
        svg += &scale.map_or(String::new(), |scale| scale.bar([LEFT + PLOT[0] + 16.0, TOP], [18.0, PLOT[1]]));
        svg += &legend(&marks, height - 10.0);
        svg += "</svg>";
        let Self { id, title, caption, .. } = self;
        Figure { id: id.to_owned(), title: title.to_owned(), caption: caption.to_owned(), svg }
    }

    /// Width and height of a cell [px].
    fn cell_size(&self) -> [f64; 2] {
        [PLOT[0] / self.map.x.points() as f64, PLOT[1] / self.map.y.points() as f64]
    }

    /// Upper left corner of a cell [px].
    fn corner(&self, cell: usize) -> [f64; 2] {
        let (columns, rows) = (self.map.x.points(), self.map.y.points());
        let [width, height] = self.cell_size();
        let (column, row) = (cell % columns, rows - 1 - cell / columns);
        [LEFT + column as f64 * width, TOP + row as f64 * height]
    }

    /// The outlines of all cells that `key` gives the same text, joined along rows.
    fn outlines(&self, key: impl Fn(usize) -> Option<String>) -> BTreeMap<String, String> {
        let columns = self.map.x.points();
        let [width, height] = self.cell_size();
        let mut paths: BTreeMap<String, String> = BTreeMap::new();
        let keys: Vec<Option<String>> = (0..self.fills.len()).map(key).collect();
        for (row, cells) in keys.chunks(columns).enumerate() {
            let mut begin = 0;
            while begin < cells.len() {
                let length = cells[begin..].iter().take_while(|key| **key == cells[begin]).count();
                if let Some(key) = &cells[begin] {
                    let [x, y] = self.corner(row * columns + begin);
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

    fn cells(&self) -> String {
        let colour = |cell: usize| match &self.fills[cell] {
            Fill::Colour(colour) => Some(colour.clone()),
            Fill::NoRebound => Some(GREY.to_owned()),
            Fill::Undecided => None,
        };
        let mut svg = "<g shape-rendering=\"crispEdges\">".to_owned();
        for (colour, path) in self.outlines(colour) {
            svg += &format!("<path fill=\"{colour}\" d=\"{path}\"/>");
        }
        svg += "</g>";
        let outside =
            |cell: usize| self.map.cells[cell].filter(|cell| cell.outside_range).map(|_| String::new());
        for path in self.outlines(outside).values() {
            svg += &format!("<path fill=\"url(#{}-hatch)\" d=\"{path}\"/>", self.id);
        }
        svg
    }

    /// The pattern of cells outside the stated range: dark and light, to be seen on every colour.
    fn hatching(&self) -> String {
        format!(
            "<defs><pattern id=\"{}-hatch\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" \
             patternTransform=\"rotate(45)\"><path d=\"M0 0v8\" stroke=\"#fff\" stroke-width=\"2\" stroke-opacity=\".7\"/>\
             <path d=\"M1.5 0v8\" stroke=\"#000\" stroke-width=\"1\" stroke-opacity=\".6\"/></pattern></defs>",
            self.id
        )
    }

    fn axes(&self) -> String {
        let [width, height] = PLOT;
        let (bottom, [cell_width, cell_height]) = (TOP + height, self.cell_size());
        let mut svg = format!(
            "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"black\"/>"
        );
        // The first and the last value are in the middle of the outermost cells.
        for (share, text) in ticks(&self.map.x) {
            let x = LEFT + 0.5 * cell_width + share * (width - cell_width);
            let length = if text.is_empty() { 3.0 } else { 6.0 };
            svg += &format!("<path d=\"M{x:.2} {bottom}v{length}\" stroke=\"black\"/>");
            svg +=
                &format!("<text x=\"{x:.2}\" y=\"{}\" text-anchor=\"middle\">{text}</text>", bottom + 20.0);
        }
        for (share, text) in ticks(&self.map.y) {
            let y = bottom - 0.5 * cell_height - share * (height - cell_height);
            let length = if text.is_empty() { 3.0 } else { 6.0 };
            svg += &format!("<path d=\"M{LEFT} {y:.2}h-{length}\" stroke=\"black\"/>");
            let (x, y) = (LEFT - 9.0, y + 4.0);
            svg += &format!("<text x=\"{x}\" y=\"{y:.2}\" text-anchor=\"end\">{text}</text>");
        }
        let (middle, low) = (LEFT + 0.5 * width, bottom + 44.0);
        svg +=
            &format!("<text x=\"{middle}\" y=\"{low}\" text-anchor=\"middle\">{}</text>", label(&self.map.x));
        let middle = TOP + 0.5 * height;
        svg + &format!(
            "<text transform=\"translate(16 {middle}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            label(&self.map.y)
        )
    }

    fn area_names(&self) -> String {
        let name = |(name, [x, y]): &(&str, [f64; 2])| {
            format!(
                "<text x=\"{x:.2}\" y=\"{:.2}\" text-anchor=\"middle\" font-size=\"13\" font-weight=\"bold\" stroke=\"white\" \
                 stroke-width=\"3\" paint-order=\"stroke\">{name}</text>",
                y + 4.5
            )
        };
        self.names.iter().map(name).collect()
    }

    /// The marks that occur in this panel, with their meaning.
    fn marks(&self) -> Vec<(String, &'static str)> {
        let mut marks = Vec::new();
        if self.map.outside_range() > 0 {
            marks.push((format!("url(#{}-hatch)", self.id), "outside the stated range"));
        }
        if self.fills.contains(&Fill::NoRebound) {
            marks.push((GREY.to_owned(), "no particle rebounds"));
        }
        if self.fills.contains(&Fill::Undecided) {
            marks.push(("white".to_owned(), "not decided"));
        }
        marks
    }
}

/// Swatches right of the plot.
fn beside(swatches: &[(&str, String)]) -> String {
    let x = LEFT + PLOT[0] + 10.0;
    let one = |(place, (colour, text)): (usize, &(&str, String))| {
        let y = TOP + 4.0 + 20.0 * place as f64;
        format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"11\" height=\"11\" fill=\"{colour}\" stroke=\"black\" stroke-width=\".5\"/>\
             <text x=\"{}\" y=\"{}\" font-size=\"9.5\">{text}</text>",
            x + 15.0,
            y + 9.0
        )
    };
    swatches.iter().enumerate().map(one).collect()
}

/// Swatches below the axis.
fn legend(marks: &[(String, &str)], y: f64) -> String {
    let mut x = LEFT;
    let mut svg = String::new();
    for (fill, text) in marks {
        svg += &format!(
            "<rect x=\"{x}\" y=\"{}\" width=\"16\" height=\"11\" fill=\"{fill}\" stroke=\"black\" stroke-width=\".5\"/>\
             <text x=\"{}\" y=\"{y}\" font-size=\"11\">{text}</text>",
            y - 10.0,
            x + 21.0
        );
        x += 36.0 + 6.5 * text.len() as f64;
    }
    svg
}

/// The name of an axis for a reader, with its unit.
fn label(axis: &InputAxis) -> String {
    let input = axis.input();
    let about = input.about.split(" [").next().unwrap_or_default();
    let spacing = if axis.is_logarithmic() { ", logarithmic" } else { "" };
    format!("{about}, {} [{}]{spacing}", input.name, input.unit)
}

/// A number without the rounding errors of zero.
fn short(value: f64) -> String {
    number(if value.abs() < 1e-14 { 0.0 } else { value })
}

/// Ticks of an axis: the share of its length, and the number; no number at minor ticks.
fn ticks(axis: &InputAxis) -> Vec<(f64, String)> {
    let [low, high] = axis.ends();
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
    if reach * height < NAME[1] || (2.0 * reach + 1.0) * width < NAME[0] {
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
            let ticks = ticks(&axis).into_iter().filter(|(_, text)| !text.is_empty());
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
