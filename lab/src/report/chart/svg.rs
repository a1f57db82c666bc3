//! Figures: the SVG of the plotting crate, made fit for a page.

use kuva::plot::legend::{LegendEntry, LegendPosition};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

/// Size of a drawing [px]: small enough that its letters are legible on a telephone, where it is scaled to 370 px.
const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 310.0;
/// Size of the labels of axes [px].
const LABEL: u32 = 12;
/// From the plot to the edge inside which marks are drawn [px]: a mark at the end of an axis is whole.
const OVERHANG: f64 = 6.0;
/// Colours of the plotting crate that a page replaces by its own (`page.html`), by their names. Colours of data are
/// never named.
const PAGE_COLOURS: [(&str, &str); 4] =
    [("#000000", "black"), ("#cccccc", "lightgray"), ("#a6a6a6", "darkgray"), ("#444444", "dimgray")];
/// Height of a row of the legend [px].
const LEGEND_ROW: f64 = 18.0;
/// Width of a letter of the legend, on average [px].
const LETTER: f64 = 6.6;

/// An SVG with a title and a caption.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Unique on its page; letters, digits and hyphens.
    pub id: String,
    /// A short heading.
    pub title: String,
    /// What the figure shows, in one to three sentences.
    pub caption: String,
    /// The SVG without width and height, so that it fills the width of its column.
    pub svg: String,
}

impl Figure {
    pub(super) fn new(
        [id, title, caption]: [&str; 3],
        plots: Vec<Plot>,
        layout: Layout,
        legend: Vec<LegendEntry>,
    ) -> Self {
        let (width, height) = (layout.width.unwrap_or(WIDTH), layout.height.unwrap_or(HEIGHT));
        let widest = legend.iter().map(|entry| entry.label.chars().count()).max().unwrap_or(0);
        let columns = ((width - 100.0) / (45.0 + LETTER * widest as f64)).floor().max(1.0);
        let rows = (legend.len() as f64 / columns).ceil();
        let layout = layout
            .with_width(width)
            .with_height(height + LEGEND_ROW * rows)
            .with_label_size(LABEL)
            .with_legend_position(LegendPosition::OutsideBottomColumns)
            .with_legend_box(false)
            .with_legend_col_limit(columns as usize);
        let layout = if legend.is_empty() { layout } else { layout.with_legend_entries(legend) };
        let svg = embedded(&kuva::render_to_svg(plots, layout), id, title);
        Self { id: id.to_owned(), title: title.to_owned(), caption: caption.to_owned(), svg }
    }
}

/// Makes an SVG fit for a page: scaled by a view box, labelled for screen readers, without a background.
fn embedded(svg: &str, id: &str, title: &str) -> String {
    let svg = with_own_ids(svg, id);
    let Some((head, body)) = svg.split_once('>') else { return svg };
    let size = |key: &str| {
        let (_, rest) = head.split_once(&format!(" {key}=\""))?;
        rest.split('"').next()
    };
    let (Some(width), Some(height)) = (size("width"), size("height")) else { return svg };
    let label = escaped(title);
    let body = body.replacen("<rect width=\"100%\" height=\"100%\" fill=\"white\" />", "", 1);
    let body =
        PAGE_COLOURS.iter().fold(with_wide_clips(&body), |body, (number, name)| body.replace(number, name));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} \
            {height}\" role=\"img\" aria-label=\"{label}\" font-family=\"DejaVu Sans, Verdana, Liberation Sans, \
            Arial, sans-serif\" fill=\"black\">{body}"
    )
}

/// A text as it may stand in an attribute.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Widens clip paths, which the plotting crate draws along the axes.
fn with_wide_clips(svg: &str) -> String {
    const HEAD: &str = "\"><rect ";
    let mut parts = svg.split("<clipPath ");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        text += "<clipPath ";
        let wide = part.split_once(HEAD).and_then(|(before, rest)| {
            let (rect, after) = rest.split_once("/>")?;
            let side = |key: &str| -> Option<f64> {
                rect.split_once(&format!("{key}=\""))?.1.split('"').next()?.parse().ok()
            };
            let [x, y] = [side("x")? - OVERHANG, side("y")? - OVERHANG];
            let [width, height] = [side("width")? + 2.0 * OVERHANG, side("height")? + 2.0 * OVERHANG];
            let rect = format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"");
            Some(format!("{before}{HEAD}{rect}/>{after}"))
        });
        text += wide.as_deref().unwrap_or(part);
    }
    text
}

/// Names clip paths after the figure. The plotting crate numbers them through a whole program, but
/// the same figure has to be the same text every time.
fn with_own_ids(svg: &str, id: &str) -> String {
    let mut parts = svg.split("kuva-clip-");
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
