//! Criteria for the direction of growth.

use crate::words::{Choice, Word};
use std::ops::RangeInclusive;

/// The quantity that the direction of growth maximises over the kink angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DirectionCriterion {
    /// The growth rate of the virtual kink, from the ranges of k1 and k2 (Hourlier & Pineau).
    #[default]
    MaxRate,
    /// The same with negative k1 counted as if a closed kink opened negatively: for comparison,
    /// since not every description of the criterion states that k1 is clipped.
    MaxRateUnclipped,
    /// The range of k1.
    MaxDeltaK1,
    /// The largest k1.
    MaxK1,
    /// No quantity: the crack grows straight ahead.
    Coplanar,
    /// The largest tangential stress ahead of the actual tip over the passage. Source: Erdogan &
    /// Sih 1963, J. Basic Eng. 85, 519–525.
    MaxTangentialStress,
    /// The range of the displacement vector of the faces at the tip of the virtual kink: the
    /// largest
    /// distance between two of its values (k1, k2) through the passage, k1 clipped at zero. After
    /// Li
    /// 1989, Fatigue Fract. Eng. Mater. Struct. 12, 59–65, and Salahi Nezhad et al. 2024, with the
    /// elastic displacement of a kink.
    MaxDeltaCtd,
}

impl Choice for DirectionCriterion {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::MaxRate, Word::now("max-rate", "the largest growth rate of the kink (Hourlier-Pineau)")),
        (
            Self::MaxRateUnclipped,
            Word::now("max-rate-unclipped", "the same, with negative k1 kept where max-rate takes zero"),
        ),
        (Self::MaxDeltaK1, Word::now("max-delta-k1", "the largest range of k1")),
        (Self::MaxK1, Word::now("max-k1", "the largest k1")),
        (Self::Coplanar, Word::now("coplanar", "straight ahead")),
        (Self::MaxTangentialStress, Word::now("mts", "the largest tangential stress ahead of the tip")),
        (
            Self::MaxDeltaCtd,
            Word::now("max-delta-ctd", "the largest range of the displacement vector at the tip of the kink"),
        ),
    ];
}

/// Range of kink angles that is searched, radians: the kink functions are accurate to about ±110°.
pub const KINK_ANGLES: RangeInclusive<f64> =
    -110.0 * std::f64::consts::PI / 180.0..=110.0 * std::f64::consts::PI / 180.0;
