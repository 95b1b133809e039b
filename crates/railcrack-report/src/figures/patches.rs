//! Pictures of patches: |q|/(μp), stick and slip.

use railcrack::rolling::{PlacedPatch, RollingPatch};
use railcrack_run::contact::{PATCH_INTERVALS, WheelRow, patch_strips};

/// Pixels per mm, and the margin around patches.
const SCALE: f64 = 14.0;
const MARGIN: f64 = 34.0;
/// Corners of an outline.
const OUTLINE: usize = 120;
/// Pixels of the line under the patches, its margins included.
const LEGEND: f64 = 520.0;

/// The patches of a wheel, from left to right; none of a line contact.
pub fn patches_picture(row: &WheelRow) -> Option<String> {
    if row.patches.is_empty() {
        return None;
    }
    let width: f64 = row.patches.iter().map(|own| 2.0 * own.patch.ellipse.along * SCALE + MARGIN).sum();
    let highest = |own: &PlacedPatch| own.patch.ends().map(f64::abs).into_iter().fold(0.0, f64::max);
    let tallest = row.patches.iter().map(highest).fold(0.0, f64::max);
    let (width, height) = ((width + MARGIN).max(LEGEND), 2.0 * tallest * SCALE + 2.5 * MARGIN);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"12\" role=\"img\" aria-label=\"Contact patches of wheel {}\">\n",
        row.number
    );
    svg.push_str(&format!("<rect width=\"{width:.0}\" height=\"{height:.0}\" fill=\"#ffffff\"/>\n"));
    let mut left = MARGIN;
    for (i, own) in row.patches.iter().enumerate() {
        let middle = [left + own.patch.ellipse.along * SCALE, MARGIN + tallest * SCALE];
        cells(&mut svg, &own.patch, middle);
        frame(&mut svg, own, middle);
        let under = MARGIN + 2.0 * tallest * SCALE + 0.6 * MARGIN;
        svg.push_str(&format!(
            "<text x=\"{:.1}\" y=\"{under:.1}\" text-anchor=\"middle\">patch {}: {:.0} kN, p0 {:.0} MPa</text>\n",
            middle[0],
            i + 1,
            1e-3 * own.patch.normal_force(),
            own.patch.ellipse.peak_pressure
        ));
        left += 2.0 * own.patch.ellipse.along * SCALE + MARGIN;
    }
    svg.push_str(&format!(
        "<text x=\"{MARGIN}\" y=\"{:.1}\">blue: stick, red: slip, the darker the larger |q|/(\u{3bc}p); travel to the right; line: the crack</text>\n</svg>\n",
        height - 0.5 * MARGIN
    ));
    Some(svg)
}

/// A cell for each point of each strip.
fn cells(svg: &mut String, patch: &RollingPatch, [x0, y0]: [f64; 2]) {
    let [low, high] = patch.ends();
    let tall = (high - low) * SCALE / patch_strips([low, high]).count() as f64;
    for y in patch_strips([low, high]) {
        let Ok(strip) = patch.strip(y, PATCH_INTERVALS) else { continue };
        for pair in strip.points.windows(3) {
            let [before, point, after] = pair else { continue };
            let (from, to) = (0.5 * (before.x + point.x), 0.5 * (point.x + after.x));
            let limit = patch.friction * point.pressure;
            let used =
                if limit > 0.0 { (point.shear[0].hypot(point.shear[1]) / limit).min(1.0) } else { 0.0 };
            // From near white to a strong blue or red.
            let light = 245.0 - 165.0 * used;
            let colour = match point.slips && used > 0.0 {
                true => format!("rgb({:.0},{light:.0},{light:.0})", 250.0 - 40.0 * used),
                false => format!(
                    "rgb({light:.0},{:.0},{:.0})",
                    light + 0.25 * (245.0 - light),
                    250.0 - 30.0 * used
                ),
            };
            svg.push_str(&format!(
                "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{colour}\"/>\n",
                x0 + to * SCALE,
                y0 - y * SCALE - 0.5 * tall,
                (from - to) * SCALE + 0.3,
                tall + 0.3
            ));
        }
    }
}

/// The outline, and the strip of the crack.
fn frame(svg: &mut String, own: &PlacedPatch, [x0, y0]: [f64; 2]) {
    // Once around the patch, in steps of the parametric angle.
    let [low, high] = own.patch.ends();
    let corner = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / OUTLINE as f64).sin_cos();
        let y = 0.5 * (low + high) + 0.5 * (high - low) * sin;
        let x = own.patch.half_length(y).copysign(cos);
        format!("{:.1},{:.1}", x0 + x * SCALE, y0 - y * SCALE)
    };
    let corners: Vec<String> = (0..OUTLINE).map(corner).collect();
    svg.push_str(&format!("<polygon points=\"{}\" fill=\"none\" stroke=\"#222222\"/>\n", corners.join(" ")));
    let half = own.patch.half_length(own.y) * SCALE;
    if half > 0.0 {
        let y = y0 - own.y * SCALE;
        svg.push_str(&format!(
            "<line x1=\"{:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{y:.1}\" stroke=\"#222222\" stroke-dasharray=\"4 3\"/>\n",
            x0 - half,
            x0 + half
        ));
    }
}
