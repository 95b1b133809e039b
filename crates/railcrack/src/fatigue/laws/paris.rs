//! Paris' law.

use super::law::{Law, above};

/// da/dN = C ΔK^m above a threshold, zero at or below it: the rate jumps there.
///
/// Source: Paris & Erdogan 1963, J. Basic Eng. 85, 528–533; constants of rail steel from Trollé et
/// al. 2014, eq. 30, read in mm per cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paris {
    /// C, mm per cycle with ΔK in MPa√m.
    pub c: f64,
    /// m.
    pub m: f64,
    /// Threshold ΔK (MPa√m), at or below which no crack grows.
    pub threshold: f64,
}

impl Paris {
    /// Rail steel as in Trollé et al. 2014, eq. 30, read in mm per cycle.
    pub const RAIL_STEEL: Self = Self { c: 2e-9, m: 3.33, threshold: 0.0 };
}

impl Law for Paris {
    fn rate(&self, delta: f64, _: f64) -> f64 {
        if delta > self.threshold { self.c * delta.powf(self.m) } else { 0.0 }
    }

    fn formula(&self) -> String {
        format!("{:e} dK^{}{}", self.c, self.m, above(self.threshold))
    }

    fn exponent(&self) -> f64 {
        self.m
    }
}
