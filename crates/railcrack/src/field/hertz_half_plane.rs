//! The half-plane under a Hertzian contact with friction, in closed form.

use crate::load::HertzianContact;
use crate::math::{Stress, Vec2};
use pulp::{Arch, Simd, WithSimd};

/// The stress of the half-plane y ≤ 0 under a Hertzian contact, prepared for many points and
/// positions.
///
/// With z = (x − x_c + i y)/a, s = √(z² − 1) (s ≈ z far away) and the Cauchy transform of the
/// pressure W = s − z = −1/(s + z), the potential of the traction t = (μ, −1) p is Φ = (μ − i) W /
/// 2 and its derivative has W′ = −W/s. Continued across the surface, Φ gives
///
/// σ_xx + σ_yy = 4 Re Φ,  σ_yy − i σ_xy = Φ(z) − Φ(z̄) + (z − z̄) conj Φ′(z),  σ_zz = ν (σ_xx +
/// σ_yy)
///
/// (Muskhelishvili, Some Basic Problems of the Mathematical Theory of Elasticity, §§ 93 and 112;
/// Johnson, Contact Mechanics, 4.49 and 7.8, has real forms on the axis and surface).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzField {
    peak_pressure: f64,
    per_half_width: f64,
    friction: f64,
    poisson: f64,
}

impl HertzField {
    /// The field of `contact` in a rail with ν = `poisson`.
    pub fn new(contact: &HertzianContact, poisson: f64) -> Self {
        Self {
            peak_pressure: contact.peak_pressure,
            per_half_width: 1.0 / contact.half_width,
            friction: contact.friction,
            poisson,
        }
    }

    /// The stress (MPa) at `point` (mm) for a contact centred at `xc` (mm); on the surface, the
    /// limit from inside. A point above the surface is moved onto it.
    #[inline(always)]
    pub fn stress(&self, point: Vec2, xc: f64) -> Stress {
        let x = (point.x - xc) * self.per_half_width;
        let y = (point.y * self.per_half_width).min(0.0);
        let Transform { w_re, w_im, slope_re, slope_im } = Transform::of(x, y);
        let mu = self.friction;
        let trace = 2.0 * (mu * w_re + w_im);
        let yy = w_im + mu * slope_im - slope_re;
        let xy = -mu * w_im - (slope_im + mu * slope_re);
        let p0 = self.peak_pressure;
        Stress { xx: p0 * (trace - yy), yy: p0 * yy, zz: p0 * self.poisson * trace, xy: p0 * xy }
    }
}

/// W = s − z and y W′ at z = x + i y.
pub(super) struct Transform {
    pub(super) w_re: f64,
    pub(super) w_im: f64,
    pub(super) slope_re: f64,
    pub(super) slope_im: f64,
}

impl Transform {
    #[inline(always)]
    pub(super) fn of(x: f64, y: f64) -> Self {
        let Root { re: s_re, im: s_im, modulus } = Root::of(x, y);
        // W = −1/(s + z): s − z would cancel far away.
        let (sum_re, sum_im) = (s_re + x, s_im + y);
        let per_sum = 1.0 / (sum_re * sum_re + sum_im * sum_im);
        let (w_re, w_im) = (-sum_re * per_sum, sum_im * per_sum);
        // y W′ = −W y/s, with |s|² = `modulus`.
        let depth_over_s = y / modulus.max(f64::MIN_POSITIVE);
        let slope_re = -(w_re * s_re + w_im * s_im) * depth_over_s;
        let slope_im = -(w_im * s_re - w_re * s_im) * depth_over_s;
        Self { w_re, w_im, slope_re, slope_im }
    }
}

/// Number of points whose stress is computed simultaneously.
const LANES: usize = 8;

/// A field that is computed at several points simultaneously.
pub(super) trait Lanes {
    /// The stress (MPa) at `point` (mm) with the wheel at `xc` (mm), inlined into the loop over
    /// points.
    fn at(&self, point: Vec2, xc: f64) -> Stress;
}

impl Lanes for HertzField {
    #[inline(always)]
    fn at(&self, point: Vec2, xc: f64) -> Stress {
        self.stress(point, xc)
    }
}

/// The stresses of `field` at many points (mm), with the same bits as point by point.
pub(super) fn side_by_side(field: &impl Lanes, points: &[Vec2], xc: f64) -> Vec<Stress> {
    let mut stresses = vec![Stress::ZERO; points.len()];
    Arch::new().dispatch(Stresses { field, points, xc, stresses: &mut stresses });
    stresses
}

impl HertzField {
    /// [`HertzField::stress`] at many points (mm), with the same bits as point by point.
    pub(crate) fn stresses(&self, points: &[Vec2], xc: f64) -> Vec<Stress> {
        side_by_side(self, points, xc)
    }
}

struct Stresses<'a, F> {
    field: &'a F,
    points: &'a [Vec2],
    xc: f64,
    stresses: &'a mut [Stress],
}

impl<F: Lanes> WithSimd for Stresses<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { field, points, xc, stresses } = self;
        let (blocks, rest) = points.as_chunks::<LANES>();
        let (results, last) = stresses.as_chunks_mut::<LANES>();
        for (points, results) in blocks.iter().zip(results) {
            let (mut xx, mut yy, mut zz, mut xy) = ([0.0; LANES], [0.0; LANES], [0.0; LANES], [0.0; LANES]);
            let (x, y) = (points.map(|point| point.x), points.map(|point| point.y));
            for k in 0..LANES {
                let stress = field.at(Vec2::new(x[k], y[k]), xc);
                (xx[k], yy[k], zz[k], xy[k]) = (stress.xx, stress.yy, stress.zz, stress.xy);
            }
            for (k, result) in results.iter_mut().enumerate() {
                *result = Stress { xx: xx[k], yy: yy[k], zz: zz[k], xy: xy[k] };
            }
        }
        rest.iter().zip(last).for_each(|(point, result)| *result = field.at(*point, xc));
    }
}

/// s = √(z² − 1) in the quadrant of z = x + i y, y ≤ 0, and |s|².
pub(super) struct Root {
    pub(super) re: f64,
    pub(super) im: f64,
    pub(super) modulus: f64,
}

impl Root {
    /// The larger of |Re s|, |Im s| by the square root of a sum without cancellation, the other by
    /// division. Im s ≤ 0 selects the lower side of the cut under the contact.
    #[inline(always)]
    pub(super) fn of(x: f64, y: f64) -> Self {
        let (ahead, behind, y2) = (x - 1.0, x + 1.0, y * y);
        let real = ahead * behind - y2;
        let modulus = ((ahead * ahead + y2) * (behind * behind + y2)).sqrt();
        // At an edge s = 0: the floor keeps 0/0 out, and y/s → 0 there.
        let larger = (0.5 * (modulus + real.abs())).sqrt().max(f64::MIN_POSITIVE);
        let smaller = (x * y).abs() / larger;
        let (re, im) = if real >= 0.0 { (larger, -smaller) } else { (smaller, -larger) };
        Self { re: re.copysign(x), im, modulus }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hertz_stress(contact: &HertzianContact, poisson: f64, point: Vec2, xc: f64) -> Stress {
        HertzField::new(contact, poisson).stress(point, xc)
    }
    use crate::math::gauss_legendre;
    use std::f64::consts::PI;

    const CONTACT: HertzianContact =
        HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.4 };
    const POISSON: f64 = 0.3;
    const XC: f64 = 2.5;

    fn at(x_over_a: f64, y_over_a: f64) -> Stress {
        let point = Vec2::new(XC + x_over_a * CONTACT.half_width, y_over_a * CONTACT.half_width);
        hertz_stress(&CONTACT, POISSON, point, XC)
    }

    /// Superposed point loads (Flamant): a force F per length on the surface of a half-plane gives
    /// σ = −2 (F·r) r ⊗ r / (π r⁴). Abscissa t = a sin φ; panels halve until shorter than their
    /// distance.
    fn flamant(point: Vec2) -> Stress {
        let rule = gauss_legendre(24);
        let a = CONTACT.half_width;
        let mut pending = vec![(-0.5 * PI, 0.5 * PI)];
        let mut sum = Stress::ZERO;
        while let Some((from, to)) = pending.pop() {
            let middle = 0.5 * (from + to);
            let distance = (point - Vec2::new(XC + a * middle.sin(), 0.0)).length();
            if a * (to - from) > distance {
                pending.extend([(from, middle), (middle, to)]);
                continue;
            }
            for &(t, weight) in &rule {
                let phi = from + t * (to - from);
                let force = CONTACT.peak_pressure * a * phi.cos().powi(2) * weight * (to - from);
                let r = point - Vec2::new(XC + a * phi.sin(), 0.0);
                let radial =
                    Vec2::new(CONTACT.friction * force, -force).dot(r) * -2.0 / (PI * r.dot(r).powi(2));
                let (xx, yy) = (radial * r.x * r.x, radial * r.y * r.y);
                sum = sum + Stress { xx, yy, zz: POISSON * (xx + yy), xy: radial * r.x * r.y };
            }
        }
        sum
    }

    fn largest_component(s: Stress) -> f64 {
        s.xx.abs().max(s.yy.abs()).max(s.zz.abs()).max(s.xy.abs())
    }

    #[test]
    fn equals_superposed_point_loads() {
        // Round-off of the reference near the surface, where point loads of 1/depth cancel.
        const TOLERANCE: f64 = 1e-10;
        let mut worst = 0.0_f64;
        for y in [-1e-3, -0.01, -0.1, -0.3, -0.78, -1.5, -4.0, -30.0, -1000.0] {
            for i in -30..=30 {
                let x = 0.13 * f64::from(i) * f64::max(1.0, -0.5 * y);
                let point = Vec2::new(XC + x * CONTACT.half_width, y * CONTACT.half_width);
                let error = largest_component(at(x, y) - flamant(point)) / CONTACT.peak_pressure;
                worst = worst.max(error);
                assert!(error < TOLERANCE, "x/a {x}, y/a {y}: {error:e}");
            }
        }
        println!("largest difference / p0: {worst:e}");
    }

    #[test]
    fn many_points_have_the_bits_of_one() {
        let point = |i: usize| Vec2::new(0.7 * i as f64 - 8.0, -0.3 * ((i * i) % 11) as f64);
        let points: Vec<Vec2> = (0..29).map(point).collect();
        let field = HertzField::new(&CONTACT, POISSON);
        let one_by_one: Vec<Stress> = points.iter().map(|&point| field.stress(point, XC)).collect();
        assert_eq!(field.stresses(&points, XC), one_by_one);
    }

    #[test]
    fn far_away_the_relative_accuracy_stays() {
        // Round-off of 400 summed terms; a difference s − z would have lost ten digits here.
        const TOLERANCE: f64 = 1e-12;
        for angle in [-0.2, -1.0, -1.5, -2.2, -3.0_f64] {
            let point = Vec2::new(XC, 0.0) + Vec2::unit(angle) * (1e5 * CONTACT.half_width);
            let want = flamant(point);
            let got = hertz_stress(&CONTACT, POISSON, point, XC);
            let error = largest_component(got - want) / largest_component(want);
            assert!(error < TOLERANCE, "angle {angle}: {error:e}");
        }
    }

    #[test]
    fn surface_carries_the_contact_traction_and_the_known_sxx() {
        // Johnson 7.8: σ_xx = −p − 2 μ p0 x/a under the contact, the sign of the last term from t_x
        // = +μ p. A few round-offs of p0; outside, (√(x²−1) − |x|) is compared with its stable
        // form.
        const TOLERANCE: f64 = 4e-15;
        let (p0, mu) = (CONTACT.peak_pressure, CONTACT.friction);
        for i in -400..=400 {
            let x = 0.01 * f64::from(i);
            let pressure = if x.abs() < 1.0 { p0 * (1.0 - x * x).sqrt() } else { 0.0 };
            let spread = if x.abs() < 1.0 { x } else { x - x.signum() * (x * x - 1.0).sqrt() };
            for y in [0.0, -0.0] {
                let s = at(x, y);
                let want = Stress {
                    xx: -pressure - 2.0 * mu * p0 * spread,
                    yy: -pressure,
                    zz: POISSON * (-2.0 * pressure - 2.0 * mu * p0 * spread),
                    xy: mu * pressure,
                };
                // √(1 − x²) turns a rounding of x at the edge into its square root.
                let edge = 3e-8 * f64::from(u8::from((x.abs() - 1.0).abs() < 1e-12));
                let error = largest_component(s - want) / p0;
                assert!(error < TOLERANCE + edge, "x/a {x}: {error:e}");
            }
        }
    }

    #[test]
    fn trailing_edge_of_a_braked_wheel_is_in_tension() {
        let two_mu_p0 = 2.0 * CONTACT.friction * CONTACT.peak_pressure;
        let unit = HertzianContact { half_width: 1.0, ..CONTACT };
        let behind = hertz_stress(&unit, POISSON, Vec2::new(-1.0, 0.0), 0.0);
        let ahead = hertz_stress(&unit, POISSON, Vec2::new(1.0, 0.0), 0.0);
        assert_eq!((behind.xx, ahead.xx), (two_mu_p0, -two_mu_p0));
        assert_eq!([behind.yy, behind.xy, ahead.yy, ahead.xy].map(f64::abs), [0.0; 4]);
    }

    #[test]
    fn is_in_equilibrium() {
        // Central differences of a step 1e-4 a: truncation 1e-8 times third derivatives, round-off
        // 1e-12.
        const TOLERANCE: f64 = 1e-6;
        let h = 1e-4;
        for (x, y) in [(0.3, -0.2), (-0.9, -0.15), (1.05, -0.3), (2.0, -1.0), (-3.0, -0.1), (0.0, -0.8)] {
            let dx = (at(x + h, y) - at(x - h, y)) * (0.5 / h / CONTACT.peak_pressure);
            let dy = (at(x, y + h) - at(x, y - h)) * (0.5 / h / CONTACT.peak_pressure);
            assert!((dx.xx + dy.xy).abs() < TOLERANCE, "x/a {x}, y/a {y}: {}", dx.xx + dy.xy);
            assert!((dx.xy + dy.yy).abs() < TOLERANCE, "x/a {x}, y/a {y}: {}", dx.xy + dy.yy);
        }
    }

    #[test]
    fn a_semicircle_carries_the_whole_load() {
        const TOLERANCE: f64 = 1e-12; // round-off; the rule resolves a smooth integrand
        let radius = 50.0;
        let mut force = Vec2::default();
        for &(t, weight) in &gauss_legendre(60) {
            let normal = Vec2::unit(-PI * t);
            let s = at(radius * normal.x, radius * normal.y);
            force = force + s.traction(normal) * (weight * PI * radius * CONTACT.half_width);
        }
        let load = CONTACT.line_load();
        let sum = force + Vec2::new(CONTACT.friction, -1.0) * load;
        assert!(sum.length() < TOLERANCE * load, "unbalanced {sum:?} of {load}");
    }
}
