//! Fields of a run as files of VTK, and the collection that lists them.

use super::names::name;
use super::space::{space_grids, status_number};
use crate::disk::files::FIELDS_FOLDER;
use crate::disk::{Durability, Seal, inner_folder, replace_file};
use crate::error::OutputError;
use railcrack::body::{Face, FieldGrid, FieldLine};
use railcrack::contact::FaceState;
use railcrack::growth::{FieldSnapshot, StepRecord};
use railcrack::math::Stress;
use railcrack::mesh::{Array, CellBlock, CellShape, UnstructuredGrid};
use railcrack_vtu::{Snapshot, VtuError, pvd_text, vtu_text_with};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A field file in the list of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct FieldFileEntry {
    /// Its name in the run folder.
    pub name: String,
    /// Step, plus the fraction of the positions of its passage that precede it.
    pub time: f64,
    /// Its content.
    pub seal: Seal,
}

/// The field file of a step and a wheel position (from 1), in the run folder.
pub fn field_file(step: usize, position: usize) -> String {
    format!("{FIELDS_FOLDER}/{}", name(step, position))
}

/// The fields of a step: of each wheel position its number (from 1), the name of its file in the
/// run folder, and what the file holds.
pub fn field_grids(record: &StepRecord) -> impl Iterator<Item = (usize, String, UnstructuredGrid)> {
    let plane = record.fields.iter().flat_map(|fields| {
        fields.snapshots.iter().map(|snapshot| {
            let position = snapshot.position + 1;
            (position, field_file(record.step, position), grid_of(&fields.grid, snapshot, record))
        })
    });
    plane.chain(space_grids(record))
}

/// Writes the fields of a step, each to its file.
///
/// Errors: a number that is not finite; the system refuses.
pub(crate) fn write_fields(
    folder: &Path,
    record: &StepRecord,
    durability: Durability,
) -> Result<Vec<FieldFileEntry>, OutputError> {
    if record.fields.is_some()
        || record.faces.across.as_ref().is_some_and(|across| !across.written.is_empty())
    {
        inner_folder(folder, FIELDS_FOLDER)?;
    }
    let positions = record.passages.last().map_or(1, |passage| passage.xc.len());
    let write = |(position, file, grid): (usize, String, UnstructuredGrid)| {
        let path = folder.join(&file);
        let text = vtu_text_with(&grid, &of_all(record, position))
            .map_err(|reason| VtuError::Grid { path: path.clone(), reason })?;
        replace_file(&path, &text, durability)?;
        let time = record.step as f64 + (position - 1) as f64 / positions as f64;
        Ok(FieldFileEntry { name: file, time, seal: Seal::of(&text) })
    };
    field_grids(record).map(write).collect()
}

/// Writes the list of `files` to `path`.
///
/// Errors: the system refuses.
pub(crate) fn write_collection<'a>(
    path: &Path,
    files: impl Iterator<Item = &'a FieldFileEntry>,
    durability: Durability,
) -> Result<(), OutputError> {
    replace_file(path, collection(path, files)?.as_bytes(), durability)
}

/// The text of the list of `files`, for `path`.
pub(crate) fn collection<'a>(
    path: &Path,
    files: impl Iterator<Item = &'a FieldFileEntry>,
) -> Result<String, OutputError> {
    let snapshots: Vec<Snapshot> =
        files.map(|file| Snapshot { time: file.time, file: file.name.clone() }).collect();
    Ok(pvd_text(&snapshots).map_err(|reason| VtuError::Grid { path: path.to_path_buf(), reason })?)
}

/// Data of a whole file: step, position (from 1) and the x coordinate of the contact centre.
fn of_all(record: &StepRecord, position: usize) -> Vec<Array> {
    let xc = record.passages.last().and_then(|passage| passage.xc.get(position - 1));
    let mut arrays = vec![
        Array::scalars("step", vec![record.step as f64]),
        Array::scalars("position", vec![position as f64]),
    ];
    arrays.extend(xc.map(|xc| Array::scalars("wheel_position_mm", vec![*xc])));
    arrays
}

/// The contact status of a piece of a face: that of the face point with the largest weight at its
/// ends.
fn status_of(line: &FieldLine, states: &[FaceState]) -> f64 {
    let points = line.tractions.iter().flatten();
    let nearest = points.max_by(|one, other| one.1.total_cmp(&other.1)).map(|(point, _)| *point);
    nearest.and_then(|point| states.get(point)).map_or(NO_FACE, |state| status_number(state.status))
}

/// Von Mises stress, √(½[(σxx − σyy)² + (σyy − σzz)² + (σzz − σxx)²] + 3σxy²), MPa.
fn von_mises(stress: &Stress) -> f64 {
    let Stress { xx, yy, zz, xy } = *stress;
    let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * normal + 3.0 * xy * xy).sqrt()
}

/// `status` of cells that are no faces.
const NO_FACE: f64 = -1.0;

/// Elements, pieces of elements, faces.
fn grid_of(grid: &FieldGrid, field: &FieldSnapshot, record: &StepRecord) -> UnstructuredGrid {
    let block = |shape, connectivity: Vec<usize>| CellBlock { shape, connectivity };
    let bulk = grid.quads.len() + grid.triangles.len();
    let side = grid.lines.iter().map(|line| match line.face {
        Face::Plus => 1.0,
        Face::Minus => -1.0,
    });
    let states = record.faces.states.get(field.position).map_or(&[][..], |states| &states[..]);
    let status = grid.lines.iter().map(|line| status_of(line, states));
    UnstructuredGrid {
        points: grid.points.clone(),
        z: Vec::new(),
        cells: vec![
            block(CellShape::QuadraticQuad, grid.quads.concat()),
            block(CellShape::Triangle, grid.triangles.concat()),
            block(CellShape::Line, grid.lines.iter().flat_map(|line| line.ends).collect()),
        ],
        point_data: vec![
            Array::vectors("displacement_mm", &field.displacement),
            Array::stresses("stress_mpa", &field.stress),
            Array::scalars("von_mises_mpa", field.stress.iter().map(von_mises).collect()),
            Array::vectors("traction", &field.traction),
            Array::vectors("traction_mpa", &field.traction),
        ],
        cell_data: vec![
            Array::scalars("face", std::iter::repeat_n(0.0, bulk).chain(side).collect()),
            Array::scalars("status", std::iter::repeat_n(NO_FACE, bulk).chain(status).collect()),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_equivalent_stress_is_that_of_von_mises() {
        // Uniaxial tension, pure shear (√3 τ), pressure.
        let stress = |xx, yy, zz, xy| Stress { xx, yy, zz, xy };
        assert_eq!(von_mises(&stress(100.0, 0.0, 0.0, 0.0)), 100.0);
        assert!((von_mises(&stress(0.0, 0.0, 0.0, 50.0)) - 50.0 * 3f64.sqrt()).abs() < 1e-12);
        assert_eq!(von_mises(&stress(-70.0, -70.0, -70.0, 0.0)), 0.0);
    }
}
