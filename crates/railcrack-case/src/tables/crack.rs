//! `[[crack]]`: a crack, or a row of equal ones.

use crate::schema::{NumberRange, closed, integer, number, points, positive, section, within};

/// Flatter cracks lie closer to the surface than face elements are long: their systems are
/// singular.
pub(crate) const ANGLES: NumberRange = NumberRange::closed(0.5, 179.5);

section! {
    CRACK "crack", Repeated, "A crack, or a row of cracks; the section is written once for each.",
        forms [[MOUTH, LENGTH, ANGLE], [POINTS]];
    MOUTH: f64 = number("mouth_mm", "mm", within(1e6), 0.0, "Abscissa of the crack mouth.").required();
    LENGTH: f64 = number("length_mm", "mm", closed(1e-3, 1e4), 6.0, "Length of a straight crack.").required();
    ANGLE: f64 = number("angle_deg", "degrees", ANGLES, 15.0, "Angle below the surface, from +x; no engine resolves flatter cracks.")
        .required();
    POINTS: Vec<[f64; 2]> = points("points_mm", "mm", within(1e6), &[[0.0, 0.0], [4.0, -1.0], [6.0, -1.2]],
        "A polyline; first point on the surface (y = 0), or below it for a buried crack with two tips.")
        .required();
    CRACK_FRICTION: f64 = number("friction", "", closed(0.0, 2.0), 0.5, "Crack-face friction coefficient.")
        .required();
    SURFACE_HALF_LENGTH: f64 = number("surface_half_length_mm", "mm", closed(1e-3, 1e4), 6.0,
        "Half axis of the elliptical crack along the surface, for the engine space, in which length_mm is the other one; the \
         plane engines take the crack as long along the surface.").optional();
    CRACK_LATERAL: f64 = number("lateral_mm", "mm", within(1e3), 0.0,
        "Lateral position of the middle of the crack and of its copies, for the engine space; 0 without it. Cracks in space stand \
         at least a twentieth of their smallest half axis apart.").optional();
    STRIKE: f64 = number("strike_deg", "degrees", closed(-180.0, 180.0), 0.0,
        "Turn of the crack about the vertical, for the engine space: a crack with angle_deg < 90 goes down towards +x with 0, towards \
         +z (lateral) with 90. The plane engines take 0 only; 0 without it.").optional();
    COUNT: usize = integer("count", (1, 256), 1, "Number of cracks of a row, copies to the right included.");
    SPACING: f64 = number("spacing_mm", "mm", positive(1e4), 3.375,
        "Distance from one copy to the next; needed when count > 1. Cracks, copies or not, stand at least a thousandth of the \
         shorter one apart, and so do the points of a polyline.")
        .optional()
        .paired(COUNT, "count copies stand spacing_mm apart: give both or neither");
    LENGTH_SD: f64 = number("length_sd_mm", "mm", closed(0.0, 1e3), 0.5,
        "Standard deviation of the lengths of the copies of a straight crack; normal, cut at three of it. 0 without it.").optional();
    ANGLE_SD: f64 = number("angle_sd_deg", "degrees", closed(0.0, 60.0), 2.0,
        "The same of their angles.").optional();
    SPACING_SD: f64 = number("spacing_sd_mm", "mm", closed(0.0, 1e3), 0.5,
        "The same of the distances from one copy to the next.").optional();
    ROW_SEED: usize = integer("seed", (0, 1_000_000_000), 1,
        "Seed of the scatter of the copies: the same cracks on every machine. The first k copies do not depend on count.")
        .optional();
}
