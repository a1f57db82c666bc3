//! Measured against predicted values.

use super::super::chart::{Chart, ErrorBars, Figure};
use super::super::diagnosis::fit::extends;
use super::super::diagnosis::gain::AGREE;
use super::super::diagnosis::plot::{FEW_DRAWN, identifier, span};
use super::series::{ModelValue, bar, bars, models};
use super::words;
use crate::dataset::RigQuantity;
use crate::diagnose::rig::{RigDiagnosis, RigRow};

/// Fewest readings of a kind with a figure of its own.
const LEAST_OF_A_KIND: usize = 3;

/// A figure for each kind of readings, and one for the kinds with few.
pub(super) fn figures(found: &RigDiagnosis) -> Vec<Figure> {
    let kind = |row: &RigRow| row.observable.split('@').next().and_then(RigQuantity::parse).map(|q| q.kind());
    let mut figures = Vec::new();
    let mut others: Vec<&RigRow> = Vec::new();
    for errors in &found.errors {
        let own: Vec<&RigRow> =
            found.readings.iter().filter(|row| kind(row) == Some(errors.observable)).collect();
        match own.len() {
            count if count >= LEAST_OF_A_KIND => {
                figures.extend(figure(found, &own, words::kind(errors.observable), errors.observable));
            }
            _ => others.extend(own),
        }
    }
    let rest = if figures.is_empty() { "all readings" } else { "all other readings" };
    figures.extend(figure(found, &others, rest, "others"));
    figures
}

fn figure(found: &RigDiagnosis, rows: &[&RigRow], what: &str, id: &str) -> Option<Figure> {
    let held_out = rows.iter().any(|row| row.held_out.is_some());
    let series = series(found, rows, held_out);
    let all = series.iter().flat_map(|(_, points, _)| points.iter().flatten());
    let [low, high] =
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], one| [low.min(*one), high.max(*one)]);
    if low > high {
        return None;
    }
    let edges = edges(low, high);
    let (low, high) = (edges[0], edges[edges.len() - 1]);
    let touch = 1e-9 * (high - low);
    let mut chart =
        Chart::new(&format!("Measured against predicted: {what}"), "predicted [1]", "measured [1]")
            .x_range(low, high)
            .y_range(low - touch, high + touch)
            .y_step(edges[1] - edges[0]);
    for (name, points, errors) in series.iter().filter(|(_, points, _)| !points.is_empty()) {
        let inside = |(at, (below, above)): (&[f64; 2], &(f64, f64))| {
            (below.min(at[1] - low), above.min(high - at[1]))
        };
        let errors: ErrorBars = points.iter().zip(errors).map(inside).collect();
        chart = if rows.len() <= FEW_DRAWN {
            chart.points_with_errors(name, points, &errors)
        } else {
            chart.points(name, points)
        };
    }
    let seen = seen(series.len() > 1, held_out);
    let caption = format!(
        "{} reading{}. The closer to the line, the better the prediction.{}{seen}",
        rows.len(),
        if rows.len() == 1 { "" } else { "s" },
        bars(rows)
    );
    let chart = chart.line(AGREE, &[[low, low], [high, high]]);
    Some(chart.figure(&format!("parity-{}", identifier(id)), &caption))
}

/// Predicted and measured values of each model, with the errors of the measured ones.
type Series = (&'static str, Vec<[f64; 2]>, ErrorBars);

/// The base and, where there is one, the extended model: as it predicts experiments held out where some were.
fn series(found: &RigDiagnosis, rows: &[&RigRow], held_out: bool) -> Vec<Series> {
    let mut models = models(extends(&found.diagnosis));
    if let (true, Some(last)) = (held_out && models.len() > 1, models.last_mut()) {
        let unseen: ModelValue = ("extended model, experiment held out", |row| row.held_out);
        *last = unseen;
    }
    let one = |(name, value): ModelValue| {
        let known = rows.iter().filter_map(|row| Some(([value(row)?, row.measured], bar(row))));
        let (points, errors) = known.unzip();
        (name, points, errors)
    };
    models.into_iter().map(one).collect()
}

/// Edges of both axes: room for the markers at the ends, but none beyond zero and one where no value is there.
fn edges(low: f64, high: f64) -> Vec<f64> {
    let room = 0.04 * (high - low);
    let edges = span((low - room).max(0.0), (high + room).min(high.max(1.0)), 6);
    span(edges[0].max(0.0), edges[edges.len() - 1], 6)
}

/// What the extended model knew of the readings.
fn seen(extended: bool, held_out: bool) -> &'static str {
    match (extended, held_out) {
        (false, _) => "",
        (true, true) => {
            " The extended model's values are those of a model chosen and fitted without the experiment, so they are \
                true predictions."
        }
        (true, false) => " The extended model was fitted to these readings, so the figure flatters it.",
    }
}
