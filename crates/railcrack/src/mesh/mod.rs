//! The background mesh of the finite-element engine: graded rectangles that do not know the cracks.

mod ordering;
mod quad;
mod shape;

pub use quad::{Element, MeshError, QuadMesh};
pub use shape::Edge;
pub(crate) use shape::{CORNERS, NODES, shape_functions};
