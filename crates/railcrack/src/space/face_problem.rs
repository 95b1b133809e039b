//! The quantities on which the contact conditions of faces in space depend.

use super::face_matrix::FaceMatrix;

/// Points in contact, those of whole faces or of one half of symmetric ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaceProblem<'a> {
    /// A (N/mm), 3p × 3p.
    pub stiffness: &'a FaceMatrix,
    /// C = A⁻¹ (mm/N).
    pub compliance: &'a FaceMatrix,
    /// Crack-face friction coefficient μ of each point.
    pub friction: &'a [f64],
}
