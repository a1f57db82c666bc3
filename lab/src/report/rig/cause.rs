//! One cause: its parameters, the alternatives, and what cannot be told from it.

use super::super::chart::{Chart, Figure};
use super::super::diagnosis::cause::{add_alternatives, parameters, resampled, significance};
use super::super::diagnosis::plot::{Window, identifier};
use super::super::diagnosis::{cause_title, form, rivals};
use super::super::format::listed;
use super::super::page::Page;
use crate::diagnose::{CauseCurve, Finding};
use nearwall::impact::INPUTS;

pub(super) fn add(page: &mut Page, finding: &Finding, place: usize) {
    page.heading(match finding.cause.strip_prefix("unknown:") {
        Some(_) => format!("Cause {}: unknown, depends on {}", place + 1, listed(&finding.variables, "and")),
        None => format!("Cause {}: {}", place + 1, cause_title(&finding.cause)),
    });
    page.lead(finding.explanation.replace('`', ""));
    let sigma = if finding.sigma > 0.0 {
        format!("Its significance is {} sigma. ", significance(finding))
    } else {
        String::new()
    };
    page.text(sigma + &resampled(finding.certainty));
    if !finding.parameters.is_empty() {
        page.table(parameters(finding));
    }
    for sentence in &finding.not_separable {
        page.text(sentence.replace('`', ""));
    }
    page.figures(finding.curve.as_ref().and_then(|curve| figure(finding, curve)));
    page.figures(finding.forms.first().and_then(|form| form::alone(form, input(finding)?, unit(finding))));
    add_alternatives(page, finding);
    if !finding.indistinguishable_from.is_empty() {
        page.subheading("What these experiments do not exclude");
        let same: Vec<String> =
            std::iter::once(&finding.cause).chain(&finding.indistinguishable_from).cloned().collect();
        page.text(format!(
            "These experiments do not exclude the others. The first is in the extended model. {}",
            rivals::to_separate(&same)
        ));
        page.table(rivals::candidates(&same));
    }
}

/// The fitted curve; `None` where it is a shift by one number.
fn figure(finding: &Finding, curve: &CauseCurve) -> Option<Figure> {
    let (input, unit) = (input(finding)?, unit(finding));
    let points = curve.at.iter().zip(&curve.adds);
    let points: Vec<[f64; 2]> = points.filter_map(|(at, adds)| Some([at.parse().ok()?, *adds])).collect();
    let ([first, ..], [.., last]) = (points.as_slice(), points.as_slice()) else { return None };
    let captures = finding.observable.starts_with("capture");
    let label = match (captures && !curve.factor, curve.factor) {
        (true, _) => "added to the log odds of capture [1]",
        (false, true) => "relative change of the restitution [1]",
        (false, false) => "added to the prediction [1]",
    };
    let chart = Chart::new(&format!("Fitted curve over {input}"), &format!("{input} [{unit}]"), label);
    let chart = chart.x_range(first[0], last[0]).mark_y(0.0, "");
    let (chart, _) = Window::new(&[], points.iter().map(|at| at[1]).chain([0.0])).draw(chart, "", &[]);
    let caption = format!(
        "{} heights over {input} of the impact, fitted to all readings together; level beyond the ends. The curve is \
            a description, not a law.",
        points.len()
    );
    let chart = chart.line("fitted curve", &points).points("", &points);
    Some(chart.figure(&format!("curve-{}", identifier(&finding.cause)), &caption))
}

/// The input or group of a curve or form.
fn input(finding: &Finding) -> Option<&str> {
    finding.variables.first().map(String::as_str)
}

/// Its unit; groups have none.
fn unit(finding: &Finding) -> &'static str {
    let own = INPUTS.iter().find(|one| input(finding) == Some(one.name));
    own.map_or("1", |one| one.unit)
}
