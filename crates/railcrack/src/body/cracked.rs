//! The trait that both engines implement.

use super::{BodyError, BodyFields, FieldLoad};
use crate::crack::CrackTip;
use crate::math::{Matrix, Stress, Vec2};
use serde::{Deserialize, Serialize};

/// A face point: where the law of the faces holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacePoint {
    /// Index of its crack in the network, from 0.
    pub crack: usize,
    /// Index of the straight segment of the crack, from 0.
    pub segment: usize,
    /// Arc length from the crack's first point, mm.
    pub s: f64,
    /// Where, mm.
    pub position: Vec2,
    /// x1, along the walk; x2 is x1 turned by +90°.
    pub tangent: Vec2,
    /// Length of face that the point stands for: nodal force / weight = traction, mm.
    pub weight: f64,
}

/// A quadrature point of the faces, for the nodal forces of a stress field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceSample {
    /// Where, mm.
    pub point: Vec2,
    /// x2 of the face there: the traction taken over is σ·x2.
    pub normal: Vec2,
    /// Face points that share the traction, with the length (mm) each takes of it; a point without share has 0.
    pub shares: [(usize, f64); 2],
}

/// The face points and the quadrature between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FaceMesh {
    /// The face points, crack by crack along the walk.
    pub points: Vec<FacePoint>,
    /// The quadrature points.
    pub samples: Vec<FaceSample>,
}

impl FaceMesh {
    /// Nodal forces on the + faces, N/mm, of removing a transmitted stress σ: ∫ φ_j σ·x2 ds in the frame of point j,
    /// `[2 j]` along x1, `[2 j + 1]` along x2. `stress` gives σ (MPa) at a point (mm).
    pub fn nodal_forces(&self, stress: impl Fn(Vec2) -> Stress) -> Vec<f64> {
        self.nodal_forces_of_samples(|_, point| stress(point))
    }

    /// [`FaceMesh::nodal_forces`] of a stress that is known by the index of the sample, from 0.
    pub fn nodal_forces_of_samples(&self, stress: impl Fn(usize, Vec2) -> Stress) -> Vec<f64> {
        let mut forces = vec![0.0; 2 * self.points.len()];
        for (k, sample) in self.samples.iter().enumerate() {
            let traction = stress(k, sample.point).traction(sample.normal);
            for (point, length) in sample.shares {
                let tangent = self.points[point].tangent;
                forces[2 * point] += length * traction.dot(tangent);
                forces[2 * point + 1] += length * traction.dot(tangent.left());
            }
        }
        forces
    }
}

/// What the ends of a rail add to the stress of the half-plane under the wheel.
pub trait RailEnds: Sync {
    /// The stresses (MPa) at the samples of the faces, in order, for the wheel at `xc` (mm); beyond the positions that the rail was made
    /// for, those of the last one.
    fn stresses(&self, xc: f64) -> Vec<Stress>;
}

/// Wall time of the phases in which a body is made, seconds; 0 for what an engine does not do or does not tell.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct BodyTimes {
    /// The mesh without cracks and its factor, where they are not there yet.
    pub mesh_s: f64,
    /// Cutting elements, choosing functions and face points.
    pub enrichment_s: f64,
    /// Stiffness of the enriched functions.
    pub border_s: f64,
    /// K as functionals of the displacements.
    pub sif_s: f64,
    /// Elimination of the unknowns behind the faces.
    pub condensation_s: f64,
}

/// A cracked elastic body loaded on its crack faces only, reduced to its face points.
///
/// With f the nodal forces on the + faces (N/mm, their negatives on the − faces), index 2 j along x1 and 2 j + 1 along
/// x2 of face point j: ⟦w⟧ = C f (slip and opening, mm) and K = S f.
pub trait CrackedBody: Sync {
    /// The face points.
    fn faces(&self) -> &FaceMesh;
    /// The tips, in order of crack and tip.
    fn tips(&self) -> &[CrackTip];
    /// C, 2p × 2p, mm per N/mm; symmetric positive definite.
    fn compliance(&self) -> &Matrix;
    /// A = C⁻¹, 2p × 2p, N/mm per mm.
    fn stiffness(&self) -> &Matrix;
    /// S, 2q × 2p, mm^(−1/2): rows 2 t and 2 t + 1 are K_I and K_II of tip t.
    fn sif_influence(&self) -> &Matrix;
    /// Number of displacement unknowns behind C.
    fn dofs(&self) -> usize;
    /// The ends of the rail; none for a half-plane.
    fn ends(&self) -> Option<&dyn RailEnds> {
        None
    }
    /// The fields of the body under each of `loads` around its cracks, what the ends of the rail do included, the half-plane under
    /// the wheel and residual stress not; none where the engine knows the faces only.
    ///
    /// Errors: the engine cannot compute them.
    fn fields(&self, _loads: &[FieldLoad]) -> Result<Option<BodyFields>, BodyError> {
        Ok(None)
    }
    /// How long its making took.
    fn times(&self) -> BodyTimes {
        BodyTimes::default()
    }
    /// What the user must know about how the body was computed.
    fn remarks(&self) -> &[String] {
        &[]
    }
}
