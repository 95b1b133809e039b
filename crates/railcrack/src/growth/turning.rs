//! How a path turns towards the best kink.

use crate::words::{Choice, Word};
use serde::{Deserialize, Serialize};

/// How a path turns towards the best kink θ* of the direction criterion.
///
/// The best kink of a tip that slides in both directions does not vanish with the increment, so
/// that a path that kinks by θ* in each increment has no limit. With a length, it has one: the path
/// turns by dθ/ds = θ*/ℓ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turning {
    /// By a whole kink in each increment, as in Trollé et al. 2014: the path depends on the
    /// increment.
    Kink,
    /// Over the turning length ℓ, mm. Infinite: straight ahead. Zero: the limit path, on which the
    /// best kink is zero at each tip.
    Over(f64),
}

impl Turning {
    /// The turning length of a case file by default, mm.
    pub const DEFAULT_LENGTH: f64 = 0.5;

    /// Whether each increment turns by a whole kink.
    #[must_use]
    pub fn is_kink(self) -> bool {
        self == Self::Kink
    }

    /// Whether the path is the limit path.
    #[must_use]
    pub fn is_limit(self) -> bool {
        self == Self::Over(0.0)
    }

    /// dθ/ds (rad/mm) towards the best kink `best` (rad); zero for the limit path, whose turns
    /// follow from the tips at their ends, and for whole kinks.
    pub(crate) fn curvature(self, best: f64) -> f64 {
        match self {
            Self::Over(length) if length > 0.0 => best / length,
            Self::Kink | Self::Over(_) => 0.0,
        }
    }
}

/// The turn of a tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// The crack, from 0.
    pub crack: usize,
    /// The tip, from 0.
    pub tip: usize,
    /// Radians, counter-clockwise.
    pub angle: f64,
}

/// Why a path does not turn smoothly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Jump {
    /// The best kink is larger than what a path turns through smoothly.
    Kink,
    /// The other of two nearly equal directions has become the best.
    Rival,
    /// The limit path turns at once, by less than a kink.
    Bend,
    /// The tip pops in: it extends at once under one load, and arrests.
    PopIn,
}

impl Choice for Jump {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Kink, Word::now("kink", "the best kink exceeds kink_angle_deg")),
        (Self::Rival, Word::now("rival", "the other of two nearly equal directions has become the best")),
        (Self::Bend, Word::now("bend", "the limit path turns at once, by less than kink_angle_deg")),
        (Self::PopIn, Word::now("pop-in", "the tip extends at once under one load, and arrests")),
    ];
}
