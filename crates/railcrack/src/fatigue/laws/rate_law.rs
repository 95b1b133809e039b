//! Laws of the growth rate: what a law declares, and the one of a run.

use super::RateLaw;
use crate::fatigue::EquivalentRange;
use crate::words::Word;

/// Declares the modules of the laws and [`RateLaw`]: a row for each, `Variant(file::Type)`, whose
/// file has the type and its `DECLARATION`.
macro_rules! laws {
    ($($law:ident($file:ident::$of:ident);)+) => {
        $(mod $file;)+
        $(pub use $file::$of;)+

        /// A law of the growth rate.
        #[derive(Debug, Clone, PartialEq)]
        pub enum RateLaw {
            $(#[doc = concat!("[`", stringify!($of), "`].")] $law($of),)+
        }

        $(impl From<$of> for RateLaw {
            fn from(law: $of) -> Self {
                Self::$law(law)
            }
        })+

        impl RateLaw {
            /// The declaration of the law.
            #[must_use]
            pub fn declaration(&self) -> &'static LawDeclaration {
                match self {
                    $(Self::$law(_) => &$file::DECLARATION,)+
                }
            }

            fn law(&self) -> &dyn rate_law::Law {
                match self {
                    $(Self::$law(law) => law,)+
                }
            }
        }

        impl LawDeclaration {
            /// All laws.
            pub const ALL: &'static [&'static Self] = &[$(&$file::DECLARATION),+];
        }

        impl crate::words::Choice for &'static LawDeclaration {
            const WORDS: &'static [(Self, crate::words::Word)] =
                &[$((&$file::DECLARATION, $file::DECLARATION.word)),+];
        }
    };
}

pub(super) use laws;

impl RateLaw {
    /// da/dN (mm per cycle) under the equivalent range `delta` (MPa√m), zero or more, with the
    /// ratio `ratio` = K_min/K_max, up to 1. Zero where nothing grows; infinite where K_max
    /// reaches the toughness that some laws contain.
    #[must_use]
    pub fn rate(&self, delta: f64, ratio: f64) -> f64 {
        if delta > 0.0 { self.law().rate(delta, ratio) } else { 0.0 }
    }

    /// A quantity that grows with the rate under `delta` (MPa√m) and `ratio`, and that no threshold
    /// flattens; none where the law knows no other than the equivalent range itself.
    pub(in crate::fatigue) fn drive(&self, delta: f64, ratio: f64) -> Option<f64> {
        let drive = self.law().drive(delta, ratio)?;
        Some(if delta > 0.0 { drive } else { 0.0 })
    }

    /// The threshold of the range, MPa√m; none where the law has no constant for it.
    pub(crate) fn threshold(&self) -> Option<f64> {
        let (_, place) = self.place_of(|of| of.threshold)?;
        Some(self.constants()[place])
    }

    /// The same law with the threshold `threshold` (MPa√m), where it has a constant for it.
    pub(in crate::fatigue) fn with_threshold(&self, threshold: f64) -> Self {
        self.changed(|of| of.threshold, |_| threshold).unwrap_or_else(|| self.clone())
    }

    /// The constants that the law declares, and the place of one of them among their values.
    pub(in crate::fatigue) fn place_of(
        &self,
        constant: impl Fn(&LawConstants) -> Option<Constant>,
    ) -> Option<(&'static LawConstants, usize)> {
        let LawInput::Constants(of) = self.declaration().input else { return None };
        let constant = constant(of)?;
        Some((of, of.all.iter().position(|one| one.key == constant.key)?))
    }

    /// The law with a constant changed; none where it has none of this kind.
    pub(in crate::fatigue) fn changed(
        &self,
        constant: impl Fn(&LawConstants) -> Option<Constant>,
        change: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let (of, place) = self.place_of(constant)?;
        let mut values = self.constants();
        values[place] = change(values[place]);
        (of.law)(&values)
    }

    /// The ratio of the rates of two drives, far from a threshold.
    pub(in crate::fatigue) fn ratio(&self, drive: f64, best: f64) -> f64 {
        let ratio = (drive / best).powf(self.law().exponent());
        if ratio.is_finite() { ratio } else { 1.0 }
    }

    /// The law with its constants as a line of text, `dK` for the equivalent range.
    #[must_use]
    pub fn formula(&self) -> String {
        format!("da/dN = {}", self.law().formula())
    }

    /// The name in case files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.declaration().word.name
    }

    /// The values of the constants in the order of the declaration; none of a table.
    #[must_use]
    pub fn constants(&self) -> Vec<f64> {
        self.law().constants()
    }

    /// This law with all its rates times `factor`.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        match self {
            Self::Table(table) => table.times(factor).into(),
            _ => self.changed(|of| Some(of.coefficient), |c| c * factor).unwrap_or_else(|| self.clone()),
        }
    }
}

/// A rate (mm per cycle) that stands for a crack that runs away: a metre per cycle.
pub const RUNAWAY: f64 = 1e3;

/// A law of the growth rate under ranges of K in MPa√m.
pub(super) trait Law {
    /// da/dN, mm per cycle, under the equivalent range `delta` (MPa√m) with the ratio `ratio` of
    /// the smallest to the largest K; zero where nothing grows, infinite where the crack runs away.
    fn rate(&self, delta: f64, ratio: f64) -> f64;

    /// A quantity that grows with the rate and is not flattened by a threshold, so that a direction
    /// can be found below it; none where it is `delta` itself, in whatever unit.
    fn drive(&self, _delta: f64, _ratio: f64) -> Option<f64> {
        None
    }

    /// The exponent of the rate in [`Law::drive`], far from a threshold.
    fn exponent(&self) -> f64;

    /// The values of the constants in the order of the declaration; none of a table.
    fn constants(&self) -> Vec<f64>;

    /// The law with its constants, `dK` for the equivalent range: `da/dN = …`, mm per cycle and
    /// MPa√m.
    fn formula(&self) -> String;
}

/// A threshold as a condition.
pub(super) fn above(threshold: f64) -> String {
    if threshold > 0.0 { format!(" above dK = {threshold}") } else { String::new() }
}

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
    /// The threshold of the range, where it may be chosen.
    pub threshold: Option<Constant>,
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
pub(in crate::fatigue) const K_UNIT: &str = "MPa sqrt(m)";

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
