//! Measured numbers as files: what was measured, under which conditions, by whom, how it was read,
//! and how it is compared with the model.

mod entry;
mod read;
mod tables;

pub use entry::{Comparison, Entry, EntryValue, Grade, HowRead, Quantity};
pub use tables::entry_schema;
