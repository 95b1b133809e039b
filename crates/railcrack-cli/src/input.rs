//! The case or study of a command: a file, or standard input.

use crate::exit::Failure;
use clap::Args;
use railcrack_case::{Case, CaseErrors, Input, Overrides, SampleTable, Study};
use std::io::Read;
use std::path::{Path, PathBuf};

/// The name that stands for standard input.
const STANDARD_INPUT: &str = "-";
/// The name that errors give it.
const SHOWN: &str = "standard input";
/// Most bytes that are read of it: as of a file.
const MOST: u64 = 4 << 20;

/// Values of the command line in place of the file's.
#[derive(Debug, Clone, Default, Args)]
pub struct Set {
    /// A value in place of the file's, checked as that: --set contact.friction=0.2, --set
    /// crack[2].angle_deg=30.0; may be given several times
    #[arg(long, value_name = "SECTION.KEY=VALUE")]
    pub set: Vec<String>,
}

/// The case in the file `path`, or in standard input.
pub fn case(path: &Path, overrides: &Overrides) -> Result<Case, Failure> {
    read(path, || Case::read_with(path, overrides), |text| Case::parse_with(text, SHOWN, here(), overrides))
}

/// The study in the file `path`, or in standard input.
pub fn study(path: &Path, overrides: &Overrides, samples: Option<&SampleTable>) -> Result<Study, Failure> {
    read(
        path,
        || Study::read_with_samples(path, overrides, samples),
        |text| Study::parse_with_samples(text, SHOWN, here(), overrides, samples),
    )
}

/// Either in the file `path`, or in standard input.
pub fn either(path: &Path, overrides: &Overrides) -> Result<Input, Failure> {
    read(path, || Input::read_with(path, overrides), |text| Input::parse_with(text, SHOWN, here(), overrides))
}

/// The folder of results: the name of the case file without its ending, beside it; `case` here for
/// standard input.
pub fn default_folder(path: &Path) -> PathBuf {
    if is_standard_input(path) { PathBuf::from("case") } else { path.with_extension("") }
}

fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == STANDARD_INPUT
}

/// Relative file names of a case that comes by standard input are relative to where the command
/// runs.
fn here() -> &'static Path {
    Path::new("")
}

fn read<T>(
    path: &Path,
    from_file: impl FnOnce() -> Result<T, CaseErrors>,
    from_text: impl FnOnce(&str) -> Result<T, CaseErrors>,
) -> Result<T, Failure> {
    if !is_standard_input(path) {
        return Ok(from_file()?);
    }
    let mut text = String::new();
    std::io::stdin().lock().take(MOST).read_to_string(&mut text).map_err(Failure::Stdin)?;
    Ok(from_text(&text)?)
}
