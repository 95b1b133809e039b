//! What moves a crack.

use serde::{Deserialize, Serialize};

/// A tip of a crack in the plane, or a motion of the front of a crack in space, with its rate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Mover {
    /// The crack, from 0.
    pub crack: usize,
    /// Of the crack, the tip (from 0) or the motion ([`FrontMotion`](super::FrontMotion) as a
    /// number).
    pub index: usize,
    /// Its rate, mm per cycle.
    pub rate: f64,
    /// Length of its crack, mm.
    pub length: f64,
}

impl Mover {
    /// Whether both are the same tip or motion.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        (self.crack, self.index) == (other.crack, other.index)
    }
}
