//! The plots of a study: all runs on one chart each.

mod bands;
mod charts;
mod choice;
mod styles;

pub(crate) use bands::{MANY, band_charts};
pub(crate) use charts::{study_charts, study_plots};
pub(crate) use choice::stratified;
pub(crate) use styles::{StudyRun, Styles, values};
