//! Case or study of a command, from a file or from standard input.

use crate::exit::Failure;
use clap::Args;
use railcrack_case::{Case, CaseErrors, Input, Overrides, SampleTable, Study};
use std::io::Read;
use std::path::{Path, PathBuf};

/// File name that denotes standard input.
const STANDARD_INPUT: &str = "-";
/// Name of standard input in error messages.
const SHOWN: &str = "standard input";
/// Maximum number of bytes read, the same as for a file.
const MOST: u64 = 4 << 20;

/// Values on the command line that override the file.
#[derive(Debug, Clone, Default, Args)]
pub struct Set {
    /// Value that overrides the file, with the same checks: --set contact.friction=0.2, --set
    /// crack[2].angle_deg=30.0; can be repeated
    #[arg(long, value_name = "SECTION.KEY=VALUE")]
    pub set: Vec<String>,
}

impl Set {
    /// These values, and nothing else that overrides the file.
    pub fn overrides(&self) -> Overrides {
        Overrides { settings: self.set.clone(), ..Overrides::default() }
    }
}

/// Reads the case in the file `path` or from standard input.
pub fn case(path: &Path, overrides: &Overrides) -> Result<Case, Failure> {
    read(path, || Case::read_with(path, overrides), |text| Case::parse_with(text, SHOWN, here(), overrides))
}

/// Reads the study in the file `path` or from standard input.
pub fn study(path: &Path, overrides: &Overrides, samples: Option<&SampleTable>) -> Result<Study, Failure> {
    read(
        path,
        || Study::read_with_samples(path, overrides, samples),
        |text| Study::parse_with_samples(text, SHOWN, here(), overrides, samples),
    )
}

/// Reads a case or a study in the file `path` or from standard input.
pub fn either(path: &Path, overrides: &Overrides) -> Result<Input, Failure> {
    read(path, || Input::read_with(path, overrides), |text| Input::parse_with(text, SHOWN, here(), overrides))
}

/// Default folder of results: the path of the case file without its extension; `case` in the
/// current directory for standard input.
pub fn default_folder(path: &Path) -> PathBuf {
    if is_standard_input(path) { PathBuf::from("case") } else { path.with_extension("") }
}

fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == STANDARD_INPUT
}

/// Directory for relative file names: for a case on standard input, the current directory.
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
    std::io::stdin().lock().take(MOST + 1).read_to_string(&mut text).map_err(Failure::Stdin)?;
    if text.len() as u64 > MOST {
        let says = format!("it is larger than {} MB, the limit for a case", MOST >> 20);
        return Err(Failure::Stdin(std::io::Error::other(says)));
    }
    Ok(from_text(&text)?)
}
