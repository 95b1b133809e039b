//! What the machine has: memory and disk, and what a run needs of them.

mod budget;
mod memory;

pub use budget::{Budget, Needs, OverBudget, mb};
pub(crate) use memory::peak_memory_mb;
