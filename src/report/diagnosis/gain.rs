//! What the extended model gains on rows that no fit and no choice saw.

use super::super::chart::{Chart, ErrorBars, Figure};
use super::super::format::number;
use super::super::page::{Page, Table};
use super::plot::{BASE, EXTENDED, OBSERVABLES, identifier, share_axis, span, title, triple};
use crate::diagnose::{Diagnosis, Gain};

/// Most parts of the probability of capture, and fewest rows of each.
const CAPTURE_BINS: usize = 8;
const ROWS_A_BIN: usize = 10;
/// Largest share of the rows beyond each end of an axis.
const BEYOND: f64 = 0.004;
/// Least number of held-out rows in a figure of measured against predicted values.
const LEAST_POINTS: usize = 3;
/// Name of the line on which measured and predicted values agree.
const AGREE: &str = "measured = predicted";

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading("Gain on rows that no fit saw");
    if diagnosis.gains.is_empty() {
        page.text("Nothing was added to the model. The figures show how well it predicts as it is.");
    } else {
        page.table(table(diagnosis));
        let mut text = "A ratio below 1 means a smaller error; if the whole interval is below 1, chance does not explain it. \
                        For capture the error is that of the probability."
            .to_owned();
        if let Some(gain) = diagnosis.gains.first() {
            let ratio = number((gain.log_score_after - gain.log_score_before).exp());
            text += &format!(
                " All observables together, an unseen row is {ratio} times as likely under the extended model."
            );
        }
        page.text(text);
        let curves = diagnosis.findings.iter().filter(|finding| finding.curve.is_some());
        let curves: Vec<String> = curves.map(|f| format!("the {}", super::cause_title(&f.cause))).collect();
        if !curves.is_empty() {
            page.text(format!(
                "These numbers include {}, which a model file cannot carry: extended.toml alone gains less, or nothing.",
                curves.join(" and ")
            ));
        }
    }
    page.figures(OBSERVABLES.iter().flat_map(|observable| parity(diagnosis, observable)));
}

fn table(diagnosis: &Diagnosis) -> Table {
    let digits = |value: f64| if value.is_finite() { format!("{value:.3}") } else { number(value) };
    let row = |gain: &Gain| {
        let (ratio, interval) = if gain.rmse_after == gain.rmse_before {
            ("unchanged".to_owned(), "–".to_owned())
        } else {
            let [low, high] = gain.ci95.map(digits);
            (digits(gain.rmse_after / gain.rmse_before), format!("{low} to {high}"))
        };
        let scatter = match gain.observable {
            "e_n" => number(diagnosis.scatter.e_n),
            "e_t" => number(diagnosis.scatter.e_t),
            _ => "–".to_owned(),
        };
        vec![
            title(gain.observable).to_owned(),
            gain.held_out_rows.to_string(),
            number(gain.rmse_before),
            number(gain.rmse_after),
            scatter,
            ratio,
            interval,
        ]
    };
    let header = [
        "observable",
        "rows",
        "before",
        "after",
        "scatter of single values",
        "after / before",
        "95 % interval",
    ];
    let caption = "Root mean square errors [1] on the held-out rows. No model can get below the scatter of single values.";
    Table::new(caption, 1, &header, diagnosis.gains.iter().map(row).collect())
}

/// Measured against predicted values, held-out rows only; nothing where the extension changes nothing or rows are too few.
fn parity(diagnosis: &Diagnosis, observable: &str) -> Vec<Figure> {
    let rows = diagnosis.sample.rows.iter().filter(|row| row.held_out);
    let rows: Vec<[f64; 3]> = rows
        .filter_map(|row| triple(row, observable))
        .filter(|numbers| numbers[EXTENDED].is_finite())
        .collect();
    let changed = rows.iter().any(|numbers| numbers[BASE] != numbers[EXTENDED]);
    if rows.len() < LEAST_POINTS || (!changed && !diagnosis.gains.is_empty()) {
        return Vec::new();
    }
    let models = [(BASE, "base model"), (EXTENDED, "extended model")];
    let models = &models[..if changed { 2 } else { 1 }];
    if observable == "outcome" {
        let varied = models.iter().any(|&(which, _)| calibration(&rows, which).0.len() > 1);
        return if varied { vec![reliability(&rows, models)] } else { Vec::new() };
    }
    let mut all: Vec<f64> = rows.iter().flatten().copied().collect();
    all.sort_by(f64::total_cmp);
    let beyond = (BEYOND * all.len() as f64) as usize;
    let edges = span(all[beyond], all[all.len() - 1 - beyond], 6);
    // Once more, so that both axes get the same steps.
    let edges = span(edges[0], edges[edges.len() - 1], 6);
    models.iter().map(|&(which, model)| scatter(observable, &rows, which, model, &edges)).collect()
}

fn scatter(observable: &str, rows: &[[f64; 3]], which: usize, model: &str, edges: &[f64]) -> Figure {
    let (low, high) = (edges[0], edges[edges.len() - 1]);
    let inside = |point: &[f64; 2]| point.iter().all(|value| (low..=high).contains(value));
    let points: Vec<[f64; 2]> =
        rows.iter().map(|numbers| [numbers[which], numbers[0]]).filter(inside).collect();
    let outside = match rows.len() - points.len() {
        0 => String::new(),
        count => format!("; {count} lie outside the figure"),
    };
    // Slightly wider, so that rounding does not lose the ticks at the ends.
    let touch = 1e-9 * (high - low);
    Chart::new(
        &format!("{observable}, {model}: measured against predicted"),
        &format!("{observable} of the {model} [1]"),
        &format!("{observable} measured [1]"),
    )
    .x_range(low, high)
    .y_range(low - touch, high + touch)
    .y_step(edges[1] - edges[0])
    .points("held-out rows", &points)
    .line(AGREE, &[[low, low], [high, high]])
    .figure(
        &format!("parity-{}-{}", identifier(observable), if which == BASE { "before" } else { "after" }),
        &format!("{} held-out rows{outside}. The closer to the line, the better the prediction.", rows.len()),
    )
}

/// Captured shares over parts of the predicted probability, with their standard errors.
fn calibration(rows: &[[f64; 3]], which: usize) -> (Vec<[f64; 2]>, ErrorBars) {
    let mut sorted: Vec<[f64; 2]> = rows.iter().map(|numbers| [numbers[which], numbers[0]]).collect();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let most = (sorted.len() / CAPTURE_BINS).max(ROWS_A_BIN).min(sorted.len().max(1));
    let mean = |part: &[[f64; 2]], of: usize| part.iter().map(|p| p[of]).sum::<f64>() / part.len() as f64;
    let one = |part: &[[f64; 2]]| {
        let (x, y) = (mean(part, 0), mean(part, 1));
        let error = (y * (1.0 - y) / part.len() as f64).sqrt();
        ([x, y], (error.min(y), error.min(1.0 - y)))
    };
    sorted.chunks(most).filter(|part| 2 * part.len() >= most).map(one).unzip()
}

fn reliability(rows: &[[f64; 3]], models: &[(usize, &str)]) -> Figure {
    let heading = "Capture: measured against predicted";
    let chart = Chart::new(heading, "predicted probability of capture [1]", "share captured [1]");
    let mut chart = share_axis(chart.x_range(0.0, 1.0));
    for &(which, model) in models {
        let (points, errors) = calibration(rows, which);
        chart = chart.points_with_errors(model, &points, &errors);
    }
    let caption = format!(
        "{} held-out rows, sorted by the predicted probability and averaged in equal numbers; bars are standard errors. On \
         the line, the model predicts the share that was captured.",
        rows.len()
    );
    chart.line(AGREE, &[[0.0, 0.0], [1.0, 1.0]]).figure("parity-outcome", &caption)
}
