//! The engine that makes bodies from the cracks of a case.

use railcrack::body::BodyEngine;
use railcrack::dislocation::DislocationEngine;
use railcrack::residual::PlasticField;
use railcrack::section::{SectionEngine, SectionLayers};
use railcrack::xfem::{EnrichmentRadius, XfemEngine, XfemSettings};
use railcrack_case::{Case, PlaneCase, PlaneEngine};

/// The finite-element engine of `case`, which is `plane`, with a mesh for the cracks at the
/// beginning and their growth that also resolves `plastic` stress.
#[must_use]
pub fn finite_elements(case: &Case, plane: &PlaneCase, plastic: Option<&PlasticField>) -> XfemEngine {
    let [first, further @ ..] = plane.refined_regions(&case.cracks);
    let defaults = XfemSettings::default();
    let settings = XfemSettings {
        enrichment: plane.mesh.tip_enrichment_radius.map_or(defaults.enrichment, EnrichmentRadius::Fixed),
        interface_spacing: plane.mesh.interface_spacing,
        ..defaults
    };
    let engine = XfemEngine::with_region(first, case.steel, plane.rail_end(case.rail), settings);
    let engine = engine.followed_by(further.into());
    match plastic.and_then(|field| field.plastic_depth()) {
        Some(depth) => engine.resolving(PlaneCase::layers_of_plastic_stress(depth)),
        None => engine,
    }
}

/// The engine of `case`, without a plastic stress; none where the cracks are in space.
#[must_use]
pub fn body_engine(case: &Case) -> Option<Box<dyn BodyEngine + Send>> {
    let plane = case.plane()?;
    Some(engine_with(case, plane, finite_elements(case, plane, None)))
}

/// The engine of `case`, which is `plane` and whose finite elements `meshed` resolve its plastic
/// stress: in the section of the rail, where one is given, on the foundation of the first wheel
/// with a track.
pub(super) fn engine_with(case: &Case, plane: &PlaneCase, meshed: XfemEngine) -> Box<dyn BodyEngine + Send> {
    let engine: Box<dyn BodyEngine + Send> = match plane.engine {
        PlaneEngine::Xfem => Box::new(meshed),
        PlaneEngine::Dislocation => {
            let resolution = plane.face_resolution(&case.cracks);
            Box::new(DislocationEngine { steel: case.steel, resolution })
        }
    };
    let Some(layers) = plane.section.and_then(SectionLayers::of) else { return engine };
    let foundation = case.wheels.iter().find_map(|wheel| Some(wheel.wheel.track.as_ref()?.foundation));
    let in_section = SectionEngine::new(engine, case.steel, layers, foundation.unwrap_or(0.0));
    Box::new(in_section.expect("the case is checked"))
}
