//! The map of a quantity on the faces of an unrolled wall.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::scale::{ColourScale, ticks};
use super::svg::{Figure, escaped};
use crate::results::surface::Shape;

/// Width of the drawing [px]: that of one of three figures side by side.
const WIDTH: f64 = 420.0;
const LEFT: f64 = 62.0;
const TOP: f64 = 24.0;
/// Width of the plot, and its least height [px].
const PLOT: f64 = 262.0;
const LEAST_HEIGHT: f64 = 92.0;
/// Height of the axis below the plot [px].
const BELOW: f64 = 46.0;
/// Place and width of the bar of colours [px].
const BAR: [f64; 2] = [LEFT + PLOT + 14.0, 14.0];
/// Length of an axis for a number [px].
const TICK: [f64; 2] = [60.0, 36.0];

/// A map under construction: shapes in a plane, whose ends are in m.
pub(in crate::report) struct SurfaceMap<'a> {
    shapes: &'a [Shape],
    ends: [[f64; 2]; 2],
}

impl<'a> SurfaceMap<'a> {
    /// `None` for shapes without an extent.
    pub fn of(shapes: &'a [Shape]) -> Option<Self> {
        let ends = [0, 1].map(|axis| {
            let places = shapes.iter().flat_map(|shape| &shape.outline).map(|corner| corner[axis]);
            places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        });
        let has_extent = |[low, high]: &[f64; 2]| low.is_finite() && high.is_finite() && low < high;
        ends.iter().all(has_extent).then_some(Self { shapes, ends })
    }

    /// Whether a metre upwards is longer than one to the right.
    pub fn is_stretched(&self) -> bool {
        self.height() > 1.001 * PLOT * self.aspect()
    }

    fn aspect(&self) -> f64 {
        let [width, height] = self.ends.map(|[low, high]| high - low);
        height / width
    }

    fn height(&self) -> f64 {
        (PLOT * self.aspect()).clamp(LEAST_HEIGHT, PLOT)
    }

    /// The figure of the values: `texts` are its id, title and caption, `axes` what the axes are, `unit` that of the values.
    pub fn of_values(&self, texts: [&str; 3], axes: &[String; 2], scale: &ColourScale, unit: &str) -> Figure {
        let colour = |shape: &Shape| {
            if shape.value.is_finite() { scale.colour(shape.value) } else { "#9a9a9a".to_owned() }
        };
        let colours: Vec<String> = self.shapes.iter().map(colour).collect();
        let unit = format!("<text x=\"{}\" y=\"{}\">{unit}</text>", BAR[0], TOP - 9.0);
        self.figure(texts, axes, &colours, &(scale.bar([BAR[0], TOP], [BAR[1], self.height()]) + &unit))
    }

    /// The figure of classes: the colour of each shape, hatched without one, and a legend of colours and their meaning in two lines.
    pub fn of_classes(
        &self,
        texts: [&str; 3],
        axes: &[String; 2],
        colours: &[Option<&str>],
        legend: &[(&str, [String; 2])],
    ) -> Figure {
        let hatch = format!("{}-hatch", texts[0]);
        let colours: Vec<String> = colours
            .iter()
            .map(|colour| colour.map_or_else(|| format!("url(#{hatch})"), str::to_owned))
            .collect();
        let pattern = format!(
            "<defs><pattern id=\"{hatch}\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" \
             patternTransform=\"rotate(45)\"><path d=\"M0 0v6\" stroke=\"#777\" stroke-width=\"1\"/></pattern></defs>"
        );
        let entries: String =
            legend.iter().enumerate().map(|(place, (colour, lines))| entry(place, colour, lines)).collect();
        self.figure(texts, axes, &colours, &(pattern + &entries))
    }

    /// The figure with what stands beside the plot.
    fn figure(
        &self,
        [id, title, caption]: [&str; 3],
        axes: &[String; 2],
        colours: &[String],
        beside: &str,
    ) -> Figure {
        let whole = TOP + self.height() + BELOW;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {whole:.1}\" role=\"img\" aria-label=\"{}\" \
             font-family=\"DejaVu Sans, Verdana, Liberation Sans, Arial, sans-serif\" font-size=\"12\" fill=\"black\">",
            escaped(title)
        );
        svg += &self.faces(colours);
        svg += &self.axes(axes);
        svg += beside;
        svg += "</svg>";
        Figure { id: id.to_owned(), title: title.to_owned(), caption: caption.to_owned(), svg }
    }

    /// Place of a corner [px].
    fn pixel(&self, corner: &[f64; 2]) -> [f64; 2] {
        let [x, y] = [0, 1].map(|axis| {
            let [low, high] = self.ends[axis];
            (corner[axis] - low) / (high - low)
        });
        [LEFT + PLOT * x, TOP + self.height() * (1.0 - y)]
    }

    /// The faces, those of one colour as one path.
    fn faces(&self, colours: &[String]) -> String {
        let mut paths: BTreeMap<&String, String> = BTreeMap::new();
        for (shape, colour) in self.shapes.iter().zip(colours) {
            let path = paths.entry(colour).or_default();
            for (place, corner) in shape.outline.iter().enumerate() {
                let [x, y] = self.pixel(corner);
                // Writing to a text cannot fail.
                let _ = write!(path, "{}{x:.1} {y:.1}", if place == 0 { "M" } else { " " });
            }
            path.push('z');
        }
        let mut svg = "<g shape-rendering=\"crispEdges\">".to_owned();
        for (colour, path) in paths {
            svg += &format!("<path fill=\"{colour}\" d=\"{path}\"/>");
        }
        svg + "</g>"
    }

    fn axes(&self, labels: &[String; 2]) -> String {
        let (height, bottom) = (self.height(), TOP + self.height());
        let mut svg = format!(
            "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{PLOT}\" height=\"{height:.1}\" fill=\"none\" stroke=\"black\"/>"
        );
        let [across, up] = self.ends;
        for (share, text) in ticks(across[0], across[1], (PLOT / TICK[0]) as usize) {
            let x = LEFT + PLOT * share;
            svg += &format!("<path d=\"M{x:.1} {bottom:.1}v5\" stroke=\"black\"/>");
            svg += &format!(
                "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
                bottom + 18.0
            );
        }
        for (share, text) in ticks(up[0], up[1], (height / TICK[1]) as usize) {
            let y = bottom - height * share;
            svg += &format!("<path d=\"M{LEFT} {y:.1}h-5\" stroke=\"black\"/>");
            let (x, y) = (LEFT - 8.0, y + 4.0);
            svg += &format!("<text x=\"{x}\" y=\"{y:.1}\" text-anchor=\"end\">{text}</text>");
        }
        let (x, y) = (LEFT + 0.5 * PLOT, bottom + 38.0);
        svg += &format!("<text x=\"{x}\" y=\"{y:.1}\" text-anchor=\"middle\">{}</text>", labels[0]);
        let middle = TOP + 0.5 * height;
        svg + &format!(
            "<text transform=\"translate(13 {middle:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            labels[1]
        )
    }
}

/// An entry of a legend: a swatch and two lines.
fn entry(place: usize, colour: &str, [name, more]: &[String; 2]) -> String {
    let (swatch, x, y) = (BAR[0], BAR[0] + 18.0, TOP + 36.0 * place as f64);
    let (first, second) = (y + 10.0, y + 23.0);
    format!(
        "<rect x=\"{swatch}\" y=\"{y}\" width=\"12\" height=\"12\" fill=\"{colour}\" stroke=\"black\" stroke-width=\".5\"/>\
         <text x=\"{x}\" y=\"{first}\" font-size=\"10\">{name}</text>\
         <text x=\"{x}\" y=\"{second}\" font-size=\"10\">{more}</text>"
    )
}
