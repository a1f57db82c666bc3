//! What was wrong: residuals of the base model against the columns that matter, and their ranking.

use super::super::chart::Figure;
use super::super::format::number;
use super::super::page::{Page, Table};
use super::axis::Axis;
use super::plot::{BASE, OBSERVABLES, Window, identifier, running, title, triple};
use super::{chance, strings};
use crate::diagnose::{Diagnosis, Misfit, Sample};

/// Figures at most.
const FIGURES: usize = 8;
/// Figures where no column stands out.
const LEAST_FIGURES: usize = 4;

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    page.heading("What was wrong");
    page.table(errors(diagnosis));
    let wrong = !(diagnosis.misfit.is_empty() && diagnosis.findings.is_empty());
    if wrong {
        page.text(
            "Each figure shows measured minus base model, over one column. A model without fault scatters evenly about \
             zero; running means that leave zero by several of their bars show where it fails.");
    } else {
        page.text(
            "No column stands out beyond chance, once it is counted how many were tried. A fault smaller than the bars below \
             cannot be seen with so many rows.");
    }
    let sample = &diagnosis.sample;
    let figures = pairs(diagnosis)
        .into_iter()
        .filter_map(|(column, observable)| residuals(sample, observable, column, wrong));
    let figures: Vec<Figure> = figures.take(FIGURES).collect();
    if !figures.is_empty() {
        page.figures(figures);
    }
    if sample.rows.len() < diagnosis.rows.used {
        page.note(format!(
            "The figures of this page show {} of the {} used rows.",
            sample.rows.len(),
            diagnosis.rows.used
        ));
    }
    add_ranking(page, &diagnosis.misfit);
}

fn errors(diagnosis: &Diagnosis) -> Table {
    let base = &diagnosis.base;
    let one = |name: &str, value: Option<f64>| value.map(|value| vec![name.to_owned(), number(value)]);
    let rows = [
        one("e_n, root mean square error [1]", base.rmse_e_n),
        one("e_t, root mean square error [1]", base.rmse_e_t),
        one("capture, mean log loss [nats]", base.log_loss_stick),
    ];
    Table {
        caption: "Errors on all used rows.".into(),
        header: strings(["observable", "base model"]),
        rows: rows.into_iter().flatten().collect(),
        text_columns: 1,
    }
}

fn add_ranking(page: &mut Page, misfit: &[Misfit]) {
    if misfit.is_empty() {
        return;
    }
    let row = |one: &Misfit| {
        vec![
            one.column.clone(),
            title(one.observable).to_owned(),
            format!("{:.1}", one.gain),
            chance(one.q_value),
        ]
    };
    page.table(Table {
        caption: "How much better a free curve over one column predicts rows that it was not fitted to, beyond what an \
                  error that is the same everywhere would give."
            .into(),
        header: strings(["column", "observable", "gain [nats]", "q"]),
        rows: misfit.iter().map(row).collect(),
        text_columns: 2,
    });
}

/// Columns and observables to show, the worst misfit first: those of the causes, then those that stand out.
fn pairs(diagnosis: &Diagnosis) -> Vec<(&str, &'static str)> {
    let misfit = &diagnosis.misfit;
    let mut chosen: Vec<(&str, &'static str)> = Vec::new();
    for finding in &diagnosis.findings {
        chosen.extend(finding.variables.iter().map(|column| (column.as_str(), finding.observable)));
    }
    // The worst of each observable.
    let worst = |observable: &&'static str| misfit.iter().find(|one| one.observable == *observable);
    chosen.extend(OBSERVABLES.iter().filter_map(worst).map(|one| (one.column.as_str(), one.observable)));
    chosen.extend(misfit.iter().map(|one| (one.column.as_str(), one.observable)));
    distinct(&mut chosen);
    chosen.truncate(FIGURES);
    if chosen.is_empty() {
        let sample = &diagnosis.sample;
        let seen = |observable: &&&str| sample.rows.iter().any(|row| triple(row, observable).is_some());
        let observable = OBSERVABLES.iter().find(seen).copied().unwrap_or("e_n");
        let columns = sample.columns.iter().map(|(name, _)| name.as_str());
        chosen.extend(columns.take(LEAST_FIGURES).map(|column| (column, observable)));
    }
    let rank = |(column, observable): &(&str, &str)| {
        misfit.iter().position(|m| m.column == *column && m.observable == *observable)
    };
    chosen.sort_by_key(|pair| rank(pair).unwrap_or(usize::MAX));
    chosen
}

fn distinct(pairs: &mut Vec<(&str, &'static str)>) {
    let mut kept: Vec<(&str, &str)> = Vec::new();
    pairs.retain(|pair| {
        let new = !kept.contains(pair);
        kept.push(*pair);
        new
    });
}

/// Measured minus base model over a column, with running means.
fn residuals(sample: &Sample, observable: &str, column: &str, wrong: bool) -> Option<Figure> {
    let axis = Axis::new(sample, column)?;
    let rows = sample.rows.iter();
    let points: Vec<[f64; 2]> = rows
        .filter_map(|row| {
            let numbers = triple(row, observable)?;
            Some([axis.at(row)?, numbers[0] - numbers[BASE]])
        })
        .collect();
    if points.is_empty() {
        return None;
    }
    let means = running(&points, axis.has_words());
    let quantity = title(observable);
    let label = match observable {
        "outcome" => "captured, measured − model [1]".to_owned(),
        _ => format!("{quantity}, measured − model [1]"),
    };
    // Single captures lie at two heights, which says nothing: only their means are drawn.
    let cloud: &[[f64; 2]] = if observable == "outcome" { &[] } else { &points };
    let window = Window::new(cloud, means.reach());
    let mut chart =
        window.on(axis.chart(&format!("{quantity} against {}", axis.name), &label)).mark_y(0.0, "");
    if !cloud.is_empty() {
        chart = chart.cloud("single rows", &window.inside);
    }
    let chart = chart.points_with_errors("running mean ± standard error", &means.means, &means.errors);
    let of = if axis.has_words() { "each word" } else { "parts of the column" };
    let see = if wrong {
        "Where the large points leave the dashed line, the base model errs."
    } else {
        "Noise: as far as the large points leave the dashed line, chance does that too."
    };
    let caption = format!("{see} {} rows; means over {of}.{}", points.len(), window.note());
    Some(chart.figure(&format!("misfit-{}-{}", identifier(observable), identifier(column)), &caption))
}
