//! Size of a run: unknowns and memory.

use super::engine::finite_elements;
use railcrack::dislocation::face_points;
use railcrack::growth::NetworkContact;
use railcrack::xfem::XfemSize;
use railcrack_case::{Case, Geometry, PlaneCase, PlaneEngine};

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

/// The face problem of an engine at the first step.
#[derive(Default)]
struct Faces {
    points: usize,
    /// The tips of the cracks, or the points of their fronts.
    tips: usize,
    unknowns_per_point: usize,
    /// Displacement unknowns behind the faces.
    displacements: usize,
    /// Number of entries of a factor.
    factor: usize,
}

impl Faces {
    fn of_case(case: &Case) -> Self {
        let in_the_plane = Self { tips: case.cracks.tips().len(), unknowns_per_point: 2, ..Self::default() };
        match &case.geometry {
            Geometry::Plane(plane) if plane.engine == PlaneEngine::Dislocation => Self {
                points: face_points(&case.cracks, plane.face_resolution(&case.cracks)),
                ..in_the_plane
            },
            Geometry::Plane(plane) => {
                let size = finite_element_size(case, plane);
                Self {
                    points: size.face_points,
                    displacements: size.mesh_unknowns + size.enriched_unknowns,
                    factor: size.factor_entries,
                    ..in_the_plane
                }
            }
            Geometry::Space(space) => Self {
                points: space.face_points(),
                tips: space.front_points(),
                unknowns_per_point: 3,
                ..Self::default()
            },
        }
    }
}

/// Size of the finite elements; zero where their mesh cannot be made, which the run reports.
fn finite_element_size(case: &Case, plane: &PlaneCase) -> XfemSize {
    // Errors of a plastic stress are reported by its reader; that of rolling is not yet available.
    let plastic = plane.plastic_stress.as_ref().and_then(|source| source.given_field().ok().flatten());
    let engine = finite_elements(case, plane, plastic.as_ref());
    // Displacements and memory of the largest mesh that the growth is expected to need.
    let size = match case.outgrows_first_mesh() {
        true => engine.largest_size(&case.cracks),
        false => engine.size(&case.cracks),
    };
    size.unwrap_or_default()
}

impl RunSize {
    /// The size of the run of `case`.
    #[must_use]
    pub fn estimate(case: &Case) -> Self {
        let Faces { points: face_points, tips, unknowns_per_point, displacements, factor } =
            Faces::of_case(case);
        let unknowns = unknowns_per_point * face_points;
        let number = size_of::<f64>();
        let columns = match case.network {
            NetworkContact::Whole => MATRICES * unknowns,
            NetworkContact::Groups if case.space().is_some() => {
                (unknowns + OF_GROUPS * unknowns / case.cracks.cracks().len().max(1)).min(MATRICES * unknowns)
            }
            NetworkContact::Groups => unknowns.min(COLUMNS),
        };
        let matrices = columns * unknowns + 2 * tips * unknowns;
        // Face record of one passage: four numbers and a status per position and point.
        let records = case.positions(case.first_wheel()).len() * (5 * face_points + 2 * tips);
        let memory_bytes = BASE + number * (matrices + records + 2 * factor);
        Self { face_points, tips, displacements, unknowns, memory_bytes }
    }
}
