//! Rolling contact with creepage and spin: Kalker's coefficients, linear theory, FASTSIM, FaStrip.

mod bound;
mod creepage;
mod fastrip;
mod fastsim;
mod forces;
mod kalker;
mod outline;
mod patch;
mod placed;
mod strip;
#[cfg(test)]
mod tests;
mod theory;

pub use creepage::{Creepage, CreepageSign};
pub use forces::PatchForces;
pub use kalker::KalkerCoefficients;
pub use outline::StripOutline;
pub use patch::{PatchError, RollingPatch};
pub use placed::PlacedPatch;
pub use strip::{RollingStrip, StripPoint};
pub use theory::RollingTheory;
