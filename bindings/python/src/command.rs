//! The command `nearwall`, which the package brings along.

use std::ffi::OsString;
use std::io::Write;

use pyo3::prelude::*;

/// Runs the command with its arguments, of which the first is its name, and returns its exit status.
#[pyfunction]
pub fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| {
        let status = nearwall_lab::command::run(arguments);
        // Nothing empties the buffer when Python ends; a closed pipe is no fault.
        let _ = std::io::stdout().flush();
        status
    })
}
