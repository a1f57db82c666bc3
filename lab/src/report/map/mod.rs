//! The page of a map: restitution, capture and regime over two inputs.

mod panel;

use super::chart::{ColourScale, Figure, regime_colour, round_edges};
use super::format::{REGIME_NAMES, number, percent, with_unit};
use super::page::{Page, Table};
use crate::map::{Cell, InputAxis, Map};
use nearwall::impact::Regime;
use panel::{Fill, Panel};

/// The page of a map of the model in the file `file`.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(map: &Map, file: &str) -> Result<String, askama::Error> {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let mut page = Page::new(&format!("Map of {name}"));
    page.lead(format!(
        "What the model decides on the wall {} over {} and {}: {} impacts.",
        map.wall,
        range(&map.x),
        range(&map.y),
        map.cells.len()
    ));
    for note in notes(map) {
        page.text(note);
    }
    page.figures([regimes(map), capture(map), restitution(map, 0), restitution(map, 1)]);
    let fixed = map.fixed_inputs();
    let row = |(input, value): (&nearwall::impact::Input, f64)| {
        vec![input.name.to_owned(), with_unit(value, input.unit), input.about.replace('`', "")]
    };
    let mut table = Table::new(
        "Inputs that are the same in all impacts.",
        3,
        &["input", "value", ""],
        fixed.map(row).collect(),
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

/// An axis in words: name and range.
fn range(axis: &InputAxis) -> String {
    let [low, high] = axis.ends();
    let spacing = if axis.is_logarithmic() { ", evenly spaced in the logarithm" } else { "" };
    format!("{} ({} to {}{spacing})", axis.input().name, number(low), with_unit(high, axis.input().unit))
}

/// What a reader has to know about the numbers.
fn notes(map: &Map) -> Vec<String> {
    let mut notes = Vec::new();
    if map.draws > 1 {
        notes.push(format!(
            "Effects of the model are random: every value is the mean over {} draws.",
            map.draws
        ));
    }
    let (undecided, all) = (map.undecided(), map.cells.len());
    if let Some(reason) = &map.first_refusal {
        notes.push(format!(
            "{undecided} of {all} impacts could not be decided and are blank. The first: {reason}."
        ));
    }
    for (number, line) in map.ranges.lines("impacts").into_iter().enumerate() {
        let hatched = if number == 0 { "; those are hatched" } else { "" };
        notes.push(format!("{line}{hatched}."));
    }
    notes
}

fn regimes(map: &Map) -> Figure {
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
        "{REGIME_NAMES} Of the share of the wall that an impact more probably meets (bare or covered). Per cent: share of \
         this map."
    );
    let panel = Panel::new(map, "regime", "Regime", fills, &caption);
    panel
        .with_areas(&map.cells.iter().map(|cell| cell.map(|cell| cell.regime)).collect::<Vec<_>>())
        .figure(&legend, None)
}

fn capture(map: &Map) -> Figure {
    let scale = ColourScale::new(0.0, 1.0);
    let fills = fills(map, |cell| Some(scale.colour(cell.sticking_probability)));
    let caption = "Probability of capture, of bare and covered share of the wall together.";
    Panel::new(map, "p-stick", "Sticking probability p_stick [1]", fills, caption).figure(&[], Some(&scale))
}

/// The map of `e_n` (0) or `e_t` (1).
fn restitution(map: &Map, which: usize) -> Figure {
    let values = map.cells.iter().flatten().filter_map(|cell| Some(cell.restitution?[which]));
    let [low, high] = values.fold([0.0_f64, 0.0], |[low, high], value| [low.min(value), high.max(value)]);
    let edges = round_edges(low, high.max(low + 0.1), 5);
    let scale = ColourScale::new(edges[0], edges[edges.len() - 1]);
    let fills = fills(map, |cell| cell.restitution.map(|pair| scale.colour(pair[which])));
    let [id, title] =
        [["e-n", "Normal restitution e_n [1]"], ["e-t", "Tangential restitution e_t [1]"]][which];
    let caption = "Mean of the particles that rebound, of the share of the wall that an impact more probably meets (bare or \
        covered). Grey: no particle rebounds.";
    Panel::new(map, id, title, fills, caption).figure(&[], Some(&scale))
}

/// The fill of every cell: its colour, grey without one, none where undecided.
fn fills(map: &Map, colour: impl Fn(&Cell) -> Option<String>) -> Vec<Fill> {
    let fill = |cell: &Option<Cell>| match cell {
        None => Fill::Undecided,
        Some(cell) => colour(cell).map_or(Fill::NoRebound, Fill::Colour),
    };
    map.cells.iter().map(fill).collect()
}
