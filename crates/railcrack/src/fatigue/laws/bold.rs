//! The law of Bold, Brown and Allen.

use super::rate_law::{
    COEFFICIENTS, CheckValue, Constant, Law, LawConstants, LawDeclaration, LawInput, OwnRange, RATE_UNIT,
};
use crate::fatigue::EquivalentRange;
use crate::words::Word;

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
}

const C: Constant = Constant::new(
    "bold_c",
    RATE_UNIT,
    COEFFICIENTS,
    Bold::RAIL_STEEL.c,
    "Coefficient C of C (dKeq^3.74 - 4^3.74).",
);

/// The declaration of the law.
pub(super) const DECLARATION: LawDeclaration = LawDeclaration {
    word: Word::now("bold", "C (dKeq^3.74 - 4^3.74), Bold, Brown and Allen 1991"),
    own_range: Some(OwnRange {
        range: EquivalentRange::Bold,
        reason: "the law of Bold, Brown and Allen defines its own equivalent range",
    }),
    input: LawInput::Constants(&LawConstants {
        all: &[C],
        coefficient: C,
        exponent: None,
        threshold: None,
        law: |values| match *values {
            [c] => Some(Bold { c }.into()),
            _ => None,
        },
        check: CheckValue { delta: 10.0, ratio: 0.5, rate: 2.695_659e-6 },
    }),
};

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

    fn constants(&self) -> Vec<f64> {
        vec![self.c]
    }
}
