//! Creepages and spin, and the two conventions for their signs.

use crate::math::OutOfRange;
use crate::words::{Choice, Word};

/// Rigid slip of wheel and rail over the speed of travel, at the point (x, y) of the patch
/// (ξ − φ y, η + φ x): x with the travel, y across; the spin turns +x towards +y.
///
/// The signs are those of CONTACT: ξ > 0 of a driving wheel, whose force on the rail is F_x < 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Creepage {
    /// ξ, along the rail.
    pub longitudinal: f64,
    /// η, across the rail.
    pub lateral: f64,
    /// φ, per mm.
    pub spin: f64,
}

impl Creepage {
    /// Rejects values that are not finite.
    pub fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless_finite("longitudinal creepage", self.longitudinal)?;
        OutOfRange::unless_finite("lateral creepage", self.lateral)?;
        OutOfRange::unless_finite("spin (1/mm)", self.spin)
    }

    /// Whether wheel and rail roll on each other without slip.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// The same creepage with all signs exchanged.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { longitudinal: -self.longitudinal, lateral: -self.lateral, spin: -self.spin }
    }
}

/// Convention for the signs of creepages and spin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CreepageSign {
    /// Those of [`Creepage`].
    Contact,
    /// All signs opposite.
    Vehicle,
}

impl CreepageSign {
    /// `given` in this convention, in that of [`Creepage`].
    #[must_use]
    pub fn read(self, given: Creepage) -> Creepage {
        match self {
            Self::Contact => given,
            Self::Vehicle => given.reversed(),
        }
    }
}

impl Choice for CreepageSign {
    const WORDS: &'static [(Self, Word)] = &[
        (
            Self::Contact,
            Word::now("contact", "of the program CONTACT: longitudinal creepage > 0 of a driving wheel"),
        ),
        (
            Self::Vehicle,
            Word::now(
                "vehicle",
                "of most vehicle codes, (V - omega r)/V: longitudinal creepage > 0 of a braking wheel",
            ),
        ),
    ];
}
