//! Sampled values of a study: distributions given instead of values, and tables of samples.

mod distribution;
mod find;
mod points;
mod sobol;
mod substitute;
mod table;

pub use distribution::Distribution;
pub(super) use find::{Sampled, find_sampled, is_sampled};
pub(super) use points::points;
pub(super) use sobol::DIMENSIONS;
pub(super) use substitute::{Substitute, substituted};
pub use table::SampleTable;
