//! The mass balance.

use super::{RunComparison, Table, number, percent};
use crate::results::{BalanceLine, RunResults, share};

/// One row for each line of a balance. A single run shows counts and shares, several runs their masses side by side.
pub(super) fn table(comparison: &RunComparison<'_>) -> Option<Table> {
    let mut names: Vec<&str> = Vec::new();
    for line in comparison.runs.iter().flat_map(|run| &run.balance) {
        if !names.contains(&line.what.as_str()) {
            names.push(&line.what);
        }
    }
    let mut table = Table {
        caption: String::new(),
        header: vec![String::new()],
        rows: names.iter().map(|name| vec![(*name).to_owned()]).collect(),
        text_columns: 1,
    };
    match comparison.runs {
        [run] => fill_single(&mut table, run),
        _ => fill_several(&mut table, comparison, &names),
    }
    Some(table)
}

fn mass(line: &BalanceLine) -> String {
    line.mass.map_or("–".to_owned(), number)
}

/// Counts and shares of one run.
fn fill_single(table: &mut Table, run: &RunResults) {
    let Table { header, rows, .. } = table;
    let injected = run.balance.first().and_then(|line| line.mass).unwrap_or(f64::NAN);
    header.extend(["particles", "mass [kg]", "of injected"].map(str::to_owned));
    for (row, line) in rows.iter_mut().zip(&run.balance) {
        let count = line.count.map_or("–".to_owned(), |count| count.to_string());
        row.extend([count, mass(line), percent(line.mass.map_or(f64::NAN, |mass| share(mass, injected)))]);
    }
    if run.balance.iter().all(|line| line.count.is_none()) {
        header.remove(1);
        rows.iter_mut().for_each(|row| drop(row.remove(1)));
    }
    table.caption = match run.residual {
        Some(residual) => format!("Injected minus all other terms, over injected: {}.", number(residual)),
        None => "The stock models keep no balance.".to_owned(),
    };
}

/// Masses of several runs side by side.
fn fill_several(table: &mut Table, comparison: &RunComparison<'_>, names: &[&str]) {
    let Table { header, rows, .. } = table;
    for (label, run) in comparison.each() {
        header.push(format!("{label} [kg]"));
        for (row, name) in rows.iter_mut().zip(names) {
            row.push(run.balance.iter().find(|line| line.what == *name).map_or("–".to_owned(), mass));
        }
    }
    let mut residuals = vec!["residual / injected [1]".to_owned()];
    residuals.extend(comparison.runs.iter().map(|run| run.residual.map_or("–".to_owned(), number)));
    rows.push(residuals);
    table.caption =
        "At each case's own last time. The stock models keep no balance: their escaped mass is what the \
        patches count, else the log's sum over all patches, else what was recorded as leaving."
            .to_owned();
}
