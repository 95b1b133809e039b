//! Meshes: the background mesh of the finite-element engine (graded rectangles, independent of the
//! cracks), and unstructured grids with data for exchange with other programs.

mod ordering;
mod quad;
mod unstructured;

pub(crate) use quad::{CORNERS, NODES, shape_functions};
pub use quad::{Edge, Element, MeshError, QuadMesh};
pub use unstructured::{Array, CellBlock, CellShape, GridError, SYMMETRIC_TENSOR, UnstructuredGrid};
