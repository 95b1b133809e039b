//! Paris' law.

use super::rate_law::{
    COEFFICIENTS, CheckValue, Constant, EXPONENTS, Law, LawConstants, LawDeclaration, LawInput, RATE_UNIT,
    above,
};
use crate::words::Word;

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

/// C.
pub(super) const C: Constant = Constant::new(
    "paris_c",
    RATE_UNIT,
    COEFFICIENTS,
    Paris::RAIL_STEEL.c,
    "Coefficient C of the law; at dKeq = 10 MPa sqrt(m) the rate is at most a millimetre per cycle.",
);

/// m.
pub(super) const M: Constant =
    Constant::new("paris_m", "", EXPONENTS, Paris::RAIL_STEEL.m, "Exponent m of the law.");

/// The declaration of the law.
pub(super) const DECLARATION: LawDeclaration = LawDeclaration {
    word: Word::now("paris", "C dKeq^m above the threshold"),
    own_range: None,
    input: LawInput::Constants(&LawConstants {
        all: &[C, M, Constant::THRESHOLD],
        coefficient: C,
        exponent: Some(M),
        threshold: Some(Constant::THRESHOLD),
        law: |values| match *values {
            [c, m, threshold] => Some(Paris { c, m, threshold }.into()),
            _ => None,
        },
        check: CheckValue { delta: 10.0, ratio: 0.5, rate: 4.275_924e-6 },
    }),
};

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

    fn constants(&self) -> Vec<f64> {
        vec![self.c, self.m, self.threshold]
    }
}
