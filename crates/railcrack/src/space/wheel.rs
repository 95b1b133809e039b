//! Stress of the half-space under an elliptical Hertz contact in full sliding.
//!
//! The point loads of Boussinesq and Cerruti (Johnson 1985, 3.2 and 3.6) are summed over the
//! ellipse in polar coordinates (r, ψ) about the projection of the point on the surface, r = d sinh
//! t with d its depth: the integrand stays smooth down to the surface.

use super::nuclei::Symmetric;
use crate::math::gauss_legendre;
use std::f64::consts::PI;
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
    /// Shear along +x over pressure.
    pub friction: f64,
    /// Shear along the lateral axis over pressure.
    pub lateral_friction: f64,
}

/// Points along and around, by the distance of the point from the contact over its size: the error
/// is at most 4e-4 of p₀ next to the edge, and a tenth of that in the mean.
const ORDERS: [(f64, usize, usize); 6] =
    [(4.0, 6, 12), (1.5, 8, 16), (0.08, 10, 24), (0.02, 12, 28), (0.005, 16, 32), (0.0, 24, 56)];
/// Panels of angles by the aspect of the ellipse: as this power of it.
const PANELS_BY_ASPECT: f64 = 0.9;
/// A point is taken to lie at least this share of a below the surface.
const SHALLOWEST: f64 = 1e-7;

/// Points of one accuracy.
struct Rule {
    /// Along a ray from the middle of the fan: share of the way, and its weight.
    from_middle: Vec<(f64, f64)>,
    /// Along a chord: −1 to 1, and its weight.
    of_chord: Vec<(f64, f64)>,
    around: Vec<(f64, f64)>,
}

fn rules() -> &'static [Rule] {
    static RULES: OnceLock<Vec<Rule>> = OnceLock::new();
    RULES.get_or_init(|| {
        // Square roots at the ends of the chord, and none at the middle of the fan.
        let rule = |&(_, along, around): &(f64, usize, usize)| {
            let along = gauss_legendre(along);
            let ray = |(s, w): &(f64, f64)| {
                let (sin, cos) = (0.5 * PI * s).sin_cos();
                (sin, 0.5 * PI * cos * w)
            };
            let chord = |(s, w): &(f64, f64)| {
                let (sin, cos) = (PI * s).sin_cos();
                (-cos, PI * sin * w)
            };
            Rule {
                from_middle: along.iter().map(ray).collect(),
                of_chord: along.iter().map(chord).collect(),
                around: gauss_legendre(around),
            }
        };
        ORDERS.iter().map(rule).collect()
    })
}

impl EllipticWheel {
    /// The stress (MPa) at x, lateral and depth (mm) of a contact centred at `position` (mm).
    pub fn stress(&self, position: f64, point: [f64; 3], poisson: f64) -> Symmetric {
        let (a, b) = (self.half_width, self.lateral_half_width);
        let (x, y) = (point[0] - position, point[1] - self.lateral);
        let d = point[2].max(SHALLOWEST * a);
        let size = a.min(b);
        let away = ((x.abs() - a).max(0.0).hypot((y.abs() - b).max(0.0)).hypot(d)) / size;
        let rule = &rules()[ORDERS.iter().position(|&(limit, ..)| away >= limit).unwrap_or(ORDERS.len() - 1)];
        let c = (x / a).powi(2) + (y / b).powi(2) - 1.0;
        let mut sum = [0.0; 6];
        // The angles under which the ellipse is seen: all, or a sector.
        let (middle, half) = if c < 0.0 { (0.0, PI) } else { sector(x, y, a, b, c) };
        // A slender ellipse turns its chord quickly: more panels of angles.
        let panels = (a.max(b) / size).powf(PANELS_BY_ASPECT).ceil().max(1.0) as usize;
        let (count, panel) = (rule.around.len(), 1.0 / panels as f64);
        for k in 0..count * panels {
            // All around: equidistant points, symmetric about both axes.
            let (psi, weight) = if c < 0.0 {
                let step = 2.0 * PI * panel / count as f64;
                (step * (k as f64 + 0.5), step)
            } else {
                let (s, w) = rule.around[k % count];
                let angle = PI * (((k / count) as f64 + s) * panel - 0.5);
                (middle + half * angle.sin(), w * panel * half * PI * angle.cos())
            };
            let (sin, cos) = psi.sin_cos();
            let (qa, qb) = (cos * cos / (a * a) + sin * sin / (b * b), x * cos / (a * a) + y * sin / (b * b));
            let root = (qb * qb - qa * c).max(0.0).sqrt();
            let ends = if c < 0.0 { [0.0, (root - qb) / qa] } else { [(-qb - root) / qa, (-qb + root) / qa] };
            if ends[1].is_nan() || ends[1] <= 0.0 {
                continue;
            }
            let [from, to] = ends.map(|r| (r.max(0.0) / d).asinh());
            let (start, reach, along) = if c < 0.0 {
                (0.0, to, &rule.from_middle)
            } else {
                (0.5 * (from + to), 0.5 * (to - from), &rule.of_chord)
            };
            for (s, w) in along {
                let grown = (start + reach * s).exp();
                let (sinh, cosh) = (0.5 * (grown - 1.0 / grown), 0.5 * (grown + 1.0 / grown));
                let r = d * sinh;
                let pressure = (-(qa * r * r + 2.0 * qb * r + c)).max(0.0).sqrt();
                let area = r * d * cosh * reach * w * weight;
                // From the load to the point.
                let load = [-r * cos, -r * sin];
                self.add_point_load(load, d, poisson, pressure * area, &mut sum);
            }
        }
        sum.map(|value| self.peak_pressure * value / (2.0 * PI))
    }

    /// Boussinesq's and Cerruti's stresses times 2π for a force, its shear included.
    fn add_point_load(&self, [x, y]: [f64; 2], z: f64, poisson: f64, force: f64, sum: &mut Symmetric) {
        let rho2 = x * x + y * y + z * z;
        let rho = rho2.sqrt();
        let (i3, far) = (1.0 / (rho2 * rho), 1.0 / (rho + z));
        let i5 = 3.0 * i3 / rho2;
        let free = 1.0 - 2.0 * poisson;
        // The radial part common to all, 3 q x_i x_j / ρ⁵ with q the force along the ray.
        let (qx, qy) = (self.friction, self.lateral_friction);
        let radial = -(z + qx * x + qy * y) * i5;
        let alone = free * (z * i3 - far / rho);
        let product = free * (2.0 * rho + z) * i3 * far * far;
        // Cerruti: (1 − 2ν) [x/ρ³ − …].
        let (one, two) = (far * far / rho, i3 * far * far + 2.0 * far * far * far / rho2);
        let (sx, sy) = (qx * x, qy * y);
        let ahead = sx + sy;
        sum[0] += force
            * (radial * x * x
                + alone
                + product * x * x
                + free * (ahead * i3 - (3.0 * sx + sy) * one + ahead * x * x * two));
        sum[1] += force
            * (radial * y * y
                + alone
                + product * y * y
                + free * (ahead * i3 - (sx + 3.0 * sy) * one + ahead * y * y * two));
        sum[2] += force * radial * z * z;
        sum[3] += force * radial * y * z;
        sum[4] += force * radial * x * z;
        sum[5] += force
            * (radial * x * y + product * x * y + free * (-(qx * y + qy * x) * one + ahead * x * y * two));
    }
}

/// Middle and half of the angle under which the ellipse is seen from a point outside.
fn sector(x: f64, y: f64, a: f64, b: f64, c: f64) -> (f64, f64) {
    let (u, v) = (x / (a * a), y / (b * b));
    // (x · direction)² − c |direction|² in the metric of the ellipse is a quadratic form, zero on
    // the tangents.
    let (m, n, l) = (u * u - c / (a * a), u * v, v * v - c / (b * b));
    let (mean, difference) = (0.5 * (m + l), (0.5 * (m - l)).hypot(n));
    let axis = 0.5 * (2.0 * n).atan2(m - l);
    let half = ((mean + difference).max(0.0) / (difference - mean).max(f64::MIN_POSITIVE)).sqrt().atan();
    // Towards the ellipse.
    let towards = u * axis.cos() + v * axis.sin() < 0.0;
    (if towards { axis } else { axis + PI }, half)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NU: f64 = 0.3;
    /// Error of the quadrature, MPa: 1e-4 of p₀.
    const QUADRATURE: f64 = 0.1;

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
