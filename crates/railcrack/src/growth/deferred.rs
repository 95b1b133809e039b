//! Deferred growth: increments too short to be segments of a crack.
//!
//! Tips slower than the fastest make shorter increments. No engine resolves a segment that is much
//! shorter than its neighbours, and behind a kink such a segment governs K. The growth of a slow
//! tip is therefore deferred: it accumulates until it amounts to a whole increment, the one that
//! the tip would make if it were the fastest, and is then added to the crack as one segment. All
//! tips thus advance by about the same fraction of their cracks, the slow ones less often. The
//! crack lags by less than one increment, which is within the error of the path of straight
//! increments, does not depend on the engine, and vanishes with the increment.

use crate::fatigue::SECONDARY_DISTANCE;
use crate::math::Vec2;
use serde::{Deserialize, Serialize};

/// Growth of a tip that is not in its crack yet.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct DeferredGrowth {
    /// Its length, mm: the sum of the increments.
    pub length: f64,
    /// Its direction, a unit vector; zero where none is deferred.
    pub direction: Vec2,
}

impl DeferredGrowth {
    /// A tip whose growth in a step reaches this fraction of a whole increment is not deferred:
    /// tips that are about equally fast, such as those of a row of cracks, stay level.
    pub(crate) const KEEPS_PACE: f64 = 2.0 / 3.0;

    /// This and an `increment` (mm) in `direction` (a unit vector).
    ///
    /// Lengths add up, so that the number of cycles is right; a sum of vectors would be shorter.
    /// The direction is the mean weighted by length, over increments on the same branch: the first
    /// increment decides how the tip kinks, and no tip would grow between two branches.
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
        let sum = self.direction * self.length + direction * increment;
        Self { length, direction: sum * sum.length().recip() }
    }

    /// The share of it that was there `before` the last increment.
    pub(crate) fn share_of(self, before: Self) -> f64 {
        if before.length == 0.0 { 0.0 } else { before.length / self.length }
    }
}
