//! The cracked body as two matrices at the face points, the fields inside it, and the engines that
//! compute it.

use super::{BlockStiffness, FaceMesh};
use crate::crack::{CrackNetwork, CrackTip};
use crate::field::{CrackLine, RailEnds, Wheel};
use crate::fracture::Sif;
use crate::interruption::{Interrupted, Interruption};
use crate::math::{Matrix, Stress, Vec2};
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::fmt::Debug;
use std::sync::Arc;
use thiserror::Error;

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

    /// The body whose cracks have these `widths`: half their extent along the surface over their
    /// length, infinite where none is given. K of all loads is that of the deepest point of such a
    /// front; how loads along the front count is in the lines of the faces.
    #[must_use]
    pub fn with_widths(mut self, widths: &[f64]) -> Self {
        if widths.iter().all(|width| width.is_infinite()) {
            return self;
        }
        let with_width = |(crack, line): (usize, &CrackLine)| CrackLine {
            width: widths.get(crack).copied().unwrap_or(f64::INFINITY),
            ..line.clone()
        };
        self.faces.lines = self.faces.lines.iter().enumerate().map(with_width).collect();
        let factors: Vec<f64> =
            self.tips.iter().map(|tip| self.faces.lines[tip.crack].width_factor()).collect();
        for (row, factor) in factors.iter().flat_map(|factor| [factor; 2]).enumerate() {
            if row < self.sif_influence.rows() {
                self.sif_influence.row_mut(row).iter_mut().for_each(|entry| *entry *= factor);
            }
        }
        self.blocks = self.blocks.map(|blocks| Arc::new(blocks.as_ref().clone().with_sif_factors(&factors)));
        self
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

/// A method of computing cracked bodies.
pub trait BodyEngine {
    /// The body with `network` of cracks.
    ///
    /// Errors: cracks that the engine cannot represent.
    fn body(&mut self, network: &CrackNetwork) -> Result<CrackedBody, BodyError> {
        self.body_unless(Interruption::NEVER, network)
    }

    /// The body with `network` of cracks, given up within a second of an `interruption`. An engine
    /// may reuse results of earlier calls, provided that the body has the same bits without them.
    ///
    /// Errors: cracks that the engine cannot represent; an interruption
    /// ([`BodyError::is_interruption`]).
    fn body_unless(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<CrackedBody, BodyError>;

    /// The body with A in blocks, for networks whose full matrices are too large; none where the
    /// engine does not support such bodies.
    ///
    /// Errors: as [`BodyEngine::body_unless`].
    fn body_by_groups(
        &mut self,
        _interruption: Interruption<'_>,
        _network: &CrackNetwork,
    ) -> Result<Option<CrackedBody>, BodyError> {
        Ok(None)
    }

    /// Frees the memory that the engine keeps for its next call, once the last body has been made.
    fn forget(&mut self) {}
    /// The smallest distance (mm) between a tip and the surface or another crack that is still
    /// resolved.
    fn resolution(&self, network: &CrackNetwork) -> f64;
}

/// Cracks that an engine cannot represent, with the engine's reason.
#[derive(Debug, Error)]
#[error("{reason}")]
pub struct BodyError {
    /// The engine's own error.
    #[source]
    pub reason: Box<dyn Error + Send + Sync>,
}

impl BodyError {
    /// Whether the body was given up on request.
    #[must_use]
    pub fn is_interruption(&self) -> bool {
        let mut next: Option<&(dyn Error + 'static)> = Some(self.reason.as_ref());
        while let Some(error) = next {
            if error.is::<Interrupted>() {
                return true;
            }
            next = error.source();
        }
        false
    }
}

/// Cells around the cracks. No cell crosses a crack: cells on the two sides of a crack have
/// separate points at the same positions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FieldGrid {
    /// Points, mm.
    pub points: Vec<Vec2>,
    /// Where the stress of each point is evaluated, mm: at the point itself, or slightly inside the
    /// cell where the stress at the point is infinite.
    pub inside: Vec<Vec2>,
    /// Quadratic rectangles: corners counter-clockwise, then the midpoints of the sides, the first
    /// between the first two corners.
    pub quads: Vec<[usize; 8]>,
    /// Triangles, counter-clockwise.
    pub triangles: Vec<[usize; 3]>,
    /// Pieces of the crack faces, each on one side.
    pub lines: Vec<FieldLine>,
}

/// A straight piece of a crack face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldLine {
    /// The face that it belongs to.
    pub face: Face,
    /// Points at its ends, along the curve.
    pub ends: [usize; 2],
    /// For each end, face points of the body and their weights in the traction at that end.
    pub tractions: [[(usize, f64); 2]; 2],
}

/// A face of a crack; x2 points from − to +.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// The face on the x2 side.
    Plus,
    /// The face on the opposite side.
    Minus,
}

/// The load for which the field of a body is computed.
#[derive(Clone, Copy)]
pub struct FieldLoad<'a> {
    /// Nodal forces on the + faces, N/mm, 2p.
    pub forces: &'a [f64],
    /// The wheel whose field the ends of the rail cancel, and its position x_c (mm).
    pub wheel: Option<(&'a dyn Wheel, f64)>,
}

/// A field at the points of a [`FieldGrid`].
#[derive(Debug, Clone, PartialEq)]
pub struct PointField {
    /// Displacement at each point, mm.
    pub displacement: Vec<Vec2>,
    /// Stress at each point, MPa.
    pub stress: Vec<Stress>,
}

/// The fields of a body under several loads.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyFields {
    /// The points and cells on which they are given.
    pub grid: FieldGrid,
    /// One field per load.
    pub loads: Vec<PointField>,
}
