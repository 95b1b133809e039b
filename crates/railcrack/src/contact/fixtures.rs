//! Fixtures of contact tests.

use crate::body::{CrackedBody, FaceMesh, FacePoint};
use crate::math::{Matrix, Vec2};

/// One face point with the compliance (mm per N/mm) `own` in shear and in pressure, and `between`
/// for the coupling of the two.
pub(super) fn one_point(own: f64, between: f64) -> CrackedBody {
    let along = Vec2 { x: 1.0, y: 0.0 };
    let point = FacePoint { crack: 0, segment: 0, s: 0.0, position: along, tangent: along, weight: 1.0 };
    let symmetric = |own, between| Matrix::from_fn(2, 2, |i, j| if i == j { own } else { between });
    let determinant = own * own - between * between;
    let stiffness = symmetric(own / determinant, -between / determinant);
    let faces = FaceMesh { points: vec![point], ..FaceMesh::default() };
    CrackedBody::new(faces, Vec::new(), [symmetric(own, between), stiffness, Matrix::zeros(0, 2)])
}
