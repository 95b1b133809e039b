//! Declaration of a growth law: its name, its constants, and how it is made of them.

use super::RateLaw;
use crate::fatigue::EquivalentRange;
use crate::words::Word;

/// Everything that case files, results and documents say of a growth law. Each law has one, in its
/// own file.
#[derive(Debug, Clone, Copy)]
pub struct LawDeclaration {
    /// Name in case files, and formula.
    pub word: Word,
    /// The equivalent range that belongs to the law; none where any may be chosen.
    pub own_range: Option<OwnRange>,
    /// The numbers that it is made of.
    pub input: LawInput,
}

/// Two declarations are equal when they are of the same law.
impl PartialEq for LawDeclaration {
    fn eq(&self, other: &Self) -> bool {
        self.word.name == other.word.name
    }
}

/// An equivalent range of ΔK_I and ΔK_II that a law has to itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OwnRange {
    /// The range.
    pub range: EquivalentRange,
    /// Reason for refusing another one: a sentence without a capital and a full stop.
    pub reason: &'static str,
}

/// The numbers that a law is made of.
#[derive(Debug, Clone, Copy)]
pub enum LawInput {
    /// Constants of a formula.
    Constants(&'static LawConstants),
    /// Measured rates, a [`RateTable`](super::RateTable).
    Table,
}

/// The constants of a law.
#[derive(Debug, Clone, Copy)]
pub struct LawConstants {
    /// All of them, in the order in which they are written.
    pub all: &'static [Constant],
    /// The coefficient, in proportion to which the rate is: the one that measurements fit.
    pub coefficient: Constant,
    /// The exponent of the range, where it may be chosen.
    pub exponent: Option<Constant>,
    /// The law of the values of `all`; none of another number of values.
    pub law: fn(&[f64]) -> Option<RateLaw>,
    /// A rate computed by hand, with the default of every constant.
    pub check: CheckValue,
}

/// A constant of a law.
#[derive(Debug, Clone, Copy)]
pub struct Constant {
    /// Key in case files.
    pub key: &'static str,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
    /// The smallest and the largest value that is accepted.
    pub range: (f64, f64),
    /// The default.
    pub default: f64,
    /// One sentence.
    pub doc: &'static str,
    /// Reason why it means nothing to other laws.
    pub reason: &'static str,
}

/// A rate of a law.
#[derive(Debug, Clone, Copy)]
pub struct CheckValue {
    /// Equivalent range, MPa√m.
    pub delta: f64,
    /// The ratio R.
    pub ratio: f64,
    /// da/dN, mm per cycle, to seven digits.
    pub rate: f64,
}

/// Unit of a coefficient.
pub(super) const RATE_UNIT: &str = "mm/cycle, MPa sqrt(m)";

/// Unit of ranges and of toughness.
pub(super) const K_UNIT: &str = "MPa sqrt(m)";

/// Accepted exponents of a range.
pub(super) const EXPONENTS: (f64, f64) = (0.1, 20.0);

/// Accepted coefficients of a law in [`RATE_UNIT`].
pub(super) const COEFFICIENTS: (f64, f64) = (1e-30, 1.0);

impl Constant {
    /// The threshold of the laws that have none of their own.
    pub const THRESHOLD: Self = Self {
        reason: "the law has a threshold of its own",
        ..Self::new(
            "threshold_mpa_sqrt_m",
            K_UNIT,
            (0.0, 1e3),
            0.0,
            "Threshold of dKeq, at or below which a crack does not grow.",
        )
    };

    /// A constant of one law, or of laws of one form.
    pub const fn new(
        key: &'static str,
        unit: &'static str,
        range: (f64, f64),
        default: f64,
        doc: &'static str,
    ) -> Self {
        Self { key, unit, range, default, doc, reason: "every other law has its own constants" }
    }
}
