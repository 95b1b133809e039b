//! The semi-analytic engine: continuous distributions of edge dislocations in a half-plane.

mod assembly;
mod engine;
mod integrals;
mod kernel;
mod walk;

pub use engine::{DislocationBody, DislocationEngine, DislocationError, face_points};
pub use walk::FaceResolution;
