//! Face points, and the quadrature between them.

use crate::math::{Stress, Vec2};

/// A face point: where the contact conditions hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacePoint {
    /// Index of its crack in the network, from 0.
    pub crack: usize,
    /// Index of the straight segment of the crack, from 0.
    pub segment: usize,
    /// Arc length from the crack's first point, mm.
    pub s: f64,
    /// Position, mm.
    pub position: Vec2,
    /// x1, along the curve; x2 is x1 turned by +90°.
    pub tangent: Vec2,
    /// Length of face that belongs to the point, mm: nodal force / weight = traction.
    pub weight: f64,
}

/// A quadrature point of the faces, for the nodal forces of a stress field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceSample {
    /// Position, mm.
    pub point: Vec2,
    /// x2 of the face at this point; the traction is σ·x2.
    pub normal: Vec2,
    /// Face points that share the traction, each with its share (mm of face length); 0 for a point
    /// without a share.
    pub shares: [(usize, f64); 2],
}

/// The face points and the quadrature between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FaceMesh {
    /// The face points, crack by crack along the curve.
    pub points: Vec<FacePoint>,
    /// The quadrature points.
    pub samples: Vec<FaceSample>,
    /// Quadrature points for tractions that vary over lengths comparable to the depth: the same
    /// shape functions, integrated over parts that are no longer than their depth. Empty in a body
    /// made by groups.
    pub graded: Vec<FaceSample>,
}

impl FaceMesh {
    /// Nodal forces on the + faces, N/mm, that remove a transmitted stress σ: ∫ φ_j σ·x2 ds in the
    /// frame of point j, `[2 j]` along x1, `[2 j + 1]` along x2. `stress` gives σ (MPa) at a point
    /// (mm).
    #[must_use]
    pub fn nodal_forces(&self, stress: impl Fn(Vec2) -> Stress) -> Vec<f64> {
        self.nodal_forces_of_samples(|_, point| stress(point))
    }

    /// [`FaceMesh::nodal_forces`] of a stress that is known by the index of the sample, from 0.
    #[must_use]
    pub fn nodal_forces_of_samples(&self, stress: impl Fn(usize, Vec2) -> Stress) -> Vec<f64> {
        self.nodal_forces_on(&self.samples, stress)
    }

    /// [`FaceMesh::nodal_forces`] of a stress that varies over lengths comparable to the depth.
    pub(crate) fn graded_nodal_forces(&self, stress: impl Fn(Vec2) -> Stress) -> Vec<f64> {
        self.nodal_forces_on(&self.graded, |_, point| stress(point))
    }

    fn nodal_forces_on(&self, samples: &[FaceSample], stress: impl Fn(usize, Vec2) -> Stress) -> Vec<f64> {
        // Summed in x and y first, because a point has one frame for all of its shares.
        let mut forces = vec![0.0; 2 * self.points.len()];
        for (k, sample) in samples.iter().enumerate() {
            let traction = stress(k, sample.point).traction(sample.normal);
            for (point, length) in sample.shares {
                forces[2 * point] += length * traction.x;
                forces[2 * point + 1] += length * traction.y;
            }
        }
        for (force, point) in forces.as_chunks_mut::<2>().0.iter_mut().zip(&self.points) {
            let sum = Vec2::new(force[0], force[1]);
            *force = [sum.dot(point.tangent), sum.dot(point.tangent.left())];
        }
        forces
    }
}
