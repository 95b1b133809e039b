//! Pressure of a patch by the interpenetration of its surfaces.

use crate::load::{HertzEllipse, WheelOnRail};
use crate::material::IsotropicElastic;
use crate::math::complete_elliptic;
use crate::rolling::StripOutline;
use std::f64::consts::PI;

/// The gap of two surfaces along their line x = 0: normal to the tangent plane of their first
/// contact.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Gap {
    /// Place of the first value and distance of the values, mm, in the tangent plane.
    pub from: f64,
    pub step: f64,
    /// The gap, mm: zero at the middle value, infinite where one surface ends.
    pub values: Vec<f64>,
    /// Curvature along the rail, per mm: that of the wheel.
    pub curvature: f64,
    /// Height of the pass towards the candidate before, mm.
    pub pass_before: f64,
}

/// The pressure on strips along the rail.
///
/// The approach is δ, the gap f(s) + A x². Kik and Piotrowski (1996) take as patch the part where
/// it is less than ε δ, ε = 0.55. With the ellipse correction of CONTACT (KPEC) ε varies across so
/// that an elliptical contact is exact: with the mean curvature B where f ≤ δ/2, around the middle
/// s_m of this interval, and the Hertz ellipse a, b of A, B and δ,
///
/// ε(s) δ = A a² − (A a² − B b²) ((s − s_m)/b)²,  a_s = √((ε δ − f)/A),
/// p = p0/a_max √(a_s² − x²),
///
/// where p0 makes the displacement of both bodies at the first contact δ.
///
/// Sources: Kik, Piotrowski 1996, 2nd mini-conference on contact mechanics, Budapest; Piotrowski,
/// Kik 2008, Vehicle System Dynamics 46, 27–48; the correction from the user guide of CONTACT.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PatchPressure {
    /// Places of the strips, from the first contact in the tangent plane, and half their lengths
    /// (mm).
    strips: Vec<[f64; 2]>,
    step: f64,
    approach: f64,
    peak: f64,
    pub normal_force: f64,
}

/// A contact patch of wheel and rail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileContact {
    /// y and z of the middle of the patch (that of its force) on the rail's profile, mm.
    pub y: f64,
    /// Downwards, mm.
    pub z: f64,
    /// Angle of the tangent plane, rad: positive where the rail falls towards +y.
    pub angle: f64,
    /// x of the patch ahead of the axle, mm.
    pub ahead: f64,
    /// δ, mm.
    pub approach: f64,
    /// N, N.
    pub normal_force: f64,
    /// Area, mm².
    pub area: f64,
    /// Pressure and length of the longest strip, and the b of an ellipse of the same normal force.
    pub ellipse: HertzEllipse,
    /// Lengths of the strips; y from the middle of the patch in the tangent plane.
    pub outline: StripOutline,
}

/// Share of the approach at which the curvature across is measured.
const MEASURED: f64 = 0.5;
/// Least curvature across over that along: surfaces that conform more would have patches longer
/// than the head is wide.
const FLATTEST: f64 = 0.02;
/// Load (N) of the ellipse whose shape is scaled.
const REFERENCE: f64 = 1e4;
/// Distance of a strip at which its own displacement is that of its width, over its width: the mean
/// of ln|s| over the width is ln(width/2e).
const OWN_STRIP: f64 = 0.5 / std::f64::consts::E;

impl Gap {
    /// The pressure at the approach δ (mm, positive), of bodies of `steel`.
    pub fn pressed(&self, approach: f64, steel: &IsotropicElastic) -> Option<PatchPressure> {
        let middle = self.values.len() / 2;
        let below = |limit: f64| {
            let low = (0..=middle).rev().take_while(|i| self.values[*i] <= limit).last();
            let high = (middle..self.values.len()).take_while(|i| self.values[*i] <= limit).last();
            [self.crossing(low.unwrap_or(middle), -1, limit), self.crossing(high.unwrap_or(middle), 1, limit)]
        };
        let [low, high] = below(MEASURED * approach);
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        let along = 0.5 * self.curvature;
        let across = (MEASURED * approach / (half * half)).max(FLATTEST * along);
        let [a, b] = hertz_axes(along, across, approach, steel)?;
        let (most, fall) = (along * a * a, along * a * a - across * b * b);
        let square = |i: usize| {
            let s = self.from + i as f64 * self.step;
            let level = (most - fall * ((s - centre) / b).powi(2)).clamp(0.0, approach);
            (level - self.values[i]) / along
        };
        let inside = |i: &usize| square(*i) > 0.0;
        let first = (0..=middle).rev().take_while(inside).last()?;
        let last = (middle..self.values.len()).take_while(inside).last()?;
        let strips: Vec<[f64; 2]> =
            (first..=last).map(|i| [self.from + i as f64 * self.step, square(i).sqrt()]).collect();
        let longest = strips.iter().map(|strip| strip[1]).fold(0.0, f64::max);
        // Displacement at the first contact per p0/a_max, times π E*: ∫∫ √(a_s² − x²)/r.
        let own = OWN_STRIP * self.step;
        let displaced: f64 = strips.iter().map(|[s, half]| strip_potential(*half, s.abs().max(own))).sum();
        let squares: f64 = strips.iter().map(|strip| strip[1] * strip[1]).sum();
        let peak = approach * PI * combined_modulus(steel) * longest / (displaced * self.step);
        let normal_force = 0.5 * PI * peak / longest * squares * self.step;
        Some(PatchPressure { strips, step: self.step, approach, peak, normal_force })
    }

    /// Where the gap reaches `limit` beyond the value `i` in the direction `towards`.
    fn crossing(&self, i: usize, towards: isize, limit: f64) -> f64 {
        let at = |i: usize| self.from + i as f64 * self.step;
        let next = i.checked_add_signed(towards).and_then(|next| self.values.get(next));
        let Some(next) = next.filter(|next| next.is_finite() && **next > self.values[i]) else {
            return at(i);
        };
        at(i) + towards as f64 * self.step * (limit - self.values[i]) / (next - self.values[i])
    }
}

impl PatchPressure {
    /// The contact with the first contact at `touching` (y, z on the rail), tilted by `angle`
    /// (rad), ahead of the axle by `ahead` (mm).
    pub fn contact(&self, touching: [f64; 2], angle: f64, ahead: f64) -> ProfileContact {
        let weight: f64 = self.strips.iter().map(|[_, half]| half * half).sum();
        let centre = self.strips.iter().map(|[s, half]| s * half * half).sum::<f64>() / weight;
        let along = self.strips.iter().map(|strip| strip[1]).fold(0.0, f64::max);
        let (first, last) = (self.strips[0], self.strips[self.strips.len() - 1]);
        // The first and the last strip end somewhere within their width.
        let ends = [first[0] - 0.5 * self.step - centre, last[0] + 0.5 * self.step - centre];
        let half_length = |y: f64| {
            let place = (y + centre - first[0]) / self.step;
            if place <= 0.0 || place >= (self.strips.len() - 1) as f64 {
                return 0.0;
            }
            let (below, part) = (place.floor() as usize, place.fract());
            let square = |i: usize| self.strips[i][1] * self.strips[i][1];
            ((1.0 - part) * square(below) + part * square(below + 1)).sqrt()
        };
        let across = 1.5 * self.normal_force / (PI * along * self.peak);
        let (sin, cos) = angle.sin_cos();
        ProfileContact {
            y: touching[0] + centre * cos,
            z: touching[1] + centre * sin,
            angle,
            ahead,
            approach: self.approach,
            normal_force: self.normal_force,
            area: 2.0 * self.step * self.strips.iter().map(|strip| strip[1]).sum::<f64>(),
            ellipse: HertzEllipse { peak_pressure: self.peak, along, across },
            outline: StripOutline::new(ends, half_length),
        }
    }
}

/// E* of two equal bodies, MPa.
fn combined_modulus(steel: &IsotropicElastic) -> f64 {
    0.5 * steel.plane_strain_modulus()
}

/// ∫ √(l² − x²)/√(x² + s²) dx over a strip of half-length l at the distance s: 2 l²/√(l² + s²) D,
/// D of the axis ratio s/√(l² + s²).
fn strip_potential(half_length: f64, distance: f64) -> f64 {
    let reach = half_length.hypot(distance);
    2.0 * half_length * half_length / reach * complete_elliptic(distance / reach).d
}

/// Semi-axes (mm) of the Hertz ellipse with the gap A x² + B s² at the approach δ (mm): those of a
/// reference load, scaled by √δ.
fn hertz_axes(along: f64, across: f64, approach: f64, steel: &IsotropicElastic) -> Option<[f64; 2]> {
    let wheel = WheelOnRail {
        wheel_load: REFERENCE,
        wheel_radius: 0.5 / along,
        rail_head_radius: 0.5 / across,
        wheel_profile_radius: f64::INFINITY,
    };
    let ellipse = HertzEllipse::new(&wheel, steel).ok()?;
    let (longer, shorter) = (ellipse.along.max(ellipse.across), ellipse.along.min(ellipse.across));
    // δ = p0 n K/E*.
    let reference =
        ellipse.peak_pressure * shorter * complete_elliptic(shorter / longer).k / combined_modulus(steel);
    let scale = (approach / reference).sqrt();
    Some([scale * ellipse.along, scale * ellipse.across])
}
