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
mod progress;

pub use commands::run::MOST_THREADS;

use arguments::Arguments;
use clap::Parser;
use exit::Exit;
use railcrack_case::Case;
use std::ffi::OsString;
use std::path::Path;

/// Does what the command line `arguments` ask for, the name of the program first, and says on
/// standard error what went wrong: the exit code of the program. Once per process: it takes the
/// signals and the threads.
pub fn command(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    match Arguments::try_parse_from(arguments) {
        Ok(arguments) => run(arguments).code(),
        Err(error) => {
            // Nobody is left to tell when the stream itself is gone.
            let _ = error.print();
            u8::try_from(error.exit_code()).unwrap_or(Exit::BadInput.code())
        }
    }
}

/// The lines that `railcrack check` prints of `case`, whose run would be written to `folder`.
#[must_use]
pub fn check_text(case: &Case, folder: &Path) -> String {
    commands::check::summary(case, folder)
}

/// Does what was asked for; says on stderr what went wrong.
fn run(arguments: Arguments) -> Exit {
    match dispatch::dispatch(arguments.command) {
        Ok(exit) => exit,
        Err(failure) => {
            print::failure(&failure);
            failure.exit()
        }
    }
}
