//! A study: a case file with lists instead of values, and the cases that it defines.

mod axes;
mod expand;
mod input;
mod merge;
mod names;
mod read;
mod sampling;
mod schema;
mod tables;
mod variation;

pub use axes::Axis;
pub use expand::{Keeping, Study, StudyRun};
pub use input::Input;
pub use sampling::{Distribution, SampleTable};
pub use schema::study_schema;
pub use variation::Variation;
