//! A plastic stress that a case names: a field on a mesh or a profile.

use super::error::{Fault, Report};
use railcrack::mesh::{Array, UnstructuredGrid};
use railcrack::residual::{PLASTIC_STRESS_ARRAY, PlasticField};
use railcrack_vtu::{VtuError, read_vtu_bytes, vtu_text};
use std::ops::Range;
use std::path::Path;

/// A plastic stress on a mesh and the file it was read from, reduced to what is used of it. Two are equal when these are.
#[derive(Debug, Clone)]
pub struct FieldFile {
    given: String,
    text: String,
    field: PlasticField,
}

impl PartialEq for FieldFile {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl FieldFile {
    /// The plastic stress.
    pub fn field(&self) -> &PlasticField {
        &self.field
    }

    /// A file of its mesh and of the one array that is used.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The file's name as the case gives it.
    pub fn given_name(&self) -> &str {
        &self.given
    }
}

/// Reads the field that the case calls `given` (at `span` of the case, under `key`), relative to `folder`.
pub(super) fn read_field(
    given: &str,
    folder: &Path,
    key: &str,
    span: Range<usize>,
    report: &mut Report,
) -> Option<FieldFile> {
    let path = folder.join(given);
    let (message, help) = match read(&path) {
        Ok((text, field)) => return Some(FieldFile { given: given.into(), text, field }),
        Err(refusal) => refusal,
    };
    report.add(Fault {
        message: format!("`{key} = \"{given}\"`: {message}"),
        key: Some(key.into()),
        span: Some(span),
        help: Some(help.into()),
        also: None,
    });
    None
}

const WHERE: &str = "file names are relative to the folder of the case file";
const WHAT: &str =
    "a VTU file with `plastic_stress_mpa` on points or cells, as `railcrack shakedown` writes it";

fn read(path: &Path) -> Result<(String, PlasticField), (String, &'static str)> {
    if path.is_dir() {
        return Err(("it is a folder, not a file".into(), WHERE));
    }
    let bytes = std::fs::read(path).map_err(|reason| match reason.kind() {
        std::io::ErrorKind::NotFound => ("there is no such file".to_owned(), WHERE),
        _ => (format!("cannot be read: {reason}"), WHERE),
    })?;
    let grid = read_vtu_bytes(&bytes, path).map_err(|error| (without_path(&error), WHAT))?;
    let field = PlasticField::from_grid(&grid).map_err(|error| (error.to_string(), WHAT))?;
    let used = |arrays: &[Array]| -> Vec<Array> {
        arrays.iter().filter(|array| array.name == PLASTIC_STRESS_ARRAY).cloned().collect()
    };
    // Data on points are taken where both are there.
    let point_data = used(&grid.point_data);
    let cell_data = if point_data.is_empty() { used(&grid.cell_data) } else { Vec::new() };
    let kept = UnstructuredGrid { points: grid.points, cells: grid.cells, point_data, cell_data };
    let text = vtu_text(&kept).map_err(|error| (error.to_string(), WHAT))?;
    let text = String::from_utf8(text).map_err(|error| (error.to_string(), WHAT))?;
    Ok((text, field))
}

/// The message names the file already.
fn without_path(error: &VtuError) -> String {
    match error {
        VtuError::Io { reason, .. } => reason.to_string(),
        VtuError::Grid { reason, .. } => reason.to_string(),
        VtuError::Malformed { part, reason, .. } => format!("{part}: {reason}"),
        VtuError::Unsupported { part, found, accepted, .. } => format!("{part} is {found}: {accepted}"),
    }
}
