//! The page of a run: where material is captured, in which regime, at which conversion, and how particles rebound.

use super::Run;
use super::case::{Case, Sweep, sweep_unit};
use super::surface::Shape;
use super::tally::{
    CONVERSION_BINS, Moments, RESTITUTION_BINS, RESTITUTION_TOP, Share, Tally, WallTally, ratio,
};
use crate::impact::Regime;
use crate::report::{BarChart, Chart, Figure, FigureMap, Page, Table, number, percent, round_edges};

/// Above this number of captures a map is drawn as cells, below as points.
const POINTS: usize = 300;

/// Makes the page of a case's runs. `left_out` hits did not fit into `impacts.csv`.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(case: &Case, runs: &[Run], left_out: u64) -> Result<String, String> {
    let mut page = Page::new(&case.title);
    if let Some(about) = &case.about {
        page.lead(about.clone());
    }
    match (&case.sweep, runs) {
        (Some(sweep), _) => add_sweep(&mut page, case, sweep, runs),
        (None, [run]) => add_run(&mut page, case, &run.tally),
        _ => {}
    }
    add_reading(&mut page, case, left_out);
    page.foot(&format!("Seed {}, {} particles.", case.seed, case.injection.count));
    page.html().map_err(|error| error.to_string())
}

fn name(case: &Case, wall: &WallTally) -> String {
    case.surfaces[wall.surface].name.clone()
}

// --- one run -------------------------------------------------------------------------------------------------------

fn add_run(page: &mut Page, case: &Case, tally: &Tally) {
    page.verdict(verdict(case, tally));
    if let Some(trouble) = &tally.first_trouble {
        let count = tally.unusable.count;
        page.text(format!("{count} particles could not be used. The first: {trouble}."));
    }
    page.heading("Where material is captured");
    page.table(wall_table(case, tally));
    if tally.stuck_later() > 0.1 {
        page.text(hops(tally));
    }
    page.figures(maps(case, tally));
    page.heading("In which state");
    let mut states = vec![regimes(case, tally)];
    if has_carbon(tally) {
        states.push(conversions(case, tally));
    }
    states.push(sizes(case, tally));
    page.figures(states);
    page.heading("How particles rebound");
    page.table(impact_table(case, tally));
    page.figures(vec![
        restitution(case, tally, "normal-restitution", "Normal restitution e_n", |wall| &wall.e_n_histogram),
        restitution(case, tally, "tangential-restitution", "Tangential restitution e_t", |wall| {
            &wall.e_t_histogram
        }),
    ]);
    page.heading("Balance");
    page.table(balance(case, tally));
}

/// Whether conversion says anything: some captured particle had carbon left.
fn has_carbon(tally: &Tally) -> bool {
    tally.captures.iter().any(|capture| capture.conversion < 1.0)
}

fn verdict(case: &Case, tally: &Tally) -> Vec<String> {
    let busiest = tally.walls.iter().max_by(|a, b| a.stuck.mass().total_cmp(&b.stuck.mass()));
    let first = format!(
        "{} of the injected mass is captured, {} leaves, {} is under way when the time is up.",
        percent(tally.capture_share()),
        percent(ratio(tally.escaped.mass(), tally.injected.mass())),
        percent(ratio(tally.airborne.mass(), tally.injected.mass())),
    );
    let Some(wall) = busiest.filter(|wall| wall.stuck.count > 0) else { return vec![first] };
    let regime = Regime::ALL
        .iter()
        .max_by(|a, b| {
            let mass = |r: &Regime| wall.regime_stuck[*r as usize].mass();
            mass(a).total_cmp(&mass(b))
        })
        .map_or("", |regime| regime.name());
    let mut second = format!(
        "Most is caught by {}: {} of its {} hits stick, mainly as {regime}",
        name(case, wall),
        percent(wall.capture_efficiency()),
        wall.hits.count,
    );
    if has_carbon(tally) {
        second += &format!(", at a mean conversion of {}", number(wall.captured_conversion.mean));
    }
    vec![first, second + "."]
}

/// Why far more stick in the end than at the first hit.
fn hops(tally: &Tally) -> String {
    let [hits, stuck] = tally.first_hits();
    let burnt = if has_carbon(tally) { " and the carbon burns on" } else { "" };
    format!(
        "Of the particles that reach a wall {} are captured at their first hit and {} in the end: each rebound takes speed \
         away{burnt}, so what comes back to the wall after a few small hops is held. A measurement of single impacts sees \
         the first share.",
        percent(ratio(stuck as f64, hits as f64)),
        percent(ratio(tally.stuck.count as f64, hits as f64)),
    )
}

fn wall_table(case: &Case, tally: &Tally) -> Table {
    let row = |wall: &WallTally| {
        vec![
            name(case, wall),
            wall.hits.count.to_string(),
            wall.stuck.count.to_string(),
            percent(wall.capture_efficiency()),
            if wall.first_hits[0] == 0 { "–".to_owned() } else { percent(wall.first_capture()) },
            number(wall.stuck.mass()),
            percent(ratio(wall.stuck.mass(), tally.injected.mass())),
            spread(&wall.captured_conversion),
        ]
    };
    let header = [
        "wall",
        "hits",
        "captured",
        "captured / hits",
        "first hits captured",
        "captured mass [kg]",
        "of injected",
        "conversion at capture",
    ];
    Table {
        caption: "Counts are of particles; mean ± standard deviation.".into(),
        header: header.map(str::to_owned).to_vec(),
        rows: tally.walls.iter().map(row).collect(),
        text_columns: 1,
    }
}

fn impact_table(case: &Case, tally: &Tally) -> Table {
    let row = |wall: &WallTally| {
        vec![
            name(case, wall),
            wall.e_n.count.to_string(),
            spread(&wall.speed),
            spread(&wall.angle),
            spread(&wall.e_n),
            spread(&wall.e_t),
            percent(ratio(wall.outside_range as f64, wall.hits.count as f64)),
        ]
    };
    let header = [
        "wall",
        "rebounds, all hits",
        "impact speed, all hits [m/s]",
        "angle from the surface, all hits [°]",
        "e_n of rebounds, all hits",
        "e_t of rebounds, all hits",
        "outside validity",
    ];
    Table {
        caption: "Mean ± standard deviation. Outside validity: hits beyond the range that a property or a fitted term \
                  is stated for."
            .into(),
        header: header.map(str::to_owned).to_vec(),
        rows: tally.walls.iter().map(row).collect(),
        text_columns: 1,
    }
}

/// Mean and standard deviation.
fn spread(moments: &Moments) -> String {
    if moments.count == 0 {
        return "–".to_owned();
    }
    format!("{} ± {}", number(moments.mean), two_digits(moments.deviation()))
}

/// A spread needs no more than two digits.
fn two_digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return number(value);
    }
    let unit = 10f64.powf(value.abs().log10().floor() - 1.0);
    number((value / unit).round() * unit)
}

fn maps(case: &Case, tally: &Tally) -> Vec<Figure> {
    let mut figures: Vec<Figure> = tally.walls.iter().filter_map(|wall| map(case, tally, wall)).collect();
    if let Some(along) = along_pipe(case, tally) {
        figures.insert(0, along);
    }
    figures
}

fn map(case: &Case, tally: &Tally, wall: &WallTally) -> Option<Figure> {
    let surface = &case.surfaces[wall.surface];
    let places: Vec<([f64; 2], f64)> =
        tally.captures.iter().filter(|c| c.surface == wall.surface).map(|c| (c.place, c.mass)).collect();
    if places.is_empty() {
        return None;
    }
    let title = format!("Capture on {}", surface.name);
    let id = format!("map-{}", identifier(&surface.name));
    let axes = surface.shape.axes();
    if places.len() < POINTS {
        let points: Vec<[f64; 2]> = places.iter().map(|(place, _)| *place).collect();
        let chart = Chart::new(&title, axes[0], axes[1]).points("", &points);
        return Some(chart.figure(&id, "One point for each captured particle."));
    }
    let ranges = extent(&surface.shape, &places);
    let map = FigureMap::of_points(&title, axes, ranges, [48, 32], places.into_iter()).per_area();
    Some(map.figure(&id, "captured mass [kg/m²]", "Mass captured per area of wall over the run."))
}

/// The part of a surface that a map shows: all of a pipe, what is hit of a plane.
fn extent(shape: &Shape, places: &[([f64; 2], f64)]) -> [[f64; 2]; 2] {
    if let Shape::Pipe { radius, zone } = shape {
        let half = std::f64::consts::PI * radius;
        return [*zone, [-half, half]];
    }
    // The outermost hundredth would stretch the map over empty wall.
    let mut reach: Vec<f64> = places.iter().map(|([a, b], _)| a.abs().max(b.abs())).collect();
    reach.sort_by(f64::total_cmp);
    let half = reach[(reach.len() * 99 / 100).min(reach.len() - 1)].max(1e-9);
    [[-half, half]; 2]
}

/// Captured mass along a pipe of several parts.
fn along_pipe(case: &Case, tally: &Tally) -> Option<Figure> {
    let zones: Vec<(usize, [f64; 2])> = tally
        .walls
        .iter()
        .filter_map(|wall| match case.surfaces[wall.surface].shape {
            Shape::Pipe { zone, .. } => Some((wall.surface, zone)),
            Shape::Plane { .. } => None,
        })
        .collect();
    let from = zones.iter().map(|(_, zone)| zone[0]).fold(f64::INFINITY, f64::min);
    let to = zones.iter().map(|(_, zone)| zone[1]).fold(f64::NEG_INFINITY, f64::max);
    if zones.is_empty() || tally.stuck.count == 0 {
        return None;
    }
    let edges = round_edges(from, to, 40);
    let (bins, step) = (edges.len() - 1, edges[1] - edges[0]);
    let title = "Captured mass along the pipe";
    let mut chart = Chart::new(title, "along the pipe, z [m]", "captured mass [% of injected]");
    let mut sums = vec![vec![0.0; bins]; 4];
    for capture in &tally.captures {
        if zones.iter().any(|(surface, _)| *surface == capture.surface) {
            let bin = (((capture.place[0] - edges[0]) / step).max(0.0) as usize).min(bins - 1);
            sums[capture.regime as usize][bin] += 100.0 * ratio(capture.mass, tally.injected.mass());
        }
    }
    // The largest is drawn as area, the others as lines over it.
    let mut order = Regime::ALL;
    let total = |regime: &Regime| sums[*regime as usize].iter().sum::<f64>();
    order.sort_by(|a, b| total(b).total_cmp(&total(a)));
    for regime in order.iter().filter(|regime| total(regime) > 0.0) {
        chart = chart.histogram(regime.name(), &edges, &sums[*regime as usize]);
    }
    for (surface, zone) in &zones {
        if zone[0] > from {
            chart = chart.mark_x(zone[0], &case.surfaces[*surface].name);
        }
    }
    Some(chart.figure(
        "capture-along",
        "By regime: sticky particle or not (SP, NSP), sticky wall or not (SW, NSW).",
    ))
}

fn regimes(case: &Case, tally: &Tally) -> Figure {
    let names: Vec<String> = tally.walls.iter().map(|wall| name(case, wall)).collect();
    let mut bars = BarChart::new("Regime of the hits", "share of the wall's hits [%]", &names).stacked();
    for regime in Regime::ALL {
        let share = |w: &WallTally| 100.0 * ratio(w.regime_hits[regime as usize] as f64, w.hits.count as f64);
        let shares: Vec<f64> = tally.walls.iter().map(share).collect();
        // Nothing at all still needs a series, to have axes.
        if shares.iter().any(|share| *share > 0.0) || regime == Regime::NspNsw {
            bars = bars.series(regime.name(), &shares);
        }
    }
    bars.figure("regimes", "Sticky particle or not (SP, NSP) on a sticky wall or not (SW, NSW).")
}

fn conversions(case: &Case, tally: &Tally) -> Figure {
    let edges: Vec<f64> = (0..=CONVERSION_BINS).map(|i| i as f64 / CONVERSION_BINS as f64).collect();
    let title = "Carbon conversion at capture";
    let mut chart = Chart::new(title, "carbon conversion [1]", "captured mass [% of injected]");
    for wall in tally.walls.iter().filter(|wall| wall.stuck.count > 0) {
        let share = |mass: &f64| 100.0 * ratio(*mass, tally.injected.mass());
        let heights: Vec<f64> = wall.conversion_at_capture.iter().map(share).collect();
        chart = chart.histogram(&name(case, wall), &edges, &heights);
    }
    let caption =
        "What was captured, by how much of its carbon was gone (1: no carbon left, or none to begin with).";
    chart.x_range(0.0, 1.0).figure("conversion", caption)
}

fn sizes(case: &Case, tally: &Tally) -> Figure {
    let title = "Size of what is captured";
    let mut chart = Chart::new(title, "diameter [µm]", "captured mass [% of injected]");
    let diameters = || tally.captures.iter().map(|capture| 1e6 * capture.diameter);
    let (low, high) = (diameters().fold(f64::INFINITY, f64::min), diameters().fold(0.0, f64::max));
    if low < high {
        let edges = round_edges(low, high, 25);
        let (low, bins, step) = (edges[0], edges.len() - 1, edges[1] - edges[0]);
        for wall in tally.walls.iter().filter(|wall| wall.stuck.count > 0) {
            let mut heights = vec![0.0; bins];
            for capture in tally.captures.iter().filter(|capture| capture.surface == wall.surface) {
                let bin = (((1e6 * capture.diameter - low) / step) as usize).min(bins - 1);
                heights[bin] += 100.0 * ratio(capture.mass, tally.injected.mass());
            }
            chart = chart.histogram(&name(case, wall), &edges, &heights);
        }
    }
    chart.figure("sizes", "Captured mass by particle diameter.")
}

fn restitution(
    case: &Case,
    tally: &Tally,
    id: &str,
    title: &str,
    histogram: fn(&WallTally) -> &[u64; RESTITUTION_BINS],
) -> Figure {
    let step = RESTITUTION_TOP / RESTITUTION_BINS as f64;
    let last = tally
        .walls
        .iter()
        .filter_map(|wall| histogram(wall).iter().rposition(|count| *count > 0))
        .max()
        .map_or(40, |bin| (bin + 2).clamp(40, RESTITUTION_BINS));
    let edges: Vec<f64> = (0..=last).map(|i| step * i as f64).collect();
    let axis = title.rsplit(' ').next().unwrap_or(title);
    let mut chart = Chart::new(title, &format!("{axis} [1]"), "share of the wall's rebounds [%]");
    for wall in &tally.walls {
        let all: u64 = histogram(wall).iter().sum();
        if all > 0 {
            let share = |count: &u64| 100.0 * *count as f64 / all as f64;
            let heights: Vec<f64> = histogram(wall)[..last].iter().map(share).collect();
            chart = chart.histogram(&name(case, wall), &edges, &heights);
        }
    }
    chart.x_range(0.0, step * last as f64).figure(id, "Rebounds only, in steps of 0.025.")
}

fn balance(case: &Case, tally: &Tally) -> Table {
    let mut rows = Vec::new();
    let mut row = |what: String, share: &Share| {
        let part = percent(ratio(share.mass(), tally.injected.mass()));
        rows.push(vec![what, share.count.to_string(), number(share.mass()), part]);
    };
    row("injected".into(), &tally.injected);
    row("captured".into(), &tally.stuck);
    for (surface, share) in &tally.exits {
        row(format!("left through {}", case.surfaces[*surface].name), share);
    }
    row("under way when the time was up".into(), &tally.airborne);
    row(format!("given up (more than {} hits, or at rest)", case.hit_limit), &tally.given_up);
    row("unusable".into(), &tally.unusable);
    let reacted = tally.reacted.total();
    rows.push(vec![
        "reacted away".into(),
        "–".into(),
        number(reacted),
        percent(ratio(reacted, tally.injected.mass())),
    ]);
    Table {
        caption: format!("Injected minus all others, over injected: {:.1e}.", tally.balance_error()),
        header: ["", "particles", "mass [kg]", "of injected"].map(str::to_owned).to_vec(),
        rows,
        text_columns: 1,
    }
}

// --- a sweep -------------------------------------------------------------------------------------------------------

/// What the figures of a sweep call the swept quantity, and how its values are shown.
struct SweepAxis {
    label: String,
    shown: fn(f64) -> f64,
}

impl SweepAxis {
    fn of(key: &str) -> Self {
        let words = key.trim_end_matches("_deg").replace('_', " ");
        match sweep_unit(key) {
            "K" => Self { label: format!("{words} [°C]"), shown: |value| value - 273.15 },
            "m" => Self { label: format!("{words} [µm]"), shown: |value| 1e6 * value },
            unit => Self { label: format!("{words} [{unit}]"), shown: |value| value },
        }
    }
}

fn add_sweep(page: &mut Page, case: &Case, sweep: &Sweep, runs: &[Run]) {
    let axis = SweepAxis::of(&sweep.key);
    page.figures(vec![sweep_capture(&axis, sweep, runs), sweep_restitution(&axis, sweep, runs)]);
    page.heading("Numbers");
    page.table(sweep_table(&axis, runs));
    let gap = |run: &&Run| run.tally.stuck_later() > 0.1;
    if let Some(run) =
        runs.iter().filter(gap).max_by(|a, b| a.tally.stuck_later().total_cmp(&b.tally.stuck_later()))
    {
        page.text(format!("At {} = {}: {}", axis.label, number(shown(&axis, run)), hops(&run.tally)));
    }
    for reference in &sweep.references {
        page.note(format!("{}: {}", reference.quantity, reference.source));
    }
    if let Some(run) = runs.iter().find(|run| run.tally.unusable.count > 0) {
        let trouble = run.tally.first_trouble.clone().unwrap_or_default();
        page.text(format!("Some particles could not be used. The first: {trouble}."));
    }
    if let Some(run) = runs.iter().max_by_key(|run| run.tally.stuck.count).filter(|r| r.tally.stuck.count > 0)
    {
        let value = run.value.map_or(f64::NAN, axis.shown);
        page.heading(format!("Where it sticks at {} = {}", axis.label, number(value)));
        page.figures(maps(case, &run.tally));
    }
}

fn shown(axis: &SweepAxis, run: &Run) -> f64 {
    run.value.map_or(f64::NAN, axis.shown)
}

/// Wilson's interval for a share at 95 % [1].
fn wilson(hits: u64, stuck: u64) -> [f64; 2] {
    const Z: f64 = 1.959_963_984_540_054;
    if hits == 0 {
        return [0.0, 1.0];
    }
    let (n, p) = (hits as f64, stuck as f64 / hits as f64);
    let middle = p + Z * Z / (2.0 * n);
    let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
    [(middle - half) / (1.0 + Z * Z / n), (middle + half) / (1.0 + Z * Z / n)]
}

fn sweep_capture(axis: &SweepAxis, sweep: &Sweep, runs: &[Run]) -> Figure {
    let (mut first, mut errors, mut every) = (Vec::new(), Vec::new(), Vec::new());
    for run in runs {
        let [hits, stuck] = run.tally.first_hits();
        let share = 100.0 * ratio(stuck as f64, hits as f64);
        let [low, high] = wilson(hits, stuck);
        first.push([shown(axis, run), share]);
        errors.push((share - 100.0 * low, 100.0 * high - share));
        every.push([shown(axis, run), 100.0 * run.tally.capture_share()]);
    }
    let chart = Chart::new("Capture", &axis.label, "captured [%]");
    let chart = referenced(chart, axis, sweep, "capture", 100.0)
        .points_with_errors("first hits", &first, &errors)
        .line("particles, in the end", &every);
    chart.y_range(0.0, 100.0).figure(
        "sweep-capture",
        "Share of first hits that stick, with its 95 % interval, and share of all mass that is stuck in the end.",
    )
}

fn sweep_restitution(axis: &SweepAxis, sweep: &Sweep, runs: &[Run]) -> Figure {
    let mut points = Vec::new();
    let mut errors = Vec::new();
    let mut rebounds = Vec::new();
    for run in runs {
        let all = merged(run, |wall| (wall.first_e_n.count, wall.first_e_n.mean, wall.first_e_n.error()));
        points.push([shown(axis, run), all.0]);
        errors.push((1.96 * all.1, 1.96 * all.1));
        let only = merged(run, |wall| (wall.e_n.count, wall.e_n.mean, wall.e_n.error()));
        rebounds.push([shown(axis, run), only.0]);
    }
    let chart = Chart::new("Normal restitution", &axis.label, "e_n [1]");
    let chart = referenced(chart, axis, sweep, "e_n", 1.0)
        .points_with_errors("first hits, captured = 0", &points, &errors)
        .line("rebounds, all hits", &rebounds);
    chart.figure(
        "sweep-restitution",
        "Mean over first hits with its 95 % interval, a captured particle counted as 0; and over the rebounds of all hits, \
         first and later.",
    )
}

fn referenced(mut chart: Chart, axis: &SweepAxis, sweep: &Sweep, quantity: &str, scale: f64) -> Chart {
    for reference in sweep.references.iter().filter(|reference| reference.quantity == quantity) {
        let at = reference.at.iter().map(|value| (axis.shown)(*value));
        let points: Vec<[f64; 2]> = at.zip(&reference.value).map(|(x, y)| [x, scale * y]).collect();
        chart = chart.reference(short(&reference.source), &points);
    }
    chart
}

/// The first words of a source, up to a comma or colon.
fn short(source: &str) -> &str {
    source.split([',', ':', ';']).next().unwrap_or(source)
}

/// Mean and its standard error over all walls, weighted by counts.
fn merged(run: &Run, of: impl Fn(&WallTally) -> (u64, f64, f64)) -> (f64, f64) {
    let (mut count, mut sum, mut error) = (0.0, 0.0, 0.0);
    for wall in &run.tally.walls {
        let (n, mean, own) = of(wall);
        let n = n as f64;
        count += n;
        sum += n * mean;
        error += (n * own).powi(2);
    }
    if count == 0.0 { (f64::NAN, 0.0) } else { (sum / count, error.sqrt() / count) }
}

fn sweep_table(axis: &SweepAxis, runs: &[Run]) -> Table {
    let row = |run: &Run| {
        let [hits, stuck] = run.tally.first_hits();
        let [low, high] = wilson(hits, stuck);
        let first = merged(run, |wall| (wall.first_e_n.count, wall.first_e_n.mean, wall.first_e_n.error()));
        let rebounds = merged(run, |wall| (wall.e_n.count, wall.e_n.mean, wall.e_n.error()));
        let speed = merged(run, |wall| (wall.speed.count, wall.speed.mean, wall.speed.error()));
        vec![
            number(shown(axis, run)),
            hits.to_string(),
            stuck.to_string(),
            format!("{} ({} to {})", percent(ratio(stuck as f64, hits as f64)), percent(low), percent(high)),
            percent(run.tally.capture_share()),
            number(first.0),
            number(rebounds.0),
            number(speed.0),
            format!("{:.1e}", run.tally.balance_error()),
        ]
    };
    let header = [
        axis.label.as_str(),
        "first hits",
        "stuck",
        "captured at first hit (95 %)",
        "stuck in the end",
        "e_n of first hits, captured = 0",
        "e_n of rebounds, all hits",
        "speed, all hits [m/s]",
        "mass balance",
    ];
    Table {
        caption: String::new(),
        header: header.map(str::to_owned).to_vec(),
        rows: runs.iter().map(row).collect(),
        text_columns: 0,
    }
}

// --- how to read it ------------------------------------------------------------------------------------------------

fn add_reading(page: &mut Page, case: &Case, left_out: u64) {
    page.heading("How this was computed");
    page.text(
        "Particles move alone in a prescribed, steady gas: drag of Schiller and Naumann, weight, convective heat of Ranz \
         and Marshall, and the stated law of carbon conversion. There is no turbulence and no action on the gas. A \
         particle touches a wall with its surface, half a diameter from its centre. Each hit is decided by the impact \
         model; its random draw depends on seed, particle and hit number alone.");
    if left_out > 0 {
        page.note(format!(
            "impacts.csv holds all hits of the first particles (of each value of a sweep), {} rows at most; {left_out} \
             hits of later particles are in the figures but not in the file (run.recorded_impacts).",
            case.recorded
        ));
    }
}

/// A name as an id: letters, digits and hyphens.
fn identifier(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' }).collect()
}
