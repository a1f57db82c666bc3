//! Dimensionless groups as columns: computed from the inputs, the base model, and columns of the file that state a
//! property of each row (`mu_p`, `sigma_p`, …); and the products of columns that have no unit.
//!
//! A group is a column only where every row has a value of it, and where no single column orders the rows as it does:
//! with one speed and many sizes, Weber's number says nothing that the size does not.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::column_product::{kind, products};
use super::data_split::{ColumnKind, Covariate, median};
use crate::dataset::{ColumnValues, Measurement, Measurements};
use nearwall::effect::CurveInput;
use nearwall::group::{GROUPS, GroupInfo, Quantity};
use nearwall::impact::ExtraInput;
use nearwall::model::Model;

/// Rows that tell whether another column orders the data as a group does.
const MOST_COMPARED: usize = 1000;
/// Values nearer than this share are the same [1].
const SAME: f64 = 1e-9;

/// The groups of the rows, beside the columns `known`. `lacks` tells rows without an input.
pub(super) fn group_columns(
    base: &Model,
    data: &Measurements,
    known: &[Covariate],
    lacks: &(dyn Fn(&Measurement) -> bool + Sync),
) -> Vec<Covariate> {
    let stated = stated_columns(base, data);
    let names: Vec<&str> = stated.iter().map(|(name, _)| *name).collect();
    let model = with_inputs(base, &names);
    let mut found: Vec<Covariate> = Vec::new();
    for place in base.groups_known(&names) {
        let group = &GROUPS[place];
        let is_new = |values: &Vec<f64>| {
            let others = known.iter().chain(&found);
            others.clone().all(|other| other.name != group.name)
                && !others.into_iter().any(|one| orders(one, values))
        };
        let values = values(&model, data, &stated, CurveInput::Group(place), lacks);
        if let Some(values) = values.filter(is_new) {
            let kind = ColumnKind::Group { factors: Vec::new(), needs: needs(group, &stated) };
            found.push(Covariate::new(group.name, "1", ColumnValues::Numbers(values), kind));
        }
    }
    for product in products(known) {
        let (name, values) = (product.name(known), product.values(known));
        let mut others = known.iter().chain(&found);
        if others.all(|other| other.name != name && !orders(other, &values)) {
            found.push(Covariate::new(&name, "1", ColumnValues::Numbers(values), kind(&product, known)));
        }
    }
    found
}

/// The columns of numbers that state a quantity of a group which the model does not declare itself.
fn stated_columns<'a>(base: &Model, data: &'a Measurements) -> Vec<(&'a str, &'a [f64])> {
    let quantities = GROUPS.iter().flat_map(|group| group.needs).filter_map(|need: &Quantity| need.input());
    let names: BTreeSet<&str> = quantities.collect();
    let declared = |name: &str| base.extra_inputs().iter().any(|input| input.name == name);
    let numbers = data.columns.iter().filter_map(|column| match &column.values {
        ColumnValues::Numbers(numbers) => Some((column.name.as_str(), numbers.as_slice())),
        ColumnValues::Labels { .. } => None,
    });
    numbers.filter(|(name, _)| names.contains(name) && !declared(name)).collect()
}

/// The model with these columns as inputs of its own, after those that it declares.
fn with_inputs(base: &Model, names: &[&str]) -> Model {
    let more = names.iter().map(|name| ExtraInput::number(name, f64::NAN));
    base.with_extra_inputs(base.extra_inputs().iter().cloned().chain(more).collect())
}

/// The value of each row; NaN for one that lacks an input, `None` where another row has no value.
fn values(
    model: &Model,
    data: &Measurements,
    stated: &[(&str, &[f64])],
    group: CurveInput,
    lacks: &(dyn Fn(&Measurement) -> bool + Sync),
) -> Option<Vec<f64>> {
    let first = model.extra_inputs().len() - stated.len().min(model.extra_inputs().len());
    let one = |(index, row): (usize, &Measurement)| {
        if lacks(row) {
            return Some(f64::NAN);
        }
        let mut impact = row.impact;
        let places = impact.extra.iter_mut().skip(first);
        places.zip(stated).for_each(|(place, (_, numbers))| *place = numbers[index]);
        model.group_value(row.wall, &impact, group).ok().filter(|value| value.is_finite())
    };
    data.rows.par_iter().enumerate().map(one).collect()
}

/// The columns among `stated` that a group needs, with their medians.
fn needs(group: &GroupInfo, stated: &[(&str, &[f64])]) -> Vec<(String, f64)> {
    let is_needed = |name: &str| group.needs.iter().any(|need| need.input() == Some(name));
    let needed = stated.iter().filter(|(name, _)| is_needed(name));
    needed.map(|(name, numbers)| ((*name).to_owned(), median(numbers.iter().copied()))).collect()
}

/// Whether a column of numbers alone gives the order of these values.
fn orders(column: &Covariate, values: &[f64]) -> bool {
    let ColumnValues::Numbers(numbers) = &column.values else { return false };
    let step = values.len().div_ceil(MOST_COMPARED).max(1);
    let pairs = numbers.iter().zip(values).step_by(step).filter(|(_, value)| value.is_finite());
    let mut pairs: Vec<[f64; 2]> = pairs.map(|(number, value)| [*number, *value]).collect();
    pairs.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
    let step = |pair: &[[f64; 2]]| {
        let [[x, a], [y, b]] = [pair[0], pair[1]];
        [same(a, b) || (!same(x, y) && b > a), same(a, b) || (!same(x, y) && b < a)]
    };
    let steps: Vec<[bool; 2]> = pairs.windows(2).map(step).collect();
    (0..2).any(|way| steps.iter().all(|step| step[way]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(numbers: &[f64]) -> Covariate {
        Covariate::new("x", "", ColumnValues::Numbers(numbers.to_vec()), ColumnKind::Further)
    }

    #[test]
    fn a_column_orders_what_rises_or_falls_with_it() {
        let x = column(&[3.0, 1.0, 2.0, 2.0]);
        assert!(orders(&x, &[9.0, 1.0, 4.0, 4.0]) && orders(&x, &[0.1, 1.0, 0.5, 0.5]));
        assert!(!orders(&x, &[9.0, 1.0, 4.0, 5.0]), "two values at one x");
        assert!(!orders(&x, &[1.0, 9.0, 12.0, 12.0]), "neither rises nor falls");
    }
}
