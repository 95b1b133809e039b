//! The cracked body as two matrices at the face points.

use super::{BlockStiffness, BodyError, BodyFields, FaceMesh, FieldLoad};
use crate::crack::CrackTip;
use crate::field::RailEnds;
use crate::fracture::Sif;
use crate::math::{Matrix, Stress, Vec2};
use serde::{Deserialize, Serialize};
use std::fmt::Debug;
use std::sync::Arc;

/// Wall time of the phases in which a body is made, seconds; 0 for phases that an engine does not
/// have or does not report.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct BodyTimes {
    /// The mesh without cracks and its factor, if they have to be made.
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
/// With f the nodal forces on the + faces (N/mm, their negatives on the − faces), index 2 j along
/// x1 and 2 j + 1 along x2 of face point j: ⟦w⟧ = C f (slip and opening, mm) and K = S f.
///
/// The body is independent of the load; quantities that depend on the wheel come from `ends` and
/// `fields`.
#[derive(Debug, Clone)]
pub struct CrackedBody {
    /// The face points.
    pub faces: FaceMesh,
    /// The tips, in order of crack and tip.
    pub tips: Vec<CrackTip>,
    /// C, 2p × 2p, mm per N/mm; symmetric positive definite.
    pub compliance: Matrix,
    /// A = C⁻¹, 2p × 2p, N/mm per mm.
    pub stiffness: Matrix,
    /// S, 2q × 2p, mm^(−1/2): rows 2 t and 2 t + 1 are K_I and K_II of tip t.
    pub sif_influence: Matrix,
    /// A in blocks, if the engine provides it in this form for many cracks; `compliance`,
    /// `stiffness` and `sif_influence` are then empty.
    pub blocks: Option<Arc<BlockStiffness>>,
    /// Number of displacement unknowns condensed into C.
    pub dofs: usize,
    /// The ends of its uncracked rail; none for a half-plane.
    pub ends: Option<Arc<dyn RailEnds>>,
    /// The field inside the body; none where the engine computes the faces only.
    pub fields: Option<Arc<dyn FieldSolver>>,
    /// Wall time of making the body.
    pub times: BodyTimes,
    /// Remarks of the engine: sentences for the reader of the results.
    pub remarks: Vec<String>,
}

impl CrackedBody {
    /// The body of the matrices C (`compliance`), A = C⁻¹ (`stiffness`) and S (`sif_influence`) in
    /// a half-plane, without a field inside.
    pub fn new(
        faces: FaceMesh,
        tips: Vec<CrackTip>,
        [compliance, stiffness, sif_influence]: [Matrix; 3],
    ) -> Self {
        Self {
            dofs: compliance.rows(),
            faces,
            tips,
            compliance,
            stiffness,
            sif_influence,
            blocks: None,
            ends: None,
            fields: None,
            times: BodyTimes::default(),
            remarks: Vec::new(),
        }
    }

    /// The body in a half-plane with A in `blocks`.
    pub(crate) fn by_groups(faces: FaceMesh, tips: Vec<CrackTip>, blocks: BlockStiffness) -> Self {
        let none = || Matrix::zeros(0, 0);
        let dofs = 2 * faces.points.len();
        Self { blocks: Some(Arc::new(blocks)), dofs, ..Self::new(faces, tips, [none(), none(), none()]) }
    }
}

impl CrackedBody {
    /// K of each tip (MPa √mm) under a `stress` (MPa) of the uncracked rail with free faces.
    /// Contact of the faces would carry part of the load; K_I < 0 means that they are closed.
    #[must_use]
    pub fn sifs_of_free_faces(&self, stress: impl Fn(Vec2) -> Stress) -> Vec<Sif> {
        let k = self.sif_influence.times(&self.faces.nodal_forces(stress));
        k.chunks_exact(2).map(|k| Sif { ki: k[0], kii: k[1] }).collect()
    }
}

/// The field inside a cracked body.
pub trait FieldSolver: Debug + Send + Sync {
    /// The field around the cracks under each of `loads`. The field added by the ends of the rail
    /// is included; the half-plane field of the wheel and the residual stress are not.
    ///
    /// Errors: the engine cannot compute them.
    fn fields(&self, loads: &[FieldLoad]) -> Result<BodyFields, BodyError>;
}
