//! `railcrack sweep`: the runs of a study.

mod command;
mod progress;
mod shard;
mod tell;

pub use command::{SweepArguments, sweep};
