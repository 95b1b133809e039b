//! Semi-analytical engine: continuous distributions of edge dislocations in a half-plane.

mod engine;
mod integrals;
mod interaction;
mod junctions;
mod nodes;
mod row;

pub use engine::{DislocationEngine, DislocationError, cracked_body, face_points};
pub use nodes::FaceResolution;
