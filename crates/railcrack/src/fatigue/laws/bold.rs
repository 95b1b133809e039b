//! The law of Bold, Brown and Allen.

use super::law::Law;

/// da/dN = C (ΔK_eq^3.74 − 4^3.74) with ΔK_eq² = ΔK_I² + [(614/507) ΔK_II^3.21]^(2/3.74), measured
/// on rail steel under sequences of mode I and mode II.
///
/// Source: Bold, Brown & Allen 1991, Wear 144, 307–317 (constants quoted from memory).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bold {
    /// C, mm per cycle with ΔK in MPa√m.
    pub c: f64,
}

impl Bold {
    /// The constants of the source.
    pub const RAIL_STEEL: Self = Self { c: 5.07e-10 };
    /// Exponent of the mode I term.
    pub const EXPONENT: f64 = 3.74;
    /// Threshold, MPa√m.
    pub const THRESHOLD: f64 = 4.0;

    /// ΔK_eq (MPa√m) of `delta_ki` and `delta_kii` (MPa√m): the mode II term makes the same rate
    /// as 6.14e-10 ΔK_II^3.21 above the threshold.
    #[must_use]
    pub fn equivalent(delta_ki: f64, delta_kii: f64) -> f64 {
        let shear = (614.0 / 507.0 * delta_kii.powf(3.21)).powf(Self::EXPONENT.recip());
        delta_ki.hypot(shear)
    }
}

impl Law for Bold {
    fn rate(&self, delta: f64, _: f64) -> f64 {
        (self.c * (delta.powf(Self::EXPONENT) - Self::THRESHOLD.powf(Self::EXPONENT))).max(0.0)
    }

    fn formula(&self) -> String {
        format!("{:e} (dK^{m} - {}^{m})", self.c, Self::THRESHOLD, m = Self::EXPONENT)
    }

    fn exponent(&self) -> f64 {
        Self::EXPONENT
    }
}
