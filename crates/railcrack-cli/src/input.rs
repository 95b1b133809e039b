//! Case or study of a command, from a file or from standard input.

use crate::exit::Failure;
use clap::Args;
use railcrack_case::{Case, CaseErrors, Companion, Input, Overrides, SampleTable, Study, StudyRun};
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

/// Files that a command reads.
#[derive(Debug, Clone, Default)]
pub struct Inputs(Vec<PathBuf>);

impl Inputs {
    /// The file `path` and the files that the case in it names.
    pub fn of_case(path: &Path, case: &Case) -> Self {
        let beside = |companion: &Companion| path.with_file_name("").join(companion.given);
        Self::default().with(path).with_all(case.companions().iter().map(beside))
    }

    /// The file `path` and the files that the runs of the study in it name.
    pub fn of_study(path: &Path, study: &Study) -> Self {
        let of_run = |run: &StudyRun| Self::of_case(path, &run.case).0;
        let mut all: Vec<PathBuf> = study.runs.iter().flat_map(of_run).collect();
        all.sort();
        all.dedup();
        Self(all)
    }

    /// These and the file `path`.
    pub fn with(mut self, path: &Path) -> Self {
        self.0.push(path.to_path_buf());
        self
    }

    /// These and `paths`.
    pub fn with_all(mut self, paths: impl IntoIterator<Item = PathBuf>) -> Self {
        self.0.extend(paths);
        self
    }

    /// Checks that no input is replaced by results in `folder`, whose names, relative to it and
    /// with `/`, are those that `is_result` accepts.
    ///
    /// Errors: one is.
    pub fn stay(&self, folder: &Path, is_result: impl Fn(&str) -> bool) -> Result<(), Failure> {
        let Ok(folder) = folder.canonicalize() else { return Ok(()) };
        let is_replaced = |path: &&PathBuf| {
            let Ok(path) = path.canonicalize() else { return false };
            let Ok(name) = path.strip_prefix(&folder) else { return false };
            let parts: Vec<_> = name.components().map(|part| part.as_os_str().to_string_lossy()).collect();
            is_result(&parts.join("/"))
        };
        match self.0.iter().find(is_replaced) {
            Some(path) => Err(Failure::InputReplaced { path: path.clone() }),
            None => Ok(()),
        }
    }

    /// Checks that no input is replaced by the file `result`.
    ///
    /// Errors: one is.
    pub fn stay_beside(&self, result: &Path) -> Result<(), Failure> {
        let (Some(name), Some(folder)) = (result.file_name(), result.parent()) else { return Ok(()) };
        let folder = if folder == Path::new("") { Path::new(".") } else { folder };
        let name = name.to_string_lossy();
        self.stay(folder, |file| file == name)
    }
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
