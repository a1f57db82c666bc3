//! What the extended model gains, on rows that no fit and no choice saw.

use super::super::chart::{Chart, ErrorBars, Figure};
use super::super::format::number;
use super::super::page::{Page, Table};
use super::plot::{BASE, EXTENDED, OBSERVABLES, identifier, span, title, triple};
use super::strings;
use crate::diagnose::{Diagnosis, Gain};

/// Parts of the probability of capture, at most.
const CAPTURE_BINS: usize = 8;
/// Rows that a part takes at least.
const ROWS_A_BIN: usize = 10;
/// Share of the rows beyond each end of an axis, at most.
const BEYOND: f64 = 0.004;

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading("What is gained on rows that no fit saw");
    if diagnosis.gains.is_empty() {
        page.text(
            "Nothing was added to the model, so nothing is gained. The figures show how well it does as it is.");
    } else {
        page.table(table(&diagnosis.gains));
        let scores = diagnosis.gains.first().map(|gain| (gain.log_score_before, gain.log_score_after));
        let scores = scores.map_or(String::new(), |(before, after)| {
            format!(
                " The log score, of all observables of a row together, goes from {} to {} nats a row: an unseen row is {} \
                 times as likely under the extended model.",
                number(before),
                number(after),
                number((after - before).exp())
            )
        });
        page.text(format!(
            "Below 1 the extended model errs less; an interval wholly below 1 is no luck. For capture the error is that of \
             the probability.{scores}"
        ));
        let curves: Vec<&str> =
            diagnosis.findings.iter().filter(|f| f.curve.is_some()).map(|f| f.cause.as_str()).collect();
        if !curves.is_empty() {
            page.text(format!(
                "These numbers include {}, which a model file cannot carry: extended.toml alone gains less, or nothing.",
                curves.into_iter().map(super::cause_title).map(|c| format!("the {c}")).collect::<Vec<_>>().join(" and ")
            ));
        }
    }
    let figures: Vec<Figure> =
        OBSERVABLES.iter().flat_map(|observable| parity(diagnosis, observable)).collect();
    if !figures.is_empty() {
        page.figures(figures);
    }
}

/// Three decimals, or a dash for what is no number.
fn digits(value: f64) -> String {
    if value.is_finite() { format!("{value:.3}") } else { number(value) }
}

fn table(gains: &[Gain]) -> Table {
    let row = |gain: &Gain| {
        let ratio = gain.rmse_after / gain.rmse_before;
        let same = gain.rmse_after == gain.rmse_before;
        vec![
            title(gain.observable).to_owned(),
            gain.held_out_rows.to_string(),
            number(gain.rmse_before),
            number(gain.rmse_after),
            if same { "unchanged".to_owned() } else { digits(ratio) },
            if same {
                "–".to_owned()
            } else {
                format!("{} to {}", digits(gain.ci95[0]), digits(gain.ci95[1]))
            },
        ]
    };
    Table {
        caption: "Root mean square errors [1] on the held-out rows.".into(),
        header: strings([
            "observable",
            "rows",
            "before",
            "after",
            "after / before",
            "95 % interval of the ratio",
        ]),
        rows: gains.iter().map(row).collect(),
        text_columns: 1,
    }
}

/// Measured against predicted, held-out rows only; nothing where the extension changes nothing.
fn parity(diagnosis: &Diagnosis, observable: &str) -> Vec<Figure> {
    let rows = diagnosis.sample.rows.iter().filter(|row| row.held_out);
    let rows: Vec<[f64; 3]> = rows
        .filter_map(|row| triple(row, observable))
        .filter(|numbers| numbers[EXTENDED].is_finite())
        .collect();
    let changed = rows.iter().any(|numbers| numbers[BASE] != numbers[EXTENDED]);
    if rows.is_empty() || (!changed && !diagnosis.gains.is_empty()) {
        return Vec::new();
    }
    let sides: &[(usize, &str)] =
        if changed { &[(BASE, "base model"), (EXTENDED, "extended model")] } else { &[(BASE, "base model")] };
    if observable == "outcome" {
        let varied = sides.iter().any(|&(which, _)| calibration(&rows, which).0.len() > 1);
        return if varied { vec![reliability(&rows, sides)] } else { Vec::new() };
    }
    let ends = ends(&rows);
    sides.iter().map(|&(which, model)| scatter(observable, &rows, which, model, ends)).collect()
}

/// Ends of both axes that hold nearly all rows.
fn ends(rows: &[[f64; 3]]) -> [f64; 2] {
    let mut all: Vec<f64> = rows.iter().flatten().copied().collect();
    all.sort_by(f64::total_cmp);
    let beyond = (BEYOND * all.len() as f64) as usize;
    let edges = span(all[beyond], all[all.len() - 1 - beyond], 6);
    // Once more, so that the steps of both axes come out the same.
    let edges = span(edges[0], edges[edges.len() - 1], 6);
    [edges[0], edges[edges.len() - 1]]
}

fn scatter(observable: &str, rows: &[[f64; 3]], which: usize, model: &str, [low, high]: [f64; 2]) -> Figure {
    let inside = |point: &[f64; 2]| point.iter().all(|value| (low..=high).contains(value));
    let points: Vec<[f64; 2]> =
        rows.iter().map(|numbers| [numbers[which], numbers[0]]).filter(inside).collect();
    let beyond = match rows.len() - points.len() {
        0 => String::new(),
        count => format!(" Beyond the picture: {count}."),
    };
    let edges = span(low, high, 6);
    // A touch wider, so that rounding does not lose the ticks at the ends.
    let touch = 1e-9 * (high - low);
    Chart::new(
        &format!("{observable}, {model}: measured against predicted"),
        &format!("{observable} of the {model} [1]"),
        &format!("{observable} measured [1]"),
    )
    .x_range(low, high)
    .y_range(low - touch, high + touch)
    .y_step(edges[1] - edges[0])
    .points(&format!("{} held-out rows", rows.len()), &points)
    .line("measured = predicted", &[[low, low], [high, high]])
    .figure(
        &format!("parity-{}-{}", identifier(observable), if which == BASE { "before" } else { "after" }),
        &format!("The closer to the line, the better.{beyond}"),
    )
}

/// Captured shares over parts of the predicted probability, with their standard errors.
fn calibration(rows: &[[f64; 3]], which: usize) -> (Vec<[f64; 2]>, ErrorBars) {
    let mut sorted: Vec<[f64; 2]> = rows.iter().map(|numbers| [numbers[which], numbers[0]]).collect();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let most = (sorted.len() / CAPTURE_BINS).max(ROWS_A_BIN).min(sorted.len().max(1));
    let mean = |part: &[[f64; 2]], of: usize| part.iter().map(|p| p[of]).sum::<f64>() / part.len() as f64;
    sorted
        .chunks(most)
        .filter(|part| 2 * part.len() >= most)
        .map(|part| {
            let (x, y) = (mean(part, 0), mean(part, 1));
            let error = (y * (1.0 - y) / part.len() as f64).sqrt();
            ([x, y], (error.min(y), error.min(1.0 - y)))
        })
        .unzip()
}

fn reliability(rows: &[[f64; 3]], sides: &[(usize, &str)]) -> Figure {
    let mut chart = Chart::new(
        "Capture: measured against predicted",
        "predicted probability of capture [1]",
        "share captured [1]",
    )
    .x_range(0.0, 1.0)
    .y_range(-0.04, 1.04)
    .y_step(0.2);
    for &(which, model) in sides {
        let (points, errors) = calibration(rows, which);
        chart = chart.points_with_errors(model, &points, &errors);
    }
    chart.line("measured = predicted", &[[0.0, 0.0], [1.0, 1.0]]).figure(
        "parity-outcome",
        &format!(
            "{} held-out rows, sorted by the predicted probability and averaged over equally many each; ± standard error. \
             On the line, as many are captured as the model says.",
            rows.len()
        ),
    )
}
