//! The gap that a line contact leaves over cracks which it does not feel.

use crate::body::FaceMesh;
use crate::field::{HertzWheel, Wheel};
use crate::load::{HertzianContact, SurfacePart, unfelt_gap};
use crate::material::IsotropicElastic;
use crate::math::{OutOfRange, dot};

/// The largest gap (mm) between rail and wheel with its centre at `xc` (mm), whose `contact` is
/// that on the uncracked rail, by the `jumps` (mm, 2p) of the faces. By Betti's theorem the nodal
/// forces of a pressure on the faces do the work on the jumps that it does on the sinking.
///
/// Errors: a contact without extent.
pub fn gap_in_plane(
    faces: &FaceMesh,
    jumps: &[f64],
    contact: &HertzianContact,
    steel: &IsotropicElastic,
    xc: f64,
) -> Result<f64, OutOfRange> {
    let measure = |half_width: f64| {
        let unit = HertzianContact { peak_pressure: 1.0, half_width, friction: 0.0 };
        Ok((HertzWheel::new(&unit, steel)?, unit.line_load()))
    };
    let a = contact.half_width;
    let (whole, part) = (measure(a)?, measure(SurfacePart::SHARE * a)?);
    Ok(unfelt_gap(|of: SurfacePart| {
        let (wheel, load) = if of == SurfacePart::WHOLE { &whole } else { &part };
        let forces = faces.nodal_forces(|point| wheel.stress(point, xc + of.ahead * a));
        dot(&forces, jumps) / load
    }))
}
