//! Deferred growth: increments too short to be segments of a crack.
//!
//! The tips that are slower than the fastest make shorter increments, down to nothing. A segment much shorter than the others is
//! resolved by no engine, and behind a turn it decides K. So the growth of a slow tip is gathered until it is a whole increment, as the tip
//! would make it as the fastest, and is then put into the crack: every tip advances by increments of about the same share of its
//! crack, the slow ones at longer intervals. What the crack is behind by meanwhile is less than an increment, within the error of
//! explicit Euler steps. Nothing in it depends on the engine, and it vanishes with the increment.

use crate::fatigue::SECONDARY_DISTANCE;
use crate::math::Vec2;
use serde::{Deserialize, Serialize};

/// A tip that makes this part of a whole increment in a step, or more, makes it at once: tips that are about equally fast, as those of a
/// row of cracks, stay side by side.
pub(super) const KEEPS_PACE: f64 = 2.0 / 3.0;

/// Growth of a tip that is not in its crack yet.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct DeferredGrowth {
    /// Its length, mm: the sum of the increments.
    pub length: f64,
    /// Its direction, a unit vector; zero where none is deferred.
    pub direction: Vec2,
}

impl DeferredGrowth {
    /// This and an `increment` (mm) in `direction` (a unit vector).
    ///
    /// Lengths add up, so that the cycles of the tip are right; a sum of vectors would be shorter. Directions are weighted by length. Only
    /// a direction of the same branch counts, though: the first increment has decided how the tip kinks, and between two
    /// branches, or on the other one, is where no tip would be.
    pub fn and(self, increment: f64, direction: Vec2) -> Self {
        if self.length == 0.0 {
            return Self { length: increment, direction };
        }
        let length = self.length + increment;
        let same_branch =
            self.direction.cross(direction).atan2(self.direction.dot(direction)).abs() < SECONDARY_DISTANCE;
        if !same_branch {
            return Self { length, ..self };
        }
        let way = self.direction * self.length + direction * increment;
        Self { length, direction: way * way.length().recip() }
    }

    /// The share of it that was there `before` the last increment.
    pub(super) fn share_of(self, before: Self) -> f64 {
        if before.length == 0.0 { 0.0 } else { before.length / self.length }
    }
}
