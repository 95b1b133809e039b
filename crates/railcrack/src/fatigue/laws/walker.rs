//! Walker's law.

use super::rate_law::{
    COEFFICIENTS, CheckValue, Constant, EXPONENTS, Law, LawConstants, LawDeclaration, LawInput, RATE_UNIT,
    above,
};
use crate::words::Word;

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

impl Walker {
    /// The range at R = 0 with the same rate.
    fn effective(&self, delta: f64, ratio: f64) -> f64 {
        delta / (1.0 - ratio).powf(1.0 - self.gamma)
    }
}

const C: Constant = Constant::new(
    "walker_c",
    RATE_UNIT,
    COEFFICIENTS,
    2e-9,
    "Coefficient C of C [dKeq / (1-R)^(1-gamma)]^m.",
);

const M: Constant = Constant::new("walker_m", "", EXPONENTS, 3.33, "Exponent m.");

const GAMMA: Constant = Constant::new(
    "walker_gamma",
    "",
    (0.0, 1.0),
    0.6,
    "Exponent gamma: 1 is Paris' law, 0 a law of the largest K.",
);

/// The declaration of the law.
pub(super) const DECLARATION: LawDeclaration = LawDeclaration {
    word: Word::now("walker", "C [dKeq / (1-R)^(1-gamma)]^m above the threshold"),
    own_range: None,
    input: LawInput::Constants(&LawConstants {
        all: &[C, M, GAMMA, Constant::THRESHOLD],
        coefficient: C,
        exponent: Some(M),
        threshold: Some(Constant::THRESHOLD),
        law: |values| match *values {
            [c, m, gamma, threshold] => Some(Walker { c, m, gamma, threshold }.into()),
            _ => None,
        },
        check: CheckValue { delta: 12.0, ratio: 0.3, rate: 1.261_923e-5 },
    }),
};

impl Law for Walker {
    fn rate(&self, delta: f64, ratio: f64) -> f64 {
        if delta > self.threshold { self.c * self.effective(delta, ratio).powf(self.m) } else { 0.0 }
    }

    fn drive(&self, delta: f64, ratio: f64) -> Option<f64> {
        Some(self.effective(delta, ratio))
    }

    fn formula(&self) -> String {
        let Self { c, m, gamma, threshold } = *self;
        format!("{c:e} [dK/(1-R)^{:.4}]^{m}{}", 1.0 - gamma, above(threshold))
    }

    fn exponent(&self) -> f64 {
        self.m
    }

    fn constants(&self) -> Vec<f64> {
        vec![self.c, self.m, self.gamma, self.threshold]
    }
}
