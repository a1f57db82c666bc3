//! The columns against which the page shows the measured values, and the models' curves through them.

use super::data_split::{Covariate, DataSplit};
use super::gain::evaluate;
use super::hypothesis::Hypothesis;
use super::observable::Observable;
use super::record::{DataView, Finding};
use crate::dataset::{ColumnValues, Measurement};
use nearwall::impact::{INPUTS, Input};

/// Values of the column at which a curve is evaluated.
const CURVE_POINTS: usize = 80;
/// Largest number of rows behind a curve, and of rows averaged at each of its values.
const MOST_CURVE_ROWS: usize = 240;
const AVERAGED_ROWS: usize = 40;
/// Least number of rows averaged, if there are so many.
const LEAST_NEAREST: usize = 12;
/// Positive values that span more than this factor are evenly spaced in their logarithm.
const CURVE_LOGARITHMIC_SPAN: f64 = 30.0;
/// Number of parts by a second column, and least number of rows of each.
const COLUMN_PARTS: usize = 3;
const LEAST_PART: usize = 20;

/// The views of every measured observable: all rows against the main column, then parts of the rows by a second column.
pub(super) fn views(models: [&Hypothesis<'_>; 2], findings: &[Finding]) -> Vec<DataView> {
    let data = models[0].data;
    let mut views = Vec::new();
    for observable in Observable::ALL {
        let rows = data.held_out.iter().chain(&data.search).copied();
        let rows: Vec<usize> = rows.filter(|&row| observable.measured(&data.rows[row]).is_some()).collect();
        let columns = columns(data, findings, observable.name(), &rows);
        let Some(&main) = columns.first() else { continue };
        let view = |rows: &[usize], within| DataView {
            observable: observable.name(),
            column: main.name.clone(),
            within,
            curve: curve(models, main, rows, observable),
        };
        views.push(view(&rows, None));
        if let Some(second) = columns.get(1) {
            let parts = parts(second, &rows).into_iter();
            views.extend(parts.map(|(range, rows)| view(&rows, Some((second.name.clone(), range)))));
        }
    }
    views
}

/// The main column and, if a finding is about this observable, a second one, of the columns that
/// vary in these rows: the findings' own inputs, then `v_n` and `d` if they are among them, then
/// `v_n`; without any of these the column with most different values.
fn columns<'a>(
    data: &'a DataSplit,
    findings: &[Finding],
    observable: &str,
    rows: &[usize],
) -> Vec<&'a Covariate> {
    let about: Vec<&Finding> = findings.iter().filter(|finding| finding.observable == observable).collect();
    let count = if about.is_empty() { 1 } else { 2 };
    let about = if about.is_empty() { findings.iter().take(1).collect() } else { about };
    let names = about.into_iter().flat_map(|finding| finding.variables.iter().map(String::as_str));
    let (plain, own): (Vec<&str>, Vec<&str>) = names.partition(|name| ["v_n", "d"].contains(name));
    let named = own.into_iter().chain(plain).chain(["v_n"]).filter_map(|name| data.covariate(name));
    let mut columns: Vec<&Covariate> = Vec::new();
    for covariate in named.filter(|covariate| different_values(covariate, rows) > 1) {
        if columns.len() < count && columns.iter().all(|column| column.name != covariate.name) {
            columns.push(covariate);
        }
    }
    if columns.is_empty() && !rows.is_empty() {
        columns.extend(data.covariates.iter().max_by_key(|covariate| different_values(covariate, rows)));
    }
    columns
}

/// Number of different values of a column in these rows.
fn different_values(covariate: &Covariate, rows: &[usize]) -> usize {
    let mut cells: Vec<f64> =
        rows.iter().map(|&row| covariate.cell(row)).filter(|cell| cell.is_finite()).collect();
    cells.sort_by(f64::total_cmp);
    cells.dedup();
    cells.len()
}

/// Ranges of a column with about equally many of the rows each, or its most frequent values if these are few or labels.
fn parts(covariate: &Covariate, rows: &[usize]) -> Vec<([f64; 2], Vec<usize>)> {
    let mut sorted: Vec<f64> =
        rows.iter().map(|&row| covariate.cell(row)).filter(|cell| cell.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let mut values: Vec<&[f64]> = sorted.chunk_by(|a, b| a == b).collect();
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    if values.len() <= COLUMN_PARTS || matches!(covariate.values, ColumnValues::Labels { .. }) {
        values.sort_by_key(|value| std::cmp::Reverse(value.len()));
        ranges.extend(values.iter().take(COLUMN_PARTS).map(|value| [value[0]; 2]));
        ranges.sort_by(|a, b| a[0].total_cmp(&b[0]));
    } else {
        for part in sorted.chunks(sorted.len().div_ceil(COLUMN_PARTS)) {
            let from = ranges.last().map_or(part[0], |[_, end]| part[0].max(end.next_up()));
            ranges.extend(part.last().filter(|end| **end >= from).map(|end| [from, *end]));
        }
    }
    let part = |range: [f64; 2]| {
        let inside = |row: &usize| (range[0]..=range[1]).contains(&covariate.cell(*row));
        (range, rows.iter().copied().filter(inside).collect::<Vec<usize>>())
    };
    let parts: Vec<_> = ranges.into_iter().map(part).filter(|(_, rows)| rows.len() >= LEAST_PART).collect();
    if parts.len() > 1 { parts } else { Vec::new() }
}

/// Copies of rows that have a value of the column, for all values of a curve.
#[derive(Default)]
struct Copies {
    copies: Vec<Measurement>,
    originals: Vec<usize>,
    values: Vec<f64>,
    weights: Vec<f64>,
}

impl Copies {
    /// Adds copies of the rows nearest to a value of the column, each given with its distance, the nearest first.
    fn add(&mut self, data: &DataSplit, near: &[(f64, usize)], input: Option<(usize, &Input)>, value: f64) {
        let farthest = near.last().map_or(0.0, |(distance, _)| *distance).max(f64::MIN_POSITIVE);
        for &(distance, row) in near {
            let mut copy = data.rows[row];
            if let Some((place, input)) = input {
                (input.set)(&mut copy.impact, value);
                copy.stated[place] = true;
            }
            if data.base.check(copy.wall, &copy.impact).is_ok() {
                self.copies.push(copy);
                self.originals.push(row);
                self.values.push(value);
                // Never zero, because all rows may be equally far.
                self.weights.push((1.0 - 0.99 * (distance / farthest).powi(3)).powi(3));
            }
        }
    }

    /// Averages of both models over the copies of each value: value, base, extended.
    fn averages(
        &self,
        models: [&Hypothesis<'_>; 2],
        main: &Covariate,
        observable: Observable,
    ) -> Vec<[f64; 3]> {
        let Self { copies, originals, values, weights } = self;
        let data = models[0].data;
        let covariate = |other: &Covariate| {
            let own = other.name == main.name;
            let values = if own { ColumnValues::Numbers(values.clone()) } else { other.values.at(originals) };
            let blank = originals.iter().map(|&row| !own && other.blank[row]).collect();
            Covariate { values, blank, ..other.clone() }
        };
        let grid = data.with_rows(copies.clone(), data.covariates.iter().map(covariate).collect());
        let all = grid.all();
        let [base, extended] = models.map(|model| {
            let model = Hypothesis { data: &grid, ..model.clone() };
            evaluate(&model, &all).means().map(|(_, mean)| observable.predicted(&mean)).collect::<Vec<f64>>()
        });
        let point = |copies: &[usize]| {
            let total: f64 = copies.iter().map(|&copy| weights[copy]).sum();
            let mean = |of: &[f64]| copies.iter().map(|&copy| weights[copy] * of[copy]).sum::<f64>() / total;
            [values[copies[0]], mean(&base), mean(&extended)]
        };
        all.chunk_by(|&a, &b| values[a] == values[b]).map(point).collect()
    }
}

/// See [`DataView::curve`].
fn curve(
    models: [&Hypothesis<'_>; 2],
    main: &Covariate,
    rows: &[usize],
    observable: Observable,
) -> Vec<[f64; 3]> {
    let data = models[0].data;
    let ColumnValues::Numbers(numbers) = &main.values else { return Vec::new() };
    let mut seen: Vec<usize> = rows.iter().copied().filter(|&row| main.cell(row).is_finite()).collect();
    seen.sort_by(|&a, &b| numbers[a].total_cmp(&numbers[b]));
    let seen: Vec<usize> =
        seen.iter().copied().step_by(seen.len().div_ceil(MOST_CURVE_ROWS).max(1)).collect();
    let (Some(&first), Some(&last)) = (seen.first(), seen.last()) else { return Vec::new() };
    let (low, high) = (numbers[first], numbers[last]);
    let log = low > 0.0 && high > CURVE_LOGARITHMIC_SPAN * low;
    let place = |value: f64| if log { value.ln() } else { value };
    let nearest = (seen.len() / 6).clamp(LEAST_NEAREST, AVERAGED_ROWS).min(seen.len());

    let middles = (0..CURVE_POINTS)
        .map(|step| place(low) + (place(high) - place(low)) * step as f64 / (CURVE_POINTS - 1) as f64);
    let input = INPUTS.iter().enumerate().find(|(_, input)| main.is_input() && input.name == main.name);
    let mut all = Copies::default();
    for middle in middles {
        let value = if log { middle.exp() } else { middle }.clamp(low, high);
        let mut near: Vec<(f64, usize)> =
            seen.iter().map(|&row| ((place(numbers[row]) - middle).abs(), row)).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.truncate(nearest);
        all.add(data, &near, input, value);
    }
    all.averages(models, main, observable)
}

#[cfg(test)]
mod tests {
    use super::super::data_split::ColumnKind;
    use super::*;

    #[test]
    fn parts_have_equally_many_rows_and_share_none() {
        let covariate = |values: Vec<f64>| Covariate {
            name: "x".into(),
            unit: "",
            blank: vec![false; values.len()].into(),
            values: ColumnValues::Numbers(values),
            kind: ColumnKind::Further,
        };
        let rows: Vec<usize> = (0..90).collect();
        let even = covariate((0..90).map(f64::from).collect());
        let found = parts(&even, &rows);
        let counts: Vec<usize> = found.iter().map(|(_, rows)| rows.len()).collect();
        assert_eq!((counts, found[0].0), (vec![30; 3], [0.0, 29.0]));
        let two = covariate((0..90).map(|i| f64::from(i % 2)).collect());
        let ranges: Vec<[f64; 2]> = parts(&two, &rows).iter().map(|(range, _)| *range).collect();
        assert_eq!(ranges, [[0.0; 2], [1.0; 2]]);
        assert!(parts(&even, &rows[..40]).is_empty(), "too few rows a part");
    }
}
