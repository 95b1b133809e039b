//! The deformed neighbourhood of the cracks: the field files of the first and the last step that have any.

use super::stored::RunFolder;
use crate::math::Vec2;
use crate::output::OutputError;
use crate::output::fields::{FIELDS_FOLDER, step_and_position};
use crate::output::report::pack::{packed_levels, quantised};
use crate::vtu::{CellShape, UnstructuredGrid, read_vtu};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::PathBuf;

/// The most cells of a grid in the page: about eight bytes each, and as many for each wheel position.
const CELLS: usize = 20_000;
/// The most wheel positions of a step.
const POSITIONS: usize = 5;

/// Cells by their corners, and the points that are one.
struct Grid {
    /// Indices of the points that the page has, in the file.
    used: Vec<usize>,
    /// Corners in `used`, four for each cell; the third of a triangle twice.
    corners: Vec<u16>,
}

/// What of the fields is in the page.
pub(super) enum Neighbourhood {
    /// The run wrote none.
    NoFiles,
    /// The grids have more cells than the page takes.
    TooLarge,
    /// Grids with displacement and stress.
    Shown(Value),
}

/// Grids with their displacement and stress, by step.
///
/// Errors: a file is damaged; the system refuses.
pub(super) fn neighbourhood(run: &RunFolder) -> Result<Neighbourhood, OutputError> {
    let files = files(run)?;
    if files.is_empty() {
        return Ok(Neighbourhood::NoFiles);
    }
    let mut steps = Vec::new();
    let ends = [files.first_key_value(), files.last_key_value()];
    for (i, (&step, positions)) in ends.into_iter().flatten().enumerate() {
        if i == 1 && files.len() == 1 {
            continue;
        }
        steps.extend(packed_step(step, &positions[..positions.len().min(POSITIONS)])?);
    }
    if steps.is_empty() {
        return Ok(Neighbourhood::TooLarge);
    }
    Ok(Neighbourhood::Shown(json!({ "steps": steps })))
}

/// The field files of finished steps: position (from 1) and path, by step.
fn files(run: &RunFolder) -> Result<BTreeMap<usize, Vec<(usize, PathBuf)>>, OutputError> {
    let folder = run.path.join(FIELDS_FOLDER);
    let mut files: BTreeMap<usize, Vec<(usize, PathBuf)>> = BTreeMap::new();
    let entries = match std::fs::read_dir(&folder) {
        Err(reason) if reason.kind() == ErrorKind::NotFound => return Ok(files),
        entries => entries.map_err(OutputError::io("read", &folder))?,
    };
    for entry in entries {
        let path = entry.map_err(OutputError::io("read", &folder))?.path();
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        if let Some((step, position)) = step_and_position(&name)
            && step < run.summary.steps_recorded
        {
            files.entry(step).or_default().push((position, path));
        }
    }
    // The order of a folder is that of no one.
    files.values_mut().for_each(|positions| positions.sort());
    Ok(files)
}

fn packed_step(step: usize, files: &[(usize, PathBuf)]) -> Result<Option<Value>, OutputError> {
    let grids: Result<Vec<UnstructuredGrid>, OutputError> =
        files.par_iter().map(|(_, path)| Ok(read_vtu(path)?)).collect();
    let grids = grids?;
    let Some((first, cells)) = grids.first().and_then(|first| Some((first, cells(first)?))) else {
        return Ok(None);
    };
    let mut snapshots = Vec::new();
    for ((position, path), grid) in files.iter().zip(&grids) {
        let damaged = |reason: String| OutputError::damaged(path, reason);
        let array =
            |name: &str| grid.point_array(name).ok_or_else(|| damaged(format!("no point data {name}")));
        let moved = array("displacement_mm")?.to_vectors().map_err(|reason| damaged(reason.to_string()))?;
        let stress = array("stress_mpa")?.to_stresses().map_err(|reason| damaged(reason.to_string()))?;
        if cells.used.iter().any(|&point| point >= moved.len().min(stress.len())) {
            return Err(damaged("another grid than at the first position of its step".to_owned()));
        }
        let von_mises = |point: &usize| {
            let s = stress[*point].deviator();
            (1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2])).sqrt()
        };
        let of = |value: &dyn Fn(&usize) -> f64| {
            let values: Vec<f64> = cells.used.iter().map(value).collect();
            quantised(&values, values.len())
        };
        snapshots.push(json!({
            "position": position,
            "ux": of(&|point| moved[*point].x),
            "uy": of(&|point| moved[*point].y),
            "stress": of(&von_mises),
        }));
    }
    let along = |value: fn(Vec2) -> f64| {
        let values: Vec<f64> = cells.used.iter().map(|&point| value(first.points[point])).collect();
        quantised(&values, values.len())
    };
    Ok(Some(json!({
        "step": step,
        "x": along(|p| p.x),
        "y": along(|p| p.y),
        "corners": packed_levels(&cells.corners, cells.corners.len()),
        "snapshots": snapshots,
    })))
}

/// The triangles and quadrilaterals of `grid`; none where there are none or too many.
fn cells(grid: &UnstructuredGrid) -> Option<Grid> {
    let mut place = vec![u16::MAX; grid.points.len()];
    let mut cells = Grid { used: Vec::new(), corners: Vec::new() };
    for block in &grid.cells {
        let corners: [usize; 4] = match block.shape {
            CellShape::Triangle => [0, 1, 2, 2],
            CellShape::Quad | CellShape::QuadraticQuad => [0, 1, 2, 3],
            _ => continue,
        };
        for cell in block.cells() {
            for corner in corners {
                let point = cell[corner];
                if place[point] == u16::MAX {
                    place[point] = u16::try_from(cells.used.len()).ok().filter(|&place| place < u16::MAX)?;
                    cells.used.push(point);
                }
                cells.corners.push(place[point]);
            }
        }
    }
    let count = cells.corners.len() / 4;
    (1..=CELLS).contains(&count).then_some(cells)
}
