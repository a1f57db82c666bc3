//! Measured and predicted values over the settings, along a wall and by size.

use super::super::chart::Figure;
use super::super::diagnosis::fit::extends;
use super::super::diagnosis::plot::identifier;
use super::super::page::Page;
use super::series::{ModelValue, bars, draw, misfit, missed, models};
use super::setting::Placed;
use super::words;
use crate::dataset::RigQuantity;
use crate::diagnose::rig::{RigDiagnosis, RigRow};

/// Most figures.
const SETTING_FIGURES: usize = 8;
/// Fewest bins of a profile.
const PROFILE_BINS: usize = 3;

/// A figure with what decides whether it is shown.
struct RatedFigure {
    kind: &'static str,
    misfit: f64,
    figure: Figure,
}

/// The figures to show; a note about those that are not.
pub(super) fn figures(
    page: &mut Page,
    found: &RigDiagnosis,
    in_case: &dyn Fn(&str) -> Option<f64>,
) -> Vec<Figure> {
    let models = models(extends(&found.diagnosis));
    let bins = groups(found.readings.iter().filter(|row| bin(row).is_some()), profile_name);
    let (full, few): (Vec<_>, Vec<_>) = bins.into_iter().partition(|(_, rows)| rows.len() >= PROFILE_BINS);
    let mut all: Vec<RatedFigure> =
        full.iter().filter_map(|(name, rows)| profile(name, rows, &models)).collect();
    let single = found.readings.iter().filter(|row| bin(row).is_none());
    let single = single.chain(few.iter().flat_map(|(_, rows)| rows.iter().copied()));
    let columns = groups(single, |row| row.observable.clone());
    all.extend(columns.iter().filter_map(|(column, rows)| over_setting(column, rows, &models, in_case)));
    let drawn = all.len();
    let shown = chosen(all);
    if shown.is_empty() {
        page.text("No setting differs between the readings of one observable, so there is nothing to draw them over.");
        return shown;
    }
    if shown.len() < drawn {
        page.note(format!(
            "{} of {drawn} figures: for each kind of observable that with the largest misfit of the base model, then \
                the next ones. The table of all readings has the others.",
            shown.len()
        ));
    }
    shown
}

/// The worst figure of each kind, then the worst of the others, in the order of the data.
fn chosen(all: Vec<RatedFigure>) -> Vec<Figure> {
    let worst = |place: usize| {
        let one = &all[place];
        let same = all.iter().enumerate().filter(|(_, other)| other.kind == one.kind);
        !same.into_iter().any(|(other, candidate)| {
            candidate.misfit > one.misfit || (candidate.misfit == one.misfit && other < place)
        })
    };
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|&a, &b| worst(b).cmp(&worst(a)).then(all[b].misfit.total_cmp(&all[a].misfit)));
    order.truncate(SETTING_FIGURES);
    let shown = all.into_iter().enumerate().filter(|(place, _)| order.contains(place));
    shown.map(|(_, candidate)| candidate.figure).collect()
}

/// Readings by a name, in the order of the data.
fn groups<'a>(
    rows: impl Iterator<Item = &'a RigRow>,
    name: impl Fn(&RigRow) -> String,
) -> Vec<(String, Vec<&'a RigRow>)> {
    let mut all: Vec<(String, Vec<&RigRow>)> = Vec::new();
    for row in rows {
        let own = name(row);
        match all.iter_mut().find(|(known, _)| *known == own) {
            Some((_, rows)) => rows.push(row),
            None => all.push((own, vec![row])),
        }
    }
    all
}

fn kind(column: &str) -> &'static str {
    let quantity = column.split('@').next().and_then(RigQuantity::parse);
    quantity.map_or("", |quantity| quantity.kind())
}

fn over_setting(
    column: &str,
    rows: &[&RigRow],
    models: &[ModelValue],
    in_case: &dyn Fn(&str) -> Option<f64>,
) -> Option<RatedFigure> {
    let placed = Placed::new(rows, in_case);
    let over = placed.setting.as_deref().unwrap_or("the experiments");
    let (quantity, _) = words::axis(column);
    let title = format!("{}, over {over}", words::column(column));
    let chart = placed.axis()?.chart(&title, &format!("{quantity} [1]"));
    let chart = draw(chart, &placed, models, placed.alone)?;
    let what = match (&placed.setting, placed.alone) {
        (Some(setting), true) => format!(" over {setting}, the only setting that varies."),
        (Some(setting), false) => {
            format!(" over {setting}. Other settings vary as well, so the points need not lie on a line.")
        }
        _ => ", experiments side by side.".to_owned(),
    };
    let caption = format!("{} readings{what}{}{}", rows.len(), bars(rows), missed(rows, models));
    let figure = chart.figure(&format!("over-{}", identifier(column)), &caption);
    Some(RatedFigure { kind: kind(column), misfit: misfit(rows), figure })
}

/// The middle of a bin [m], and whether it is one of sizes.
fn bin(row: &RigRow) -> Option<(f64, bool)> {
    match RigQuantity::parse(row.observable.split('@').next()?)? {
        RigQuantity::CapturedAlong([from, to]) => Some((0.5 * (from + to), false)),
        RigQuantity::CapturedBySize([from, to]) => Some((0.5 * (from + to), true)),
        _ => None,
    }
}

/// What the bins of one profile share.
fn profile_name(row: &RigRow) -> String {
    let by_size = bin(row).is_some_and(|(_, by_size)| by_size);
    let wall = words::axis(&row.observable).1;
    format!("{} {wall} {}", if by_size { "size" } else { "along" }, row.experiment)
}

/// The mass along a wall or by size in one experiment.
fn profile(name: &str, rows: &[&RigRow], models: &[ModelValue]) -> Option<RatedFigure> {
    let first = rows.first()?;
    let (by_size, wall) = (bin(first)?.1, words::axis(&first.observable).1);
    let (over, place) =
        if by_size { ("by diameter", "diameter") } else { ("along the wall", "coordinate along the wall") };
    let middles = rows.iter().map(|row| bin(row).map_or(f64::NAN, |(middle, _)| middle));
    let placed = Placed::of_numbers(rows, place, "m", middles);
    let title = format!("Captured {over}, wall {wall}: {}", first.experiment);
    let chart = placed.axis()?.chart(&title, "captured in the bin / injected mass [1]");
    let chart = draw(chart, &placed, models, true)?;
    let caption = format!(
        "{} bins of experiment {}, at their middles; lines connect the bins.{}{}",
        rows.len(),
        first.experiment,
        bars(rows),
        missed(rows, models)
    );
    let figure = chart.figure(&format!("profile-{}", identifier(name)), &caption);
    Some(RatedFigure { kind: "captured", misfit: misfit(rows), figure })
}
