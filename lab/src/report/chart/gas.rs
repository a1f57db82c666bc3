//! The picture of a cut through the gas with parcels on it.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::scale::{ColourScale, ticks};
use super::svg::{Figure, escaped};
use crate::results::gas::CutCell;

/// Left of the plot, above it and below it [px].
const LEFT: f64 = 64.0;
const TOP: f64 = 12.0;
const BELOW: f64 = 46.0;
/// Largest width and height of the plot, and the least of either [px].
const MOST: [f64; 2] = [400.0, 600.0];
const LEAST: f64 = 24.0;
/// Largest and least height of the bars of colours, and width of each with its numbers and its label [px].
const BAR: [f64; 2] = [260.0, 150.0];
const BAR_WIDTH: f64 = 14.0;
const COLUMN: f64 = 98.0;
/// Least and largest radius of a dot, and the width of its outline [px].
const RADIUS: [f64; 2] = [0.7, 1.9];
const OUTLINE: f64 = 0.3;
/// Least width of the drawing [px].
const LEAST_WIDTH: f64 = 470.0;
/// Length of an axis for a number [px].
const TICK: [f64; 2] = [50.0, 44.0];

/// A picture under construction; one metre is equally long along both axes, unless the domain is very thin.
pub(in crate::report) struct GasPicture<'a> {
    cells: &'a [CutCell],
    ends: [[f64; 2]; 2],
    /// Width and height of the plot [px].
    size: [f64; 2],
    /// Radius of a dot [px].
    radius: f64,
}

/// A scale and its label.
pub(in crate::report) type LabelledScale<'a> = (&'a ColourScale, &'a str);

impl<'a> GasPicture<'a> {
    /// `None` for cells without an extent.
    pub fn of(cells: &'a [CutCell], dots: usize) -> Option<Self> {
        let ends = [0, 1].map(|axis| {
            let places = cells.iter().flat_map(|cell| &cell.outline).map(|corner| corner[axis]);
            places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        });
        let has_extent = |[low, high]: &[f64; 2]| low.is_finite() && high.is_finite() && low < high;
        if !ends.iter().all(has_extent) {
            return None;
        }
        let [width, height] = ends.map(|[low, high]| high - low);
        let scale = (MOST[0] / width).min(MOST[1] / height);
        let size = [width, height].map(|length| (scale * length).max(LEAST));
        let apart = (size[0] * size[1] / dots.max(1) as f64).sqrt();
        let radius = (0.22 * apart).clamp(RADIUS[0], RADIUS[1]);
        Some(Self { cells, ends, size, radius })
    }

    /// The figure: `texts` are its id, title and caption, `axes` the labels of the axes. Dots without a scale are black.
    pub fn figure(
        &self,
        [id, title, caption]: [&str; 3],
        axes: &[String; 2],
        gas: LabelledScale<'_>,
        dots: &[([f64; 2], f64)],
        parcels: Option<LabelledScale<'_>>,
    ) -> Figure {
        let [plot_width, plot_height] = self.size;
        let scales: Vec<LabelledScale<'_>> = [Some(gas), parcels].into_iter().flatten().collect();
        let needed = LEFT + plot_width + 14.0 + COLUMN * scales.len() as f64;
        let width = needed.max(LEAST_WIDTH);
        let bar = (plot_height).clamp(BAR[1], BAR[0]);
        let height = TOP + (plot_height + BELOW).max(bar + 14.0);
        // The whole is in the middle of a drawing that is wider.
        let shift = 0.5 * (width - needed);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{:.1} 0 {width:.1} {height:.1}\" role=\"img\" aria-label=\"{}\" \
             font-family=\"DejaVu Sans, Verdana, Liberation Sans, Arial, sans-serif\" font-size=\"12\" fill=\"black\">",
            -shift,
            escaped(title)
        );
        svg += &self.gas(id, gas.0);
        svg += &self.dots(dots, parcels.map(|(scale, _)| scale));
        svg += &self.axes(axes);
        for (place, (scale, label)) in scales.iter().enumerate() {
            let x = LEFT + plot_width + 24.0 + COLUMN * place as f64;
            svg += &scale.bar([x, TOP], [BAR_WIDTH, bar]);
            svg += &format!(
                "<text transform=\"translate({:.1} {:.1}) rotate(-90)\" text-anchor=\"middle\">{label}</text>",
                x + 73.0,
                TOP + 0.5 * bar
            );
        }
        svg += "</svg>";
        Figure { id: id.to_owned(), title: title.to_owned(), caption: caption.to_owned(), svg }
    }

    /// Place in the drawing [px].
    fn pixel(&self, place: &[f64; 2]) -> [f64; 2] {
        let [x, y] = [0, 1].map(|axis| {
            let [low, high] = self.ends[axis];
            (place[axis] - low) / (high - low)
        });
        [LEFT + self.size[0] * x, TOP + self.size[1] * (1.0 - y)]
    }

    /// The cells, those of one colour as one path, over a wider copy of themselves in black, which outlines the domain.
    fn gas(&self, id: &str, scale: &ColourScale) -> String {
        let mut paths: BTreeMap<String, String> = BTreeMap::new();
        for cell in self.cells {
            let colour = if cell.value.is_finite() { scale.colour(cell.value) } else { "#9a9a9a".to_owned() };
            let path = paths.entry(colour).or_default();
            for (place, corner) in cell.outline.iter().enumerate() {
                let [x, y] = self.pixel(corner);
                // Writing to a text cannot fail.
                let _ = write!(path, "{}{x:.1} {y:.1}", if place == 0 { "M" } else { " " });
            }
            path.push('z');
        }
        let mut svg = format!("<defs><g id=\"{id}-cells\">");
        for (colour, path) in paths {
            svg += &format!("<path fill=\"{colour}\" d=\"{path}\"/>");
        }
        svg + &format!(
            "</g></defs><use href=\"#{id}-cells\" stroke=\"#222\" stroke-width=\"2\" stroke-linejoin=\"round\"/>\
             <use href=\"#{id}-cells\" shape-rendering=\"crispEdges\"/>"
        )
    }

    /// The parcels as round ends of lines without a length: first all of them in black and a bit larger, as outlines, then those of
    /// one colour as one path, in the order of their values.
    fn dots(&self, dots: &[([f64; 2], f64)], scale: Option<&ColourScale>) -> String {
        let mut paths: Vec<(String, String)> = Vec::new();
        let mut sorted: Vec<&([f64; 2], f64)> = dots.iter().collect();
        sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut all = String::new();
        for (place, value) in sorted {
            let colour = match scale {
                Some(scale) if value.is_finite() => scale.colour(*value),
                _ => "black".to_owned(),
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
        let width = 2.0 * self.radius;
        let mut svg = format!(
            "<g fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{width:.2}\">\
             <path stroke=\"black\" stroke-width=\"{:.2}\" d=\"{all}\"/>",
            width + 2.0 * OUTLINE
        );
        for (colour, path) in paths {
            svg += &format!("<path stroke=\"{colour}\" d=\"{path}\"/>");
        }
        svg + "</g>"
    }

    fn axes(&self, labels: &[String; 2]) -> String {
        let [width, height] = self.size;
        let bottom = TOP + height;
        let mut svg = String::new();
        let [across, up] = self.ends;
        for (share, text) in ticks(across[0], across[1], ((width / TICK[0]) as usize).max(4)) {
            let x = LEFT + width * share;
            svg += &format!("<path d=\"M{x:.1} {:.1}v5\" stroke=\"black\"/>", bottom + 3.0);
            svg += &format!(
                "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
                bottom + 20.0
            );
        }
        for (share, text) in ticks(up[0], up[1], ((height / TICK[1]) as usize).max(2)) {
            let y = bottom - height * share;
            svg += &format!("<path d=\"M{:.1} {y:.1}h-5\" stroke=\"black\"/>", LEFT - 3.0);
            svg += &format!(
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
                LEFT - 11.0,
                y + 4.0
            );
        }
        let (x, y) = (LEFT + 0.5 * width, bottom + 38.0);
        svg += &format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\">{}</text>", labels[0]);
        svg + &format!(
            "<text transform=\"translate(13 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            TOP + 0.5 * height,
            labels[1]
        )
    }
}
