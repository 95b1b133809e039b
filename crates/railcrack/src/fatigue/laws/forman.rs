//! Forman's law.

use super::law::{Law, above};

/// da/dN = C ΔK^m/((1−R) K_c − ΔK) above a threshold of ΔK: the crack runs away as K_max = ΔK/(1−R)
/// reaches K_c.
///
/// Source: Forman, Kearney & Engle 1967, J. Basic Eng. 89, 459–463.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forman {
    /// C, mm per cycle times MPa√m, with ΔK in MPa√m.
    pub c: f64,
    /// m.
    pub m: f64,
    /// K_c, MPa√m.
    pub kc: f64,
    /// Threshold ΔK (MPa√m), at or below which no crack grows.
    pub threshold: f64,
}

impl Forman {
    fn unbounded(&self, delta: f64, ratio: f64) -> f64 {
        let left = (1.0 - ratio) * self.kc - delta;
        if left > 0.0 { self.c * delta.powf(self.m) / left } else { f64::INFINITY }
    }
}

impl Law for Forman {
    fn rate(&self, delta: f64, ratio: f64) -> f64 {
        if delta > self.threshold { self.unbounded(delta, ratio) } else { 0.0 }
    }

    fn drive(&self, delta: f64, ratio: f64) -> f64 {
        self.unbounded(delta, ratio).powf(self.m.recip())
    }

    fn formula(&self) -> String {
        let Self { c, m, kc, threshold } = *self;
        format!("{c:e} dK^{m}/((1-R) {kc} - dK){}", above(threshold))
    }

    fn exponent(&self) -> f64 {
        self.m
    }
}
