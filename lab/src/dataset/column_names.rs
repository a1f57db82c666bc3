//! Names of columns with a meaning.

use super::unit::Dimension;
use nearwall::impact::{INPUTS, Impact};

/// The columns of standard errors of inputs, each with the place of its input in [`INPUTS`].
pub(super) const INPUT_ERRORS: [(&str, usize); 5] = [
    ("v_n_err", Impact::NORMAL_SPEED),
    ("v_t_err", Impact::TANGENTIAL_SPEED),
    ("d_err", Impact::DIAMETER),
    ("T_p_err", Impact::PARTICLE_TEMPERATURE),
    ("T_w_err", Impact::WALL_TEMPERATURE),
];

/// The column of standard errors of `speed`.
pub(super) const SPEED_ERROR: &str = "speed_err";
/// The column of standard errors of `angle`.
pub(super) const ANGLE_ERROR: &str = "angle_err";

/// Names that only a map can give to a column: their meaning needs a unit, or depends on other columns.
pub(super) const ONLY_MAPPED: [&str; 4] = ["speed", SPEED_ERROR, "angle", ANGLE_ERROR];

/// The columns of observations; a row has at least one of them.
pub(super) const OBSERVATIONS: [&str; 5] = ["e_n", "e_t", "outcome", "capture_efficiency", "captured"];

/// Those of them that state captures.
pub(super) const CAPTURES: [&str; 3] = ["outcome", "capture_efficiency", "captured"];

/// The columns that qualify an observation.
pub(super) const DETAILS: [&str; 3] = ["e_n_err", "e_t_err", "n_impacts"];

/// The names that a column map accepts beyond the inputs of an impact.
const MORE_NAMES: [(&str, Dimension); 14] = [
    ("speed", Dimension::Speed),
    ("speed_err", Dimension::Speed),
    ("angle", Dimension::Angle),
    ("angle_err", Dimension::Angle),
    ("e_n", Dimension::Share),
    ("e_n_err", Dimension::Share),
    ("e_t", Dimension::Share),
    ("e_t_err", Dimension::Share),
    ("outcome", Dimension::Text),
    ("capture_efficiency", Dimension::Share),
    ("captured", Dimension::Count),
    ("n_impacts", Dimension::Count),
    ("wall", Dimension::Text),
    ("series", Dimension::Text),
];

/// Every name that a column map accepts, with its dimension.
pub(super) fn names() -> impl Iterator<Item = (&'static str, Dimension)> {
    let of_unit = |unit: &str| match unit {
        "m" => Dimension::Length,
        "m/s" => Dimension::Speed,
        "K" => Dimension::Temperature,
        "rad/s" => Dimension::Spin,
        "kg/m3" => Dimension::Density,
        _ => Dimension::Share,
    };
    let errors = INPUT_ERRORS.into_iter().map(move |(name, place)| (name, of_unit(INPUTS[place].unit)));
    INPUTS.iter().map(move |input| (input.name, of_unit(input.unit))).chain(errors).chain(MORE_NAMES)
}

/// Whether the column of this name holds standard errors, which are differences.
pub(super) fn is_error(name: &str) -> bool {
    name.ends_with("_err")
}

/// Names of columns that tell groups of rows apart.
const GROUPS: [&str; 10] =
    ["series", "day", "date", "batch", "burst", "lab", "laboratory", "session", "run", "campaign"];

/// The columns of OpenFOAM's record that identify a parcel, order its impacts and weigh them: the
/// rank that made it, its number there, its age [s] and its number of particles. A file with all of
/// them is such a record; they are no causes.
pub const PARCEL_COLUMNS: [&str; 4] = ["origProcId", "origId", "parcel_age", "n_particles"];

/// Whether a column of this name tells groups of rows apart that may share an error: `series`, `day`, `date`, `batch`,
/// `burst`, `lab`, `laboratory`, `session`, `run` or `campaign`, in upper or lower case. Its numbers are labels.
pub fn names_groups(name: &str) -> bool {
    GROUPS.iter().any(|group| group.eq_ignore_ascii_case(name))
}
