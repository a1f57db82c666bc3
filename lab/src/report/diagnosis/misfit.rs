//! Where the base model is wrong: its errors, its residuals against the columns that matter, and their ranking.

use super::super::format::{number, once_in};
use super::super::page::{Page, Table};
use super::fit;
use super::plot::{BASE, OBSERVABLES, identifier, residuals, title, triple};
use crate::diagnose::{Diagnosis, Misfit};

/// Most figures.
const MISFIT_FIGURES: usize = 8;
/// Figures where no column stands out.
const FEWEST_FIGURES: usize = 4;

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    let (base, sample) = (&diagnosis.base, &diagnosis.sample);
    page.heading("Where the base model is wrong");
    let one = |name: &str, value: Option<f64>| value.map(|value| vec![name.to_owned(), number(value)]);
    let errors = [
        one("e_n, root mean square error [1]", base.rmse_e_n),
        one("e_t, root mean square error [1]", base.rmse_e_t),
        // The mean log loss is minus the mean logarithm of that probability.
        one(
            "capture, probability given to what happened, geometric mean [1]",
            base.log_loss_stick.map(|loss| (-loss).exp()),
        ),
    ];
    let errors = errors.into_iter().flatten().collect();
    page.table(Table::new("Errors on all used rows.", 1, &["observable", "base model"], errors));
    page.text(summary(diagnosis));
    let figures = pairs(diagnosis).into_iter().filter_map(|(column, observable)| {
        let id = format!("misfit-{}-{}", identifier(observable), identifier(column));
        let heading = format!("Residuals of {} against {column}", title(observable));
        residuals(sample, [observable, column], &[(BASE, "base")], [&id, &heading])
    });
    page.figures(figures.take(MISFIT_FIGURES));
    if sample.rows.len() < diagnosis.rows.used {
        let (shown, used) = (sample.rows.len(), diagnosis.rows.used);
        page.note(format!("The figures of this page show {shown} of the {used} used rows."));
    }
    add_ranking(page, diagnosis);
}

/// The columns over which the base model fails, the worst first.
fn add_ranking(page: &mut Page, diagnosis: &Diagnosis) {
    let row = |one: &Misfit| {
        vec![
            one.column.clone(),
            title(one.observable).to_owned(),
            number((20.0 * one.gain).round() / 10.0),
            once_in(one.q_value),
        ]
    };
    if !diagnosis.misfit.is_empty() {
        page.table(Table::new(
            "Fall of chi-square by a free curve over one column, beyond that of a constant offset and less what its \
                number of parameters gains by chance.",
            2,
            &["column", "observable", "fall of chi-square", "by chance once in"],
            diagnosis.misfit.iter().map(row).collect(),
        ));
    }
}

/// What the figures below show.
fn summary(diagnosis: &Diagnosis) -> &'static str {
    if !(diagnosis.misfit.is_empty() && diagnosis.findings.is_empty()) {
        "Each figure shows measured minus base model over one column. A correct model scatters evenly about zero. \
            Means that are off zero by several of their error bars show where it fails."
    } else if fit::base_is_refuted(diagnosis) || !diagnosis.undecided.is_empty() {
        "The base model misses the data by more than chance allows, but no single column is proven to \
         be the reason. Each figure shows measured minus base model over one column."
    } else {
        "No column stands out beyond chance, given how many were tried. A misfit smaller than the error bars below \
            cannot be seen."
    }
}

/// Columns and observables to show, the worst misfit first: those of the causes, then those that stand out.
fn pairs(diagnosis: &Diagnosis) -> Vec<(&str, &'static str)> {
    let (misfit, sample) = (&diagnosis.misfit, &diagnosis.sample);
    let of_causes = diagnosis.findings.iter().flat_map(|finding| {
        finding.variables.iter().map(move |column| (column.as_str(), finding.observable))
    });
    let worst =
        OBSERVABLES.iter().filter_map(|observable| misfit.iter().find(|one| one.observable == *observable));
    let others = worst.chain(misfit).map(|one| (one.column.as_str(), one.observable));
    let mut chosen: Vec<(&str, &'static str)> = Vec::new();
    for pair in of_causes.chain(others) {
        if !chosen.contains(&pair) && chosen.len() < MISFIT_FIGURES {
            chosen.push(pair);
        }
    }
    if chosen.is_empty() {
        let seen = |observable: &&&str| sample.rows.iter().any(|row| triple(row, observable).is_some());
        let observable = OBSERVABLES.iter().find(seen).copied().unwrap_or("e_n");
        let columns = sample.columns.iter().take(FEWEST_FIGURES);
        return columns.map(|(column, _)| (column.as_str(), observable)).collect();
    }
    let rank = |(column, observable): &(&str, &str)| {
        misfit.iter().position(|one| one.column == *column && one.observable == *observable)
    };
    chosen.sort_by_key(|pair| rank(pair).unwrap_or(usize::MAX));
    chosen
}
