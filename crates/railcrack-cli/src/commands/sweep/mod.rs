//! `railcrack sweep`: the runs of a study.

mod command;
mod job;
mod progress;
mod shard;
mod tell;

pub use command::{SweepArguments, sweep};
