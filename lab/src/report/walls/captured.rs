//! What is captured: by wall, regime and size, and over time.

use super::{RunComparison, RunResults, number, percent, spread};
use crate::report::chart::regime_colour;
use crate::report::format::REGIME_NAMES;
use crate::report::{BarChart, Chart, Figure, Table, round_edges};
use crate::results::{WallTotals, range, share};
use nearwall::impact::Regime;

/// Captured mass of each run by wall; a single run with regimes has [`regimes`] instead.
pub(super) fn by_wall(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let time = comparison.time;
    let known = |run: &RunResults| {
        comparison.walls.iter().any(|wall| run.totals(wall, time).is_some_and(|t| t.regimes.is_some()))
    };
    if comparison.walls.is_empty() || matches!(comparison.runs, [run] if known(run)) {
        return Vec::new();
    }
    let mut bars = BarChart::new(
        "Captured mass by wall, at capture",
        "mass at capture [% of injected]",
        &comparison.walls,
    );
    for (label, run) in comparison.each() {
        let part = |wall: &String| {
            let mass = run.captured(wall, time).map_or(f64::NAN, |amount| amount.mass());
            100.0 * share(mass, comparison.injected(run))
        };
        bars = bars.series(label, &comparison.walls.iter().map(part).collect::<Vec<f64>>());
    }
    vec![bars.figure("by-wall", "Mass at the moment of capture as a share of the mass injected so far.")]
}

/// Captured mass by wall and regime, one figure for each run with regimes.
pub(super) fn regimes(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let mut figures = Vec::new();
    for (label, run) in comparison.each().filter(|(_, run)| run.is_ours()) {
        let of =
            |totals: &WallTotals, regime: Regime| totals.regimes.map_or(0.0, |r| r[regime as usize].mass());
        let title = if comparison.is_single() { String::new() } else { format!(", {label}") };
        let (whole, name) = match run.injected_at(comparison.time) {
            Some(mass) => (mass, "injected"),
            None => (run.captured_mass(comparison.time), "captured"),
        };
        let axis = format!("mass at capture [% of {name}]");
        let bars = BarChart::new(&format!("Regime of capture{title}"), &axis, &comparison.walls);
        if let Some(bars) = stacked(comparison, run, bars, of, |_| whole) {
            let id =
                if figures.is_empty() { "regimes".to_owned() } else { format!("regimes-{}", figures.len()) };
            figures.push(bars.figure(&id, REGIME_NAMES));
        }
    }
    figures
}

/// Hits of a single run by wall and regime.
pub(super) fn hit_regimes(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let [run] = comparison.runs else { return Vec::new() };
    let of = |totals: &WallTotals, regime: Regime| {
        totals.regime_hits.map_or(0.0, |hits| hits[regime as usize] as f64)
    };
    let all = |totals: &WallTotals| totals.hits.map_or(f64::NAN, |hits| hits.count as f64);
    let bars = BarChart::new("Regime of the hits", "share of the wall's hits [%]", &comparison.walls);
    let bars = stacked(comparison, run, bars, of, all);
    bars.map(|bars| bars.figure("hit-regimes", REGIME_NAMES)).into_iter().collect()
}

/// Stacked bars of the regimes that occur at any wall as a percentage of `whole`; `None` when none does.
fn stacked(
    comparison: &RunComparison<'_>,
    run: &RunResults,
    bars: BarChart,
    of: impl Fn(&WallTotals, Regime) -> f64,
    whole: impl Fn(&WallTotals) -> f64,
) -> Option<BarChart> {
    let (mut bars, mut any) = (bars.stacked(), false);
    for regime in Regime::ALL {
        let part = |wall: &String| {
            let totals = run.totals(wall, comparison.time);
            totals.map_or(0.0, |totals| 100.0 * share(of(totals, regime), whole(totals)))
        };
        let parts: Vec<f64> = comparison.walls.iter().map(part).collect();
        if parts.iter().any(|part| *part > 0.0) {
            bars = bars.coloured(regime.name(), regime_colour(regime), &parts);
            any = true;
        }
    }
    any.then_some(bars)
}

/// Captured mass over time.
pub(super) fn history(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let mut chart = Chart::new("Captured mass over time", comparison.clock(), "mass at capture [kg]");
    let mut any = false;
    for (label, run) in comparison.each() {
        let mut times: Vec<f64> =
            run.walls.iter().flat_map(|wall| wall.rows.iter().map(|row| row.0)).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let line: Vec<[f64; 2]> = thinned(&times).map(|time| [*time, run.captured_mass(*time)]).collect();
        any |= times.len() > 1 && line.iter().any(|[_, captured]| *captured > 0.0);
        chart = chart.line(label, &line);
    }
    let caption = "All walls together from the start of the case, with the mass at capture.";
    if any { vec![chart.figure("history", caption)] } else { Vec::new() }
}

/// Some hundred items at most, as many as a reader can see, with the last one.
pub(super) fn thinned<T>(items: &[T]) -> impl Iterator<Item = &T> {
    items.iter().step_by(items.len().div_ceil(300).max(1)).chain(items.last())
}

/// Captured mass by diameter, unless the arrivals are classed by diameter.
pub(super) fn sizes(comparison: &RunComparison<'_>) -> Vec<Figure> {
    let diameters =
        comparison.runs.iter().flat_map(|run| &run.captures).map(|capture| 1e6 * capture.diameter);
    let [low, high] = range(diameters);
    if low >= high || comparison.runs.iter().any(|run| !run.classes.is_empty()) {
        return Vec::new();
    }
    let edges = round_edges(low, high, 25);
    let chart = Chart::new("Size of captured particles", "diameter [µm]", "captured mass [% of injected]");
    comparison.histogram(["sizes", "Captured mass by particle diameter."], chart, &edges, |series| {
        let own = series.run.captures.iter().filter(|capture| {
            let wall = capture.wall.map(|index| series.run.walls[index].wall.as_str());
            wall.is_none_or(|wall| series.walls.contains(&wall))
        });
        let points = own.map(|capture| (1e6 * capture.diameter, capture.mass));
        Some(heights(&edges, points, comparison.injected(series.run)))
    })
}

/// Sums of masses in bins between evenly spaced edges, in percent of `whole`.
pub(super) fn heights(edges: &[f64], points: impl Iterator<Item = (f64, f64)>, whole: f64) -> Vec<f64> {
    let mut heights = vec![0.0; edges.len() - 1];
    for (place, mass) in points {
        let bin = ((place - edges[0]) / (edges[1] - edges[0])).max(0.0) as usize;
        heights[bin.min(edges.len() - 2)] += 100.0 * share(mass, whole);
    }
    heights
}

pub(super) fn table(comparison: &RunComparison<'_>) -> Option<Table> {
    let caption = format!(
        "{}. Counts are of particles, or of parcels in OpenFOAM; masses are those at the hit; mean \
         ± standard deviation.",
        comparison.span()
    );
    comparison.wall_table(
        &caption,
        &[
            ("hits", |c, run, wall| Some(run.arrived(wall, c.time)?.0.count.to_string())),
            ("arriving mass [kg]", |c, run, wall| Some(number(run.arrived(wall, c.time)?.0.mass()))),
            ("captured", |c, run, wall| Some(run.captured(wall, c.time)?.count.to_string())),
            ("captured / hits", |c, run, wall| {
                let hits = run.arrived(wall, c.time)?.0.count;
                Some(percent(share(run.captured(wall, c.time)?.count as f64, hits as f64)))
            }),
            ("first hits captured", |c, run, wall| {
                let [hits, captured] = c.totals(run, wall)?.first_hits?;
                Some(percent(share(captured as f64, hits as f64)))
            }),
            ("captured mass [kg]", |c, run, wall| Some(number(run.captured(wall, c.time)?.mass()))),
            ("captured / arriving mass", |c, run, wall| {
                Some(percent(share(run.captured(wall, c.time)?.mass(), run.arrived(wall, c.time)?.0.mass())))
            }),
            ("captured / injected mass", |c, run, wall| {
                Some(percent(share(run.captured(wall, c.time)?.mass(), c.injected(run))))
            }),
            ("conversion at capture", |c, run, wall| {
                let conversion = &c.totals(run, wall)?.captured_conversion;
                (run.has_carbon || conversion.mean < 1.0).then(|| spread(conversion))
            }),
        ],
    )
}
