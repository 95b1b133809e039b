//! The `railcrack` command of the package.

use pyo3::prelude::*;
use railcrack_report::PageEngine;
use std::ffi::OsString;
use std::path::PathBuf;

/// Executes the command line `arguments`, program name first, and returns the exit code.
#[pyfunction]
pub fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| railcrack_cli::command(arguments))
}

/// Version of the program.
#[pyfunction]
pub fn version() -> &'static str {
    railcrack_run::VERSION
}

/// Looks for the engine of pages in `folders`.
#[pyfunction]
pub fn engine_folders(folders: Vec<PathBuf>) {
    PageEngine::come_with(folders);
}
