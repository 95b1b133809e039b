//! Size of a run: unknowns and memory.

use super::case::Case;
use super::space_case::SpaceCase;
use crate::tables::{Engine, PlasticSource};
use railcrack::dislocation;
use railcrack::plane::NetworkContact;
use railcrack::residual::PlasticField;
use railcrack::space::SpaceResolution;

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
        let in_space = |points: fn(&SpaceCase, SpaceResolution) -> usize| {
            self.space.as_ref().map_or(0, |space| points(space, self.mesh.space))
        };
        let tips = match self.engine {
            Engine::Space => in_space(SpaceCase::front_points),
            _ => self.cracks.tips().len(),
        };
        let (face_points, displacements, factor) = match self.engine {
            Engine::Space => (in_space(SpaceCase::face_points), 0, 0),
            Engine::Dislocation => (dislocation::face_points(&self.cracks, self.face_resolution()), 0, 0),
            // Errors of a plastic stress are reported by its reader; that of rolling is not there
            // yet.
            Engine::Xfem => {
                let engine = self.finite_elements(self.given_plastic().as_ref());
                let size = match self.network {
                    NetworkContact::Whole => engine.size(&self.cracks),
                    NetworkContact::Groups => engine.size_by_groups(&self.cracks),
                };
                match size {
                    Ok(size) => {
                        (size.face_points, size.mesh_unknowns + size.enriched_unknowns, size.factor_entries)
                    }
                    Err(_) => (0, 0, 0),
                }
            }
        };
        let unknowns = if self.engine == Engine::Space { 3 * face_points } else { 2 * face_points };
        let number = size_of::<f64>();
        let columns = match self.network {
            NetworkContact::Whole => MATRICES * unknowns,
            NetworkContact::Groups => unknowns.min(COLUMNS),
        };
        let matrices = columns * unknowns + 2 * tips * unknowns;
        // Face record of one passage: four numbers and a status per position and point.
        let records = self.positions().len() * (5 * face_points + 2 * tips);
        let memory_bytes = BASE + number * (matrices + records + 2 * factor);
        RunSize { face_points, tips, displacements, unknowns, memory_bytes }
    }
}
