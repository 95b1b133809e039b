//! `[[crack]]`: a crack, or a row of equal ones.

use crate::schema::{NumberRange, RangeEnd, closed, integer, number, points, positive, section, within};

/// (0, 180).
const BELOW_THE_SURFACE: NumberRange = NumberRange { min: RangeEnd::Open(0.0), max: RangeEnd::Open(180.0) };

section! {
    CRACK "crack", Repeated, "A crack, or a row of equal cracks; the section is written once for each.",
        forms [[MOUTH, LENGTH, ANGLE], [POINTS]];
    MOUTH: f64 = number("mouth_mm", "mm", within(1e6), 0.0, "Abscissa of the crack mouth.").required();
    LENGTH: f64 = number("length_mm", "mm", closed(1e-3, 1e4), 6.0, "Length of a straight crack.").required();
    ANGLE: f64 = number("angle_deg", "degrees", BELOW_THE_SURFACE, 15.0, "Angle below the surface, from +x.")
        .required();
    POINTS: Vec<[f64; 2]> = points("points_mm", "mm", within(1e6), &[[0.0, 0.0], [4.0, -1.0], [6.0, -1.2]],
        "A polyline; first point on the surface (y = 0), or below it for a buried crack with two tips.")
        .required();
    CRACK_FRICTION: f64 = number("friction", "", closed(0.0, 2.0), 0.5, "Crack-face friction coefficient.")
        .required();
    COUNT: usize = integer("count", (1, 100), 1, "Number of equal cracks, copies to the right included.");
    SPACING: f64 = number("spacing_mm", "mm", positive(1e4), 3.375,
        "Distance from one copy to the next; needed when count > 1.")
        .optional()
        .paired(COUNT, "count copies stand spacing_mm apart: give both or neither");
}
