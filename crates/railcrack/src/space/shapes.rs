//! The body with the cracks of a growing front.

use super::body::SpaceBody;
use super::division::SpaceResolution;
use super::fold::{FoldedBodyError, FoldedResolution};
use super::shape::{ShapeError, SpaceCrack, SpaceError};
use super::stiffness::SpaceKernel;
use crate::growth::FrontShape;
use crate::interruption::Interruption;
use crate::material::IsotropicElastic;
use thiserror::Error;

/// Reasons why the body with cracks of some shapes cannot be built.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ShapesError {
    /// An inadmissible shape.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// An inadmissible folded crack.
    #[error(transparent)]
    Fold(#[from] super::fold::FoldError),
    /// A folded crack that is not the only one.
    #[error("a folded crack in space must be the only crack; there are {cracks}")]
    NotAlone {
        /// The number of cracks.
        cracks: usize,
    },
    /// Matrices that cannot be computed.
    #[error(transparent)]
    Body(#[from] SpaceError),
}

impl From<FoldedBodyError> for ShapesError {
    fn from(error: FoldedBodyError) -> Self {
        match error {
            FoldedBodyError::Fold(error) => error.into(),
            FoldedBodyError::Branch(error) => error.into(),
            FoldedBodyError::Body(error) => error.into(),
        }
    }
}

/// The body with cracks of `shapes` in the half-space of `kernel`; a folded crack has half as many
/// rows of cells again between mouth and fold as its branch has in the block of `resolution`. An
/// `interruption` ends the computation.
///
/// Errors: an inadmissible shape; a folded crack among others; cracks that are too close to each
/// other; a stiffness that is not positive definite; the interruption.
pub fn body_of(
    shapes: &[FrontShape],
    steel: &IsotropicElastic,
    kernel: &SpaceKernel,
    resolution: SpaceResolution,
    interruption: Interruption<'_>,
) -> Result<SpaceBody, ShapesError> {
    if let [only] = shapes
        && let Some(folded) = only.folded()
    {
        let resolution = FoldedResolution::below(resolution);
        return Ok(folded.body(steel, kernel, resolution, interruption)?);
    }
    Ok(SpaceBody::with_kernel(&planar(shapes)?, steel, Some(kernel), resolution, interruption)?)
}

/// [`body_of`] without C and S: a body of which only parts are solved for.
///
/// Errors: an inadmissible shape; a folded crack; cracks that are too close to each other; the
/// interruption.
pub(super) fn body_in_parts(
    shapes: &[FrontShape],
    steel: &IsotropicElastic,
    kernel: &SpaceKernel,
    resolution: SpaceResolution,
    interruption: Interruption<'_>,
) -> Result<SpaceBody, ShapesError> {
    Ok(SpaceBody::in_parts(&planar(shapes)?, steel, Some(kernel), resolution, interruption)?)
}

/// The cracks of `shapes`, none of which may be folded.
fn planar(shapes: &[FrontShape]) -> Result<Vec<SpaceCrack>, ShapesError> {
    if shapes.iter().any(|shape| shape.strip.is_some()) {
        return Err(ShapesError::NotAlone { cracks: shapes.len() });
    }
    Ok(shapes.iter().map(FrontShape::crack).collect::<Result<_, _>>()?)
}
