//! Paris' law with the threshold inside.

use super::law::Law;

/// da/dN = C (ΔK^m − ΔK_th^m): the rate falls to zero at the threshold and does not jump there.
///
/// Source: the form of Klesnil & Lukáš 1972, Mater. Sci. Eng. 9, 231–240 (quoted from memory).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParisThreshold {
    /// C, mm per cycle with ΔK in MPa√m.
    pub c: f64,
    /// m.
    pub m: f64,
    /// ΔK_th, MPa√m.
    pub threshold: f64,
}

impl Law for ParisThreshold {
    fn rate(&self, delta: f64, _: f64) -> f64 {
        (self.c * (delta.powf(self.m) - self.threshold.powf(self.m))).max(0.0)
    }

    fn formula(&self) -> String {
        format!("{:e} (dK^{m} - {}^{m})", self.c, self.threshold, m = self.m)
    }

    fn exponent(&self) -> f64 {
        self.m
    }
}
