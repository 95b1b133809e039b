//! Interface of an engine to the case that uses it.

use crate::case::case::Case;
use crate::schema::KeyRow;
use railcrack::body::BodyEngine;
use railcrack::xfem::XfemEngine;

/// An engine as a case uses it.
pub(in crate::case) trait CaseEngine {
    /// The tips of the cracks, or the points of their fronts.
    fn tips(&self, case: &Case) -> usize {
        case.cracks.tips().len()
    }

    /// The size of the faces at the first step.
    fn face_size(&self, case: &Case) -> FaceSize;

    /// Unknowns of the contact at a face point.
    fn unknowns_per_point(&self) -> usize {
        2
    }

    /// The face points that the case requires, before anything is computed: those of the first
    /// step, or an upper estimate.
    fn wanted_face_points(&self, case: &Case) -> f64;

    /// The keys responsible for too many face points in this case.
    fn finest_grid(&self, case: &Case) -> FinestGrid;

    /// The engine of a run; `finite_elements` is that of the rail, plastic stress and all. None
    /// where the run has no body.
    fn body_engine(&self, case: &Case, finite_elements: XfemEngine) -> Option<Box<dyn BodyEngine + Send>>;
}

/// Size of the faces of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(in crate::case) struct FaceSize {
    pub face_points: usize,
    /// Displacement unknowns behind them.
    pub displacements: usize,
    /// Number of entries of a factor.
    pub factor: usize,
}

/// Maximum number of face points, the key of `[mesh]` that controls them, and a remedy.
pub(in crate::case) struct FinestGrid {
    pub most_points: f64,
    pub key: &'static str,
    /// The number of points and its limit, as worded in an error.
    pub says: fn(f64, f64) -> String,
    pub help: &'static str,
}

impl FinestGrid {
    /// In the plane, with `row` of `[mesh]`.
    pub fn in_the_plane<T>(row: KeyRow<T>, help: &'static str) -> Self {
        let says = |points, most| format!("{points:.2e} face points; the limit is {most:e}");
        Self { most_points: MOST_FACE_POINTS, key: row.key.name, says, help }
    }
}

/// Maximum number of points of the crack faces in the plane: four dense matrices with two unknowns
/// at each have 51 GB.
pub(in crate::case) const MOST_FACE_POINTS: f64 = 2e4;
