//! The law of NASGRO.

use super::rate_law::{
    COEFFICIENTS, CheckValue, Constant, EXPONENTS, K_UNIT, Law, LawConstants, LawDeclaration, LawInput,
    RATE_UNIT,
};
use crate::words::Word;
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

const C: Constant = Constant::new(
    "nasgro_c",
    RATE_UNIT,
    COEFFICIENTS,
    1e-9,
    "Coefficient C of C [(1-f)/(1-R) dKeq]^n (1 - dKth/dKeq)^p / (1 - Kmax/Kc)^q.",
);

const N: Constant = Constant::new("nasgro_n", "", EXPONENTS, 3.0, "Exponent n.");

const P: Constant = Constant::new("nasgro_p", "", (0.0, 10.0), 0.5, "Exponent p.");

const Q: Constant = Constant::new("nasgro_q", "", (0.0, 10.0), 0.5, "Exponent q.");

const THRESHOLD: Constant = Constant::new("nasgro_threshold", K_UNIT, (0.0, 1e3), 5.0, "dKth.");

const KC: Constant = Constant::new(
    "nasgro_kc",
    K_UNIT,
    (0.1, 1e3),
    40.0,
    "Kc, at which the crack runs away: the run ends with fracture.",
);

const ALPHA: Constant = Constant::new(
    "nasgro_alpha",
    "",
    (1.0, 3.0),
    2.5,
    "Constraint alpha of Newman's f: 1 in plane stress, 3 in plane strain.",
);

const S: Constant =
    Constant::new("nasgro_s", "", (0.0, 0.99), 0.3, "Largest stress over flow stress in Newman's f.");

/// The declaration of the law.
pub(super) const DECLARATION: LawDeclaration = LawDeclaration {
    word: Word::now("nasgro", "with closure, threshold and toughness"),
    own_range: None,
    input: LawInput::Constants(&LawConstants {
        all: &[C, N, P, Q, THRESHOLD, KC, ALPHA, S],
        coefficient: C,
        exponent: Some(N),
        threshold: Some(THRESHOLD),
        law: |values| match *values {
            [c, n, p, q, threshold, kc, alpha, s] => {
                Some(Nasgro { c, n, p, q, threshold, kc, alpha, s }.into())
            }
            _ => None,
        },
        check: CheckValue { delta: 12.0, ratio: 0.3, rate: 1.220_730e-6 },
    }),
};

impl Law for Nasgro {
    fn rate(&self, delta: f64, ratio: f64) -> f64 {
        let share = 1.0 - self.threshold / delta;
        if share > 0.0 { self.above_threshold(delta, ratio) * share.powf(self.p) } else { 0.0 }
    }

    fn drive(&self, delta: f64, ratio: f64) -> Option<f64> {
        Some(self.above_threshold(delta, ratio).powf(self.n.recip()))
    }

    fn formula(&self) -> String {
        let Self { c, n, p, q, threshold, kc, .. } = *self;
        format!("{c:e} [(1-f)/(1-R) dK]^{n} (1 - {threshold}/dK)^{p}/(1 - Kmax/{kc})^{q}")
    }

    fn exponent(&self) -> f64 {
        self.n
    }

    fn constants(&self) -> Vec<f64> {
        vec![self.c, self.n, self.p, self.q, self.threshold, self.kc, self.alpha, self.s]
    }
}
