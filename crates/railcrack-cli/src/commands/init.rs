//! `railcrack init`.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;

/// Write a commented case file to start from
///
/// The file holds the reference case (one 6 mm crack at 15 degrees under a wheel of 845 MPa), ready
/// to run, with a comment on every key.
#[derive(Debug, Args)]
pub struct InitArguments {
    /// The file to write; `-` is standard output
    #[arg(value_name = "FILE", default_value = "case.toml")]
    file: PathBuf,
    /// Replace a file that is already there
    #[arg(long)]
    force: bool,
}

/// Writes the commented case file.
pub fn init(arguments: &InitArguments) -> Result<Exit, Failure> {
    let text = railcrack_case::init_text();
    if arguments.file.as_os_str() == "-" {
        print::stdout(&text)?;
        return Ok(Exit::Done);
    }
    let path = arguments.file.clone();
    let mut options = OpenOptions::new();
    if arguments.force {
        options.write(true).create(true).truncate(true);
    } else {
        options.write(true).create_new(true);
    }
    match options.open(&path).and_then(|mut file| file.write_all(text.as_bytes())) {
        Ok(()) => {
            let shown = path.display();
            print::stdout(&format!("wrote {shown}; next: railcrack check {shown}\n"))?;
            Ok(Exit::Done)
        }
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(Failure::Exists { path }),
        Err(source) => Err(Failure::CannotWrite { path, source }),
    }
}
