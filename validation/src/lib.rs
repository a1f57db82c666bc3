//! Validation: comparison with both source papers and with independent computations.
//!
//! A [`SourceStudy`] compares one source with the library. Each comparison is a [`Claim`], which
//! gives a reason where the two differ. [`STUDIES`] lists all studies, [`page`] writes the page.
//! `validation/run` is the command.
//!
//! [`oracle`] computes the same quantities independently (numerical integration of a contact, an
//! impulse, an energy) and shares no code with the library.

pub mod checks;
pub mod claim;
pub mod materials;
pub mod migraine;
pub mod oracle;
pub mod page;
pub mod steps;
pub mod study;
pub mod summary;
pub mod terms;
pub mod troiano;

pub use claim::{Claim, ClaimBasis, Published, Verdict};
pub use study::{Extent, SourceStudy, StudyPart};

/// Result of a study: any error ends the run.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Makes a study of the given extent.
pub type StudyMaker = fn(Extent) -> Result<SourceStudy>;

/// Every study in the order of the page: its name and the function that makes it.
pub const STUDIES: [(&str, StudyMaker); 4] = [
    ("migraine", migraine::study),
    ("troiano", troiano::study),
    ("checks", checks::study),
    ("materials", materials::study),
];
