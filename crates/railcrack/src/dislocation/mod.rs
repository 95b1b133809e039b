//! Semi-analytical engine: continuous distributions of edge dislocations in a half-plane.

mod assembly;
mod engine;
mod far;
mod integrals;
mod junctions;
mod kernel;
mod nodes;
mod row;
mod units;

pub use engine::{DislocationEngine, DislocationError, cracked_body, face_points};
pub use nodes::FaceResolution;
