//! The cracked body as data: two matrices at the face points, made by an engine.

mod blocks;
mod cracked;
mod elements;
mod engine;
mod error;
mod face_mesh;
mod fields;
mod thin_flap;

pub(crate) use blocks::RowPart;
pub use blocks::{BlockStiffness, FarStiffness, TipGain};
pub use cracked::{BodyTimes, CrackedBody, FieldSolver};
pub(crate) use elements::{FaceElement, FacePiece, discretise};
pub use engine::BodyEngine;
pub use error::BodyError;
pub use face_mesh::{FaceMesh, FacePoint, FaceSample};
pub use fields::{BodyFields, Face, FieldGrid, FieldLine, FieldLoad, PointField};
pub(crate) use thin_flap::thin_flaps;
