//! An unstructured grid with data on its points and cells.

use super::{Array, GridError};
use crate::math::Vec2;

/// The shape of a cell and the order of its nodes: corners counter-clockwise, then the midpoints of
/// the sides, the first between the first and the second corner, then the centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellShape {
    /// 1 node.
    Vertex,
    /// 2 nodes.
    Line,
    /// 3 nodes: the ends, then the middle.
    QuadraticLine,
    /// 3 nodes.
    Triangle,
    /// 4 nodes.
    Quad,
    /// 6 nodes: corners and midpoints of the sides.
    QuadraticTriangle,
    /// 8 nodes: corners and midpoints of the sides.
    QuadraticQuad,
    /// 9 nodes: corners, midpoints of the sides, centre.
    BiquadraticQuad,
    /// A polygon with this number of corners.
    Polygon {
        /// Number of corners, at least 3.
        corners: usize,
    },
}

impl CellShape {
    /// Nodes of one cell.
    pub fn nodes(self) -> usize {
        match self {
            Self::Vertex => 1,
            Self::Line => 2,
            Self::Triangle | Self::QuadraticLine => 3,
            Self::Quad => 4,
            Self::QuadraticTriangle => 6,
            Self::QuadraticQuad => 8,
            Self::BiquadraticQuad => 9,
            Self::Polygon { corners } => corners,
        }
    }
}

/// Consecutive cells of one shape.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellBlock {
    /// Shape of all of them.
    pub shape: CellShape,
    /// `connectivity[cell * shape.nodes() + node]`: index of a point, from 0.
    pub connectivity: Vec<usize>,
}

impl CellBlock {
    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.connectivity.len() / self.shape.nodes().max(1)
    }

    /// The points of each cell.
    pub fn cells(&self) -> impl Iterator<Item = &[usize]> {
        self.connectivity.chunks_exact(self.shape.nodes().max(1))
    }
}

/// A grid with data on its points and cells: of the plane z = 0, or of a surface in space.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct UnstructuredGrid {
    /// Points, mm.
    pub points: Vec<Vec2>,
    /// Third coordinate of each point, mm; empty for the plane z = 0.
    pub z: Vec<f64>,
    /// Cells, block after block.
    pub cells: Vec<CellBlock>,
    /// Data with an entry per point.
    pub point_data: Vec<Array>,
    /// Data with an entry per cell, in the order of the blocks.
    pub cell_data: Vec<Array>,
}

impl UnstructuredGrid {
    /// Number of cells in all blocks.
    pub fn cell_count(&self) -> usize {
        self.cells.iter().map(CellBlock::cell_count).sum()
    }

    /// The point data called `name`.
    pub fn point_array(&self, name: &str) -> Option<&Array> {
        self.point_data.iter().find(|array| array.name == name)
    }

    /// The cell data called `name`.
    pub fn cell_array(&self, name: &str) -> Option<&Array> {
        self.cell_data.iter().find(|array| array.name == name)
    }

    /// Checks that cells and data fit the points.
    ///
    /// Errors: a number of nodes that is not a multiple of the nodes of a cell; a cell that refers
    /// to a missing point; data of the wrong length; two arrays with the same name.
    pub fn check(&self) -> Result<(), GridError> {
        for (i, block) in self.cells.iter().enumerate() {
            let nodes = block.shape.nodes();
            let least = if matches!(block.shape, CellShape::Polygon { .. }) { 3 } else { 1 };
            if nodes < least || !block.connectivity.len().is_multiple_of(nodes) {
                return Err(GridError::PartialCell { block: i, found: block.connectivity.len(), nodes });
            }
            let points = self.points.len();
            if let Some(&point) = block.connectivity.iter().find(|&&point| point >= points) {
                return Err(GridError::NoSuchPoint { block: i, point, points });
            }
        }
        if !self.z.is_empty() && self.z.len() != self.points.len() {
            let (found, entries) = (self.z.len(), self.points.len());
            return Err(GridError::Length { name: "z".to_owned(), found, components: 1, entries });
        }
        for (data, entries) in [(&self.point_data, self.points.len()), (&self.cell_data, self.cell_count())] {
            for (i, array) in data.iter().enumerate() {
                array.check(entries)?;
                if data[..i].iter().any(|other| other.name == array.name) {
                    return Err(GridError::SameName { name: array.name.clone() });
                }
            }
        }
        Ok(())
    }
}
