//! Standard errors of a case's numbers, as the instruments state them.
//!
//! `temperature = { value = 1500, error = 30 }` is the number 1500 with a standard error of 30, in the
//! same unit; a distribution takes a key `error` beside its own keys, the error of its middle. The
//! simulation uses the numbers alone; `nearwall diagnose --case` the errors, too.

use std::collections::BTreeMap;
use std::ops::Range;

use toml_edit::{InlineTable, Item, TableLike, Value};

/// The tables of a case whose numbers may state errors.
const TABLES: [&str; 3] = ["gas", "particles", "walls"];

/// A case's text without the errors that it states, every other character at its place, and the
/// errors by dotted key, with the name of a table in a list: `walls.plate.temperature`. A text that
/// is no TOML stays as it is.
pub fn split_errors(text: &str) -> (String, BTreeMap<String, f64>) {
    let mut found = Found { text: text.to_owned(), errors: BTreeMap::new() };
    if let Ok(document) = toml_edit::Document::parse(text) {
        for key in TABLES {
            if let Some(item) = document.get(key) {
                found.item(item, key);
            }
        }
    }
    (found.text, found.errors)
}

/// The number that a value is, whole or not.
pub fn number_of(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

struct Found {
    text: String,
    errors: BTreeMap<String, f64>,
}

impl Found {
    fn item(&mut self, item: &Item, key: &str) {
        match item {
            Item::Table(table) => self.table(table, key),
            Item::ArrayOfTables(tables) => {
                for table in tables {
                    let name = table.get("name").and_then(Item::as_str).unwrap_or("?");
                    self.table(table, &format!("{key}.{name}"));
                }
            }
            Item::Value(Value::InlineTable(table)) => self.quantity(table, key),
            _ => {}
        }
    }

    fn table(&mut self, table: &dyn TableLike, key: &str) {
        table.iter().for_each(|(name, item)| self.item(item, &format!("{key}.{name}")));
    }

    /// Takes the error out of `{ value = 1, error = 2 }`, of which the value stays, or of a table with
    /// more keys.
    fn quantity(&mut self, table: &InlineTable, key: &str) {
        let Some((name, error)) = table.get_key_value("error") else {
            return self.table(table, key);
        };
        let Some(number) =
            error.as_value().and_then(number_of).filter(|number| *number > 0.0 && number.is_finite())
        else {
            return;
        };
        let value = table.get("value").and_then(Value::span);
        match (table.span(), value, name.span().zip(error.span())) {
            (Some(whole), Some(value), _) if table.len() == 2 => {
                self.blank(whole.start..value.start);
                self.blank(value.end..whole.end);
            }
            (.., Some((name, error))) => {
                let before = self.text[..name.start].trim_end();
                let start = if before.ends_with(',') { before.len() - 1 } else { name.start };
                self.blank(start..error.end);
            }
            _ => return,
        }
        self.errors.insert(key.to_owned(), number);
    }

    fn blank(&mut self, range: Range<usize>) {
        let spaces: String =
            self.text[range.clone()].chars().map(|c| if c == '\n' { c } else { ' ' }).collect();
        self.text.replace_range(range, &spaces);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_taken_out_and_everything_else_stays_at_its_place() {
        let text = "[gas]\ntemperature = { value = 1500, error = 30 } # K\nvelocity = { value = [0, 2], error = 0.1 }\n\
                    [particles]\nspeed = { distribution = \"normal\", mean = 2, error = 0.1, deviation = 1 }\n\
                    [[walls]]\nname = \"plate\"\ntemperature = { error = 5, value = 300 }\n[run]\na = { value = 1, \
                    error = 2 }\n";
        let (left, errors) = split_errors(text);
        let table: toml_edit::DocumentMut = left.parse().unwrap();
        assert_eq!(table["gas"]["temperature"].as_integer(), Some(1500));
        assert_eq!(table["gas"]["velocity"].as_array().unwrap().len(), 2);
        assert_eq!(table["particles"]["speed"].as_inline_table().unwrap().len(), 3);
        assert_eq!(table["walls"][0]["temperature"].as_integer(), Some(300));
        assert!(table["run"]["a"].is_inline_table());
        let all: Vec<(&str, f64)> = errors.iter().map(|(key, error)| (key.as_str(), *error)).collect();
        let expected = [
            ("gas.temperature", 30.0),
            ("gas.velocity", 0.1),
            ("particles.speed", 0.1),
            ("walls.plate.temperature", 5.0),
        ];
        assert_eq!(all, expected);
        assert_eq!(left.find("# K"), text.find("# K"));
        assert_eq!(left.len(), text.len());
    }
}
