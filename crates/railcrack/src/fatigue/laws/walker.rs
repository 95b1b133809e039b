//! Walker's law.

use super::law::{Law, above};

/// da/dN = C [ΔK/(1−R)^(1−γ)]^m above a threshold of ΔK: γ = 1 is Paris' law.
///
/// Source: Walker 1970, ASTM STP 462, 1–14.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walker {
    /// C, mm per cycle with ΔK in MPa√m.
    pub c: f64,
    /// m.
    pub m: f64,
    /// γ, the share of the range.
    pub gamma: f64,
    /// Threshold ΔK (MPa√m), at or below which no crack grows.
    pub threshold: f64,
}

impl Law for Walker {
    fn rate(&self, delta: f64, ratio: f64) -> f64 {
        if delta > self.threshold { self.c * self.drive(delta, ratio).powf(self.m) } else { 0.0 }
    }

    fn drive(&self, delta: f64, ratio: f64) -> f64 {
        delta / (1.0 - ratio).powf(1.0 - self.gamma)
    }

    fn formula(&self) -> String {
        let Self { c, m, gamma, threshold } = *self;
        format!("{c:e} [dK/(1-R)^{:.4}]^{m}{}", 1.0 - gamma, above(threshold))
    }

    fn exponent(&self) -> f64 {
        self.m
    }
}
