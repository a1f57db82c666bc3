//! Impacts in a CSV file: one row an impact, columns by name.
//!
//! [`ImpactReader`] reads measured or planned impacts one at a time, in SI units, so a file may be larger than memory;
//! `predict` uses it. [`Measurements`] reads all of a file of measured impacts with what was observed and every column
//! that may be a cause; a [`ColumnMap`] says what the columns of a laboratory's own file mean. For both, the columns
//! named in [`crate::impact::INPUTS`] are the inputs; only `v_n` has to be there, a blank or absent one takes the value
//! of [`crate::Impact::default`]. A row that cannot be used is returned as a [`BadRow`] with its line and the reason.
//!
//! The format and the map for users: `docs/data-file.md`.

mod builder;
mod column;
mod column_map;
mod impact_reader;
mod impact_velocity;
mod inputs;
mod lines;
mod measurements;
mod notes;
mod number;
mod observed;
mod table;
mod unit;
mod wall_choice;

pub use column::{Column, Values};
pub use column_map::ColumnMap;
pub use impact_reader::{ImpactReader, Row};
pub use measurements::{Measurement, Measurements};
pub use notes::{assumed, unlikely};
pub use observed::Reading;
pub use wall_choice::{WallChoice, WallError};

/// Why a file cannot be read as impacts at all.
#[derive(Debug, thiserror::Error)]
pub enum DatasetError {
    /// The file cannot be opened or read.
    #[error("{file}: {reason}")]
    Unreadable {
        /// The file's name as the user gave it.
        file: String,
        /// What the operating system or the CSV reader said.
        reason: String,
    },
    /// The header is at fault.
    #[error("{file}:{line}: {problem}")]
    Header {
        /// The file's name as the user gave it.
        file: String,
        /// Line of the header, counted from 1.
        line: u64,
        /// What is wrong and the remedy.
        problem: String,
    },
    /// There is nothing but a header.
    #[error("{file}: no row follows the header; write one row an impact under it (a comment line is no row)")]
    NoRows {
        /// The file's name as the user gave it.
        file: String,
    },
    /// Nothing says which wall is hit.
    #[error(transparent)]
    Wall(#[from] WallError),
}

/// A row that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BadRow {
    /// Line in the file, counted from 1.
    pub line: u64,
    /// What is wrong with it.
    pub reason: String,
}
