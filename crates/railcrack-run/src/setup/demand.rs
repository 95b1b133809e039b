//! The loading of the cracks by a wheel, and passages that cannot be computed.

use super::carried::CarriedStressError;
use railcrack::body::BodyError;
use railcrack::contact::CrackFrictionError;
use railcrack::growth::{GrowthError, PassageError};
use thiserror::Error;

/// The loading of the fastest tip by one wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WheelDemand {
    /// ΔK_eq, MPa√m.
    pub delta_keq: f64,
    /// da/dN of a passage of this wheel, mm.
    pub rate: f64,
}

/// Passages that cannot be computed.
#[derive(Debug, Error)]
pub enum DemandError {
    /// Cracks in space that cannot be made.
    #[error("the cracks cannot be made")]
    NoFront,
    /// A body in space.
    #[error(transparent)]
    Growth(#[from] GrowthError),
    /// The passage of a wheel over cracks in space.
    #[error("wheel {wheel}: {source}")]
    InSpace {
        /// From 1.
        wheel: usize,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The residual stress.
    #[error(transparent)]
    Stress(#[from] CarriedStressError),
    /// The body.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The passage of a wheel.
    #[error("wheel {wheel}: {source}")]
    Passage {
        /// From 1.
        wheel: usize,
        /// Why.
        source: PassageError,
    },
    /// The faces.
    #[error(transparent)]
    Faces(#[from] CrackFrictionError),
}
