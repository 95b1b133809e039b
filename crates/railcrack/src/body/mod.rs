//! The cracked body as data: two matrices at the face points, made by an engine.

mod blocks;
mod cracked;
mod face_mesh;

pub(crate) use blocks::RowPart;
pub use blocks::{BlockStiffness, FarStiffness, TipGain};
pub use cracked::{
    BodyEngine, BodyError, BodyFields, BodyTimes, CrackedBody, Face, FieldGrid, FieldLine, FieldLoad,
    FieldSolver, PointField,
};
pub(crate) use face_mesh::{FaceElement, FacePiece, discretise, thin_flaps};
pub use face_mesh::{FaceMesh, FacePoint, FaceSample};
