//! Stick zones of strip theory.

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
/// With d > a_y the whole strip slips. Without a real root, or with a denominator that is not
/// positive, the theory has no answer, which happens for |φ′| > 1 only. The denominator, not the
/// numerator of the quadratic formula, remains regular at |φ′| = 1.
///
/// With t = e_2/e_1, which falls from √(1 − d/a_y) at the leading edge to 0, the shear is
/// |(κ, λ) − t (κ, λ − φ′)| of the limit: below it where t (1 − 2λφ′ + φ′²) < 2 (1 − λφ′), as it is
/// for all |φ′| ≤ 1. A zone in which it exceeds the limit is no answer either.
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

/// A strip by strip theory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Regime {
    /// It sticks in a zone.
    Sticks(StickZone),
    /// It slips as a whole.
    Slips,
    /// Nothing: the spin is too large.
    Unknown,
}

impl Regime {
    /// The regime of the strip at `y` (mm) of `patch`, whose theory knows strips.
    pub fn of(patch: &RollingPatch, y: f64) -> Self {
        let poisson = patch.steel.poisson();
        let share = if patch.theory == RollingTheory::Strip { 1.0 - poisson } else { 1.0 };
        let KalkerCoefficients { c11, c22, .. } = patch.coefficients();
        let Creepage { longitudinal, lateral, .. } = patch.creepage;
        let a = patch.ellipse.along;
        let limit = patch.friction * patch.ellipse.peak_pressure;
        let (shear, rigid) = (patch.steel.shear_modulus(), 1.0 - poisson);
        let creep = -2.0 * rigid * shear / (PI * PI * limit);
        let eta = creep * c22 * lateral;
        let phi = patch.relative_spin();
        let k = creep * c11 * longitudinal - phi * y / a;
        let strip = patch.half_length(y);
        let square = eta * eta + (1.0 - phi * phi) * k * k;
        let (over, under) = (eta * eta + k * k, square.max(0.0).sqrt() - eta * phi);
        let zone = |middle: f64, [kappa, lambda]: [f64; 2]| {
            let (outer, inner) = ([kappa, lambda], [kappa, lambda - phi]);
            let half_length = strip - middle;
            Self::Sticks(StickZone { middle, half_length, strip, scale: limit / a, outer, inner })
        };
        if over == 0.0 {
            // Spin alone, on the middle strip: its shear changes sign and reaches no limit.
            return if phi.abs() < 1.0 { zone(0.0, [0.0, phi]) } else { Self::Unknown };
        }
        if square < 0.0 || under <= 0.0 {
            return Self::Unknown;
        }
        let middle = a / rigid * over / under;
        if middle >= strip {
            return Self::Slips;
        }
        let [along, across] = [k, eta + phi * share * middle / a];
        let size = along.hypot(across);
        let lambda = across / size;
        let leading = (1.0 - middle / strip).sqrt() * (1.0 - 2.0 * lambda * phi + phi * phi);
        let within = phi.abs() <= 1.0 || leading <= 2.0 * (1.0 - lambda * phi);
        if size > 0.0 && within { zone(middle, [along / size, lambda]) } else { Self::Unknown }
    }
}

impl StickZone {
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
