//! The engine that makes bodies from the cracks of a case.

use railcrack::body::BodyEngine;
use railcrack::dislocation::DislocationEngine;
use railcrack::residual::PlasticField;
use railcrack::section::{SectionEngine, SectionLayers};
use railcrack::xfem::{EnrichmentRadius, XfemEngine, XfemSettings};
use railcrack_case::{Case, Engine};

/// The finite-element engine of `case`, with a mesh for the cracks at the beginning and their
/// growth that also resolves `plastic` stress.
#[must_use]
pub fn finite_elements(case: &Case, plastic: Option<&PlasticField>) -> XfemEngine {
    let [first, further @ ..] = case.refined_regions();
    let defaults = XfemSettings::default();
    let settings = XfemSettings {
        enrichment: case.mesh.tip_enrichment_radius.map_or(defaults.enrichment, EnrichmentRadius::Fixed),
        interface_spacing: case.mesh.interface_spacing,
        ..defaults
    };
    let engine = XfemEngine::with_region(first, case.steel, case.rail_end(), settings);
    let engine = engine.followed_by(further.into());
    match plastic.and_then(|field| field.plastic_depth()) {
        Some(depth) => engine.resolving(Case::layers_of_plastic_stress(depth)),
        None => engine,
    }
}

/// The engine of `case`, without a plastic stress; none where the cracks are in space.
#[must_use]
pub fn body_engine(case: &Case) -> Option<Box<dyn BodyEngine + Send>> {
    engine_with(case, finite_elements(case, None))
}

/// The engine of `case`, whose `finite_elements` resolve its plastic stress: in the section of the
/// rail, where one is given, on the foundation of the first wheel with a track. None where the
/// cracks are in space, whose growth builds no plane body.
pub(super) fn engine_with(case: &Case, finite_elements: XfemEngine) -> Option<Box<dyn BodyEngine + Send>> {
    let engine: Box<dyn BodyEngine + Send> = match case.engine {
        Engine::Xfem => Box::new(finite_elements),
        Engine::Dislocation => {
            Box::new(DislocationEngine { steel: case.steel, resolution: case.face_resolution() })
        }
        Engine::Space => return None,
    };
    let Some(layers) = case.rail.section.and_then(SectionLayers::of) else { return Some(engine) };
    let foundation = case.wheels.iter().find_map(|wheel| Some(wheel.wheel.track.as_ref()?.foundation));
    let in_section = SectionEngine::new(engine, case.steel, layers, foundation.unwrap_or(0.0));
    in_section.ok().map(|engine| Box::new(engine) as Box<dyn BodyEngine + Send>)
}
