//! Grid of cells on a folded crack, in the plane into which it unfolds.
//!
//! The branch has the grid of a surface crack whose mouth is the fold. Its columns at the fold
//! continue through the strip, whose rows are parallel to the mouth, so that vertices on the fold
//! belong to both planes.

use super::super::division::{CellDivision, SpaceResolution};
use super::super::grid::{Cell, FrontColumn, Grid};
use super::super::patch::Patch;
use super::super::shape::ShapeError;
use super::shape::FoldedCrack;

/// Numbers of cells of a folded crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FoldedResolution {
    /// Rows of the strip between mouth and fold, at least 3.
    pub strip: usize,
    /// Cells of the branch, as of a crack that breaks the surface.
    pub branch: SpaceResolution,
}

impl FoldedResolution {
    /// A strip with half as many rows again as the block of the branch.
    #[must_use]
    pub fn below(branch: SpaceResolution) -> Self {
        Self { strip: (3 * branch.block).div_ceil(2).max(LEAST_ROWS), branch }
    }

    /// Points of the faces besides those of a planar crack like the branch, and of its front.
    #[must_use]
    pub fn points_of_strip(&self) -> [usize; 2] {
        let SpaceResolution { block, ring, .. } = self.branch;
        let rows = self.strip.max(LEAST_ROWS);
        [rows * (2 * (block + ring) - 1), 2 * rows]
    }
}

impl Default for FoldedResolution {
    fn default() -> Self {
        Self::below(SpaceResolution::default())
    }
}

/// The least number of rows of the strip: hats on the mouth and on the fold do not touch.
const LEAST_ROWS: usize = 3;

/// The part of the crack to which a cell or a free vertex belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// On the mouth.
    Mouth,
    /// The strip between mouth and fold.
    Strip,
    /// On the fold.
    Fold,
    /// The branch below the fold.
    Branch,
}

impl Part {
    /// Its plane: 0 for the strip with mouth and fold, 1 for the branch.
    pub fn plane(self) -> usize {
        usize::from(self == Self::Branch)
    }
}

/// A point of the front and the plane in which it lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct FoldedFront {
    pub column: FrontColumn,
    pub part: Part,
}

/// The cells of a folded crack. Positions are (s, ζ), s from the mouth over the fold.
#[derive(Debug, Clone)]
pub(super) struct FoldedGrid {
    pub cells: Vec<Cell>,
    /// Strip or branch, by cell.
    pub part_of_cell: Vec<Part>,
    /// Positions of the vertices, mm: those of mouth and strip, of fold and branch, of the front.
    pub vertices: Vec<[f64; 2]>,
    /// The part of each free vertex.
    pub part_of_vertex: Vec<Part>,
    pub free: usize,
    /// The front, from the mouth down one side, along the branch and up the other side, in the
    /// order of the vertices on it.
    pub front: Vec<FoldedFront>,
    /// The strip with vertices of mouth and strip free and those of the fold held.
    pub strip: Grid,
}

/// Distances of the rows of the strip from the mouth, relative to the fold.
fn row(r: usize, rows: usize) -> f64 {
    r as f64 / rows as f64
}

/// The vertices of the mouth of the branch `lower`, which lie on the fold, from ζ = c to −c; the
/// first and the last are on the front.
fn vertices_on_fold(lower: &Grid) -> Vec<usize> {
    let mut line: Vec<usize> = Vec::new();
    for (cell, corners) in &lower.mouth {
        line.extend(corners.map(|corner| lower.cells[*cell].vertices[corner]));
    }
    line.sort_by(|&a, &b| lower.vertices[b][1].total_cmp(&lower.vertices[a][1]));
    line.dedup();
    line
}

/// The cells of a strip of the length `fold` (mm) in `rows` above the fold of the branch `lower`,
/// with those on the mouth and the corners of their edges there. `vertex` numbers the vertices by
/// row and column.
fn cells_of_strip(
    lower: &Grid,
    line: &[usize],
    fold: f64,
    rows: usize,
    vertex: &dyn Fn(usize, usize) -> usize,
) -> (Vec<Cell>, Vec<(usize, [usize; 2])>) {
    let (mut cells, mut mouth) = (Vec::new(), Vec::new());
    for (at, [from, to]) in &lower.mouth {
        let cell = &lower.cells[*at];
        let place = |corner: usize| line.iter().position(|&v| v == cell.vertices[corner]);
        let (Some(start), Some(end)) = (place(*from), place(*to)) else { continue };
        let edge = if start < end { Patch::along(*from, *to) } else { Patch::along(*to, *from) };
        let first = start.min(end);
        for r in 0..rows {
            let [near, far] = [r, r + 1].map(|r| fold * row(r, rows));
            let corners = [(r, first), (r, first + 1), (r + 1, first + 1), (r + 1, first)];
            if r == 0 {
                mouth.push((cells.len(), [0, 1]));
            }
            cells.push(Cell::new(corners.map(|(r, c)| vertex(r, c)), |p, q| {
                let [u, v] = edge.at([p, 0.0]);
                [near + q * (far - near), cell.at(u, v).position[1]]
            }));
        }
    }
    (cells, mouth)
}

impl FoldedGrid {
    /// The cells of `crack`.
    ///
    /// Errors: a branch of an inadmissible shape.
    pub fn new(crack: &FoldedCrack, resolution: FoldedResolution) -> Result<Self, ShapeError> {
        let rows = resolution.strip.max(LEAST_ROWS);
        let lower = Grid::new(&crack.branch_shape()?, &CellDivision::even(resolution.branch, false));

        let line = vertices_on_fold(&lower);
        let (columns, inside) = (line.len() - 1, line.len() - 2);
        let above = rows * inside;
        let free = above + lower.free;
        let count = free + lower.front.len() + 2 * rows;
        let below = |v: usize| if v < lower.free { above + v } else { free + rows + v - lower.free };
        let vertex = |r: usize, c: usize| match c {
            c if r == rows => below(line[c]),
            0 => free + r,
            c if c == columns => count - 1 - r,
            c => r * inside + c - 1,
        };

        let (strip_cells, mouth) = cells_of_strip(&lower, &line, crack.fold, rows, &vertex);
        let on_branch = |[s, zeta]: [f64; 2]| [crack.fold + s, zeta];
        let in_branch =
            |cell: &Cell| Cell::new(cell.vertices.map(below), |u, v| on_branch(cell.at(u, v).position));
        let cells: Vec<Cell> = strip_cells.iter().cloned().chain(lower.cells.iter().map(in_branch)).collect();
        let part_of_cell =
            [vec![Part::Strip; strip_cells.len()], vec![Part::Branch; lower.cells.len()]].concat();

        let mut vertices = vec![[0.0; 2]; count];
        for (v, &position) in lower.vertices.iter().enumerate() {
            vertices[below(v)] = on_branch(position);
        }
        for (r, c) in (0..rows).flat_map(|r| (0..=columns).map(move |c| (r, c))) {
            vertices[vertex(r, c)] = [crack.fold * row(r, rows), lower.vertices[line[c]][1]];
        }
        let part = |v: usize| match v {
            v if v < inside => Part::Mouth,
            v if v < above => Part::Strip,
            v if line.contains(&(v - above)) => Part::Fold,
            _ => Part::Branch,
        };
        let on_strip = |end: FrontColumn, r: usize, columns: [usize; 2]| FoldedFront {
            column: FrontColumn { vertices: columns.map(|c| vertex(r, c)), ..end },
            part: Part::Strip,
        };
        let of_branch = |column: &FrontColumn| FoldedFront {
            column: FrontColumn { vertices: column.vertices.map(below), ..*column },
            part: Part::Branch,
        };
        let mut front: Vec<FoldedFront> = lower.front.iter().map(of_branch).collect();
        if let &[first, .., last] = &lower.front[..] {
            front.splice(..0, (0..rows).map(|r| on_strip(first, r, [1, 2])));
            front.extend((0..rows).rev().map(|r| on_strip(last, r, [columns - 1, columns - 2])));
        }
        let strip = Grid {
            cells: strip_cells,
            mouth,
            vertices: vertices.clone(),
            free: above,
            front: Vec::new(),
            is_graded: false,
        };
        let part_of_vertex = (0..free).map(part).collect();
        Ok(Self { cells, part_of_cell, vertices, part_of_vertex, free, front, strip })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn cells_cover_both_planes() {
        let crack = FoldedCrack {
            mouth_dip: 0.4,
            branch_dip: 1.2,
            fold: 4.0,
            half_length: 6.0,
            branch: 3.0,
            middle: [0.0; 2],
            deviation: None,
        };
        let resolution = FoldedResolution { strip: 4, branch: SpaceResolution::new(2, 3) };
        let grid = FoldedGrid::new(&crack, resolution).unwrap();
        let rule = crate::math::gauss_legendre(6);
        let mut areas = [0.0; 2];
        for (cell, part) in grid.cells.iter().zip(&grid.part_of_cell) {
            for (u, wu) in &rule {
                let area: f64 = rule.iter().map(|(v, wv)| wu * wv * cell.at(*u, *v).area).sum();
                areas[part.plane()] += area;
            }
        }
        assert!((areas[0] / 48.0 - 1.0).abs() < 1e-10, "{areas:?}");
        assert!((areas[1] / (0.5 * PI * 18.0) - 1.0).abs() < 1e-5, "{areas:?}");
        // Corners of cells are where the vertices are.
        for cell in &grid.cells {
            for (v, [p, q]) in cell.vertices.iter().zip(super::super::super::grid::CORNERS) {
                let [s, zeta] = cell.at(p, q).position;
                let want = grid.vertices[*v];
                assert!((s - want[0]).hypot(zeta - want[1]) < 1e-9, "{v}: {s} {zeta} {want:?}");
            }
        }
        let count = |part: Part| grid.part_of_vertex.iter().filter(|p| **p == part).count();
        assert_eq!((count(Part::Mouth), count(Part::Strip), count(Part::Fold)), (9, 27, 9));
        assert_eq!(grid.front.len(), 9 + 8);
        for (k, front) in grid.front.iter().enumerate() {
            let [s, zeta] = grid.vertices[grid.free + k];
            let x = (s - 4.0).max(0.0) / 3.0;
            assert!((x.hypot(zeta / 6.0) - 1.0).abs() < 1e-9, "{k}: {s} {zeta}");
            assert_eq!(front.part == Part::Strip, s < 4.0 - 1e-9);
            let inner = grid.vertices[front.column.vertices[0]];
            let away = (s - inner[0]) * front.column.normal[0] + (zeta - inner[1]) * front.column.normal[1];
            assert!(away > 0.0, "{k}");
        }
    }
}
