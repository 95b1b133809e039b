//! Meshes: the background mesh of the finite-element engine (graded rectangles, independent of the
//! cracks), and unstructured grids with data for exchange with other programs.

mod array;
mod grid_error;
mod ordering;
mod quad;
mod shape;
mod unstructured;

pub use array::{Array, SYMMETRIC_TENSOR};
pub use grid_error::GridError;
pub use quad::{Element, MeshError, QuadMesh};
pub use shape::Edge;
pub(crate) use shape::{CORNERS, NODES, shape_functions};
pub use unstructured::{CellBlock, CellShape, UnstructuredGrid};
