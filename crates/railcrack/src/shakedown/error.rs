//! Errors of the stabilised plastic state.

use crate::interruption::Interrupted;
use crate::math::OutOfRange;
use thiserror::Error;

/// Errors of the stabilised plastic state.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ShakedownError {
    /// A pressure outside the range of the model.
    #[error("p0/k = {ratio}: must be positive and at most {most}; k is the yield stress over sqrt(3)")]
    Load {
        /// p0/k.
        ratio: f64,
        /// The largest accepted value.
        most: f64,
    },
    /// An invalid contact.
    #[error("{quantity} = {value}: must be {accepted}")]
    Contact {
        /// The quantity.
        quantity: &'static str,
        /// The given value.
        value: f64,
        /// The accepted values.
        accepted: &'static str,
    },
    /// An initial residual stress that the steel cannot carry.
    #[error(
        "initial residual stress: {utilisation} of the yield stress at depth {depth} mm; must be at most 1, otherwise the rail yields without a wheel"
    )]
    Initial {
        /// √(3/2) |s| / σ_y.
        utilisation: f64,
        /// mm.
        depth: f64,
    },
    /// A plastic zone that becomes deeper with every enlargement of the grid.
    #[error(
        "the plastic zone reaches below {depth} mm: the initial residual stress and the wheel make the whole rail yield"
    )]
    Bottomless {
        /// mm.
        depth: f64,
    },
    /// A passage whose plastic strain did not converge.
    #[error(
        "passage {pass} not converged: after {iterations} redistributions the plastic strain still changes by {change:.2e} of the yield strain, the tolerance is {tolerance:.1e}"
    )]
    NotConverged {
        /// Number of the passage, from 1.
        pass: usize,
        /// Number of elastic redistributions.
        iterations: usize,
        /// The last change of the plastic strain, times 2 G over the radius of the yield surface.
        change: f64,
        /// The tolerance of this change.
        tolerance: f64,
    },
    /// Interrupted on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
}

impl From<OutOfRange> for ShakedownError {
    fn from(OutOfRange { quantity, value, accepted }: OutOfRange) -> Self {
        Self::Contact { quantity, value, accepted }
    }
}
