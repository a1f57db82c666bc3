//! One cause: its parameters, its effect on the residuals, and the alternatives.

use super::super::chart::Figure;
use super::super::format::{by_chance, listed, number, whole_percent, with_interval};
use super::super::page::{Page, Table};
use super::axis::ColumnAxis;
use super::plot::{BASE, EXTENDED, identifier, residuals, title};
use super::{cause_title, curve, form, probability, spread, usage};
use crate::diagnose::{Alternative, CauseSurface, Diagnosis, Estimate, Finding};
use nearwall::effect::{EFFECTS, FormInfo};

/// A law whose lack of fit is less likely than this has another shape than the data.
const MISSHAPEN: f64 = 0.01;

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis, finding: &Finding, place: usize) {
    page.heading(match finding.cause.strip_prefix("unknown:") {
        Some(_) => format!("Cause {}: unknown, depends on {}", place + 1, listed(&finding.variables, "and")),
        None => format!("Cause {}: {}", place + 1, finding.cause),
    });
    page.lead(finding.explanation.replace('`', ""));
    page.text(strength(finding));
    page.text(certainty(finding));
    if let Some(p_value) = finding.lack_of_fit {
        page.text(shape(p_value));
    }
    if !finding.parameters.is_empty() {
        page.table(parameters(finding));
    }
    for sentence in &finding.not_separable {
        page.text(sentence.replace('`', ""));
    }
    if let Some(surface) = &finding.surface {
        page.table(heights(finding, surface));
    }
    page.figures(figures(diagnosis, finding));
    add_alternatives(page, finding);
    for measure in &finding.measure_next {
        page.text(usage::sentence(measure));
    }
}

/// Significance in standard deviations.
pub(in crate::report) fn significance(finding: &Finding) -> String {
    if finding.sigma > 0.0 { format!("{:.1}", finding.sigma) } else { "–".to_owned() }
}

/// Fall of chi-square, sigma and how often chance does the same.
fn strength(finding: &Finding) -> String {
    let mut text =
        format!("With it chi-square falls by {}.", number((10.0 * finding.chi_square).round() / 10.0));
    if finding.sigma > 0.0 {
        text += &format!(" That is {} sigma:", significance(finding));
    } else {
        text += " So large a fall";
    }
    let end = if finding.sigma > 0.0 { " it happens by chance" } else { " happens by chance" };
    text + end + &format!(" {}, given how many candidates were tried.", by_chance(finding.q_value))
}

/// How often resampled data name the cause, and what these data cannot tell it from.
fn certainty(finding: &Finding) -> String {
    let mut text = resampled(finding.certainty);
    if !finding.indistinguishable_from.is_empty() {
        let others: Vec<String> =
            finding.indistinguishable_from.iter().map(|cause| cause_title(cause)).collect();
        text += &format!(" These data do not exclude {}.", listed(&others, "or"));
    }
    text
}

/// How often resampled data name a cause.
pub(in crate::report) fn resampled(certainty: f64) -> String {
    let share = whole_percent(certainty);
    match certainty {
        share if share >= 0.9999 => "It is named in all resampled data sets.".to_owned(),
        sure if sure >= 0.8 => format!("It is named in {share} of resampled data sets."),
        likely if likely >= 0.5 => {
            format!(
                "It is named in {share} of resampled data sets: likely, but a few other rows could change the answer."
            )
        }
        _ => {
            format!("It is named in only {share} of resampled data sets: take it as a hint, not as a result.")
        }
    }
}

/// Whether the law has the shape of the data.
fn shape(p_value: f64) -> String {
    let by_chance = by_chance(p_value);
    if p_value < MISSHAPEN {
        return format!(
            "The shape of this law does not fit: a free curve over its inputs fits better, which happens by chance \
                {by_chance}.              Something acts along these inputs, but by another law than this one; do not \
                extrapolate it."
        );
    }
    format!(
        "The shape of this law fits: what a free curve over its inputs gains beyond it happens by chance {by_chance}."
    )
}

pub(in crate::report) fn parameters(finding: &Finding) -> Table {
    let effect = EFFECTS.iter().find(|kind| kind.id == finding.cause);
    let form = finding.forms.first().and_then(|form| FormInfo::from_name(form.form));
    let of_effect = effect.map(|effect| effect.parameters);
    let known = of_effect.or_else(|| form.map(|form| form.parameters)).unwrap_or_default();
    let about = |name: &str| {
        let parameter = known.iter().find(|known| known.name == name);
        parameter.map_or("", |parameter| parameter.about)
    };
    let row = |(name, estimate): (&&'static str, &Estimate)| {
        let (value, interval) = with_interval(estimate.value, [estimate.low, estimate.high]);
        vec![(*name).into(), about(name).into(), value, interval, estimate.unit.into()]
    };
    let header = ["parameter", "what it is", "value", "95 % interval", "unit"];
    Table::new("", 2, &header, finding.parameters.iter().map(row).collect())
}

/// The heights of a surface.
fn heights(finding: &Finding, surface: &CauseSurface) -> Table {
    let names: Vec<&str> = finding.variables.iter().map(String::as_str).collect();
    let [one, two] = names[..] else { return Table::default() };
    let caption = match (finding.observable, surface.factor) {
        ("outcome", _) => format!(
            "What the fitted surface adds to the log odds of capture over {one} (down) and {two} (across)."
        ),
        (observable, true) => {
            format!("Factor of the fitted surface on {observable} over {one} (down) and {two} (across).")
        }
        (observable, false) => {
            format!("What the fitted surface adds to {observable} over {one} (down) and {two} (across).")
        }
    };
    let short = |text: &String| text.parse().map_or_else(|_| text.clone(), number);
    let header: Vec<String> = std::iter::once(String::new()).chain(surface.at[1].iter().map(short)).collect();
    let height =
        |height: &f64| number(((if surface.factor { 1.0 } else { 0.0 } + height) * 1e3).round() / 1e3);
    let row = |(place, heights): (&String, &Vec<f64>)| {
        std::iter::once(short(place)).chain(heights.iter().map(height)).collect()
    };
    let rows = surface.at[0].iter().zip(&surface.adds).map(row).collect();
    Table { caption, header, rows, text_columns: 1 }
}

pub(in crate::report) fn add_alternatives(page: &mut Page, finding: &Finding) {
    let row = |other: &Alternative| {
        let difference = other.score_difference;
        vec![cause_title(&other.cause), format!("{:+.1}", 2.0 * difference), probability(other.probability)]
    };
    if finding.alternatives.is_empty() {
        return;
    }
    page.table(Table::new(
        "Other candidates, less what their number of parameters gains by chance.",
        1,
        &["alternative", "chi-square higher by", "probability"],
        finding.alternatives.iter().map(row).collect(),
    ));
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
    let forms = finding.forms.iter().filter_map(|one| form::figure(diagnosis, finding, one));
    curve.into_iter().chain(forms).chain(before_and_after(diagnosis, finding, &id)).collect()
}

/// Residuals of both models over the cause's own column, else over the speed, else over the first.
fn before_and_after(diagnosis: &Diagnosis, finding: &Finding, id: &str) -> Option<Figure> {
    let sample = &diagnosis.sample;
    let own = finding.variables.iter().map(String::as_str);
    let all = own.chain(["v_n"]).chain(sample.columns.iter().map(|(name, _)| name.as_str()));
    let column = { all }.find(|column| ColumnAxis::new(sample, column).is_some())?;
    let heading = format!("Residuals of {} against {column}, before and after", title(finding.observable));
    let models = [(BASE, "base"), (EXTENDED, "extended")];
    residuals(sample, [finding.observable, column], &models, [&format!("cause-{id}"), &heading])
}
