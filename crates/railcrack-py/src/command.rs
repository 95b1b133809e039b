//! The command of the package.

use pyo3::prelude::*;
use std::ffi::OsString;

/// Does what the command line `arguments` ask for, the name of the program first: its exit code.
#[pyfunction]
pub fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| railcrack_cli::command(arguments))
}

/// Version of the program.
#[pyfunction]
pub fn version() -> &'static str {
    railcrack_run::VERSION
}
