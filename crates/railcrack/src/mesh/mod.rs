//! The background mesh of the finite-element engine: graded rectangles, independent of the cracks.

mod ordering;
mod quad;
mod shape;

pub use quad::{Element, MeshError, QuadMesh};
pub use shape::{CORNERS, Edge, NODES, shape_functions};
