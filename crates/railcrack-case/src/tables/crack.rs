//! `[[crack]]`: a crack, a row of equal ones, or those of an inspection.

use crate::schema::{NumberRange, closed, file, integer, number, points, positive, section, within};

/// Flatter cracks lie closer to the surface than face elements are long: their systems are
/// singular.
pub(crate) const ANGLES: NumberRange = NumberRange::closed(0.5, 179.5);

section! {
    CRACK "crack", Repeated, "A crack or a row of cracks; the section is repeated for each.",
        forms [[MOUTH, LENGTH, ANGLE], [MOUTH, CRACK_DEPTH, ANGLE], [POINTS], [CRACK_TABLE; ANGLE]];
    MOUTH: f64 = number("mouth_mm", "mm", within(1e6), 0.0, "x coordinate of the crack mouth.").required();
    LENGTH: f64 = number("length_mm", "mm", closed(1e-3, 1e4), 6.0, "Length of a straight crack.").required();
    CRACK_DEPTH: f64 = number("depth_mm", "mm", closed(1e-3, 1e4), 1.5,
        "Depth of the tip of a straight crack, as an inspection gives it, instead of its length: length_mm = depth_mm/sin(angle_deg).").required();
    ANGLE: f64 = number("angle_deg", "degrees", ANGLES, 15.0, "Angle of the crack below the surface, measured from +x; no engine resolves flatter cracks.")
        .required();
    POINTS: Vec<[f64; 2]> = points("points_mm", "mm", within(1e6), &[[0.0, 0.0], [4.0, -1.0], [6.0, -1.2]],
        "Points of a polyline, the first on the surface (y = 0), or below it for a buried crack with two tips. In the space engine two points, or three of a folded crack: mouth, fold and deepest point.")
        .required();
    CRACK_TABLE: String = file("table", "inputs/cracks", "inspection.csv",
        "CSV file with a row for each crack of an inspection: mouth_mm, or position_m along the track, of which the smallest lies at x = 0; depth_mm or length_mm, a number or a class of sizes such as 0.5-1.0, which counts as its upper end, or at_most_mm. Optional are surface_length_mm, the length on the surface, half of which is surface_half_length_mm, angle_deg and lateral_mm; a row without them has those of the section, and all rows have its friction.")
        .required();
    CRACK_FRICTION: f64 = number("friction", "", closed(0.0, 2.0), 0.5, "Crack-face friction coefficient.")
        .required();
    SURFACE_HALF_LENGTH: f64 = number("surface_half_length_mm", "mm", closed(1e-3, 1e4), 6.0,
        "Semi-axis of the semi-elliptical crack along the surface; length_mm is the other one. The space engine needs it. In the plane a crack that grows keeps its shape, K is that of its deepest point, and without it the crack is long along the surface.").optional();
    CRACK_LATERAL: f64 = number("lateral_mm", "mm", within(1e3), 0.0,
        "Lateral position of the centre of the crack and of its copies, for the space engine and for a table of wheels; 0 if not given. Cracks in space must be at least a twentieth of their smallest semi-axis apart.").optional();
    STRIKE: f64 = number("strike_deg", "degrees", closed(-180.0, 180.0), 0.0,
        "Rotation of the crack about the vertical, for the space engine: a crack with angle_deg < 90 descends towards +x at 0 and towards +z (laterally) at 90. 0 if not given, the only value that the plane engines accept.").optional();
    COUNT: usize = integer("count", (1, 256), 1, "Number of cracks in a row, including the copies to the right.");
    SPACING: f64 = number("spacing_mm", "mm", positive(1e4), 3.375,
        "Distance from one copy to the next; required when count > 1. Cracks, copied or not, must be at least a thousandth of the length of the shorter one apart, and the points of a polyline a thousandth of its length.")
        .optional()
        .paired(COUNT, "count copies are spaced spacing_mm apart: give both or neither");
    LENGTH_SD: f64 = number("length_sd_mm", "mm", closed(0.0, 1e3), 0.5,
        "Standard deviation of the lengths of the copies of a straight crack (normal distribution, truncated at three standard deviations); 0 if not given.").optional();
    ANGLE_SD: f64 = number("angle_sd_deg", "degrees", closed(0.0, 60.0), 2.0,
        "Standard deviation of the angles of these copies, likewise truncated; 0 if not given.").optional();
    SPACING_SD: f64 = number("spacing_sd_mm", "mm", closed(0.0, 1e3), 0.5,
        "Standard deviation of the distances from one copy to the next, likewise truncated; 0 if not given.").optional();
    ROW_SEED: usize = integer("seed", (0, 1_000_000_000), 1,
        "Seed of the scatter of the copies, which is the same on every machine. The first k copies do not depend on count.")
        .optional();
}
