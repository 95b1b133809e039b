//! The engines as a case uses them, a file for each.

mod case_engine;
mod choice;
mod dislocation;
mod space;
mod xfem;

pub(super) use case_engine::FaceSize;
pub(super) use choice::of;
