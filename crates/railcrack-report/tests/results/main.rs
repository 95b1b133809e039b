//! Results as files: the run folder, its plots and pages, comparisons, fields.

mod compare;
mod damage;
mod fields;
mod fields_of_a_run;
mod report;
mod row;
mod run_folder;
mod simulation;

#[path = "../../../railcrack-vtu/tests/vtu/meshio.rs"]
mod meshio;
#[path = "../../../railcrack/tests/common/random.rs"]
mod random;
#[path = "../support/mod.rs"]
mod support;
