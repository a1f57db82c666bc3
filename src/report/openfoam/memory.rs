//! What the walls remember: `postProcessing/nearWallInteraction/<cloud>/<start time>/<patch>.wall.dat`, and its figures.

use std::path::Path;

use super::tables::{Balance, rows, value};
use super::{CloudResult, time_folders};
use crate::report::{Chart, Figure};

/// What lay on one patch, over time: rows of names and values, in the order of time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WallHistory {
    /// Name of the patch.
    pub patch: String,
    /// As in the table.
    pub rows: Vec<Balance>,
}

impl WallHistory {
    /// A column over time; at most a few hundred places, as many as a reader can see, with the last one.
    fn line(&self, column: &str) -> Vec<[f64; 2]> {
        let stride = self.rows.len().div_ceil(300).max(1);
        let shown = self.rows.iter().step_by(stride).chain(self.rows.last());
        shown.filter_map(|row| Some([value(row, "time_s")?, value(row, column)?])).collect()
    }

    fn last(&self, column: &str) -> f64 {
        self.rows.last().and_then(|row| value(row, column)).unwrap_or(0.0)
    }

    fn is_something(&self) -> bool {
        self.last("initial_kg") + self.last("arrived_kg") > 0.0
    }
}

/// The histories of a cloud's patches; where a run was started again from an earlier time, the later start counts.
pub(super) fn read_all(case: &Path, cloud: &str) -> Vec<WallHistory> {
    let mut histories: Vec<WallHistory> = Vec::new();
    for (_, start) in time_folders(&case.join("postProcessing/nearWallInteraction").join(cloud)) {
        let entries = std::fs::read_dir(&start).into_iter().flatten().flatten();
        let mut tables: Vec<_> = entries.map(|entry| entry.path()).collect();
        tables.sort();
        for path in tables {
            let name = path.file_name().and_then(|name| name.to_str());
            let Some(patch) = name.and_then(|name| name.strip_suffix(".wall.dat")) else { continue };
            let rows = rows(&std::fs::read_to_string(&path).unwrap_or_default());
            let Some(first) = rows.first().and_then(|row| value(row, "time_s")) else { continue };
            let index = histories.iter().position(|history| history.patch == patch).unwrap_or_else(|| {
                histories.push(WallHistory { patch: patch.to_owned(), rows: Vec::new() });
                histories.len() - 1
            });
            let history = &mut histories[index].rows;
            history.retain(|row| value(row, "time_s").is_some_and(|time| time < first));
            history.extend(rows);
        }
    }
    histories
}

/// The figures of all cases whose walls remember something.
pub(super) fn figures<'a>(each: impl Iterator<Item = (&'a String, &'a CloudResult)>) -> Vec<Figure> {
    let each = each.flat_map(|(label, result)| result.memory.iter().map(move |history| (label, history)));
    let walls: Vec<(&String, &WallHistory)> = each.filter(|(_, history)| history.is_something()).collect();
    if walls.is_empty() {
        return Vec::new();
    }
    let mut figures: Vec<Figure> =
        walls.iter().enumerate().map(|(index, (label, history))| deposit(index, label, history)).collect();
    let over_time = |title: &str, y_label: &str, column: &str| {
        let chart = Chart::new(title, "time [s]", y_label);
        walls.iter().fold(chart, |chart, (label, history)| {
            let patch = &history.patch;
            chart
                .line(
                    &format!("{label}: {patch}, mean"),
                    &history.line(&format!("{column}_mean{}", unit(column))),
                )
                .line(
                    &format!("{label}: {patch}, most"),
                    &history.line(&format!("{column}_max{}", unit(column))),
                )
        })
    };
    figures.push(over_time("Share of the wall that powder covers", "coverage [1]", "coverage").figure(
        "wall-coverage",
        "Mean over the area of the patch, and the face that is covered most. What is covered is not sticky.",
    ));
    figures.push(over_time("Powder on the wall", "thickness of the layer [m]", "layer_thickness").figure(
        "wall-layer",
        "Mean over the area of the patch, and the thickest face, evenly spread on it. Powder takes up rebounds.",
    ));
    figures
}

fn unit(column: &str) -> &'static str {
    if column == "layer_thickness" { "_m" } else { "" }
}

fn deposit(index: usize, label: &str, history: &WallHistory) -> Figure {
    let title = format!("What lies on {}, {label}", history.patch);
    let mut chart = Chart::new(&title, "time [s]", "mass [kg]");
    for (name, column) in [("molten", "molten_kg"), ("powder", "powder_kg"), ("drained", "drained_kg")] {
        chart = chart.line(name, &history.line(column));
    }
    let caption = "Molten mass and powder on the patch as the wall remembers them, with their mass at capture, and what ran off \
                   it as a film.";
    chart.figure(&format!("wall-deposit-{}", index + 1), caption)
}
