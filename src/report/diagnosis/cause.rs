//! One cause: what it is, its numbers, why the others lost, and what it mends.

use super::super::chart::Figure;
use super::super::format::number;
use super::super::page::{Page, Table};
use super::axis::Axis;
use super::plot::{BASE, EXTENDED, Window, identifier, running, title, triple};
use super::{cause_title, chance, curve, spread, strings, usage};
use crate::diagnose::{Alternative, Diagnosis, Estimate, Finding};
use crate::effect::EFFECTS;

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis, finding: &Finding, place: usize) {
    let heading = match finding.cause.strip_prefix("unknown:") {
        Some(column) => format!("Cause {}: something that goes with {column}", place + 1),
        None => format!("Cause {}: {}", place + 1, finding.cause),
    };
    page.heading(heading);
    page.lead(finding.explanation.replace('`', ""));
    page.text(format!(
        "It predicts unseen rows better by {:.1} nats in all. The chance of that by luck, corrected for the number of \
         candidates, is q {}.",
        finding.gain,
        match chance(finding.q_value) {
            bound if bound.starts_with('<') => bound,
            value => format!("= {value}"),
        }
    ));
    if !finding.parameters.is_empty() {
        page.table(parameters(finding));
    }
    let figures = figures(diagnosis, finding);
    if !figures.is_empty() {
        page.figures(figures);
    }
    add_alternatives(page, finding);
    if !finding.indistinguishable_from.is_empty() {
        let others: Vec<String> =
            finding.indistinguishable_from.iter().map(|cause| cause_title(cause)).collect();
        page.text(format!(
            "With these data {} might as well be the cause: what is named here is the simplest of them, not proven.",
            others.join(" or ")
        ));
    }
    for measure in &finding.measure_next {
        page.text(usage::sentence(measure, &finding.cause));
    }
}

fn parameters(finding: &Finding) -> Table {
    let about = |name: &str| {
        let kind = EFFECTS.iter().find(|kind| kind.id == finding.cause)?;
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
    let row = |other: &Alternative| {
        let odds = (-other.score_difference).exp();
        vec![
            cause_title(&other.cause),
            format!("{:.1}", other.score_difference),
            if odds < 1e-4 { "< 0.0001".to_owned() } else { number(odds) },
        ]
    };
    page.table(Table {
        caption: "Why the others lost: how much worse they predict unseen rows.".into(),
        header: strings(["alternative", "score difference D [nats]", "exp(−D)"]),
        rows: finding.alternatives.iter().map(row).collect(),
        text_columns: 1,
    });
    let mut text =
        "Unseen rows are exp(−D) times as likely under the alternative: more than 3 nats (one in twenty) is \
                    clear, less than 1 is a draw."
            .to_owned();
    if finding.alternatives.iter().any(|other| other.score_difference < 0.0) {
        text += " A negative difference: the alternative predicts a little better, but needs more parameters, or says less \
                 than a law.";
    }
    page.note(text);
}

fn figures(diagnosis: &Diagnosis, finding: &Finding) -> Vec<Figure> {
    let id = match finding.cause.strip_prefix("unknown:") {
        Some(column) => format!("unknown-{}", identifier(column)),
        None => finding.cause.clone(),
    };
    let kind = EFFECTS.iter().find(|kind| kind.id == finding.cause);
    if kind.is_some_and(|kind| kind.stream.is_some()) && finding.observable != "outcome" {
        return spread::figures(diagnosis, finding, &id);
    }
    let mut figures = Vec::new();
    if let Some(shape) = &finding.curve {
        figures.extend(curve::figure(diagnosis, finding, shape, &id));
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
            let left = numbers[0] - numbers[which];
            left.is_finite().then_some([axis.at(row)?, left])
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
