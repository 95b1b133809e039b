//! `railcrack explorer`.

use crate::exit::{Exit, Failure};
use crate::input::Inputs;
use crate::print;
use clap::Args;
use railcrack_case::{Case, NotInPage};
use railcrack_report::{PageEngine, explorer_page, put};
use railcrack_run::simulation::RunError;
use std::path::{Path, PathBuf};

/// The case of a page for which none is given.
const HEAD_CHECK: &str = include_str!("../../templates/explorer.toml");

/// Write a page that computes a case in any browser
///
/// The page is one file that opens without a server and loads nothing: it holds the engine, the
/// case with a slider for its main values, and the charts that move with them. Engine dislocation,
/// without files that the case would name. The engine of pages is the file railcrack-VERSION.wasm
/// beside the program or in ../share/railcrack; the variable RAILCRACK_ENGINE names another place.
#[derive(Debug, Args)]
pub struct ExplorerArguments {
    /// Case file [default: a head check under traffic]
    #[arg(value_name = "CASE")]
    case: Option<PathBuf>,
    /// File to write
    #[arg(long, value_name = "FILE", default_value = "explorer.html")]
    out: PathBuf,
    /// Replace an existing file
    #[arg(long)]
    force: bool,
}

/// Writes the page.
pub fn explorer(arguments: &ExplorerArguments) -> Result<Exit, Failure> {
    let text = match &arguments.case {
        Some(path) => text_of(path)?,
        None => HEAD_CHECK.to_owned(),
    };
    let path = &arguments.out;
    if !arguments.force && path.exists() {
        return Err(Failure::Exists { path: path.clone() });
    }
    if let Some(case) = &arguments.case {
        Inputs::default().with(case).stay_beside(path)?;
    }
    let engine = PageEngine::find().map_err(RunError::from)?;
    let page = explorer_page(&engine, &text);
    put(path, &page).map_err(RunError::from)?;
    let megabytes = page.len() as f64 / 1e6;
    print::stdout(&format!("wrote {}, {megabytes:.1} MB: open it in a browser\n", path.display()))?;
    Ok(Exit::Done)
}

/// The text of the case in the file `path`, which a page must be able to compute.
fn text_of(path: &Path) -> Result<String, Failure> {
    let case = Case::read(path)?;
    if let Some(NotInPage { message, help, .. }) = case.not_in_page().first() {
        return Err(Failure::Show(format!("{}: {message}; {help}", path.display())));
    }
    std::fs::read_to_string(path).map_err(|source| Failure::CannotRead { path: path.to_path_buf(), source })
}
