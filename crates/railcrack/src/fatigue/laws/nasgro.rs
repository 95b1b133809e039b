//! The law of NASGRO.

use super::law::Law;
use std::f64::consts::PI;

/// da/dN = C [(1−f)/(1−R) ΔK]^n (1 − ΔK_th/ΔK)^p / (1 − K_max/K_c)^q with K_max = ΔK/(1−R) and
/// Newman's closure function f.
///
/// Source: Forman & Mettu 1992, ASTM STP 1131, 519–546; f from Newman 1984, Int. J. Fract. 24,
/// R131–R135.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nasgro {
    /// C, mm per cycle with ΔK in MPa√m.
    pub c: f64,
    /// n.
    pub n: f64,
    /// p, of the approach to the threshold.
    pub p: f64,
    /// q, of the approach to the toughness.
    pub q: f64,
    /// ΔK_th, MPa√m, whatever the ratio.
    pub threshold: f64,
    /// K_c, MPa√m.
    pub kc: f64,
    /// α, the constraint: 1 in plane stress, 3 in plane strain.
    pub alpha: f64,
    /// The largest stress over the flow stress.
    pub s: f64,
}

impl Nasgro {
    /// Newman's f, the opening K over K_max, at the ratio `ratio`.
    #[must_use]
    pub fn closure(&self, ratio: f64) -> f64 {
        let alpha = self.alpha;
        let a0 =
            (0.825 - 0.34 * alpha + 0.05 * alpha * alpha) * (0.5 * PI * self.s).cos().powf(alpha.recip());
        let a1 = (0.415 - 0.071 * alpha) * self.s;
        let a3 = 2.0 * a0 + a1 - 1.0;
        let a2 = 1.0 - a0 - a1 - a3;
        if ratio >= 0.0 {
            ratio.max(a0 + ratio * (a1 + ratio * (a2 + ratio * a3)))
        } else {
            a0 + a1 * ratio.max(-2.0)
        }
    }

    fn above_threshold(&self, delta: f64, ratio: f64) -> f64 {
        let largest = delta / (1.0 - ratio);
        let left = 1.0 - largest / self.kc;
        let effective = (1.0 - self.closure(ratio)) * largest;
        if left > 0.0 { self.c * effective.powf(self.n) / left.powf(self.q) } else { f64::INFINITY }
    }
}

impl Law for Nasgro {
    fn rate(&self, delta: f64, ratio: f64) -> f64 {
        let share = 1.0 - self.threshold / delta;
        if share > 0.0 { self.above_threshold(delta, ratio) * share.powf(self.p) } else { 0.0 }
    }

    fn drive(&self, delta: f64, ratio: f64) -> f64 {
        self.above_threshold(delta, ratio).powf(self.n.recip())
    }

    fn formula(&self) -> String {
        let Self { c, n, p, q, threshold, kc, .. } = *self;
        format!("{c:e} [(1-f)/(1-R) dK]^{n} (1 - {threshold}/dK)^{p}/(1 - Kmax/{kc})^{q}")
    }

    fn exponent(&self) -> f64 {
        self.n
    }
}
