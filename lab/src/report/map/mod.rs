//! The page of a map: restitution, capture and regime over two inputs, and a slider over a third one.

mod panel;

use super::chart::{ColourScale, Figure, regime_colour, round_edges};
use super::format::{REGIME_NAMES, listed, percent, span, with_unit};
use super::page::{Page, Table};
use crate::map::{Cell, InputAxis, Map, MapSeries};
use nearwall::impact::Regime;
use panel::{Fill, Panel};

/// The page of a map of the model in the file `file`.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(map: &MapSeries, file: &str) -> Result<String, askama::Error> {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let mut page = Page::new(&format!("Map of {name}"));
    let wall = map.maps.first().map_or("", |map| &map.wall);
    let inputs: Vec<String> = map.axes().into_iter().map(range).collect();
    page.lead(format!(
        "What the model decides on the wall {wall} over {}: {} impacts.",
        listed(&inputs, "and"),
        map.count()
    ));
    for note in notes(map) {
        page.text(note);
    }
    add_figures(&mut page, map);
    let row = |(input, value): (&nearwall::impact::Input, f64)| {
        vec![input.name.to_owned(), with_unit(value, input.unit), input.about.replace('`', "")]
    };
    let mut table = Table::new(
        "Inputs that are the same in all impacts.",
        3,
        &["input", "value", ""],
        map.fixed_inputs().into_iter().map(row).collect(),
    );
    table.header[2] = "meaning".to_owned();
    page.heading("Other inputs");
    page.table(table);
    page.note(
        "What the model file puts on the wall (layer, film, coverage) holds where the input is smaller.",
    );
    page.foot(&format!("Made from {file}. The numbers are in map.csv."));
    page.html()
}

/// Four pictures of a map, or of each map of a series.
fn add_figures(page: &mut Page, map: &MapSeries) {
    let scales = [0, 1].map(|which| restitution_scale(map, which));
    let figures = |place: usize, map: &Map| {
        let ids = ["regime", "p-stick", "e-n", "e-t"].map(|id| format!("{id}-{place}"));
        let [regime, p_stick, e_n, e_t] = &ids;
        let rebound = |which: usize, id: &str| restitution(map, which, id, &scales[which]);
        vec![regimes(map, regime), capture(map, p_stick), rebound(0, e_n), rebound(1, e_t)]
    };
    let Some(third) = &map.third else {
        return page.figures(map.maps.first().into_iter().flat_map(|map| figures(0, map)));
    };
    let heading = |value: Option<f64>| {
        let (name, unit) = (panel::name(third), third.input().unit);
        value.map_or(String::new(), |value| format!("{name} = {}", with_unit(value, unit)))
    };
    let steps = map.by_value().enumerate();
    page.steps(steps.map(|(place, (value, map))| (heading(value), figures(place, map))).collect());
}

/// An axis in words: name and range.
fn range(axis: &InputAxis) -> String {
    let spacing = if axis.is_logarithmic() { ", evenly spaced in the logarithm" } else { "" };
    format!("{} ({}{spacing})", axis.input().name, span(axis.ends(), axis.input().unit))
}

/// What a reader has to know about the numbers.
fn notes(map: &MapSeries) -> Vec<String> {
    let mut notes = Vec::new();
    if let Some(Map { draws, .. }) = map.maps.first().filter(|map| map.draws > 1) {
        notes.push(format!("Effects of the model are random: every value is the mean over {draws} draws."));
    }
    let (undecided, all) = (map.undecided(), map.count());
    if let Some(reason) = map.first_refusal() {
        notes.push(format!(
            "{undecided} of {all} impacts could not be decided and are blank. The first: {reason}."
        ));
    }
    for (number, line) in map.ranges().lines("impacts").into_iter().enumerate() {
        let hatched = if number == 0 { "; those are hatched" } else { "" };
        notes.push(format!("{line}{hatched}."));
    }
    notes
}

fn regimes(map: &Map, id: &str) -> Figure {
    let decided = map.cells.iter().flatten().count().max(1) as f64;
    let share = |regime: Regime| {
        map.cells.iter().flatten().filter(|cell| cell.regime == regime).count() as f64 / decided
    };
    let fills = fills(map, |cell| Some(regime_colour(cell.regime).to_owned()));
    let shares = Regime::ALL.into_iter().filter(|regime| share(*regime) > 0.0);
    let legend: Vec<(&str, [String; 2])> = shares
        .map(|regime| (regime_colour(regime), [regime.name().to_owned(), percent(share(regime))]))
        .collect();
    let caption = format!(
        "{REGIME_NAMES} Of the share of the wall that an impact more probably meets (bare or covered). Per cent: \
            share of this map."
    );
    let panel = Panel::new(map, id, "Regime", fills, &caption);
    panel
        .with_areas(&map.cells.iter().map(|cell| cell.map(|cell| cell.regime)).collect::<Vec<_>>())
        .figure(&legend, None)
}

fn capture(map: &Map, id: &str) -> Figure {
    let scale = ColourScale::new(0.0, 1.0);
    let fills = fills(map, |cell| Some(scale.colour(cell.sticking_probability)));
    let caption = "Probability of capture, of bare and covered share of the wall together.";
    Panel::new(map, id, "Sticking probability p_stick [1]", fills, caption).figure(&[], Some(&scale))
}

/// The colours of `e_n` (0) or `e_t` (1), the same in all maps.
fn restitution_scale(map: &MapSeries, which: usize) -> ColourScale {
    let cells = map.maps.iter().flat_map(|map| map.cells.iter().flatten());
    let values = cells.filter_map(|cell| Some(cell.restitution?[which]));
    let [low, high] = values.fold([0.0_f64, 0.0], |[low, high], value| [low.min(value), high.max(value)]);
    let edges = round_edges(low, high.max(low + 0.1), 5);
    ColourScale::new(edges[0], edges[edges.len() - 1])
}

/// The map of `e_n` (0) or `e_t` (1).
fn restitution(map: &Map, which: usize, id: &str, scale: &ColourScale) -> Figure {
    let fills = fills(map, |cell| cell.restitution.map(|pair| scale.colour(pair[which])));
    let title = ["Normal restitution e_n [1]", "Tangential restitution e_t [1]"][which];
    let caption = "Mean of the particles that rebound, of the share of the wall that an impact more probably meets \
        (bare or covered). Grey: no particle rebounds.";
    Panel::new(map, id, title, fills, caption).figure(&[], Some(scale))
}

/// The fill of every cell: its colour, grey without one, none where undecided.
fn fills(map: &Map, colour: impl Fn(&Cell) -> Option<String>) -> Vec<Fill> {
    let fill = |cell: &Option<Cell>| match cell {
        None => Fill::Undecided,
        Some(cell) => colour(cell).map_or(Fill::NoRebound, Fill::Colour),
    };
    map.cells.iter().map(fill).collect()
}
