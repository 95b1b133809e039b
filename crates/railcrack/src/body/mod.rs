//! The cracked body: two matrices at the face points.

mod cracked;
mod engine;
mod faces;
mod fields;

pub use cracked::{BodyTimes, CrackedBody, FaceMesh, FacePoint, FaceSample, RailEnds};
pub use engine::{BodyEngine, BodyError};
pub use faces::{FaceElement, FacePiece, discretise};
pub use fields::{BodyFields, Face, FieldGrid, FieldLine, FieldLoad, PointField};
