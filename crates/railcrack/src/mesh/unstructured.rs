//! An unstructured grid with data on its points and cells, and why one is refused.

use crate::math::{Stress, Vec2};
use thiserror::Error;

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

/// Components of a symmetric tensor in the order of VTK.
pub const SYMMETRIC_TENSOR: [&str; 6] = ["XX", "YY", "ZZ", "XY", "YZ", "XZ"];

/// Named data with an entry per point or per cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// The name, with the unit: `stress_mpa`.
    pub name: String,
    /// Components of one entry, at least 1.
    pub components: usize,
    /// `values[entry * components + component]`.
    pub values: Vec<f64>,
}

impl Array {
    /// An array with one number per point or cell.
    pub fn scalars(name: &str, values: Vec<f64>) -> Self {
        Self { name: name.to_owned(), components: 1, values }
    }

    /// Plane vectors stored with 3 components, the third of which is 0.
    pub fn vectors(name: &str, vectors: &[Vec2]) -> Self {
        let values = vectors.iter().flat_map(|v| [v.x, v.y, 0.0]).collect();
        Self { name: name.to_owned(), components: 3, values }
    }

    /// Symmetric tensors stored with the 6 components XX, YY, ZZ, XY, YZ, XZ of VTK, the last two
    /// 0.
    pub fn stresses(name: &str, stresses: &[Stress]) -> Self {
        let values = stresses.iter().flat_map(|s| [s.xx, s.yy, s.zz, s.xy, 0.0, 0.0]).collect();
        Self { name: name.to_owned(), components: SYMMETRIC_TENSOR.len(), values }
    }

    /// The entries, each of `components` values.
    pub fn entries(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks_exact(self.components.max(1))
    }

    /// The entries as plane vectors; a third component is ignored.
    ///
    /// Errors: a number of components other than 2 or 3; a value that is not finite.
    pub fn to_vectors(&self) -> Result<Vec<Vec2>, GridError> {
        if !matches!(self.components, 2 | 3) {
            return Err(self.other_components("2 or 3"));
        }
        self.finite()?;
        Ok(self.entries().map(|v| Vec2::new(v[0], v[1])).collect())
    }

    /// The entries as plane-strain tensors: 4 components XX, YY, ZZ, XY, or the 6 of VTK, of which
    /// the out-of-plane shears are ignored.
    ///
    /// Errors: a number of components other than 4 or 6; a value that is not finite.
    pub fn to_stresses(&self) -> Result<Vec<Stress>, GridError> {
        if !matches!(self.components, 4 | 6) {
            return Err(self.other_components("4 or 6"));
        }
        self.finite()?;
        Ok(self.entries().map(|s| Stress { xx: s[0], yy: s[1], zz: s[2], xy: s[3] }).collect())
    }

    /// Checks that every value is finite.
    ///
    /// Errors: the first value that is not finite.
    pub fn finite(&self) -> Result<(), GridError> {
        match self.values.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(i) => Err(GridError::NotFinite {
                name: self.name.clone(),
                entry: i / self.components.max(1),
                value: self.values[i],
            }),
        }
    }

    pub(super) fn check(&self, entries: usize) -> Result<(), GridError> {
        let fits = self.components.checked_mul(entries) == Some(self.values.len());
        if self.components == 0 || !fits {
            return Err(GridError::Length {
                name: self.name.clone(),
                found: self.values.len(),
                components: self.components,
                entries,
            });
        }
        Ok(())
    }

    fn other_components(&self, accepted: &'static str) -> GridError {
        GridError::Components { name: self.name.clone(), found: self.components, accepted }
    }
}

/// Inconsistencies of an unstructured grid.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GridError {
    /// A number of nodes that is not a multiple of the nodes of one cell.
    #[error(
        "block {block} of the cells has {found} nodes, which is not a multiple of the {nodes} nodes of a cell"
    )]
    PartialCell {
        /// Block, from 0.
        block: usize,
        /// Its number of nodes.
        found: usize,
        /// Number of nodes of one cell.
        nodes: usize,
    },
    /// A cell that refers to a point outside the list of points.
    #[error(
        "block {block} of the cells refers to point {point}, but the {points} points are numbered from 0"
    )]
    NoSuchPoint {
        /// Block, from 0.
        block: usize,
        /// The point that it refers to.
        point: usize,
        /// Number of points.
        points: usize,
    },
    /// Data whose length does not fit the points or cells.
    #[error("`{name}` has {found} values, not {components} for each of {entries} points or cells")]
    Length {
        /// The data.
        name: String,
        /// Its number of values.
        found: usize,
        /// Its number of components.
        components: usize,
        /// Number of points or cells.
        entries: usize,
    },
    /// Data with an unsuitable number of components.
    #[error("`{name}` has {found} components: must be {accepted}")]
    Components {
        /// The data.
        name: String,
        /// Its number of components.
        found: usize,
        /// The accepted numbers of components.
        accepted: &'static str,
    },
    /// Two arrays with the same name.
    #[error("`{name}` occurs twice")]
    SameName {
        /// The name.
        name: String,
    },
    /// A value that is not a finite number.
    #[error("`{name}` is {value} at entry {entry} (from 0): must be a finite number")]
    NotFinite {
        /// The data, or `points`.
        name: String,
        /// Point or cell, from 0.
        entry: usize,
        /// The value.
        value: f64,
    },
}
