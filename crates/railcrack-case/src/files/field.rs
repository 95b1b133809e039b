//! Plastic stress on a mesh, in VTU files.

use super::companion::{FieldFile, RELATIVE};
use crate::schema::{KeyRow, Report, SectionValues, read_bytes};
use railcrack::mesh::{Array, UnstructuredGrid};
use railcrack::residual::{PLASTIC_STRESS_ARRAY, PlasticField};
use railcrack_vtu::{VtuError, read_vtu_bytes, vtu_text};
use std::path::Path;

/// The field in the file that a key names, relative to `folder`; none if no file is named or it
/// cannot be read; errors are added to `report`.
pub(crate) fn read_field(
    section: &SectionValues,
    row: KeyRow<String>,
    folder: &Path,
    report: &mut Report,
) -> Option<FieldFile> {
    let given = section.get(row)?;
    match read(&folder.join(&given)) {
        Ok((text, field)) => Some(FieldFile::new(row, given, text, field)),
        Err((message, help)) => report.refuse(section.fault(row, message).help(help)),
    }
}

/// Help where the file is not such a field.
const EXPECTED: &str =
    "expected a VTU file with `plastic_stress_mpa` at points or cells, as written by `railcrack shakedown`";

/// Maximum size (bytes) of a field: a million cells, ten times as many as `railcrack shakedown`
/// writes.
const MOST_FIELD: u64 = 256 << 20;

fn read(path: &Path) -> Result<(String, PlasticField), (String, &'static str)> {
    let bytes = read_bytes(path, MOST_FIELD).map_err(|reason| match reason.kind() {
        std::io::ErrorKind::NotFound => ("there is no such file".to_owned(), RELATIVE),
        _ => (format!("cannot be read: {reason}"), RELATIVE),
    })?;
    let grid = read_vtu_bytes(&bytes, path).map_err(|error| (without_path(&error), EXPECTED))?;
    let field = PlasticField::from_grid(&grid).map_err(|error| (error.to_string(), EXPECTED))?;
    let used = |arrays: &[Array]| -> Vec<Array> {
        arrays.iter().filter(|array| array.name == PLASTIC_STRESS_ARRAY).cloned().collect()
    };
    // Data at points are preferred if both are present.
    let point_data = used(&grid.point_data);
    let cell_data = if point_data.is_empty() { used(&grid.cell_data) } else { Vec::new() };
    let kept = UnstructuredGrid { points: grid.points, z: grid.z, cells: grid.cells, point_data, cell_data };
    let text = vtu_text(&kept).map_err(|error| (error.to_string(), EXPECTED))?;
    let text = String::from_utf8(text).map_err(|error| (error.to_string(), EXPECTED))?;
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
