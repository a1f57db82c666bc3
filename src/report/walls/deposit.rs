//! What lies on walls that keep a deposit, over time.

use super::Comparison;
use super::captured::thinned;
use crate::report::{Chart, Figure};
use crate::results::History;
use crate::results::openfoam::deposit::{DepositState, value};

pub(super) fn figures(comparison: &Comparison<'_>) -> Vec<Figure> {
    let all = comparison.each().flat_map(|(label, run)| run.deposits.iter().map(move |wall| (label, wall)));
    let walls: Vec<(&String, &History<DepositState>)> = all.filter(|(_, wall)| is_something(wall)).collect();
    // A single run needs no name.
    let single = comparison.is_single();
    let titled = |(label, wall): &(&String, &History<DepositState>)| {
        if single {
            format!("Deposit on {}", wall.wall)
        } else {
            format!("Deposit on {}, {label}", wall.wall)
        }
    };
    let mut figures: Vec<Figure> =
        walls.iter().enumerate().map(|(index, wall)| masses(index, &titled(wall), wall.1)).collect();
    if walls.is_empty() {
        return figures;
    }
    let over_time = |title: &str, y_label: &str, [mean, most]: [&str; 2]| {
        let chart = Chart::new(title, "time [s]", y_label);
        walls.iter().fold(chart, |chart, (label, wall)| {
            let name = if single { wall.wall.clone() } else { format!("{label}: {}", wall.wall) };
            chart
                .line(&format!("{name}, mean"), &line(wall, mean))
                .line(&format!("{name}, maximum"), &line(wall, most))
        })
    };
    let coverage =
        over_time("Share of the wall covered by powder", "coverage [1]", ["coverage_mean", "coverage_max"]);
    figures.push(coverage.figure(
        "wall-coverage",
        "Mean over the area of the wall, and the face or bin with the largest coverage. Covered area is not sticky.",
    ));
    let thickness = ["layer_thickness_mean_m", "layer_thickness_max_m"];
    figures.push(over_time("Powder on the wall", "thickness of the layer [m]", thickness).figure(
        "wall-layer",
        "Mean over the area of the wall, and the thickest face or bin, with the powder spread evenly on it. Powder damps \
         rebounds.",
    ));
    figures
}

fn is_something(wall: &History<DepositState>) -> bool {
    wall.rows.last().is_some_and(|(_, state)| value(state, "initial_kg") + value(state, "arrived_kg") > 0.0)
}

/// A column over time.
fn line(wall: &History<DepositState>, column: &str) -> Vec<[f64; 2]> {
    thinned(&wall.rows).map(|(time, state)| [*time, value(state, column)]).collect()
}

fn masses(index: usize, title: &str, wall: &History<DepositState>) -> Figure {
    let mut chart = Chart::new(title, "time [s]", "mass [kg]");
    for (name, column) in [("molten", "molten_kg"), ("powder", "powder_kg"), ("drained", "drained_kg")] {
        let points = line(wall, column);
        if column != "drained_kg" || points.iter().any(|[_, mass]| *mass > 0.0) {
            chart = chart.line(name, &points);
        }
    }
    let caption = "Molten mass and powder in the deposit of the wall, and, where it runs down, the mass that drained from \
                   it as a film. In OpenFOAM with the mass at capture; a standalone case counts out what burns off.";
    chart.figure(&format!("wall-deposit-{}", index + 1), caption)
}
