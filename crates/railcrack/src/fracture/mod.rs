//! Stress intensity factors and the fields around a tip.

mod sif;
mod williams;

pub use sif::{Sif, SifHistory};
pub(crate) use williams::WilliamsField;
