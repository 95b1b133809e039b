//! Stress of the half-space under an elliptical Hertz contact in full sliding.
//!
//! The pressure is a superposition of waves of all directions ψ and wave numbers k, each of which
//! loads the half-space in plane strain and antiplane shear, with e^(−kz). With φ the parametric
//! angle of the ellipse in the direction ψ, R = √(a² cos² ψ + b² sin² ψ) and
//!
//!   w = z/R − i (x/a cos φ + y/b sin φ),
//!
//! the sum over k is closed, ∫ (sin κ − κ cos κ)/κ² e^(−κw) dκ = 1 − w arccot w, and the stress is
//! an integral of it and its derivative over φ. The integrand peaks where a line normal to ψ
//! through the point touches the ellipse (w = ±i), within an angle that shrinks with the depth:
//! hyperbolic sines stretch the neighbourhood of these angles, and that of the bend of R for a
//! slender ellipse.

use super::directions::{Directions, Node, Place};
use super::lanes::{LANES, Lanes, angles, logarithms, sines_and_cosines};
use super::plane::Symmetric;
use crate::load::HertzEllipse;
use crate::math::gauss_legendre;
use pulp::{Arch, Simd, WithSimd};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

/// Elliptical Hertz pressure p₀ √(1 − (u/a)² − (v/b)²) with shear in proportion along both axes.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct EllipticWheel {
    /// p₀, MPa.
    pub peak_pressure: f64,
    /// a, along the rail, mm.
    pub half_width: f64,
    /// b, across the rail, mm.
    pub lateral_half_width: f64,
    /// Lateral position of the centre, mm.
    pub lateral: f64,
    /// Ratio of shear along +x to pressure.
    pub friction: f64,
    /// Ratio of shear along the lateral axis to pressure.
    pub lateral_friction: f64,
}

/// −ln of the error of a rule in its ellipse of convergence; the resulting error is at most 5e-5 of
/// p₀ next to the edge of the contact, and 1e-6 on average.
const DIGITS: f64 = 14.0;
/// Smallest and largest number of points of a rule.
const POINTS: [usize; 2] = [3, 96];
/// Points are assumed to lie at least this share of a below the surface.
const SHALLOWEST: f64 = 1e-7;
/// When tangents are sought, points are assumed to lie at least this share of the semi-axes away
/// from the middle, where the tangents are far from real.
const OFF_MIDDLE: f64 = 1e-3;
/// Widths of neighbourhoods are limited to this value, at which stretching has practically no
/// effect.
const WIDEST: f64 = 2.0;
/// A bend of R closer than this many of its widths to a tangent is not stretched separately.
const APART: f64 = 1.5;

fn rule(points: usize) -> &'static [(f64, f64)] {
    static RULES: OnceLock<Vec<Vec<(f64, f64)>>> = OnceLock::new();
    &RULES.get_or_init(|| (0..=POINTS[1]).map(gauss_legendre).collect())[points]
}

/// A real angle near singular complex angles, and their distance from the real axis.
#[derive(Debug, Clone, Copy, Default)]
struct Centre {
    at: f64,
    width: f64,
}

impl EllipticWheel {
    /// Pressure (MPa) at x and lateral position `at` (mm) with the centre at the abscissa
    /// `position` (mm); zero outside of the contact.
    #[must_use]
    pub fn pressure(&self, position: f64, at: [f64; 2]) -> f64 {
        let (u, v) = ((at[0] - position) / self.half_width, (at[1] - self.lateral) / self.lateral_half_width);
        self.peak_pressure * (1.0 - u * u - v * v).max(0.0).sqrt()
    }

    /// Its ellipse with the pressure.
    #[must_use]
    pub fn ellipse(&self) -> HertzEllipse {
        let Self { peak_pressure, half_width, lateral_half_width, .. } = *self;
        HertzEllipse { peak_pressure, along: half_width, across: lateral_half_width }
    }

    /// The stress (MPa) at x, lateral and depth (mm) of a contact centred at `position` (mm).
    pub fn stress(&self, position: f64, point: [f64; 3], poisson: f64) -> Symmetric {
        let at =
            [(point[0] - position) / self.half_width, (point[1] - self.lateral) / self.lateral_half_width];
        let place = Place {
            half_axes: [self.half_width, self.lateral_half_width],
            at,
            depth: point[2].max(SHALLOWEST * self.half_width),
            friction: [self.friction, self.lateral_friction],
            poisson,
        };
        Arch::new().dispatch(AllDirections(place)).map(|value| self.peak_pressure * value / PI)
    }
}

/// The sum over all directions at a place.
struct AllDirections(Place);

impl WithSimd for AllDirections {
    type Output = Symmetric;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Symmetric {
        let Self(place) = self;
        let bend = bend(place.half_axes);
        let tangents = tangents(&place);
        let from_bend = |c: &Centre| {
            let turned = (c.at - bend.at) / PI;
            PI * (turned - turned.round_ties_even())
        };
        let mut centres = [tangents[0], tangents[1], bend];
        let is_alone = tangents.iter().all(|c| from_bend(c).abs() > APART * bend.width);
        let count = if is_alone { 3 } else { 2 };
        let centres = &mut centres[..count];
        for c in centres.iter_mut() {
            c.at -= PI * (c.at / PI).floor();
            c.width = c.width.min(WIDEST);
        }
        centres.sort_by(|one, other| one.at.total_cmp(&other.at));
        // The integrand has the period π. The part of each angle extends to the midpoints between
        // it and its neighbours.
        let mut ends = [0.0; LANES];
        for (k, c) in centres.iter().enumerate() {
            let before = if k > 0 { centres[k - 1].at } else { centres[count - 1].at - PI };
            let after = if k + 1 < count { centres[k + 1].at } else { centres[0].at + PI };
            ends[2 * k] = 0.5 * (c.at - before) / c.width;
            ends[2 * k + 1] = 0.5 * (after - c.at) / c.width;
        }
        let ends = inverse_hyperbolic_sines(&ends);
        // Logarithms of the sums of the semi-axes of the ellipses that have the interval's ends as
        // foci and pass through the singular points.
        let mut bends = [[0.0; LANES]; 2];
        for (k, c) in centres.iter().enumerate() {
            (bends[0][k], bends[1][k]) = (bend.width / c.width, -from_bend(c) / c.width);
        }
        let of_bend = if is_alone { bends } else { arc_cosines(&bends) };
        let mut singular = [[0.0; LANES]; 2];
        for k in 0..count {
            let (from, to) = (-ends[2 * k], ends[2 * k + 1]);
            let of_bend = [of_bend[1][k].copysign(bends[1][k]), FRAC_PI_2 - of_bend[0][k]];
            for (lane, [at, off_axis]) in [(2 * k, [0.0, FRAC_PI_2]), (2 * k + 1, of_bend)] {
                singular[0][lane] = (2.0 * at - from - to) / (to - from);
                singular[1][lane] = 2.0 * off_axis / (to - from);
            }
        }
        let decays = arc_cosines(&singular)[1];
        let mut directions = Directions::new(place);
        for (k, c) in centres.iter().enumerate() {
            let reach = ends[2 * k] + ends[2 * k + 1];
            if reach <= 0.0 {
                continue;
            }
            let slowest = if is_alone { decays[2 * k] } else { decays[2 * k].min(decays[2 * k + 1]) };
            let points = (0.5 * DIGITS / slowest).ceil() as usize + 1;
            for (share, weight) in rule(points.clamp(POINTS[0], POINTS[1])) {
                let t = reach * share - ends[2 * k];
                directions.add(Node { at: c.at, width: c.width, t, weight: weight * reach });
            }
        }
        directions.total()
    }
}

/// Where R of a slender ellipse bends.
fn bend([a, b]: [f64; 2]) -> Centre {
    let width = (a.min(b) / a.max(b)).atanh().min(10.0);
    Centre { at: if b > a { FRAC_PI_2 } else { 0.0 }, width }
}

/// The angles at which a line through the point touches the ellipse; they are complex below the
/// surface and inside the ellipse.
#[inline(always)]
fn tangents(place: &Place) -> [Centre; 2] {
    let Place { half_axes: [a, b], at: [along, across], depth, .. } = *place;
    let inverse = 1.0 / (along * along + across * across).sqrt().max(OFF_MIDDLE);
    let towards = across.atan2(along);
    let mut cosines = [[0.0; LANES]; 2];
    cosines[0].fill(inverse.min(1.0));
    let mut sides = arc_cosines(&cosines);
    // The dependence of R on the angle is weak.
    for _ in 0..2 {
        let phi = std::array::from_fn(|lane| towards + SIDES[lane % 2] * sides[0][lane]);
        let [sin, cos] = sines_and_cosines(&phi);
        for lane in 0..LANES {
            let (x, y) = (cos[lane] / a, sin[lane] / b);
            (cosines[0][lane], cosines[1][lane]) = (inverse, depth * inverse * (x * x + y * y).sqrt());
        }
        sides = arc_cosines(&cosines);
    }
    [0, 1].map(|side| Centre { at: towards + SIDES[side] * sides[0][side], width: sides[1][side] })
}

/// The tangents on either side of the direction from the middle to the point.
const SIDES: [f64; 2] = [-1.0, 1.0];

/// Inverse hyperbolic sines of positive numbers.
#[inline(always)]
fn inverse_hyperbolic_sines(values: &Lanes) -> Lanes {
    let mut sums = [0.0; LANES];
    for i in 0..LANES {
        sums[i] = values[i] + (values[i] * values[i] + 1.0).sqrt();
    }
    logarithms(&sums)
}

/// Real parts of the arc cosines of complex numbers, and the magnitudes of their imaginary parts.
#[inline(always)]
fn arc_cosines([xs, ys]: &[Lanes; 2]) -> [Lanes; 2] {
    let (mut sines, mut cosines, mut sums) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        let (x, y) = (xs[i].abs(), ys[i]);
        let square = y * y;
        let (ahead, behind) = (x + 1.0, x - 1.0);
        let (far, near) = ((ahead * ahead + square).sqrt(), (behind * behind + square).sqrt());
        // Half of far + near − 2, without a difference of nearly equal numbers.
        let below = if x <= 1.0 { near - behind } else { near + behind };
        let share = square / if below > f64::MIN_POSITIVE { below } else { f64::MIN_POSITIVE };
        let excess = 0.5 * (square / (far + ahead) + share) + if x <= 1.0 { 0.0 } else { behind };
        let cosine = 0.5 * (far - near);
        let less = (1.0 - cosine) * (1.0 + cosine);
        (sines[i], cosines[i]) = (if less > 0.0 { less.sqrt() } else { 0.0 }, cosine);
        sums[i] = 1.0 + excess + (excess * (excess + 2.0)).sqrt();
    }
    let (mut reals, imaginaries) = (angles(&sines, &cosines), logarithms(&sums));
    for i in 0..LANES {
        reals[i] = if xs[i] < 0.0 { PI - reals[i] } else { reals[i] };
    }
    [reals, imaginaries]
}

#[cfg(test)]
mod tests {
    use super::*;

    const NU: f64 = 0.3;
    /// Error of the quadrature, MPa: 5e-5 of p₀.
    const QUADRATURE: f64 = 0.05;

    fn wheel(b: f64, friction: f64, lateral_friction: f64) -> EllipticWheel {
        EllipticWheel {
            peak_pressure: 1000.0,
            half_width: 5.0,
            lateral_half_width: b,
            lateral: 0.0,
            friction,
            lateral_friction,
        }
    }

    #[test]
    fn on_the_axis_of_a_circle() {
        for z in [0.01f64, 0.5, 2.5, 5.0, 20.0] {
            let stress = wheel(5.0, 0.0, 0.0).stress(0.0, [0.0, 0.0, z], NU);
            let t = z / 5.0;
            let normal = -1000.0 / (1.0 + t * t);
            let radial = -1000.0 * ((1.0 + NU) * (1.0 - t * (1.0 / t).atan()) + 0.5 * normal / 1000.0);
            assert!((stress[2] - normal).abs() < QUADRATURE, "{z}: {} {normal}", stress[2]);
            assert!((stress[0] - radial).abs() < QUADRATURE, "{z}: {} {radial}", stress[0]);
        }
    }

    #[test]
    fn in_equilibrium() {
        let wheel = wheel(8.0, 0.3, -0.2);
        let h = 1e-3;
        let entry = |i: usize, j: usize| if i == j { i } else { 6 - i - j };
        for point in [[1.0, 2.0, 1.5], [6.0, 3.0, 2.0], [-9.0, 7.0, 4.0], [2.0, -9.0, 1.0]] {
            for i in 0..3 {
                let divergence: f64 = (0..3)
                    .map(|j| {
                        let at = |step: f64| {
                            let mut moved = point;
                            moved[j] += step;
                            wheel.stress(0.0, moved, NU)[entry(i, j)]
                        };
                        (at(h) - at(-h)) / (2.0 * h)
                    })
                    .sum();
                // MPa/mm: the error of the quadrature varies over a tenth of the contact.
                assert!(divergence.abs() < 0.2, "{point:?} {i}: {divergence}");
            }
        }
    }

    #[test]
    fn slender_ellipses_press_as_a_line() {
        // σ_zz and σ_xx below the middle of the line contact (Johnson 1985, 4.49). σ_xx of an
        // ellipse of aspect n differs most at the surface, by (1 − 2ν) p0/(1 + n) (Johnson 1985,
        // 3.64).
        for aspect in [10.0f64, 40.0] {
            let allowed = 1.01 * (1.0 - 2.0 * NU) / (1.0 + aspect);
            for z in [1.0f64, 5.0, 12.0] {
                let stress = wheel(5.0 * aspect, 0.0, 0.0).stress(0.0, [0.0, 0.0, z], NU);
                let m = (25.0 + z * z).sqrt();
                let (xx, zz) = (-200.0 * ((25.0 + 2.0 * z * z) / m - 2.0 * z), -5000.0 / m);
                let off = (stress[2] - zz).abs().max((stress[0] - xx).abs()) / 1000.0;
                assert!(off < allowed + QUADRATURE / 1000.0, "aspect {aspect}, depth {z} mm: {off} p0");
            }
        }
    }

    #[test]
    fn surface_values() {
        let wheel = wheel(8.0, 0.3, 0.1);
        for (x, y) in [(0.0, 0.0), (2.0, 3.0), (-3.0, 4.0)] {
            let s = wheel.stress(0.0, [x, y, 1e-4], NU);
            let p = 1000.0 * (1.0f64 - x * x / 25.0 - y * y / 64.0).sqrt();
            assert!((s[2] + p).abs() < 0.5 && (s[4] + 0.3 * p).abs() < 0.5 && (s[3] + 0.1 * p).abs() < 0.5);
        }
        let s = wheel.stress(0.0, [9.0, 2.0, 1e-5], NU);
        assert!(s[2].abs() < 1e-3 && s[4].abs() < 0.01, "{s:?}");
    }
}
