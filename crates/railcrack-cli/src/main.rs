//! The `railcrack` command.

// The command line that calls `run` comes with the case file.
#![allow(dead_code)]

mod commands {
    pub mod run;
}
mod drive;
mod interruption;
mod progress;

fn main() {}
