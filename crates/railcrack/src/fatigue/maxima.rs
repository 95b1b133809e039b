//! Local maxima over kink angles.

use super::KINK_ANGLES;
use crate::math::{Ties, golden_section};

/// A local maximum.
#[derive(Debug, Clone, Copy)]
pub(super) struct Maximum {
    /// β, radians.
    pub angle: f64,
    pub value: f64,
}

/// Step of the coarse search, radians: the kink functions change by 2 % over it.
const GRID_STEP: f64 = std::f64::consts::PI / 180.0;
/// Golden sections of two steps: 2° · 0.618^36 = 1e-9 rad, below which the top of a smooth maximum
/// is flat in double precision.
const SECTIONS: usize = 36;
/// Difference (radians) below which two angles are equally far from straight ahead; the resolution
/// of a maximum in double precision.
pub(super) const SAME_ANGLE: f64 = 1e-6;

/// All local maxima of `value` in [`KINK_ANGLES`], ends included: found on a grid of 1° and refined
/// by golden section.
pub(super) fn local_maxima(value: impl Fn(f64) -> f64) -> Vec<Maximum> {
    let half = (KINK_ANGLES.end() / GRID_STEP).round() as i32;
    let angle = |i: i32| f64::from(i) * GRID_STEP;
    let values: Vec<f64> = (-half..=half).map(|i| value(angle(i))).collect();
    let last = values.len() - 1;
    let mut maxima = Vec::new();
    for (i, here) in (-half..=half).enumerate() {
        let not_below = |j: usize| values[i] >= values[j];
        if (i > 0 && !not_below(i - 1)) || (i < last && !not_below(i + 1)) {
            continue;
        }
        let (from, to) = (angle((here - 1).max(-half)), angle((here + 1).min(half)));
        let refined = golden_section([from, to], SECTIONS, Ties::Middle, &value);
        let refined = vertex(Maximum { angle: refined, value: value(refined) }, (from, to), &value);
        // At an end of the range the grid point itself may be the maximum, as on a plateau.
        let on_grid = Maximum { angle: angle(here), value: values[i] };
        maxima.push(if refined.value > on_grid.value { refined } else { on_grid });
    }
    maxima
}

/// The preferred one of two tied maxima.
pub(super) fn preferred(a: Maximum, b: Maximum) -> Maximum {
    let difference = a.angle.abs() - b.angle.abs();
    if difference.abs() > SAME_ANGLE {
        return if difference < 0.0 { a } else { b };
    }
    if a.angle > b.angle { a } else { b }
}

/// The maximum at `rough`, refined where the function is smooth there: the vertex of the parabola
/// through three points. Comparing values leaves an angle uncertain by the square root of
/// round-off, about 1e-8; the parabola by about 1e-11, so that histories that differ by round-off
/// give angles that differ by little more.
fn vertex(rough: Maximum, (from, to): (f64, f64), value: impl Fn(f64) -> f64) -> Maximum {
    const SPACING: f64 = 2e-4;
    let at = |step: f64| value(rough.angle + step * SPACING);
    let curvature = |left: f64, middle: f64, right: f64| left - 2.0 * middle + right;
    let [far_left, left, middle, right, far_right] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(at);
    let (near, wide) = (curvature(left, middle, right), 0.25 * curvature(far_left, middle, far_right));
    // At a corner of the function the second difference is the jump of the slope: it halves with
    // twice the spacing.
    let smooth = near < 0.0 && (wide - near).abs() < 0.2 * near.abs();
    let angle = rough.angle + 0.5 * SPACING * (left - right) / near;
    if !smooth || (angle - rough.angle).abs() > SPACING || angle < from || angle > to {
        return rough;
    }
    Maximum { angle, value: value(angle).max(rough.value) }
}
