//! Writes the extended model: the base file with the fitted effects added and the recalibrated parameters changed.

use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value, value};

use super::data_split::DataSplit;
use super::hypothesis::Hypothesis;
use super::part::{FittedPart, Part, rounded};
use super::record::Estimate;
use crate::dataset::Values;
use crate::effect::EffectInfo;

/// The text of the extended model, with the notes as comments at its end.
///
/// # Errors
/// When the base text cannot be edited.
pub(super) fn extended(
    base: &str,
    hypothesis: &Hypothesis<'_>,
    notes: &[String],
) -> Result<String, toml_edit::TomlError> {
    let mut document: DocumentMut = base.parse()?;
    let mut added = ArrayOfTables::new();
    for fitted in &hypothesis.parts {
        match (fitted.part, fitted.values().first()) {
            (Part::LawParameter(parameter), Some(number)) => {
                let [table, key] = parameter.key();
                document[table][key] = value(rounded(*number));
            }
            (Part::LawParameter(_), None) => {}
            (Part::Effect(info), _) => added.push(effect(hypothesis.data, fitted, info)),
        }
    }
    append(&mut document, added);
    let mut text = document.to_string();
    if !text.ends_with('\n') {
        text.push('\n');
    }
    for note in notes {
        // A note contains column names, and a quoted header may contain line breaks, which would end the comment.
        let line: String = note.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        text += &format!("# {line}\n");
    }
    Ok(text)
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

fn effect(data: &DataSplit, fitted: &FittedPart, info: &EffectInfo) -> Table {
    let mut table = Table::new();
    table.insert("kind", value(info.id));
    for (name, Estimate { value: number, low, high, unit }) in fitted.estimates() {
        let mut fit = InlineTable::from_iter([("value", number), ("low", low), ("high", high)]);
        fit.insert("unit", unit.into());
        table.insert(name, value(fit));
    }
    table.insert("valid", value(valid(data)));
    table.insert("source", value("fitted by nearwall diagnose"));
    table
}

/// The range of every input that varies in the fitted rows.
fn valid(data: &DataSplit) -> InlineTable {
    let mut ranges = InlineTable::new();
    for column in data.covariates.iter().filter(|c| c.input && matches!(c.values, Values::Numbers(_))) {
        if let Some([low, high]) = data.range(&column.name) {
            // Rounded outwards, so that the rows at the ends stay within the range.
            let ends = [low - 1e-5 * low.abs(), high + 1e-5 * high.abs()].map(rounded);
            ranges.insert(&column.name, Value::Array(ends.into_iter().collect()));
        }
    }
    ranges
}
