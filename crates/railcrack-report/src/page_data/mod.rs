//! Histories of K, crack faces, contact pressures and fields for plots and page, in addition to the
//! short tables of a run. They are collected step by step from the records of a run in progress or
//! from the files of a finished run, limited to what is shown. Both sources give the same numbers,
//! because the tables have full precision.

mod contact;
mod faces;
mod fields;
mod pack;
mod run;
mod step_table;
mod thinned;

pub(crate) use faces::{CrackFaces, CrackWindows, StepFaces};
pub(crate) use pack::{Deflated, Quantised};
pub(crate) use run::{PageData, PageStep};
