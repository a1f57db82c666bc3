//! Writes the extended model: the base file with the fitted effects added and the recalibrated parameters changed.

use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value, value};

use super::closed_form::ClosedForm;
use super::constant_capture::ConstantCapture;
use super::curve::{ColumnCurve, ColumnCurveForm};
use super::data_split::{ColumnKind, Covariate, DataSplit};
use super::hypothesis::Hypothesis;
use super::observable::Observable;
use super::part::{FittedPart, Part, rounded};
use super::record::Estimate;
use super::smooth::Basis;
use crate::dataset::ColumnValues;
use nearwall::effect::EffectInfo;
use nearwall::model::Model;

/// What the file gives as the source of an effect.
const SOURCE: &str = "fitted by nearwall diagnose";

/// The text of the extended model.
///
/// # Errors
/// When the base text cannot be edited.
pub(super) fn extended(base: &str, hypothesis: &Hypothesis<'_>) -> Result<String, toml_edit::TomlError> {
    let mut document: DocumentMut = base.parse()?;
    let mut added = ArrayOfTables::new();
    for fitted in &hypothesis.parts {
        match (fitted.part, fitted.values().first()) {
            (Part::LawParameter(parameter), Some(number)) => parameter.write(&mut document, *number),
            (Part::LawParameter(_), None) => {}
            (Part::Effect(info), _) => added.push(effect(fitted, info, valid(hypothesis.data))),
        }
    }
    for curve in &hypothesis.curves {
        let before = document.clone();
        declare_inputs(&mut document, hypothesis.data, curve);
        let table = fitted_curve(hypothesis.data, curve);
        if is_readable(&document, &table) {
            added.push(table);
        } else {
            document = before;
        }
    }
    let ConstantCapture { rate, ceiling } = hypothesis.captures;
    let rate = (rate != 0.0).then_some((rate, false));
    for (height, factor) in ceiling.map(|ceiling| (ceiling - 1.0, true)).into_iter().chain(rate) {
        let form = ColumnCurveForm::level(Observable::Capture, factor);
        added.push(fitted_curve(hypothesis.data, &ColumnCurve::constant(form, height)));
    }
    Ok(with_effects(document, added))
}

/// The text of a model file with more effects.
pub(super) fn with_effects(mut document: DocumentMut, added: ArrayOfTables) -> String {
    append(&mut document, added);
    let mut text = document.to_string();
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text
}

/// Whether a model file with this curve can be read; not if the name of a column cannot be that of an input.
fn is_readable(document: &DocumentMut, curve: &Table) -> bool {
    let mut document = document.clone();
    append(&mut document, std::iter::once(curve.clone()).collect());
    Model::from_toml("extended.toml", &document.to_string()).is_ok()
}

/// Whether a model file contains a curve.
pub(super) fn contains(text: &str, curve: &ColumnCurve, data: &DataSplit) -> bool {
    let mut columns = curve.form.sides.iter().map(|(column, _)| &data.covariates[*column]);
    columns.all(|column| {
        let name = &column.name;
        column.kind != ColumnKind::Further
            || text.parse::<DocumentMut>().is_ok_and(|document| {
                document.get("inputs").is_some_and(|inputs| inputs.get(name.as_str()).is_some())
            })
    })
}

/// A curve, a surface, a closed form or a level shift as an effect.
fn fitted_curve(data: &DataSplit, curve: &ColumnCurve) -> Table {
    let on = match curve.form.observable {
        Observable::Capture => "capture",
        observable => observable.name(),
    };
    if let (Some(closed), Some((column, _))) = (&curve.closed, curve.form.sides.first()) {
        let Covariate { name, unit, .. } = &data.covariates[*column];
        return form_effect(on, (name, unit), closed, valid_over(data, curve));
    }
    let form = if curve.form.multiplicative { "factor" } else { "add" };
    let sides = &curve.form.sides;
    let knots: Vec<Value> = sides.iter().map(|(column, basis)| knots(data, *column, basis)).collect();
    let wide = sides.last().map_or(1, |(_, basis)| basis.len().max(1));
    let columns = curve.form.columns(data);
    curve_effect([on, form], &columns, &knots, (&curve.heights, wide), valid_over(data, curve))
}

/// A closed form over an input or group with its unit as an effect, with the intervals of its parameters.
pub(super) fn form_effect(
    on: &str,
    (input, unit): (&str, &'static str),
    closed: &ClosedForm,
    valid: InlineTable,
) -> Table {
    let mut table = Table::from_iter([("kind", value("fitted-form")), ("on", value(on))]);
    table.insert("form", value(closed.info.name));
    table.insert("acts", value(closed.acts.name()));
    table.insert("input", value(input));
    for (parameter, number) in closed.info.parameters.iter().zip(&closed.parameters) {
        table.insert(parameter.name, value(rounded(*number)));
    }
    insert_estimates(&mut table, closed.estimates(unit));
    table.insert("valid", value(valid));
    table.insert("source", value(SOURCE));
    table
}

/// The range of every input that varies in the fitted rows, and of the groups and further columns of a curve.
fn valid_over(data: &DataSplit, curve: &ColumnCurve) -> InlineTable {
    let columns = curve.form.sides.iter().map(|(column, _)| &data.covariates[*column]);
    let further = columns.filter(|column| !column.is_input());
    let further =
        ranges(further.filter_map(|column| Some((column.name.as_str(), data.range(&column.name)?))));
    let mut all = valid(data);
    all.extend(further);
    all
}

/// A curve, a surface or a level shift on an observable, in a form, over inputs with their knots.
/// The heights of a surface come with their number along its second input; `valid` are the ranges
/// of the inputs of the fit.
pub(super) fn curve_effect(
    [on, form]: [&str; 2],
    inputs: &[impl AsRef<str>],
    knots: &[Value],
    (heights, wide): (&[f64], usize),
    valid: InlineTable,
) -> Table {
    let names: Vec<&str> = inputs.iter().map(AsRef::as_ref).collect();
    let input = match names.as_slice() {
        [] => None,
        [one] => Some(value(*one)),
        several => Some(value(several.iter().copied().collect::<Array>())),
    };
    let kind = if input.is_some() { "fitted-curve" } else { "level-shift" };
    let mut table = Table::from_iter([("kind", value(kind))]);
    table.extend(input.map(|input| ("input", input)));
    table.extend([("on", value(on)), ("form", value(form))]);
    table.extend(match knots {
        [] => vec![("value", value(rounded(heights.first().copied().unwrap_or(0.0))))],
        [one] => vec![("knots", value(one.clone())), ("values", value(list(heights)))],
        several => vec![
            ("knots", value(several.iter().cloned().collect::<Array>())),
            ("values", value(heights.chunks(wide).map(list).collect::<Array>())),
        ],
    });
    table.extend([("valid", value(valid)), ("source", value(SOURCE))]);
    table
}

/// Numbers with six digits.
pub(super) fn list(numbers: &[f64]) -> Value {
    Value::Array(numbers.iter().map(|number| rounded(*number)).collect())
}

/// The knots of a column of numbers, or its labels.
fn knots(data: &DataSplit, column: usize, basis: &Basis) -> Value {
    match (basis, data.values(column)) {
        (Basis::Hats(knots), _) => Value::Array(knots.iter().copied().collect()),
        (Basis::Labels(_), ColumnValues::Labels { levels, .. }) => Value::Array(levels.iter().collect()),
        _ => Value::Array(Array::new()),
    }
}

/// Declares the columns of a curve, and those that its groups need, as inputs of the model where it does not have them.
fn declare_inputs(document: &mut DocumentMut, data: &DataSplit, curve: &ColumnCurve) {
    for (column, _) in &curve.form.sides {
        let covariate = &data.covariates[*column];
        match (&covariate.kind, &covariate.values) {
            (ColumnKind::Input, _) => {}
            (ColumnKind::Group { factors, needs }, _) => {
                declare_product(document, &covariate.name, factors);
                needs.iter().for_each(|(name, median)| declare(document, name, ("default", value(*median))));
            }
            (ColumnKind::Further, ColumnValues::Numbers(_)) => {
                declare(document, &covariate.name, ("default", value(covariate.median())));
            }
            (ColumnKind::Further, ColumnValues::Labels { levels, .. }) => {
                let labels = value(levels.iter().collect::<Array>());
                declare(document, &covariate.name, ("labels", labels));
            }
        }
    }
}

/// Declares a product of columns as a group of the model; nothing for a built-in group.
fn declare_product(document: &mut DocumentMut, name: &str, factors: &[(String, f64)]) {
    if factors.is_empty() {
        return;
    }
    let groups = document.entry("groups").or_insert_with(|| Item::Table(Table::new()));
    let powers = factors.iter().map(|(name, exponent)| (name.as_str(), Value::from(*exponent)));
    if let Some(groups) = groups.as_table_like_mut()
        && !groups.contains_key(name)
    {
        groups.insert(name, value(powers.collect::<InlineTable>()));
    }
}

/// Declares an input with one key.
fn declare(document: &mut DocumentMut, name: &str, (key, item): (&str, Item)) {
    let inputs = document.entry("inputs").or_insert_with(|| {
        let mut inputs = Table::new();
        inputs.set_implicit(true);
        Item::Table(inputs)
    });
    if let Some(inputs) = inputs.as_table_like_mut()
        && !inputs.contains_key(name)
    {
        inputs.insert(name, Item::Table(Table::from_iter([(key, item)])));
    }
}

/// Adds the effects after those of the base, in the notation of the base.
fn append(document: &mut DocumentMut, added: ArrayOfTables) {
    if added.is_empty() {
        return;
    }
    match document.get_mut("effects") {
        Some(Item::ArrayOfTables(tables)) => tables.extend(added),
        Some(Item::Value(Value::Array(array))) => {
            array.extend(added.into_iter().map(Table::into_inline_table));
        }
        _ => {
            document.insert("effects", Item::ArrayOfTables(added));
        }
    }
}

/// An effect with its fitted parameters and the ranges of the inputs of the fit.
pub(super) fn effect(fitted: &FittedPart, info: &EffectInfo, valid: InlineTable) -> Table {
    let mut table = Table::new();
    table.insert("kind", value(info.id));
    for (parameter, number) in info.parameters.iter().zip(fitted.values()) {
        table.insert(parameter.name, value(rounded(number)));
    }
    insert_estimates(&mut table, fitted.estimates());
    table.insert("valid", value(valid));
    table.insert("source", value(SOURCE));
    table
}

/// Writes parameters with their intervals.
fn insert_estimates(table: &mut Table, estimates: impl Iterator<Item = (&'static str, Estimate)>) {
    for (name, Estimate { value: number, low, high, unit }) in estimates {
        let mut fit = InlineTable::from_iter([("value", number), ("low", low), ("high", high)]);
        fit.insert("unit", unit.into());
        table.insert(name, value(fit));
    }
}

/// The range of every input that varies in the fitted rows.
fn valid(data: &DataSplit) -> InlineTable {
    let inputs =
        data.covariates.iter().filter(|c| c.is_input() && matches!(c.values, ColumnValues::Numbers(_)));
    ranges(inputs.filter_map(|column| Some((column.name.as_str(), data.range(&column.name)?))))
}

/// The ranges of inputs as a table.
pub(super) fn ranges<'a>(inputs: impl Iterator<Item = (&'a str, [f64; 2])>) -> InlineTable {
    let mut ranges = InlineTable::new();
    for (name, [low, high]) in inputs {
        // Rounded outwards, so that the rows at the ends stay within the range.
        let ends = [low - 1e-5 * low.abs(), high + 1e-5 * high.abs()].map(rounded);
        ranges.insert(name, Value::Array(ends.into_iter().collect()));
    }
    ranges
}
