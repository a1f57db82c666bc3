//! One cause: what it is, its numbers, why the others lost, and what it mends.

use super::super::figure::{Chart, Figure};
use super::super::page::{Block, Page, Table, number};
use super::plot::{Axis, BASE, EXTENDED, OBSERVABLES, Window, identifier, running, span, title, triple};
use super::{cause_title, chance, strings, usage};
use crate::diagnose::{Diagnosis, Estimate, Finding, Shape};
use crate::effect::KINDS;

/// Bins of a histogram, about.
const BINS: usize = 30;

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis, finding: &Finding, place: usize) {
    let heading = match finding.cause.strip_prefix("unknown:") {
        Some(column) => format!("Cause {}: something that goes with {column}", place + 1),
        None => format!("Cause {}: {}", place + 1, finding.cause),
    };
    page.add(Block::Heading(heading));
    page.add(Block::Lead(finding.explanation.replace('`', "")));
    page.add(Block::Text(format!(
        "It predicts unseen rows better by {:.1} nats in all. The chance of that by luck, corrected for the number of \
         candidates, is q {}.",
        finding.gain,
        match chance(finding.q_value) {
            bound if bound.starts_with('<') => bound,
            value => format!("= {value}"),
        }
    )));
    if !finding.parameters.is_empty() {
        page.add(Block::Table(parameters(finding)));
    }
    let figures = figures(diagnosis, finding);
    if !figures.is_empty() {
        page.add(Block::Figures(figures));
    }
    add_alternatives(page, finding);
    if !finding.indistinguishable_from.is_empty() {
        let others: Vec<String> =
            finding.indistinguishable_from.iter().map(|cause| cause_title(cause)).collect();
        page.add(Block::Text(format!(
            "With these data {} might as well be the cause: what is named here is the simplest of them, not proven.",
            others.join(" or ")
        )));
    }
    for measure in &finding.measure_next {
        page.add(Block::Text(usage::sentence(measure, &finding.cause)));
    }
}

fn parameters(finding: &Finding) -> Table {
    let about = |name: &str| {
        let kind = KINDS.iter().find(|kind| kind.id == finding.cause)?;
        kind.parameters.iter().find(|parameter| parameter.name == name).map(|parameter| parameter.about)
    };
    let row = |(name, estimate): (&&'static str, &Estimate)| {
        vec![
            (*name).to_owned(),
            about(name).unwrap_or("").to_owned(),
            number(estimate.value),
            format!("{} to {}", number(estimate.low), number(estimate.high)),
            estimate.unit.to_owned(),
        ]
    };
    Table {
        caption: String::new(),
        header: strings(["parameter", "what it is", "value", "95 % interval", "unit"]),
        rows: finding.parameters.iter().map(row).collect(),
        text_columns: 2,
    }
}

fn add_alternatives(page: &mut Page, finding: &Finding) {
    if finding.alternatives.is_empty() {
        return;
    }
    let row = |other: &crate::diagnose::Alternative| {
        let odds = (-other.score_difference).exp();
        vec![
            cause_title(&other.cause),
            format!("{:.1}", other.score_difference),
            if odds < 1e-4 { "< 0.0001".to_owned() } else { number(odds) },
        ]
    };
    page.add(Block::Table(Table {
        caption: "Why the others lost: how much worse they predict unseen rows.".into(),
        header: strings(["alternative", "score difference D [nats]", "exp(−D)"]),
        rows: finding.alternatives.iter().map(row).collect(),
        text_columns: 1,
    }));
    let mut text =
        "Unseen rows are exp(−D) times as likely under the alternative: more than 3 nats (one in twenty) is \
                    clear, less than 1 is a draw."
            .to_owned();
    if finding.alternatives.iter().any(|other| other.score_difference < 0.0) {
        text += " A negative difference: the alternative predicts a little better, but needs more parameters, or says less \
                 than a law.";
    }
    page.add(Block::Note(text));
}

fn figures(diagnosis: &Diagnosis, finding: &Finding) -> Vec<Figure> {
    let id = match finding.cause.strip_prefix("unknown:") {
        Some(column) => format!("unknown-{}", identifier(column)),
        None => finding.cause.clone(),
    };
    let kind = KINDS.iter().find(|kind| kind.id == finding.cause);
    if kind.is_some_and(|kind| !kind.streams.is_empty()) && finding.observable != "outcome" {
        return scatter(diagnosis, finding, &id);
    }
    let mut figures = Vec::new();
    if let Some(shape) = &finding.curve {
        figures.extend(curve(diagnosis, finding, shape, &id));
    }
    figures.extend(before_and_after(diagnosis, finding, &id));
    figures
}

/// The column that shows a cause best: its own, else the speed, else the first.
fn main_axis<'a>(diagnosis: &'a Diagnosis, finding: &'a Finding) -> Option<Axis<'a>> {
    let own = finding.variables.iter().map(String::as_str);
    let others = diagnosis.sample.columns.iter().map(|(name, _)| name.as_str());
    own.chain(std::iter::once("v_n")).chain(others).find_map(|column| Axis::new(&diagnosis.sample, column))
}

/// Measured minus model, before and after, over the main variable.
fn before_and_after(diagnosis: &Diagnosis, finding: &Finding, id: &str) -> Option<Figure> {
    let axis = main_axis(diagnosis, finding)?;
    let left = |which: usize| {
        let rows = diagnosis.sample.rows.iter();
        rows.filter_map(|row| {
            let numbers = triple(row, finding.observable)?;
            Some([axis.at(row)?, numbers[0] - numbers[which]])
        })
        .collect::<Vec<[f64; 2]>>()
    };
    let (before, after) = (left(BASE), left(EXTENDED));
    if before.is_empty() {
        return None;
    }
    let (means, mended) = (running(&before, axis.has_words()), running(&after, axis.has_words()));
    let is_capture = finding.observable == "outcome";
    let cloud: &[[f64; 2]] = if is_capture { &[] } else { &before };
    let window = Window::new(cloud, means.reach().chain(mended.reach()));
    let quantity = title(finding.observable);
    let label =
        if is_capture { "captured".to_owned() } else { quantity.to_owned() } + ", measured − model [1]";
    let heading = format!("{quantity} against {}, before and after", axis.name);
    let mut chart = window.on(axis.chart(&heading, &label)).mark_y(0.0, "");
    if !cloud.is_empty() {
        chart = chart.cloud("rows, base model", &window.inside);
    }
    let chart = chart.points_with_errors("mean, base model", &means.means, &means.errors).points_with_errors(
        "mean, extended model",
        &mended.means,
        &mended.errors,
    );
    let caption = format!(
        "Running means ± standard error. With every cause of this page added, the squares should lie on the dashed \
         line.{}",
        window.note()
    );
    Some(chart.figure(&format!("cause-{id}"), &caption))
}

/// The curve over a column that no effect explains, with what the rest of the model leaves of the rows.
fn curve(diagnosis: &Diagnosis, finding: &Finding, shape: &Shape, id: &str) -> Option<Figure> {
    let sample = &diagnosis.sample;
    let axis = main_axis(diagnosis, finding)?;
    let mut line: Vec<[f64; 2]> = shape
        .at
        .iter()
        .zip(&shape.adds)
        .filter_map(|(at, adds)| Some([axis.find(sample, at)?, *adds]))
        .collect();
    line.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let bends = line.clone();
    // Beyond its outermost bends the curve is level.
    if let (Some([low, high]), Some(first), Some(last)) =
        (axis.ends(), bends.first().copied(), bends.last().copied())
    {
        if low < first[0] {
            line.insert(0, [low, first[1]]);
        }
        if high > last[0] {
            line.push([high, last[1]]);
        }
    }
    let quantity = title(finding.observable);
    let heading = format!("What goes with {}", axis.name);
    let (label, points) = match (finding.observable, shape.factor) {
        ("outcome", _) => ("added to the log odds of capture [1]".to_owned(), Vec::new()),
        (observable, true) => {
            let share = |measured: f64, extended: f64, adds: f64| measured / (extended / (1.0 + adds)) - 1.0;
            (
                format!("change of {quantity}, as a share of it [1]"),
                left(diagnosis, &axis, observable, &line, share),
            )
        }
        (observable, false) => {
            let rest = |measured: f64, extended: f64, adds: f64| measured - (extended - adds);
            (format!("added to {quantity} [1]"), left(diagnosis, &axis, observable, &line, rest))
        }
    };
    let means = running(&points, axis.has_words());
    let window = Window::new(&points, line.iter().map(|point| point[1]).chain(means.reach()));
    let mut chart = window.on(axis.chart(&heading, &label)).mark_y(0.0, "");
    if !points.is_empty() {
        chart = chart.cloud("rows without the curve", &window.inside);
        if !axis.has_words() {
            chart = chart.points_with_errors("mean ± standard error", &means.means, &means.errors);
        }
    }
    chart = if axis.has_words() {
        chart.reference("fitted level", &line).points_with_errors(
            "mean ± standard error",
            &means.means,
            &means.errors,
        )
    } else {
        chart.line("fitted curve", &line)
    };
    let caption = format!(
        "What the rest of the model leaves, and the curve fitted to it. This is a description, not a law: the cause has yet \
         to be found.{}",
        window.note()
    );
    Some(chart.figure(&format!("curve-{id}"), &caption))
}

/// What the model without the curve leaves of each row.
fn left(
    diagnosis: &Diagnosis,
    axis: &Axis<'_>,
    observable: &str,
    line: &[[f64; 2]],
    of: impl Fn(f64, f64, f64) -> f64,
) -> Vec<[f64; 2]> {
    let rows = diagnosis.sample.rows.iter();
    rows.filter_map(|row| {
        let numbers = triple(row, observable)?;
        let x = axis.at(row)?;
        let y = of(numbers[0], numbers[EXTENDED], along(line, x)?);
        y.is_finite().then_some([x, y])
    })
    .collect()
}

/// A line of points at `x`.
fn along(line: &[[f64; 2]], x: f64) -> Option<f64> {
    let right = line.partition_point(|point| point[0] <= x);
    match (right.checked_sub(1).and_then(|left| line.get(left)), line.get(right)) {
        (Some(a), Some(b)) => Some(a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])),
        (Some(one), None) | (None, Some(one)) => Some(one[1]),
        (None, None) => None,
    }
}

/// Causes that leave something to chance show in the spread: histograms of the values and of what the base leaves.
fn scatter(diagnosis: &Diagnosis, finding: &Finding, id: &str) -> Vec<Figure> {
    let observable = if finding.observable == "e_t" { "e_t" } else { OBSERVABLES[0] };
    let rows: Vec<[f64; 3]> =
        diagnosis.sample.rows.iter().filter_map(|row| triple(row, observable)).collect();
    if rows.len() < 2 {
        return Vec::new();
    }
    let own = if observable == "e_n" { diagnosis.scatter.e_n } else { diagnosis.scatter.e_t };
    histograms(&rows, observable, own, id).to_vec()
}

fn histograms(rows: &[[f64; 3]], observable: &str, own: f64, id: &str) -> [Figure; 2] {
    let of = |which: usize| rows.iter().map(|numbers| numbers[which]).collect::<Vec<f64>>();
    let residuals: Vec<f64> = rows.iter().map(|numbers| numbers[0] - numbers[BASE]).collect();
    let y_label = "share of the rows [%]";
    let edges = edges([of(0), of(BASE)].concat());
    let values =
        Chart::new(&format!("{observable}, measured and forecast"), &format!("{observable} [1]"), y_label)
            .histogram("measured", &edges, &shares(&of(0), &edges))
            .histogram("base model, without scatter", &edges, &shares(&of(BASE), &edges));
    let edges = self::edges(residuals.clone());
    let label = format!("{observable}, measured − base model [1]");
    let mut left = Chart::new(&format!("What the base model leaves of {observable}"), &label, y_label)
        .histogram("measured − base model", &edges, &shares(&residuals, &edges));
    if own > 0.0 {
        left = left.line("scatter of the rest alone", &bell(&edges, own));
    }
    [
        values.figure(
            &format!("spread-{id}"),
            "A single forecast a row is not enough here: the measured values spread wider, or have a second hump.",
        ),
        left.figure(
            &format!("residuals-{id}"),
            "The line is what scatter would leave were the base model right; what stands outside it is the cause's.",
        ),
    ]
}

/// Edges of bins over all but the outermost few values.
fn edges(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    let beyond = values.len() / 400;
    span(values[beyond], values[values.len() - 1 - beyond], BINS)
}

/// Shares [%] of the values between edges.
fn shares(values: &[f64], edges: &[f64]) -> Vec<f64> {
    let (low, step, bins) = (edges[0], edges[1] - edges[0], edges.len() - 1);
    let mut counts = vec![0.0; bins];
    for value in values {
        let place = (value - low) / step;
        if place >= 0.0 && place <= bins as f64 {
            counts[(place as usize).min(bins - 1)] += 100.0 / values.len() as f64;
        }
    }
    counts
}

/// A normal distribution about zero, in per cent a bin.
fn bell(edges: &[f64], deviation: f64) -> Vec<[f64; 2]> {
    let (low, high, step) = (edges[0], edges[edges.len() - 1], edges[1] - edges[0]);
    let density =
        |x: f64| (-0.5 * (x / deviation).powi(2)).exp() / (deviation * (2.0 * std::f64::consts::PI).sqrt());
    (0..=200)
        .map(|i| low + (high - low) * f64::from(i) / 200.0)
        .map(|x| [x, 100.0 * step * density(x)])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::figure::round_edges;
    use super::*;

    #[test]
    fn histograms_hold_all_rows_and_the_bell_its_whole() {
        let edges = round_edges(-1.0, 1.0, 20);
        assert!((shares(&[-0.95, 0.0, 0.5, 1.0], &edges).iter().sum::<f64>() - 100.0).abs() < 1e-9);
        let bell = bell(&edges, 0.1);
        let sum: f64 = bell.iter().map(|point| point[1]).sum::<f64>() * (2.0 / 200.0) / (edges[1] - edges[0]);
        assert!((sum - 100.0).abs() < 0.1, "{sum}");
    }

    #[test]
    fn a_cause_of_chance_shows_in_histograms() {
        let rows: Vec<[f64; 3]> = (0..200)
            .map(|i| f64::from(i % 20) * 0.01)
            .map(|e| [if e < 0.05 { 0.1 + e } else { 0.5 + e }, 0.6, 0.5])
            .collect();
        let [values, left] = histograms(&rows, "e_n", 0.05, "agglomerates");
        assert_eq!([values.id.as_str(), left.id.as_str()], ["spread-agglomerates", "residuals-agglomerates"]);
        for figure in [values, left] {
            assert!(figure.svg.contains("[1]") && !figure.svg.contains("NaN"), "{}", figure.svg);
        }
    }

    #[test]
    fn a_line_is_level_beyond_its_ends() {
        let line = [[1.0, 2.0], [3.0, 4.0]];
        let at = |x| along(&line, x).unwrap();
        assert_eq!([at(0.0), at(2.0), at(3.0), at(9.0)], [2.0, 3.0, 4.0, 4.0]);
        assert!(along(&[], 1.0).is_none());
    }
}
