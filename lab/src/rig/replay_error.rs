//! Why a record cannot be replayed.

use std::path::PathBuf;

use crate::results::openfoam::impact_history::HistoryError;
use nearwall::impact::ImpactError;

/// Why a record cannot be replayed.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError {
    /// The record cannot be read, or is a part of the impacts.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// An experiment has no folder.
    #[error(
        "{place}: there is no folder {}; the column `experiment` names the sub-folders of --impacts with the recorded \
            cases{}",
        .folder.display(), list(": there are ", .found)
    )]
    NoCase {
        /// File, line and name of the experiment.
        place: String,
        /// The folder that is missing.
        folder: PathBuf,
        /// The folders beside it.
        found: Vec<String>,
    },
    /// The model has no wall of this name.
    #[error("{}: the run's model has a wall `{wall}`, the model file has none; give the model file of the \
        run", .file.display())]
    NoWall {
        /// The record.
        file: PathBuf,
        /// The wall.
        wall: String,
    },
    /// A reading is of a patch without recorded impacts.
    #[error(
        "{place}: `{column}`: {} has no impact on a patch of this name{}; what follows the @ is a patch that `record` \
            of nearWallInteraction includes",
        .file.display(), list(", only on ", .found)
    )]
    NoPatch {
        /// File, line and name of the experiment.
        place: String,
        /// The column.
        column: String,
        /// The record.
        file: PathBuf,
        /// The patches with impacts.
        found: Vec<String>,
    },
    /// The model file decides otherwise than the record.
    #[error(
        "{}: the model file is not the one of the run: {reason}; give the model file with which the case was run \
            (walls with a memory cannot be replayed)",
        .file.display()
    )]
    OtherModel {
        /// The record.
        file: PathBuf,
        /// What differs.
        reason: String,
    },
    /// The model cannot decide an impact.
    #[error("{}:{line}: the model file cannot decide this impact: {reason}; give the model file of the \
        run", .file.display())]
    Undecided {
        /// The record.
        file: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// The reason.
        reason: ImpactError,
    },
    /// The record is empty.
    #[error("{}: no impact is recorded; run the case until particles arrive at the walls", .0.display())]
    Empty(PathBuf),
}

fn list(before: &str, names: &[String]) -> String {
    if names.is_empty() { String::new() } else { format!("{before}{}", names.join(", ")) }
}
