//! Reads the `[[effects]]` table of a `fitted-form`.

use super::curve_reader::{read_target, unknown_input};
use super::{CurveInput, FORMS, FittedForm, FormInfo, Operation};
use crate::group::Declared;
use crate::input::{InputError, Section};

/// Reads a form; `declared` is what the model file declares.
///
/// # Errors
/// [`InputError::Fault`] naming the key and the remedy.
pub(super) fn read(section: &Section<'_>, declared: &Declared<'_>) -> Result<FittedForm, InputError> {
    let on = read_target(section)?;
    let word = section.choice("acts", &Operation::ALL.map(Operation::name))?;
    let acts = Operation::ALL.into_iter().find(|acts| Some(acts.name()) == word.as_deref());
    let form = read_form(section)?;
    let input = read_input(section, declared)?;
    let parameters = form.parameters.iter().map(|parameter| parameter.read(section));
    let parameters = parameters.collect::<Result<_, _>>()?;
    Ok(FittedForm { on, acts: acts.unwrap_or(Operation::Set), form, input, parameters })
}

fn read_form(section: &Section<'_>) -> Result<&'static FormInfo, InputError> {
    let names: Vec<&str> = FORMS.iter().map(|form| form.name).collect();
    let word = section.choice("form", &names)?;
    let form = word.and_then(|word| FormInfo::from_name(&word));
    form.ok_or_else(|| section.missing("form", &format!("one of {}", names.join(", "))))
}

fn read_input(section: &Section<'_>, declared: &Declared<'_>) -> Result<CurveInput, InputError> {
    let name = section.text("input")?;
    let name = name.ok_or_else(|| section.missing("input", "the name of an input or group"))?;
    match CurveInput::named(&name, declared) {
        Some(CurveInput::Label(_)) => {
            let problem = format!("{name} is a word; a form needs a number, a `fitted-curve` takes words");
            Err(section.fault("input", problem))
        }
        Some(input) => Ok(input),
        None => Err(unknown_input(&name, section, declared)),
    }
}
