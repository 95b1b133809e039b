//! Paris' law with the threshold inside.

use super::paris::{C, M};
use super::rate_law::{CheckValue, Constant, Law, LawConstants, LawDeclaration, LawInput};
use crate::words::Word;

/// da/dN = C (ΔK^m − ΔK_th^m): the rate falls to zero at the threshold and does not jump there.
///
/// Source: the form of Klesnil & Lukáš 1972, Mater. Sci. Eng. 9, 231–240, as quoted in
/// Crack Paths 2009, p. 563.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParisThreshold {
    /// C, mm per cycle with ΔK in MPa√m.
    pub c: f64,
    /// m.
    pub m: f64,
    /// ΔK_th, MPa√m.
    pub threshold: f64,
}

/// The declaration of the law.
pub(super) const DECLARATION: LawDeclaration = LawDeclaration {
    word: Word::now("paris-threshold", "C (dKeq^m - dKth^m)"),
    own_range: None,
    input: LawInput::Constants(&LawConstants {
        all: &[C, M, Constant::THRESHOLD],
        coefficient: C,
        exponent: Some(M),
        threshold: Some(Constant::THRESHOLD),
        law: |values| match *values {
            [c, m, threshold] => Some(ParisThreshold { c, m, threshold }.into()),
            _ => None,
        },
        check: CheckValue { delta: 10.0, ratio: 0.5, rate: 4.275_924e-6 },
    }),
};

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

    fn constants(&self) -> Vec<f64> {
        vec![self.c, self.m, self.threshold]
    }
}
