//! Plastic stress from elsewhere: taken from its mesh to that of the rail and balanced there.
//!
//! A plastic stress 𝕂ε_p is not a residual stress: cut out of the rail, a piece with it would
//! change its shape. What the rail makes of it, σ = 𝕂(ε − ε_p) in equilibrium, is the residual
//! stress, of opposite sign for a layer along the rail.

mod balance;
mod cells;
mod error;
mod plastic;
mod recover;
mod shape;

pub use balance::{BalancedStress, ProjectionLoss, RailPart, projection_loss};
pub use error::PlasticFieldError;
pub use plastic::{PLASTIC_STRESS_ARRAY, PlasticField, RecoveryLoss};

#[cfg(test)]
mod balance_tests;
#[cfg(test)]
mod projection_tests;
