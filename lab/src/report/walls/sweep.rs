//! The results of a standalone case over its sweep.

use super::places::map_figures;
use super::{later_captures, number, percent};
use crate::report::format::with_deviation;
use crate::report::page::TableColumn;
use crate::report::{Chart, Figure, Page, Table};
use crate::results::standalone::{Doubts, Run, RunTotals};
use crate::results::{MapQuantity, Moments, WallTotals, share, wilson};
use crate::rig::Band;
use crate::simulate::{Case, Sweep, sweep_unit};

/// How the figures label the swept quantity and show its values.
struct SweepAxis {
    words: String,
    unit: &'static str,
    shown: fn(f64) -> f64,
}

impl SweepAxis {
    fn of(key: &str) -> Self {
        let words = match key {
            "speed" => "speed at release".to_owned(),
            "angle_deg" => "angle at release".to_owned(),
            _ => key.replace('_', " "),
        };
        match sweep_unit(key) {
            "m" => Self { words, unit: "µm", shown: |value| 1e6 * value },
            unit => Self { words, unit, shown: |value| value },
        }
    }

    /// The label of an axis or a column.
    fn label(&self) -> String {
        format!("{} [{}]", self.words, self.unit)
    }

    /// The value of a run in words: "temperature = 320 K".
    fn at(&self, run: &Run) -> String {
        let unit = if self.unit == "1" { String::new() } else { format!(" {}", self.unit) };
        format!("{} = {}{unit}", self.words, number(self.value(run)))
    }

    fn value(&self, run: &Run) -> f64 {
        run.value.map_or(f64::NAN, self.shown)
    }
}

pub(super) fn add_to(page: &mut Page, case: &Case, sweep: &Sweep, runs: &[Run]) {
    let axis = SweepAxis::of(&sweep.key);
    page.figures([capture(&axis, sweep, runs), restitution(&axis, sweep, runs)]);
    page.heading("Numbers");
    page.table(table(&axis, runs));
    let later = |run: &&Run| run.totals.captured_later();
    let most = runs.iter().max_by(|a, b| later(a).total_cmp(&later(b))).filter(|run| later(run) > 0.1);
    if let Some(run) = most {
        let totals = &run.totals;
        let text = later_captures(totals.first_hits(), totals.ends.captured.count, totals.has_carbon);
        page.text(format!("At {}: {text}", axis.at(run)));
    }
    for reference in &sweep.references {
        page.note(format!("{}: {}", reference.quantity, reference.source));
    }
    if let Some(trouble) = runs.iter().find_map(|run| run.totals.first_trouble.as_ref()) {
        page.text(format!("Some particles could not be used. The first: {trouble}."));
    }
    let doubts = Doubts::of_all(runs.iter().map(|run| &run.totals.doubts)).lines();
    if !doubts.is_empty() {
        page.heading("Outside of stated ranges");
        doubts.into_iter().for_each(|line| page.note(format!("{line}.")));
    }
    for (quantity, heading) in [
        (MapQuantity::Captured, "Where particles are captured"),
        (MapQuantity::Eroded, "Where walls are eroded"),
    ] {
        let most = runs.iter().max_by(|a, b| left(a, quantity).total_cmp(&left(b, quantity)));
        if let Some(run) = most.filter(|run| left(run, quantity) > 0.0) {
            page.heading(format!("{heading} at {}", axis.at(run)));
            page.figures(map_figures(&run.results(case), quantity, &[]));
        }
    }
}

/// What a run leaves on its walls: the number of captured particles, or the eroded volume [m³].
fn left(run: &Run, quantity: MapQuantity) -> f64 {
    match quantity {
        MapQuantity::Captured => run.totals.ends.captured.count as f64,
        MapQuantity::Eroded => run.totals.walls.iter().filter_map(|(_, wall)| wall.eroded).sum(),
    }
}

/// Share of first hits that are captured, in percent, and its 95 % interval.
fn first_capture(totals: &RunTotals) -> [f64; 3] {
    let [hits, captured] = totals.first_hits();
    let part = share(captured as f64, hits as f64);
    let [low, high] = wilson(part, hits as f64);
    [100.0 * part, 100.0 * low, 100.0 * high]
}

fn capture(axis: &SweepAxis, sweep: &Sweep, runs: &[Run]) -> Figure {
    let (mut first, mut errors, mut every) = (Vec::new(), Vec::new(), Vec::new());
    for run in runs {
        let [part, low, high] = first_capture(&run.totals);
        first.push([axis.value(run), part]);
        errors.push((part - low, high - part));
        every.push([axis.value(run), 100.0 * captured_mass(&run.totals)]);
    }
    let chart = Chart::new("Capture", &axis.label(), "captured share [%]");
    let chart = with_band(chart, axis, runs);
    let chart = with_references(chart, axis, sweep, "capture", 100.0)
        .points_with_errors("share of the number of first hits", &first, &errors)
        .line("share of the injected mass, in the end", &every);
    chart.y_range(0.0, 100.0).figure(
        "sweep-capture",
        "Points: how many of all first hits end in capture, with the 95 % interval. Line: the captured part of the \
            injected mass in the end, which large particles dominate and to which later hits add.",
    )
}

/// The band of the captured mass over drawn models; with several walls each has its own, which do not add up.
fn with_band(chart: Chart, axis: &SweepAxis, runs: &[Run]) -> Chart {
    let bands: Vec<(f64, Band)> = runs
        .iter()
        .filter_map(|run| match run.bands.as_slice() {
            [only] => Some((axis.value(run), only.mass_share)),
            _ => None,
        })
        .collect();
    if bands.len() < 2 {
        return chart;
    }
    let of = |end: fn(&Band) -> f64| bands.iter().map(|(_, band)| 100.0 * end(band)).collect::<Vec<_>>();
    let x: Vec<f64> = bands.iter().map(|(x, _)| *x).collect();
    chart.band(&x, &of(|band| band.low), &of(|band| band.high))
}

fn captured_mass(totals: &RunTotals) -> f64 {
    share(totals.ends.captured.mass(), totals.ends.injected.mass())
}

fn restitution(axis: &SweepAxis, sweep: &Sweep, runs: &[Run]) -> Figure {
    let (mut points, mut errors, mut rebounds) = (Vec::new(), Vec::new(), Vec::new());
    for run in runs {
        let (mean, error) = merged(run, |wall| &wall.first_e_n);
        points.push([axis.value(run), mean]);
        errors.push((1.96 * error, 1.96 * error));
        rebounds.push([axis.value(run), merged(run, |wall| &wall.e_n).0]);
    }
    let chart = Chart::new("Normal restitution", &axis.label(), "e_n [1]");
    let chart = with_references(chart, axis, sweep, "e_n", 1.0)
        .points_with_errors("first hits, captured = 0", &points, &errors)
        .line("rebounds, all hits", &rebounds);
    chart.figure(
        "sweep-restitution",
        "Mean over first hits with its 95 % interval, where a captured particle counts as 0, and mean over the \
            rebounds of all hits, first and later.",
    )
}

fn with_references(mut chart: Chart, axis: &SweepAxis, sweep: &Sweep, quantity: &str, scale: f64) -> Chart {
    for reference in sweep.references.iter().filter(|reference| reference.quantity == quantity) {
        let at = reference.at.iter().map(|value| (axis.shown)(*value));
        let points: Vec<[f64; 2]> = at.zip(&reference.value).map(|(x, y)| [x, scale * y]).collect();
        // The first words of the source, up to a comma or colon.
        let name = reference.source.split([',', ':', ';']).next().unwrap_or(&reference.source);
        chart = chart.published(name, &points);
    }
    chart
}

/// Mean over all walls, weighted by counts, and its standard error.
fn merged(run: &Run, of: impl Fn(&WallTotals) -> &Moments) -> (f64, f64) {
    let (mut count, mut sum, mut error) = (0.0, 0.0, 0.0);
    for (_, wall) in &run.totals.walls {
        let moments = of(wall);
        let n = moments.count as f64;
        count += n;
        sum += n * moments.mean;
        error += (n * moments.error()).powi(2);
    }
    if count == 0.0 { (f64::NAN, 0.0) } else { (sum / count, error.sqrt() / count) }
}

fn table(axis: &SweepAxis, runs: &[Run]) -> Table {
    let first = |run: &Run| {
        let [part, low, high] = first_capture(&run.totals).map(|part| percent(0.01 * part));
        format!("{part} ({low} to {high})")
    };
    let label = axis.label();
    let mean = |run: &Run, of: fn(&WallTotals) -> &Moments| {
        let (mean, error) = merged(run, of);
        if mean.is_finite() { with_deviation(mean, error) } else { number(mean) }
    };
    let columns: [TableColumn<'_, Run>; 9] = [
        (&label, &|run| number(axis.value(run))),
        ("first hits", &|run| run.totals.first_hits()[0].to_string()),
        ("captured", &|run| run.totals.first_hits()[1].to_string()),
        ("captured at first hit (95 %)", &first),
        ("mass captured in the end", &|run| percent(captured_mass(&run.totals))),
        ("e_n of first hits, captured = 0", &|run| mean(run, |wall| &wall.first_e_n)),
        ("e_n of rebounds, all hits", &|run| mean(run, |wall| &wall.e_n)),
        ("resultant impact speed, all hits [m/s]", &|run| mean(run, |wall| &wall.speed)),
        ("mass balance", &|run| number(run.totals.ends.balance_error())),
    ];
    Table::of_items("Means ± standard error.", 0, runs, &columns)
}
