//! The compiled part of the Python package `nearwall`: what its functions do on whole tables.
//! Python code in `nearwall/` checks arguments and makes objects of the results.
//!
//! The module also carries the C library in itself: `nearwall/library.py` calls its functions `nw_*` on NumPy arrays.

#![allow(unsafe_code, reason = "PyO3's macros write the entries that Python calls")]

mod command;
mod diagnosis;
mod materials;
mod openfoam;
mod prediction;
mod simulation;
mod table;
mod work;

use pyo3::prelude::*;

// Keeps the C functions in the library that is linked.
pub use nearwall::c_api;

/// The compiled part of nearwall.
#[pymodule]
fn _compiled(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(command::command, module)?)?;
    module.add_function(wrap_pyfunction!(diagnosis::diagnose, module)?)?;
    module.add_function(wrap_pyfunction!(prediction::predict, module)?)?;
    module.add_function(wrap_pyfunction!(simulation::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(materials::materials, module)?)?;
    module.add_function(wrap_pyfunction!(table::csv_of, module)?)?;
    module.add_function(wrap_pyfunction!(table::read_csv, module)?)?;
    module.add_function(wrap_pyfunction!(openfoam::clouds, module)?)?;
    module.add_function(wrap_pyfunction!(openfoam::tables, module)?)?;
    module.add_function(wrap_pyfunction!(openfoam::wall_fields, module)?)?;
    module.add_function(wrap_pyfunction!(openfoam::record_file, module)?)
}
