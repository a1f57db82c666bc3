//! Figures as SVG: points, lines, bands, histograms, bars and maps.
//!
//! Colours are Okabe and Ito's, told apart by the colour-blind; series also differ by marker and dash, so that a figure
//! survives a black-and-white printer. Maps use cividis, which is read the same with every kind of colour vision and
//! grows brighter evenly.

use kuva::plot::annotations::{Orientation, ReferenceLine};
use kuva::plot::line::LineStyle;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{BandPlot, BarPlot, ColorMap, Heatmap, Histogram, LinePlot, ScatterPlot};
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;

/// Okabe and Ito's colours in an order that keeps neighbours apart, black left for text.
const COLOURS: [&str; 7] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8A8A8A"];
/// Of single readings behind what is drawn over them: pale, but not lost on paper.
const CLOUD: &str = "#A6A6A6";
const MARKERS: [MarkerShape; 7] = [
    MarkerShape::Circle,
    MarkerShape::Square,
    MarkerShape::Triangle,
    MarkerShape::Diamond,
    MarkerShape::TriangleDown,
    MarkerShape::Cross,
    MarkerShape::Plus,
];
const DASHES: [(LineStyle, &str); 4] = [
    (LineStyle::Solid, ""),
    (LineStyle::Dashed, "8 4"),
    (LineStyle::DashDot, "8 4 2 4"),
    (LineStyle::Dotted, "2 4"),
];

const WIDTH: f64 = 620.0;
const HEIGHT: f64 = 370.0;
/// Letters that fit side by side under an x axis.
const WORDS_LETTERS: usize = 60;
/// Where a legend begins.
const LEGEND_LEFT: f64 = 60.0;

/// A picture with what a reader needs to understand it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Unique on its page, letters, digits and hyphens.
    pub id: String,
    /// A short heading.
    pub title: String,
    /// One or two sentences: what is shown, what to see.
    pub caption: String,
    /// The picture, without width and height: it takes the room it is given.
    pub svg: String,
}

impl Figure {
    fn new(id: &str, title: &str, caption: &str, plots: Vec<Plot>, layout: Layout, keys: &[Key]) -> Self {
        let svg = kuva::render_to_svg(plots, layout);
        Self {
            id: id.to_owned(),
            title: title.to_owned(),
            caption: caption.to_owned(),
            svg: embedded(&svg, id, title, keys),
        }
    }
}

/// One entry of a legend.
struct Key {
    name: String,
    colour: &'static str,
    sign: Sign,
}

/// What stands before a legend's entry.
#[derive(Clone, Copy)]
enum Sign {
    Marker(MarkerShape),
    /// A line with the gaps of an SVG dash array.
    Line(&'static str),
    Area,
}

impl Key {
    /// The sign at the left end of a row that has its middle at `y`.
    fn drawn(&self, x: f64, y: f64) -> String {
        let colour = self.colour;
        let shape = |path: String| format!("<path d=\"{path}\" fill=\"{colour}\"/>");
        let strokes = |path: String| format!("<path d=\"{path}\" stroke=\"{colour}\" stroke-width=\"2\"/>");
        let middle = x + 11.0;
        match self.sign {
            Sign::Area => {
                format!("<rect x=\"{x}\" y=\"{}\" width=\"22\" height=\"10\" fill=\"{colour}\"/>", y - 5.0)
            }
            Sign::Line(dashes) => format!(
                "<line x1=\"{x}\" y1=\"{y}\" x2=\"{}\" y2=\"{y}\" stroke=\"{colour}\" stroke-width=\"2\" \
                 stroke-dasharray=\"{dashes}\"/>",
                x + 24.0
            ),
            Sign::Marker(MarkerShape::Square) => shape(format!("M{} {}h8v8h-8z", middle - 4.0, y - 4.0)),
            Sign::Marker(MarkerShape::Triangle) => shape(format!("M{middle} {}l5 9h-10z", y - 5.0)),
            Sign::Marker(MarkerShape::TriangleDown) => shape(format!("M{middle} {}l5 -9h-10z", y + 5.0)),
            Sign::Marker(MarkerShape::Diamond) => shape(format!("M{middle} {}l5 5l-5 5l-5 -5z", y - 5.0)),
            Sign::Marker(MarkerShape::Cross) => {
                strokes(format!("M{} {}l8 8m0 -8l-8 8", middle - 4.0, y - 4.0))
            }
            Sign::Marker(MarkerShape::Plus) => strokes(format!("M{} {y}h10m-5 -5v10", middle - 5.0)),
            Sign::Marker(_) => format!("<circle cx=\"{middle}\" cy=\"{y}\" r=\"4.5\" fill=\"{colour}\"/>"),
        }
    }
}

/// A legend above the picture, entries side by side as far as they fit, and its height.
fn legend(keys: &[Key]) -> (String, f64) {
    const ROW: f64 = 20.0;
    let (mut x, mut row, mut text) = (LEGEND_LEFT, 0.0, String::new());
    for key in keys.iter().filter(|key| !key.name.is_empty()) {
        // The width of a character in the page's font, on average.
        let width = 30.0 + 7.6 * key.name.chars().count() as f64 + 22.0;
        if x > LEGEND_LEFT && x + width > WIDTH {
            (x, row) = (LEGEND_LEFT, row + 1.0);
        }
        let y = ROW * (row + 0.5);
        text += &key.drawn(x, y);
        text += &format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"13\">{}</text>",
            x + 30.0,
            y + 4.5,
            escaped(&key.name)
        );
        x += width;
    }
    let height = if text.is_empty() { 0.0 } else { ROW * (row + 1.0) + 4.0 };
    (text, height)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Makes an SVG fit into a page: scaled by a view box, labelled for screen readers, with ids of its own and a legend
/// above it.
fn embedded(svg: &str, id: &str, title: &str, keys: &[Key]) -> String {
    let svg = unnumbered(svg, id);
    let Some((head, body)) = svg.split_once('>') else { return svg };
    let size = |key: &str| {
        let text = head.split_once(&format!(" {key}=\"")).and_then(|(_, rest)| rest.split('"').next());
        text.and_then(|text| text.parse::<f64>().ok())
    };
    let (Some(width), Some(height)) = (size("width"), size("height")) else { return svg };
    let family = "font-family=\"DejaVu Sans, Verdana, Liberation Sans, Arial, sans-serif\"";
    let label = escaped(title);
    let (legend, above) = legend(keys);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {}\" role=\"img\" aria-label=\"{label}\" \
         {family} fill=\"black\">{legend}<g transform=\"translate(0 {above})\">{}</g></svg>",
        height + above,
        body.trim_end().trim_end_matches("</svg>").replacen(
            "<rect width=\"100%\" height=\"100%\" fill=\"white\" />",
            "",
            1
        )
    )
}

/// The plotting crate numbers its clip paths through a whole program; here they are named after the figure, so that
/// the same figure is the same text every time.
fn unnumbered(svg: &str, id: &str) -> String {
    const MARK: &str = "kuva-clip-";
    let mut parts = svg.split(MARK);
    let mut text = parts.next().unwrap_or_default().to_owned();
    let mut seen: Vec<&str> = Vec::new();
    for part in parts {
        let digits = part.len() - part.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (number, rest) = part.split_at(digits);
        let place = seen.iter().position(|earlier| *earlier == number).unwrap_or_else(|| {
            seen.push(number);
            seen.len() - 1
        });
        text += &format!("{id}-clip-{place}{rest}");
    }
    text
}

/// How far a point may be off, below and above.
pub type Errors = Vec<(f64, f64)>;

/// A figure with two number axes; series are added one after the other and get their colours in turn.
pub struct Chart {
    title: String,
    x_label: String,
    y_label: String,
    plots: Vec<Plot>,
    colours: usize,
    keys: Vec<Key>,
    x_range: Option<[f64; 2]>,
    y_range: Option<[f64; 2]>,
    y_step: Option<f64>,
    log: [bool; 2],
    words: Vec<String>,
    lines: Vec<ReferenceLine>,
}

impl Chart {
    /// An empty chart; axis labels carry their units.
    pub fn new(title: &str, x_label: &str, y_label: &str) -> Self {
        Self {
            title: title.to_owned(),
            x_label: x_label.to_owned(),
            y_label: y_label.to_owned(),
            plots: Vec::new(),
            colours: 0,
            keys: Vec::new(),
            x_range: None,
            y_range: None,
            y_step: None,
            log: [false; 2],
            words: Vec::new(),
            lines: Vec::new(),
        }
    }

    /// Words along the x axis instead of numbers; the first stands at 1, the next at 2.
    #[must_use]
    pub fn words(mut self, words: &[String]) -> Self {
        self.words = words.to_vec();
        self
    }

    /// Fixes the ends of the x axis.
    #[must_use]
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.x_range = ends([low, high]);
        self
    }

    /// Fixes the ends of the y axis.
    #[must_use]
    pub fn y_range(mut self, low: f64, high: f64) -> Self {
        self.y_range = ends([low, high]);
        self
    }

    /// Fixes the distance of the ticks of the y axis.
    #[must_use]
    pub fn y_step(mut self, step: f64) -> Self {
        self.y_step = Some(step);
        self
    }

    /// A logarithmic x axis.
    #[must_use]
    pub fn log_x(mut self) -> Self {
        self.log[0] = true;
        self
    }

    /// A logarithmic y axis.
    #[must_use]
    pub fn log_y(mut self) -> Self {
        self.log[1] = true;
        self
    }

    /// Points; one without a name is not in the legend.
    #[must_use]
    pub fn points(mut self, name: &str, points: &[[f64; 2]]) -> Self {
        let plot = self.scatter(name, points);
        self.plots.push(plot.into());
        self
    }

    /// Small pale points for single readings; what is drawn after them lies on top.
    #[must_use]
    pub fn cloud(mut self, name: &str, points: &[[f64; 2]]) -> Self {
        let points = finite(points);
        let plot = ScatterPlot::new()
            .with_data(points.iter().map(|p| (p[0], p[1])))
            .with_color(CLOUD)
            .with_size(if points.len() > 500 { 1.5 } else { 2.0 });
        self.keys.push(Key { name: name.to_owned(), colour: CLOUD, sign: Sign::Marker(MarkerShape::Circle) });
        self.plots.push(plot.into());
        self
    }

    /// Large points to compare with; what is drawn after them lies on top.
    #[must_use]
    pub fn reference(mut self, name: &str, points: &[[f64; 2]]) -> Self {
        let plot = self.scatter(name, points).with_size(8.0);
        self.plots.push(plot.into());
        self
    }

    /// Points with error bars.
    #[must_use]
    pub fn points_with_errors(mut self, name: &str, points: &[[f64; 2]], errors: &Errors) -> Self {
        let both = points.iter().zip(errors);
        let drawn = both.filter_map(|(point, (below, above))| {
            all_drawable([point[0], point[1], point[1] - below, point[1] + above])?;
            Some((*point, (*below, *above)))
        });
        let (points, errors): (Vec<[f64; 2]>, Errors) = drawn.unzip();
        let plot = self.scatter(name, &points).with_y_err_asymmetric(errors);
        self.plots.push(plot.into());
        self
    }

    /// A line through points in their order.
    #[must_use]
    pub fn line(mut self, name: &str, points: &[[f64; 2]]) -> Self {
        let points = finite(points);
        let (colour, place) = self.next();
        let (style, dashes) = DASHES[place % DASHES.len()].clone();
        self.keys.push(Key { name: name.to_owned(), colour, sign: Sign::Line(dashes) });
        let plot = LinePlot::new()
            .with_data(points.iter().map(|p| (p[0], p[1])))
            .with_color(colour)
            .with_stroke_width(2.0)
            .with_line_style(style);
        self.plots.push(plot.into());
        self
    }

    /// A shaded band between two curves, in the colour that the next series will have.
    #[must_use]
    pub fn band(mut self, x: &[f64], low: &[f64], high: &[f64]) -> Self {
        let colour = COLOURS[self.colours % COLOURS.len()];
        let edges =
            x.iter().zip(low).zip(high).filter_map(|((x, low), high)| all_drawable([*x, *low, *high]));
        let edges: Vec<[f64; 3]> = edges.collect();
        let [x, low, high] = [0, 1, 2].map(|side| edges.iter().map(|edge| edge[side]).collect::<Vec<f64>>());
        let band = BandPlot::new(x, low, high);
        self.plots.push(band.with_color(colour).with_opacity(0.2).into());
        self
    }

    /// Bars of a histogram between `edges`, one more than `heights`; further ones are drawn as stairs over the first.
    #[must_use]
    pub fn histogram(mut self, name: &str, edges: &[f64], heights: &[f64]) -> Self {
        if self.colours > 0 {
            return self.line(name, &stairs(edges, heights));
        }
        if edges.iter().any(|edge| drawable(*edge).is_none()) {
            return self;
        }
        let (colour, _) = self.next();
        self.keys.push(Key { name: name.to_owned(), colour, sign: Sign::Area });
        if let (None, [low, .., high]) = (self.x_range, edges) {
            self.x_range = ends([*low, *high]);
        }
        let heights = heights.iter().map(|height| drawable(*height).unwrap_or(0.0)).collect();
        let plot = Histogram::from_bins(edges.to_vec(), heights).with_color(colour);
        self.plots.push(plot.into());
        self
    }

    /// A histogram as an outline, which several series and a logarithmic axis take.
    #[must_use]
    pub fn stairs(self, name: &str, edges: &[f64], heights: &[f64]) -> Self {
        self.line(name, &stairs(edges, heights))
    }

    /// A thin vertical line with a label.
    #[must_use]
    pub fn mark_x(mut self, x: f64, label: &str) -> Self {
        self.lines.extend(drawable(x).map(|x| reference(Orientation::Vertical, x, label)));
        self
    }

    /// A thin horizontal line with a label.
    #[must_use]
    pub fn mark_y(mut self, y: f64, label: &str) -> Self {
        self.lines.extend(drawable(y).map(|y| reference(Orientation::Horizontal, y, label)));
        self
    }

    /// The figure; `id` is its name on the page.
    pub fn figure(mut self, id: &str, caption: &str) -> Figure {
        if self.plots.is_empty() {
            self.plots.push(ScatterPlot::new().with_data(vec![(0.0, 0.0)]).with_size(0.0).into());
        }
        let mut layout = Layout::auto_from_plots(&self.plots)
            .with_x_label(self.x_label)
            .with_y_label(self.y_label)
            .with_tick_format(ticks())
            .with_width(WIDTH)
            .with_height(HEIGHT);
        if let Some([low, high]) = self.x_range {
            let step = round_step((high - low) / 6.0);
            let (low, high) = ((low / step).floor() * step, (high / step - 1e-9).ceil() * step);
            layout = layout.with_x_axis_min(low).with_x_axis_max(high).with_x_tick_step(step);
        }
        if !self.words.is_empty() {
            let last = self.words.len() as f64 + 0.5;
            layout = layout.with_x_axis_min(0.5).with_x_axis_max(last);
            // Level words lie side by side as far as there is room.
            let letters: usize = self.words.iter().map(|word| word.chars().count() + 2).sum();
            if letters > WORDS_LETTERS {
                layout = layout.with_x_tick_rotate(-40.0);
            }
            layout = layout.with_x_categories(self.words);
        }
        if let Some([low, high]) = self.y_range {
            layout = layout.with_y_axis_min(low).with_y_axis_max(high);
        }
        if let Some(step) = self.y_step {
            layout = layout.with_y_tick_step(step);
        }
        if self.log[0] {
            layout = layout.with_log_x();
        }
        if self.log[1] {
            layout = layout.with_log_y();
        }
        layout = self.lines.into_iter().fold(layout, Layout::with_reference_line);
        Figure::new(id, &self.title, caption, self.plots, layout, &self.keys)
    }

    fn scatter(&mut self, name: &str, points: &[[f64; 2]]) -> ScatterPlot {
        let points = finite(points);
        let (colour, place) = self.next();
        let size = if points.len() > 500 { 1.5 } else { 4.0 };
        let marker = MARKERS[place % MARKERS.len()];
        self.keys.push(Key { name: name.to_owned(), colour, sign: Sign::Marker(marker) });
        ScatterPlot::new()
            .with_data(points.iter().map(|p| (p[0], p[1])))
            .with_color(colour)
            .with_size(size)
            .with_marker(marker)
    }

    fn next(&mut self) -> (&'static str, usize) {
        let place = self.colours;
        self.colours += 1;
        (COLOURS[place % COLOURS.len()], place)
    }
}

/// Numbers beyond the first cannot be drawn, and those within the second are zero on any axis: steps, ranges and powers of
/// the plotting crate's axes would overflow, and a tick for each power up to infinity fill the memory.
const FARTHEST: f64 = 1e100;
const NEAREST: f64 = 1e-100;

/// The number as it can be drawn.
fn drawable(value: f64) -> Option<f64> {
    match value.abs() {
        size if size < NEAREST => Some(0.0),
        size => (size <= FARTHEST).then_some(value),
    }
}

/// What can be drawn of some numbers that belong together: all or nothing.
fn all_drawable<const N: usize>(values: [f64; N]) -> Option<[f64; N]> {
    let drawn = values.map(drawable);
    drawn.iter().all(Option::is_some).then(|| drawn.map(Option::unwrap_or_default))
}

/// The points that can be drawn.
fn finite(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().copied().filter_map(all_drawable).collect()
}

/// The ends of an axis, where they can be.
fn ends([low, high]: [f64; 2]) -> Option<[f64; 2]> {
    all_drawable([low, high]).filter(|[low, high]| low < high)
}

/// Short numbers on the axes.
fn ticks() -> TickFormat {
    TickFormat::Custom(std::sync::Arc::new(|value: f64| {
        // What rounding leaves of a zero.
        if value.abs() < 1e-14 { "0".to_owned() } else { super::page::number(value) }
    }))
}

/// Edges of about `count` bins that hold `low` to `high`, at round numbers.
pub fn round_edges(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = round_step((high - low).max(1e-300) / count.max(1) as f64);
    let (from, to) = ((low / step).floor(), (high / step).ceil());
    let bins = ((to - from) as usize).clamp(1, 10_000);
    (0..=bins).map(|i| (from + i as f64) * step).collect()
}

/// The next of 1, 2, 2.5, 5, 10 times a power of ten.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let digit = step / power;
    [1.0, 2.0, 2.5, 5.0].into_iter().find(|round| digit <= round * (1.0 + 1e-9)).unwrap_or(10.0) * power
}

/// The outline of a histogram.
fn stairs(edges: &[f64], heights: &[f64]) -> Vec<[f64; 2]> {
    let mut line: Vec<[f64; 2]> = edges.first().map(|first| [*first, 0.0]).into_iter().collect();
    for (pair, height) in edges.windows(2).zip(heights) {
        line.extend([[pair[0], *height], [pair[1], *height]]);
    }
    line.extend(edges.last().map(|last| [*last, 0.0]));
    line
}

fn reference(orientation: Orientation, value: f64, label: &str) -> ReferenceLine {
    let line = match orientation {
        Orientation::Horizontal => ReferenceLine::horizontal(value),
        Orientation::Vertical => ReferenceLine::vertical(value),
    };
    line.with_color("#444444").with_label(label)
}

/// Bars over named categories, one or several series side by side or on top of each other.
pub struct Bars {
    title: String,
    y_label: String,
    categories: Vec<String>,
    series: Vec<(String, Vec<f64>)>,
    stacked: bool,
}

impl Bars {
    /// Bars without a series yet; the label of the axis carries its unit.
    pub fn new(title: &str, y_label: &str, categories: &[String]) -> Self {
        Self {
            title: title.to_owned(),
            y_label: y_label.to_owned(),
            categories: categories.to_vec(),
            series: Vec::new(),
            stacked: false,
        }
    }

    /// Adds a series: one value a category.
    #[must_use]
    pub fn series(mut self, name: &str, values: &[f64]) -> Self {
        self.series.push((name.to_owned(), values.to_vec()));
        self
    }

    /// Puts the series on top of each other.
    #[must_use]
    pub fn stacked(mut self) -> Self {
        self.stacked = true;
        self
    }

    /// The figure; `id` is its name on the page.
    pub fn figure(self, id: &str, caption: &str) -> Figure {
        let mut plot = BarPlot::new();
        for (index, category) in self.categories.iter().enumerate() {
            let value = |values: &Vec<f64>| values.get(index).copied().and_then(drawable).unwrap_or(0.0);
            let bars = self.series.iter().zip(COLOURS.iter().cycle());
            let bars: Vec<(f64, &str)> = bars.map(|((_, values), colour)| (value(values), *colour)).collect();
            plot = plot.with_group(category.clone(), bars);
        }
        if self.stacked {
            plot = plot.with_stacked();
        }
        let plots = vec![Plot::Bar(plot)];
        let layout = Layout::auto_from_plots(&plots)
            .with_y_label(self.y_label)
            .with_tick_format(ticks())
            .with_width(WIDTH)
            .with_height(HEIGHT)
            .with_y_axis_min(0.0);
        let keys = self.series.into_iter().zip(COLOURS.into_iter().cycle());
        let keys: Vec<Key> = keys.map(|((name, _), colour)| Key { name, colour, sign: Sign::Area }).collect();
        Figure::new(id, &self.title, caption, plots, layout, &keys)
    }
}

/// A map: a quantity over two coordinates, as coloured cells.
pub struct FigureMap {
    title: String,
    x_label: String,
    y_label: String,
    x: [f64; 2],
    y: [f64; 2],
    cells: Vec<Vec<f64>>,
}

impl FigureMap {
    /// Sums weighted points up in `columns` by `rows` cells over the given ranges; points outside are left out.
    pub fn of_points(
        title: &str,
        [x_label, y_label]: [&str; 2],
        [x, y]: [[f64; 2]; 2],
        [columns, rows]: [usize; 2],
        points: impl Iterator<Item = ([f64; 2], f64)>,
    ) -> Self {
        let mut cells = vec![vec![0.0; columns]; rows];
        let place = |value: f64, [low, high]: [f64; 2], count: usize| {
            let share = (value - low) / (high - low);
            (0.0..=1.0).contains(&share).then(|| ((share * count as f64) as usize).min(count - 1))
        };
        for ([a, b], weight) in points {
            if let (Some(column), Some(row)) = (place(a, x, columns), place(b, y, rows)) {
                cells[row][column] += weight;
            }
        }
        Self {
            title: title.to_owned(),
            x_label: x_label.to_owned(),
            y_label: y_label.to_owned(),
            x,
            y,
            cells,
        }
    }

    /// Every cell divided by its area: points per area, mass per area.
    #[must_use]
    pub fn per_area(mut self) -> Self {
        let columns = self.cells.first().map_or(1, Vec::len);
        let area = (self.x[1] - self.x[0]) * (self.y[1] - self.y[0]) / (columns * self.cells.len()) as f64;
        self.cells.iter_mut().flatten().for_each(|cell| *cell /= area);
        self
    }

    /// The figure; `id` is its name on the page. `quantity` names what the colours mean, with its unit.
    pub fn figure(self, id: &str, quantity: &str, caption: &str) -> Figure {
        let plot = Heatmap::new()
            .with_data(self.cells)
            .with_x_range(self.x[0], self.x[1])
            .with_y_range(self.y[0], self.y[1])
            .with_cell_size(1.0)
            .with_color_map(ColorMap::Cividis);
        let plots = vec![Plot::Heatmap(plot)];
        let layout = Layout::auto_from_plots(&plots)
            .with_x_label(self.x_label)
            .with_y_label(self.y_label)
            .with_width(WIDTH)
            .with_height(HEIGHT)
            .with_clamp_axis()
            .with_colorbar_tick_format(ticks())
            .with_tick_format(ticks());
        let title = format!("{}: {quantity}", self.title);
        Figure::new(id, &title, caption, plots, layout, &[])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_figure_is_the_same_text() {
        let draw = || {
            let chart =
                Chart::new("t < u", "x [m]", "y [1]").line("a", &[[0.0, 1.0], [1.0, f64::NAN], [2.0, 3.0]]);
            chart.points("b", &[[1.0, 2.0]]).mark_x(1.5, "here").figure("one", "c")
        };
        let (first, second) = (draw(), draw());
        assert_eq!(first, second);
        assert!(first.svg.starts_with("<svg xmlns"), "{}", first.svg);
        assert!(
            first.svg.contains("viewBox=\"0 0 620 394\"") && first.svg.contains("aria-label=\"t &lt; u\"")
        );
        assert!(first.svg.contains("id=\"one-clip-0\"") && !first.svg.contains("kuva-clip"));
        assert!(first.svg.contains("x [m]") && first.svg.contains("here"));
    }

    /// The plotting crate would look for a tick at each power of ten up to infinity.
    #[test]
    fn numbers_beyond_any_axis_are_left_out() {
        let far = [[1.7e308, 1.0], [1.0, -1.7e308], [5e-324, 2.0], [3.0, 4.0]];
        let chart = Chart::new("t", "x", "y").points_with_errors("p", &far, &vec![(1e300, 0.0); 4]);
        let chart = chart.line("l", &far).band(&[1.0, 1e200], &[0.0; 2], &[1.0; 2]).mark_x(f64::NAN, "n");
        let chart = chart.histogram("h", &[0.0, 1e300], &[1.0]).x_range(2.0, 2.0).y_range(-1e300, 1e300);
        for svg in [
            chart.log_x().figure("f", "").svg,
            Bars::new("t", "y", &["a".into()]).series("s", &[1e300]).figure("b", "").svg,
        ] {
            assert!(svg.contains("</svg>") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }

    #[test]
    fn words_stand_along_the_axis() {
        let words = ["Ann".to_owned(), "Bob".to_owned()];
        let chart = Chart::new("t", "who", "y [1]").words(&words).cloud("rows", &[[1.0, 2.0], [2.0, 3.0]]);
        let svg = chart.figure("w", "").svg;
        assert!(svg.contains(">Ann<") && svg.contains(">Bob<") && svg.contains(CLOUD), "{svg}");
    }

    #[test]
    fn maps_sum_up_weights_per_area() {
        let points = [([0.1, 0.1], 2.0), ([0.2, 0.3], 1.0), ([1.9, 0.9], 4.0), ([5.0, 0.0], 9.0)];
        let map = FigureMap::of_points(
            "m",
            ["x [m]", "y [m]"],
            [[0.0, 2.0], [0.0, 1.0]],
            [2, 1],
            points.into_iter(),
        );
        assert_eq!(map.per_area().cells, [[3.0, 4.0]]);
    }

    #[test]
    fn empty_charts_and_bars_are_drawn() {
        assert!(Chart::new("t", "x", "y").figure("e", "").svg.contains("</svg>"));
        let bars = Bars::new("t", "mass [kg]", &["a".into(), "b".into()]).series("s", &[1.0]).stacked();
        assert!(bars.figure("b", "").svg.contains("mass [kg]"));
    }
}
