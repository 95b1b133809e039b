//! The cracked body: two matrices at the face points.

mod cracked;

pub use cracked::{BodyTip, CrackedBody, FaceMesh, FaceSample, MeshPoint};
