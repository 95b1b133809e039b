//! Stress under an elliptical contact against the equations of elasticity and against point forces.

use crate::common::{Of, close};
use railcrack::math::gauss_legendre;
use railcrack::space::{EllipticWheel, Symmetric};
use std::f64::consts::PI;

const NU: f64 = 0.3;
/// Step of the second differences, mm.
const STEP: f64 = 0.1;

/// Beltrami's and Michell's equations, ∇²σ_ij + ∂_i ∂_j σ_kk / (1 + ν) = 0: with equilibrium, the
/// tractions of the surface and no stress far away they leave one field, for any pressure and
/// shear.
#[test]
fn compatible_under_pressure_and_shear() {
    let wheel = EllipticWheel {
        peak_pressure: 1000.0,
        half_width: 5.0,
        lateral_half_width: 8.0,
        lateral: 0.5,
        friction: 0.3,
        lateral_friction: -0.2,
    };
    let components = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];
    for point in [[1.0, 2.0, 2.5], [6.0, 3.0, 3.0], [-9.0, 7.0, 4.0], [2.0, -9.0, 3.0]] {
        let at = |i: usize, j: usize, one: f64, other: f64| {
            let mut moved = point;
            moved[i] += one * STEP;
            moved[j] += other * STEP;
            wheel.stress(0.0, moved, NU)
        };
        // ∂_i ∂_j of all components.
        let second = |i: usize, j: usize| -> [f64; 6] {
            let (pp, pm, mp, mm) =
                (at(i, j, 1.0, 1.0), at(i, j, 1.0, -1.0), at(i, j, -1.0, 1.0), at(i, j, -1.0, -1.0));
            std::array::from_fn(|c| (pp[c] - pm[c] - mp[c] + mm[c]) / (4.0 * STEP * STEP))
        };
        let laplacian: [f64; 6] = std::array::from_fn(|c| (0..3).map(|i| second(i, i)[c]).sum());
        let of_trace: [f64; 6] = components.map(|(i, j)| second(i, j)[..3].iter().sum::<f64>() / (1.0 + NU));
        let scale = of_trace.iter().chain(&laplacian).fold(0.0f64, |m, v| m.max(v.abs()));
        for c in 0..6 {
            close(laplacian[c] + of_trace[c], 0.0, Of(0.006, scale), "second differences over 0.2 mm");
        }
    }
}

/// Boussinesq's and Cerruti's stresses (Johnson 1985, 3.2 and 3.6) times 2π for a unit force down,
/// with `shear` along x and y, at x, y and depth relative to it.
fn point_force(shear: [f64; 2], [x, y, z]: [f64; 3]) -> Symmetric {
    let rho2 = x * x + y * y + z * z;
    let rho = rho2.sqrt();
    let (i3, far) = (1.0 / (rho2 * rho), 1.0 / (rho + z));
    let free = 1.0 - 2.0 * NU;
    // 3 q x_i x_j / ρ⁵ with q the force along the ray.
    let radial = -(z + shear[0] * x + shear[1] * y) * 3.0 * i3 / rho2;
    let (alone, product) = (free * (z * i3 - far / rho), free * (2.0 * rho + z) * i3 * far * far);
    let (one, two) = (far * far / rho, i3 * far * far + 2.0 * far * far * far / rho2);
    let (sx, sy) = (shear[0] * x, shear[1] * y);
    let side = |own: f64, other: f64, square: f64| {
        let sheared = (own + other) * i3 - (3.0 * own + other) * one + (own + other) * square * two;
        (radial + product) * square + alone + free * sheared
    };
    let across = -(shear[0] * y + shear[1] * x) * one + (sx + sy) * x * y * two;
    [
        side(sx, sy, x * x),
        side(sy, sx, y * y),
        radial * z * z,
        radial * y * z,
        radial * x * z,
        (radial + product) * x * y + free * across,
    ]
}

/// Points along a ray and around, of the sum of point forces.
const RAY: usize = 80;
const AROUND: usize = 600;

/// Point forces over the ellipse in polar coordinates (r, ψ) about the projection of a point that
/// lies inside, r = d sinh t with d its depth.
fn summed(wheel: &EllipticWheel, [x, y, d]: [f64; 3]) -> Symmetric {
    let (a, b) = (wheel.half_width, wheel.lateral_half_width);
    let rule = gauss_legendre(RAY);
    let mut sum = [0.0; 6];
    for k in 0..AROUND {
        let step = 2.0 * PI / AROUND as f64;
        let (sin, cos) = (step * (k as f64 + 0.5)).sin_cos();
        // The pressure is p₀ √(−(A r² + 2 B r + C)) on the ray.
        let second = (cos / a).powi(2) + (sin / b).powi(2);
        let first = x * cos / (a * a) + y * sin / (b * b);
        let none = (x / a).powi(2) + (y / b).powi(2) - 1.0;
        let end = ((first * first - second * none).sqrt() - first) / second;
        let reach = (end / d).asinh();
        for (s, w) in &rule {
            // A square root at the end.
            let (sine, cosine) = (0.5 * PI * s).sin_cos();
            let t = reach * sine;
            let r = d * t.sinh();
            let pressure = (-(second * r * r + 2.0 * first * r + none)).max(0.0).sqrt();
            let area = r * d * t.cosh() * reach * 0.5 * PI * cosine * w * step;
            let shear = [wheel.friction, wheel.lateral_friction];
            let stress = point_force(shear, [-r * cos, -r * sin, d]);
            (0..6).for_each(|c| sum[c] += pressure * area * stress[c]);
        }
    }
    sum.map(|value| wheel.peak_pressure * value / (2.0 * PI))
}

#[test]
fn of_point_forces_under_the_contact() {
    for (b, limit) in [(6.0, 5e-5), (3.0, 5e-5), (12.0, 5e-5), (48.0, 3e-4)] {
        let wheel = EllipticWheel {
            peak_pressure: 1.0,
            half_width: 6.0,
            lateral_half_width: b,
            lateral: 0.0,
            friction: 0.3,
            lateral_friction: -0.2,
        };
        for (along, across) in
            [(0.0, 0.0), (0.3, -0.2), (-0.6, 0.5), (0.95, 0.2), (0.1, -0.97), (-0.7, -0.69)]
        {
            for depth in [0.01, 0.1, 1.0, 4.0, 15.0] {
                let point = [6.0 * along, b * across, depth];
                let (got, want) = (wheel.stress(0.0, point, NU), summed(&wheel, point));
                for c in 0..6 {
                    let reason = "waves of all directions against point forces";
                    close(got[c], want[c], Of(limit, 1.0), reason);
                }
            }
        }
    }
}
