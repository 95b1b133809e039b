//! `railcrack init`.

use super::template::Template;
use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Write a commented case file as a starting point
///
/// The file contains the reference case (one 6 mm crack at 15 degrees under a wheel with a peak
/// pressure of 845 MPa), ready to run, with a comment on every key. With --template it is a shorter
/// file for that kind of case: for a rail, begin with head-check, whose wheel is given by its load
/// and radii.
#[derive(Debug, Args)]
pub struct InitArguments {
    /// File to write; `-` is standard output [default: case.toml, or the name of the template]
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    /// Kind of case to write instead of the reference case
    #[arg(long, value_name = "NAME")]
    template: Option<Template>,
    /// Replace an existing file
    #[arg(long)]
    force: bool,
}

/// Writes the case file and the files that it names.
pub fn init(arguments: &InitArguments) -> Result<Exit, Failure> {
    let template = arguments.template;
    let text = template.map_or_else(railcrack_case::init_text, |template| template.text().to_owned());
    let path = arguments.file.clone().unwrap_or_else(|| default_file(template));
    if path.as_os_str() == "-" {
        print::stdout(&text)?;
        return Ok(Exit::Done);
    }
    for (name, text) in template.map_or(&[][..], Template::beside) {
        put(&path.with_file_name(name), text, arguments.force)?;
    }
    put(&path, &text, arguments.force)?;
    let shown = path.display();
    print::stdout(&format!("wrote {shown}; next: railcrack check {shown}\n"))?;
    Ok(Exit::Done)
}

fn default_file(template: Option<Template>) -> PathBuf {
    let name = template.and_then(|template| clap::ValueEnum::to_possible_value(&template));
    PathBuf::from(name.map_or_else(|| "case.toml".to_owned(), |name| format!("{}.toml", name.get_name())))
}

fn put(path: &Path, text: &str, force: bool) -> Result<(), Failure> {
    let mut options = OpenOptions::new();
    if force {
        options.write(true).create(true).truncate(true);
    } else {
        options.write(true).create_new(true);
    }
    let path = path.to_path_buf();
    match options.open(&path).and_then(|mut file| file.write_all(text.as_bytes())) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(Failure::Exists { path }),
        Err(source) => Err(Failure::CannotWrite { path, source }),
    }
}
