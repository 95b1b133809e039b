//! Runs of a study in a few files: what a run folder would hold, a record for each run.

#[cfg(fuzzing)]
mod fuzzed;
mod record;
mod runs;
mod scan;
#[cfg(test)]
mod sequence_tests;
#[cfg(test)]
mod tests;
mod writer;

#[cfg(fuzzing)]
pub use fuzzed::fuzz_packed;
pub(super) use runs::packed_files;
pub(crate) use runs::{Flaw, PackedRuns};
pub(super) use writer::{PackWriter, void_damages};
