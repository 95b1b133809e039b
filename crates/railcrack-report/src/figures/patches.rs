//! Pictures of the patches of a wheel, to scale: |q|/(μp), stick and slip.

use crate::svg::{Anchor, Axes, Axis, Frame, GREY, INK, Stroke, Svg, TextStyle, coordinate, quantity, text};
use railcrack::rolling::{PlacedPatch, RollingPatch};
use railcrack_run::contact::{PATCH_INTERVALS, WheelRow, patch_strips};
use std::fmt::Write;

/// Pixels per mm.
const SCALE: f64 = 14.0;
/// Room around a patch, mm.
const AIR: f64 = 1.0;
/// Room around the axes, pixels: left, above, below.
const ROOM: [f64; 3] = [56.0, 26.0, 48.0];
/// Pixels between two patches, and below them for the key.
const GAP: f64 = 16.0;
const KEY: f64 = 22.0;
/// Corners of an outline.
const OUTLINE: usize = 120;
/// Shades from no shear to that of full friction.
const SHADES: usize = 8;

/// The key of the colours: on a page once for all wheels.
pub const PATCH_KEY: &str = "Blue: stick, red: slip, the darker the larger |q|/(μp). Dashed: the plane of the crack. The wheel travels to the right.";

/// Where the key of the colours stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PatchKey {
    /// Below the patches.
    InPicture,
    /// With the pictures of all wheels.
    OnPage,
}

/// The patches of a wheel side by side, with axes in mm; none of a line contact.
pub fn patches_picture(row: &WheelRow, key: PatchKey) -> Option<String> {
    if row.patches.is_empty() {
        return None;
    }
    let ends = row.patches.iter().flat_map(|own| own.patch.ends());
    let [low, high] = ends.fold([0.0_f64, 0.0_f64], |[low, high], y| [low.min(y), high.max(y)]);
    let (low, high) = (low - AIR, high + AIR);
    let [left, above, below] = ROOM;
    let height = (high - low) * SCALE;
    let below = if key == PatchKey::InPicture { below + KEY } else { below };
    let wide = |own: &PlacedPatch| 2.0 * (own.patch.ellipse.along + AIR) * SCALE;
    let width: f64 = row.patches.iter().map(|own| left + wide(own) + GAP).sum();
    let mut svg = Svg::new(width, above + height + below);
    let mut x = 0.0;
    for (place, own) in row.patches.iter().enumerate() {
        let half = own.patch.ellipse.along + AIR;
        let frame = Frame { left: x + left, top: above, width: wide(own), height };
        let ticks = |length: f64| (length / 45.0) as usize + 1;
        let axes = Axes {
            frame,
            x: Axis::exact(-half, half, ticks(frame.width)),
            y: Axis::exact(low, high, ticks(height)),
        };
        draw(&mut svg, &axes, own);
        let words = format!(
            "patch {}: {:.0} kN, {:.0} MPa",
            place + 1,
            1e-3 * own.patch.normal_force(),
            own.patch.ellipse.peak_pressure
        );
        let small = TextStyle { size: 11.0, anchor: Anchor::Middle, colour: INK, weight: "normal" };
        svg.text([frame.left + 0.5 * frame.width, above - 9.0], &text(&words), small);
        x = frame.right() + GAP;
    }
    if key == PatchKey::InPicture {
        let quiet = TextStyle { size: 11.0, anchor: Anchor::Start, colour: GREY, weight: "normal" };
        svg.text([4.0, above + height + below - 6.0], &text(PATCH_KEY), quiet);
    }
    Some(svg.finish(&format!("Contact patches of wheel {}", row.number)))
}

/// A patch on its axes: cells, outline, plane of the crack.
fn draw(svg: &mut Svg, axes: &Axes, own: &PlacedPatch) {
    axes.draw_grid(svg);
    for (shade, outline) in cells(axes, &own.patch).iter().enumerate() {
        if !outline.is_empty() {
            svg.area("cells", outline, &colour(shade));
        }
    }
    // Once around the patch, in steps of the parametric angle.
    let [low, high] = own.patch.ends();
    let corner = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / OUTLINE as f64).sin_cos();
        let y = 0.5 * (low + high) + 0.5 * (high - low) * sin;
        axes.at(own.patch.half_length(y).copysign(cos), y)
    };
    let corners: Vec<[f64; 2]> = (0..=OUTLINE).map(corner).collect();
    svg.polyline("outline", &corners, &Stroke::solid(INK, 1.0));
    let half = own.patch.half_length(own.y);
    if half > 0.0 {
        let line = [axes.at(-half, own.y), axes.at(half, own.y)];
        svg.polyline("crack", &line, &Stroke { dashes: "4 3", ..Stroke::solid(INK, 1.2) });
    }
    axes.draw_frame(svg, &quantity("x along the rail (mm)"), &quantity("y across (mm)"));
}

/// Outlines of the points of each strip by their shade: first those that stick, then those that
/// slip.
fn cells(axes: &Axes, patch: &RollingPatch) -> Vec<String> {
    let mut outlines = vec![String::new(); 2 * (SHADES + 1)];
    let [low, high] = patch.ends();
    let half = 0.5 * (high - low) / patch_strips([low, high]).count() as f64;
    for y in patch_strips([low, high]) {
        let Ok(strip) = patch.strip(y, PATCH_INTERVALS) else { continue };
        for three in strip.points.windows(3) {
            let [before, point, after] = three else { continue };
            let limit = patch.friction * point.pressure;
            let used =
                if limit > 0.0 { (point.shear[0].hypot(point.shear[1]) / limit).min(1.0) } else { 0.0 };
            let shade = (used * SHADES as f64).round() as usize;
            let slips = point.slips && used > 0.0;
            let [x0, y0] = axes.at(0.5 * (before.x + point.x), y + half).map(coordinate);
            let [x1, y1] = axes.at(0.5 * (point.x + after.x), y - half).map(coordinate);
            let outline = &mut outlines[if slips { SHADES + 1 + shade } else { shade }];
            // Writing to a string does not fail.
            let _ = write!(outline, "M{x0} {y0}H{x1}V{y1}H{x0}z");
        }
    }
    outlines
}

/// The colour of a shade of [`cells`]: from near white to a strong blue or red.
fn colour(shade: usize) -> String {
    let used = (shade % (SHADES + 1)) as f64 / SHADES as f64;
    let light = 245.0 - 165.0 * used;
    let [red, green, blue] = if shade > SHADES {
        [250.0 - 40.0 * used, light, light]
    } else {
        [light, light + 0.25 * (245.0 - light), 250.0 - 30.0 * used]
    };
    format!("#{:02x}{:02x}{:02x}", red as u8, green as u8, blue as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stick_is_blue_and_slip_is_red() {
        assert_eq!(colour(0), "#f5f5fa");
        assert_eq!(colour(SHADES), "#5079dc");
        assert_eq!(colour(2 * SHADES + 1), "#d25050");
    }
}
