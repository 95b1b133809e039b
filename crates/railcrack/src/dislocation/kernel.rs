//! Interaction of two edge dislocations in the half-plane y ≤ 0 with a traction-free surface.

use crate::math::Vec2;

/// The 2 × 2 interaction of unit dislocations: `[xx, xy, yx, yy]`, first index the Burgers vector
/// at z.
pub(super) type Interaction = [f64; 4];

/// Energy of interaction of unit dislocations at `z` and `z0` (mm), in units of E′/(8π) per mm² of
/// Burgers vectors.
///
/// With the Kolosov–Muskhelishvili potentials φ0 = γ log(z − z0), ψ0 = γ̄ log(z − z0) − γ
/// z̄0/(z − z0) of a dislocation (b_x + i b_y = 8π i γ/E′) and their images φ1 = −(z φ̄0′ + ψ̄0),
/// ψ1 = −(φ̄0 + z φ1′) that make y = 0 traction-free, the resultant force over a line from the
/// surface to z is F = φ + z φ̄′ + ψ̄ = γ P + γ̄ Q,
/// P = log(|z−z0|²/|z−z̄0|²) − 4 y y0/(z̄−z0)²,
/// Q = (z−z0)/(z̄−z̄0) − (z−z0)/(z−z̄0) − 2 i y/(z̄−z0).
/// It vanishes with z or z0 on the surface. Moving a second dislocation b′ in from the surface
/// costs b′_x Im F − b′_y Re F. (Muskhelishvili 1953, §§ 41, 90–93.)
#[inline]
pub(super) fn interaction(z: Vec2, z0: Vec2) -> Interaction {
    split_interaction(z, z0).whole()
}

/// An interaction split into its logarithm, which appears on the diagonal only, and the rest. Sums
/// over many points need only the logarithm of one product.
#[derive(Debug, Clone, Copy)]
pub(super) struct Split {
    /// The interaction without the logarithm.
    pub rational: Interaction,
    /// The argument of the logarithm.
    pub of_log: f64,
}

impl Split {
    fn whole(self) -> Interaction {
        let Self { rational: [xx, xy, yx, yy], of_log } = self;
        let log = of_log.ln();
        [xx + log, xy, yx, yy + log]
    }
}

/// [`interaction`] in two parts; the argument of the logarithm is |z̄−z0|²/|z−z0|².
#[inline]
pub(super) fn split_interaction(z: Vec2, z0: Vec2) -> Split {
    let (dx, dy) = (z.x - z0.x, z.y - z0.y);
    let inverse = 1.0 / (dx * dx + dy * dy);
    // (z − z0)/(z̄ − z̄0): the direction squared.
    let (ex, ey) = ((dx * dx - dy * dy) * inverse, 2.0 * dx * dy * inverse);
    let Split { rational: [xx, xy, yx, yy], of_log } = split_image_interaction(z, z0);
    Split { rational: [xx + ex, xy + ey, yx + ey, yy - ex], of_log: of_log * inverse }
}

/// Contribution of the free surface to [`interaction`]: all but −log|z−z0|² and (z−z0)/(z̄−z̄0);
/// smooth at z = z0 below the surface. The argument of the logarithm is |z̄−z0|² in mm².
#[inline]
pub(super) fn split_image_interaction(z: Vec2, z0: Vec2) -> Split {
    // m = z̄ − z0.
    let (mx, my) = (z.x - z0.x, -z.y - z0.y);
    let (dx, dy) = (z.x - z0.x, z.y - z0.y);
    let m2 = mx * mx + my * my;
    let inverse = 1.0 / m2;
    // 4 y y0 / m² = 4 y y0 m̄² / |m|⁴.
    let scale = 4.0 * z.y * z0.y * inverse * inverse;
    let (px, py) = (-scale * (mx * mx - my * my), scale * 2.0 * mx * my);
    // −(z−z0) m/|m|² − 2 i y m̄/|m|²; (z − z̄0) is the conjugate of m.
    let qx = (-(dx * mx - dy * my) - 2.0 * z.y * my) * inverse;
    let qy = (-(dx * my + dy * mx) - 2.0 * z.y * mx) * inverse;
    Split { rational: [qx - px, py + qy, qy - py, -(px + qx)], of_log: m2 }
}

/// −log|z−z0|² and (z−z0)/(z̄−z̄0) when both lie on one straight line of direction `tangent`: the
/// second is constant. Returns it as an [`Interaction`] without the logarithm.
pub(super) fn collinear_constant(tangent: Vec2) -> Interaction {
    let (ex, ey) = (tangent.x * tangent.x - tangent.y * tangent.y, 2.0 * tangent.x * tangent.y);
    [ex, ey, ey, -ex]
}

#[cfg(test)]
#[path = "kernel_tests.rs"]
mod tests;
