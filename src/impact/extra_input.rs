//! Inputs that a model file declares: `[inputs.NAME]`.
//!
//! The library knows no law for such an input; a [`FittedCurve`](crate::effect::FittedCurve)
//! depends on it. It is a number, or a word of a list: its value is then the index of the word.

use super::{EXTRA_INPUTS, INPUTS};
use crate::input::{InputError, Section, unknown};

/// Columns of data files that are no inputs, and [`OBSERVED_ERROR`] of each input.
const OBSERVED_COLUMNS: [&str; 8] =
    ["e_n", "e_t", "outcome", "capture_efficiency", "captured", "e_n_err", "e_t_err", "n_impacts"];

/// The end of the name of a standard error.
const OBSERVED_ERROR: &str = "_err";

/// The value of a word that is not in the list.
const UNKNOWN_LABEL: f64 = -1.0;

/// An input that a model file declares.
#[derive(Debug, Clone)]
pub struct ExtraInput {
    /// Its name in data files, model files, C and OpenFOAM.
    pub name: String,
    /// The value of an impact that does not state it; NaN for none. A label's value is its index in `labels`.
    pub default: f64,
    /// The words of an input of words; empty for a number.
    pub labels: Vec<String>,
}

/// An input without a default equals itself.
impl PartialEq for ExtraInput {
    fn eq(&self, other: &Self) -> bool {
        let bits = |input: &Self| input.default.to_bits();
        self.name == other.name && bits(self) == bits(other) && self.labels == other.labels
    }
}

impl ExtraInput {
    /// An input that is a number.
    pub fn number(name: &str, default: f64) -> Self {
        Self { name: name.to_owned(), default, labels: Vec::new() }
    }

    /// An input that is one of these words, without a default.
    pub fn words(name: &str, labels: Vec<String>) -> Self {
        Self { name: name.to_owned(), default: f64::NAN, labels }
    }

    /// Whether it is a word.
    pub fn is_label(&self) -> bool {
        !self.labels.is_empty()
    }

    /// The value of a cell that is not blank: a finite number, or the index of a word. A word that
    /// is not in the list has a value on which no curve acts. `None` for a cell that should be a
    /// number and is not.
    pub fn value_of_text(&self, text: &str) -> Option<f64> {
        if self.is_label() {
            return Some(self.place(text).map_or(UNKNOWN_LABEL, |place| place as f64));
        }
        text.trim().parse().ok().filter(|value: &f64| value.is_finite())
    }

    /// The value as text: a number, or the word.
    pub fn text_of_value(&self, value: f64) -> String {
        let known = self.labels.iter().enumerate().find(|(place, _)| *place as f64 == value);
        known.map_or_else(|| value.to_string(), |(_, label)| label.clone())
    }

    /// Whether a value is that of a word which is not in the list.
    pub fn is_unknown(&self, value: f64) -> bool {
        self.is_label() && value == UNKNOWN_LABEL
    }

    /// The default as `name = value`; `None` without one.
    pub fn describe_default(&self) -> Option<String> {
        (!self.default.is_nan()).then(|| format!("{} = {}", self.name, self.text_of_value(self.default)))
    }

    /// The input in words.
    pub(crate) fn describe(&self) -> String {
        let kind =
            if self.is_label() { format!(", one of {}", self.labels.join(", ")) } else { String::new() };
        let default = if self.default.is_nan() {
            "no default".to_owned()
        } else {
            format!("default {}", self.text_of_value(self.default))
        };
        format!("{}{kind}, {default}", self.name)
    }

    /// The index of a word.
    pub(crate) fn place(&self, label: &str) -> Option<usize> {
        self.labels.iter().position(|own| own == label)
    }

    /// Why an input cannot have this name.
    pub fn refusal(name: &str) -> Option<&'static str> {
        let of_input = |name: &str| INPUTS.iter().any(|input| input.name == name);
        if of_input(name) {
            return Some("is an input that every model has; remove it, or give this one another name");
        }
        if OBSERVED_COLUMNS.contains(&name) || name.strip_suffix(OBSERVED_ERROR).is_some_and(of_input) {
            return Some("is an observed column of data files; give the input another name");
        }
        let unusable = name.trim() != name || name.is_empty() || name.chars().any(char::is_control);
        unusable.then_some("is no name for an input; use one without control characters and spaces around it")
    }

    fn read(name: &str, section: &Section<'_>) -> Result<Self, InputError> {
        if let Some(reason) = Self::refusal(name) {
            return Err(section.fault("", format!("`{name}` {reason}")));
        }
        let Some(labels) = section.texts("labels")? else {
            let default = section
                .number("default")?
                .ok_or_else(|| section.missing("default", "a number, or a list of words named `labels`,"))?;
            return Ok(Self::number(name, default));
        };
        let words = Self::words(name, labels);
        words.check_labels(section)?;
        let Some(text) = section.text("default")? else { return Ok(words) };
        let known: Vec<&str> = words.labels.iter().map(String::as_str).collect();
        let place =
            words.place(&text).ok_or_else(|| section.fault("default", unknown(&text, "label", &known)))?;
        Ok(Self { default: place as f64, ..words })
    }

    fn check_labels(&self, section: &Section<'_>) -> Result<(), InputError> {
        if self.labels.is_empty() {
            return Err(section.fault("labels", "the list is empty; add the words of the column"));
        }
        for (place, label) in self.labels.iter().enumerate() {
            if label.is_empty() {
                return Err(
                    section.fault("labels", "a label is blank; a blank cell is one that is not stated")
                );
            }
            if self.labels[..place].contains(label) {
                return Err(section.fault("labels", format!("`{label}` occurs twice; remove one of them")));
            }
        }
        Ok(())
    }
}

/// Reads `[inputs]`, where the file has it.
///
/// # Errors
/// [`InputError`] naming line, column and key.
pub(crate) fn read_extra_inputs(top: &Section<'_>) -> Result<Vec<ExtraInput>, InputError> {
    let Some(table) = top.section("inputs")? else { return Ok(Vec::new()) };
    let names = table.keys();
    if names.len() > EXTRA_INPUTS {
        let problem = format!("{} inputs are declared; at most {EXTRA_INPUTS} are possible", names.len());
        return Err(top.fault("inputs", problem));
    }
    let one = |name: &String| {
        let section = table.required_section(name)?;
        let input = ExtraInput::read(name, &section)?;
        section.finish()?;
        Ok(input)
    };
    names.iter().map(one).collect()
}
