//! Stress intensity factors.

mod sif;

pub use sif::{Sif, SifHistory};
