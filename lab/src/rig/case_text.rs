//! A case file as text, in which an experiment changes settings.
//!
//! A setting is a dotted key: `gas.temperature`, `particles.speed.mean`, `walls.NAME.temperature`
//! (`[[walls]]` by name), `particles.NAME.key` (several `[[particles]]` by name),
//! `model.walls.NAME.coverage` (a key of the model file). A number replaces the whole value:
//! `particles.speed = 2` makes the speed of all particles 2 m/s, `particles.speed.mean = 2` moves
//! the mean of a distribution.

use std::collections::BTreeMap;
use std::path::Path;

use toml_edit::{ArrayOfTables, DocumentMut, Item, TableLike, Value};

use super::case_number::CaseNumber;
use crate::simulate::{Case, number_of, split_errors};
use nearwall::input::{Document, InputError};

/// Why a setting cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingError {
    /// A case or model file cannot be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The text of a file is not TOML.
    #[error("{file}: not valid TOML: {reason}")]
    Text {
        /// The file.
        file: String,
        /// The reason.
        reason: String,
    },
    /// The case has no place for a setting, or not with this value.
    #[error("{experiment}: `{key}`: {reason}")]
    Setting {
        /// File, line and name of the experiment.
        experiment: String,
        /// The dotted key.
        key: String,
        /// The reason, with the remedy.
        reason: SettingFault,
    },
    /// The changed case cannot be read.
    #[error("{0}")]
    Case(String),
    /// The case with the settings of an experiment cannot be read.
    #[error("{experiment}: with its settings the case is at fault: {reason}")]
    Experiment {
        /// File, line and name of the experiment.
        experiment: String,
        /// The error of the case.
        reason: Box<SettingError>,
    },
}

/// Why a case has no place for a setting.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingFault {
    /// A part of the key names no table.
    #[error("the case has no `{part}` there, only {keys}")]
    NoTable {
        /// The part.
        part: String,
        /// The keys that are there.
        keys: String,
    },
    /// A part of the key names a value.
    #[error("`{0}` is a value in the case; make it a distribution there, or set `{0}` itself")]
    Value(String),
    /// A part of the key names a list, and the next one none of its tables.
    #[error("`{list}` is a list; name one of {names} after it")]
    List {
        /// The list.
        list: String,
        /// Names of its tables.
        names: String,
    },
    /// An observable is of a wall that the case does not have.
    #[error("the case has no wall `{wall}`; it has {walls}")]
    NoWall {
        /// The wall.
        wall: String,
        /// The walls of the case.
        walls: String,
    },
    /// Particles have a model file of their own.
    #[error("particles with a model file of their own cannot be diagnosed; give them the model of the case")]
    OwnModels,
}

/// The text of a case, with its model as a table in it.
#[derive(Debug, Clone)]
pub struct CaseText {
    name: String,
    folder: std::path::PathBuf,
    document: DocumentMut,
    /// As the user wrote it.
    original: DocumentMut,
    /// Standard errors that it states, by key.
    errors: BTreeMap<String, f64>,
    /// Name and text of the model file, or of the model's own tables.
    pub model: Document,
}

impl CaseText {
    /// Reads a case file and its model file.
    ///
    /// # Errors
    /// [`SettingError`] for a file that cannot be read.
    pub fn from_file(path: &Path) -> Result<Self, SettingError> {
        let case = Document::from_file(path)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        // All errors with file, line and key, before anything is changed.
        Case::from_file(path)?;
        let original = parse(&case)?;
        let (text, errors) = split_errors(case.text());
        let mut document = parse(&Document::new(case.name(), text))?;
        document.remove("sweep");
        let model = match document.get("model") {
            Some(Item::Value(Value::String(name))) => Document::from_file(&folder.join(name.value()))?,
            Some(Item::Table(table)) => {
                Document::new(case.name(), DocumentMut::from(table.clone()).to_string())
            }
            Some(Item::Value(Value::InlineTable(table))) => {
                Document::new(case.name(), DocumentMut::from(table.clone().into_table()).to_string())
            }
            _ => Document::new(case.name(), ""),
        };
        let text = Self { name: case.name().to_owned(), folder, document, original, errors, model };
        let model = text.model.clone();
        text.with_model(model)
    }

    /// Whether the case file has a `[sweep]`, which is left out here.
    pub fn has_sweep(&self) -> bool {
        self.original.contains_key("sweep")
    }

    /// The case with another model file.
    ///
    /// # Errors
    /// [`SettingError::Text`].
    pub fn with_model(mut self, model: Document) -> Result<Self, SettingError> {
        let mut table = parse(&model)?.as_table().clone();
        table.set_implicit(true);
        self.document.insert("model", Item::Table(table));
        self.model = model;
        Ok(self)
    }

    /// The case with the settings of an experiment, which messages call `experiment`.
    ///
    /// # Errors
    /// [`SettingError`] for a setting that the case does not have, or with an impossible value.
    pub fn with(&self, experiment: &str, settings: &[(String, String)]) -> Result<Case, SettingError> {
        let mut changed = self.clone();
        changed.change(experiment, settings)?;
        let read = self.read(&changed.document);
        read.map_err(|error| SettingError::Experiment {
            experiment: experiment.to_owned(),
            reason: Box::new(error),
        })
    }

    /// Changes settings, which messages say come from `experiment`.
    ///
    /// # Errors
    /// [`SettingError`] for a setting that the case does not have.
    pub fn change(&mut self, experiment: &str, settings: &[(String, String)]) -> Result<(), SettingError> {
        for (key, cell) in settings {
            set(&mut self.document, key, cell).map_err(|reason| SettingError::Setting {
                experiment: experiment.to_owned(),
                key: key.clone(),
                reason,
            })?;
        }
        Ok(())
    }

    /// The case of a changed text.
    ///
    /// # Errors
    /// [`SettingError::Case`].
    pub(super) fn read(&self, document: &DocumentMut) -> Result<Case, SettingError> {
        let read = Case::from_toml(&self.name, &document.to_string(), &self.folder);
        // Lines of the changed text mean nothing to the reader.
        read.map_err(|error| match error {
            InputError::Fault { problem, .. } => SettingError::Case(problem),
            other => other.into(),
        })
    }

    /// The numbers that may be wrong, with their standard errors, and the forces that may be missing.
    pub fn numbers(&self) -> Vec<CaseNumber> {
        let mut all = CaseNumber::all(&self.document, &self.errors);
        if let Ok(case) = self.read(&self.document) {
            all.extend(CaseNumber::places(&case, &self.document, &self.errors));
            all.extend(CaseNumber::forces(&case, &self.document));
        }
        all
    }

    /// As [`CaseText::with`], with a number of the case moved by so many standard errors.
    ///
    /// # Errors
    /// [`SettingError`] for a setting that the case does not have, or with an impossible value.
    pub(super) fn with_moved(
        &self,
        experiment: &str,
        settings: &[(String, String)],
        (number, widths): (&CaseNumber, f64),
    ) -> Result<Case, SettingError> {
        let mut changed = self.clone();
        changed.change(experiment, settings)?;
        number.shift(&mut changed.document, widths);
        self.read(&changed.document)
    }

    /// The user's text with numbers moved by so many standard errors, and another model file.
    pub fn extended(&self, moves: &[(&CaseNumber, f64)], model: &str) -> String {
        let mut document = self.original.clone();
        moves.iter().for_each(|(number, widths)| number.shift(&mut document, *widths));
        document.insert("model", toml_edit::value(model));
        document.to_string()
    }

    /// The text, with the model as a table in it.
    pub(super) fn document(&self) -> &DocumentMut {
        &self.document
    }

    /// The number that a setting has in the case, if it is one.
    pub fn number(&self, key: &str) -> Option<f64> {
        let (last, item) = find(&self.document, key)?;
        number_of(item.get(&last)?.as_value()?)
    }
}

fn parse(document: &Document) -> Result<DocumentMut, SettingError> {
    document.text().parse().map_err(|error: toml_edit::TomlError| SettingError::Text {
        file: document.name().to_owned(),
        reason: error.to_string(),
    })
}

/// The table of a key and the key's last part.
fn find<'a>(document: &'a DocumentMut, key: &str) -> Option<(String, &'a dyn TableLike)> {
    let mut parts: Vec<&str> = key.split('.').collect();
    let last = parts.pop()?.to_owned();
    let mut table: &dyn TableLike = document.as_table();
    let mut parts = parts.into_iter();
    while let Some(part) = parts.next() {
        table = match table.get(part)? {
            Item::ArrayOfTables(tables) => {
                let wanted = parts.next()?;
                tables.iter().find(|t| name_of(*t) == Some(wanted))?
            }
            item => item.as_table_like()?,
        };
    }
    Some((last, table))
}

fn name_of(table: &dyn TableLike) -> Option<&str> {
    table.get("name")?.as_str()
}

/// Sets a dotted key to a cell: a value of TOML, or a text.
fn set(document: &mut DocumentMut, key: &str, cell: &str) -> Result<(), SettingFault> {
    let value = cell.parse::<Value>().unwrap_or_else(|_| Value::from(cell));
    let (table, last) = table_mut(document, key)?;
    table.insert(last, Item::Value(value));
    Ok(())
}

/// The item with a dotted key.
pub(super) fn find_mut<'a>(document: &'a mut DocumentMut, key: &str) -> Option<&'a mut Item> {
    let (table, last) = table_mut(document, key).ok()?;
    table.get_mut(last)
}

/// The table of a dotted key and the key's last part.
fn table_mut<'a, 'k>(
    document: &'a mut DocumentMut,
    key: &'k str,
) -> Result<(&'a mut dyn TableLike, &'k str), SettingFault> {
    let mut parts: Vec<&str> = key.split('.').collect();
    let last = parts.pop().unwrap_or_default();
    let mut table: &mut dyn TableLike = document.as_table_mut();
    let mut parts = parts.into_iter();
    while let Some(part) = parts.next() {
        let keys = table.iter().map(|(key, _)| key.to_owned()).collect::<Vec<_>>().join(", ");
        let Some(item) = table.get_mut(part) else {
            return Err(SettingFault::NoTable { part: part.to_owned(), keys });
        };
        table = match item {
            Item::ArrayOfTables(tables) => named(tables, part, parts.next())?,
            item => item.as_table_like_mut().ok_or_else(|| SettingFault::Value(part.to_owned()))?,
        };
    }
    Ok((table, last))
}

/// Changes a number, or all numbers of a list, and keeps what stands around them.
pub(super) fn change_value(value: &mut Value, with: &dyn Fn(f64) -> f64) {
    if let Some(number) = number_of(value) {
        let decor = value.decor().clone();
        *value = Value::from(with(number));
        *value.decor_mut() = decor;
    } else if let Value::Array(list) = value {
        list.iter_mut().for_each(|one| change_value(one, with));
    }
}

/// The table of a list with a name.
fn named<'a>(
    tables: &'a mut ArrayOfTables,
    list: &str,
    wanted: Option<&str>,
) -> Result<&'a mut dyn TableLike, SettingFault> {
    let names: Vec<String> = tables.iter().filter_map(|t| name_of(t).map(str::to_owned)).collect();
    let found = tables.iter_mut().find(|table| name_of(*table) == wanted);
    let found = found.map(|table| table as &mut dyn TableLike);
    found.ok_or_else(|| SettingFault::List { list: list.to_owned(), names: names.join(", ") })
}
