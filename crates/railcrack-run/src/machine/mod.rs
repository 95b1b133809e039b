//! Memory and disk: available amounts and requirements of a run.

mod budget;
mod memory;

pub use budget::{Budget, Needs, OverBudget, mb};
pub(crate) use memory::peak_memory_mb;
pub use memory::short_of_address_space;
