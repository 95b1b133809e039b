//! Residual stress from a given plastic stress, projected onto the mesh of the rail and balanced
//! there.
//!
//! A plastic stress 𝕂ε_p is not a residual stress: a piece of steel cut out of the rail would
//! change its shape by the plastic strain. The residual stress is the resulting σ = 𝕂(ε − ε_p) in
//! equilibrium; for a plastic strain in a layer along the rail it has the opposite sign.

mod balance;
mod cells;
mod plastic;
mod recover;
mod shape;

pub use balance::{BalancedStress, ProjectionLoss, projection_loss};
pub use cells::PlasticFieldError;
pub use plastic::{PLASTIC_STRESS_ARRAY, PlasticField, RecoveryLoss};

#[cfg(test)]
mod balance_tests;
#[cfg(test)]
mod projection_tests;
