//! Tornado: what a result becomes at both ends of the range of each quantity.

use std::fmt::Write;

use super::super::format::number;
use super::COLOURS;
use super::axis::{all_drawable, round_edges};
use super::plane::{swatch, text_at};
use super::scale::ticks;
use super::svg::{Figure, escaped};

/// Width of the drawing, of which the plot takes all but the margins [px].
const WIDTH: f64 = 480.0;
const MARGIN: f64 = 18.0;
/// Height above the rows, of a row, of each of its two bars, and of the axis below [px].
const HEAD: f64 = 42.0;
const ROW: f64 = 36.0;
const BAR: f64 = 7.0;
const AXIS: f64 = 48.0;

/// A quantity: its name with its range, and what the result becomes at the low and the high end, with each in words.
pub(in crate::report) struct TornadoRow {
    pub name: String,
    pub results: [f64; 2],
    pub ends: [String; 2],
}

/// The figure of rows about the result `middle` of unchanged quantities; `None` without a row that can be drawn.
pub(in crate::report) fn tornado(
    [id, title, caption, label]: [&str; 4],
    middle: f64,
    mut rows: Vec<TornadoRow>,
) -> Option<Figure> {
    rows.retain(|row| all_drawable(row.results).is_some());
    let all = rows.iter().flat_map(|row| row.results).chain([middle]);
    let [low, high] =
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    if low >= high {
        return None;
    }
    let edges = round_edges(low, high, 6);
    let [low, high] = [edges[0], edges[edges.len() - 1]];
    let at = |value: f64| MARGIN + (WIDTH - 2.0 * MARGIN) * (value - low) / (high - low);
    let bottom = HEAD + ROW * rows.len() as f64;
    let mut svg = legend() + &axis([low, high], bottom, label);
    let x = at(middle);
    svg += &format!("<path d=\"M{x:.1} {HEAD}V{bottom:.1}\" stroke=\"dimgray\" stroke-dasharray=\"4 3\"/>");
    for (place, row) in rows.iter().enumerate() {
        svg += &bars(row, HEAD + ROW * place as f64, at(middle), &at);
    }
    let anchor = match x / WIDTH {
        share if share > 0.7 => "end",
        share if share < 0.3 => "start",
        _ => "middle",
    };
    svg += &text_at([x, HEAD - 5.0], anchor, &format!("as it is: {}", number(middle)));
    let svg = drawing(title, bottom + AXIS, &svg);
    let [id, title, caption] = [id, title, caption].map(str::to_owned);
    Some(Figure { id, title, caption, svg })
}

/// The drawing of a height [px].
fn drawing(title: &str, height: f64, body: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.1}\" role=\"img\" aria-label=\"{}\" \
         font-family=\"DejaVu Sans, Verdana, Liberation Sans, Arial, sans-serif\" font-size=\"11\" \
         fill=\"black\">{body}</svg>",
        escaped(title)
    )
}

/// What both colours mean.
fn legend() -> String {
    swatch(COLOURS[0], [MARGIN, 4.0], &["at the low end of the range"])
        + &swatch(COLOURS[1], [0.5 * WIDTH, 4.0], &["at the high end"])
}

/// Grid lines, numbers and the label under the rows.
fn axis([low, high]: [f64; 2], bottom: f64, label: &str) -> String {
    let mut svg = String::new();
    for (share, number) in ticks(low, high, 6) {
        let x = MARGIN + (WIDTH - 2.0 * MARGIN) * share;
        // Writing to a text cannot fail.
        let _ = write!(svg, "<path d=\"M{x:.1} {HEAD}V{:.1}\" stroke=\"lightgray\"/>", bottom + 4.0);
        svg += &text_at([x, bottom + 18.0], "middle", &number);
    }
    svg + &text_at([0.5 * WIDTH, bottom + 38.0], "middle", label)
}

/// The name of a quantity over its two bars from the middle; a bar tells its numbers under the pointer.
fn bars(row: &TornadoRow, top: f64, middle: f64, at: &dyn Fn(f64) -> f64) -> String {
    // A white edge keeps the name legible on the lines behind it.
    let mut svg = format!(
        "<g stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\">{}</g>",
        text_at([MARGIN, top + 14.0], "start", &escaped(&row.name))
    );
    for (side, (result, end)) in row.results.iter().zip(&row.ends).enumerate() {
        let (left, right) = (at(*result).min(middle), at(*result).max(middle));
        let y = top + 18.0 + BAR * side as f64;
        let _ = write!(
            svg,
            "<rect x=\"{left:.1}\" y=\"{y}\" width=\"{:.1}\" height=\"{BAR}\" fill=\"{}\"><title>{}</title></rect>",
            right - left,
            COLOURS[side],
            escaped(end)
        );
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(name: &str, results: [f64; 2]) -> TornadoRow {
        TornadoRow { name: name.to_owned(), results, ends: ["low".to_owned(), "high".to_owned()] }
    }

    /// By hand: 0 to 100 on 444 px from 18; 25 is at 129, 50 at 240, 100 at 462.
    #[test]
    fn rows_keep_their_order_and_bars_end_where_their_results_are() {
        let rows =
            vec![row("wi<de", [0.0, 100.0]), row("lost", [f64::NAN, 1.0]), row("narrow", [50.0, 60.0])];
        let svg = tornado(["id", "t", "c", "captured [%]"], 50.0, rows).unwrap().svg;
        assert!(
            svg.find("wi&lt;de").unwrap() < svg.find("narrow").unwrap() && !svg.contains("lost"),
            "{svg}"
        );
        assert!(svg.contains("<rect x=\"18.0\" y=\"60\" width=\"222.0\""), "{svg}");
        assert!(svg.contains("<rect x=\"240.0\" y=\"67\" width=\"222.0\""), "{svg}");
        assert!(svg.contains("<rect x=\"240.0\" y=\"103\" width=\"44.4\""), "{svg}");
        assert!(tornado(["id", "t", "c", "x"], 1.0, vec![row("nothing", [1.0, 1.0])]).is_none());
    }
}
