//! Cases for the engines in the plane: the sections that only those know, and keys of cracks in
//! space.

use super::cracks::PlacedCracks;
use super::geometry::PlaneCase;
use crate::schema::{Report, SectionValues, Sections};
use crate::tables::{
    CRACK, CrackSurface, ENGINE, Engine, FRONT, FrontForm, GROWTH, MESH, MeshSettings, PLASTIC_STRESS,
    PlasticSource, RESIDUAL_STRESS, Rail, SOLVER, SOLVER_CONTACT, STRIKE, SURFACE,
};
use std::path::Path;

/// The parts that only the engines in the plane know, files relative to `folder`; none if something
/// is wrong or missing; errors are added to `report`.
pub(super) fn read_plane(
    sections: &Sections,
    placed: Option<&PlacedCracks>,
    rail: Option<&Rail>,
    folder: &Path,
    report: &mut Report,
) -> Option<PlaneCase> {
    refuse_strike(sections, report);
    refuse_fronts(sections, report);
    let plastic_stress = match sections.one(&PLASTIC_STRESS) {
        Some(section) => Some(read_plastic_stress(section, sections, folder, report)?),
        None => None,
    };
    let (solver, rail) = (sections.one(&SOLVER)?, rail?);
    let Engine::Plane(engine) = solver.get(ENGINE)? else { return None };
    let cracks: Vec<&SectionValues> = sections.all(&CRACK).collect();
    Some(PlaneCase {
        widths: placed.map_or_else(Vec::new, |placed| placed.widths(&cracks)),
        engine,
        contact_solver: solver.get(SOLVER_CONTACT)?,
        boundary: rail.boundary,
        section: rail.section,
        plastic_stress,
        mesh: MeshSettings::read(sections.one(&MESH)?),
    })
}

/// The plastic stress. A residual stress is a total, and the state that rolling leaves starts from
/// a manufacturing stress of its own: both would be counted twice.
pub(super) fn read_plastic_stress(
    section: &SectionValues,
    sections: &Sections,
    folder: &Path,
    report: &mut Report,
) -> Option<PlasticSource> {
    let source = PlasticSource::read(section, folder, report)?;
    if source == PlasticSource::Rolled && sections.one(&RESIDUAL_STRESS).is_some() {
        let says = "without a field, this is the stress left by rolling, but `[residual_stress]` is already the total";
        let help =
            "give a stress that was present before the first passage as `initial_residual` of [shakedown]";
        report.add(section.fault_of_all(says).help(help));
    }
    Some(source)
}

/// Reports free fronts and turned surfaces, which cracks in the plane do not have.
fn refuse_fronts(sections: &Sections, report: &mut Report) {
    let Some(growth) = sections.one(&GROWTH) else { return };
    if growth.get(FRONT) == Some(FrontForm::Free) {
        let says = "concerns fronts of cracks in space; in the plane a crack has tips";
        report.add(growth.fault(FRONT, says).help("use engine = \"space\" or front = \"ellipse\""));
    }
    if growth.get(SURFACE) == Some(CrackSurface::Turned) {
        let says = "concerns cracks in space; in the plane paths turn in any case";
        report.add(growth.fault(SURFACE, says).help("use engine = \"space\" or leave it out"));
    }
}

/// Reports rotated cracks, which the plane engines cannot compute.
fn refuse_strike(sections: &Sections, report: &mut Report) {
    let turned = |section: &&SectionValues| section.get(STRIKE).is_some_and(|strike| strike != 0.0);
    for section in sections.all(&CRACK).filter(turned) {
        let says = "rotates the crack about the vertical, which requires the space engine; in the plane its mouth lies across the rail";
        report.add(section.fault(STRIKE, says).help("use engine = \"space\" or strike_deg = 0"));
    }
}
