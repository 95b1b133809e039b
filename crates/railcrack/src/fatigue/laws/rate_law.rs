//! The law of the growth rate, one of a table.

use super::RateLaw;

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

            fn law(&self) -> &dyn law::Law {
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
        self.law().threshold()
    }

    /// The same law with the threshold `threshold` (MPa√m), where it has a constant for it.
    pub(in crate::fatigue) fn with_threshold(&self, threshold: f64) -> Self {
        self.law().with_threshold(threshold).unwrap_or_else(|| self.clone())
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
        self.law().times(factor)
    }
}
