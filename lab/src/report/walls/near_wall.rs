//! How long particles stay near the walls, and how densely: the dense-dispersed phase of Troiano et al.

use super::{RunComparison, RunResults, number, spread};
use crate::report::format::with_unit;
use crate::report::{BarChart, Figure, Table};
use crate::results::NearWall;

fn near<'a>(comparison: &RunComparison<'_>, run: &'a RunResults, wall: &str) -> Option<&'a NearWall> {
    run.totals(wall, comparison.time)?.near_wall.as_ref()
}

/// Concentration near each pipe wall over that in its cross-section.
pub(super) fn figures(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let [run] = comparison.runs else { return Vec::new() };
    let ratios = |wall: &String| near(comparison, run, wall)?.concentration();
    let walls = comparison
        .walls
        .iter()
        .filter(|wall| ratios(wall).is_some_and(|ratios| ratios.iter().all(|ratio| ratio.is_finite())));
    let walls: Vec<String> = walls.cloned().collect();
    if walls.is_empty() {
        return Vec::new();
    }
    let of = |which: usize| -> Vec<f64> {
        walls.iter().map(|wall| ratios(wall).map_or(f64::NAN, |ratios| ratios[which])).collect()
    };
    let chart =
        BarChart::new("Concentration near the wall", "over the mean of the cross-section [1]", &walls)
            .series("particles", &of(0))
            .series("mass", &of(1));
    let caption = "Time-mean concentration of flying particles in the layer near the wall, over that in the whole \
                   cross-section between the ends of this part of the pipe. 1 means evenly spread.";
    vec![chart.figure("near-wall", caption)]
}

pub(super) fn table(comparison: &RunComparison<'_>) -> Option<Table> {
    let distances =
        comparison.runs.iter().flat_map(|run| &run.walls).filter_map(|wall| wall.at(comparison.time));
    let distance = distances.filter_map(|totals| totals.near_wall).map(|near| near.distance).next()?;
    let caption = format!(
        "A particle is near a wall while the gap between them is at most {} (run.near_wall_distance). Residence time: \
         mean ± standard deviation over the particles that come near, of all their stays in flight.",
        with_unit(distance, "m")
    );
    comparison.wall_table(
        &caption,
        &[
            ("particles that come near", |c, run, wall| Some(near(c, run, wall)?.stays.count.to_string())),
            ("residence time near the wall [s]", |c, run, wall| Some(spread(&near(c, run, wall)?.stays))),
            ("number concentration / mean", |c, run, wall| {
                Some(number(near(c, run, wall)?.concentration()?[0]))
            }),
            ("mass concentration / mean", |c, run, wall| {
                Some(number(near(c, run, wall)?.concentration()?[1]))
            }),
        ],
    )
}
