//! The engine of a page: railcrack compiled to WebAssembly, as a file.

use crate::page_data::Deflated;
use railcrack_case::open_regular;
use railcrack_run::disk::sha256;
use railcrack_run::{OutputError, VERSION};
use serde_json::{Value, json};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Variable of the environment that names the file.
const VARIABLE: &str = "RAILCRACK_ENGINE";
/// The folder of the file below the parent of the program's folder.
const SHARED: &str = "share/railcrack";
/// SHA-256 of the module that belongs to this program, where it was made with one: releases are.
const CHECKSUM: Option<&str> = option_env!("RAILCRACK_ENGINE_SHA256");
/// Maximum size of a module, bytes: ten times what it has.
const MOST: u64 = 50_000_000;
/// How every module begins: the name of the format and its version 1.
const MAGIC: [u8; 8] = *b"\0asm\x01\0\0\0";

/// The folders of the package.
static PACKAGED: OnceLock<Vec<PathBuf>> = OnceLock::new();

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
    /// [`PageEngine::file_name`] in the folders of the package ([`PageEngine::come_with`]), or
    /// beside the program and in `share/railcrack` beside the folder of the program.
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

    /// Looks for the module in `folders` from now on, and not beside the program: a package of an
    /// interpreter knows its environment, its process only the interpreter. The first call counts.
    pub fn come_with(folders: Vec<PathBuf>) {
        let _ = PACKAGED.set(folders);
    }

    /// The module in the file `path`.
    ///
    /// Errors: it is no regular file, larger than a module, or cannot be read; it is no WebAssembly
    /// module, not named for this version, or not the one that the program was released with.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let mut bytes = Vec::new();
        let file = open_regular(path).map_err(OutputError::io("read", path))?;
        file.take(MOST + 1).read_to_end(&mut bytes).map_err(OutputError::io("read", path))?;
        let name = Self::file_name();
        let is_named = path.file_name().is_some_and(|own| own == name.as_str());
        match fault(&bytes, CHECKSUM) {
            Some(reason) => Err(OutputError::BadPageEngine { path: path.to_path_buf(), reason }),
            None if !is_named => {
                let reason = format!("must be called {name}, as the engine of this version");
                Err(OutputError::BadPageEngine { path: path.to_path_buf(), reason })
            }
            None => Ok(Self { module: Deflated::of(&bytes) }),
        }
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

/// Why `bytes` are not the module with the `checksum`, or no module where none is given.
fn fault(bytes: &[u8], checksum: Option<&str>) -> Option<String> {
    if bytes.len() as u64 > MOST {
        return Some(format!("is larger than {} MB, the limit for a module", MOST / 1_000_000));
    }
    if !bytes.starts_with(&MAGIC) {
        return Some("is no WebAssembly module".to_owned());
    }
    let expected = checksum.filter(|expected| *expected != sha256(bytes))?;
    Some(format!("is not the engine that this program was released with (SHA-256 {expected})"))
}

/// Where the module is looked for: beside the program only where no package brings it.
fn places() -> Vec<PathBuf> {
    let folders = PACKAGED.get().cloned().or_else(folders_of_program).unwrap_or_default();
    folders.into_iter().map(|place| place.join(PageEngine::file_name())).collect()
}

/// None if the folder of the program is not known.
fn folders_of_program() -> Option<Vec<PathBuf>> {
    let program = program()?;
    let folder = program.parent()?;
    let shared = folder.parent().map(|above| above.join(SHARED));
    Some([Some(folder.to_path_buf()), shared].into_iter().flatten().collect())
}

/// The file of the program; as it was called where the system does not say (Linux without `/proc`).
fn program() -> Option<PathBuf> {
    let called = || std::env::args_os().next().map(PathBuf::from).filter(|path| path.is_absolute());
    std::env::current_exe().ok().or_else(called)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_module_is_known_by_its_checksum() {
        let module = [&MAGIC[..], b"module"].concat();
        assert_eq!(fault(&module, None), None);
        assert_eq!(fault(&module, Some(&sha256(&module))), None);
        assert!(fault(&module, Some(&sha256(b"other"))).unwrap().contains("was released with"));
        assert!(fault(b"text", None).unwrap().contains("is no WebAssembly module"));
    }
}
