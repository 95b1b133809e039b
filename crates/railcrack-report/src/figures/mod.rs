//! Figures: charts and pictures, each built once from results for its SVG file and for the page.

mod calibration;
mod cells;
mod compare;
mod faces;
mod forest;
mod patches;
mod paths;
mod plan;
mod plot;
mod row;
mod run;
mod section;
mod shakedown;
mod sif;
mod smooth;
mod space;
mod space_view;
mod study;
mod wheel_passage;

pub use calibration::{CalibratedRun, calibration_charts};
pub(crate) use compare::{comparison_plots, lengths_of_both, steps_of_both};
pub(crate) use forest::{ForestRatio, ForestRow, forest};
pub use patches::{PATCH_KEY, PatchKey, patches_picture};
pub(crate) use plan::{plan_plots, tone, words};
pub(crate) use plot::{Plot, chart, charts};
pub(crate) use row::bundle;
pub(crate) use run::run_plots;
pub(crate) use shakedown::shakedown_plots;
pub(crate) use sif::far_chart;
pub(crate) use smooth::smooth;
pub(crate) use space::{front_ends, has_closed_front, space_plots};
pub(crate) use space_view::space_view;
pub(crate) use study::{MANY, StudyRun, Styles, band_charts, stratified, study_charts, study_plots, values};
pub(crate) use wheel_passage::{WheelPassage, mouth, mouth_over_a, origin};
