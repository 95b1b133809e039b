//! The pages, one for each kind of folder.

mod compare;
mod phrases;
mod plan;
mod run;
mod shakedown;
mod study;
mod what_if;

pub(crate) use compare::comparison_page;
pub(crate) use plan::plan_page;
pub(crate) use run::{RunFolder, run_page};
pub(crate) use shakedown::shakedown_page;
pub(crate) use study::study_page;
pub use what_if::explorer_page;
