//! A patch in rolling contact as the load of the half-space.

use railcrack::load::{HertzEllipse, Travel};
use railcrack::rolling::{PlacedPatch, RollingPatch, StripPoint};
use railcrack::space::{BilinearPatch, EllipticWheel, StripTraction, WheelPatch};
use std::sync::Arc;

/// Intervals along each strip.
const INTERVALS: usize = 160;

/// The whole `patch` of a wheel that runs towards `travel`, its y = 0 at `lateral` (mm).
pub(super) fn rolling_patch(patch: &RollingPatch, lateral: f64, travel: Travel) -> WheelPatch {
    let HertzEllipse { peak_pressure, along, .. } = patch.ellipse;
    let [from, to] = patch.ends();
    let middle = 0.5 * (from + to);
    let outline = EllipticWheel {
        peak_pressure,
        half_width: along,
        lateral_half_width: 0.5 * (to - from),
        lateral: lateral + middle,
        friction: 0.0,
        lateral_friction: 0.0,
    };
    // Strips run from their leading edge backwards; a wheel that runs towards −x has the mirror
    // image.
    let towards = |sign: f64| {
        move |point: &StripPoint| StripTraction {
            x: sign * point.x,
            traction: [point.pressure, sign * point.shear[0], point.shear[1]],
        }
    };
    let strip = |y: f64| {
        let Ok(strip) = patch.strip(middle + y, INTERVALS) else { return Vec::new() };
        match travel {
            Travel::Forward => strip.points.iter().rev().map(towards(1.0)).collect(),
            Travel::Backward => strip.points.iter().map(towards(-1.0)).collect(),
        }
    };
    WheelPatch::Bilinear(Arc::new(BilinearPatch::new(outline, strip)))
}

/// All `patches` of a wheel that runs towards `travel`, the place of each at z = 0: the heaviest
/// first.
pub(super) fn placed_patches(patches: &[PlacedPatch], travel: Travel) -> Option<WheelPatch> {
    let mut order: Vec<&PlacedPatch> = patches.iter().collect();
    order.sort_by(|a, b| b.patch.normal_force().total_cmp(&a.patch.normal_force()));
    let sign = if travel == Travel::Forward { 1.0 } else { -1.0 };
    let placed = |own: &&PlacedPatch| (sign * own.x, rolling_patch(&own.patch, -own.y, travel));
    match order[..] {
        [] => None,
        // The centre of the wheel is the middle of its only patch.
        [one] => Some(rolling_patch(&one.patch, -one.y, travel)),
        _ => Some(WheelPatch::Several(order.iter().map(placed).collect())),
    }
}
