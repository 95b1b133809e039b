//! What the tests of contact begin with.

use crate::body::{CrackedBody, FaceMesh, FacePoint};
use crate::crack::CrackTip;
use crate::math::{Matrix, Vec2};

/// One face point with the compliance (mm per N/mm) c of its shear and its pressure and what is between them.
pub(super) struct OnePoint {
    faces: FaceMesh,
    compliance: Matrix,
    stiffness: Matrix,
    none: Matrix,
}

impl OnePoint {
    pub(super) fn new(own: f64, between: f64) -> Self {
        let along = Vec2 { x: 1.0, y: 0.0 };
        let point = FacePoint { crack: 0, segment: 0, s: 0.0, position: along, tangent: along, weight: 1.0 };
        let symmetric = |own, between| Matrix::from_fn(2, 2, |i, j| if i == j { own } else { between });
        let determinant = own * own - between * between;
        Self {
            faces: FaceMesh { points: vec![point], samples: Vec::new() },
            compliance: symmetric(own, between),
            stiffness: symmetric(own / determinant, -between / determinant),
            none: Matrix::zeros(0, 2),
        }
    }
}

impl CrackedBody for OnePoint {
    fn faces(&self) -> &FaceMesh {
        &self.faces
    }
    fn tips(&self) -> &[CrackTip] {
        &[]
    }
    fn compliance(&self) -> &Matrix {
        &self.compliance
    }
    fn stiffness(&self) -> &Matrix {
        &self.stiffness
    }
    fn sif_influence(&self) -> &Matrix {
        &self.none
    }
    fn dofs(&self) -> usize {
        0
    }
}
