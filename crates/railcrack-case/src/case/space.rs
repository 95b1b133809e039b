//! Cases for the space engine: required and excluded sections.

use super::cracks::PlacedCracks;
use super::front_shape::front_shape;
use super::plane::read_plastic_stress;
use super::space_case::SpaceCase;
use super::traffic_wheel::TrafficWheel;
use crate::schema::{Fault, Report, SectionValues, Sections};
use crate::tables::{
    CONTACT, CRACK, ContactOrigin, ContactSolver, CrackSurface, FRONT, FRONT_HARMONICS, FrontForm, GROWTH,
    GivenContact, GivenWheel, KIND, LATERAL_HALF_WIDTH, LAW, MESH, MODE_3_WEIGHT, PLASTIC_STRESS,
    PlasticSource, RAIL, Rail, SOLVER, SOLVER_CONTACT, SPACE_SURFACE_ROWS, SPACING, SURFACE,
    SURFACE_HALF_LENGTH, TURNING_LENGTH, WHEEL, WHEEL_CONTACT, read_resolution,
};
use railcrack::bulk::Boundary;
use railcrack::crack::Crack;
use railcrack::growth::{FrontDeviation, FrontShape};
use railcrack::space::{CellDivision, CloseCracks, LEAST_STRIP, SpaceCrack};
use std::path::Path;

/// The cracks, the wheel and the law of the engine in space; none if something is wrong or missing;
/// errors are added to `report`.
pub(super) fn read_space(
    sections: &Sections,
    placed: Option<&PlacedCracks>,
    wheels: Option<&[TrafficWheel]>,
    rail: Option<&Rail>,
    folder: &Path,
    report: &mut Report,
) -> Option<SpaceCase> {
    let plastic_stress = match sections.one(&PLASTIC_STRESS) {
        Some(section) => Some(read_plastic_stress(section, sections, folder, report)?),
        None => None,
    };
    if let Some((section, source)) = sections.one(&PLASTIC_STRESS).zip(plastic_stress.as_ref())
        && *source != PlasticSource::Rolled
    {
        let says = "the space engine balances no plastic stress that is given";
        let help = "use from = \"passages\" or a balanced profile ([residual_stress])";
        report.add(section.fault_of_all(says).help(help));
    }
    let solver = sections.one(&SOLVER)?;
    if solver.get(SOLVER_CONTACT) == Some(ContactSolver::Latin) {
        let says = "the space engine solves the contact conditions by Newton's method only";
        report.add(solver.fault(SOLVER_CONTACT, says).help("use contact = \"newton\""));
    }
    if rail.is_some_and(|rail| rail.boundary != Boundary::HalfPlane) {
        let says = "the space engine computes a half-space only";
        let rail = sections.one(&RAIL)?;
        report.add(rail.fault_of_name("boundary", says).help("use boundary = \"half-plane\""));
    }
    let growth = sections.one(&GROWTH)?;
    if growth.get(LAW).is_some_and(|law| law.own_range.is_some()) {
        let says = "does not include mode III, which occurs in space";
        report.add(growth.fault(LAW, says).help("use another law, such as law = \"paris\""));
    }
    let given: Vec<&SectionValues> = sections.all(&CRACK).collect();
    for section in &given {
        if section.get(SURFACE_HALF_LENGTH).is_none() && !section.is_refused(SURFACE_HALF_LENGTH) {
            let key = section.dotted(SURFACE_HALF_LENGTH.key.name);
            let message = format!(
                "`{key}` is missing: the space engine needs the semi-axis of the crack along the surface, in mm"
            );
            report.add(Fault::of(key, section.span.clone(), message));
        }
    }
    let deviation = read_deviation(growth, report);
    judge_turning(growth, report);
    let mesh = sections.one(&MESH)?;
    let shapes = placed.and_then(|placed| read_shapes(placed, &given, report));
    // For a mix, the contact section of each wheel.
    let mut contacts: Vec<&SectionValues> =
        sections.all(&WHEEL).filter_map(|wheel| sections.part(wheel, &WHEEL_CONTACT)).collect();
    if contacts.is_empty() {
        contacts.extend(sections.one(&CONTACT));
    }
    // Those of a table come last, and have no sections.
    for (section, wheel) in contacts.iter().zip(wheels.unwrap_or_default()) {
        check_wheel(section, &wheel.wheel, report);
    }
    let shapes = shapes?.into_iter().map(|shape| FrontShape { deviation, ..shape }).collect();
    let (resolution, mode_3_weight) = (read_resolution(mesh), growth.get(MODE_3_WEIGHT));
    let space = SpaceCase { shapes, resolution, mode_3_weight, plastic_stress };
    judge_harmonics(&space, growth, report);
    judge_surface_rows(&space, mesh, report);
    Some(space)
}

/// The deviation, still none, of fronts that are free to leave their ellipses; errors are added to
/// `report`.
fn read_deviation(growth: &SectionValues, report: &mut Report) -> Option<FrontDeviation> {
    if growth.get(FRONT)? == FrontForm::Ellipse {
        return None;
    }
    let harmonics = growth.get(FRONT_HARMONICS)?;
    let Some(deviation) = FrontDeviation::none(harmonics) else {
        return report.refuse(growth.fault(FRONT_HARMONICS, "must be even").help("use 2, 4, 6 or 8"));
    };
    Some(deviation)
}

/// Adds an error to `report` where a surface would turn as the limit path.
fn judge_turning(growth: &SectionValues, report: &mut Report) {
    if growth.get(SURFACE) == Some(CrackSurface::Turned) && growth.get(TURNING_LENGTH) == Some(0.0) {
        let says = "the limit path is followed in the plane only";
        report.add(growth.fault(TURNING_LENGTH, says).help("use a positive length, such as 0.5"));
    }
}

/// Adds an error to `report` where fronts have too few points for their harmonics.
fn judge_harmonics(space: &SpaceCase, growth: &SectionValues, report: &mut Report) {
    let harmonics = |shape: &FrontShape| Some(shape.deviation?.harmonics());
    let Some(harmonics) = space.shapes.iter().find_map(harmonics) else { return };
    // Points in the layer at the surface do not count.
    let counted =
        |division: CellDivision| division.front_angles().filter(|phi| division.counts(*phi)).count();
    if space.divisions().any(|division| counted(division) < harmonics + 2) {
        let says = format!(
            "{harmonics} harmonics are determined by more points of the front than {} cells (mesh.space_cells) have",
            space.resolution.block
        );
        report.add(growth.fault(FRONT_HARMONICS, says).help("use front_harmonics = 4 or more space_cells"));
    }
}

/// Adds an error to `report` where no crack has the further rows next to the surface.
fn judge_surface_rows(space: &SpaceCase, mesh: &SectionValues, report: &mut Report) {
    let has_surface_rows = |shape: &FrontShape| shape.buried.is_none() && shape.strip.is_none();
    if space.resolution.surface > 0 && !space.shapes.iter().any(has_surface_rows) {
        let says = "has no effect: no crack is planar and breaks the surface";
        report.add(mesh.fault(SPACE_SURFACE_ROWS, says).help("leave it out"));
    }
}

/// The cracks, none of which meets another.
fn read_shapes(
    placed: &PlacedCracks,
    given: &[&SectionValues],
    report: &mut Report,
) -> Option<Vec<FrontShape>> {
    let mut shapes = Vec::new();
    for (crack, &owner) in placed.network.cracks().iter().zip(&placed.owner) {
        let section = given.get(owner)?;
        shapes.push(read_shape(crack, section.get(SURFACE_HALF_LENGTH)?, section, report)?);
    }
    let cracks: Vec<SpaceCrack> = shapes.iter().filter_map(|shape| shape.crack().ok()).collect();
    let Some(close) = CloseCracks::among(&cracks) else { return Some(shapes) };
    let [first, second] = [close.first, close.second].map(|k| given[placed.owner[k]]);
    let help = "counting copies; cracks that join in space are not modelled";
    let fault = if placed.owner[close.first] == placed.owner[close.second] {
        Fault::of(first.dotted(SPACING.key.name), first.span_of(SPACING), close.to_string())
    } else {
        Fault::of(second.path.clone(), second.span.clone(), close.to_string())
            .also(first.span.clone(), "the other crack")
    };
    report.refuse(fault.help(help))
}

fn read_shape(
    crack: &Crack,
    half_length: f64,
    section: &SectionValues,
    report: &mut Report,
) -> Option<FrontShape> {
    let Some(shape) = front_shape(crack, half_length, section) else {
        let says = "the space engine computes planar cracks, of two points, and folded ones, of three: mouth, fold and deepest point";
        return report.refuse(section.fault_of_name("points_mm", says));
    };
    if let Err(error) = shape.crack() {
        let name = if section.is_given_name("angle_deg") { "angle_deg" } else { "points_mm" };
        return report.refuse(
            section.fault_of_name(name, format!("the space engine cannot compute this crack: {error}")),
        );
    }
    if !accepts_fold(&shape, section, report) {
        return None;
    }
    let aspect = half_length / shape.length;
    if !(1.0 / LARGEST_ASPECT..=LARGEST_ASPECT).contains(&aspect) {
        let says = format!(
            "the semi-axes of the crack have the ratio {aspect:.3}; the cells of the space engine resolve 1/{LARGEST_ASPECT} to {LARGEST_ASPECT}"
        );
        return report.refuse(
            section
                .fault(SURFACE_HALF_LENGTH, says)
                .help("a plane engine computes the limit of very wide cracks"),
        );
    }
    Some(shape)
}

/// Whether the parts of a folded crack are such as its cells resolve; otherwise an error is added.
fn accepts_fold(shape: &FrontShape, section: &SectionValues, report: &mut Report) -> bool {
    let Some(strip) = shape.strip else { return true };
    let branch = shape.length;
    if strip.min(branch) >= LEAST_STRIP * strip.max(branch) {
        return true;
    }
    let says = format!(
        "the parts of the folded crack above and below the fold, {strip:.3} and {branch:.3} mm long, differ by a factor of more than {:.0}, which its cells do not resolve",
        1.0 / LEAST_STRIP
    );
    report
        .add(section.fault_of_name("points_mm", says).help("leave out the fold: use a crack of two points"));
    false
}

/// Semi-axes of a crack that its grid resolves.
const LARGEST_ASPECT: f64 = 25.0;

/// Reports a contact that loads no part of the half-space.
fn check_wheel(section: &SectionValues, wheel: &GivenWheel, report: &mut Report) {
    let Some(GivenContact { contact, origin, .. }) = wheel.given() else { return };
    if matches!(origin, ContactOrigin::Rolling { .. } | ContactOrigin::Profiles(_)) {
        return;
    }
    if contact.sliding().is_none() {
        let says = "the space engine computes the Hertz ellipse in full sliding only";
        report.add(section.fault(KIND, says).help("use kind = \"hertz\" or \"rolling\""));
    } else if !matches!(origin, ContactOrigin::Ellipse { .. } | ContactOrigin::GivenEllipse { .. }) {
        let key = section.dotted(LATERAL_HALF_WIDTH.key.name);
        let message = format!(
            "`{key}` is missing: the space engine needs the lateral semi-axis of the contact ellipse, in mm"
        );
        let help = "give it with peak_pressure_mpa and half_width_mm, or give wheel_load_kn with the radii of wheel and rail";
        report.add(Fault::of(key, section.span.clone(), message).help(help));
    }
}
