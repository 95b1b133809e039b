//! Distributed dislocations in a half-plane.

use super::case_engine::{CaseEngine, FaceSize, FinestGrid};
use crate::case::case::Case;
use crate::tables::INTERFACE_ELEMENTS;
use railcrack::body::BodyEngine;
use railcrack::dislocation::{DislocationEngine, face_points};
use railcrack::xfem::XfemEngine;

pub(super) struct Dislocations;

impl CaseEngine for Dislocations {
    fn face_size(&self, case: &Case) -> FaceSize {
        let face_points = face_points(&case.cracks, case.face_resolution());
        FaceSize { face_points, ..FaceSize::default() }
    }

    fn wanted_face_points(&self, case: &Case) -> f64 {
        face_points(&case.cracks, case.face_resolution()) as f64
    }

    fn finest_grid(&self, _: &Case) -> FinestGrid {
        let help = "a smaller [mesh] interface_elements or cracks further apart ([[crack]] spacing_mm) reduce their number";
        FinestGrid::in_the_plane(INTERFACE_ELEMENTS, help)
    }

    fn body_engine(&self, case: &Case, _: XfemEngine) -> Option<Box<dyn BodyEngine + Send>> {
        Some(Box::new(DislocationEngine { steel: case.steel, resolution: case.face_resolution() }))
    }
}
