//! Strips of Carter's form, scaled to Kalker's coefficients: FaStrip and strip theory.

use super::{Creepage, KalkerCoefficients, RollingPatch, RollingTheory};
use std::f64::consts::PI;

/// The stick zone of one strip, which touches the leading edge.
///
/// With ξ′ = −2(1−ν)GC11ξ/(π²μp0), η′ = −2(1−ν)GC22η/(π²μp0), φ′ = −3GcC23φ/(2πμp0),
/// k = ξ′ − φ′y/a, and a_y half the length of the strip:
///
/// d = a/(1−ν) (η′² + k²)/(√(η′² + (1−φ′²)k²) − η′φ′),
///
/// and in the stick zone, d ± (a_y − d), the shear
///
/// q_x = μp0/a κ (e_1 − e_2),  q_y = μp0/a [λ e_1 − (λ − φ′) e_2],
/// e_1 = √(a_y² − x²),  e_2 = √((a_y−d)² − (x−d)²),
///
/// with a unit vector (κ, λ) along (k, η′ + φ′f d/a), so that the shear reaches μp where the stick
/// zone ends; for small creepage its force is that of the linear theory. FaStrip as published has
/// f = 1. Kalker's strip theory has f = 1 − ν: only then is d what makes the vector a unit one, and
/// wheel and rail do not slip in the stick zone.
/// Without a real root, with d > a_y or a denominator that is not positive the whole strip slips;
/// the direction of slip is that of FASTSIM. The denominator, not the numerator of the quadratic
/// formula, remains regular at |φ′| = 1.
///
/// Source: Kalker 1967, Int. J. Mech. Sci. 9; Sichani, Enblom, Berg 2016, Vehicle System Dynamics
/// 54, 748–764.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StickZone {
    /// d, mm: x of its middle, half the length of the slip zone.
    pub middle: f64,
    /// a_y − d, mm.
    pub half_length: f64,
    /// a_y, mm.
    strip: f64,
    /// μp0/a, N/mm³.
    scale: f64,
    /// κ, λ of the strip and κ′, λ′ of the stick zone.
    pub(super) outer: [f64; 2],
    pub(super) inner: [f64; 2],
}

impl StickZone {
    /// The stick zone of the strip at `y` (mm) of `patch`; none where the whole strip slips, or the
    /// theory of the patch knows no strips.
    pub fn of(patch: &RollingPatch, y: f64) -> Option<Self> {
        let poisson = patch.steel.poisson();
        let share = match patch.theory {
            RollingTheory::FaStrip => 1.0,
            RollingTheory::Strip => 1.0 - poisson,
            RollingTheory::Fastsim | RollingTheory::Linear => return None,
        };
        let KalkerCoefficients { c11, c22, c23 } = patch.coefficients();
        let Creepage { longitudinal, lateral, spin } = patch.creepage;
        let (a, b) = (patch.ellipse.along, patch.ellipse.across);
        let limit = patch.friction * patch.ellipse.peak_pressure;
        let (shear, rigid) = (patch.steel.shear_modulus(), 1.0 - poisson);
        let creep = -2.0 * rigid * shear / (PI * PI * limit);
        let eta = creep * c22 * lateral;
        let phi = -3.0 * shear * (a * b).sqrt() * c23 * spin / (2.0 * PI * limit);
        let k = creep * c11 * longitudinal - phi * y / a;
        let strip = patch.half_length(y);
        let square = eta * eta + (1.0 - phi * phi) * k * k;
        if square < 0.0 {
            return None;
        }
        let (over, under) = (eta * eta + k * k, square.sqrt() - eta * phi);
        let zone = |middle: f64, [kappa, lambda]: [f64; 2]| Self {
            middle,
            half_length: strip - middle,
            strip,
            scale: limit / a,
            outer: [kappa, lambda],
            inner: [kappa, lambda - phi],
        };
        if over == 0.0 {
            // Spin alone, on the middle strip: its shear changes sign and reaches no limit.
            return (phi.abs() < 1.0).then(|| zone(0.0, [0.0, phi]));
        }
        if under <= 0.0 {
            return None;
        }
        let middle = a / rigid * over / under;
        let [along, across] = [k, eta + phi * share * middle / a];
        let size = along.hypot(across);
        (middle < strip && size > 0.0).then(|| zone(middle, [along / size, across / size]))
    }

    /// Whether wheel and rail stick at `x`, mm.
    pub fn holds(&self, x: f64) -> bool {
        x > self.middle - self.half_length
    }

    /// q_x and q_y at `x` (mm) in the stick zone, MPa.
    pub fn shear(&self, x: f64) -> [f64; 2] {
        let outer = ((self.strip - x) * (self.strip + x)).max(0.0).sqrt();
        let from = x - self.middle;
        let inner = ((self.half_length - from) * (self.half_length + from)).max(0.0).sqrt();
        [0, 1].map(|i| self.scale * (self.outer[i] * outer - self.inner[i] * inner))
    }
}
