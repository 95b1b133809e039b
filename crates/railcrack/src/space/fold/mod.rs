//! Cracks in space with a straight fold parallel to the mouth.

mod assembly;
mod body;
mod grid;
mod kernel;
mod shape;

pub use body::FoldedBodyError;
pub use grid::FoldedResolution;
pub use shape::{FoldError, FoldedCrack};
