//! The stabilised plastic state of a rolled rail.

use crate::background::{Watch, compute};
use crate::case::CaseCore;
use crate::columns;
use crate::errors::{exception, output_error, run_error};
use crate::scratch::scratch_folder;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use railcrack::interruption::Interruption;
use railcrack_report::Pages;
use railcrack_run::csv::{ColumnValues, columns_of};
use railcrack_run::simulation::{RunObserver, pass_text, roll};
use railcrack_run::{Existing, OutputError, Presentation, ShakedownFolder, TablesOnly};
use std::path::PathBuf;
use std::sync::Arc;

/// `profile.csv` and `passes.csv` by columns, and `shakedown.json`.
type State<'py> = (Bound<'py, PyDict>, Bound<'py, PyDict>, String);

/// The stabilised plastic state of the rail of `case` under repeated passages of its wheel; also
/// written to `out`, with plots and report, if that is given.
#[pyfunction]
#[pyo3(signature = (case, out, replace, threads, tell))]
pub fn shakedown<'py>(
    py: Python<'py>,
    case: &CaseCore,
    out: Option<PathBuf>,
    replace: bool,
    threads: Option<usize>,
    tell: Option<&Bound<'py, PyAny>>,
) -> PyResult<State<'py>> {
    let (watch, told) = Watch::new();
    let (case, observer) = (Arc::clone(&case.case), Arc::clone(&watch));
    let scratch = scratch_folder()?;
    let over = compute(py, threads, (watch, told), tell, move || {
        let folder = out.as_deref().unwrap_or(scratch.path());
        let presentation: &dyn Presentation = if out.is_some() { &Pages } else { &TablesOnly };
        let existing = if replace { Existing::Replace } else { Existing::Refuse };
        let asked = || observer.is_interrupted();
        let interruption = Interruption::when(&asked);
        let summary = roll(&case, 0.0, (folder, existing), presentation, interruption, |pass| {
            observer.stage(&pass_text(pass));
        })?;
        Ok((summary, ShakedownFolder::open(folder)?))
    })?;
    if let Some(signal) = over.signal {
        return Err(signal);
    }
    let (summary, folder) = over.result.map_err(|error| run_error(py, &error))?;
    let read = |columns: Result<Vec<(_, ColumnValues)>, OutputError>| {
        columns::to_numpy(py, columns.map_err(|error| output_error(py, &error))?)
    };
    let summary = serde_json::to_string(&summary)
        .map_err(|error| exception(py, "FolderError", (error.to_string(),)))?;
    let profile = read(columns_of(folder.profile.into_iter().map(Ok), None))?;
    let passes = read(columns_of(folder.passes.into_iter().map(Ok), None))?;
    Ok((profile, passes, summary))
}
