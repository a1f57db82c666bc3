//! What a heading says beside the name: `v_n [m/s]`, `T_p (C)`, `V_N`, and a row of units under the header.

use super::any_unit::AnyUnit;
use super::column_names::{ONLY_MAPPED, is_error, names};
use super::number::{NumberStyle, is_blank};
use super::row_error::HeaderError;
use super::unit::{Dimension, Unit};
use nearwall::impact::ExtraInput;

/// A heading: its name and, in brackets, its unit.
struct Heading<'a> {
    name: &'a str,
    unit: Option<&'a str>,
    /// Whether the brackets can enclose nothing but a unit.
    square: bool,
}

impl<'a> Heading<'a> {
    fn of(text: &'a str) -> Self {
        let split = |open: char, close: char| {
            let (name, rest) = text.strip_suffix(close)?.split_once(open)?;
            Some((name.trim(), rest.trim()))
        };
        match (split('[', ']'), split('(', ')')) {
            (Some((name, unit)), _) => Self { name, unit: Some(unit), square: true },
            (_, Some((name, unit))) => Self { name, unit: Some(unit), square: false },
            _ => Self { name: text, unit: None, square: false },
        }
    }

    /// Whether it means this name in any case. A single capital may be another quantity, unless it has a unit, and a
    /// word such as `Wall` has its own meaning.
    fn means(&self, name: &str, dimension: Dimension) -> bool {
        let clear = self.unit.is_some() || name.len() > 1;
        let quantity = dimension != Dimension::Text || name == "outcome";
        self.name == name || (clear && quantity && self.name.eq_ignore_ascii_case(name))
    }
}

/// A column whose heading means a name of nearwall, with its unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct FoundColumn {
    pub(super) index: usize,
    pub(super) unit: Unit,
}

/// The column of this name among those for which `free` holds: the name itself, else the name with a unit, else the
/// name in another case.
///
/// # Errors
/// [`HeaderError`] for two such columns and for an unknown unit.
pub(super) fn find(
    name: &'static str,
    dimension: Dimension,
    headers: &csv::StringRecord,
    free: impl Fn(&str) -> bool,
) -> Result<Option<FoundColumn>, HeaderError> {
    if let Some(index) = headers.iter().position(|header| header == name && free(header)) {
        return Ok(Some(FoundColumn { index, unit: Unit::SI }));
    }
    if ONLY_MAPPED.contains(&name) {
        return Ok(None);
    }
    let (mut exact, mut other) = (Vec::new(), Vec::new());
    for (index, text) in headers.iter().enumerate().filter(|(_, text)| free(text)) {
        let heading = Heading::of(text);
        if !heading.means(name, dimension) {
            continue;
        }
        let Some(unit) = unit_of(name, dimension, text, &heading)? else { continue };
        let list = if heading.name == name { &mut exact } else { &mut other };
        list.push((text, FoundColumn { index, unit }));
    }
    let found = if exact.is_empty() { other } else { exact };
    match found.as_slice() {
        [] => Ok(None),
        [(_, one)] => Ok(Some(*one)),
        [(one, _), (two, _), ..] => {
            Err(HeaderError::Ambiguous { name, one: (*one).to_owned(), two: (*two).to_owned() })
        }
    }
}

/// Name and unit of a column that is no input: what stands before the brackets where they hold a known unit, else the
/// whole heading.
pub(super) fn further<'a>(heading: &'a str, headers: &csv::StringRecord) -> (&'a str, Option<AnyUnit>) {
    let Heading { name, unit, .. } = Heading::of(heading);
    // Other headings are looked at only for one with a unit: a file may have thousands.
    let is_free = || {
        ExtraInput::refusal(name).is_none()
            && names().all(|(own, _)| own != name)
            && headers.iter().filter(|other| Heading::of(other).name == name).count() == 1
    };
    match unit.and_then(AnyUnit::of).filter(|_| is_free()) {
        Some(unit) => (name, Some(unit)),
        None => (heading, None),
    }
}

/// The column of an input that a model declares: with this heading, else with this name and a unit.
pub(super) fn find_further(name: &str, headers: &csv::StringRecord) -> Option<FoundColumn> {
    let whole = || headers.iter().position(|header| header == name).map(|index| (index, Unit::SI));
    let stated = || {
        let mut all = headers.iter().map(|header| further(header, headers)).enumerate();
        all.find_map(|(index, (own, unit))| Some((index, unit.filter(|_| own == name)?.conversion)))
    };
    whole().or_else(stated).map(|(index, unit)| FoundColumn { index, unit })
}

/// The unit of a heading; `None` where the brackets hold something else.
fn unit_of(
    name: &str,
    dimension: Dimension,
    text: &str,
    heading: &Heading<'_>,
) -> Result<Option<Unit>, HeaderError> {
    let Some(word) = heading.unit else { return Ok(Some(Unit::SI)) };
    match dimension.stated_unit(word) {
        Some(unit) if is_error(name) => Ok(Some(unit.of_difference())),
        Some(unit) => Ok(Some(unit)),
        None if heading.square => Err(HeaderError::UnknownUnit {
            column: text.to_owned(),
            unit: word.to_owned(),
            known: dimension.unit_names(),
        }),
        None => Ok(None),
    }
}

/// Whether the first row under a header states units.
pub(super) enum UnitRow {
    /// The headings with these units.
    Units(csv::StringRecord),
    /// One of them is not known: the problem.
    Unknown(String),
    /// It is a row of data.
    No,
}

/// Looks for units in the first row: it holds no number but 1, and one unit at least. Columns for which `mapped` holds
/// keep their heading.
pub(super) fn unit_row(
    headers: &csv::StringRecord,
    cells: &csv::StringRecord,
    style: NumberStyle,
    mapped: impl Fn(&str) -> bool,
) -> UnitRow {
    let bare = |cell: &'_ str| cell.trim_matches(['[', ']', '(', ')', ' ']).to_owned();
    let is_number = |cell: &str| cell != "1" && !is_blank(cell) && style.parse(cell).is_some();
    let units: Vec<String> = cells.iter().map(bare).collect();
    let known = |unit: &String| unit != "1" && Dimension::ALL.iter().any(|all| all.unit(unit).is_some());
    if headers.len() != cells.len() || units.iter().any(|cell| is_number(cell)) || !units.iter().any(known) {
        return UnitRow::No;
    }
    let mut found = csv::StringRecord::new();
    for (header, unit) in headers.iter().zip(units) {
        let heading = Heading::of(header);
        let meant = names().find(|(name, dimension)| {
            let spelled = Heading { unit: Some(&unit), ..Heading::of(header) };
            *dimension != Dimension::Text && spelled.means(name, *dimension)
        });
        match meant.filter(|_| heading.unit.is_none() && !mapped(header) && !is_blank(&unit)) {
            Some((_, dimension)) if dimension.stated_unit(&unit).is_none() => {
                let known = dimension.unit_names();
                return UnitRow::Unknown(format!(
                    "the row states units, but `{unit}` is no unit of {header}; use one of {known}"
                ));
            }
            Some(_) => found.push_field(&format!("{header} [{unit}]")),
            None => found.push_field(header),
        }
    }
    UnitRow::Units(found)
}

/// What is said of columns that are no inputs and state a unit.
pub(super) fn further_notes(headers: &csv::StringRecord, is_used: impl Fn(usize) -> bool) -> Vec<String> {
    let all = headers.iter().enumerate().filter(|(index, _)| is_used(*index));
    let note = |(_, header): (usize, &str)| {
        let (name, unit) = further(header, headers);
        unit.map(|unit| format!("column `{header}` is read as {name} in {}", unit.si))
    };
    all.filter_map(note).collect()
}

/// What is said of the headings that are not nearwall's own names: how each of these columns is read.
pub(super) fn notes(
    found: impl Iterator<Item = (&'static str, usize, Unit)>,
    headers: &csv::StringRecord,
) -> Vec<String> {
    let note = |(name, index, unit): (&'static str, usize, Unit)| {
        let header = headers.get(index).unwrap_or("");
        let read = if unit == Unit::SI { String::new() } else { format!(" in {}", unit.name) };
        (header != name).then(|| format!("column `{header}` is read as {name}{read}"))
    };
    found.filter_map(note).collect()
}
