//! The semi-analytical engine: continuous distributions of edge dislocations in a half-plane.

mod assembly;
mod engine;
mod integrals;
mod junctions;
mod kernel;
mod nodes;

pub use engine::{DislocationBody, DislocationEngine, DislocationError, face_points};
pub use nodes::FaceResolution;
