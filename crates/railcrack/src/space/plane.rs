//! Plane of a crack in the half-space, and stress and tractions due to jumps on it.
//!
//! A point of the plane has the coordinates s, the distance from the trace of the plane in the
//! surface along its dip, and ζ along that trace. Components of jumps and tractions are along the
//! normal, along the dip and along the trace, in this order; without strike the normal, the dip and
//! the trace are x2, x1 and the lateral axis of docs/conventions.md.
//!
//! A jump w of the displacement over an element of surface with the normal n is a double force with
//! the moment m = λ (w·n) I + μ (w ⊗ n + n ⊗ w) (Burridge & Knopoff 1964; Aki & Richards 2002,
//! 3.1). Its field in the half-space is Kelvin's part and the image of Mindlin (1936).
//!
//! Axes in this module: x and y along the surface, z downwards; the material lies in z ≥ 0.

use super::mindlin_image::mindlin_image;
use crate::math::dot3;
use std::f64::consts::PI;

/// The solid around a crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Surroundings {
    /// The elastic full space.
    FullSpace,
    /// The half-space with a surface free of traction.
    HalfSpace,
}

/// The directions of an inclined plane: x along the rail, lateral, depth.
#[derive(Debug, Clone, Copy)]
pub struct PlaneFrame {
    normal: [f64; 3],
    dip: [f64; 3],
    trace: [f64; 3],
}

impl PlaneFrame {
    /// The plane that descends at the angle `dip` (radians) from +x.
    pub fn new(dip: f64) -> Self {
        Self::turned(dip, 0.0)
    }

    /// The same plane turned about the vertical by `strike` (radians), from +x to the positive
    /// lateral direction.
    pub fn turned(dip: f64, strike: f64) -> Self {
        let (sin, cos) = dip.sin_cos();
        let (aside, ahead) = strike.sin_cos();
        Self {
            normal: [sin * ahead, sin * aside, -cos],
            dip: [cos * ahead, cos * aside, sin],
            trace: [-aside, ahead, 0.0],
        }
    }

    /// x, lateral and depth of the point (s, ζ) relative to the middle of the trace.
    pub fn position(&self, s: f64, zeta: f64) -> [f64; 3] {
        std::array::from_fn(|c| s * self.dip[c] + zeta * self.trace[c])
    }

    /// x, lateral and depth of a vector with these components: normal, dip, trace.
    pub fn vector(&self, [normal, dip, trace]: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|c| normal * self.normal[c] + dip * self.dip[c] + trace * self.trace[c])
    }

    /// The unit normal, along which a jump opens the crack.
    pub fn normal(&self) -> [f64; 3] {
        self.normal
    }

    /// The directions of the components: normal, dip, trace.
    pub fn directions(&self) -> [[f64; 3]; 3] {
        [self.normal, self.dip, self.trace]
    }

    /// The components of a vector of the rail: normal, dip, trace.
    pub(super) fn components(&self, vector: [f64; 3]) -> [f64; 3] {
        self.directions().map(|direction| dot3(vector, direction))
    }

    /// The components of the traction of a stress on the plane.
    pub fn traction(&self, stress: &super::Symmetric) -> [f64; 3] {
        self.components(traction(stress, self.normal))
    }

    /// The image part of the stiffness −t_i for jump component j, in units of the shear modulus and
    /// per mm³: minus the traction at (s, ζ) due to a unit jump at (s′, ζ′), with τ = ζ − ζ′.
    pub(super) fn image_stiffness(&self, s: f64, other: f64, tau: f64, poisson: f64) -> [[f64; 3]; 3] {
        let (point, source) = (self.position(s, tau), self.position(other, 0.0));
        self.columns(|m| image_stress(point, source, m, poisson), poisson)
    }

    /// The same for the full space, at distinct points.
    pub(super) fn kelvin_stiffness(&self, ds: f64, tau: f64, poisson: f64) -> [[f64; 3]; 3] {
        let d = self.position(ds, tau);
        self.columns(|m| kelvin_stress(d, m, poisson), poisson)
    }

    fn columns(&self, stress: impl Fn(&super::Symmetric) -> super::Symmetric, poisson: f64) -> [[f64; 3]; 3] {
        let tractions = self.directions().map(|jump| {
            let stress = stress(&moment(jump, self.normal, poisson));
            self.traction(&stress)
        });
        std::array::from_fn(|i| std::array::from_fn(|j| -tractions[j][i]))
    }
}

/// A symmetric tensor: xx, yy, zz, yz, xz, xy.
pub type Symmetric = [f64; 6];

/// The pairs of axes of the entries of a symmetric tensor.
pub(super) const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];

/// Stress (in units of the shear modulus, per mm³) at the distance `d` from a double force of the
/// symmetric moment `moment` (in units of the shear modulus) in the full space.
///
/// Kelvin's solution is 16πμ(1−ν) G_kl = 4(1−ν) δ_kl/r − ∂_k∂_l r.
pub fn kelvin_stress(d: [f64; 3], moment: &Symmetric, poisson: f64) -> Symmetric {
    let r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let i3 = 1.0 / (r2 * r2.sqrt());
    let (i5, i7) = (i3 / r2, i3 / (r2 * r2));
    let delta = |i: usize, j: usize| f64::from(u8::from(i == j));
    let m = |i: usize, j: usize| moment[entry(i, j)];
    // Contractions of the moment with the derivatives of 1/r and r.
    let md: [f64; 3] = std::array::from_fn(|i| (0..3).map(|j| m(i, j) * d[j]).sum());
    let trace = moment[0] + moment[1] + moment[2];
    let dmd: f64 = (0..3).map(|i| d[i] * md[i]).sum();
    let gradient = |k: usize, j: usize| {
        // m_lm ∂_j∂_m (1/r) for l = k.
        let inverse = 3.0 * d[j] * md[k] * i5 - m(j, k) * i3;
        // m_lm ∂_j∂_k∂_l∂_m r.
        let fourth = -(delta(j, k) * trace + 2.0 * m(j, k)) * i3
            + 3.0 * (delta(j, k) * dmd + 2.0 * (d[j] * md[k] + d[k] * md[j]) + d[j] * d[k] * trace) * i5
            - 15.0 * d[j] * d[k] * dmd * i7;
        -(4.0 * (1.0 - poisson) * inverse - fourth)
    };
    let scale = 1.0 / (16.0 * PI * (1.0 - poisson));
    let dilatation = (0..3).map(|i| gradient(i, i)).sum::<f64>() * 2.0 * poisson / (1.0 - 2.0 * poisson);
    PAIRS.map(|(i, j)| scale * (gradient(i, j) + gradient(j, i) + delta(i, j) * dilatation))
}

/// The image part of that stress in the half-space, at `point` for a double force at `source`.
pub fn image_stress(point: [f64; 3], source: [f64; 3], moment: &Symmetric, poisson: f64) -> Symmetric {
    image_matrix(point, source, poisson).map(|row| row.iter().zip(moment).map(|(a, b)| a * b).sum())
}

/// The same for all unit moments: entry `[a][b]` is stress component a of moment component b.
pub(super) fn image_matrix(point: [f64; 3], source: [f64; 3], poisson: f64) -> [Symmetric; 6] {
    mindlin_image(point[0] - source[0], point[1] - source[1], point[2], source[2], poisson)
}

/// The moment, in units of the shear modulus, of the jump `jump` per unit of surface with the unit
/// normal `normal`.
pub fn moment(jump: [f64; 3], normal: [f64; 3], poisson: f64) -> Symmetric {
    let lambda = 2.0 * poisson / (1.0 - 2.0 * poisson);
    let opening: f64 = jump.iter().zip(normal).map(|(w, n)| w * n).sum();
    PAIRS.map(|(i, j)| {
        let bulk = if i == j { lambda * opening } else { 0.0 };
        bulk + jump[i] * normal[j] + jump[j] * normal[i]
    })
}

/// The traction of `stress` on the plane with the unit normal `normal`.
pub fn traction(stress: &Symmetric, normal: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|j| stress[entry(i, j)] * normal[j]).sum())
}

/// The place of the entry (i, j) in a symmetric tensor.
pub(super) fn entry(i: usize, j: usize) -> usize {
    if i == j { i } else { 6 - i - j }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_turned_plane() {
        let frame = PlaneFrame::turned(0.6, 0.5 * PI);
        let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
        assert!(close(frame.position(2.0, 0.0), [0.0, 2.0 * 0.6f64.cos(), 2.0 * 0.6f64.sin()]));
        assert!(close(frame.position(0.0, 1.0), [-1.0, 0.0, 0.0]), "x to z as z to −x");
        let frame = PlaneFrame::turned(1.1, -0.4);
        let vector = frame.vector([0.3, -0.5, 0.7]);
        assert!(close(frame.components(vector), [0.3, -0.5, 0.7]));
        assert!(close(frame.vector([0.0, 2.0, 3.0]), frame.position(2.0, 3.0)));
    }

    #[test]
    fn coplanar_jumps_in_the_full_space() {
        let (nu, ds, tau) = (0.3, 0.7, -0.4);
        let k = 1.0 / (4.0 * PI * (1.0 - nu));
        let r = f64::hypot(ds, tau);
        let slip = |a: f64, b: f64, same: f64| {
            k * (-(1.0 - 2.0 * nu) * same / r.powi(3) - 3.0 * nu * a * b / r.powi(5))
        };
        let want = [
            [-k / r.powi(3), 0.0, 0.0],
            [0.0, slip(ds, ds, 1.0), slip(ds, tau, 0.0)],
            [0.0, slip(tau, ds, 0.0), slip(tau, tau, 1.0)],
        ];
        for dip in [15f64, 50.0, 90.0, 130.0] {
            let got = PlaneFrame::new(dip.to_radians()).kelvin_stiffness(ds, tau, nu);
            for i in 0..3 {
                for j in 0..3 {
                    let gap = got[i][j] - want[i][j];
                    assert!(gap.abs() < 1e-14, "{dip} {i} {j}: {} {}", got[i][j], want[i][j]);
                }
            }
        }
    }

    const NU: f64 = 0.3;

    fn total(point: [f64; 3], source: [f64; 3], m: &Symmetric) -> Symmetric {
        let d = std::array::from_fn(|i| point[i] - source[i]);
        let (full, image) = (kelvin_stress(d, m, NU), image_stress(point, source, m, NU));
        std::array::from_fn(|i| full[i] + image[i])
    }

    #[test]
    fn the_surface_is_free_of_traction() {
        let source = [0.3, -0.2, 0.7];
        for b in 0..6 {
            let m = std::array::from_fn(|i| f64::from(u8::from(i == b)));
            for point in [[0.9, 0.4, 0.0], [0.3, -0.2, 0.0], [-3.0, 2.0, 0.0], [0.35, -0.2, 0.0]] {
                let stress = total(point, source, &m);
                let size = stress.iter().fold(0.0f64, |s, v| s.max(v.abs()));
                let free = traction(&stress, [0.0, 0.0, 1.0]);
                for t in free {
                    assert!(t.abs() < 1e-14 * size.max(1.0), "{b} {point:?} {free:?} of {size}");
                }
            }
        }
    }

    #[test]
    fn field_point_and_source_may_be_exchanged() {
        let (p, q) = ([0.3, -0.2, 0.7], [-0.4, 0.5, 1.1]);
        for a in 0..6 {
            for b in 0..6 {
                let unit = |k: usize| std::array::from_fn(|i| f64::from(u8::from(i == k)));
                // Work of the double force a on the strain of b, where the stress is conjugate to
                // C⁻¹ of the moment.
                let strained = |s: &Symmetric, m: &Symmetric| {
                    let trace = s[0] + s[1] + s[2];
                    let strain = |i: usize| {
                        0.5 * (s[i] - if i < 3 { NU / (1.0 + NU) * trace } else { 0.0 })
                            * if i < 3 { 1.0 } else { 2.0 }
                    };
                    (0..6).map(|i| strain(i) * m[i]).sum::<f64>()
                };
                let there = strained(&total(p, q, &unit(b)), &unit(a));
                let back = strained(&total(q, p, &unit(a)), &unit(b));
                assert!((there - back).abs() < 1e-13, "{a} {b}: {there} {back}");
            }
        }
    }
}
