//! Direction of growth under a non-proportional passage.

use super::hull::convex_hull;
use super::{DirectionCriterion, KINK_ANGLES, KinkFunctions, ParisLaw};
use crate::fracture::{Sif, SifHistory};

/// The criterion of Hourlier & Pineau: the crack kinks by the angle β that maximises the growth
/// rate of the virtual kink over the passage, from the ranges of k1(β, t), clipped at zero (a
/// closed kink does not open negatively), and k2(β, t).
///
/// Source: Hourlier & Pineau 1982, Fatigue Eng. Mater. Struct. 5, 287–302; Trollé et al. 2014, section 4.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HourlierPineau {
    /// The growth law that weights the two modes.
    pub law: ParisLaw,
    /// The quantity that is maximised.
    pub criterion: DirectionCriterion,
}

/// The chosen virtual kink.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kink {
    /// β, radians, counter-clockwise positive from straight ahead.
    pub angle: f64,
    /// Growth rate of the virtual kink, mm per cycle.
    pub rate: f64,
    /// Δk1 of the virtual kink, k1 clipped at zero, MPa √mm.
    pub delta_k1: f64,
    /// Δk2 of the virtual kink, MPa √mm.
    pub delta_k2: f64,
    /// The largest secondary maximum, if any.
    pub secondary: Option<SecondaryMaximum>,
}

/// A secondary maximum of the criterion, at least 15° from the chosen one. An end of the searched
/// range is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SecondaryMaximum {
    /// β, radians.
    pub angle: f64,
    /// Its value over the largest one: of the growth rate (without threshold) for
    /// [`DirectionCriterion::MaxRate`], of Δk1 or of k1 for the others.
    pub ratio: f64,
}

/// Step of the coarse search, radians: the kink functions change by 2 % over it.
const GRID_STEP: f64 = std::f64::consts::PI / 180.0;
/// Least distance of a secondary maximum from the chosen direction, radians.
pub(crate) const SECONDARY_DISTANCE: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Maxima whose criteria differ by less, relatively, are ties: round-off of the history must not
/// decide between them.
const TIE: f64 = 1e-9;
/// Angles closer than this (radians) count as equally far from straight ahead: the resolution of a
/// maximum in double precision.
const SAME_ANGLE: f64 = 1e-6;

#[derive(Debug, Clone, Copy)]
struct Maximum {
    angle: f64,
    value: f64,
}

impl HourlierPineau {
    /// The kink for one passage of `history`. None where nothing drives a kink: no samples, all
    /// zero, never open in any direction for a criterion on k1, or samples that are not finite.
    ///
    /// β is searched in [`KINK_ANGLES`] on a grid of 1°; every local maximum is refined by golden
    /// section, and an end of the range can be chosen. Ties go to the smaller |β|, then to the
    /// positive (counter-clockwise) one; apart from this last rule, a history with K_II reversed
    /// gives exactly the opposite angle.
    #[must_use]
    pub fn kink(&self, history: &SifHistory) -> Option<Kink> {
        if !history.samples.iter().all(|k| k.ki.is_finite() && k.kii.is_finite()) {
            return None;
        }
        let extremes = convex_hull(&history.samples);
        let maxima = self.local_maxima(&extremes);
        let top = maxima.iter().fold(0.0_f64, |top, m| top.max(m.value));
        if top <= 0.0 {
            return None;
        }
        let best = maxima.iter().filter(|m| m.value >= top * (1.0 - TIE)).copied().reduce(preferred)?;
        let secondary = maxima
            .iter()
            .filter(|m| (m.angle - best.angle).abs() >= SECONDARY_DISTANCE && m.value > 0.0)
            .filter(|m| m.angle.abs() < KINK_ANGLES.end() - SAME_ANGLE)
            .copied()
            .reduce(|a, b| if b.value > a.value * (1.0 + TIE) { b } else { a })
            .map(|m| SecondaryMaximum { angle: m.angle, ratio: self.ratio(m.value, best.value) });
        let ranges = KinkRanges::of(&extremes, best.angle);
        Some(Kink {
            angle: best.angle,
            rate: self.law.rate(ranges.delta_k1, ranges.delta_k2),
            delta_k1: ranges.delta_k1,
            delta_k2: ranges.delta_k2,
            secondary,
        })
    }

    /// The criterion at `angle`. The rate is represented by ΔK_eq, with which it grows: no
    /// threshold flattens the search.
    fn value(&self, extremes: &[Sif], angle: f64) -> f64 {
        let ranges = KinkRanges::of(extremes, angle);
        match self.criterion {
            DirectionCriterion::MaxRate => self.law.equivalent_range(ranges.delta_k1, ranges.delta_k2),
            DirectionCriterion::MaxRateUnclipped => {
                self.law.equivalent_range(ranges.delta_k1_unclipped, ranges.delta_k2)
            }
            DirectionCriterion::MaxDeltaK1 => ranges.delta_k1,
            DirectionCriterion::MaxK1 => ranges.k1_max,
        }
    }

    fn ratio(&self, value: f64, best: f64) -> f64 {
        match self.criterion {
            DirectionCriterion::MaxRate | DirectionCriterion::MaxRateUnclipped => {
                (value / best).powf(self.law.m)
            }
            DirectionCriterion::MaxDeltaK1 | DirectionCriterion::MaxK1 => value / best,
        }
    }

    fn local_maxima(&self, extremes: &[Sif]) -> Vec<Maximum> {
        let half = (KINK_ANGLES.end() / GRID_STEP).round() as i32;
        let angle = |i: i32| f64::from(i) * GRID_STEP;
        let values: Vec<f64> = (-half..=half).map(|i| self.value(extremes, angle(i))).collect();
        let last = values.len() - 1;
        let mut maxima = Vec::new();
        for (i, here) in (-half..=half).enumerate() {
            let not_below = |j: usize| values[i] >= values[j];
            if (i > 0 && !not_below(i - 1)) || (i < last && !not_below(i + 1)) {
                continue;
            }
            let (from, to) = (angle((here - 1).max(-half)), angle((here + 1).min(half)));
            let refined =
                vertex(golden_section(from, to, |beta| self.value(extremes, beta)), (from, to), |beta| {
                    self.value(extremes, beta)
                });
            // At an end of the range the grid point itself may be the maximum, as on a plateau.
            let on_grid = Maximum { angle: angle(here), value: values[i] };
            maxima.push(if refined.value > on_grid.value { refined } else { on_grid });
        }
        maxima
    }
}

/// The preferred one of two tied maxima.
fn preferred(a: Maximum, b: Maximum) -> Maximum {
    let difference = a.angle.abs() - b.angle.abs();
    if difference.abs() > SAME_ANGLE {
        return if difference < 0.0 { a } else { b };
    }
    if a.angle > b.angle { a } else { b }
}

/// The maximum of a unimodal function in [from, to]. Symmetric: the mirrored function gives the
/// mirrored angle to the last bit.
fn golden_section(mut from: f64, mut to: f64, value: impl Fn(f64) -> f64) -> Maximum {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    // 2° · 0.618^36 = 1e-9 rad: below it the top of a smooth maximum is flat in double precision.
    const STEPS: usize = 36;
    for _ in 0..STEPS {
        let width = GOLDEN * (to - from);
        let (left, right) = (to - width, from + width);
        let (at_left, at_right) = (value(left), value(right));
        if at_left >= at_right {
            to = right;
        }
        if at_left <= at_right {
            from = left;
        }
    }
    let angle = 0.5 * (from + to);
    Maximum { angle, value: value(angle) }
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

/// Ranges of k1 and k2 at one angle over the passage. They follow from the extremes of linear
/// functions of (K_I, K_II), so the corners of the convex hull of the samples suffice.
#[derive(Debug, Clone, Copy)]
struct KinkRanges {
    k1_max: f64,
    delta_k1: f64,
    delta_k1_unclipped: f64,
    delta_k2: f64,
}

impl KinkRanges {
    fn of(extremes: &[Sif], angle: f64) -> Self {
        let functions = KinkFunctions::at(angle);
        let (mut k1_low, mut k1_top) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut k2_low, mut k2_high) = (f64::INFINITY, f64::NEG_INFINITY);
        for k in extremes.iter().map(|&k| functions.kinked(k)) {
            (k1_low, k1_top) = (k1_low.min(k.k1), k1_top.max(k.k1));
            (k2_low, k2_high) = (k2_low.min(k.k2), k2_high.max(k.k2));
        }
        if extremes.is_empty() {
            return Self { k1_max: 0.0, delta_k1: 0.0, delta_k1_unclipped: 0.0, delta_k2: 0.0 };
        }
        let k1_high = k1_top.max(0.0);
        Self {
            k1_max: k1_high,
            delta_k1: k1_high - k1_low.max(0.0).min(k1_high),
            delta_k1_unclipped: k1_top - k1_low,
            delta_k2: k2_high - k2_low,
        }
    }
}

#[cfg(test)]
#[path = "hourlier_pineau_tests.rs"]
mod tests;
