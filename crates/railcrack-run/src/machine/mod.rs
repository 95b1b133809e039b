//! Memory, disk and time: available amounts and requirements of a run.

mod budget;
mod duration;
mod memory;

pub use budget::{Budget, Needs, OverBudget, mb};
pub use duration::{long_step, step_seconds};
pub(crate) use memory::peak_memory_mb;
pub use memory::short_of_address_space;
