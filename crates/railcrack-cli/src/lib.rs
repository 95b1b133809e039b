//! The `railcrack` command: growth of rolling-contact-fatigue cracks in rails.

mod arguments;
mod commands;
mod dispatch;
mod display;
mod exit;
mod input;
mod interruption;
mod json;
#[cfg(feature = "png")]
mod png;
mod print;
mod processes;
mod progress;
mod terminal;

pub use commands::run::{MOST_THREADS, thread_count};
pub use processes::start_alone;

use arguments::Arguments;
use clap::Parser;
use exit::Exit;
use railcrack_case::Case;
use std::ffi::OsString;
use std::path::Path;

/// Executes the command line `arguments`, whose first entry is the name of the program, reports
/// errors on standard error, and returns the exit code. Called once per process, because it
/// installs signal handlers and a thread pool.
pub fn command(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    match Arguments::try_parse_from(arguments) {
        Ok(arguments) => run(arguments).code(),
        Err(error) => {
            // A failure to write to the stream cannot be reported.
            let _ = error.print();
            u8::try_from(error.exit_code()).unwrap_or(Exit::BadInput.code())
        }
    }
}

/// The lines that `railcrack check` prints of `case`, whose run would be written to `folder`.
#[must_use]
pub fn check_text(case: &Case, folder: &Path) -> String {
    commands::check::summary(&railcrack_run::setup::represented(case), folder)
}

/// Readers for the fuzz targets in `fuzz/`.
#[cfg(fuzzing)]
pub mod fuzzing {
    /// Reads `head` as the header of a request to `railcrack view`.
    pub fn request(head: &[u8]) {
        crate::commands::view::fuzz_request(head);
    }
}

/// Executes the command and reports errors on standard error.
fn run(arguments: Arguments) -> Exit {
    match dispatch::dispatch(arguments.command) {
        Ok(exit) => exit,
        Err(failure) => {
            print::failure(&failure);
            failure.exit()
        }
    }
}
