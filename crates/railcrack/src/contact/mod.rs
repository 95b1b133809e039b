//! Unilateral contact with Coulomb friction on the crack faces.

mod law;

pub use law::{FaceState, FaceStatus};
