//! Isotropic elasticity.

mod elastic;

pub use elastic::{IsotropicElastic, MaterialError};
