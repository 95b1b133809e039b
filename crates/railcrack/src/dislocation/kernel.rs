//! Interaction of two edge dislocations in the half-plane y ≤ 0 with a traction-free surface.

use crate::math::Vec2;

/// The 2 × 2 interaction of unit dislocations: `[xx, xy, yx, yy]`, first index the Burgers vector at z.
pub type Interaction = [f64; 4];

/// Energy of interaction of unit dislocations at `z` and `z0` (mm), in units of E′/(8π) per mm² of Burgers vectors.
///
/// With the Kolosov–Muskhelishvili potentials φ0 = γ log(z − z0), ψ0 = γ̄ log(z − z0) − γ z̄0/(z − z0) of a
/// dislocation (b_x + i b_y = 8π i γ/E′) and their images φ1 = −(z φ̄0′ + ψ̄0), ψ1 = −(φ̄0 + z φ1′) that free
/// y = 0 of traction, the resultant force over a line from the surface to z is F = φ + z φ̄′ + ψ̄ = γ P + γ̄ Q,
/// P = log(|z−z0|²/|z−z̄0|²) − 4 y y0/(z̄−z0)²,  Q = (z−z0)/(z̄−z̄0) − (z−z0)/(z−z̄0) − 2 i y/(z̄−z0).
/// It vanishes with z or z0 on the surface. Moving a second dislocation b′ in from the surface costs
/// b′_x Im F − b′_y Re F. (Muskhelishvili 1953, §§ 41, 90–93.)
#[inline]
pub fn interaction(z: Vec2, z0: Vec2) -> Interaction {
    let (dx, dy) = (z.x - z0.x, z.y - z0.y);
    let distance2 = dx * dx + dy * dy;
    let inverse = 1.0 / distance2;
    // (z − z0)/(z̄ − z̄0): the direction squared.
    let (ex, ey) = ((dx * dx - dy * dy) * inverse, 2.0 * dx * dy * inverse);
    let mut pair = image_interaction(z, z0);
    let log = distance2.ln();
    pair[0] += ex - log;
    pair[1] += ey;
    pair[2] += ey;
    pair[3] += -ex - log;
    pair
}

/// The share of the free surface in [`interaction`]: all but −log|z−z0|² and (z−z0)/(z̄−z̄0); smooth where z meets z0
/// below the surface.
#[inline]
pub fn image_interaction(z: Vec2, z0: Vec2) -> Interaction {
    // m = z̄ − z0.
    let (mx, my) = (z.x - z0.x, -z.y - z0.y);
    let (dx, dy) = (z.x - z0.x, z.y - z0.y);
    let m2 = mx * mx + my * my;
    let inverse = 1.0 / m2;
    let log = -m2.ln();
    // 4 y y0 / m² = 4 y y0 m̄² / |m|⁴.
    let scale = 4.0 * z.y * z0.y * inverse * inverse;
    let (px, py) = (log - scale * (mx * mx - my * my), scale * 2.0 * mx * my);
    // −(z−z0) m/|m|² − 2 i y m̄/|m|²; (z − z̄0) is the conjugate of m.
    let qx = (-(dx * mx - dy * my) - 2.0 * z.y * my) * inverse;
    let qy = (-(dx * my + dy * mx) - 2.0 * z.y * mx) * inverse;
    [qx - px, py + qy, qy - py, -(px + qx)]
}

/// −log|z−z0|² and (z−z0)/(z̄−z̄0) when both lie on one straight line of direction `tangent`: the second is constant.
/// Returns it as an [`Interaction`] without the logarithm.
pub fn collinear_constant(tangent: Vec2) -> Interaction {
    let (ex, ey) = (tangent.x * tangent.x - tangent.y * tangent.y, 2.0 * tangent.x * tangent.y);
    [ex, ey, ey, -ex]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stress of a unit dislocation from second differences of the resultant force: F = Φ_x + i Φ_y.
    fn airy_gradient(z: Vec2, z0: Vec2, burgers: usize) -> Vec2 {
        let e = interaction(z, z0);
        // Row x of the interaction is Im F = Φ_y, row y is −Re F = −Φ_x.
        Vec2::new(-e[2 + burgers], e[burgers])
    }

    /// Distance to the dislocation or its image: the length over which the field varies.
    fn distance(z: Vec2, z0: Vec2) -> f64 {
        (z - z0).length().min((z - Vec2::new(z0.x, -z0.y)).length())
    }

    /// Central difference of fourth order of `value` over the step `h` around 0.
    fn slope<const N: usize>(value: impl Fn(f64) -> [f64; N], h: f64) -> [f64; N] {
        let (near, far) = ([value(h), value(-h)], [value(2.0 * h), value(-2.0 * h)]);
        std::array::from_fn(|i| (8.0 * (near[0][i] - near[1][i]) - (far[0][i] - far[1][i])) / (12.0 * h))
    }

    /// σxx, σyy, σxy. Differences over 1e-3 of the distance: truncation and round-off of 1e-12 of the stress 1/distance.
    fn stress(z: Vec2, z0: Vec2, burgers: usize) -> [f64; 3] {
        const ROUND_OFF: f64 = 1e-9;
        let near = distance(z, z0);
        let gradient = |z: Vec2| {
            let g = airy_gradient(z, z0, burgers);
            [g.x, g.y]
        };
        let along_x = slope(|t| gradient(z + Vec2::new(t, 0.0)), 1e-3 * near);
        let along_y = slope(|t| gradient(z + Vec2::new(0.0, t)), 1e-3 * near);
        assert!((along_x[1] - along_y[0]).abs() < ROUND_OFF / near, "the gradient is curl free: equilibrium");
        [along_y[1], along_x[0], -along_x[1]]
    }

    const POINTS: [Vec2; 4] =
        [Vec2::new(0.3, -0.7), Vec2::new(-1.2, -0.4), Vec2::new(0.9, -2.0), Vec2::new(0.1, -0.05)];

    #[test]
    fn reciprocal() {
        for z in POINTS {
            for z0 in POINTS.into_iter().filter(|&p| p != z) {
                let (e, t) = (interaction(z, z0), interaction(z0, z));
                let difference =
                    (e[0] - t[0]).abs() + (e[1] - t[2]).abs() + (e[2] - t[1]).abs() + (e[3] - t[3]).abs();
                assert!(difference < 1e-13, "{z:?} {z0:?}: {e:?} {t:?}");
            }
        }
    }

    #[test]
    fn the_surface_is_free_of_traction() {
        for z0 in POINTS {
            for x in [-3.0, 0.0, 0.2, 5.0] {
                assert!(interaction(Vec2::new(x, 0.0), z0).iter().all(|e| e.abs() < 1e-13));
            }
            for burgers in [0, 1] {
                let below = stress(Vec2::new(0.4, -1e-5), z0, burgers);
                let scale = 1.0 / z0.length();
                assert!(below[1].abs() < 1e-3 * scale && below[2].abs() < 1e-3 * scale, "{below:?}");
            }
        }
    }

    #[test]
    fn equilibrium_and_no_net_force() {
        for z0 in POINTS {
            for burgers in [0, 1] {
                // Differences over 0.02 of the distance: truncation of 1e-6 of derivatives of 1/distance.
                const TRUNCATION: f64 = 1e-5;
                let z = Vec2::new(0.7, -1.3);
                let near = distance(z, z0);
                let h = 0.02 * near;
                let at = |x: f64, y: f64| stress(z + Vec2::new(x, y), z0, burgers);
                let (dx, dy) = (slope(|t| at(t, 0.0), h), slope(|t| at(0.0, t), h));
                let divergence = Vec2::new(dx[0] + dy[2], dx[2] + dy[1]);
                assert!(divergence.length() < TRUNCATION / near.powi(2), "{divergence:?}");
                // Compatibility: the trace is harmonic.
                let trace = |x: f64, y: f64| [at(x, y)[0] + at(x, y)[1]];
                let along_x = slope(|s| slope(|t| trace(s + t, 0.0), h), h);
                let along_y = slope(|s| slope(|t| trace(0.0, s + t), h), h);
                let laplacian = along_x[0] + along_y[0];
                assert!(laplacian.abs() < 10.0 * TRUNCATION / near.powi(3), "{laplacian}");
                // The resultant over a closed circuit around z0 is the change of F around it: none.
                let circle = |t: f64| z0 + Vec2::unit(t) * (0.5 * z0.y.abs());
                let jump = airy_gradient(circle(0.0), z0, burgers)
                    - airy_gradient(circle(std::f64::consts::TAU), z0, burgers);
                assert!(jump.length() < 1e-12);
            }
        }
    }

    /// 2G (u + i v) = κ φ − z φ̄′ − ψ̄ around z0 must gain 2G b: the trace σxx + σyy = 4 Re φ′ fixes φ′.
    #[test]
    fn burgers_circuit() {
        // In units of E′/(8π): displacement gradients from Hooke's law, integrated around the dislocation.
        let (modulus, poisson) = (8.0 * std::f64::consts::PI, 0.3);
        let young = modulus * (1.0 - poisson * poisson);
        for z0 in POINTS {
            for burgers in [0, 1] {
                // ∮ (∂u/∂s) ds with u from strains needs rotation; use Volterra instead: the work of a uniform
                // remote stress on the dislocation dipole equals b × stress × length, here by the mean strain:
                // integrate strain over an annulus sector is equivalent to integrating the symmetrised jump.
                let n = 400;
                let radius = 0.3 * z0.y.abs();
                // Michell–Cesàro: ∮ [ε·dx − (x − x0) × (curl-type terms)] reduces to the integrals of strain and
                // of its normal derivative; evaluated with exact trapezoidal sums on the circle.
                let mut jump = Vec2::default();
                for k in 0..n {
                    let t = std::f64::consts::TAU * (k as f64 + 0.5) / n as f64;
                    let (e, h) = (Vec2::unit(t), 1e-3 * radius);
                    let strain = |z: Vec2| {
                        let s = stress(z, z0, burgers);
                        let (p, q) = ((1.0 - poisson * poisson) / young, poisson * (1.0 + poisson) / young);
                        [p * s[0] - q * s[1], p * s[1] - q * s[0], (1.0 + poisson) / young * s[2]]
                    };
                    let z = z0 + e * radius;
                    let ds = e.left() * (std::f64::consts::TAU * radius / n as f64);
                    let g = strain(z);
                    let (ex, wx) = (strain(z + Vec2::new(h, 0.)), strain(z - Vec2::new(h, 0.)));
                    let (ny, sy) = (strain(z + Vec2::new(0., h)), strain(z - Vec2::new(0., h)));
                    let d = |a: [f64; 3], b: [f64; 3], i: usize| (a[i] - b[i]) / (2.0 * h);
                    // ω,x = ε_xy,x − ε_xx,y ; ω,y = ε_yy,x − ε_xy,y.
                    let omega = (d(ex, wx, 2) - d(ny, sy, 0)) * ds.x + (d(ex, wx, 1) - d(ny, sy, 2)) * ds.y;
                    let r = z - z0;
                    // u_x,s = ε_xx dx + ε_xy dy − ω dy ; integrating ω by parts on the closed circuit.
                    jump.x += g[0] * ds.x + g[2] * ds.y + r.y * omega;
                    jump.y += g[2] * ds.x + g[1] * ds.y - r.x * omega;
                }
                let want = if burgers == 0 { Vec2::new(1.0, 0.0) } else { Vec2::new(0.0, 1.0) };
                let miss = (jump.length() - 1.0).abs() + jump.cross(want).abs();
                assert!(miss < 1e-4, "Burgers vector {want:?}: {jump:?}");
            }
        }
    }
}
