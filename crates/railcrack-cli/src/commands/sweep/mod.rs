//! `railcrack sweep`: the runs of a study.

mod command;
mod messages;
mod progress;
mod shard;

pub use command::{SweepArguments, sweep};
