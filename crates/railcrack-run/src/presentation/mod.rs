//! Presentation of results as they become available: plots and pages, made by a crate above this
//! one, and the files of a study, compiled from its runs.

mod interface;
mod study;

pub use interface::{Presentation, RunPresentation, TablesOnly};
