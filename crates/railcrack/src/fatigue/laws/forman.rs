//! Forman's law.

use super::rate_law::{
    CheckValue, Constant, EXPONENTS, K_UNIT, Law, LawConstants, LawDeclaration, LawInput, RATE_UNIT, above,
};
use crate::words::Word;

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

const C: Constant = Constant::new(
    "forman_c",
    RATE_UNIT,
    (1e-30, 1e3),
    5e-8,
    "Coefficient C of C dKeq^m / ((1-R) Kc - dKeq).",
);

const M: Constant = Constant::new("forman_m", "", EXPONENTS, 3.0, "Exponent m.");

const KC: Constant = Constant::new(
    "forman_kc",
    K_UNIT,
    (0.1, 1e3),
    60.0,
    "Kc, at which the crack runs away: the run ends with fracture.",
);

/// The declaration of the law.
pub(super) const DECLARATION: LawDeclaration = LawDeclaration {
    word: Word::now("forman", "C dKeq^m / ((1-R) Kc - dKeq) above the threshold"),
    own_range: None,
    input: LawInput::Constants(&LawConstants {
        all: &[C, M, KC, Constant::THRESHOLD],
        coefficient: C,
        exponent: Some(M),
        threshold: Some(Constant::THRESHOLD),
        law: |values| match *values {
            [c, m, kc, threshold] => Some(Forman { c, m, kc, threshold }.into()),
            _ => None,
        },
        check: CheckValue { delta: 12.0, ratio: 0.3, rate: 2.88e-6 },
    }),
};

impl Law for Forman {
    fn rate(&self, delta: f64, ratio: f64) -> f64 {
        if delta > self.threshold { self.unbounded(delta, ratio) } else { 0.0 }
    }

    fn drive(&self, delta: f64, ratio: f64) -> Option<f64> {
        Some(self.unbounded(delta, ratio).powf(self.m.recip()))
    }

    fn formula(&self) -> String {
        let Self { c, m, kc, threshold } = *self;
        format!("{c:e} dK^{m}/((1-R) {kc} - dK){}", above(threshold))
    }

    fn exponent(&self) -> f64 {
        self.m
    }

    fn constants(&self) -> Vec<f64> {
        vec![self.c, self.m, self.kc, self.threshold]
    }
}
