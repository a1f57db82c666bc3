//! Effects by their names.

use nearwall::effect::{KINDS, Term};

/// The effect of this name with its parameters in the order of its file.
///
/// # Errors
/// When there is no such effect.
pub fn term(id: &str, values: &[f64]) -> Result<Term, String> {
    let kind = KINDS.into_iter().find(|kind| kind.id == id).ok_or_else(|| format!("no effect {id}"))?;
    Ok(Term::new(kind, values))
}
