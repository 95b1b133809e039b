//! The deformed neighbourhood of the cracks: the fields of the first and the last step with fields.

use super::pack::{Deflated, Quantised};
use crate::svg::ends;
use railcrack::growth::StepRecord;
use railcrack::math::Vec2;
use railcrack::mesh::{CellShape, UnstructuredGrid};
use railcrack_run::OutputError;
use railcrack_run::{FieldFile, field_files, field_grids};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Maximum number of cells of a grid in the page, of about eight bytes each, plus half as many for
/// each wheel position.
const CELLS: usize = 20_000;
/// Highest level of a value in a cell: it is drawn.
const LEVELS: u16 = 255;
/// Maximum number of wheel positions of a step.
const POSITIONS: usize = 5;

/// Cells by their corners, and the points that are one.
struct Grid {
    /// Indices of the points that the page has, in the file.
    used: Vec<usize>,
    /// Corners in `used`, four for each cell; the third of a triangle twice.
    corners: Vec<u16>,
}

/// The fields of a step.
#[derive(Debug, Clone)]
pub(crate) struct PackedFields {
    step: usize,
    /// Wheel positions that have a file, from 1.
    positions: Vec<usize>,
    /// Cells and their values at the first positions; none if there are too many cells for a page.
    cells: Option<Value>,
    /// Ends of the cells along x and y, mm.
    extent: [[f64; 2]; 2],
}

/// The fields of the first and the last step that have any.
#[derive(Debug, Clone, Default)]
pub(crate) struct FieldData {
    /// One or two, or none where the run has no fields.
    ends: Vec<PackedFields>,
}

impl FieldData {
    /// The fields of a record; none where it has none.
    ///
    /// Errors: they are not of one grid.
    pub(crate) fn of_record(record: &StepRecord) -> Result<Option<PackedFields>, OutputError> {
        let grids = field_grids(record).map(|(position, file, grid)| Ok((position, file.into(), grid)));
        let packed = |fields: &railcrack::growth::FieldRecord| {
            let positions = fields.snapshots.iter().map(|snapshot| snapshot.position + 1).collect();
            packed_fields(record.step, positions, grids)
        };
        record.fields.as_ref().map(packed).transpose()
    }

    /// Those in the folder of a run with `steps` finished steps.
    ///
    /// Errors: a file is damaged; the system refuses.
    pub(crate) fn read(folder: &Path, steps: usize) -> Result<Self, OutputError> {
        let mut files: BTreeMap<usize, Vec<FieldFile>> = BTreeMap::new();
        for file in field_files(folder, steps)? {
            files.entry(file.step).or_default().push(file);
        }
        let ends = [files.pop_first(), files.pop_last()];
        let mut shown = Self::default();
        for (step, files) in ends.into_iter().flatten() {
            let positions = files.iter().map(|file| file.position).collect();
            let grids = files.into_iter().map(|file| {
                let grid = file.read()?;
                Ok((file.position, file.path, grid))
            });
            shown.push(packed_fields(step, positions, grids)?);
        }
        Ok(shown)
    }

    /// Adds the fields of a step after the last one.
    pub(crate) fn push(&mut self, fields: PackedFields) {
        self.ends.truncate(1);
        self.ends.push(fields);
    }

    /// Whether the run has none.
    pub(crate) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Steps and wheel positions (from 1) of the files.
    pub(crate) fn files(&self) -> impl Iterator<Item = (usize, usize)> {
        self.ends.iter().flat_map(|end| end.positions.iter().map(|&position| (end.step, position)))
    }

    /// Ends of the cells that the page has along x and y, mm.
    pub(crate) fn extent(&self) -> Option<[[f64; 2]; 2]> {
        let extents = self.ends.iter().filter(|end| end.cells.is_some()).map(|end| end.extent);
        let both = |one: [f64; 2], other: [f64; 2]| [one[0].min(other[0]), one[1].max(other[1])];
        extents.reduce(|one, other| [both(one[0], other[0]), both(one[1], other[1])])
    }

    /// Data for the page; none if nothing can be shown.
    pub(crate) fn data(&self) -> Option<Value> {
        let steps: Vec<&Value> = self.ends.iter().filter_map(|end| end.cells.as_ref()).collect();
        (!steps.is_empty()).then(|| json!({ "steps": steps }))
    }
}

/// The fields of a step with files at wheel `positions` (from 1); `grids` are position, file and
/// what it holds.
///
/// Errors: those of `grids`; another grid than at the first position, or no fields on it.
fn packed_fields(
    step: usize,
    positions: Vec<usize>,
    grids: impl Iterator<Item = Result<(usize, PathBuf, UnstructuredGrid), OutputError>>,
) -> Result<PackedFields, OutputError> {
    let mut first: Option<(Grid, [Quantised; 2])> = None;
    let mut extent = [[0.0; 2]; 2];
    let mut snapshots = Vec::new();
    for grid in grids.take(POSITIONS) {
        let (position, path, grid) = grid?;
        let (cells, _) = match &mut first {
            Some(first) => first,
            None => {
                let Some(cells) = cells(&grid) else {
                    return Ok(PackedFields { step, positions, cells: None, extent });
                };
                let along = |value: fn(Vec2) -> f64| packed(&cells, |point| value(grid.points[point]));
                let places = [along(|p| p.x), along(|p| p.y)];
                let used = || cells.used.iter().map(|&point| grid.points[point]);
                extent = [ends(used().map(|p| p.x)), ends(used().map(|p| p.y))];
                first.insert((cells, places))
            }
        };
        let damaged = |reason: String| OutputError::damaged(&path, reason);
        let array =
            |name: &str| grid.point_array(name).ok_or_else(|| damaged(format!("no point data {name}")));
        let moved = array("displacement_mm")?.to_vectors().map_err(|reason| damaged(reason.to_string()))?;
        let stress = array("stress_mpa")?.to_stresses().map_err(|reason| damaged(reason.to_string()))?;
        if cells.used.iter().any(|&point| point >= moved.len().min(stress.len())) {
            return Err(damaged("another grid than at the first position of its step".to_owned()));
        }
        let von_mises = |point: usize| {
            let s = stress[point].deviator();
            (1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2])).sqrt()
        };
        snapshots.push(json!({
            "position": position,
            "ux": packed(cells, |point| moved[point].x),
            "uy": packed(cells, |point| moved[point].y),
            "stress": packed(cells, von_mises),
        }));
    }
    let cells = first.map(|(cells, [x, y])| {
        json!({
            "step": step,
            "x": x,
            "y": y,
            "corners": Deflated::levels(&cells.corners, cells.corners.len()),
            "snapshots": snapshots,
        })
    });
    Ok(PackedFields { step, positions, cells, extent })
}

/// A value of every point that the page has.
fn packed(cells: &Grid, value: impl Fn(usize) -> f64) -> Quantised {
    let values: Vec<f64> = cells.used.iter().map(|&point| value(point)).collect();
    Quantised::rounded(LEVELS, 1, &values, values.len())
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
