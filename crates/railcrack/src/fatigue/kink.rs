//! Stress intensity factors of virtual kinks and their ranges.

use super::LoadRange;
use crate::fracture::Sif;
use crate::math::{Orientation, Vec2, orientation};
use std::f64::consts::PI;

/// Stress intensity factors of a virtual kink at the tip, MPa √mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KinkSif {
    /// k1 (opening mode).
    pub k1: f64,
    /// k2 (shear mode).
    pub k2: f64,
}

/// The four functions of the kink angle in k1 = F11 K_I + F12 K_II, k2 = F21 K_I + F22 K_II.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KinkFunctions {
    /// F11, even in the angle.
    pub f11: f64,
    /// F12, odd.
    pub f12: f64,
    /// F21, odd.
    pub f21: f64,
    /// F22, even.
    pub f22: f64,
}

const PI2: f64 = PI * PI;
const PI3: f64 = PI2 * PI;
const PI4: f64 = PI2 * PI2;
const PI5: f64 = PI4 * PI;
const PI6: f64 = PI3 * PI3;

// Coefficients of m⁰, m², … m²⁰ (F11, F22) and m, m³, … m¹⁹ (F12, F21): Amestoy & Leblond 1992,
// appendix.
const F11: [f64; 11] = [
    1.0,
    -3.0 * PI2 / 8.0,
    PI2 - 5.0 * PI4 / 128.0,
    PI2 / 9.0 - 11.0 * PI4 / 72.0 + 119.0 * PI6 / 15360.0,
    5.07790,
    -2.88312,
    -0.0925,
    2.996,
    -4.059,
    1.63,
    4.1,
];
const F12: [f64; 10] = [
    -3.0 * PI / 2.0,
    10.0 * PI / 3.0 + PI3 / 16.0,
    -2.0 * PI - 133.0 * PI3 / 180.0 + 59.0 * PI5 / 1280.0,
    12.313906,
    -7.32433,
    1.5793,
    4.0216,
    -6.915,
    4.21,
    4.56,
];
const F21: [f64; 10] = [
    PI / 2.0,
    -(4.0 * PI / 3.0 + PI3 / 48.0),
    -2.0 * PI / 3.0 + 13.0 * PI3 / 30.0 - 59.0 * PI5 / 3840.0,
    -6.176023,
    4.44112,
    -1.5340,
    -2.0700,
    4.684,
    -3.95,
    -1.32,
];
const F22: [f64; 11] = [
    1.0,
    -(4.0 + 3.0 * PI2 / 8.0),
    8.0 / 3.0 + 29.0 * PI2 / 18.0 - 5.0 * PI4 / 128.0,
    -32.0 / 15.0 - 4.0 * PI2 / 9.0 - 1159.0 * PI4 / 7200.0 + 119.0 * PI6 / 15360.0,
    10.58254,
    -4.78511,
    -1.8804,
    7.280,
    -7.591,
    0.25,
    12.5,
];

impl KinkFunctions {
    /// The functions at the kink `angle` (radians, counter-clockwise positive from straight ahead).
    ///
    /// Series in m = angle/π to m²⁰ for an infinitesimal kink. Largest error of any of the four,
    /// measured against the kinked crack solved by conformal mapping: 1e-10 at 45°, 3e-8 at 70°,
    /// 5e-6 at 90°, 3e-4 at 110°.
    ///
    /// Source: Amestoy & Leblond 1992, Int. J. Solids Struct. 29, 465–501; Leblond 1999, Int. J.
    /// Solids Struct. 36, 79–103.
    #[must_use]
    pub fn at(angle: f64) -> Self {
        let m = angle / PI;
        let m2 = m * m;
        let series = |coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, c| sum * m2 + c);
        Self { f11: series(&F11), f12: m * series(&F12), f21: m * series(&F21), f22: series(&F22) }
    }

    /// k1 and k2 of the virtual kink for K_I and K_II of the actual `tip`, in the same units.
    #[must_use]
    pub fn kinked(&self, tip: Sif) -> KinkSif {
        KinkSif { k1: self.f11 * tip.ki + self.f12 * tip.kii, k2: self.f21 * tip.ki + self.f22 * tip.kii }
    }
}

/// Loading of a virtual kink by one wheel.
#[derive(Debug, Clone, Copy)]
pub(super) struct KinkLoad<'a> {
    /// K of the tip: where the faces of the kink are frictionless, the corners of the convex hull
    /// of the samples, which are the extremes of all linear functions of them; otherwise all
    /// samples in their order.
    pub samples: &'a [Sif],
    /// Friction coefficient of the faces of the kink.
    pub friction: f64,
}

impl KinkLoad<'_> {
    /// k1 and k2 of the kink at `angle`, with k2 as far as friction lets the faces slip: closed
    /// faces (k1 < 0) bear a shear of up to μ|k1|, so that k2 follows a play operator of that
    /// half-width. The passage is followed twice, so that the result is that of repeated passages.
    fn kinked(&self, angle: f64) -> impl Iterator<Item = KinkSif> + '_ {
        let functions = KinkFunctions::at(angle);
        let all = self.samples.iter().map(move |&tip| functions.kinked(tip));
        let friction = self.friction;
        let slip = move |slipped: f64, k: KinkSif| {
            let play = friction * (-k.k1).max(0.0);
            slipped.clamp(k.k2 - play, k.k2 + play)
        };
        let before = if friction > 0.0 { all.clone().fold(0.0, slip) } else { 0.0 };
        all.scan(before, move |slipped, k| {
            *slipped = slip(*slipped, k);
            Some(KinkSif { k1: k.k1, k2: *slipped })
        })
    }
}

/// Ranges of k1 and k2 at one angle over the passage.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct KinkRanges {
    pub k1_max: f64,
    pub delta_k1: f64,
    pub delta_k1_unclipped: f64,
    pub delta_k2: f64,
}

impl KinkRanges {
    pub(crate) fn of(load: KinkLoad<'_>, angle: f64) -> Self {
        let (mut k1_low, mut k1_top) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut k2_low, mut k2_high) = (f64::INFINITY, f64::NEG_INFINITY);
        for k in load.kinked(angle) {
            (k1_low, k1_top) = (k1_low.min(k.k1), k1_top.max(k.k1));
            (k2_low, k2_high) = (k2_low.min(k.k2), k2_high.max(k.k2));
        }
        if load.samples.is_empty() {
            return Self::default();
        }
        let k1_high = k1_top.max(0.0);
        Self {
            k1_max: k1_high,
            delta_k1: k1_high - k1_low.max(0.0).min(k1_high),
            delta_k1_unclipped: k1_top - k1_low,
            delta_k2: k2_high - k2_low,
        }
    }

    /// The ranges with negative k1 clipped at zero.
    pub(crate) fn clipped(&self) -> LoadRange {
        LoadRange::new(self.delta_k1, self.delta_k2, self.k1_max)
    }

    /// The ranges with negative k1 included.
    pub(crate) fn unclipped(&self) -> LoadRange {
        LoadRange { delta_ki: self.delta_k1_unclipped, ..self.clipped() }
    }
}

/// The largest distance between two values of (k1, k2) at one angle, k1 clipped at zero.
pub(super) fn vector_range(load: KinkLoad<'_>, angle: f64) -> f64 {
    let values: Vec<(f64, f64)> = load.kinked(angle).map(|k| (k.k1.max(0.0), k.k2)).collect();
    let distances =
        values.iter().enumerate().flat_map(|(i, a)| values[..i].iter().map(|b| (a.0 - b.0).hypot(a.1 - b.1)));
    distances.fold(0.0, f64::max)
}

/// The largest tangential stress √(2πr) σ_θθ at `angle` ahead of the actual tip: cos(θ/2) (K_I
/// cos²(θ/2) − 3/2 K_II sin θ); zero if it is never tensile.
pub(super) fn tangential(extremes: &[Sif], angle: f64) -> f64 {
    let half = (0.5 * angle).cos();
    let of = |k: &Sif| half * (k.ki * half * half - 1.5 * k.kii * angle.sin());
    extremes.iter().map(of).fold(0.0, f64::max)
}

/// The corners of the convex hull of `samples` in the (K_I, K_II) plane, counter-clockwise: a
/// linear function of K attains its extremes at corners. Fewer than three samples, or collinear
/// ones, yield their end points.
///
/// Andrew's monotone chain with an exact orientation test; all samples finite.
pub(crate) fn convex_hull(samples: &[Sif]) -> Vec<Sif> {
    // Adding zero turns −0 into +0, which are equal and must not be sorted apart.
    let mut points: Vec<Vec2> = samples.iter().map(|k| Vec2::new(k.ki + 0.0, k.kii + 0.0)).collect();
    points.sort_unstable_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    points.dedup();
    let to_sif = |p: &Vec2| Sif { ki: p.x, kii: p.y };
    if points.len() < 3 {
        return points.iter().map(to_sif).collect();
    }
    let mut corners = half_hull(points.iter().copied());
    corners.extend(half_hull(points.iter().rev().copied()));
    corners.iter().map(to_sif).collect()
}

/// The corners from the first point up to, but excluding, the last one, with all other points to
/// the left.
fn half_hull(points: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let mut chain: Vec<Vec2> = Vec::new();
    for point in points {
        while let [.., before, last] = chain[..] {
            if orientation(before, last, point) == Orientation::Left {
                break;
            }
            chain.pop();
        }
        chain.push(point);
    }
    chain.pop();
    chain
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROUNDING: f64 = 1e-12;

    /// In pure mode II the largest tangential stress is 2/√3 K_II, at cos θ = 1/3.
    #[test]
    fn tangential_stress_of_pure_mode_two() {
        let angle = -(1.0_f64 / 3.0).acos();
        let value = tangential(&[Sif { ki: 0.0, kii: 1.0 }], angle);
        assert!((value - 2.0 / 3f64.sqrt()).abs() < ROUNDING, "{value}");
        assert!(tangential(&[Sif { ki: 0.0, kii: 1.0 }], angle + 0.01) < value);
    }

    /// Straight ahead k1 and k2 are K_I and K_II: a closed tip has only slipped.
    #[test]
    fn vector_ranges_leave_out_closed_faces() {
        let tip = |ki: f64, kii: f64| Sif { ki, kii };
        let samples = [tip(-100.0, 0.0), tip(3.0, 4.0), tip(0.0, -2.0)];
        let range = vector_range(KinkLoad { samples: &samples, friction: 0.0 }, 0.0);
        assert!((range - 45f64.sqrt()).abs() < ROUNDING, "{range}");
    }

    /// Reversed mode II of amplitude 1: at 30°, Δk1² + 0.772 Δk2² falls from 2.495 to 1.993 with a
    /// friction of 0.3; straight ahead the faces bear no pressure, and at −76° there is no k2.
    #[test]
    fn friction_holds_back_a_closed_kink() {
        let tip = |kii: f64| Sif { ki: 0.0, kii };
        let samples = [tip(0.0), tip(1.0), tip(-1.0), tip(0.0)];
        let drive = |degrees: f64, friction: f64| {
            let ranges = KinkRanges::of(KinkLoad { samples: &samples, friction }, degrees.to_radians());
            ranges.delta_k1.powi(2) + 0.772 * ranges.delta_k2.powi(2)
        };
        assert!((drive(30.0, 0.0) - 2.495).abs() < 1e-3, "{}", drive(30.0, 0.0));
        assert!((drive(30.0, 0.3) - 1.993).abs() < 1e-3, "{}", drive(30.0, 0.3));
        assert_eq!(drive(0.0, 0.3), drive(0.0, 0.0));
        assert!((drive(-76.0, 0.3) - drive(-76.0, 0.0)).abs() < 2e-3);
        // A strong friction lets the kink slip only while it is open.
        let stuck = KinkRanges::of(KinkLoad { samples: &samples, friction: 1e6 }, 0.5);
        let open = KinkFunctions::at(0.5).kinked(tip(-1.0));
        assert!((stuck.delta_k2 - open.k2.abs()).abs() < ROUNDING, "{stuck:?}");
    }

    fn k(ki: f64, kii: f64) -> Sif {
        Sif { ki, kii }
    }

    #[test]
    fn corners_of_a_square_with_points_inside_and_on_its_sides() {
        let samples =
            [k(0., 0.), k(1., 1.), k(2., 0.), k(1., 0.), k(2., 2.), k(0., 2.), k(0., 1.), k(2., 2.)];
        assert_eq!(convex_hull(&samples), [k(0., 0.), k(2., 0.), k(2., 2.), k(0., 2.)]);
    }

    #[test]
    fn a_line_has_two_ends_and_a_point_one() {
        let line: Vec<Sif> = (0..9).map(|i| k(f64::from(i), -2.0 * f64::from(i))).collect();
        assert_eq!(convex_hull(&line), [k(0., 0.), k(8., -16.)]);
        assert_eq!(convex_hull(&[k(0., 0.), k(-0.0, 0.)]), [k(0., 0.)]);
        assert!(convex_hull(&[]).is_empty());
        let zeros_of_both_signs = [k(-0.0, 3.), k(0., 1.), k(0., 7.), k(1., 0.)];
        assert_eq!(convex_hull(&zeros_of_both_signs), [k(0., 1.), k(1., 0.), k(0., 7.)]);
    }
}

#[cfg(test)]
#[path = "kink_tests.rs"]
mod kink_tests;
