//! Histories of K, crack faces and fields as plots and page show them, beyond the short tables of a
//! run. They are gathered step by step, from the records of a run that is being computed or from
//! the files of one that was, no more than is shown. Both give the same numbers, since the tables
//! hold every number to its last bit.

mod faces;
mod histories;
mod neighbourhood;
mod of_steps;
mod pack;
mod run;
mod thinned;

pub(crate) use faces::{CrackFaces, StepFaces};
pub(crate) use pack::{Deflated, Quantised};
pub(crate) use run::{ShownRun, ShownStep};
