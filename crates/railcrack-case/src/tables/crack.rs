//! `[[crack]]`: a crack, a row of equal ones, or those of an inspection.

use crate::schema::{NumberRange, closed, file, integer, number, points, positive, section, within};

/// Flatter cracks lie closer to the surface than face elements are long: their systems are
/// singular.
pub(crate) const ANGLES: NumberRange = NumberRange::closed(0.5, 179.5);

section! {
    CRACK "crack", Repeated, "A crack or a row of cracks.",
        forms [[MOUTH, LENGTH, ANGLE], [MOUTH, CRACK_DEPTH, ANGLE], [POINTS], [CRACK_TABLE; ANGLE]];
    MOUTH: f64 = number("mouth_mm", "mm", within(1e6), 0.0, "x of the crack mouth.").required();
    LENGTH: f64 = number("length_mm", "mm", closed(1e-3, 1e4), 6.0, "Length of a straight crack.").required();
    CRACK_DEPTH: f64 = number("depth_mm", "mm", closed(1e-3, 1e4), 1.5,
        "Tip depth of a straight crack: length_mm = depth_mm/sin(angle_deg).").required();
    ANGLE: f64 = number("angle_deg", "degrees", ANGLES, 15.0, "Angle of the crack below the surface, measured from +x.")
        .required();
    POINTS: Vec<[f64; 2]> = points("points_mm", "mm", within(1e6), &[[0.0, 0.0], [4.0, -1.0], [6.0, -1.2]],
        "Polyline from the surface (y = 0), or from below it for a buried crack with two tips. In space two points, or three of a folded crack: mouth, fold, deepest point.")
        .required();
    CRACK_TABLE: String = file("table", "inputs/cracks", "inspection.csv",
        "CSV file with a row per crack: mouth_mm, or position_m along the track (smallest at x = 0); depth_mm or length_mm, a number or a class such as 0.5-1.0 (its upper end counts), or at_most_mm; optionally surface_length_mm (twice surface_half_length_mm), angle_deg and lateral_mm, by default those of the section.")
        .required();
    CRACK_FRICTION: f64 = number("friction", "", closed(0.0, 2.0), 0.5, "Crack-face friction coefficient.")
        .required();
    SURFACE_HALF_LENGTH: f64 = number("surface_half_length_mm", "mm", closed(1e-3, 1e4), 6.0,
        "Semi-axis of a semi-elliptical crack along the surface; length_mm is the other one. Required in space. In the plane the crack keeps this shape, with K of its deepest point; by default it is long along the surface.").optional();
    CRACK_LATERAL: f64 = number("lateral_mm", "mm", within(1e3), 0.0,
        "Lateral position of the crack and its copies, in space or under a table of wheels; by default 0.").optional();
    STRIKE: f64 = number("strike_deg", "degrees", closed(-180.0, 180.0), 0.0,
        "Rotation of the crack about the vertical, only in space; by default 0. A crack with angle_deg < 90 descends towards +x at 0, +z (lateral) at 90.").optional();
    COUNT: usize = integer("count", (1, 256), 1, "Number of cracks in a row towards +x.");
    SPACING: f64 = number("spacing_mm", "mm", positive(1e4), 3.375,
        "Distance from one crack of the row to the next; required when count > 1.")
        .optional()
        .paired(COUNT, "count copies are spaced spacing_mm apart: give both or neither");
    LENGTH_SD: f64 = number("length_sd_mm", "mm", closed(0.0, 1e3), 0.5,
        "Standard deviation of the lengths of a row of straight cracks (normal, truncated at three deviations); by default 0.").optional();
    ANGLE_SD: f64 = number("angle_sd_deg", "degrees", closed(0.0, 60.0), 2.0,
        "Standard deviation of the angles of a row, likewise; by default 0.").optional();
    SPACING_SD: f64 = number("spacing_sd_mm", "mm", closed(0.0, 1e3), 0.5,
        "Standard deviation of spacing_mm, likewise; by default 0.").optional();
    ROW_SEED: usize = integer("seed", (0, 1_000_000_000), 1,
        "Seed of the scatter of a row; its first cracks do not depend on count.")
        .optional();
}
