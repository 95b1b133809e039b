//! How a path turns towards the best kink, and growth that is deferred behind a kink.
//!
//! Tips that are slower than the fastest one make shorter increments. No engine resolves a segment
//! that is much shorter than its neighbours, and after a kink such a segment governs K. The growth
//! of a slow tip is therefore deferred after a kink: it accumulates until it amounts to a full
//! increment, which is what the tip would make if it were the fastest, and is then added to the
//! crack as one segment. Where every increment kinks, all tips thus advance by about the same
//! fraction of their cracks, the slow ones less often, and a crack lags by less than one increment:
//! an error of first order.
//!
//! Where the path turns smoothly a short segment has no corner, and growth is deferred only up to a
//! fixed small fraction of the length, behind one of its rare kinks up to twice that: the error of
//! a slow tip is of second order in the increment, as is that of the fastest, but for that
//! fraction.

use crate::fatigue::SECONDARY_DISTANCE;
use crate::math::Vec2;
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

    /// The turn (radians) over an increment (mm) at whose start the best kink was `best` (radians),
    /// of a path that turns towards that direction over the turning length, but over `least` (mm)
    /// where that is longer.
    pub(crate) fn turn(self, best: f64, increment: f64, least: f64) -> f64 {
        let length = match self {
            Self::Over(length) => length.max(least),
            Self::Kink => least,
        };
        -best * (-increment / length).exp_m1()
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

/// The increment after a kink, as a fraction of the length: the rates change over lengths in
/// proportion to the distance from it.
pub(super) const AFTER_KINK: f64 = 0.004;

/// Growth of a tip that has not been added to its crack yet.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct DeferredGrowth {
    /// Its length, mm: the sum of the increments.
    pub length: f64,
    /// Its direction, a unit vector: that of the last part where the path turns smoothly; zero
    /// where no growth is deferred.
    pub direction: Vec2,
    /// Whether it begins with a kink.
    pub is_kinked: bool,
}

impl DeferredGrowth {
    /// Growth that reaches this fraction of a full increment in one step is not deferred, so that
    /// tips of about the same speed, such as those of a row of cracks, stay level.
    pub(crate) const KEEPS_PACE: f64 = 2.0 / 3.0;
    /// Smooth growth of this fraction of the length of the crack is not deferred: the shortest
    /// increment behind a kink. A lag of 0.4 % changes K by 0.2 %, and the rate by 0.6 % at most.
    pub(crate) const LEAST_SMOOTH: f64 = AFTER_KINK;
    /// Where paths turn over a length, growth behind a kink of this fraction is not deferred
    /// either: kinks are rare, and the second increment of the fastest tip behind one is as long.
    /// The rates change abruptly with the kink.
    pub(crate) const LEAST_KINKED: f64 = 2.0 * AFTER_KINK;
    /// Growth below this part of a full increment is deferred where the surface is removed.
    pub(crate) const LEAST_DRAWN: f64 = 0.1;

    /// The deferred growth after a further `increment` (mm) in `direction` (a unit vector).
    ///
    /// Lengths add up, which keeps the number of cycles right; a vector sum would be shorter. The
    /// direction is the length-weighted mean over increments on the same branch: the first
    /// increment decides how the tip kinks, and no tip grows in a direction between two branches.
    pub fn and(self, increment: f64, direction: Vec2) -> Self {
        if self.length == 0.0 {
            return Self { length: increment, direction, is_kinked: true };
        }
        let length = self.length + increment;
        let same_branch =
            self.direction.cross(direction).atan2(self.direction.dot(direction)).abs() < SECONDARY_DISTANCE;
        if !same_branch {
            return Self { length, ..self };
        }
        let sum = self.direction * self.length + direction * increment;
        Self { length, direction: sum * sum.length().recip(), ..self }
    }

    /// The deferred growth after a further `increment` (mm) with which a path that runs along
    /// `ahead` (a unit vector) turns by `turn` (radians), `at_once` or smoothly. After a kink the
    /// path goes straight on until it is drawn, since the tip has not moved yet.
    pub fn turned(self, increment: f64, ahead: Vec2, turn: f64, at_once: bool) -> Self {
        let length = self.length + increment;
        if self.is_kinked {
            return Self { length, ..self };
        }
        let before = if self.length > 0.0 { self.direction } else { ahead };
        Self { length, direction: Vec2::unit(before.angle() + turn), is_kinked: at_once }
    }

    /// The share of it that was already deferred `before` the last increment.
    pub(crate) fn share_of(self, before: Self) -> f64 {
        if before.length == 0.0 { 0.0 } else { before.length / self.length }
    }
}
