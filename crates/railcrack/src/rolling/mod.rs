//! Rolling contact with creepage and spin: Kalker's coefficients, linear theory, FASTSIM, FaStrip.

mod forces;
mod kalker;
mod patch;
mod slip;
mod stick;
mod strip;
#[cfg(test)]
mod tests;

pub use forces::PatchForces;
pub use kalker::{Creepage, CreepageSign, KalkerCoefficients, RollingTheory};
pub use patch::{PatchError, PlacedPatch, RollingPatch, StripOutline};
pub use strip::{RollingStrip, StripPoint};
