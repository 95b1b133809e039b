//! The `railcrack` command: growth of rolling-contact-fatigue cracks in rails.

mod arguments;
mod commands;
mod display;
mod exit;
mod input;
mod interruption;
mod json;
#[cfg(feature = "png")]
mod png;
mod print;
mod progress;

use arguments::Arguments;
use clap::Parser;
use exit::Exit;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    run(arguments).into()
}

/// Does what was asked for; says on stderr what went wrong.
fn run(arguments: Arguments) -> Exit {
    match commands::dispatch(arguments.command) {
        Ok(exit) => exit,
        Err(failure) => {
            print::failure(&failure);
            failure.exit()
        }
    }
}
