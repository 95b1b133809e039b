//! Errors as the exceptions of `railcrack.errors`.

use pyo3::call::PyCallArgs;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use railcrack::shakedown::ShakedownError;
use railcrack_case::CaseErrors;
use railcrack_run::OutputError;
use railcrack_run::setup::CarriedStressError;
use railcrack_run::simulation::RunError;
use std::ffi::CString;

/// The exception `class` of the package, constructed from `arguments`.
pub fn exception<'py>(py: Python<'py>, class: &str, arguments: impl PyCallArgs<'py>) -> PyErr {
    let made = py
        .import("railcrack.errors")
        .and_then(|errors| errors.getattr(class))
        .and_then(|class| class.call1(arguments));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// `CaseError` with all `errors`, each with message, file, line, column, key and help.
pub fn case_error(py: Python<'_>, errors: &CaseErrors) -> PyErr {
    let each = errors.errors().iter().map(|error| {
        let (line, column) = error.position().unzip();
        (error.message(), error.file(), line, column, error.key(), error.help(), error.one_line())
    });
    exception(py, "CaseError", (each.collect::<Vec<_>>(),))
}

/// `FolderError`: an unsuitable folder, or a file that cannot be read or written.
pub fn output_error(py: Python<'_>, error: &OutputError) -> PyErr {
    exception(py, "FolderError", (in_python(&error.to_string()),))
}

/// `text` with the arguments of functions for the options of the command.
pub fn in_python(text: &str) -> String {
    let words = [
        ("take it up again with `railcrack run --resume`, ", ""),
        ("another folder with --out", "another folder"),
        ("name its folder with --out", "name its folder"),
        ("--resume", "resume=True"),
        ("--force", "replace=True"),
        ("--steps", "growth.steps"),
        ("--engine", "solver.engine"),
    ];
    words.iter().fold(text.to_owned(), |text, (option, argument)| text.replace(option, argument))
}

/// Name of the exception for `error`.
pub fn class_of(error: &RunError) -> &'static str {
    match error {
        RunError::Output(OutputError::NotFinite { .. } | OutputError::Field(_))
        | RunError::Growth(_)
        | RunError::NoLayers
        | RunError::Shakedown(ShakedownError::NotConverged { .. }) => "NotConverged",
        RunError::Residual(CarriedStressError::Field(_)) | RunError::Shakedown(_) => "BadInput",
        RunError::Residual(_) => "NotConverged",
        _ => "FolderError",
    }
}

/// The exception for `error`.
pub fn run_error(py: Python<'_>, error: &RunError) -> PyErr {
    exception(py, class_of(error), (in_python(&error.to_string()),))
}

/// A `UserWarning` for each damage in the folder of a study.
pub fn warn_of_damages(py: Python<'_>, damages: &[String]) -> PyResult<()> {
    let class = py.get_type::<PyUserWarning>();
    damages.iter().try_for_each(|damage| {
        let text = CString::new(format!("damaged: {damage}"))?;
        PyErr::warn(py, &class, &text, 1)
    })
}

/// `BadInput` with the message of `error`.
pub fn bad_input(py: Python<'_>, error: impl ToString) -> PyErr {
    exception(py, "BadInput", (error.to_string(),))
}

/// `NotConverged` with the message of `error`.
pub fn not_converged(py: Python<'_>, error: impl ToString) -> PyErr {
    exception(py, "NotConverged", (error.to_string(),))
}
