//! Effects by their names.

use crate::Result;
use nearwall::Model;
use nearwall::effect::{EFFECTS, Term};

/// The effect of this name with its parameters in the order of its file.
///
/// # Errors
/// When there is no such effect.
pub fn term(id: &str, values: &[f64]) -> Result<Term> {
    let kind = EFFECTS.into_iter().find(|kind| kind.id == id).ok_or_else(|| format!("no effect {id}"))?;
    Ok(Term::new(kind, values))
}

/// The first parameter of a model's effect of this name.
///
/// # Errors
/// When the model has no such effect.
pub fn first_value(model: &Model, id: &str) -> Result<f64> {
    let term = model.terms().iter().find(|term| term.kind().id == id);
    term.and_then(|term| term.values().first().copied())
        .ok_or_else(|| format!("the model has no {id}").into())
}
