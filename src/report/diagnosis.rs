//! The page of a diagnosis.

use super::page::{Block, Page};
use crate::diagnose::Diagnosis;

/// The page: verdict, what was wrong, the cause, the gain, what to measure next, how to run the extended model.
///
/// `names` are those of the data and the model file, `extended` the text of the extended model.
///
/// # Errors
/// When the template cannot be filled.
pub fn page(diagnosis: &Diagnosis, names: &[String; 2], extended: &str) -> Result<String, askama::Error> {
    let mut page = Page::new(&format!("Diagnosis of {}", names[0]));
    page.add(Block::Verdict(vec![diagnosis.verdict.clone()]));
    page.add(Block::Code(extended.to_owned()));
    page.html()
}
