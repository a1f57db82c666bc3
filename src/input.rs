//! Reads TOML files of users: every key is checked, every error names file, line, column and key.
//!
//! A [`Section`] is one table of the file. Reading a key marks it as known, whether or not it is present;
//! [`Section::finish`] then refuses every unknown key and proposes the nearest known one.

use std::cell::RefCell;
use std::io::Read;
use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// An error in a file of the user, with its remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InputError {
    /// The file cannot be read.
    #[error("{path}: cannot be read: {reason}")]
    Unreadable {
        /// The path as the user gave it.
        path: String,
        /// The message of the operating system.
        reason: String,
    },
    /// The content of the file has an error.
    #[error("{file}:{line}:{column}: {problem}")]
    Fault {
        /// The file's name as the user gave it.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// Column in characters, counted from 1.
        column: usize,
        /// The key with its table, the error and the remedy.
        problem: String,
    },
}

/// Limits of a quantity. A number outside them means a wrong exponent or unit.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// SI unit.
    pub unit: &'static str,
    /// Smallest allowed number.
    pub low: f64,
    /// Largest allowed number; may be infinite.
    pub high: f64,
    /// Known values near the limits, for the message; may be empty.
    pub known: &'static str,
}

impl Limits {
    /// Every positive number.
    pub const fn positive(unit: &'static str) -> Self {
        Self { unit, low: f64::MIN_POSITIVE, high: f64::INFINITY, known: "" }
    }

    /// Whether a number lies within the limits.
    pub fn allow(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

/// Largest file that is read [bytes]: a wrong path must not fill the memory.
const LARGEST_FILE: u64 = 16 << 20;

/// The text of a file, and its name for messages.
#[derive(Debug, Clone)]
pub struct Document {
    name: String,
    text: String,
}

impl Document {
    /// A text in memory; messages call the file `name`.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`InputError::Unreadable`] when it is missing, not readable or not UTF-8.
    pub fn from_file(path: &Path) -> Result<Self, InputError> {
        let name = path.display().to_string();
        let mut text = String::new();
        let read =
            std::fs::File::open(path).and_then(|file| file.take(LARGEST_FILE + 1).read_to_string(&mut text));
        let reason = match read {
            Ok(size) if size as u64 <= LARGEST_FILE => return Ok(Self { name, text }),
            Ok(_) => format!("larger than {} MB, which no model or case file is", LARGEST_FILE >> 20),
            Err(error) => error.to_string(),
        };
        Err(InputError::Unreadable { path: name, reason })
    }

    /// The name of the file in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text as it was read.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Parses the text, passes its top table to `read`, then refuses the keys that `read` did not read.
    ///
    /// # Errors
    /// [`InputError::Fault`] for text that is not TOML, and the errors of `read`.
    pub fn read<T>(&self, read: impl FnOnce(&Section<'_>) -> Result<T, InputError>) -> Result<T, InputError> {
        let table = DeTable::parse(&self.text).map_err(|error| {
            self.fault(error.span().unwrap_or(0..0), format!("not valid TOML: {}", error.message()))
        })?;
        let section = Section::new(self, String::new(), table.get_ref(), table.span());
        let value = read(&section)?;
        section.finish()?;
        Ok(value)
    }

    fn fault(&self, span: Range<usize>, problem: String) -> InputError {
        let before = self.text.get(..span.start).unwrap_or(&self.text);
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        InputError::Fault { file: self.name.clone(), line, column, problem }
    }
}

/// One table of a [`Document`].
pub struct Section<'a> {
    document: &'a Document,
    path: String,
    table: &'a DeTable<'a>,
    span: Range<usize>,
    known: RefCell<Vec<String>>,
}

/// What a list of texts has to be.
const TEXTS: &str = "a list of texts in quotes";

/// A list in a table.
pub struct List<'s, 'a> {
    section: &'s Section<'a>,
    key: &'s str,
    values: &'a DeArray<'a>,
}

impl List<'_, '_> {
    /// Its entries as finite numbers.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an entry that is not a finite number.
    pub fn numbers(&self) -> Result<Vec<f64>, InputError> {
        self.values.iter().map(|value| self.section.to_number(self.key, value)).collect()
    }

    /// Its entries as texts.
    ///
    /// # Errors
    /// [`InputError::Fault`] for an entry that is not a text.
    pub fn texts(&self) -> Result<Vec<String>, InputError> {
        let to_text = |value: Value<'_>| {
            let text = value.get_ref().as_str().map(str::to_owned);
            text.ok_or_else(|| self.section.wrong_type(self.key, TEXTS, value.get_ref()))
        };
        self.values.iter().map(to_text).collect()
    }
}

/// A value with its place in the file.
type Value<'a> = &'a Spanned<DeValue<'a>>;

impl<'a> Section<'a> {
    fn new(document: &'a Document, path: String, table: &'a DeTable<'a>, span: Range<usize>) -> Self {
        Self { document, path, table, span, known: RefCell::default() }
    }

    /// The table's name, empty for the top of the file.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The keys of the table, in the order of the file.
    pub fn keys(&self) -> Vec<String> {
        self.table.keys().map(|key| key.get_ref().to_string()).collect()
    }

    /// Whether the table has the key.
    pub fn has(&self, key: &str) -> bool {
        self.find(key).is_some()
    }

    /// An error at the position of `key`, or of the table when the key is absent.
    pub fn fault(&self, key: &str, problem: impl std::fmt::Display) -> InputError {
        let place = self.table.iter().find(|(name, _)| name.get_ref() == key);
        let span = place.map_or(self.span.clone(), |(name, _)| name.span());
        self.document.fault(span, format!("{}: {problem}", self.full(key)))
    }

    /// A finite number, or `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the value is not a finite number.
    pub fn number(&self, key: &str) -> Result<Option<f64>, InputError> {
        self.find(key).map(|value| self.to_number(key, value)).transpose()
    }

    /// A required finite number.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the key is absent or not a finite number.
    pub fn required_number(&self, key: &str) -> Result<f64, InputError> {
        self.number(key)?.ok_or_else(|| self.missing(key, "a number"))
    }

    /// A number in `low..=high`, or `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when it is not a number or outside the bounds.
    pub fn number_within(&self, key: &str, low: f64, high: f64) -> Result<Option<f64>, InputError> {
        match self.number(key)? {
            Some(value) if value < low || value > high => {
                Err(self.fault(key, format!("{} is outside {}", Short(value), range_text(low, high))))
            }
            other => Ok(other),
        }
    }

    /// A quantity within its limits, or `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when it is not a number or outside the limits.
    pub fn quantity(&self, key: &str, limits: &Limits) -> Result<Option<f64>, InputError> {
        match self.number(key)? {
            Some(value) if !limits.allow(value) => Err(self.outside(key, value, None, limits)),
            other => Ok(other),
        }
    }

    /// The error for a quantity outside its limits, with the temperature [K] where the quantity depends on it.
    pub fn outside(&self, key: &str, value: f64, temperature: Option<f64>, limits: &Limits) -> InputError {
        let Limits { unit, low, high, known } = *limits;
        let range = range_text(low, high);
        let at = temperature.map_or_else(String::new, |t| format!(" at {} K", Short(t)));
        let known = if known.is_empty() { String::new() } else { format!(" ({known})") };
        let remedy = match temperature {
            None => format!("check the exponent and the unit, {unit}"),
            Some(_) => format!("check the exponent, the temperatures and the unit, {unit}"),
        };
        self.fault(key, format!("{}{at} is outside {range}{known}; {remedy}", Short(value)))
    }

    /// A text, or `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the value is not a text.
    pub fn text(&self, key: &str) -> Result<Option<String>, InputError> {
        self.converted(key, "a text in quotes", |value| value.as_str().map(str::to_owned))
    }

    /// A required text.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the key is absent or not a text.
    pub fn required_text(&self, key: &str) -> Result<String, InputError> {
        self.text(key)?.ok_or_else(|| self.missing(key, "a text"))
    }

    /// A truth value, or `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the value is neither `true` nor `false`.
    pub fn boolean(&self, key: &str) -> Result<Option<bool>, InputError> {
        self.converted(key, "true or false", DeValue::as_bool)
    }

    /// A list of finite numbers, or `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the value is not a list of finite numbers.
    pub fn numbers(&self, key: &str) -> Result<Option<Vec<f64>>, InputError> {
        let list = self.converted(key, "a list of numbers", DeValue::as_array)?;
        list.map(|values| List { section: self, key, values }.numbers()).transpose()
    }

    /// A list of texts, or `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the value is not a list of texts.
    pub fn texts(&self, key: &str) -> Result<Option<Vec<String>>, InputError> {
        let list = self.converted(key, TEXTS, DeValue::as_array)?;
        list.map(|values| List { section: self, key, values }.texts()).transpose()
    }

    /// The lists in a list, or the list itself where its first entry is none; `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the value is not a list, or lists and other values are mixed.
    pub fn lists<'s>(&'s self, key: &'s str) -> Result<Option<Vec<List<'s, 'a>>>, InputError> {
        let Some(outer) = self.converted(key, "a list", DeValue::as_array)? else { return Ok(None) };
        if outer.first().is_none_or(|first| first.get_ref().as_array().is_none()) {
            return Ok(Some(vec![List { section: self, key, values: outer }]));
        }
        let to_list = |value: Value<'a>| {
            let values = value.get_ref().as_array();
            let values = values.ok_or_else(|| self.wrong_type(key, "a list of lists", value.get_ref()))?;
            Ok(List { section: self, key, values })
        };
        outer.iter().map(to_list).collect::<Result<_, _>>().map(Some)
    }

    /// Whether the value of `key` is a list (some keys take a text or a list).
    pub fn is_list(&self, key: &str) -> bool {
        matches!(self.find(key).map(Spanned::get_ref), Some(DeValue::Array(_)))
    }

    /// A pair `[low, high]` with `low <= high`, or `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the value is anything else.
    pub fn range(&self, key: &str) -> Result<Option<[f64; 2]>, InputError> {
        match self.numbers(key)?.as_deref() {
            None => Ok(None),
            Some(&[low, high]) if low <= high => Ok(Some([low, high])),
            Some(_) => Err(self.fault(key, "expected [low, high] with low not above high")),
        }
    }

    /// A table inside this one, or `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the value is not a table.
    pub fn section(&self, key: &str) -> Result<Option<Section<'a>>, InputError> {
        let table = self.converted(key, "a table", DeValue::as_table)?;
        Ok(table
            .zip(self.find(key))
            .map(|(table, value)| Section::new(self.document, self.full(key), table, value.span())))
    }

    /// A required table.
    ///
    /// # Errors
    /// [`InputError::Fault`] when it is absent or not a table.
    pub fn required_section(&self, key: &str) -> Result<Section<'a>, InputError> {
        self.section(key)?.ok_or_else(|| self.missing(key, "a table"))
    }

    /// The tables of a `[[key]]` list, empty when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] when the value is not a list of tables.
    pub fn sections(&self, key: &str) -> Result<Vec<Section<'a>>, InputError> {
        let expected = "a list of tables";
        let list = self.converted(key, expected, DeValue::as_array)?;
        let to_section = |(index, value): (usize, Value<'a>)| {
            let wrong = || self.wrong_type(key, expected, value.get_ref());
            let path = format!("{}[{}]", self.full(key), index + 1);
            let table = value.get_ref().as_table().ok_or_else(wrong)?;
            Ok(Section::new(self.document, path, table, value.span()))
        };
        list.into_iter().flatten().enumerate().map(to_section).collect()
    }

    /// Whether the value of `key` is a table (some keys take a number or a table).
    pub fn is_section(&self, key: &str) -> bool {
        matches!(self.find(key).map(Spanned::get_ref), Some(DeValue::Table(_)))
    }

    /// One of a fixed set of words; `None` when the key is absent.
    ///
    /// # Errors
    /// [`InputError::Fault`] naming the nearest known word when the value is none of them.
    pub fn choice(&self, key: &str, words: &[&str]) -> Result<Option<String>, InputError> {
        match self.text(key)? {
            Some(word) if !words.contains(&word.as_str()) => {
                Err(self.fault(key, unknown(&word, "value", words)))
            }
            other => Ok(other),
        }
    }

    /// Refuses the keys that were not read.
    ///
    /// # Errors
    /// [`InputError::Fault`] at the first unknown key, with the nearest known one.
    pub fn finish(&self) -> Result<(), InputError> {
        let known = self.known.borrow();
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        for name in self.table.keys() {
            let key: &str = name.get_ref();
            if !known.contains(&key) {
                return Err(self.fault(key, unknown(key, "key", &known)));
            }
        }
        Ok(())
    }

    /// The error for a missing key. Where the table has a misspelt form of it, the error names that instead.
    pub fn missing(&self, key: &str, what: &str) -> InputError {
        let known = self.known.borrow();
        let misspelt = self
            .table
            .keys()
            .map(|name| name.get_ref())
            .find(|name| !known.iter().any(|asked| asked == *name) && alike(name, key));
        if let Some(name) = misspelt {
            return self.fault(name, format!("unknown key `{name}`; did you mean `{key}`?"));
        }
        let place = if self.path.is_empty() { "the file".to_owned() } else { format!("[{}]", self.path) };
        self.fault(key, format!("missing; add {what} named `{key}` to {place}"))
    }

    /// The converted value of `key`, `None` when the key is absent; an error naming the `expected`
    /// type where `convert` fails.
    fn converted<T>(
        &self,
        key: &str,
        expected: &str,
        convert: impl FnOnce(&'a DeValue<'a>) -> Option<T>,
    ) -> Result<Option<T>, InputError> {
        let Some(value) = self.find(key) else { return Ok(None) };
        let wrong = || self.wrong_type(key, expected, value.get_ref());
        convert(value.get_ref()).ok_or_else(wrong).map(Some)
    }

    fn find(&self, key: &str) -> Option<Value<'a>> {
        let mut known = self.known.borrow_mut();
        if !known.iter().any(|name| name == key) {
            known.push(key.to_owned());
        }
        self.table.iter().find(|(name, _)| name.get_ref() == key).map(|(_, value)| value)
    }

    fn full(&self, key: &str) -> String {
        match (self.path.as_str(), key) {
            ("", key) => key.to_owned(),
            (path, "") => path.to_owned(),
            (path, key) => format!("{path}.{key}"),
        }
    }

    fn to_number(&self, key: &str, value: Value<'a>) -> Result<f64, InputError> {
        let parsed = match value.get_ref() {
            DeValue::Float(number) => number.as_str().replace('_', "").parse::<f64>().ok(),
            DeValue::Integer(number) => {
                i64::from_str_radix(&number.as_str().replace('_', ""), number.radix())
                    .ok()
                    .map(|whole| whole as f64)
            }
            other => return Err(self.wrong_type(key, "a number in SI units", other)),
        };
        match parsed {
            // Negative zero becomes zero, so that its reciprocal has the right sign.
            Some(number) if number.is_finite() => Ok(number + 0.0),
            _ => Err(self.fault(key, "the number is not finite")),
        }
    }

    fn wrong_type(&self, key: &str, expected: &str, found: &DeValue<'_>) -> InputError {
        self.fault(key, format!("expected {expected}, found {}", found.type_str()))
    }
}

/// Whether a word probably means another: nearly the same letters, or equal except for case and punctuation.
pub fn alike(word: &str, meant: &str) -> bool {
    let plain = |w: &str| w.chars().filter(char::is_ascii_alphanumeric).collect::<String>().to_lowercase();
    plain(word) == plain(meant) || strsim::jaro_winkler(word, meant) > 0.85
}

/// The message for an unknown word: "unknown key `x`; did you mean `y`? (known here: ...)".
pub fn unknown(word: &str, what: &str, known: &[&str]) -> String {
    let likeness = |candidate: &str| strsim::jaro_winkler(word, candidate);
    let nearest = known.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let meant: Vec<&str> =
        nearest.copied().filter(|candidate| likeness(candidate) > 0.75).into_iter().collect();
    unknown_meaning(word, what, known, &meant)
}

/// The same where the words that are probably meant are known.
pub fn unknown_meaning(word: &str, what: &str, known: &[&str], meant: &[&str]) -> String {
    let quoted: Vec<String> = meant.iter().map(|candidate| format!("`{candidate}`")).collect();
    let hint =
        if quoted.is_empty() { String::new() } else { format!("; did you mean {}?", quoted.join(" or ")) };
    let list = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
    format!("unknown {what} `{word}`{hint} (known here: {list})")
}

fn range_text(low: f64, high: f64) -> String {
    let (least, most) = (Short(low), Short(high));
    match (low == f64::NEG_INFINITY, high == f64::INFINITY) {
        (true, _) => format!("the allowed range (at most {most})"),
        (_, true) if low == f64::MIN_POSITIVE => "the allowed range (above 0)".to_owned(),
        (_, true) => format!("the allowed range (at least {least})"),
        _ if low == f64::MIN_POSITIVE => format!("the allowed range (above 0, at most {most})"),
        _ => format!("the allowed range {least} to {most}"),
    }
}

/// A number, written with an exponent where it would be long otherwise.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self(value) = *self;
        match value == 0.0 || !value.is_finite() || (1e-4..1e7).contains(&value.abs()) {
            true => write!(f, "{value}"),
            false => write!(f, "{value:e}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str, read: impl FnOnce(&Section<'_>) -> Result<(), InputError>) -> String {
        Document::new("m.toml", text).read(read).unwrap_err().to_string()
    }

    #[test]
    fn ranges_above_zero_say_so() {
        assert_eq!(range_text(f64::MIN_POSITIVE, f64::INFINITY), "the allowed range (above 0)");
        assert_eq!(range_text(f64::MIN_POSITIVE, 1.0), "the allowed range (above 0, at most 1)");
        assert_eq!(range_text(0.0, 1.0), "the allowed range 0 to 1");
    }

    #[test]
    fn quantities_beyond_their_limits_name_range_and_remedy() {
        let limits = Limits { unit: "Pa", low: 1.0, high: 1e13, known: "diamond has 1.1e12" };
        let read = |text: &str| error(text, |top| top.quantity("E", &limits).map(|_| ()));
        let text = read("\nE = 70e90");
        assert_eq!(
            text,
            "m.toml:2:1: E: 7e91 is outside the allowed range 1 to 1e13 (diamond has 1.1e12); \
             check the exponent and the unit, Pa"
        );
        assert!(read("E = 1e-320").contains("E: 1e-320 is outside"), "denormal");
        let text = error("d = 0", |top| top.quantity("d", &Limits::positive("m")).map(|_| ()));
        assert_eq!(
            text,
            "m.toml:1:1: d: 0 is outside the allowed range (above 0); check the exponent and the unit, m"
        );
    }

    #[test]
    fn unknown_key_names_line_column_and_nearest() {
        let message = error("\n[normal]\n yield_rato = 1\n", |top| {
            let normal = top.required_section("normal")?;
            normal.number("yield_ratio")?;
            normal.finish()
        });
        assert_eq!(
            message,
            "m.toml:3:2: normal.yield_rato: unknown key `yield_rato`; did you mean `yield_ratio`? \
             (known here: yield_ratio)"
        );
    }

    #[test]
    fn wrong_type_and_not_finite_are_named() {
        let text = error("a = \"one\"", |top| top.number("a").map(|_| ()));
        assert_eq!(text, "m.toml:1:1: a: expected a number in SI units, found string");
        let text = error("a = nan", |top| top.number("a").map(|_| ()));
        assert!(text.contains("not finite"), "{text}");
    }

    #[test]
    fn a_negative_zero_is_a_zero() {
        let read = |top: &Section<'_>| Ok((top.number("a")?, top.numbers("b")?));
        let (one, list) = Document::new("m", "a = -0.0\nb = [-0e3]").read(read).unwrap();
        assert!([one.unwrap(), list.unwrap()[0]].iter().all(|zero| *zero == 0.0 && zero.is_sign_positive()));
    }

    #[test]
    fn numbers_with_underscores_and_bases_are_read() {
        let document = Document::new("m.toml", "a = 1_000.5e1\nb = 0x10\nc = -2");
        let values = document.read(|top| {
            Ok([top.required_number("a")?, top.required_number("b")?, top.required_number("c")?])
        });
        assert_eq!(values, Ok([10005.0, 16.0, -2.0]));
    }

    #[test]
    fn endless_and_missing_files_are_refused() {
        let endless = Document::from_file(Path::new("/dev/zero")).unwrap_err().to_string();
        assert!(endless.contains("/dev/zero: cannot be read: larger than 16 MB"), "{endless}");
        let missing = Document::from_file(Path::new("no/such.toml")).unwrap_err().to_string();
        assert!(missing.contains("no/such.toml: cannot be read"), "{missing}");
    }

    #[test]
    fn broken_toml_names_the_line() {
        let message = error("a = 1\nb = = 2\n", |_| Ok(()));
        assert!(message.starts_with("m.toml:2:"), "{message}");
    }
}
