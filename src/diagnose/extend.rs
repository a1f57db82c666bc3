//! Writes the extended model: the base file as it stands, with the named terms added and the recalibrated numbers changed.

use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value, value};

use super::data_split::DataSplit;
use super::part::{Fitted, Part};
use crate::dataset::Values;

/// The text of the extended model. `intervals` are those of `parts`, in their order.
///
/// # Errors
/// When the base text cannot be edited.
pub(super) fn extended(
    base: &str,
    study: &DataSplit,
    parts: &[Fitted],
    intervals: &[Vec<[f64; 2]>],
    notes: &[String],
) -> Result<String, toml_edit::TomlError> {
    let mut document: DocumentMut = base.parse()?;
    let mut added = ArrayOfTables::new();
    for (fitted, ends) in parts.iter().zip(intervals) {
        match fitted.part {
            Part::Number(number) => {
                let [table, key] = number.key();
                if let Some(number) = fitted.values().first() {
                    document[table][key] = value(rounded(*number));
                }
            }
            Part::Effect(_) => added.push(effect(study, fitted, ends)),
        }
    }
    append(&mut document, added);
    let mut text = document.to_string();
    if !text.ends_with('\n') {
        text.push('\n');
    }
    for note in notes {
        // A note names columns, and a quoted header may hold line breaks: what follows one would be read as TOML.
        let line: String = note.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        text += &format!("# {line}\n");
    }
    Ok(text)
}

/// Adds the effects behind those that the base has, in whichever form it has them.
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

fn effect(study: &DataSplit, fitted: &Fitted, ends: &[[f64; 2]]) -> Table {
    let mut table = Table::new();
    let Part::Effect(kind) = fitted.part else { return table };
    table.insert("kind", value(kind.id));
    for ((parameter, number), [low, high]) in kind.parameters.iter().zip(fitted.values()).zip(ends) {
        let mut fit = InlineTable::new();
        fit.insert("value", rounded(number).into());
        fit.insert("low", rounded(*low).into());
        fit.insert("high", rounded(*high).into());
        fit.insert("unit", parameter.unit.into());
        table.insert(parameter.name, value(fit));
    }
    table.insert("valid", value(valid(study)));
    table.insert("source", value("fitted by nearwall diagnose"));
    table
}

/// The range of every input that varied in the rows of the fit.
fn valid(study: &DataSplit) -> InlineTable {
    let mut ranges = InlineTable::new();
    for factor in study.factors.iter().filter(|f| f.input && matches!(f.values, Values::Numbers(_))) {
        if let Some([low, high]) = study.range(&factor.name) {
            ranges.insert(
                &factor.name,
                Value::Array([outward(low, -1.0), outward(high, 1.0)].into_iter().collect()),
            );
        }
    }
    ranges
}

/// Six digits, rounded so that the rows at the ends of the range stay within it.
fn outward(end: f64, direction: f64) -> f64 {
    rounded(end + direction * 1e-5 * end.abs())
}

/// Six digits are more than a fit is worth, and easier to read than seventeen.
pub(super) fn rounded(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}
