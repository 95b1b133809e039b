//! Stress intensity factors, and the fields of Williams around a tip.

use crate::material::IsotropicElastic;
use crate::math::{MPA_SQRT_MM, Stress, Vec2};
use num_complex::Complex64;
use std::ops::{Add, Mul};

/// Stress intensity factors of a tip, MPa √mm. K_II > 0 means τ12 > 0 ahead of the tip: the + face
/// moves along +x1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sif {
    /// K_I.
    pub ki: f64,
    /// K_II.
    pub kii: f64,
}

impl Sif {
    /// K_I, MPa √m.
    #[must_use]
    pub fn ki_mpa_sqrt_m(self) -> f64 {
        self.ki / MPA_SQRT_MM
    }

    /// K_II, MPa √m.
    #[must_use]
    pub fn kii_mpa_sqrt_m(self) -> f64 {
        self.kii / MPA_SQRT_MM
    }
}

impl Add for Sif {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { ki: self.ki + o.ki, kii: self.kii + o.kii }
    }
}

impl Mul<f64> for Sif {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self { ki: self.ki * s, kii: self.kii * s }
    }
}

/// The stress intensity factors of one tip through a passage: all accepted substeps in order, both
/// unloaded ends included.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SifHistory {
    /// The samples in the order of loading.
    pub samples: Vec<Sif>,
}

impl SifHistory {
    /// The largest |K_I| or |K_II|, MPa √mm.
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.samples.iter().fold(0.0, |m, k| m.max(k.ki.abs()).max(k.kii.abs()))
    }
}

/// A displacement with its gradient and stress, components in the tip frame (x1 ahead, x2 to its
/// left).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TipField {
    /// Displacement u, mm.
    pub displacement: Vec2,
    /// ∂u/∂x1.
    pub along: Vec2,
    /// ∂u/∂x2.
    pub across: Vec2,
    /// Stress, MPa.
    pub stress: Stress,
}

/// Kolosov's potentials φ = A z^λ, ψ = (Ā − λ A) z^λ with λ = ±1/2, both traction-free on θ = ±π:
///
/// 2 G (u1 + i u2) = κ φ − z conj φ′ − conj ψ
#[derive(Debug, Clone, Copy)]
pub(crate) struct WilliamsField {
    exponent: f64,
    phi: Complex64,
    psi: Complex64,
    shear_modulus: f64,
    kolosov: f64,
}

/// z, z^λ and its first two derivatives at a point z = r e^{iθ}.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TipPowers {
    z: Complex64,
    power: Complex64,
    slope: Complex64,
    curvature: Complex64,
}

impl WilliamsField {
    /// The field of a tip with the stress intensity factors `k` (MPa √mm): λ = 1/2, A = (K_I − i
    /// K_II)/√(2π) (Williams 1957, in the form of Muskhelishvili's potentials).
    pub(crate) fn of(k: Sif, steel: &IsotropicElastic) -> Self {
        Self::new(0.5, Complex64::new(k.ki, -k.kii) / std::f64::consts::TAU.sqrt(), steel)
    }

    /// −∂/∂x1 of [`WilliamsField::of`], the rate of its change with the advance of the tip: λ =
    /// −1/2, displacements like r^(−1/2).
    ///
    /// It is the dual field of the stress intensity factors: with u a field of K around the tip,
    /// the integral over a small circle ∮ (t(u)·v − t(v)·u) ds = (2/E′) (K_I k_I + K_II k_II)
    /// (Betti; equal to the interaction integral).
    pub(crate) fn dual(k: Sif, steel: &IsotropicElastic) -> Self {
        Self::new(-0.5, Complex64::new(-k.ki, k.kii) * 0.5 / std::f64::consts::TAU.sqrt(), steel)
    }

    fn new(exponent: f64, phi: Complex64, steel: &IsotropicElastic) -> Self {
        Self {
            exponent,
            phi,
            psi: phi.conj() - phi * exponent,
            shear_modulus: steel.shear_modulus(),
            kolosov: 3.0 - 4.0 * steel.poisson(),
        }
    }

    /// The field at the distance `r` (mm, positive) and the angle `theta` (radians from x1). The
    /// angle may leave (−π, π]: the field is continued, so that the jump can follow a crack that
    /// kinks behind the tip.
    #[cfg(test)]
    pub(crate) fn at(&self, r: f64, theta: f64, poisson: f64) -> TipField {
        self.of_powers(&self.powers(r, theta), poisson)
    }

    /// The powers of z that all fields with this λ share at a point, as for [`WilliamsField::at`].
    pub(crate) fn powers(&self, r: f64, theta: f64) -> TipPowers {
        let l = self.exponent;
        let z = Complex64::from_polar(r, theta);
        let power = Complex64::from_polar(r.powf(l), l * theta);
        let slope = power * l / z;
        TipPowers { z, power, slope, curvature: slope * (l - 1.0) / z }
    }

    /// [`WilliamsField::at`] from the `powers` of a field with the same λ.
    pub(crate) fn of_powers(&self, powers: &TipPowers, poisson: f64) -> TipField {
        let z = powers.z;
        let (phi, psi) = (self.phi * powers.power, self.psi * powers.power);
        let (phi_1, psi_1) = (self.phi * powers.slope, self.psi * powers.slope);
        let phi_2 = self.phi * powers.curvature;
        let per_two_g = 0.5 / self.shear_modulus;
        let u = (phi * self.kolosov - z * phi_1.conj() - psi.conj()) * per_two_g;
        let even = phi_1 * self.kolosov - phi_1.conj();
        let odd = z * phi_2.conj() + psi_1.conj();
        let (u_1, u_2) = ((even - odd) * per_two_g, Complex64::i() * (even + odd) * per_two_g);
        let trace = 4.0 * phi_1.re;
        let deviator = (z.conj() * phi_2 + psi_1) * 2.0;
        let vector = |c: Complex64| Vec2::new(c.re, c.im);
        TipField {
            displacement: vector(u),
            along: vector(u_1),
            across: vector(u_2),
            stress: Stress {
                xx: 0.5 * (trace - deviator.re),
                yy: 0.5 * (trace + deviator.re),
                zz: poisson * trace,
                xy: 0.5 * deviator.im,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn steel() -> IsotropicElastic {
        IsotropicElastic::new(210e3, 0.3).unwrap()
    }

    const MODES: [Sif; 2] = [Sif { ki: 1.0, kii: 0.0 }, Sif { ki: 0.0, kii: 1.0 }];

    #[test]
    fn stress_ahead_and_opening_behind_define_the_intensity_factors() {
        let r = 0.37;
        for k in MODES {
            let field = WilliamsField::of(k, &steel());
            let ahead = field.at(r, 0.0, 0.3).stress;
            assert!((ahead.yy - k.ki / (TAU * r).sqrt()).abs() < 1e-14);
            assert!((ahead.xy - k.kii / (TAU * r).sqrt()).abs() < 1e-14);
            let jump = field.at(r, PI, 0.3).displacement - field.at(r, -PI, 0.3).displacement;
            let factor = 8.0 / steel().plane_strain_modulus() * (r / TAU).sqrt();
            assert!((jump.y - factor * k.ki).abs() < 1e-18, "{jump:?}");
            assert!((jump.x - factor * k.kii).abs() < 1e-18, "{jump:?}");
        }
    }

    #[test]
    fn faces_are_free_and_stress_is_that_of_the_gradient() {
        for k in MODES {
            for field in [WilliamsField::of(k, &steel()), WilliamsField::dual(k, &steel())] {
                for theta in [-PI, PI] {
                    let stress = field.at(0.5, theta, 0.3).stress;
                    assert!(stress.yy.abs() < 1e-13 && stress.xy.abs() < 1e-13, "{stress:?}");
                }
                let at = field.at(0.5, 1.1, 0.3);
                let (g, nu) = (steel().shear_modulus(), 0.3);
                let lame = 2.0 * g * nu / (1.0 - 2.0 * nu);
                let trace = at.along.x + at.across.y;
                assert!((at.stress.xx - lame * trace - 2.0 * g * at.along.x).abs() < 1e-12);
                assert!((at.stress.yy - lame * trace - 2.0 * g * at.across.y).abs() < 1e-12);
                assert!((at.stress.zz - lame * trace).abs() < 1e-12);
                assert!((at.stress.xy - g * (at.along.y + at.across.x)).abs() < 1e-12);
                // The gradient by finite differences.
                let moved = |dx: f64, dy: f64| {
                    let p = Vec2::new(0.5 * 1.1f64.cos() + dx, 0.5 * 1.1f64.sin() + dy);
                    field.at(p.length(), p.angle(), 0.3).displacement
                };
                let step = 1e-6;
                let along = (moved(step, 0.0) - moved(-step, 0.0)) * (0.5 / step);
                let across = (moved(0.0, step) - moved(0.0, -step)) * (0.5 / step);
                assert!((along - at.along).length() < 1e-8 * at.along.length());
                assert!((across - at.across).length() < 1e-8 * at.across.length());
            }
        }
    }

    /// Betti on circles of two radii.
    #[test]
    fn the_dual_field_extracts_the_intensity_factors() {
        const POINTS: usize = 2000;
        for r in [0.2, 1.7] {
            for (k, wanted) in MODES.into_iter().zip([[1.0, 0.0], [0.0, 1.0]]) {
                let u = WilliamsField::of(k, &steel());
                for (dual, want) in MODES.into_iter().zip(wanted) {
                    let v = WilliamsField::dual(dual, &steel());
                    let sum: f64 = (0..POINTS)
                        .map(|i| {
                            let theta = -PI + TAU * (i as f64 + 0.5) / POINTS as f64;
                            let n = Vec2::unit(theta);
                            let (u, v) = (u.at(r, theta, 0.3), v.at(r, theta, 0.3));
                            let (tu, tv) = (u.stress.traction(n), v.stress.traction(n));
                            tu.dot(v.displacement) - tv.dot(u.displacement)
                        })
                        .sum();
                    let measured = sum * TAU * r / POINTS as f64 * 0.5 * steel().plane_strain_modulus();
                    assert!((measured - want).abs() < 1e-12, "{measured} {want}");
                }
            }
        }
    }
}
