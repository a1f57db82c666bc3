//! Reads the `[[effects]]` table of a `fitted-curve` or a `level-shift`.

use super::correction::LARGEST_VALUE;
use super::{CurveAxis, CurveInput, CurveTarget, EffectInfo, FittedCurve, Operation, Parameter};
use crate::group::Declared;
use crate::impact::ExtraInput;
use crate::input::{InputError, List, Section, unknown};

/// Most inputs of a curve.
const MOST_AXES: usize = 2;

/// Reads a curve; `declared` is what the model file declares.
///
/// # Errors
/// [`InputError::Fault`] naming the key and the remedy.
pub(super) fn read(
    kind: &EffectInfo,
    section: &Section<'_>,
    declared: &Declared<'_>,
) -> Result<FittedCurve, InputError> {
    let on = read_target(section)?;
    let factor = section
        .choice("form", &Operation::OF_CURVES.map(Operation::name))?
        .is_some_and(|form| form == "factor");
    let form = if factor { Operation::Factor } else { Operation::Add };
    if let [value] = kind.parameters {
        return read_level(value, section, on, form);
    }
    let axes = read_axes(section, declared)?;
    let values = read_grid("values", section, &axes)?;
    let values = values.ok_or_else(|| section.missing("values", "a list with a number for each knot"))?;
    check_interval(section, &axes)?;
    Ok(FittedCurve { on, form, axes, values })
}

/// What a correction acts on.
pub(super) fn read_target(section: &Section<'_>) -> Result<CurveTarget, InputError> {
    let targets = CurveTarget::ALL.map(CurveTarget::name);
    let word = section.choice("on", &targets)?;
    let word = word.ok_or_else(|| section.missing("on", "\"e_n\", \"e_t\" or \"capture\""))?;
    let on = CurveTarget::ALL.into_iter().find(|on| on.name() == word);
    Ok(on.unwrap_or(CurveTarget::NormalRestitution))
}

/// The error for an unknown input or group of a correction.
pub(super) fn unknown_input(name: &str, section: &Section<'_>, declared: &Declared<'_>) -> InputError {
    let problem = unknown(name, "input", &CurveInput::names(declared));
    section.fault("input", format!("{problem}; declare another one in [inputs.{name}]"))
}

fn read_level(
    value: &Parameter,
    section: &Section<'_>,
    on: CurveTarget,
    form: Operation,
) -> Result<FittedCurve, InputError> {
    Ok(FittedCurve { on, form, axes: Vec::new(), values: vec![value.read(section)?] })
}

fn read_axes(section: &Section<'_>, declared: &Declared<'_>) -> Result<Vec<CurveAxis>, InputError> {
    let names = if section.is_list("input") {
        section.texts("input")?
    } else {
        section.text("input")?.map(|name| vec![name])
    };
    let names = names.ok_or_else(|| section.missing("input", "the name of an input"))?;
    if names.is_empty() || names.len() > MOST_AXES || (names.len() == MOST_AXES && names[0] == names[1]) {
        return Err(section.fault("input", "expected one input, or a list of two different ones"));
    }
    let knots =
        section.lists("knots")?.ok_or_else(|| section.missing("knots", "a list of values of the input"))?;
    if knots.len() != names.len() {
        let problem = match names.len() {
            1 => "expected one list: the curve has one input".to_owned(),
            _ => format!("expected two lists, of {} and of {}", names[0], names[1]),
        };
        return Err(section.fault("knots", problem));
    }
    names.iter().zip(&knots).map(|(name, knots)| read_axis(name, knots, section, declared)).collect()
}

fn read_axis(
    name: &str,
    knots: &List<'_, '_>,
    section: &Section<'_>,
    declared: &Declared<'_>,
) -> Result<CurveAxis, InputError> {
    let input = CurveInput::named(name, declared).ok_or_else(|| unknown_input(name, section, declared))?;
    let label = match input {
        CurveInput::Label(place) => declared.inputs.get(place),
        _ => None,
    };
    let knots = match label {
        Some(words) => read_labels(words, knots, section)?,
        None => read_numbers(name, knots, section)?,
    };
    Ok(CurveAxis { input, knots })
}

/// Knots of a number: at least two, ascending.
fn read_numbers(name: &str, knots: &List<'_, '_>, section: &Section<'_>) -> Result<Vec<f64>, InputError> {
    let knots = knots.numbers()?;
    if knots.len() < 2 {
        let problem =
            format!("{name} needs at least two knots; a `level-shift` has one value for all impacts");
        return Err(section.fault("knots", problem));
    }
    match knots.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some(pair) => {
            let problem = format!("the knots of {name} must ascend, but {} follows {}", pair[1], pair[0]);
            Err(section.fault("knots", format!("{problem}; sort them together with their values")))
        }
        None => Ok(knots),
    }
}

/// Knots of a word, as indices.
fn read_labels(
    input: &ExtraInput,
    knots: &List<'_, '_>,
    section: &Section<'_>,
) -> Result<Vec<f64>, InputError> {
    let mut places: Vec<f64> = Vec::new();
    for label in knots.texts()? {
        let known: Vec<&str> = input.labels.iter().map(String::as_str).collect();
        let what = format!("label of {}", input.name);
        let place =
            input.place(&label).ok_or_else(|| section.fault("knots", unknown(&label, &what, &known)))? as f64;
        if places.contains(&place) {
            return Err(section.fault("knots", format!("`{label}` occurs twice; remove one of them")));
        }
        places.push(place);
    }
    if places.is_empty() {
        return Err(section.fault("knots", format!("the list is empty; add labels of {}", input.name)));
    }
    Ok(places)
}

/// The numbers of a key at the knots, those of the last axis together; `None` when the key is absent.
fn read_grid(key: &str, section: &Section<'_>, axes: &[CurveAxis]) -> Result<Option<Vec<f64>>, InputError> {
    let Some(lists) = section.lists(key)? else { return Ok(None) };
    let (rows, columns) = match axes {
        [first, second] => (first.knots.len(), second.knots.len()),
        [only] => (1, only.knots.len()),
        _ => (1, 1),
    };
    if lists.len() != rows {
        let problem = match rows {
            1 => format!("expected one list of {columns} numbers, one a knot"),
            _ => format!("expected {rows} lists, one a knot of the first input; found {}", lists.len()),
        };
        return Err(section.fault(key, problem));
    }
    let mut grid = Vec::new();
    for list in &lists {
        let row = list.numbers()?;
        if row.len() != columns {
            let problem = format!("expected {columns} numbers, one a knot; found {}", row.len());
            return Err(section.fault(key, problem));
        }
        grid.extend(row);
    }
    if let Some(value) = grid.iter().find(|value| value.abs() > LARGEST_VALUE) {
        let problem = format!("{value} is outside -{LARGEST_VALUE} to {LARGEST_VALUE}; check the exponent");
        return Err(section.fault(key, problem));
    }
    Ok(Some(grid))
}

/// Checks the interval of the values, `low` and `high`: a record of the fit.
fn check_interval(section: &Section<'_>, axes: &[CurveAxis]) -> Result<(), InputError> {
    let [low, high] = [read_grid("low", section, axes)?, read_grid("high", section, axes)?];
    let (Some(low), Some(high)) = (low, high) else { return Ok(()) };
    if low.iter().zip(&high).any(|(low, high)| low > high) {
        return Err(section.fault("low", "a number is above its partner in `high`; exchange the two"));
    }
    Ok(())
}
