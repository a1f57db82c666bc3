//! Rebounds: restitution, impact speed and angle.

use super::{RunComparison, percent, spread};
use crate::report::{Chart, Figure, Table};
use crate::results::share;
use crate::results::standalone::RESTITUTION_STEP;

pub(super) fn normal(comparison: &RunComparison<'_>) -> Vec<Figure> {
    restitution(comparison, 0, "normal-restitution", ["Normal restitution e_n", "e_n [1]"])
}

pub(super) fn tangential(comparison: &RunComparison<'_>) -> Vec<Figure> {
    restitution(comparison, 1, "tangential-restitution", ["Tangential restitution e_t", "e_t [1]"])
}

fn restitution(
    comparison: &RunComparison<'_>,
    which: usize,
    id: &str,
    [title, label]: [&str; 2],
) -> Vec<Figure> {
    let counts = |wall: &str| {
        let totals = comparison.runs.first().and_then(|run| run.totals(wall, comparison.time));
        totals.map_or(&[][..], |totals| totals.restitutions[which].as_slice())
    };
    let filled = |wall: &String| counts(wall).iter().rposition(|count| *count > 0);
    let last = comparison.walls.iter().filter_map(filled).max().map_or(40, |bin| (bin + 2).clamp(40, 60));
    let edges: Vec<f64> = (0..=last).map(|i| RESTITUTION_STEP * i as f64).collect();
    let chart = Chart::new(title, label, "share of the wall's rebounds [%]").x_range(0.0, edges[last]);
    comparison.histogram([id, "Rebounds only, in steps of 0.025."], chart, &edges, |series| {
        let [wall] = series.walls[..] else { return None };
        let all: u64 = counts(wall).iter().sum();
        let percent = |count: &u64| 100.0 * share(*count as f64, all as f64);
        Some(counts(wall).get(..last)?.iter().map(percent).collect())
    })
}

pub(super) fn table(comparison: &RunComparison<'_>) -> Option<Table> {
    let caption = "Mean ± standard deviation. Outside validity: hits beyond the range that a property or a fitted \
        term is stated for.";
    comparison.wall_table(
        caption,
        &[
            ("rebounds, all hits", |c, run, wall| {
                Some(c.totals(run, wall)?.e_n.count).filter(|count| *count > 0).map(|count| count.to_string())
            }),
            ("resultant impact speed, all hits [m/s]", |c, run, wall| {
                Some(spread(&run.arrived(wall, c.time)?.1))
            }),
            ("angle from the surface, all hits [°]", |c, run, wall| {
                Some(spread(&c.totals(run, wall)?.angle))
            }),
            ("e_n of rebounds, all hits", |c, run, wall| Some(spread(&c.totals(run, wall)?.e_n))),
            ("e_t of rebounds, all hits", |c, run, wall| Some(spread(&c.totals(run, wall)?.e_t))),
            ("eroded volume [m³]", |c, run, wall| {
                let eroded = c.totals(run, wall)?.eroded.filter(|volume| *volume > 0.0)?;
                Some(format!("{eroded:.3e}"))
            }),
            ("heat from rebounds [J]", |c, run, wall| {
                let heat = c.totals(run, wall)?.contact_heat.filter(|heat| *heat != 0.0)?;
                Some(format!("{heat:.3e}"))
            }),
            ("outside validity", |c, run, wall| {
                let totals = c.totals(run, wall)?;
                Some(percent(share(totals.outside_range? as f64, totals.hits?.count as f64)))
            }),
        ],
    )
}
