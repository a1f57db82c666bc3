//! What lies on a patch that keeps a deposit, by the columns of `<patch>.wall.dat`.

/// The columns that are read, in the order of [`DepositState`].
pub const COLUMNS: [&str; 17] = [
    "initial_kg",
    "arrived_kg",
    "molten_kg",
    "frozen_kg",
    "powder_kg",
    "drained_kg",
    "shed_kg",
    "resuspended_kg",
    "condensed_kg",
    "coverage_mean",
    "coverage_max",
    "layer_thickness_mean_m",
    "layer_thickness_max_m",
    "wall_temperature_mean_K",
    "wall_temperature_max_K",
    "heat_flux_mean_W_m2",
    "heat_flux_max_W_m2",
];

/// Values of [`COLUMNS`]; NaN for a column that a table does not have.
pub type DepositState = [f64; COLUMNS.len()];

/// Value of a column; NaN when it is absent.
pub fn value(state: &DepositState, column: &str) -> f64 {
    COLUMNS.iter().position(|name| *name == column).map_or(f64::NAN, |index| state[index])
}
