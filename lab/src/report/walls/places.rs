//! Where captured particles lie: along the main axis, on unrolled walls, and seen from the side.

use super::captured::heights;
use super::{RunComparison, identifier};
use crate::report::chart::{ColourScale, PlanePicture, regime_colour};
use crate::report::format::REGIME_NAMES;
use crate::report::{Chart, Figure, percent, round_edges};
use crate::results::{Capture, Grid, MapQuantity, RunResults, WallMap, range, share};
use nearwall::impact::Regime;

/// Bins along the axis.
const AXIS_BINS: usize = 40;
/// From this number of captures on a map shows cells instead of points.
const POINTS: usize = 300;
/// Columns and rows of such a map, the size of its plot, and the width of the drawing [px].
const MAP_CELLS: [usize; 2] = [48, 32];
const MAP_SIZE: [f64; 2] = [330.0, 230.0];
const MAP_WIDTH: f64 = 480.0;
const AXES: [&str; 3] = ["x", "y", "z"];

/// Captured mass along the main axis: by regime along the pipes of a standalone case, else one series for each run.
pub(super) fn along(comparison: &RunComparison<'_>) -> Vec<Figure> {
    match comparison.runs {
        [run] if run.pipe.is_some() => along_pipe(comparison, run),
        runs if runs.iter().all(|run| run.maps.is_empty()) => along_axis(comparison),
        _ => Vec::new(),
    }
}

fn along_pipe(comparison: &RunComparison<'_>, run: &RunResults) -> Vec<Figure> {
    let Some(pipe) = &run.pipe else { return Vec::new() };
    let edges = round_edges(pipe.range[0], pipe.range[1], AXIS_BINS);
    let title = "Captured mass along the pipe";
    let on_pipe = |capture: &&Capture| capture.wall.is_some_and(|wall| pipe.walls.contains(&wall));
    let sums = Regime::ALL.map(|regime| {
        let own = run.captures.iter().filter(on_pipe).filter(|capture| capture.regime == Some(regime));
        heights(&edges, own.map(|capture| (capture.position[2], capture.mass)), comparison.injected(run))
    });
    let of = |regime: Regime| (regime.name(), regime_colour(regime), sums[regime as usize].as_slice());
    let series: Vec<(&str, &str, &[f64])> =
        Regime::ALL.map(of).into_iter().filter(|(_, _, heights)| heights.iter().sum::<f64>() > 0.0).collect();
    if series.is_empty() {
        return Vec::new();
    }
    let chart =
        Chart::new(title, "along the pipe, z [m]", "captured mass [% of injected]").stacked(&edges, &series);
    let chart = pipe.marks.iter().fold(chart, |chart, (begin, name)| chart.mark_x(*begin, name));
    vec![chart.figure("along", &format!("By regime. {REGIME_NAMES}"))]
}

fn along_axis(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let axis = main_axis(comparison.runs);
    let place = |capture: &Capture| capture.position[axis];
    let [low, high] = range(comparison.runs.iter().flat_map(|run| &run.captures).map(place));
    if low >= high {
        return Vec::new();
    }
    let edges = round_edges(low, high, AXIS_BINS);
    let name = AXES[axis];
    let title = format!("Captured mass along {name}, at the last written time");
    let mut chart = Chart::new(&title, &format!("{name} [m]"), "mass [% of injected]");
    for (place_of_run, (label, run)) in comparison.each().enumerate() {
        let injected = run.injected.last().map_or(f64::NAN, |[_, mass]| *mass);
        let heights =
            heights(&edges, run.captures.iter().map(|capture| (place(capture), capture.mass)), injected);
        if heights.iter().any(|height| *height > 0.0) {
            chart = chart.coloured(place_of_run).histogram(label, &edges, &heights);
        }
    }
    let fates: Vec<String> = comparison.each().filter_map(|(label, run)| fate(label, run)).collect();
    let caption = format!("Parcels that lie still at the last written time. {}", fates.join(" "));
    vec![chart.figure("along", caption.trim_end())]
}

/// What becomes of captured parcels, and so what their mass means.
fn fate(label: &str, run: &RunResults) -> Option<String> {
    let text = match run.stuck.as_deref() {
        Some("keep") => "captured parcels are inert and keep their mass at capture (stuck keep)",
        Some("react") => {
            "captured parcels go on reacting (stuck react), so that their mass may be less than at capture"
        }
        Some("remove") => "captured parcels are removed and not shown (stuck remove)",
        Some("slide") => {
            "molten parcels join the film and are not shown, others keep their mass at capture (stuck slide)"
        }
        Some(_) => return None,
        None => {
            "captured parcels stay in the cloud and go on reacting, so that their mass may be less than at capture"
        }
    };
    Some(format!("{label}: {text}."))
}

/// Captures on each wall that can be unrolled.
pub(super) fn captured_maps(comparison: &RunComparison<'_>) -> Vec<Figure> {
    maps(comparison, MapQuantity::Captured)
}

/// Erosion of each wall that can be unrolled.
pub(super) fn eroded_maps(comparison: &RunComparison<'_>) -> Vec<Figure> {
    maps(comparison, MapQuantity::Eroded)
}

fn maps(comparison: &RunComparison<'_>, quantity: MapQuantity) -> Vec<Figure> {
    let figures = |run| map_figures(run, quantity, &comparison.few);
    comparison.runs.iter().flat_map(figures).collect()
}

/// The maps of a quantity on all walls but some.
pub(super) fn map_figures(run: &RunResults, quantity: MapQuantity, left_out: &[String]) -> Vec<Figure> {
    let wanted = |map: &&WallMap| map.quantity == quantity && !left_out.contains(&map.wall);
    run.maps.iter().filter(wanted).map(map_figure).collect()
}

/// How a map names what it shows.
struct MapWords {
    /// Begin of the id.
    id: &'static str,
    title: &'static str,
    /// The quantity of a cell, its unit, and what it is in a sentence.
    value: &'static str,
    unit: &'static str,
    sentence: &'static str,
    /// What has a place and how much it leaves.
    hits: &'static str,
    amount: &'static str,
}

const CAPTURED: MapWords = MapWords {
    id: "map",
    title: "Capture on",
    value: "captured mass",
    unit: "kg/m²",
    sentence: "Mass captured per area of wall during the run.",
    hits: "captured particles",
    amount: "mass",
};
const ERODED: MapWords = MapWords {
    id: "erosion",
    title: "Erosion on",
    value: "eroded depth",
    unit: "m",
    sentence: "Volume that hits removed per area of wall during the run.",
    hits: "hits that erode",
    amount: "volume",
};

fn map_figure(map: &WallMap) -> Figure {
    let words = match map.quantity {
        MapQuantity::Captured => CAPTURED,
        MapQuantity::Eroded => ERODED,
    };
    let title = format!("{} {}", words.title, map.wall);
    let id = format!("{}-{}", words.id, identifier(&map.wall));
    let outside = outside(map, &words);
    if map.places.len() < POINTS {
        let places = map.places.iter().map(|(place, _)| *place);
        let points: Vec<[f64; 2]> = places.filter(|place| map.shows(place)).collect();
        let chart = Chart::new(&title, map.axes[0], map.axes[1]).points("", &points);
        return chart.figure(&id, &format!("One point for each of the {}.{outside}", words.hits));
    }
    let cells = Grid::new(map.ranges, MAP_CELLS).densities(&map.places);
    let scale = ColourScale::new(0.0, range(cells.iter().map(|cell| cell.value))[1]);
    let fills: Vec<String> = cells.iter().map(|cell| scale.colour(cell.value)).collect();
    let title = format!("{title}: {} [{}]", words.value, words.unit);
    let mut picture = PlanePicture::new([&id, &title], map.ranges, MAP_SIZE);
    picture.cells(&cells, &fills);
    picture.axes(map.axes, true);
    picture.bar(&scale, words.unit, 0, MAP_SIZE[1]);
    let size = [MAP_WIDTH, picture.below()[1]];
    picture.figure(&format!("{}{outside}", words.sentence), size, MAP_WIDTH)
}

/// How much is not on a map, in a sentence; nothing where all is.
fn outside(map: &WallMap, words: &MapWords) -> String {
    let (count, part) = map.outside();
    if count == 0 {
        return String::new();
    }
    let (all, part) = (map.places.len(), percent(part));
    format!(" Outside of the map: {count} of {all} {}, with {part} of the {}.", words.hits, words.amount)
}

/// Captured parcels along the main axis and around it or, where the wall is not round, from the side. All cases have
/// the same axes.
pub(super) fn scatter(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let all: Vec<[f64; 3]> =
        comparison.runs.iter().flat_map(|run| &run.captures).map(|capture| capture.position).collect();
    if all.is_empty() || comparison.runs.iter().any(|run| !run.maps.is_empty()) {
        return Vec::new();
    }
    let axis = main_axis(comparison.runs);
    let [first, second] = around(axis);
    let extent = |axis: usize| range(all.iter().map(|place| place[axis]));
    let width = |axis: usize| extent(axis)[1] - extent(axis)[0];
    let across = if width(second) > width(first) { second } else { first };
    let round = is_round(&all, axis);
    let name = AXES[axis];
    let (y_label, view) = if round {
        (format!("angle about {name} [°]"), "the wall unrolled")
    } else {
        (format!("{} [m]", AXES[across]), "seen from the side")
    };
    let place = |Capture { position: p, .. }: &Capture| {
        [p[axis], if round { p[second].atan2(p[first]).to_degrees() } else { p[across] }]
    };
    let figure = |(number, (label, run)): (usize, (&String, &RunResults))| {
        let points: Vec<[f64; 2]> = run.captures.iter().map(place).collect();
        let title = format!("Captured parcels, {label}");
        let [low, high] = extent(axis);
        let chart =
            Chart::new(&title, &format!("{name} [m]"), &y_label).points("", &points).x_range(low, high);
        let chart =
            if round { chart.y_range(-180.0, 180.0).y_step(90.0) } else { upright(chart, extent(across)) };
        let caption = format!("{} parcels, one point each; {view}.", points.len());
        chart.figure(&format!("places-{number}"), &caption)
    };
    let with_captures = comparison.each().enumerate().filter(|(_, (_, run))| !run.captures.is_empty());
    with_captures.map(figure).collect()
}

/// With a scale of round numbers over a range [m], if it has any width.
fn upright(chart: Chart, [bottom, top]: [f64; 2]) -> Chart {
    if bottom >= top {
        return chart;
    }
    let edges = round_edges(bottom, top, 5);
    chart.y_range(edges[0], edges[edges.len() - 1]).y_step(edges[1] - edges[0])
}

/// The direction in which captured parcels spread most: 0, 1, 2 for x, y, z.
fn main_axis(runs: &[RunResults]) -> usize {
    let extent = |axis: usize| {
        let [low, high] =
            range(runs.iter().flat_map(|run| &run.captures).map(|capture| capture.position[axis]));
        high - low
    };
    (0..3).max_by(|a, b| extent(*a).total_cmp(&extent(*b))).unwrap_or(2)
}

/// The two axes across this one.
fn around(axis: usize) -> [usize; 2] {
    [[1, 2], [2, 0], [0, 1]][axis]
}

/// Whether places lie roughly on round walls about an axis through the origin: all around it, and
/// at each place along it most at one radius.
fn is_round(places: &[[f64; 3]], axis: usize) -> bool {
    let [first, second] = around(axis);
    let [low, high] = range(places.iter().map(|place| place[axis]));
    let mut sectors = [false; 12];
    let mut slices: Vec<Vec<f64>> = vec![Vec::new(); AXIS_BINS];
    for place in places {
        let turn = place[second].atan2(place[first]) / std::f64::consts::TAU + 0.5;
        sectors[((12.0 * turn) as usize).min(11)] = true;
        let slice = (share(place[axis] - low, high - low) * AXIS_BINS as f64).max(0.0) as usize;
        slices[slice.min(AXIS_BINS - 1)].push(place[first].hypot(place[second]));
    }
    let at_one_radius = |radii: &mut Vec<f64>| {
        radii.sort_by(f64::total_cmp);
        let middle = radii.get(radii.len() / 2).copied().unwrap_or(0.0);
        radii.iter().filter(|radius| (**radius - middle).abs() <= 0.1 * middle).count()
    };
    let regular: usize = slices.iter_mut().map(at_one_radius).sum();
    sectors.iter().filter(|hit| **hit).count() >= 8 && regular * 10 >= places.len() * 8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pipe_is_round_and_a_plate_is_not() {
        let turn = |i: usize| i as f64 * 0.7;
        let pipe: Vec<[f64; 3]> =
            (0..200).map(|i| [0.2 * turn(i).cos(), 0.2 * turn(i).sin(), 0.01 * i as f64]).collect();
        let plate: Vec<[f64; 3]> =
            (0..200).map(|i| [turn(i).sin(), 0.0, 0.01 * ((7 * i) % 200) as f64]).collect();
        assert!(is_round(&pipe, 2) && !is_round(&plate, 2) && !is_round(&[], 2));
    }
}
