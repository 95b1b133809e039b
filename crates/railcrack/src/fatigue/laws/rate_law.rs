//! The table of the laws of the growth rate.

use super::law::Law;
use super::{Bold, Forman, Nasgro, Paris, ParisThreshold, RateTable, Walker};

/// Declares [`RateLaw`]: a row for each law.
macro_rules! laws {
    ($($(#[doc = $doc:literal])+ $law:ident($of:ty) = $name:literal;)+) => {
        /// A law of the growth rate.
        #[derive(Debug, Clone, PartialEq)]
        pub enum RateLaw {
            $($(#[doc = $doc])+ $law($of),)+
        }

        impl RateLaw {
            /// The name in case files.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$law(_) => $name,)+
                }
            }

            fn law(&self) -> &dyn Law {
                match self {
                    $(Self::$law(law) => law,)+
                }
            }
        }
    };
}

laws! {
    /// C ΔK^m above a threshold.
    Paris(Paris) = "paris";
    /// C (ΔK^m − ΔK_th^m).
    ParisThreshold(ParisThreshold) = "paris-threshold";
    /// The same with constants for rail steel in non-proportional mixed mode.
    Bold(Bold) = "bold";
    /// C [ΔK/(1−R)^(1−γ)]^m.
    Walker(Walker) = "walker";
    /// C ΔK^m/((1−R) K_c − ΔK).
    Forman(Forman) = "forman";
    /// Threshold, closure and toughness in one formula.
    Nasgro(Nasgro) = "nasgro";
    /// Measured rates.
    Table(RateTable) = "table";
}

impl RateLaw {
    /// da/dN (mm per cycle) under the equivalent range `delta` (MPa√m), zero or more, with the
    /// ratio `ratio` = K_min/K_max, up to 1. Zero where nothing grows; infinite where K_max
    /// reaches the toughness that some laws contain.
    #[must_use]
    pub fn rate(&self, delta: f64, ratio: f64) -> f64 {
        if delta > 0.0 { self.law().rate(delta, ratio) } else { 0.0 }
    }

    /// A quantity that grows with the rate under `delta` (MPa√m) and `ratio`, and that no threshold
    /// flattens: the equivalent range itself where the law knows no other.
    pub(in crate::fatigue) fn drive(&self, delta: f64, ratio: f64) -> f64 {
        if delta > 0.0 { self.law().drive(delta, ratio) } else { 0.0 }
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

    /// This law with all its rates times `factor`.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        let mut law = self.clone();
        match &mut law {
            Self::Paris(law) => law.c *= factor,
            Self::ParisThreshold(law) => law.c *= factor,
            Self::Bold(law) => law.c *= factor,
            Self::Walker(law) => law.c *= factor,
            Self::Forman(law) => law.c *= factor,
            Self::Nasgro(law) => law.c *= factor,
            Self::Table(table) => *table = table.times(factor),
        }
        law
    }
}
