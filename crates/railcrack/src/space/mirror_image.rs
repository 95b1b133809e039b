//! Mirror images of the points of a crack about its line of dip.

use super::grid::{Cell, Grid};
use crate::math::Matrix;
use std::cmp::Ordering;
use std::collections::HashMap;

/// Signs of the components of mirrored jumps and forces.
pub(super) const SIGNS: [f64; 3] = [1.0, 1.0, -1.0];
/// Distance of a point from the mirror image of another one, relative to the size of the cracks, up
/// to which it is round-off: the points of a grid are closer together by a factor of 10⁴ at most.
const COINCIDENT: f64 = 1e-9;

/// The mirror image of each of `points` (s, ζ) about the line of dip through the middle; none if
/// one is missing.
pub(super) fn images(points: &[[f64; 2]]) -> Option<Vec<usize>> {
    let size = points.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
    let image = |[s, zeta]: &[f64; 2]| {
        let is_image = |[u, v]: &[f64; 2]| (u - s).abs().max((v + zeta).abs()) <= COINCIDENT * size;
        points.iter().position(is_image)
    };
    points.iter().map(image).collect()
}

/// Cells, and edges on the mouth, that are mirror images of each other: of two products of which
/// one is the mirror image of the other, one is integrated, and the average with the mirror image
/// gives the other.
pub(super) struct MirroredCells {
    vertices: Vec<usize>,
    cells: Vec<usize>,
    edges: Vec<usize>,
}

impl MirroredCells {
    /// Those of a grid; none if it is not its own mirror image.
    pub fn of(grid: &Grid) -> Option<Self> {
        let mirrored = Self::of_cells(&grid.cells, &grid.vertices)?;
        let edge =
            |(cell, _): &(usize, _)| grid.mouth.iter().position(|(other, _)| *other == mirrored.cells[*cell]);
        let edges = grid.mouth.iter().map(edge).collect::<Option<_>>()?;
        Some(Self { edges, ..mirrored })
    }

    /// The cells alone, with the positions (s, ζ) of their vertices.
    pub fn of_cells(cells: &[Cell], vertices: &[[f64; 2]]) -> Option<Self> {
        let vertices = images(vertices)?;
        let sorted = |mut corners: [usize; 4]| {
            corners.sort_unstable();
            corners
        };
        let known: HashMap<_, _> =
            cells.iter().enumerate().map(|(k, cell)| (sorted(cell.vertices), k)).collect();
        let image = |cell: &Cell| known.get(&sorted(cell.vertices.map(|v| vertices[v]))).copied();
        let cells = cells.iter().map(image).collect::<Option<_>>()?;
        Some(Self { vertices, cells, edges: Vec::new() })
    }

    /// How often the product of two cells counts: not at all where that of its mirror image is
    /// taken twice.
    pub fn count(&self, pair: [usize; 2]) -> f64 {
        let mut image = pair.map(|cell| self.cells[cell]);
        image.sort_unstable();
        counted(pair, image)
    }

    /// The same of a cell and an edge on the mouth.
    pub fn count_with_edge(&self, [cell, edge]: [usize; 2]) -> f64 {
        counted([cell, edge], [self.cells[cell], self.edges[edge]])
    }
}

/// Two cracks that are symmetric about one plane along the rail.
pub(super) struct MirroredPair([MirroredCells; 2]);

impl MirroredPair {
    /// Those with these grids, whose lines of dip lie in that plane; none if a grid is not its own
    /// mirror image.
    pub fn of([one, other]: [&Grid; 2]) -> Option<Self> {
        Some(Self([MirroredCells::of(one)?, MirroredCells::of(other)?]))
    }

    /// How often the product of a cell of each counts ([`MirroredCells::count`]).
    pub fn count(&self, pair: [usize; 2]) -> f64 {
        let Self([one, other]) = self;
        counted(pair, [one.cells[pair[0]], other.cells[pair[1]]])
    }

    /// The stiffness between the points of the two, averaged with its mirror image.
    pub fn averaged(&self, stiffness: &Matrix) -> Matrix {
        let Self([rows, columns]) = self;
        Matrix::from_fn(stiffness.rows(), stiffness.columns(), |i, j| {
            let (c, d) = (i % 3, j % 3);
            let mirrored = stiffness[(3 * rows.vertices[i / 3] + c, 3 * columns.vertices[j / 3] + d)];
            0.5 * (stiffness[(i, j)] + SIGNS[c] * SIGNS[d] * mirrored)
        })
    }
}

fn counted(pair: [usize; 2], image: [usize; 2]) -> f64 {
    match image.cmp(&pair) {
        Ordering::Less => 0.0,
        Ordering::Equal => 1.0,
        Ordering::Greater => 2.0,
    }
}
