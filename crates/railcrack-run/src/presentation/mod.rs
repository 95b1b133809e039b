//! Presentation of results as they come in: plots and pages, made by someone above this crate, and
//! the files of a study, made of its runs.

mod interface;
mod study;

pub use interface::{Presentation, RunPresentation, TablesOnly};
