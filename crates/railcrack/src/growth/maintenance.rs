//! Wear and grinding, which remove the running surface and the mouths of its cracks.

use crate::field::StressField;
use crate::math::{OutOfRange, Stress, Vec2};
use crate::words::{Choice, Word};

/// Removal of the running surface while cracks grow.
///
/// The mouth of a surface-breaking crack moves down along the crack: its length changes by dl/dN =
/// da/dN − w/sin θ, with w the wear per cycle and θ the angle of the crack at its mouth. Where the
/// two terms are equal, the crack is worn away as fast as it grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Maintenance {
    /// Wear of the running surface, mm per load cycle.
    pub wear: f64,
    /// Grinding, if any.
    pub grinding: Option<Grinding>,
    /// Effect of surface removal on the residual stress.
    pub stress: StressMoves,
    /// Depth of removal (mm) at which the rail is replaced, which ends the run.
    pub limit: Option<f64>,
}

/// Grinding at regular intervals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grinding {
    /// Depth removed each time, mm.
    pub depth: f64,
    /// Load cycles from one grinding to the next.
    pub interval: f64,
    /// Load cycles until the first one.
    pub first: f64,
}

impl Grinding {
    /// The load cycles at which the next grinding is due after `done` of them.
    #[must_use]
    pub fn at(&self, done: usize) -> f64 {
        self.first + self.interval * done as f64
    }
}

/// Shortfall of the removed depth, relative to the wear limit, that is attributed to rounding.
const LIMIT_ROUNDING: f64 = 1e-9;

/// Effect of surface removal on the residual stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressMoves {
    /// It stays where it is in the steel, and so comes closer to the surface.
    WithMetal,
    /// It keeps its depth below the surface, because rolling restores it as fast as the surface is
    /// removed.
    WithSurface,
}

impl Choice for StressMoves {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::WithMetal, Word::now("metal", "the stress stays in place in the steel")),
        (Self::WithSurface, Word::now("surface", "the stress keeps its depth below the surface")),
    ];
}

impl Maintenance {
    /// Rejects negative wear, a wear limit of zero, and grinding that removes nothing or never
    /// takes place.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let wears = self.wear >= 0.0 && self.wear.is_finite();
        OutOfRange::unless(wears, "wear (mm per cycle)", self.wear, "zero or more")?;
        OutOfRange::unless_positive("wear limit (mm)", self.limit.unwrap_or(1.0))?;
        let Some(Grinding { depth, interval, first }) = self.grinding else { return Ok(()) };
        OutOfRange::unless_positive("grinding depth (mm)", depth)?;
        let later = first >= 0.0 && first.is_finite();
        OutOfRange::unless(later, "cycles until the first grinding", first, "zero or more")?;
        OutOfRange::unless_positive("cycles between grindings", interval)
    }

    /// Whether `removed` (mm) of the surface reaches the wear limit.
    pub(crate) fn is_at_limit(&self, removed: f64) -> bool {
        self.limit.is_some_and(|limit| removed >= limit * (1.0 - LIMIT_ROUNDING))
    }

    /// The mean removal of the surface, mm per load cycle.
    #[must_use]
    pub fn removal(&self) -> f64 {
        self.wear + self.grinding.map_or(0.0, |grinding| grinding.depth / grinding.interval)
    }
}

/// A field fixed in the steel, seen from a surface that has receded by `removed` (mm).
pub(crate) struct Uncovered<'a> {
    pub field: &'a dyn StressField,
    pub removed: f64,
}

impl StressField for Uncovered<'_> {
    fn stress(&self, point: Vec2) -> Stress {
        self.field.stress(Vec2::new(point.x, point.y - self.removed))
    }
}
