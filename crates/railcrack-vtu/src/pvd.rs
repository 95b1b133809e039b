//! Collections of grids in time (`.pvd`).

use crate::error::VtuError;
use crate::write::{escaped, put};
use railcrack::mesh::GridError;
use std::path::Path;

/// A grid of a collection.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Time, or any other parameter that orders the grids: a growth step, x_c/a.
    pub time: f64,
    /// The file of the grid, relative to the folder of the collection, with `/`.
    pub file: String,
}

/// Writes the collection of `snapshots` to the file `path` as [`pvd_text`].
///
/// Errors: a time that is not finite; an error of the operating system.
pub fn write_pvd(path: &Path, snapshots: &[Snapshot]) -> Result<(), VtuError> {
    let text = pvd_text(snapshots).map_err(|reason| VtuError::Grid { path: path.to_path_buf(), reason })?;
    put(path, text.as_bytes())
}

/// The contents of the file of the collection of `snapshots`, in their order.
///
/// Errors: a time that is not finite.
pub fn pvd_text(snapshots: &[Snapshot]) -> Result<String, GridError> {
    if let Some(entry) = snapshots.iter().position(|snapshot| !snapshot.time.is_finite()) {
        return Err(GridError::NotFinite { name: "time".to_owned(), entry, value: snapshots[entry].time });
    }
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    text.push_str(
        "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
    );
    for Snapshot { time, file } in snapshots {
        let file = escaped(file);
        text.push_str(&format!("<DataSet timestep=\"{time}\" part=\"0\" file=\"{file}\"/>\n"));
    }
    text.push_str("</Collection>\n</VTKFile>\n");
    Ok(text)
}
