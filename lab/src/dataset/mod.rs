//! Impacts in a CSV file: one row an impact, columns by name.
//!
//! [`ImpactReader`] reads impacts one at a time, in SI units, so a file may be larger than memory.
//! [`Measurements`] reads a whole file with its observations, the standard errors of its inputs and
//! all columns that may be causes; a [`ColumnMap`] describes the columns and the detection limit of
//! a laboratory's own file. The columns named in [`nearwall::impact::INPUTS`] are the inputs; only
//! `v_n` is required, a blank or absent input takes its value in [`nearwall::Impact::default`]. A
//! row that cannot be used becomes a [`BadRow`].
//!
//! Format for users: `docs/reference/data-file.md`.

mod any_unit;
mod builder;
mod column;
mod column_map;
mod column_names;
mod csv_table;
mod detection;
mod encoding;
mod headings;
mod impact_reader;
mod impact_velocity;
mod input_errors;
mod inputs;
mod lines;
mod measurements;
mod notation;
mod notes;
mod number;
mod observed;
mod rig_measurements;
mod rig_observable;
mod row_error;
mod selection;
mod unit;
mod wall_choice;

pub use any_unit::{UnitPowers, unit_powers};
pub use column::{ColumnValues, DataColumn};
pub use column_map::ColumnMap;
pub use column_names::{PARCEL_COLUMNS, names_groups};
pub use detection::Detection;
pub use impact_reader::{ImpactReader, ImpactRow};
pub use input_errors::InputErrors;
pub use measurements::{Limit, Measurement, Measurements, Reading, Unselected};
pub use notes::{assumed, unlikely};
pub use rig_measurements::{Experiment, RigMeasurements, RigReading, settings_of};
pub use rig_observable::{Restitution, RigQuantity};
pub use selection::MOST_ROWS;
pub use wall_choice::{WallChoice, WallError};

/// Why a file cannot be read as impacts.
#[derive(Debug, thiserror::Error)]
pub enum DatasetError {
    /// The file cannot be read, or has no rows.
    #[error("{file}: {reason}")]
    Unreadable {
        /// The name of the file.
        file: String,
        /// The reason.
        reason: String,
    },
    /// The header or a line under it has an error that concerns the whole file.
    #[error("{file}:{line}: {problem}")]
    Header {
        /// The name of the file.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// The error and the remedy.
        problem: String,
    },
    /// The column that is to tell groups of rows apart cannot do so.
    #[error("{file}: {problem}")]
    Group {
        /// The name of the file.
        file: String,
        /// The error, with the columns of the file.
        problem: String,
    },
    /// The wall is undetermined.
    #[error(transparent)]
    Wall(#[from] WallError),
}

/// A row that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct BadRow {
    /// Line in the file, counted from 1.
    pub line: u64,
    /// The reason.
    pub reason: String,
}
