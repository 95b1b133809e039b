//! The cracked body: two matrices at the face points.

use super::{BlockStiffness, BodyError, BodyFields, FaceMesh, FieldLoad};
use crate::crack::CrackTip;
use crate::field::RailEnds;
use crate::fracture::Sif;
use crate::math::{Matrix, Stress, Vec2};
use serde::{Deserialize, Serialize};
use std::fmt::Debug;
use std::sync::Arc;

/// Wall time of the phases in which a body is made, seconds; 0 for what an engine does not do or
/// does not tell.
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
/// With f the nodal forces on the + faces (N/mm, their negatives on the − faces), index 2 j along
/// x1 and 2 j + 1 along x2 of face point j: ⟦w⟧ = C f (slip and opening, mm) and K = S f.
///
/// The body knows no load: what depends on the wheel is asked of `ends` and `fields`.
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
    /// A by groups of neighbours, where an engine gives it so for many cracks; `compliance`,
    /// `stiffness` and `sif_influence` are empty then.
    pub blocks: Option<Arc<BlockStiffness>>,
    /// Number of displacement unknowns behind C.
    pub dofs: usize,
    /// The ends of its uncracked rail; none for a half-plane.
    pub ends: Option<Arc<dyn RailEnds>>,
    /// The field behind the face points; none where the engine knows the faces only.
    pub fields: Option<Arc<dyn FieldSolver>>,
    /// How long its making took.
    pub times: BodyTimes,
    /// Remarks made while computing it: sentences for the reader of the results.
    pub remarks: Vec<String>,
}

impl CrackedBody {
    /// The body of the matrices C (`compliance`), A = C⁻¹ (`stiffness`) and S (`sif_influence`) in
    /// a half-plane, known at its faces only.
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

    /// The body of A by groups of neighbours (`blocks`) in a half-plane.
    pub(crate) fn by_groups(faces: FaceMesh, tips: Vec<CrackTip>, blocks: BlockStiffness) -> Self {
        let none = || Matrix::zeros(0, 0);
        let dofs = 2 * faces.points.len();
        Self { blocks: Some(Arc::new(blocks)), dofs, ..Self::new(faces, tips, [none(), none(), none()]) }
    }
}

impl CrackedBody {
    /// K of each tip (MPa √mm) under a `stress` (MPa) of the uncracked rail with the faces free:
    /// closed faces would bear a part, and K_I < 0 means that they are closed.
    #[must_use]
    pub fn sifs_of_free_faces(&self, stress: impl Fn(Vec2) -> Stress) -> Vec<Sif> {
        let k = self.sif_influence.times(&self.faces.nodal_forces(stress));
        k.chunks_exact(2).map(|k| Sif { ki: k[0], kii: k[1] }).collect()
    }
}

/// The field of a cracked body behind its face points.
pub trait FieldSolver: Debug + Send + Sync {
    /// The fields under each of `loads` around the cracks, what the ends of the rail add included,
    /// those of the half-plane under the wheel and of residual stress not.
    ///
    /// Errors: the engine cannot compute them.
    fn fields(&self, loads: &[FieldLoad]) -> Result<BodyFields, BodyError>;
}
