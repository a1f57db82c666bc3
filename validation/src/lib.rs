//! Both source papers and independent checks, reproduced.
//!
//! A [`Study`] holds what a source says, what the library says of the same, and why they differ where they do. Each
//! statement is a [`Claim`]; [`STUDIES`] lists them all, [`page`] shows them. `validation/run` is the command.
//!
//! [`oracle`] computes the same things another way (numerical integration of a contact, of an impulse, of an energy); it shares
//! no code with the library, so that it can disagree with it.

pub mod checks;
pub mod claim;
pub mod materials;
pub mod migraine;
pub mod oracle;
pub mod page;
pub mod study;
pub mod summary;
pub mod troiano;

pub use claim::{Basis, Claim, Published, Verdict};
pub use study::{Extent, Part, STUDIES, Study};
