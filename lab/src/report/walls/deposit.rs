//! What lies on walls that keep a deposit, over time.

use super::RunComparison;
use super::captured::thinned;
use crate::report::format::{duration, number, time_unit};
use crate::report::{Chart, Figure};
use crate::results::History;
use crate::results::openfoam::deposit::{DepositState, value};

/// Relative change of a column over time from which on it is drawn [1].
const LEAST_CHANGE: f64 = 1e-3;

/// A quantity of a wall over time: mean and maximum.
struct OverTime {
    id: &'static str,
    title: &'static str,
    y_label: &'static str,
    /// Drawn values over those of the columns.
    factor: f64,
    columns: [&'static str; 2],
    /// Drawn even where it does not change.
    always: bool,
    caption: &'static str,
}

/// Places of the surface's temperature and of the heat flux in [`OVER_TIME`].
const TEMPERATURE: usize = 2;
const HEAT_FLUX: usize = 3;

const OVER_TIME: [OverTime; 4] = [
    OverTime {
        id: "wall-coverage",
        title: "Share of the wall covered by powder",
        y_label: "coverage [1]",
        factor: 1.0,
        columns: ["coverage_mean", "coverage_max"],
        always: true,
        caption: "Mean over the area of the wall, and the face or bin with the largest coverage. Covered area is not \
                  sticky.",
    },
    OverTime {
        id: "wall-layer",
        title: "Powder on the wall",
        y_label: "thickness of the layer [µm]",
        factor: 1e6,
        columns: ["layer_thickness_mean_m", "layer_thickness_max_m"],
        always: true,
        caption: "Mean over the area of the wall, and the thickest face or bin, with the powder spread evenly on it. \
                  Powder damps rebounds.",
    },
    OverTime {
        id: "wall-temperature",
        title: "Surface of the deposit",
        y_label: "temperature [K]",
        factor: 1.0,
        columns: ["wall_temperature_mean_K", "wall_temperature_max_K"],
        always: false,
        caption: "Mean over the area of the wall, and the hottest face or bin: what impacts meet.",
    },
    OverTime {
        id: "wall-heat-flux",
        title: "Heat through the wall",
        y_label: "heat flux [kW/m²]",
        factor: 1e-3,
        columns: ["heat_flux_mean_W_m2", "heat_flux_max_W_m2"],
        always: false,
        caption: "Into the coolant; mean over the area of the wall, and the face or bin with the largest flux.",
    },
];

pub(super) fn figures(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let all = comparison.each().flat_map(|(label, run)| run.deposits.iter().map(move |wall| (label, wall)));
    let walls: Vec<(&String, &History<DepositState>)> =
        all.filter(|(_, wall)| is_something(wall) && !comparison.few.contains(&wall.wall)).collect();
    // A single run needs no name.
    let single = comparison.is_single();
    let titled = |(label, wall): &(&String, &History<DepositState>)| {
        if single {
            format!("Deposit on {}", wall.wall)
        } else {
            format!("Deposit on {}, {label}", wall.wall)
        }
    };
    let clock = time_unit(comparison.time);
    let mut figures: Vec<Figure> =
        walls.iter().enumerate().map(|(index, wall)| masses(index, &titled(wall), wall.1, clock)).collect();
    if walls.is_empty() {
        return figures;
    }
    let over_time = |title: &str, y_label: &str, factor: f64, [mean, most]: [&str; 2]| {
        let chart = Chart::new(title, &format!("time [{}]", clock.1), y_label);
        walls.iter().fold(chart, |chart, (label, wall)| {
            let name = if single { wall.wall.clone() } else { format!("{label}: {}", wall.wall) };
            let colour = comparison.colour(label, &wall.wall);
            // Several walls of one case have one colour and other gaps.
            let dash = if single {
                0
            } else {
                2 * comparison.walls.iter().position(|one| *one == wall.wall).unwrap_or(0)
            };
            let scaled = |column: &str| {
                line(wall, column, clock).into_iter().map(|[time, value]| [time, factor * value])
            };
            chart
                .dashed(colour, dash)
                .line(&format!("{name}, mean"), &scaled(mean).collect::<Vec<_>>())
                .dashed(colour, dash + 1)
                .line(&format!("{name}, maximum"), &scaled(most).collect::<Vec<_>>())
        })
    };
    let drawn = OVER_TIME
        .iter()
        .filter(|drawn| drawn.always || walls.iter().any(|(_, wall)| changes(wall, drawn.columns[0])));
    figures.extend(drawn.map(|drawn| {
        over_time(drawn.title, drawn.y_label, drawn.factor, drawn.columns).figure(drawn.id, drawn.caption)
    }));
    figures
}

/// How the surface and the heat through the cooled walls of a single run change, in one sentence.
pub(super) fn heat_words(comparison: &RunComparison<'_>) -> Option<String> {
    let [run] = comparison.runs else { return None };
    let of_wall = |wall: &History<DepositState>| {
        let [(_, first), .., (end, last)] = wall.rows.as_slice() else { return None };
        let at = |state: &DepositState, place: usize| value(state, OVER_TIME[place].columns[0]);
        let [temperatures, fluxes] =
            [TEMPERATURE, HEAT_FLUX].map(|place| [first, last].map(|state| at(state, place)));
        let known =
            fluxes.iter().all(|flux| flux.is_finite()) && changes(wall, OVER_TIME[HEAT_FLUX].columns[0]);
        known.then(|| {
            let [[cold, hot], [before, after]] = [temperatures.map(f64::round), fluxes.map(|flux| 1e-3 * flux)];
            let [before, after] = [before, after].map(|flux| number((10.0 * flux).round() / 10.0));
            format!(
                "on {} the surface that impacts meet goes from {cold} to {hot} K over {}, and the heat through the \
                 wall from {before} to {after} kW/m²",
                wall.wall,
                duration(*end)
            )
        })
    };
    let walls: Vec<String> = run.deposits.iter().filter_map(of_wall).collect();
    (!walls.is_empty()).then(|| format!("In the mean over a wall, {}.", walls.join("; ")))
}

/// Whether a column is there and changes over time.
fn changes(wall: &History<DepositState>, column: &str) -> bool {
    let mut values =
        wall.rows.iter().map(|(_, state)| value(state, column)).filter(|value| value.is_finite());
    let first = values.next();
    first.is_some_and(|first| values.any(|value| (value - first).abs() > LEAST_CHANGE * first.abs()))
}

fn is_something(wall: &History<DepositState>) -> bool {
    wall.rows.last().is_some_and(|(_, state)| {
        let brought = ["initial_kg", "arrived_kg", "condensed_kg"].map(|column| value(state, column));
        brought.into_iter().any(|mass| mass > 0.0)
    })
}

/// The seconds of a unit of time, and its name.
type Clock = (f64, &'static str);

/// A column over time.
fn line(wall: &History<DepositState>, column: &str, clock: Clock) -> Vec<[f64; 2]> {
    thinned(&wall.rows).map(|(time, state)| [*time / clock.0, value(state, column)]).collect()
}

fn masses(index: usize, title: &str, wall: &History<DepositState>, clock: Clock) -> Figure {
    let mut chart = Chart::new(title, &format!("time [{}]", clock.1), "mass [kg]");
    for (name, column) in [("molten", "molten_kg"), ("powder", "powder_kg")] {
        chart = chart.line(name, &line(wall, column, clock));
    }
    let others = [
        ("frozen", "frozen_kg"),
        ("drained", "drained_kg"),
        ("fallen off", "shed_kg"),
        ("carried away by the gas", "resuspended_kg"),
        ("condensed from the gas", "condensed_kg"),
    ];
    for (name, column) in others {
        let points = line(wall, column, clock);
        if points.iter().any(|[_, mass]| *mass > 0.0) {
            chart = chart.line(name, &points);
        }
    }
    let caption = "Molten and frozen slag and powder in the deposit of the wall, and, where there is some, the mass \
        that drained from it as a film, that fell off, that the gas carried away and that vapour brought. In OpenFOAM \
        with the mass at capture; a standalone case counts out what burns off.";
    chart.figure(&format!("wall-deposit-{}", index + 1), caption)
}
