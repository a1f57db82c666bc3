//! Pictures of a plane: coloured cells, dots and hatching over two axes, with a bar of colours or a legend beside them.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::scale::{ColourScale, ticks};
use super::svg::{Figure, escaped};
use crate::results::MapCell;

/// Left of the plot, above it, and the height of the axis below it [px].
const LEFT: f64 = 62.0;
const TOP: f64 = 24.0;
const BELOW: f64 = 46.0;
/// From the plot to what is beside it, and width of a bar of colours [px].
const BESIDE: f64 = 14.0;
const BAR_WIDTH: f64 = 14.0;
/// Length of an axis for a number [px].
const TICK_SPACE: [f64; 2] = [50.0, 40.0];
/// Least and largest radius of a dot, and the width of its outline [px].
const DOT_RADIUS: [f64; 2] = [0.7, 1.9];
const DOT_OUTLINE: f64 = 0.3;
/// Colour of outlines of dots, and of dots without a scale: dots lie on coloured cells, and a page leaves numbered
/// colours as they are.
const DOT_COLOUR: &str = "#000000";
/// Width of a letter of a number at a tick, and from the numbers of the upright axis to its label [px].
const LETTER: f64 = 7.7;
const LABEL_GAP: f64 = 10.0;
/// The label of an axis and its ticks: the share of its length, and the number, which minor ticks have not.
pub(in crate::report) type LabelledAxis = (String, Vec<(f64, String)>);

/// A picture under construction.
pub(in crate::report) struct PlanePicture<'a> {
    id: &'a str,
    title: &'a str,
    /// What both axes show, and the size of the plot [px].
    ends: [[f64; 2]; 2],
    size: [f64; 2],
    /// Left end of what is drawn [px]; negative where the numbers of the upright axis are long.
    left: f64,
    svg: String,
}

impl<'a> PlanePicture<'a> {
    pub fn new([id, title]: [&'a str; 2], ends: [[f64; 2]; 2], size: [f64; 2]) -> Self {
        Self { id, title, ends, size, left: 0.0, svg: String::new() }
    }

    /// Right of the plot and its upper end [px].
    pub fn beside(&self) -> [f64; 2] {
        [LEFT + self.size[0] + BESIDE, TOP]
    }

    /// Left of the plot and below its axis [px].
    pub fn below(&self) -> [f64; 2] {
        [LEFT, TOP + self.size[1] + BELOW]
    }

    /// Height of the plot [px].
    pub fn height(&self) -> f64 {
        self.size[1]
    }

    /// Place in the drawing [px].
    fn pixel(&self, place: &[f64; 2]) -> [f64; 2] {
        let [x, y] = [0, 1].map(|axis| {
            let [low, high] = self.ends[axis];
            (place[axis] - low) / (high - low)
        });
        [LEFT + self.size[0] * x, TOP + self.size[1] * (1.0 - y)]
    }

    /// A place in the drawing that is a share of the way from the upper left corner of the plot [px].
    pub fn at(&self, [right, down]: [f64; 2]) -> [f64; 2] {
        [LEFT + self.size[0] * right, TOP + self.size[1] * down]
    }

    /// Adds any SVG.
    pub fn add(&mut self, svg: &str) {
        self.svg += svg;
    }

    /// Adds paths, each with its fill.
    pub fn paths(&mut self, paths: &BTreeMap<String, String>) {
        self.svg += "<g shape-rendering=\"crispEdges\">";
        for (fill, path) in paths {
            self.svg += &format!("<path fill=\"{fill}\" d=\"{path}\"/>");
        }
        self.svg += "</g>";
    }

    /// Adds cells, those of one fill as one path.
    pub fn cells(&mut self, cells: &[MapCell], fills: &[String]) {
        let mut paths: BTreeMap<String, String> = BTreeMap::new();
        for (cell, fill) in cells.iter().zip(fills) {
            *paths.entry(fill.clone()).or_default() += &self.path(cell);
        }
        self.paths(&paths);
    }

    /// Adds cells one over the other, in their order.
    pub fn stacked_cells(&mut self, cells: &[MapCell], fills: &[String]) {
        for (cell, fill) in cells.iter().zip(fills) {
            let path = self.path(cell);
            // The stroke closes the seams between neighbours.
            self.svg +=
                &format!("<path fill=\"{fill}\" stroke=\"{fill}\" stroke-width=\"0.4\" d=\"{path}\"/>");
        }
    }

    fn path(&self, cell: &MapCell) -> String {
        let mut path = String::new();
        for (place, corner) in cell.outline.iter().enumerate() {
            let [x, y] = self.pixel(corner);
            // Writing to a text cannot fail.
            let _ = write!(path, "{}{x:.1} {y:.1}", if place == 0 { "M" } else { " " });
        }
        path + "z"
    }

    /// Outlines all that is drawn so far, by a wider copy in black under it.
    pub fn outline(&mut self) {
        let crisp = " shape-rendering=\"crispEdges\"";
        let (id, cells) = (self.id, self.svg.replace(crisp, ""));
        self.svg = format!(
            "<defs><g id=\"{id}-cells\">{cells}</g></defs><use href=\"#{id}-cells\" stroke=\"black\" \
             stroke-width=\"2\" \
             stroke-linejoin=\"round\"/><use href=\"#{id}-cells\"{crisp}/>"
        );
    }

    /// Adds dots as round ends of lines without a length: first all of them in black and a bit
    /// larger, as outlines, then those of one colour as one path, in the order of their values.
    /// Without a scale they are black.
    pub fn dots(&mut self, dots: &[([f64; 2], f64)], scale: Option<&ColourScale>) {
        let mut paths: Vec<(String, String)> = Vec::new();
        let mut sorted: Vec<&([f64; 2], f64)> = dots.iter().collect();
        sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut all = String::new();
        for (place, value) in sorted {
            let colour = match scale {
                Some(scale) if value.is_finite() => scale.colour(*value),
                _ => DOT_COLOUR.to_owned(),
            };
            if paths.last().is_none_or(|(last, _)| *last != colour) {
                paths.push((colour, String::new()));
            }
            let [x, y] = self.pixel(place);
            let dot = format!("M{x:.1} {y:.1}h0");
            all += &dot;
            if let Some((_, path)) = paths.last_mut() {
                path.push_str(&dot);
            }
        }
        let apart = (self.size[0] * self.size[1] / dots.len().max(1) as f64).sqrt();
        let width = 2.0 * (0.22 * apart).clamp(DOT_RADIUS[0], DOT_RADIUS[1]);
        self.svg += &format!(
            "<g fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{width:.2}\">\
             <path stroke=\"{DOT_COLOUR}\" stroke-width=\"{:.2}\" d=\"{all}\"/>",
            width + 2.0 * DOT_OUTLINE
        );
        for (colour, path) in paths {
            self.svg += &format!("<path stroke=\"{colour}\" d=\"{path}\"/>");
        }
        self.svg += "</g>";
    }

    /// Adds both axes with round numbers, and a frame around the plot if wanted.
    pub fn axes(&mut self, labels: [&str; 2], is_framed: bool) {
        let [across, up] = [0, 1].map(|axis| {
            let [low, high] = self.ends[axis];
            let count = (self.size[axis] / TICK_SPACE[axis]) as usize;
            (labels[axis].to_owned(), ticks(low, high, count.max(2)))
        });
        self.labelled_axes(&across, &up, is_framed);
    }

    /// The same with these ticks.
    pub fn labelled_axes(&mut self, across: &LabelledAxis, up: &LabelledAxis, is_framed: bool) {
        let [width, height] = self.size;
        let bottom = TOP + height;
        let mut svg = String::new();
        if is_framed {
            svg = format!(
                "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" \
                 stroke=\"black\"/>"
            );
        }
        let length = |text: &str| if text.is_empty() { 3.0 } else { 5.0 };
        for (share, text) in &across.1 {
            let x = LEFT + width * share;
            svg += &format!("<path d=\"M{x:.1} {bottom:.1}v{}\" stroke=\"black\"/>", length(text));
            svg += &text_at([x, bottom + 18.0], "middle", text);
        }
        for (share, text) in &up.1 {
            let y = bottom - height * share;
            svg += &format!("<path d=\"M{LEFT} {y:.1}h-{}\" stroke=\"black\"/>", length(text));
            svg += &text_at([LEFT - 8.0, y + 4.0], "end", text);
        }
        svg += &text_at([LEFT + 0.5 * width, bottom + 38.0], "middle", &across.0);
        let longest = up.1.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0);
        let x = (LEFT - 8.0 - LETTER * longest as f64 - LABEL_GAP + 4.0).min(13.0);
        self.left = (x - 13.0).min(self.left);
        self.svg += &(svg + &upright([x, TOP + 0.5 * height], &up.0));
    }

    /// Adds a bar of colours of a height [px], the first or a later one beside the plot: a unit
    /// stands above it, a longer label upright beside it.
    pub fn bar(&mut self, scale: &ColourScale, label: &str, place: usize, height: f64) {
        let [x, y] = self.beside();
        let x = x + COLUMN_WIDTH * place as f64;
        self.svg += &scale.bar([x, y], [BAR_WIDTH, height]);
        self.svg += &match label.contains(' ') {
            true => upright([x + 73.0, y + 0.5 * height], label),
            false => text_at([x, y - 9.0], "start", label),
        };
    }

    /// The figure, so wide and so high [px]; the plot with what is beside it is in the middle of a
    /// drawing that is wider.
    pub fn figure(self, caption: &str, [width, height]: [f64; 2], used: f64) -> Figure {
        let centred = -0.5 * (width - used).max(0.0);
        let left = centred.min(self.left) + 0.0;
        let width = centred + width - left;
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{left:.1} 0 {width:.1} {height:.1}\" role=\"img\" \
             aria-label=\"{}\" font-family=\"DejaVu Sans, Verdana, Liberation Sans, Arial, \
             sans-serif\" font-size=\"12\" fill=\"black\">{}</svg>",
            escaped(self.title),
            self.svg
        );
        let [id, title, caption] = [self.id, self.title, caption].map(str::to_owned);
        Figure { id, title, caption, svg }
    }
}

/// Width of a bar of colours with its numbers and an upright label [px].
pub(in crate::report) const COLUMN_WIDTH: f64 = 98.0;

/// A text at a place [px].
pub(in crate::report) fn text_at([x, y]: [f64; 2], anchor: &str, text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>")
}

/// A text that reads upwards, about its middle [px].
fn upright([x, y]: [f64; 2], text: &str) -> String {
    format!("<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" text-anchor=\"middle\">{text}</text>")
}

/// An entry of a legend: a swatch, and lines of text beside it [px].
pub(in crate::report) fn swatch(fill: &str, [x, y]: [f64; 2], lines: &[&str]) -> String {
    let line = |(place, text): (usize, &&str)| {
        let y = y + 10.0 + 14.0 * place as f64;
        format!("<text x=\"{}\" y=\"{y}\">{text}</text>", x + 18.0)
    };
    let lines: String = lines.iter().enumerate().map(line).collect();
    format!(
        "<rect x=\"{x}\" y=\"{y}\" width=\"12\" height=\"12\" fill=\"{fill}\" stroke=\"black\" \
         stroke-width=\".5\"/>{lines}"
    )
}

/// A pattern for cells: dark and light stripes, to be seen on every colour. Its fill is `url(#ID-hatch)`.
pub(in crate::report) fn hatching(id: &str) -> String {
    format!(
        "<defs><pattern id=\"{id}-hatch\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" \
         patternTransform=\"rotate(45)\"><path d=\"M0 0v8\" stroke=\"#fff\" stroke-width=\"2\" stroke-opacity=\".7\"/>\
         <path d=\"M1.5 0v8\" stroke=\"#000\" stroke-width=\"1\" stroke-opacity=\".6\"/></pattern></defs>"
    )
}
