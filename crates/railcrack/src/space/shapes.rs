//! The body with the cracks of a growing front.

use super::body::SpaceBody;
use super::division::SpaceResolution;
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
    /// Matrices that cannot be computed.
    #[error(transparent)]
    Body(#[from] SpaceError),
}

/// The body with cracks of `shapes` in the half-space of `kernel`. An `interruption` ends the
/// computation.
///
/// Errors: an inadmissible shape; cracks that are too close to each other; a stiffness that is not
/// positive definite; the interruption.
pub fn body_of(
    shapes: &[FrontShape],
    steel: &IsotropicElastic,
    kernel: &SpaceKernel,
    resolution: SpaceResolution,
    interruption: Interruption<'_>,
) -> Result<SpaceBody, ShapesError> {
    Ok(SpaceBody::with_kernel(&cracks(shapes)?, steel, Some(kernel), resolution, interruption)?)
}

/// [`body_of`] without C and S: a body of which only parts are solved for.
///
/// Errors: an inadmissible shape; cracks that are too close to each other; the interruption.
pub(super) fn body_in_parts(
    shapes: &[FrontShape],
    steel: &IsotropicElastic,
    kernel: &SpaceKernel,
    resolution: SpaceResolution,
    interruption: Interruption<'_>,
) -> Result<SpaceBody, ShapesError> {
    Ok(SpaceBody::in_parts(&cracks(shapes)?, steel, Some(kernel), resolution, interruption)?)
}

fn cracks(shapes: &[FrontShape]) -> Result<Vec<SpaceCrack>, ShapeError> {
    shapes.iter().map(FrontShape::crack).collect()
}
