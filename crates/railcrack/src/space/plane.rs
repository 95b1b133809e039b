//! Plane of a crack in the half-space, and tractions on it due to jumps.
//!
//! A point of the plane has the coordinates s, the distance from the trace of the plane in the
//! surface along its dip, and ζ along that trace. Components of jumps and tractions are along the
//! normal, along the dip and along the trace, in this order; without strike the normal, the dip and
//! the trace are x2, x1 and the lateral axis of docs/conventions.md.

use super::nuclei::{image_stress, kelvin_stress, moment, traction};
use crate::math::dot3;

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
}
