//! The displacement of the half-plane under a Hertzian contact with friction, in closed form.

use super::hertz_half_plane::Root;
use crate::load::HertzianContact;
use crate::material::IsotropicElastic;
use crate::math::Vec2;

/// The displacement of the half-plane y ≤ 0 under a Hertzian contact in plane strain; its stress is
/// [`super::HertzField`].
///
/// With z, s, W and Φ = (μ − i) W p0 / 2 as there and φ′ = Φ, a φ = a p0 (μ − i) I / 2 in mm,
/// I = ∫ W dz = −ρ²/4 − ln(z + s)/2, ρ = 1/(z + s) = −W,
///
/// 2G (u_x + i u_y) = κ φ(z) + φ(z̄) − (z − z̄) conj Φ(z),  κ = 3 − 4ν
///
/// (Muskhelishvili, Some Basic Problems of the Mathematical Theory of Elasticity, § 112). Under a
/// line load the displacement of a half-plane grows without bound, like the logarithm of the
/// distance. The rigid motion is fixed by taking I without a constant of integration, so that there
/// is no rotation far away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HertzDisplacement {
    per_half_width: f64,
    friction: f64,
    /// κ = 3 − 4ν.
    kolosov: f64,
    /// a p0 / (4 G), mm.
    scale: f64,
}

impl HertzDisplacement {
    /// The displacement under `contact` in a rail of `steel`.
    pub(crate) fn new(contact: &HertzianContact, steel: &IsotropicElastic) -> Self {
        Self {
            per_half_width: 1.0 / contact.half_width,
            friction: contact.friction,
            kolosov: 3.0 - 4.0 * steel.poisson(),
            scale: 0.25 * contact.half_width * contact.peak_pressure / steel.shear_modulus(),
        }
    }

    /// The displacement (mm) of `point` (mm) for a contact centred at `xc` (mm). A point above the
    /// surface is moved onto it.
    pub(crate) fn displacement(&self, point: Vec2, xc: f64) -> Vec2 {
        let x = (point.x - xc) * self.per_half_width;
        let y = (point.y * self.per_half_width).min(0.0);
        let root = Root::of(x, y);
        // z + s lies in the lower half-plane, its limit on the surface too: −π ≤ argument ≤ 0.
        let (sum_re, sum_im) = (root.re + x, root.im + y);
        let square = sum_re * sum_re + sum_im * sum_im;
        let (rho_re, rho_im) = (sum_re / square, -sum_im / square);
        let argument = (-sum_im.abs()).atan2(sum_re);
        let (i_re, i_im) = (
            -0.25 * (rho_re * rho_re - rho_im * rho_im) - 0.25 * square.ln(),
            -0.5 * rho_re * rho_im - 0.5 * argument,
        );
        // κ I + conj I, and −(z − z̄) conj Φ = y (1 − i μ) conj W.
        let (even, odd) = ((self.kolosov + 1.0) * i_re, (self.kolosov - 1.0) * i_im);
        let mu = self.friction;
        let (w_re, w_im) = (-rho_re, -rho_im);
        let ux = mu * even + odd + 2.0 * y * (w_re - mu * w_im);
        let uy = mu * odd - even - 2.0 * y * (w_im + mu * w_re);
        Vec2::new(ux, uy) * self.scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::HertzField;
    use crate::math::Stress;

    const CONTACT: HertzianContact =
        HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.4 };
    const XC: f64 = 2.5;

    fn steel() -> IsotropicElastic {
        IsotropicElastic::new(210e3, 0.3).unwrap()
    }

    /// Hooke's law of plane strain from central differences of the displacement; one-sided of the
    /// same order on the surface.
    fn stress_by_differences(point: Vec2, step: f64) -> Stress {
        let field = HertzDisplacement::new(&CONTACT, &steel());
        let at = |dx: f64, dy: f64| field.displacement(point + Vec2::new(dx, dy) * step, XC);
        let along_x = (at(1.0, 0.0) - at(-1.0, 0.0)) * (0.5 / step);
        let along_y = if point.y < -step {
            (at(0.0, 1.0) - at(0.0, -1.0)) * (0.5 / step)
        } else {
            (at(0.0, 0.0) * 3.0 - at(0.0, -1.0) * 4.0 + at(0.0, -2.0)) * (0.5 / step)
        };
        let (mu, nu) = (steel().shear_modulus(), steel().poisson());
        let lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
        let trace = along_x.x + along_y.y;
        let (xx, yy) = (lambda * trace + 2.0 * mu * along_x.x, lambda * trace + 2.0 * mu * along_y.y);
        Stress { xx, yy, zz: nu * (xx + yy), xy: mu * (along_x.y + along_y.x) }
    }

    fn largest_component(s: Stress) -> f64 {
        s.xx.abs().max(s.yy.abs()).max(s.zz.abs()).max(s.xy.abs())
    }

    #[test]
    fn strains_are_those_of_the_stress() {
        // Truncation of second-order differences with steps of 1e-4 of the distance to the nearest
        // edge of the contact; round-off of the differences 1e-16 / 1e-4 of displacements whose
        // strains are of the order of 1/10 of them.
        const TOLERANCE: f64 = 1e-6;
        let stress = HertzField::new(&CONTACT, steel().poisson());
        let a = CONTACT.half_width;
        let places = [
            (0.0, -0.8),
            (0.3, -0.05),
            (-0.9, -0.3),
            (1.2, -0.2),
            (-2.5, -1.0), // inside
            (0.0, 0.0),
            (0.6, 0.0),
            (-0.7, 0.0),
            (1.5, 0.0),
            (-1.5, 0.0),
            (6.0, 0.0),
            (-9.0, -0.0), // on the surface
            (30.0, -20.0),
            (-300.0, -1.0),
            (0.0, -1e3),
            (-1e4, -1e4), // far away
        ];
        for (x, y) in places {
            let point = Vec2::new(XC + a * x, a * y);
            let from_edge = (x.abs() - 1.0).hypot(y) * a;
            let want = stress.stress(point, XC);
            let error = largest_component(stress_by_differences(point, 1e-4 * from_edge) - want);
            assert!(error < TOLERANCE * largest_component(want), "x/a {x}, y/a {y}: {error:e} of {want:?}");
        }
    }

    #[test]
    fn is_continuous_along_the_surface_and_around_the_rail() {
        // The argument of z + s must not jump where the surface leaves the contact.
        const STEP: f64 = 1e-7;
        let field = HertzDisplacement::new(&CONTACT, &steel());
        for x in [-5.0, -1.0, 0.0, 1.0, 5.0] {
            for side in [-1.0, 1.0] {
                let near = |dx, y| field.displacement(Vec2::new(XC + CONTACT.half_width * (x + dx), y), XC);
                let on = near(0.0, 0.0);
                assert!((near(side * STEP, 0.0) - on).length() < 1e-6, "beside x/a {x}");
                assert!((near(0.0, -STEP) - on).length() < 1e-6, "below x/a {x}");
                assert_eq!(near(0.0, -0.0), on);
            }
        }
    }

    #[test]
    fn a_wheel_presses_down_and_drags_along() {
        let field = HertzDisplacement::new(&CONTACT, &steel());
        let under =
            field.displacement(Vec2::new(XC, 0.0), XC) - field.displacement(Vec2::new(XC, -200.0), XC);
        assert!(under.y < 0.0 && under.x > 0.0, "{under:?}");
    }
}
