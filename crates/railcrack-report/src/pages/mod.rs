//! The pages, one for each kind of folder.

mod approval;
mod calibration;
mod compare;
mod contact;
mod described;
mod phrases;
mod plan;
mod run;
mod shakedown;
mod study;
mod validation;
mod what_if;

pub use calibration::calibration_page;
pub(crate) use compare::comparison_page;
pub use contact::contact_page;
pub(crate) use plan::plan_page;
pub(crate) use run::{RunFolder, run_page};
pub(crate) use shakedown::shakedown_page;
pub(crate) use study::study_page;
pub use validation::{ValidationPage, is_validation_plot};
pub use what_if::explorer_page;
