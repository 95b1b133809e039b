//! The folder of a run: its case, when it may be replaced, its checkpoint; its results read back
//! and verified.

mod begin;
mod case_files;
mod checkpoint;
mod clear;
mod history;
mod read;
mod representative;
mod result_folder;
mod stored_case;
mod verification;

pub use begin::Existing;
pub(crate) use begin::{begin, restore_case};
pub use case_files::CaseFiles;
pub(crate) use case_files::{case_checksums, has_more_steps, same_case, same_text};
#[cfg(fuzzing)]
pub use checkpoint::fuzz_checkpoint;
pub(crate) use checkpoint::{AfterStep, Checkpoint, LogFile, Seals};
pub use clear::{clear_run, is_file_of_run};
pub(crate) use clear::{is_unfinished, run_file_in, run_file_in_study};
pub use history::History;
pub(crate) use read::RunFiles;
pub use read::RunFolder;
pub use representative::{RepresentativeTip, cycles_to, representative_tip};
pub use result_folder::{OF_A_RUN, ResultFolder, ResultKind, WithRun};
pub(crate) use stored_case::{check_case, read_case, stored_case, was_about_to_begin, wheel_groups};
pub use verification::Verification;
pub(crate) use verification::{Extent, check_numbers, same_bytes};
