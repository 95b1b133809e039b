//! The interaction is that of dislocations in a half-plane: it derives from stresses in equilibrium
//! that leave the surface traction-free, with the Burgers vector and no force in the core.

use super::*;
use crate::math::Stress;
use std::f64::consts::{PI, TAU};

const POINTS: [Vec2; 4] =
    [Vec2::new(0.3, -0.7), Vec2::new(-1.2, -0.4), Vec2::new(0.9, -2.0), Vec2::new(0.1, -0.05)];

/// Gradient of the Airy function at z of the unit Burgers vector number `burgers` at z0: row x of
/// the interaction is Φ_y, row y is −Φ_x.
fn airy_gradient(z: Vec2, z0: Vec2, burgers: usize) -> Vec2 {
    let e = interaction(z, z0);
    Vec2::new(-e[2 + burgers], e[burgers])
}

/// A dislocation at `z0`, its stress in units of E′/(8π).
#[derive(Debug, Clone, Copy)]
struct Dislocation {
    z0: Vec2,
    burgers: usize,
}

/// Step of central differences over the distance from the dislocation: the error is about its
/// square.
const STEP: f64 = 1e-4;
/// Resulting error of a stress, relative to 1/distance, with a margin for the higher derivatives
/// near the surface.
const DIFFERENCE: f64 = 1e-6;

impl Dislocation {
    fn all() -> impl Iterator<Item = Self> {
        POINTS.into_iter().flat_map(|z0| [0, 1].map(|burgers| Self { z0, burgers }))
    }

    fn distance(self, z: Vec2) -> f64 {
        (z - self.z0).length()
    }

    /// Second derivatives of the Airy function at z: [Φ_xx, Φ_xy, Φ_yx, Φ_yy].
    fn airy_curvature(self, z: Vec2) -> [f64; 4] {
        let h = STEP * self.distance(z);
        let change = |d: Vec2| {
            let gradient = |z| airy_gradient(z, self.z0, self.burgers);
            (gradient(z + d) - gradient(z - d)) * (0.5 / h)
        };
        let (x, y) = (change(Vec2::new(h, 0.0)), change(Vec2::new(0.0, h)));
        [x.x, x.y, y.x, y.y]
    }

    /// σ_xx = Φ_yy, σ_yy = Φ_xx, σ_xy = −Φ_xy.
    fn stress(self, z: Vec2) -> Stress {
        let [xx, xy, yx, yy] = self.airy_curvature(z);
        Stress { xx: yy, yy: xx, zz: 0.0, xy: -0.5 * (xy + yx) }
    }

    fn trace(self, z: Vec2) -> f64 {
        let stress = self.stress(z);
        stress.xx + stress.yy
    }

    /// Points on a circle about the core that stays below the surface, counter-clockwise, with the
    /// outward normal and the weight of each. The trapezoidal rule on a circle converges
    /// exponentially.
    fn circuit(self) -> impl Iterator<Item = (Vec2, Vec2, f64)> {
        const NUMBER: usize = 128;
        let radius = 0.5 * self.z0.y.abs();
        (0..NUMBER).map(move |k| {
            let normal = Vec2::unit(TAU * k as f64 / NUMBER as f64);
            (self.z0 + normal * radius, normal, TAU * radius / NUMBER as f64)
        })
    }
}

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
    for dislocation in Dislocation::all() {
        for x in [-3.0, 0.0, 0.2, 5.0] {
            let z = Vec2::new(x, 0.0);
            let resultant = airy_gradient(z, dislocation.z0, dislocation.burgers);
            assert!(resultant.length() < 1e-13, "{dislocation:?} at {x}: {resultant:?}");
            let (stress, scale) = (dislocation.stress(z), 1.0 / dislocation.distance(z));
            assert!(stress.yy.abs() < DIFFERENCE * scale, "{dislocation:?} at {x}: {stress:?}");
            assert!(stress.xy.abs() < DIFFERENCE * scale, "{dislocation:?} at {x}: {stress:?}");
        }
    }
}

/// The mixed derivatives agree, so that the rows derive from one Airy function and its stress is in
/// equilibrium; the trace is harmonic, so that the strains are compatible: its mean over a circle
/// is its value at the centre.
#[test]
fn equilibrium_and_compatibility() {
    for dislocation in Dislocation::all() {
        for z in [Vec2::new(0.7, -1.3), Vec2::new(-0.2, -0.3), Vec2::new(4.0, -0.9)] {
            let scale = 1.0 / dislocation.distance(z);
            let [_, xy, yx, _] = dislocation.airy_curvature(z);
            assert!((xy - yx).abs() < DIFFERENCE * scale, "{dislocation:?} at {z:?}: {xy} {yx}");
            let radius = 0.3 * dislocation.distance(z).min(-z.y);
            let around =
                (0..32).map(|k| dislocation.trace(z + Vec2::unit(TAU * f64::from(k) / 32.0) * radius));
            let mean = around.sum::<f64>() / 32.0;
            let centre = dislocation.trace(z);
            assert!((mean - centre).abs() < DIFFERENCE * scale, "{dislocation:?} at {z:?}: {mean} {centre}");
        }
    }
}

#[test]
fn no_force_and_no_moment_in_the_core() {
    for dislocation in Dislocation::all() {
        let (mut force, mut moment, mut magnitude) = (Vec2::default(), 0.0, 0.0);
        for (z, normal, length) in dislocation.circuit() {
            let traction = dislocation.stress(z).traction(normal) * length;
            force = force + traction;
            moment += (z - dislocation.z0).cross(traction);
            magnitude += traction.length();
        }
        let arm = 0.5 * dislocation.z0.y.abs();
        assert!(force.length() < DIFFERENCE * magnitude, "{dislocation:?}: {force:?} of {magnitude}");
        assert!(moment.abs() < DIFFERENCE * magnitude * arm, "{dislocation:?}: {moment} of {magnitude}");
    }
}

/// The displacement gains b around the core, counter-clockwise.
///
/// By Cesàro, ∮ du = ∮ ε·ds − e_z × (z − z0) dω, with the rotation from the trace T of the stress:
/// E′ ω_x = −T_y, E′ ω_y = T_x.
#[test]
fn burgers_circuit() {
    const POISSON: f64 = 0.3;
    let modulus = 8.0 * PI; // E′ in units of E′/(8π)
    let twice_shear = modulus * (1.0 - POISSON);
    for dislocation in Dislocation::all() {
        let mut gain = Vec2::default();
        for (z, normal, length) in dislocation.circuit() {
            let (along, arm) = (normal.left() * length, z - dislocation.z0);
            let stress = dislocation.stress(z);
            let mean = POISSON * (stress.xx + stress.yy);
            let strain =
                Stress { xx: stress.xx - mean, yy: stress.yy - mean, ..stress } * (1.0 / twice_shear);
            // The trace is itself computed by differences: a wider step for its derivatives.
            let h = 1e-2 * dislocation.distance(z);
            let slope = |d: Vec2| {
                let difference = |k: f64| dislocation.trace(z + d * k) - dislocation.trace(z - d * k);
                (8.0 * difference(1.0) - difference(2.0)) / (12.0 * h * modulus)
            };
            let (x, y) = (slope(Vec2::new(h, 0.0)), slope(Vec2::new(0.0, h)));
            let turn = x * along.y - y * along.x;
            gain = gain + strain.traction(along) + arm.left() * -turn;
        }
        let want = [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)][dislocation.burgers];
        let miss = (gain - want).length();
        assert!(miss < 1e-5, "{dislocation:?} gains {gain:?}"); // differences of differences
    }
}
