//! The field files of a run, read back.

use super::names::step_and_position;
use crate::disk::files::FIELDS_FOLDER;
use crate::error::OutputError;
use railcrack::mesh::UnstructuredGrid;
use railcrack_vtu::read_vtu;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A field file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FieldFile {
    /// Growth step.
    pub step: usize,
    /// Wheel position, from 1.
    pub position: usize,
    /// The file.
    pub path: PathBuf,
}

/// The field files of the first `steps` growth steps of the run in `folder`, in their order.
///
/// Errors: the system refuses.
pub fn field_files(folder: &Path, steps: usize) -> Result<Vec<FieldFile>, OutputError> {
    let folder = folder.join(FIELDS_FOLDER);
    let refused = || OutputError::io("read", &folder);
    let entries = match std::fs::read_dir(&folder) {
        Err(reason) if reason.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(refused())?,
    };
    let mut files = Vec::new();
    for entry in entries {
        let name = entry.map_err(refused())?.file_name();
        if let Some((step, position)) =
            step_and_position(&name.to_string_lossy()).filter(|(step, _)| *step < steps)
        {
            files.push(FieldFile { step, position, path: folder.join(name) });
        }
    }
    files.sort_by_key(|file| (file.step, file.position));
    Ok(files)
}

impl FieldFile {
    /// Reads it.
    ///
    /// Errors: it is damaged; the system refuses.
    pub fn read(&self) -> Result<UnstructuredGrid, OutputError> {
        Ok(read_vtu(&self.path)?)
    }
}
