//! The plots of a study: all runs on one chart each.

mod bands;
mod charts;
mod choice;
mod plots;
mod run;
mod styles;

pub(crate) use bands::{MANY, band_charts};
pub(crate) use charts::study_charts;
pub(crate) use choice::stratified;
pub(crate) use plots::study_plots;
pub(crate) use run::{StudyRun, values};
pub(crate) use styles::Styles;
