//! Reasons why a body in space cannot be built.

use super::shape::SpaceCrack;
use crate::interruption::Interrupted;
use crate::linear::LinearError;
use thiserror::Error;

/// Smallest admissible distance of two cracks, relative to their smallest semi-axis: down to this
/// distance the integrals between them are verified, and cells resolve the ligament.
pub(super) const LEAST_DISTANCE: f64 = 0.05;

/// Reasons why a body in space cannot be built.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SpaceError {
    /// The stiffness of the cracks is not positive definite: the cells are too coarse, most likely
    /// for the thin flap above a crack of this dip.
    #[error(
        "the cells of crack {} in space (dip {:.1}°, semi-axes {:.3} mm down the dip and {:.3} mm along the surface) are too \
         coarse, most likely for the flap above it: its stiffness is not positive definite; use more cells (space_cells, \
         space_rings) or a steeper crack", crack + 1, shape.dip.to_degrees(), shape.length, shape.half_length
    )]
    TooCoarse {
        /// The crack, from 0.
        crack: usize,
        /// Its shape.
        shape: Box<SpaceCrack>,
    },
    /// A matrix that cannot be inverted for another reason.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// Interrupted on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
    /// Cracks that meet, or nearly meet.
    #[error(transparent)]
    Close(#[from] CloseCracks),
}

/// Two cracks in space that meet, or nearly meet.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "cracks {} and {} in space are {distance:.3e} mm apart: must be at least {least:.3e} mm, {LEAST_DISTANCE} of the smallest \
     semi-axis of the two", first + 1, second + 1
)]
pub struct CloseCracks {
    /// One of them, from 0.
    pub first: usize,
    /// The other one.
    pub second: usize,
    /// Their distance, mm.
    pub distance: f64,
    /// The smallest admissible distance, mm.
    pub least: f64,
}

impl CloseCracks {
    /// The first two of `cracks` that are too close to each other.
    pub fn among(cracks: &[SpaceCrack]) -> Option<Self> {
        let pairs = (0..cracks.len()).flat_map(|second| (0..second).map(move |first| (first, second)));
        let of = |(first, second): (usize, usize)| {
            let axes = [&cracks[first], &cracks[second]].map(|crack| crack.length.min(crack.half_length));
            let least = LEAST_DISTANCE * axes[0].min(axes[1]);
            let distance = cracks[first].distance(&cracks[second]);
            (distance < least).then_some(Self { first, second, distance, least })
        };
        pairs.into_iter().find_map(of)
    }
}
