//! What the extended model gains on rows that it was not fitted to.

use super::super::chart::{Chart, ErrorBars, Figure};
use super::super::format::{number, whole_percent};
use super::super::page::{Page, Table};
use super::plot::{
    BASE, EXTENDED, FEW_DRAWN, OBSERVABLES, PlotRow, identifier, share_axis, span, stated_error, title,
    triple,
};
use crate::diagnose::{Diagnosis, Gain};

/// Most parts of the probability of capture, and fewest rows of each.
const CAPTURE_BINS: usize = 8;
const ROWS_A_PART: usize = 10;
/// Largest share of the rows beyond each end of an axis.
const BEYOND_PARITY: f64 = 0.004;
/// Least number of held-out rows in a figure of measured against predicted values.
const LEAST_HELD_OUT: usize = 3;
/// An error up to this many noise floors is noise.
const AT_THE_FLOOR: f64 = 1.1;
/// Name of the line on which measured and predicted values agree.
pub(in crate::report) const AGREE: &str = "measured = predicted";

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading("Gain on rows that no fit saw");
    match diagnosis.gains.first() {
        None => page.text("Nothing was added to the model. The figures show how well it predicts as it is."),
        Some(first) => {
            page.text(measured(first, diagnosis.groups.is_some()));
            page.table(table(&diagnosis.gains));
            for gain in &diagnosis.gains {
                page.text(sentence(gain));
            }
            page.note(
                "A ratio below 1 means a smaller error; if the whole interval is below 1, chance does not explain it. \
                    The noise floor is the scatter of the measurements, which no model removes. For capture the error \
                    is that of the probability.",
            );
        }
    }
    page.figures(OBSERVABLES.iter().flat_map(|observable| parity(diagnosis, observable)));
}

/// Which model predicted the rows.
fn measured(gain: &Gain, groups: bool) -> String {
    if gain.measured == "cross-validated" {
        let group = if groups { " and without the other rows of its group" } else { "" };
        return format!(
            "Each row was predicted by a model file that was chosen, of the explanations that all rows led to, and \
                fitted without it{group}; extended.toml itself is fitted to all rows."
        );
    }
    "extended.toml, as it was written, predicted rows that it was not fitted to; without them the same causes are \
        chosen."
        .to_owned()
}

/// What an observable gains, in words.
fn sentence(gain: &Gain) -> String {
    let name = title(gain.observable);
    let [before, after] = [gain.rmse_before, gain.rmse_after].map(number);
    if gain.rmse_after == gain.rmse_before {
        return format!("{name}: unchanged.");
    }
    if gain.ci95[1] < 1.0 {
        return format!("{name}: the error falls from {before} to {after}.{}", what_is_left(gain));
    }
    if gain.ci95[0] > 1.0 {
        return format!(
            "{name}: the error rises from {before} to {after}. The extended model predicts it worse."
        );
    }
    let [low, high] = [gain.log_score_before, gain.log_score_after].map(|score| format!("{score:.3}"));
    let ratio = number((gain.log_score_after - gain.log_score_before).exp());
    if gain.log_score_after > gain.log_score_before {
        return format!(
            "{name}: its mean is not predicted better ({before} before, {after} after). What improves is the \
                prediction of how the values scatter: the mean log score of a row, all observables together, is {low} \
                before and {high} after, so an unseen row is {ratio} times as likely."
        );
    }
    format!(
        "{name}: neither its mean ({before} before, {after} after) nor the mean log score of a row ({low} before, \
            {high} after) improves on these rows."
    )
}

/// The error that is left, against the noise floor.
pub(in crate::report) fn what_is_left(gain: &Gain) -> String {
    match gain.noise_floor {
        Some(floor) if gain.rmse_after <= AT_THE_FLOOR * floor => {
            format!(" The noise floor is {}: what is left is noise.", number(floor))
        }
        Some(floor) => format!(
            " The noise floor is {}; the other {} of the mean square error are the model's: a shape that is not quite \
                right, too few rows to fit it, or a further cause.",
            number(floor),
            whole_percent(1.0 - (floor / gain.rmse_after).powi(2))
        ),
        None => String::new(),
    }
}

pub(in crate::report) fn table(gains: &[Gain]) -> Table {
    let digits = |value: f64| if value.is_finite() { format!("{value:.3}") } else { number(value) };
    let row = |gain: &Gain| {
        let (ratio, interval) = if gain.rmse_after == gain.rmse_before {
            ("unchanged".to_owned(), "–".to_owned())
        } else {
            let [low, high] = gain.ci95.map(digits);
            (digits(gain.rmse_after / gain.rmse_before), format!("{low} to {high}"))
        };
        vec![
            title(gain.observable).to_owned(),
            gain.held_out_rows.to_string(),
            number(gain.rmse_before),
            number(gain.rmse_after),
            gain.noise_floor.map_or("not known".to_owned(), number),
            ratio,
            interval,
        ]
    };
    let header = ["observable", "rows", "before", "after", "noise floor", "after / before", "95 % interval"];
    Table::new("Root mean square errors [1].", 1, &header, gains.iter().map(row).collect())
}

/// Measured against predicted values: of the held-out rows, or of all where none are held out;
/// nothing where the extension changes nothing or rows are too few.
fn parity(diagnosis: &Diagnosis, observable: &str) -> Vec<Figure> {
    let sample = &diagnosis.sample.rows;
    let held_out = sample.iter().any(|row| row.held_out);
    let rows = sample.iter().filter(|row| row.held_out || !held_out);
    let rows: Vec<PlotRow> = rows
        .filter_map(|row| Some((0.0, stated_error(row, observable), triple(row, observable)?)))
        .filter(|(_, _, numbers)| numbers[EXTENDED].is_finite())
        .collect();
    let changed = rows.iter().any(|(_, _, numbers)| numbers[BASE] != numbers[EXTENDED]);
    if rows.len() < LEAST_HELD_OUT || (!changed && !diagnosis.gains.is_empty()) {
        return Vec::new();
    }
    let models = [(BASE, "base model"), (EXTENDED, "extended model")];
    let models = &models[..if changed { 2 } else { 1 }];
    if observable == "outcome" {
        let varied = models.iter().any(|&(which, _)| calibration(&rows, which).0.len() > 1);
        return if varied { vec![reliability(&rows, models, held_out)] } else { Vec::new() };
    }
    let mut all: Vec<f64> = rows.iter().flat_map(|(_, _, numbers)| *numbers).collect();
    all.sort_by(f64::total_cmp);
    let beyond = (BEYOND_PARITY * all.len() as f64) as usize;
    let edges = span(all[beyond], all[all.len() - 1 - beyond], 6);
    // Once more, so that both axes get the same steps.
    let edges = span(edges[0], edges[edges.len() - 1], 6);
    let parity = Parity { observable, rows: &rows, held_out, edges: &edges };
    models.iter().map(|&(which, model)| parity.figure(which, model)).collect()
}

/// What a figure says of its rows.
fn kind(held_out: bool) -> &'static str {
    if held_out { "held-out rows" } else { "rows" }
}

/// A warning where the extended model was fitted to the rows of a figure.
fn flattered(held_out: bool, extended: bool) -> &'static str {
    if held_out || !extended {
        ""
    } else {
        " The extended model was fitted to these rows, so the figure flatters it."
    }
}

/// Measured against predicted values of one observable.
struct Parity<'a> {
    observable: &'a str,
    rows: &'a [PlotRow],
    held_out: bool,
    edges: &'a [f64],
}

impl Parity<'_> {
    fn figure(&self, which: usize, model: &str) -> Figure {
        let Self { observable, rows, held_out, edges } = self;
        let (low, high) = (edges[0], edges[edges.len() - 1]);
        let inside =
            |(point, _): &([f64; 2], (f64, f64))| point.iter().all(|value| (low..=high).contains(value));
        let points = rows.iter().map(|(_, error, numbers)| ([numbers[which], numbers[0]], (*error, *error)));
        let (points, errors): (Vec<[f64; 2]>, ErrorBars) = points.filter(inside).unzip();
        let outside = match rows.len() - points.len() {
            0 => String::new(),
            count => format!("; {count} lie outside the figure"),
        };
        let kind = kind(*held_out);
        // Slightly wider, so that rounding does not lose the ticks at the ends.
        let touch = 1e-9 * (high - low);
        let chart = Chart::new(
            &format!("{observable}, {model}: measured against predicted"),
            &format!("{observable} of the {model} [1]"),
            &format!("{observable} measured [1]"),
        )
        .x_range(low, high)
        .y_range(low - touch, high + touch)
        .y_step(edges[1] - edges[0]);
        let bars = points.len() <= FEW_DRAWN && errors.iter().any(|(error, _)| *error > 0.0);
        let chart =
            if bars { chart.points_with_errors(kind, &points, &errors) } else { chart.points(kind, &points) };
        let bars = if bars { " Bars are the stated standard errors." } else { "" };
        let part = if which == BASE { "before" } else { "after" };
        chart.line(AGREE, &[[low, low], [high, high]]).figure(
            &format!("parity-{}-{part}", identifier(observable)),
            &format!(
                "{} {kind}{outside}.{bars} The closer to the line, the better the prediction.{}",
                rows.len(),
                flattered(*held_out, which == EXTENDED)
            ),
        )
    }
}

/// Captured shares over parts of the predicted probability, with their standard errors.
fn calibration(rows: &[PlotRow], which: usize) -> (Vec<[f64; 2]>, ErrorBars) {
    let mut sorted: Vec<[f64; 2]> = rows.iter().map(|(_, _, numbers)| [numbers[which], numbers[0]]).collect();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let most = (sorted.len() / CAPTURE_BINS).max(ROWS_A_PART).min(sorted.len().max(1));
    let mean = |part: &[[f64; 2]], of: usize| part.iter().map(|p| p[of]).sum::<f64>() / part.len() as f64;
    let one = |part: &[[f64; 2]]| {
        let (x, y) = (mean(part, 0), mean(part, 1));
        let error = (y * (1.0 - y) / part.len() as f64).sqrt();
        ([x, y], (error.min(y), error.min(1.0 - y)))
    };
    sorted.chunks(most).filter(|part| 2 * part.len() >= most).map(one).unzip()
}

fn reliability(rows: &[PlotRow], models: &[(usize, &str)], held_out: bool) -> Figure {
    let heading = "Capture: measured against predicted";
    let chart = Chart::new(heading, "predicted probability of capture [1]", "share captured [1]");
    let mut chart = share_axis(chart.x_range(0.0, 1.0));
    for &(which, model) in models {
        let (points, errors) = calibration(rows, which);
        chart = chart.points_with_errors(model, &points, &errors);
    }
    let caption = format!(
        "{} {}, sorted by the predicted probability and averaged in equal numbers; bars are standard errors. On the \
            line, the model predicts the share that was captured.{}",
        rows.len(),
        kind(held_out),
        flattered(held_out, models.len() > 1)
    );
    chart.line(AGREE, &[[0.0, 0.0], [1.0, 1.0]]).figure("parity-outcome", &caption)
}
