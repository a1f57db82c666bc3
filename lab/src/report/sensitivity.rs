//! The page of a sensitivity: for each wall what it captures at both ends of the range of each number, and a table.

use super::{Chart, Figure, Page, RowStatus, Table, number, percent};
use crate::rig::sensitivity::{NumberEffect, Quality, Sensitivity};

/// Numbers in a figure and in the table.
const SHOWN_NUMBERS: usize = 15;
const LISTED_NUMBERS: usize = 60;

/// Makes the page.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(found: &Sensitivity) -> Result<String, askama::Error> {
    let mut page = Page::new(&format!("{}: which numbers matter", found.title));
    page.lead(
        "Each number was moved to the low and to the high end of its range, one at a time and with the same random numbers. \
         The numbers are ranked by the largest change of the captured share of the injected mass at any wall.",
    );
    let walls = found.numbers.first().map_or(&[][..], |first| &first.walls);
    page.figures((0..walls.len()).filter_map(|wall| figure(found, wall)));
    page.heading("The numbers");
    let (table, status) = table(found);
    page.marked(table, status);
    let none: Vec<&str> = found
        .numbers
        .iter()
        .filter(|effect| effect.largest == 0.0)
        .map(|effect| effect.key.as_str())
        .collect();
    if !none.is_empty() {
        page.text(format!("Without any effect: {}.", none.join(", ")));
    }
    for note in &found.notes {
        page.note(note.clone());
    }
    page.foot(&format!("{} particles.", found.particles));
    page.html()
}

/// The numbers that change something, by rank, with the status of each.
fn table(found: &Sensitivity) -> (Table, Vec<RowStatus>) {
    let rows: Vec<(usize, &NumberEffect)> = found
        .numbers
        .iter()
        .enumerate()
        .filter(|(_, effect)| effect.largest > 0.0)
        .take(LISTED_NUMBERS)
        .collect();
    let mut header =
        ["rank", "number", "range", "source", "low", "value", "high"].map(str::to_owned).to_vec();
    let walls = found.numbers.first().map_or(&[][..], |first| &first.walls);
    header.extend(walls.iter().map(|wall| format!("captured at {}: low, as it is, high", wall.wall)));
    let cells = |(rank, effect): &(usize, &NumberEffect)| {
        let mut cells = vec![(rank + 1).to_string(), effect.key.clone(), effect.range.clone()];
        cells.push(effect.source.clone().unwrap_or_else(|| "none given".to_owned()));
        cells.extend([effect.low, effect.value, effect.high].map(number));
        cells.extend(effect.walls.iter().map(|wall| {
            let shares = [wall.captured_low, wall.captured, wall.captured_high].map(percent);
            shares.join(", ")
        }));
        cells
    };
    let status = rows.iter().map(|(_, effect)| match effect.quality {
        Quality::Assumed => RowStatus::Watch,
        Quality::Sourced | Quality::Stated => RowStatus::Good,
    });
    let table = Table {
        caption: "Marked: an assumed number, whose range is assumed too. For a table or a list the ends are a factor or a \
                  difference that applies to all its values."
            .to_owned(),
        header,
        rows: rows.iter().map(cells).collect(),
        text_columns: 4,
    };
    (table, status.collect())
}

/// Captured share at both ends of the ranges, by rank.
fn figure(found: &Sensitivity, wall: usize) -> Option<Figure> {
    let shown = &found.numbers[..found.numbers.len().min(SHOWN_NUMBERS)];
    let base = shown.first()?.walls.get(wall)?;
    let of = |share: fn(&crate::rig::sensitivity::WallEffect) -> f64| -> Vec<[f64; 2]> {
        let point = |(rank, effect): (usize, &NumberEffect)| {
            Some([(rank + 1) as f64, 100.0 * share(effect.walls.get(wall)?)])
        };
        shown.iter().enumerate().filter_map(point).collect()
    };
    let chart = Chart::new(&base.wall, "rank of the number", "captured [%]")
        .points("number at its low end", &of(|wall| wall.captured_low))
        .points("at its high end", &of(|wall| wall.captured_high))
        .mark_y(100.0 * base.captured, "as it is");
    Some(chart.figure(
        &format!("sensitivity-{wall}"),
        "Captured share of the injected mass; the table names the ranks.",
    ))
}
