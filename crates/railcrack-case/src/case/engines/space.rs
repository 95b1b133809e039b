//! Planar cracks in the half-space.

use super::case_engine::{CaseEngine, FaceSize, FinestGrid};
use crate::case::case::Case;
use crate::case::space_case::{MOST_SPACE_POINTS, SpaceCase};
use crate::tables::SPACE_CELLS;
use railcrack::body::BodyEngine;
use railcrack::space::SpaceResolution;
use railcrack::xfem::XfemEngine;

pub(super) struct Space;

fn of(case: &Case, points: fn(&SpaceCase, SpaceResolution) -> usize) -> usize {
    case.space.as_ref().map_or(0, |space| points(space, case.mesh.space))
}

impl CaseEngine for Space {
    fn tips(&self, case: &Case) -> usize {
        of(case, SpaceCase::front_points)
    }

    fn face_size(&self, case: &Case) -> FaceSize {
        FaceSize { face_points: of(case, SpaceCase::face_points), ..FaceSize::default() }
    }

    fn unknowns_per_point(&self) -> usize {
        3
    }

    fn wanted_face_points(&self, case: &Case) -> f64 {
        of(case, SpaceCase::face_points) as f64
    }

    fn finest_grid(&self, _: &Case) -> FinestGrid {
        FinestGrid {
            most_points: MOST_SPACE_POINTS as f64,
            key: SPACE_CELLS.key.name,
            says: |points, most| {
                format!("with space_rings, {points} face points; the limit in space is {most}")
            },
            help: "reduce space_cells, space_rings or the number of cracks",
        }
    }

    /// The growth loop in space builds no plane body.
    fn body_engine(&self, _: &Case, _: XfemEngine) -> Option<Box<dyn BodyEngine + Send>> {
        None
    }
}
