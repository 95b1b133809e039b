//! Size of a run: unknowns and memory.

use super::case::Case;
use super::engines::{self, FaceSize};
use crate::tables::{Engine, PlasticSource};
use railcrack::growth::NetworkContact;
use railcrack::residual::PlasticField;

/// Size of the face problem of a case at its first step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RunSize {
    /// Points of the crack faces, p.
    pub face_points: usize,
    /// Tips, q.
    pub tips: usize,
    /// Displacement unknowns behind the face points; none in the dislocation engine.
    pub displacements: usize,
    /// Unknowns of the contact problem: two per face point, three in space.
    pub unknowns: usize,
    /// Estimate of the memory needed, bytes.
    pub memory_bytes: usize,
}

/// Dense matrices of the size of C alive at once: C itself, its kernel before inversion, the
/// factors, and the working copy of the contact solver.
const MATRICES: usize = 4;

/// Numbers by unknown of contact in groups: A of near cracks, A and C of the group around each of
/// them, and the histories of its jumps.
const COLUMNS: usize = 3000;

/// Squares of the unknowns of one crack that the group around it needs in space besides A of all
/// cracks: four matrices of three cracks.
const OF_GROUPS: usize = 36;

/// Memory that every case needs, bytes.
const BASE: usize = 20 << 20;

impl Case {
    pub(super) fn given_plastic(&self) -> Option<PlasticField> {
        match &self.plastic_stress {
            Some(PlasticSource::Rolled) | None => None,
            Some(_) => self.plastic_field(None).ok().flatten(),
        }
    }

    /// The size of the run.
    #[must_use]
    pub fn size(&self) -> RunSize {
        let engine = engines::of(self.engine);
        let tips = engine.tips(self);
        let FaceSize { face_points, displacements, factor } = engine.face_size(self);
        let unknowns = engine.unknowns_per_point() * face_points;
        let number = size_of::<f64>();
        let columns = match self.network {
            NetworkContact::Whole => MATRICES * unknowns,
            NetworkContact::Groups if self.engine == Engine::Space => {
                (unknowns + OF_GROUPS * unknowns / self.cracks.cracks().len().max(1)).min(MATRICES * unknowns)
            }
            NetworkContact::Groups => unknowns.min(COLUMNS),
        };
        let matrices = columns * unknowns + 2 * tips * unknowns;
        // Face record of one passage: four numbers and a status per position and point.
        let records = self.positions().len() * (5 * face_points + 2 * tips);
        let memory_bytes = BASE + number * (matrices + records + 2 * factor);
        RunSize { face_points, tips, displacements, unknowns, memory_bytes }
    }
}
