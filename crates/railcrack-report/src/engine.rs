//! The engine of a page: railcrack compiled to WebAssembly, as a file.

use crate::page_data::Deflated;
use railcrack_run::{OutputError, VERSION};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Variable of the environment that names the file.
const VARIABLE: &str = "RAILCRACK_ENGINE";
/// The folder of the file below the parent of the program's folder.
const SHARED: &str = "share/railcrack";
/// How every module begins: the name of the format and its version 1.
const MAGIC: [u8; 8] = *b"\0asm\x01\0\0\0";

const ENGINE: &str = include_str!("assets/engine.js");
const WORKER: &str = include_str!("assets/worker.js");

/// A module that computes cases within a page, of the version of this program.
#[derive(Debug, Clone, PartialEq)]
pub struct PageEngine {
    module: Deflated,
}

impl PageEngine {
    /// The file name of the module for this version: `railcrack-0.1.0.wasm`.
    #[must_use]
    pub fn file_name() -> String {
        format!("railcrack-{VERSION}.wasm")
    }

    /// The module that the variable `RAILCRACK_ENGINE` names; without it the file
    /// [`PageEngine::file_name`] beside the program, or in `share/railcrack` beside the folder of
    /// the program.
    ///
    /// Errors: there is no such file; those of [`PageEngine::read`].
    pub fn find() -> Result<Self, OutputError> {
        if let Some(named) = std::env::var_os(VARIABLE) {
            return Self::read(Path::new(&named));
        }
        let places = places();
        match places.iter().find(|place| place.is_file()) {
            Some(place) => Self::read(place),
            None => Err(OutputError::NoPageEngine { file: Self::file_name(), places }),
        }
    }

    /// The module in the file `path`.
    ///
    /// Errors: the file cannot be read, is no WebAssembly module, or is not named for this version.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let bytes = std::fs::read(path).map_err(OutputError::io("read", path))?;
        if !bytes.starts_with(&MAGIC) {
            return Err(OutputError::damaged(path, "is no WebAssembly module"));
        }
        let name = Self::file_name();
        if path.file_name().is_none_or(|own| own != name.as_str()) {
            let reason = format!("must be called {name}, as the engine of this version");
            return Err(OutputError::damaged(path, reason));
        }
        Ok(Self { module: Deflated::of(&bytes) })
    }

    /// Data of a page with `case`; `first` is the name of the curves of that case.
    pub(crate) fn data(&self, case: &str, first: &str) -> Value {
        json!({
            "version": VERSION,
            "module": self.module,
            "worker": format!("{ENGINE}\n{WORKER}"),
            "case": case,
            "first": first,
        })
    }
}

/// Where the module is looked for; nowhere if the folder of the program is not known.
fn places() -> Vec<PathBuf> {
    let Some(program) = program() else { return Vec::new() };
    let Some(folder) = program.parent() else { return Vec::new() };
    let shared = folder.parent().map(|above| above.join(SHARED));
    let folders = [Some(folder.to_path_buf()), shared].into_iter().flatten();
    folders.map(|place| place.join(PageEngine::file_name())).collect()
}

/// The file of the program; as it was called where the system does not say (Linux without `/proc`).
fn program() -> Option<PathBuf> {
    let called = || std::env::args_os().next().map(PathBuf::from).filter(|path| path.is_absolute());
    std::env::current_exe().ok().or_else(called)
}
