//! Charts as SVG: points, lines, bands and histograms over two axes; bars; tornados; maps.
//!
//! Colours are those of Okabe and Ito, which colour-blind readers can tell apart; series also
//! differ by marker and dash, so that a figure survives a black-and-white printer.

mod axis;
mod bars;
mod plane;
mod scale;
mod svg;
mod tornado;

use kuva::plot::annotations::ReferenceLine;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::plot::line::LineStyle;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{BandPlot, Histogram, LinePlot, ScatterPlot};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

use axis::{all_drawable, drawable, ends, finite, round_step, tick_format};

pub use axis::round_edges;
pub use bars::BarChart;
pub(super) use plane::{COLUMN_WIDTH, LabelledAxis, PlanePicture, hatching, swatch, text_at};
pub(super) use scale::{ColourScale, NO_VALUE, Palette, regime_colour};
pub use svg::Figure;
pub(super) use tornado::{TornadoRow, tornado};

/// Okabe and Ito's colours in an order that keeps neighbours apart; black is left for text.
const COLOURS: [&str; 7] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8A8A8A"];
/// Colour of single readings behind other series: pale, but visible on paper.
const CLOUD: &str = "#a6a6a6";
const MARKER_SHAPES: [MarkerShape; 7] = [
    MarkerShape::Circle,
    MarkerShape::Square,
    MarkerShape::Triangle,
    MarkerShape::Diamond,
    MarkerShape::TriangleDown,
    MarkerShape::Cross,
    MarkerShape::Plus,
];
/// Gaps of lines, short enough to be seen in the legend: two each of three walls of a case.
const DASHES: [&str; 6] = ["", "5 2", "7 2 2 2", "2 2", "4 1", "6 2 2 2 2 2"];
/// Letters that fit side by side under an x axis.
const WORDS_LETTERS: usize = 46;

/// Length of each point's error bar below and above it.
pub type ErrorBars = Vec<(f64, f64)>;

/// Colour and form of markers.
type MarkerStyle = (&'static str, MarkerShape);

/// An entry of the legend; `None` for a series without a name.
fn legend_entry(name: &str, colour: &str, shape: LegendShape) -> Option<LegendEntry> {
    let entry = || LegendEntry { label: name.to_owned(), color: colour.to_owned(), shape, dasharray: None };
    (!name.is_empty()).then(entry)
}

/// A chart with two number axes. Series are drawn in the order in which they are added and get their colours in turn.
#[derive(Default)]
pub struct Chart {
    title: String,
    labels: [String; 2],
    plots: Vec<Plot>,
    colours: usize,
    legend: Vec<LegendEntry>,
    x_range: Option<[f64; 2]>,
    y_range: Option<[f64; 2]>,
    y_step: Option<f64>,
    log: [bool; 2],
    words: Vec<String>,
    lines: Vec<ReferenceLine>,
    panel: bool,
    /// Gaps of the next line, if not those of its place.
    dash: Option<usize>,
    /// Shown numbers of the x axis over those of the data.
    x_factor: Option<f64>,
}

impl Chart {
    /// An empty chart; axis labels carry their units.
    pub fn new(title: &str, x_label: &str, y_label: &str) -> Self {
        Self { title: title.to_owned(), labels: [x_label, y_label].map(str::to_owned), ..Self::default() }
    }

    /// Makes the figure smaller: one of several side by side.
    #[must_use]
    pub fn panel(mut self) -> Self {
        self.panel = true;
        self
    }

    /// Puts words along the x axis instead of numbers, the first at 1, the next at 2.
    #[must_use]
    pub fn words(mut self, words: &[String]) -> Self {
        self.words = words.to_vec();
        self
    }

    /// Fixes the ends of the x axis.
    #[must_use]
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.x_range = ends(low, high);
        self
    }

    /// Fixes the ends of the y axis.
    #[must_use]
    pub fn y_range(mut self, low: f64, high: f64) -> Self {
        self.y_range = ends(low, high);
        self
    }

    /// Fixes the distance of the ticks of the y axis.
    #[must_use]
    pub fn y_step(mut self, step: f64) -> Self {
        self.y_step = Some(step);
        self
    }

    /// Makes the x axis logarithmic.
    #[must_use]
    pub fn log_x(mut self) -> Self {
        self.log[0] = true;
        self
    }

    /// Makes the y axis logarithmic.
    #[must_use]
    pub fn log_y(mut self) -> Self {
        self.log[1] = true;
        self
    }

    /// Gives the next series the colour of this place, so that one thing has one colour in all figures.
    #[must_use]
    pub fn coloured(mut self, place: usize) -> Self {
        self.colours = place;
        self
    }

    /// The same with the gaps of this place for a line, so that lines of one colour differ.
    #[must_use]
    pub fn dashed(mut self, colour: usize, dash: usize) -> Self {
        self.dash = Some(dash);
        self.coloured(colour)
    }

    /// Shows the numbers along the x axis in a unit of which a shown number is this many SI ones.
    #[must_use]
    pub fn x_factor(mut self, factor: f64) -> Self {
        self.x_factor = Some(factor);
        self
    }

    /// Adds points. A series without a name is not in the legend.
    #[must_use]
    pub fn points(mut self, name: &str, points: &[[f64; 2]]) -> Self {
        let style = self.next_marker();
        self.scatter(name, finite(points), style, [4.0, 1.5], None)
    }

    /// Adds small pale points for single readings.
    #[must_use]
    pub fn cloud(self, name: &str, points: &[[f64; 2]]) -> Self {
        self.scatter(name, finite(points), (CLOUD, MarkerShape::Circle), [2.0, 1.5], None)
    }

    /// Adds large points to compare with.
    #[must_use]
    pub fn reference(mut self, name: &str, points: &[[f64; 2]]) -> Self {
        let style = self.next_marker();
        self.scatter(name, finite(points), style, [8.0; 2], None)
    }

    /// Adds points with error bars.
    #[must_use]
    pub fn points_with_errors(mut self, name: &str, points: &[[f64; 2]], errors: &ErrorBars) -> Self {
        let style = self.next_marker();
        self.error_bars(name, points, errors, style)
    }

    /// Adds measured values with error bars, in black.
    #[must_use]
    pub fn measured(self, name: &str, points: &[[f64; 2]], errors: &ErrorBars) -> Self {
        self.error_bars(name, points, errors, ("#000000", MarkerShape::Circle))
    }

    /// Adds published values, black as measured ones are, large enough to be seen behind others.
    #[must_use]
    pub fn published(self, name: &str, points: &[[f64; 2]]) -> Self {
        self.scatter(name, finite(points), ("#000000", MarkerShape::Circle), [6.0; 2], None)
    }

    /// Adds a line through points in their order.
    #[must_use]
    pub fn line(mut self, name: &str, points: &[[f64; 2]]) -> Self {
        let (colour, place) = self.next();
        let dash = self.dash.take().unwrap_or(place);
        let dashes = Some(DASHES[dash % DASHES.len()].to_owned()).filter(|dashes| !dashes.is_empty());
        let style = dashes.clone().map_or(LineStyle::Solid, LineStyle::Custom);
        let entry = legend_entry(name, colour, LegendShape::Line);
        self.legend.extend(entry.map(|entry| LegendEntry { dasharray: dashes, ..entry }));
        let plot = LinePlot::new()
            .with_data(finite(points).into_iter().map(|[x, y]| (x, y)))
            .with_color(colour)
            .with_stroke_width(2.0)
            .with_line_style(style);
        self.plots.push(plot.into());
        self
    }

    /// Adds a shaded band between two curves, in the colour that the next series will have.
    #[must_use]
    pub fn band(mut self, x: &[f64], low: &[f64], high: &[f64]) -> Self {
        let colour = COLOURS[self.colours % COLOURS.len()];
        let edges = x.iter().zip(low).zip(high);
        let edges: Vec<[f64; 3]> =
            edges.filter_map(|((x, low), high)| all_drawable([*x, *low, *high])).collect();
        let [x, low, high] = [0, 1, 2].map(|side| edges.iter().map(|edge| edge[side]).collect::<Vec<f64>>());
        let band = BandPlot::new(x, low, high);
        self.plots.push(band.with_color(colour).with_opacity(0.2).into());
        self
    }

    /// Adds the bars of a histogram between `edges`, one more than `heights`; after another series as an outline.
    #[must_use]
    pub fn histogram(mut self, name: &str, edges: &[f64], heights: &[f64]) -> Self {
        if self.plots.iter().any(|plot| matches!(plot, Plot::Histogram(_))) {
            return self.stairs(name, edges, heights);
        }
        if edges.iter().any(|edge| drawable(*edge).is_none()) {
            return self;
        }
        let (colour, _) = self.next();
        self.area(name, colour, edges, heights)
    }

    /// Adds the bars of several histograms in these colours, each on top of those before it.
    #[must_use]
    pub fn stacked(self, edges: &[f64], series: &[(&str, &str, &[f64])]) -> Self {
        let mut sums = vec![0.0; edges.len().saturating_sub(1)];
        let mut tops = Vec::new();
        for (name, colour, heights) in series {
            sums.iter_mut().zip(*heights).for_each(|(sum, height)| *sum += height);
            tops.push((name, colour, sums.clone()));
        }
        // The highest first, behind the others; the legend names them in their order.
        let mut chart = tops
            .into_iter()
            .rev()
            .fold(self, |chart, (_, colour, tops)| chart.area("", colour, edges, &tops));
        let entry = |(name, colour, _): &(&str, &str, &[f64])| legend_entry(name, colour, LegendShape::Rect);
        chart.legend.extend(series.iter().filter_map(entry));
        chart
    }

    /// Adds bars between `edges`.
    fn area(mut self, name: &str, colour: &str, edges: &[f64], heights: &[f64]) -> Self {
        self.legend.extend(legend_entry(name, colour, LegendShape::Rect));
        if let (None, [low, .., high]) = (self.x_range, edges) {
            self.x_range = ends(*low, *high);
        }
        let heights = heights.iter().map(|height| drawable(*height).unwrap_or(0.0)).collect();
        self.plots.push(Histogram::from_bins(edges.to_vec(), heights).with_color(colour).into());
        self
    }

    /// Adds a histogram as an outline, for several series or a logarithmic axis.
    #[must_use]
    pub fn stairs(self, name: &str, edges: &[f64], heights: &[f64]) -> Self {
        let mut line: Vec<[f64; 2]> = edges.first().map(|first| [*first, 0.0]).into_iter().collect();
        for (pair, height) in edges.windows(2).zip(heights) {
            line.extend([[pair[0], *height], [pair[1], *height]]);
        }
        line.extend(edges.last().map(|last| [*last, 0.0]));
        self.line(name, &line)
    }

    /// Adds a thin vertical line with a label.
    #[must_use]
    pub fn mark_x(mut self, x: f64, label: &str) -> Self {
        self.lines.extend(drawable(x).map(ReferenceLine::vertical).map(|line| line.with_label(label)));
        self
    }

    /// Adds a thin horizontal line with a label.
    #[must_use]
    pub fn mark_y(mut self, y: f64, label: &str) -> Self {
        self.lines.extend(drawable(y).map(ReferenceLine::horizontal).map(|line| line.with_label(label)));
        self
    }

    /// The figure; `id` is its name on the page.
    pub fn figure(mut self, id: &str, caption: &str) -> Figure {
        if self.plots.is_empty() {
            self.plots.push(ScatterPlot::new().with_data(vec![(0.0, 0.0)]).with_size(0.0).into());
        }
        let [x_label, y_label] = self.labels;
        let mut layout = Layout::auto_from_plots(&self.plots).with_x_label(x_label).with_y_label(y_label);
        if let Some([low, high]) = self.x_range {
            let step = round_step((high - low) / 6.0);
            let (low, high) = ((low / step).floor() * step, (high / step - 1e-9).ceil() * step);
            layout = layout.with_x_axis_min(low).with_x_axis_max(high).with_x_tick_step(step);
        }
        if !self.words.is_empty() {
            let letters: usize = self.words.iter().map(|word| word.chars().count() + 2).sum();
            if letters > WORDS_LETTERS {
                layout = layout.with_x_tick_rotate(-40.0);
            }
            let end = self.words.len() as f64 + 0.5;
            layout = layout.with_x_axis_min(0.5).with_x_axis_max(end).with_x_categories(self.words);
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
        layout = layout.with_tick_format(tick_format(1.0));
        if let Some(factor) = self.x_factor {
            layout = layout.with_x_tick_format(tick_format(factor));
        }
        let lines = self.lines.into_iter().map(|line| line.with_color("#444444"));
        layout = lines.fold(layout, Layout::with_reference_line);
        let layout = if self.panel { layout.with_width(420.0).with_height(300.0) } else { layout };
        Figure::new([id, &self.title, caption], self.plots, layout, self.legend)
    }

    fn error_bars(self, name: &str, points: &[[f64; 2]], errors: &ErrorBars, style: MarkerStyle) -> Self {
        let both = points.iter().zip(errors);
        let drawn =
            both.filter(|([x, y], (below, above))| all_drawable([*x, *y, y - below, y + above]).is_some());
        let (points, errors) = drawn.unzip();
        self.scatter(name, points, style, [4.0, 1.5], Some(errors))
    }

    /// Adds points that can be drawn; the radii of their markers [px] are those of up to 500 points and of more.
    fn scatter(
        mut self,
        name: &str,
        points: Vec<[f64; 2]>,
        (colour, marker): MarkerStyle,
        [few, many]: [f64; 2],
        errors: Option<ErrorBars>,
    ) -> Self {
        self.legend.extend(legend_entry(name, colour, LegendShape::Marker(marker)));
        let size = if points.len() > 500 { many } else { few };
        let plot = ScatterPlot::new().with_data(points.into_iter().map(|[x, y]| (x, y)));
        let plot = plot.with_color(colour).with_marker(marker).with_size(size);
        self.plots.push(match errors {
            Some(errors) => plot.with_y_err_asymmetric(errors).into(),
            None => plot.into(),
        });
        self
    }

    fn next_marker(&mut self) -> MarkerStyle {
        let (colour, place) = self.next();
        (colour, MARKER_SHAPES[place % MARKER_SHAPES.len()])
    }

    fn next(&mut self) -> (&'static str, usize) {
        let place = self.colours;
        self.colours += 1;
        (COLOURS[place % COLOURS.len()], place)
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
            first.svg.contains("viewBox=\"0 0 480 328\"") && first.svg.contains("aria-label=\"t &lt; u\"")
        );
        assert!(first.svg.contains("id=\"one-clip-0\"") && !first.svg.contains("kuva-clip"));
        // The page colours what is named.
        assert!(first.svg.contains("\"black\"") && !first.svg.contains("#000000"), "{}", first.svg);
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
            BarChart::new("t", "y", &["a".into()]).series("s", &[1e300]).figure("b", "").svg,
        ] {
            assert!(svg.contains("</svg>") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }

    #[test]
    fn words_stand_along_the_axis() {
        let words = ["Ann".to_owned(), "Bob".to_owned()];
        let chart = Chart::new("t", "who", "y [1]").words(&words).cloud("rows", &[[1.0, 2.0], [2.0, 3.0]]);
        let svg = chart.figure("w", "").svg;
        assert!(svg.contains(">Ann<") && svg.contains(">Bob<") && svg.contains("darkgray"), "{svg}");
    }

    #[test]
    fn empty_charts_and_bars_are_drawn() {
        assert!(Chart::new("t", "x", "y").figure("e", "").svg.contains("</svg>"));
        let bars = BarChart::new("t", "mass [kg]", &["a".into(), "b".into()]).series("s", &[1.0]).stacked();
        assert!(bars.figure("b", "").svg.contains("mass [kg]"));
    }
}
