//! The extension module of the Python package railcrack: cases, runs, studies and the parts of the
//! mechanics, with arrays of numpy.
//!
//! Classes and functions here are minimal; the package in `python/railcrack` adds names, units,
//! tables and plots. Computations do not hold the interpreter lock.

mod background;
mod body;
mod case;
mod columns;
mod command;
mod errors;
mod fatigue;
mod grid;
mod judge;
mod limits;
mod passage;
mod run;
mod scratch;
mod shakedown;
mod study;
mod wheel;

/// Contents of the module.
#[pyo3::pymodule]
mod _railcrack {
    #[pymodule_export]
    use crate::body::{BodyCore, case_body, dislocation_body, xfem_body};
    #[pymodule_export]
    use crate::case::CaseCore;
    #[pymodule_export]
    use crate::command::{command, engine_folders, version};
    #[pymodule_export]
    use crate::fatigue::{hourlier_pineau, kink_functions};
    #[pymodule_export]
    use crate::passage::passage;
    #[pymodule_export]
    use crate::run::RunCore;
    #[pymodule_export]
    use crate::shakedown::shakedown;
    #[pymodule_export]
    use crate::study::StudyCore;
}
