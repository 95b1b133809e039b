//! Memory and disk: those of the machine, and a run's need of them.

mod budget;
mod memory;

pub use budget::{Budget, Needs, OverBudget, mb};
pub(crate) use memory::peak_memory_mb;
