//! Isotropic elasticity and kinematic hardening.

mod elastic;
mod hardening;

pub use elastic::{IsotropicElastic, MaterialError};
pub use hardening::{HardeningError, KinematicHardening};
