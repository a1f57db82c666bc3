//! The page of a sensitivity: for each wall what it captures at both ends of the range of each number, and a table.

use super::chart::{TornadoRow, tornado};
use super::format::{shown_unit, span, with_unit};
use super::{Figure, Page, RowStatus, Table, number, percent};
use crate::rig::sensitivity::{NumberEffect, NumberScale, Quality, Sensitivity};

/// Numbers in a figure and in the table.
const SHOWN_NUMBERS: usize = 15;
const LISTED_NUMBERS: usize = 60;
/// A bar is drawn from this share of the largest change on [1].
const LEAST_SHOWN: f64 = 0.01;

/// Makes the page.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(found: &Sensitivity) -> Result<String, askama::Error> {
    let mut page = Page::new(&format!("{}: which numbers matter", found.title));
    page.lead(
        "Each number was moved to the low and to the high end of its range, one at a time and with the same random \
         numbers. A bar shows how far that changes what a wall captures; the table ranks all numbers by their largest \
         change at any wall.",
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
        .map(|effect| effect.name.as_str())
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
    let walls = found.numbers.first().map_or(&[][..], |first| &first.walls);
    let captured = walls.iter().map(|wall| format!("captured at {}: low, as it is, high", wall.wall));
    let before = ["rank", "number", "unit", "low", "value", "high"].map(str::to_owned);
    let after = ["range", "key", "source"].map(str::to_owned);
    let header = before.into_iter().chain(captured).chain(after).collect();
    let cells = |(rank, effect): &(usize, &NumberEffect)| {
        let (factor, unit) = shown(effect);
        let mut cells = vec![(rank + 1).to_string(), effect.name.clone(), unit];
        cells.extend([effect.low, effect.value, effect.high].map(|value| number(factor * value)));
        cells.extend(effect.walls.iter().map(|wall| {
            let shares = [wall.captured_low, wall.captured, wall.captured_high].map(percent);
            shares.join(", ")
        }));
        let source = effect.source.clone().unwrap_or_else(|| "none given".to_owned());
        cells.extend([effect.range.clone(), effect.key.clone(), source]);
        cells
    };
    let status = rows.iter().map(|(_, effect)| match effect.quality {
        Quality::Assumed => RowStatus::Watch,
        Quality::Sourced | Quality::Stated => RowStatus::Good,
    });
    let table = Table {
        caption:
            "Orange: number and range are assumed. Green: one of them is stated, see range and source. × and + stand \
            before a factor and a difference that apply to all values of a table or a list."
                .to_owned(),
        header,
        rows: rows.iter().map(cells).collect(),
        text_columns: 3,
    };
    (table, status.collect())
}

/// How value and ends of a number are shown: a factor, and the unit.
fn shown(effect: &NumberEffect) -> (f64, String) {
    match effect.scale {
        NumberScale::Value => shown_unit(effect.unit, effect.high),
        NumberScale::Factor => (1.0, "×".to_owned()),
        NumberScale::Difference => (1.0, format!("+ {}", effect.unit)),
    }
}

/// A number with its range.
fn named(effect: &NumberEffect) -> String {
    let ends = [effect.low, effect.high];
    let range = match effect.scale {
        NumberScale::Value => span(ends, effect.unit),
        NumberScale::Factor => format!("× {}, all values", span(ends, "")),
        NumberScale::Difference => format!("{}, added to all values", span(ends, effect.unit)),
    };
    format!("{}: {range}", effect.name)
}

/// What a wall captures at both ends of the ranges of the numbers that change it most, the largest change first.
fn figure(found: &Sensitivity, wall: usize) -> Option<Figure> {
    let of_wall = |effect: &'_ NumberEffect| effect.walls.get(wall).map_or(0.0, |on_wall| on_wall.change);
    let mut numbers: Vec<&NumberEffect> = found.numbers.iter().collect();
    numbers.sort_by(|a, b| of_wall(b).total_cmp(&of_wall(a)));
    let first = *numbers.first()?;
    let base = first.walls.get(wall)?;
    numbers.retain(|effect| of_wall(effect) > 0.0 && of_wall(effect) >= LEAST_SHOWN * of_wall(first));
    let row = |effect: &NumberEffect| {
        let on_wall = effect.walls.get(wall)?;
        let results = [on_wall.captured_low, on_wall.captured_high];
        let ends = ends(effect);
        let said = |side: usize| format!("{}: {} captured", ends[side], percent(results[side]));
        let ends = [said(0), said(1)];
        Some(TornadoRow { name: named(effect), results: results.map(|share| 100.0 * share), ends })
    };
    let rows = numbers.into_iter().take(SHOWN_NUMBERS).filter_map(row).collect();
    let title = format!("Captured at {}", base.wall);
    let caption = format!(
        "Share of the injected mass, of {} particles; the numbers that change it most, the largest change first.",
        found.particles
    );
    let texts = [&format!("sensitivity-{wall}"), &title, &caption, "captured [% of the injected mass]"];
    tornado(texts, 100.0 * base.captured, rows)
}

/// Both ends of a number in words.
fn ends(effect: &NumberEffect) -> [String; 2] {
    [effect.low, effect.high].map(|end| match effect.scale {
        NumberScale::Value => format!("{} {}", effect.name, with_unit(end, effect.unit)),
        NumberScale::Factor => format!("{} × {}", effect.name, number(end)),
        NumberScale::Difference => format!("{} + {}", effect.name, with_unit(end, effect.unit)),
    })
}
