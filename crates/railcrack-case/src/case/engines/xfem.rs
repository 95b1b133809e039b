//! Extended finite elements.

use super::case_engine::{CaseEngine, FaceSize, FinestGrid};
use crate::case::case::Case;
use crate::tables::{ELEMENT_SIZE, INTERFACE_SPACING};
use railcrack::body::BodyEngine;
use railcrack::crack::Crack;
use railcrack::xfem::XfemEngine;

pub(super) struct Xfem;

impl CaseEngine for Xfem {
    fn face_size(&self, case: &Case) -> FaceSize {
        // Errors of a plastic stress are reported by its reader; that of rolling is not yet
        // available.
        let engine = case.finite_elements(case.given_plastic().as_ref());
        // Displacements and memory of the largest mesh that the growth is expected to need.
        let size = match case.outgrows_first_mesh() {
            true => engine.largest_size(&case.cracks),
            false => engine.size(&case.cracks),
        };
        size.map_or(FaceSize::default(), |size| FaceSize {
            face_points: size.face_points,
            displacements: size.mesh_unknowns + size.enriched_unknowns,
            factor: size.factor_entries,
        })
    }

    /// An upper estimate: the points depend on the elements that a crack crosses.
    fn wanted_face_points(&self, case: &Case) -> f64 {
        let spacing = case.mesh.interface_spacing.unwrap_or(f64::INFINITY);
        let points = |(crack, size): (&Crack, f64)| crack.length() / size.min(spacing);
        case.cracks.cracks().iter().zip(case.element_sizes()).map(points).sum()
    }

    fn finest_grid(&self, case: &Case) -> FinestGrid {
        if case.mesh.interface_spacing.is_some() {
            let help = "a larger [mesh] interface_spacing_mm reduces their number";
            return FinestGrid::in_the_plane(INTERFACE_SPACING, help);
        }
        FinestGrid::in_the_plane(ELEMENT_SIZE, "a larger [mesh] element_size_mm reduces their number")
    }

    fn body_engine(&self, _: &Case, finite_elements: XfemEngine) -> Option<Box<dyn BodyEngine + Send>> {
        Some(Box::new(finite_elements))
    }
}
