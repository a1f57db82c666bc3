//! A table of runs over one variable, beside published numbers: one figure a quantity.
//!
//! The CSV's first column names the run and the second is the variable. A quantity `Q` is drawn
//! when there is a column `Q_paper` beside it: its values with error bars from `Q_low95` and
//! `Q_high95`, or 1.96 `Q_standard_error`, and the published ones; `>0.85` is a lower bound, `-` or
//! a blank means no value. A column `Q_reference`, the result of another calculation of the same
//! quantity, is drawn, too.

use std::path::Path;

use super::{Chart, ErrorBars, Figure, Page, Table, number};

/// Why a table cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// The file cannot be read as CSV, or a line does not fit the header: the file, with the line
    /// if it is known, and what is wrong.
    #[error("{0}: {1}")]
    Unreadable(String, String),
    /// No column has a published partner.
    #[error("{0}:1: no quantity to draw; a column `Q` is drawn when a column `Q_paper` stands beside it")]
    NothingToDraw(String),
    /// The page cannot be filled.
    #[error(transparent)]
    Page(#[from] askama::Error),
}

struct Runs {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// The error of a file as a message.
fn fault(path: &Path, error: &csv::Error) -> SweepError {
    let line = error.position().map_or(String::new(), |position| format!(":{}", position.line()));
    let reason = match error.kind() {
        csv::ErrorKind::Io(error) => error.to_string(),
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => format!(
            "{len} cells where the header has {expected_len}; write one cell a column, \"-\" where there is nothing, \
                and put quotes around a text with a comma"
        ),
        csv::ErrorKind::Utf8 { .. } => "not UTF-8; save the table as UTF-8".to_owned(),
        _ => error.to_string(),
    };
    SweepError::Unreadable(format!("{}{line}", path.display()), reason)
}

impl Runs {
    fn read(path: &Path) -> Result<Self, SweepError> {
        let fault = |error: csv::Error| fault(path, &error);
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_path(path).map_err(fault)?;
        let header = reader.headers().map_err(fault)?.iter().map(str::to_owned).collect();
        let to_row = |record: csv::StringRecord| record.iter().map(str::to_owned).collect();
        let rows =
            reader.records().map(|record| record.map(to_row)).collect::<Result<_, _>>().map_err(fault)?;
        Ok(Self { header, rows })
    }

    /// The cells of a column; `None` when there is no such column.
    fn cells(&self, name: &str) -> Option<Vec<&str>> {
        let column = self.header.iter().position(|h| h == name)?;
        Some(self.rows.iter().map(|row| row.get(column).map_or("", String::as_str)).collect())
    }

    /// The numbers of a column, not a number where a cell is none; `None` when there is no such column.
    fn numbers(&self, name: &str) -> Option<Vec<f64>> {
        let to_number = |cell: &str| cell.trim_start_matches('>').parse().unwrap_or(f64::NAN);
        Some(self.cells(name)?.into_iter().map(to_number).collect())
    }

    fn quantities(&self) -> Vec<&str> {
        self.header.iter().filter_map(|name| name.strip_suffix("_paper")).collect()
    }

    /// Whether any quantity has error bars.
    fn has_errors(&self) -> bool {
        self.header.iter().any(|name| name.ends_with("_low95") || name.ends_with("_standard_error"))
    }

    /// Says so where a published number is a bound.
    fn caption(&self, quantity: &str) -> &'static str {
        let published = self.cells(&format!("{quantity}_paper")).unwrap_or_default();
        let bounded = published.iter().any(|cell| cell.starts_with('>'));
        if bounded { "A published lower bound stands at its number." } else { "" }
    }

    /// Half widths below and above each value.
    fn errors(&self, quantity: &str, values: &[f64]) -> Vec<(f64, f64)> {
        let column = |ending: &str| self.numbers(&format!("{quantity}_{ending}"));
        let pairs = match (column("low95"), column("high95"), column("standard_error")) {
            (Some(low), Some(high), _) => {
                low.iter().zip(&high).zip(values).map(|((l, h), v)| (v - l, h - v)).collect()
            }
            (_, _, Some(error)) => error.iter().map(|e| (1.96 * e, 1.96 * e)).collect(),
            _ => vec![(0.0, 0.0); values.len()],
        };
        let usable = |x: f64| if x.is_finite() { x.max(0.0) } else { 0.0 };
        pairs.into_iter().map(|(below, above): (f64, f64)| (usable(below), usable(above))).collect()
    }
}

/// The page of a table of runs.
///
/// # Errors
/// [`SweepError`] for a file that is no such table.
pub fn page(path: &Path) -> Result<String, SweepError> {
    let runs = Runs::read(path)?;
    let file = path.display().to_string();
    let variable = runs.header.get(1).cloned().unwrap_or_default();
    let nothing = || SweepError::NothingToDraw(file.clone());
    let x = runs.numbers(&variable).ok_or_else(nothing)?;
    if runs.quantities().is_empty() || runs.rows.is_empty() {
        return Err(nothing());
    }
    let label = readable(&variable);
    let mut page = Page::new("Runs beside published numbers");
    let bars = if runs.has_errors() { "; bars are 95 % intervals of the sampling" } else { "" };
    page.lead(format!("{} runs over {label}{bars}.", runs.rows.len()));
    let quantities = runs.quantities().into_iter().enumerate();
    let figures = quantities.map(|(index, quantity)| figure(&runs, quantity, &x, &label, index));
    page.figures(figures);
    page.table(table(&runs, &variable));
    page.foot(&format!("Made from {file}."));
    Ok(page.html()?)
}

/// A quantity over the variable `x`, simulated and published.
fn figure(runs: &Runs, quantity: &str, x: &[f64], label: &str, index: usize) -> Figure {
    let values = runs.numbers(quantity).unwrap_or_default();
    let published = runs.numbers(&format!("{quantity}_paper")).unwrap_or_default();
    let reference = runs.numbers(&format!("{quantity}_reference"));
    let over_x = |values: Vec<f64>| -> Vec<[f64; 2]> { x.iter().zip(values).map(|(x, y)| [*x, y]).collect() };
    let drawn: Vec<usize> =
        (0..values.len()).filter(|i| x[*i].is_finite() && values[*i].is_finite()).collect();
    let errors = runs.errors(quantity, &values);
    let points: Vec<[f64; 2]> = drawn.iter().map(|i| [x[*i], values[*i]]).collect();
    let bars: ErrorBars = drawn.iter().map(|i| errors[*i]).collect();
    let mut chart = Chart::new(&readable(quantity), label, &format!("{} [1]", readable(quantity)))
        .points_with_errors("simulated", &points, &bars)
        .published("published", &over_x(published));
    if over_decades(x) {
        chart = chart.log_x();
    }
    if let Some(reference) = reference {
        chart = chart.line("calculated otherwise", &over_x(reference));
    }
    chart.figure(&format!("sweep-{index}"), runs.caption(quantity))
}

/// Whether a variable is positive and spans more than a decade and a half: a logarithmic axis shows it better.
fn over_decades(x: &[f64]) -> bool {
    let (low, high) = x.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(*x), high.max(*x)));
    low > 0.0 && high > 30.0 * low
}

/// A column's name for the reader: `T_C` is a temperature, underscores become spaces.
fn readable(name: &str) -> String {
    if let Some(quantity) = name.strip_suffix("_paper") {
        return format!("{}, published", readable(quantity));
    }
    if let Some(quantity) = name.strip_suffix("_reference") {
        return format!("{}, calculated otherwise", readable(quantity));
    }
    match name {
        "T_C" => "temperature [°C]".to_owned(),
        "e_n" | "e_t" | "e_g" => name.to_owned(),
        _ => name.replace('_', " "),
    }
}

fn table(runs: &Runs, variable: &str) -> Table {
    let columns: Vec<String> = std::iter::once(variable.to_owned())
        .chain(
            runs.quantities()
                .into_iter()
                .flat_map(|q| [q.to_owned(), format!("{q}_reference"), format!("{q}_paper")])
                .filter(|name| runs.header.contains(name)),
        )
        .collect();
    let shown = |cell: &str| cell.parse().map_or_else(|_| cell.to_owned(), number);
    let cells: Vec<Vec<&str>> = columns.iter().filter_map(|name| runs.cells(name)).collect();
    let header: Vec<String> = columns.iter().map(|column| readable(column)).collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let row = |row: usize| cells.iter().map(|column| shown(column[row])).collect();
    Table::new("The same in numbers.", 0, &header, (0..runs.rows.len()).map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_becomes_a_figure_for_each_published_quantity() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        let text = "run,T_C,capture,capture_paper,e_n,e_n_standard_error,e_n_paper\n\
                    a,20,0.01,0,0.28,0.01,0.28\nb,120,0.99,>0.85,,,\n";
        std::fs::write(&path, text).unwrap();
        let html = page(&path).unwrap();
        assert_eq!(html.matches("<svg").count(), 2);
        assert!(
            html.contains("temperature [°C]") && html.contains("published") && html.contains("bars are 95")
        );
        let text = "run,Stk,hit,hit_reference,hit_paper\na,0.1,0,0,-\nb,10,0.8,0.81,0.82\n";
        std::fs::write(&path, text).unwrap();
        let html = page(&path).unwrap();
        assert!(html.contains("calculated otherwise") && html.contains("0.81") && !html.contains("bars are"));
        std::fs::write(&path, "run,T_C\na,20\n").unwrap();
        assert!(page(&path).unwrap_err().to_string().contains("Q_paper"));
        std::fs::write(&path, "run,T_C\na,20\nb,20,3\n").unwrap();
        let message = page(&path).unwrap_err().to_string();
        assert!(message.contains("t.csv:3: 3 cells where the header has 2;"), "{message}");
    }
}
