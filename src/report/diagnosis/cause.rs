//! One cause: its parameters, its effect on the residuals, and the alternatives.

use super::super::chart::Figure;
use super::super::format::{number, once_in, sigma};
use super::super::page::{Page, Table};
use super::axis::Axis;
use super::plot::{BASE, EXTENDED, identifier, residuals, title};
use super::{cause_title, curve, spread, usage};
use crate::diagnose::{Alternative, Diagnosis, Estimate, Finding};
use crate::effect::EFFECTS;

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis, finding: &Finding, place: usize) {
    page.heading(match finding.cause.strip_prefix("unknown:") {
        Some(column) => format!("Cause {}: unknown, depends on {column}", place + 1),
        None => format!("Cause {}: {}", place + 1, finding.cause),
    });
    page.lead(finding.explanation.replace('`', ""));
    page.text(format!(
        "With it the model predicts unseen rows better by {} sigma. By chance that would happen once in {} data sets, given \
         how many candidates were tried.",
        sigma(finding.gain),
        once_in(finding.q_value)
    ));
    if !finding.parameters.is_empty() {
        page.table(parameters(finding));
    }
    page.figures(figures(diagnosis, finding));
    add_alternatives(page, finding);
    if !finding.indistinguishable_from.is_empty() {
        let others = finding.indistinguishable_from.iter().map(|cause| cause_title(cause));
        page.text(format!(
            "These data cannot tell this cause from {}. The simplest of them is named; it is not proven.",
            others.collect::<Vec<_>>().join(" or ")
        ));
    }
    for measure in &finding.measure_next {
        page.text(usage::sentence(measure, &finding.cause));
    }
}

fn parameters(finding: &Finding) -> Table {
    let effect = EFFECTS.iter().find(|kind| kind.id == finding.cause);
    let about = |name: &str| {
        let parameter = effect.and_then(|effect| effect.parameters.iter().find(|known| known.name == name));
        parameter.map_or("", |parameter| parameter.about)
    };
    let row = |(name, estimate): (&&'static str, &Estimate)| {
        let interval = format!("{} to {}", number(estimate.low), number(estimate.high));
        vec![(*name).into(), about(name).into(), number(estimate.value), interval, estimate.unit.into()]
    };
    let header = ["parameter", "what it is", "value", "95 % interval", "unit"];
    Table::new("", 2, &header, finding.parameters.iter().map(row).collect())
}

fn add_alternatives(page: &mut Page, finding: &Finding) {
    let row = |other: &Alternative| {
        let difference = other.score_difference;
        let ratio = difference.exp();
        let ratio = if ratio > 1e4 { "> 10000".to_owned() } else { format!("{ratio:.2}") };
        vec![
            cause_title(&other.cause),
            if difference < 0.0 { "better".into() } else { sigma(difference) },
            ratio,
        ]
    };
    if finding.alternatives.is_empty() {
        return;
    }
    page.table(Table::new(
        "Other candidates: how much worse they predict unseen rows.",
        1,
        &["alternative", "worse by [sigma]", "unseen rows less likely by a factor of"],
        finding.alternatives.iter().map(row).collect(),
    ));
    let mut text = "A factor above 20 is clear; below 3 the data hardly decide.".to_owned();
    if finding.alternatives.iter().any(|other| other.score_difference < 0.0) {
        text += " A better alternative was not chosen because it needs more parameters or is a curve without a law.";
    }
    page.note(text);
}

fn figures(diagnosis: &Diagnosis, finding: &Finding) -> Vec<Figure> {
    let id = match finding.cause.strip_prefix("unknown:") {
        Some(column) => format!("unknown-{}", identifier(column)),
        None => finding.cause.clone(),
    };
    let effect = EFFECTS.iter().find(|effect| effect.id == finding.cause);
    if effect.is_some_and(|effect| effect.stream.is_some()) && finding.observable != "outcome" {
        return spread::figures(diagnosis, finding, &id);
    }
    let curve = finding.curve.as_ref().and_then(|shape| curve::figure(diagnosis, finding, shape, &id));
    curve.into_iter().chain(before_and_after(diagnosis, finding, &id)).collect()
}

/// Residuals of both models over the cause's own column, else over the speed, else over the first.
fn before_and_after(diagnosis: &Diagnosis, finding: &Finding, id: &str) -> Option<Figure> {
    let sample = &diagnosis.sample;
    let own = finding.variables.iter().map(String::as_str);
    let all = own.chain(["v_n"]).chain(sample.columns.iter().map(|(name, _)| name.as_str()));
    let column = { all }.find(|column| Axis::new(sample, column).is_some())?;
    let heading = format!("Residuals of {} against {column}, before and after", title(finding.observable));
    let caption = "With all causes of this page in the model, the means should lie on the dashed line.";
    let models = [(BASE, "base"), (EXTENDED, "extended")];
    residuals(sample, [finding.observable, column], &models, [&format!("cause-{id}"), &heading, caption])
}
