//! Figures: charts and pictures, each built once from results for its SVG file and for the page.

mod calibration;
mod cells;
mod compare;
mod faces;
mod patches;
mod paths;
mod plan;
mod plot;
mod row;
mod run;
mod section;
mod shakedown;
mod sif;
mod space;
mod study;
mod wheel_passage;

pub use calibration::{CalibratedRun, calibration_charts};
pub(crate) use compare::{comparison_plots, lengths_of_both, steps_of_both};
pub use patches::patches_picture;
pub(crate) use plan::plan_plots;
pub(crate) use plot::{Plot, chart, charts};
pub(crate) use row::bundle;
pub(crate) use run::run_plots;
pub(crate) use shakedown::shakedown_plots;
pub(crate) use sif::far_chart;
pub(crate) use space::{has_closed_front, space_plots};
pub(crate) use study::{MANY, StudyRun, Styles, band_charts, stratified, study_charts, study_plots, values};
pub(crate) use wheel_passage::{WheelPassage, mouth, mouth_over_a, origin};
