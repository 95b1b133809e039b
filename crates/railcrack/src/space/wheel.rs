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

use super::nuclei::Symmetric;
use crate::load::HertzEllipse;
use crate::math::gauss_legendre;
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
/// |w|² above which series in 1/w replace the logarithms, and the last term of these series.
const FAR: f64 = 64.0;
const LAST_TERM: u32 = 15;

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

/// A point relative to the contact: x/a, y/b and its depth (mm).
#[derive(Debug, Clone, Copy)]
struct Place {
    along: f64,
    across: f64,
    depth: f64,
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
        let place = Place {
            along: (point[0] - position) / self.half_width,
            across: (point[1] - self.lateral) / self.lateral_half_width,
            depth: point[2].max(SHALLOWEST * self.half_width),
        };
        let bend = self.bend();
        let tangents = self.tangents(&place);
        let from_bend = |c: &Centre| (c.at - bend.at + FRAC_PI_2).rem_euclid(PI) - FRAC_PI_2;
        let mut centres = [tangents[0], tangents[1], bend];
        let is_alone = tangents.iter().all(|c| from_bend(c).abs() > APART * bend.width);
        let count = if is_alone { 3 } else { 2 };
        let centres = &mut centres[..count];
        centres.iter_mut().for_each(|c| c.at = c.at.rem_euclid(PI));
        centres.sort_by(|one, other| one.at.total_cmp(&other.at));
        let mut sum = [0.0; 6];
        // The integrand has the period π. The part of each angle extends to the midpoints between
        // it and its neighbours.
        for (k, c) in centres.iter().enumerate() {
            let before = if k > 0 { centres[k - 1].at } else { centres[count - 1].at - PI };
            let after = if k + 1 < count { centres[k + 1].at } else { centres[0].at + PI };
            let width = c.width.min(WIDEST);
            let [from, to] = [before, after].map(|at| (0.5 * (at - c.at) / width).asinh());
            let reach = to - from;
            if reach <= 0.0 {
                continue;
            }
            // Logarithm of the sum of the semi-axes of the ellipse that has the interval's ends as
            // foci and passes through a singular point.
            let decay = |[at, off_axis]: [f64; 2]| {
                arc_cosine([(2.0 * at - from - to) / reach, 2.0 * off_axis / reach])[1]
            };
            let mut slowest = decay([0.0, FRAC_PI_2]);
            if !is_alone {
                let x = -from_bend(c) / width;
                let [real, imaginary] = arc_cosine([bend.width / width, x]);
                slowest = slowest.min(decay([imaginary.copysign(x), FRAC_PI_2 - real]));
            }
            let points = (0.5 * DIGITS / slowest).ceil() as usize + 1;
            for (share, weight) in rule(points.clamp(POINTS[0], POINTS[1])) {
                let grown = (from + reach * share).exp();
                let (sinh, cosh) = (0.5 * (grown - 1.0 / grown), 0.5 * (grown + 1.0 / grown));
                let weight = weight * reach * width * cosh;
                self.add_direction(c.at + width * sinh, weight, &place, poisson, &mut sum);
            }
        }
        sum.map(|value| self.peak_pressure * value / PI)
    }

    /// 1/R (per mm) at the parametric angle with this sine and cosine, and its parts along x and y.
    fn wave([sin, cos]: [f64; 2], half_axes: [f64; 2]) -> (f64, [f64; 2]) {
        let parts = [cos / half_axes[0], sin / half_axes[1]];
        ((parts[0] * parts[0] + parts[1] * parts[1]).sqrt(), parts)
    }

    /// Where R of a slender ellipse bends.
    fn bend(&self) -> Centre {
        let (a, b) = (self.half_width, self.lateral_half_width);
        let width = (a.min(b) / a.max(b)).atanh().min(10.0);
        Centre { at: if b > a { FRAC_PI_2 } else { 0.0 }, width }
    }

    /// The angles at which a line through the point touches the ellipse; they are complex below the
    /// surface and inside the ellipse.
    fn tangents(&self, place: &Place) -> [Centre; 2] {
        let inverse = 1.0 / place.along.hypot(place.across).max(OFF_MIDDLE);
        let towards = place.across.atan2(place.along);
        [-1.0, 1.0].map(|sign| {
            let mut angle = [inverse.min(1.0).acos(), 0.0];
            // The dependence of R on the angle is weak.
            for _ in 0..2 {
                let (sin, cos) = (towards + sign * angle[0]).sin_cos();
                let (wave, _) = Self::wave([sin, cos], [self.half_width, self.lateral_half_width]);
                angle = arc_cosine([inverse, place.depth * wave * inverse]);
            }
            Centre { at: towards + sign * angle[0], width: angle[1] }
        })
    }

    /// Adds the contribution of the waves of the parametric angle `phi`.
    fn add_direction(&self, phi: f64, weight: f64, place: &Place, poisson: f64, sum: &mut Symmetric) {
        let (sin, cos) = phi.sin_cos();
        let (wave, [x, y]) = Self::wave([sin, cos], [self.half_width, self.lateral_half_width]);
        let (c, s) = (x / wave, y / wave);
        let depth = place.depth * wave;
        let ([j, ji], [k, ki]) = waves_of_hertz([depth, -(place.along * cos + place.across * sin)]);
        let (k, ki) = (depth * k, depth * ki);
        // Shear along and across the direction.
        let along = self.friction * c + self.lateral_friction * s;
        let across = self.lateral_friction * c - self.friction * s;
        // Pressure, then shear: plane strain with the depth and the direction, antiplane shear.
        let uu = -(j - k) - along * (2.0 * ji - ki);
        let vv = -2.0 * poisson * (j + along * ji);
        let uz = -ki - along * (j - k);
        let (vz, uv) = (-across * j, -across * ji);
        sum[0] += weight * (c * c * uu + s * s * vv - 2.0 * c * s * uv);
        sum[1] += weight * (s * s * uu + c * c * vv + 2.0 * c * s * uv);
        sum[2] -= weight * (j + k + along * ki);
        sum[3] += weight * (s * uz + c * vz);
        sum[4] += weight * (c * uz - s * vz);
        sum[5] += weight * (c * s * (uu - vv) + (c * c - s * s) * uv);
    }
}

type Complex = [f64; 2];

fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

/// 1 − w arccot w and minus its derivative, arccot w − w/(1 + w²), of Re w > 0.
fn waves_of_hertz(w: Complex) -> (Complex, Complex) {
    let [re, im] = w;
    let size = re * re + im * im;
    if size < FAR {
        let (above, below) = (re * re + (1.0 - im) * (1.0 - im), re * re + (1.0 + im) * (1.0 + im));
        let arccot = [0.5 * (2.0 * re).atan2(size - 1.0), 0.25 * (above / below).ln()];
        let product = times(w, arccot);
        // w / (1 + w²); the squared modulus of the divisor is above · below.
        let share = 1.0 / (above * below);
        let quotient = times(w, [1.0 + re * re - im * im, -2.0 * re * im]).map(|value| share * value);
        return ([1.0 - product[0], -product[1]], [arccot[0] - quotient[0], arccot[1] - quotient[1]]);
    }
    let inverse = [re / size, -im / size];
    let square = times(inverse, inverse);
    let (mut one, mut two) = ([0.0; 2], [0.0; 2]);
    for term in (3..=LAST_TERM).rev().step_by(2) {
        let odd = f64::from(term);
        let next = |sum: Complex, first: f64| {
            let [re, im] = times(sum, square);
            [first - re, -im]
        };
        (one, two) = (next(one, 1.0 / odd), next(two, (odd - 1.0) / odd));
    }
    (times(one, square), times(times(two, square), inverse))
}

/// Real part of the arc cosine of a complex number, and the magnitude of its imaginary part.
fn arc_cosine([x, y]: Complex) -> [f64; 2] {
    let mirrored = x.abs();
    let (far, near) = ((mirrored + 1.0).hypot(y), (mirrored - 1.0).hypot(y));
    // Half of far + near − 2, without a difference of nearly equal numbers.
    let beyond = y * y / (far + mirrored + 1.0);
    let excess = if mirrored <= 1.0 {
        0.5 * (beyond + y * y / (near + 1.0 - mirrored).max(f64::MIN_POSITIVE))
    } else {
        mirrored - 1.0 + 0.5 * (beyond + y * y / (near + mirrored - 1.0))
    };
    let real = (0.5 * (far - near)).clamp(-1.0, 1.0).acos();
    [if x < 0.0 { PI - real } else { real }, (excess * (excess + 2.0)).sqrt().asinh()]
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
