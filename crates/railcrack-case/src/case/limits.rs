//! Limits of the size of a run, checked before anything is computed.

use super::by_geometry::ByGeometry;
use super::case::Case;
use super::geometry::Geometry;
use crate::schema::{Report, SectionValues, Sections};
use crate::tables::{ELEMENT_SIZE, INTERFACE_SPACING, MESH, PASSAGE, POSITIONS, PlaneEngine};
use railcrack::xfem::MOST_MESH_UNKNOWNS;

/// Maximum number of rows of `faces.csv`, one for each position, growth step and face point: a
/// terabyte of text.
const MOST_ROWS: f64 = 1e10;

/// Least distance between two cracks, least depth of a buried point and least segment, over the
/// length of the (shorter) crack: face elements are as short as these, and at a thousandth a crack
/// has a thousand.
pub(super) const RESOLVED: f64 = 1e-3;

/// Least distance between face points over the element of their crack. The jump in an element
/// follows three points; whether it follows four depends on where the crack cuts the elements: at
/// 20° it does, at 90° a crack has failed with 0.45, which the run then says.
const CLOSE_POINTS: f64 = 0.3;

/// Reports face points that are closer than the elements can follow.
fn check_face_points(case: &Case, mesh: &SectionValues, report: &mut Report) -> bool {
    let Some(plane) = case.plane().filter(|plane| plane.engine == PlaneEngine::Xfem) else { return true };
    let largest = plane.element_sizes(&case.cracks).into_iter().fold(0.0, f64::max);
    let is_close = plane.mesh.interface_spacing.is_some_and(|spacing| spacing < CLOSE_POINTS * largest);
    if is_close {
        let says = format!(
            "must be at least {CLOSE_POINTS} of the element size at each crack, which is at most {largest} mm: the jump within an element cannot resolve closer face points"
        );
        let help = "reduce [mesh] element_size_mm, or leave both keys out: face points are then as close as the elements";
        report.add(mesh.fault(INTERFACE_SPACING, says).help(help));
    }
    !is_close
}

/// Size that a case requires, before anything is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WantedSize {
    /// Displacement unknowns of the mesh.
    unknowns: f64,
    /// Face points.
    points: f64,
}

/// Reports a run that is too large for any machine, and the key responsible; returns whether the
/// size is acceptable. `sizes` are those of other cases of the same study.
pub(super) fn check_size(
    case: &Case,
    sections: &Sections,
    sizes: &ByGeometry<WantedSize>,
    report: &mut Report,
) -> bool {
    let (Some(mesh), Some(passage)) = (sections.one(&MESH), sections.one(&PASSAGE)) else { return false };
    let WantedSize { unknowns, points } = sizes.value(case, || match &case.geometry {
        Geometry::Plane(plane) => WantedSize {
            unknowns: plane.wanted_mesh_unknowns(&case.cracks, case.rail),
            points: plane.wanted_face_points(&case.cracks),
        },
        Geometry::Space(space) => WantedSize { unknowns: 0.0, points: space.face_points() as f64 },
    });
    if unknowns.is_nan() || unknowns > MOST_MESH_UNKNOWNS {
        let says = format!("{unknowns:.2e} displacement unknowns; the limit is {MOST_MESH_UNKNOWNS:e}");
        let help = "a larger [mesh] element_size_mm reduces their number";
        report.add(mesh.fault(ELEMENT_SIZE, says).help(help));
        return false;
    }
    let most = case.geometry.most_face_points();
    if points.is_nan() || points > most {
        let says = match case.geometry {
            Geometry::Plane(_) => format!("{points:.2e} face points; the limit is {most:e}"),
            Geometry::Space(_) => {
                format!("with space_rings, {points} face points; the limit in space is {most}")
            }
        };
        let (key, help) = case.geometry.finest_key();
        report.add(mesh.fault_of_name(key, says).help(help));
        return false;
    }
    if !check_face_points(case, mesh, report) {
        return false;
    }
    let rows = case.positions(case.first_wheel()).len() as f64
        * (case.growth.expected_steps() as f64 + 1.0)
        * points;
    if rows > MOST_ROWS {
        let says =
            format!("with [growth] steps, up to {rows:.2e} rows of results; the limit is {MOST_ROWS:e}");
        let help = "reduce [passage] positions or [growth] steps";
        report.add(passage.fault(POSITIONS, says).help(help));
        return false;
    }
    true
}
