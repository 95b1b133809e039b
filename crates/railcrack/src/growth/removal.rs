//! Wear and grinding, which remove the running surface and the mouths of its cracks.

use super::record::{Piece, PieceCause, PieceKind};
use super::tonnage::{Axles, Mgt, Traffic};
use crate::field::StressField;
use crate::math::{OutOfRange, Stress, Vec2};
use crate::words::{Choice, Word};

/// Removal of the running surface while cracks grow, over traffic in axles or million gross tonnes.
///
/// The mouth of a surface-breaking crack moves down along the crack: its length changes by dl/dN =
/// da/dN − w/sin θ, with w the wear per cycle and θ the angle of the crack at its mouth. Where the
/// two terms are equal, the crack is worn away as fast as it grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceRemoval<T> {
    /// Wear of the running surface, mm per axle or per million gross tonnes.
    pub wear: f64,
    /// Grinding, if any.
    pub grinding: Option<Grinding<T>>,
    /// Depth of removal (mm) at which the rail is replaced, which ends the run.
    pub limit: Option<f64>,
    /// Effect of the removal on the residual stress.
    pub stress: StressMoves,
    /// Thickness (mm) from which the loss of a piece of the surface is a failure; `None` for
    /// [`SurfaceRemoval::least_spall`] by itself.
    pub least_spall: Option<f64>,
}

/// Grinding at regular intervals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grinding<T> {
    /// Depth removed each time, mm.
    pub depth: f64,
    /// Traffic from one grinding to the next.
    pub interval: T,
    /// Traffic until the first one; `None` for one interval.
    pub first: Option<T>,
}

/// Thickness (mm) of a flake that is no loss of running surface: traffic wears its edge down, as it
/// does with the flakes of a head-checked gauge corner.
pub const THIN_FLAKE: f64 = 0.3;

/// Shortfall of the removed depth, relative to the wear limit or in removals per interval, that is
/// attributed to rounding.
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

impl<T: Traffic> Grinding<T> {
    /// Traffic until the first grinding.
    #[must_use]
    pub fn until_first(&self) -> T {
        self.first.unwrap_or(self.interval)
    }

    /// The traffic at which the next grinding is due after `done` of them.
    #[must_use]
    pub fn at(&self, done: usize) -> T {
        T::of(self.until_first().amount() + self.interval.amount() * done as f64)
    }
}

impl<T> SurfaceRemoval<T> {
    /// Nothing is removed.
    pub const NONE: Self =
        Self { wear: 0.0, grinding: None, limit: None, stress: StressMoves::WithMetal, least_spall: None };

    /// Thickness (mm) from which the loss of a piece of the surface is a failure: where it is not
    /// given, that of the next grinding, which takes thinner flakes with it, and [`THIN_FLAKE`] at
    /// least.
    #[must_use]
    pub fn least_spall(&self) -> f64 {
        let ground = self.grinding.as_ref().map_or(0.0, |grinding| grinding.depth);
        self.least_spall.unwrap_or(ground.max(THIN_FLAKE))
    }

    /// Whether the loss of `piece` is a failure of the rail. A flake that a grinding cuts off comes
    /// away with it, however thick, unless a thickness is given.
    #[must_use]
    pub fn is_loss(&self, piece: &Piece) -> bool {
        let is_ground = piece.cause == PieceCause::Grinding && self.least_spall.is_none();
        piece.kind == PieceKind::Detached || (!is_ground && piece.thickness >= self.least_spall())
    }

    /// The depth (mm) at which the rail is replaced, less what is attributed to rounding.
    #[must_use]
    pub fn reached_limit(&self) -> Option<f64> {
        self.limit.map(|limit| limit * (1.0 - LIMIT_ROUNDING))
    }
}

impl<T: Traffic> SurfaceRemoval<T> {
    /// The mean removal of the surface, mm per unit of traffic.
    #[must_use]
    pub fn mean_rate(&self) -> f64 {
        self.wear + self.grinding.map_or(0.0, |grinding| grinding.depth / grinding.interval.amount())
    }

    /// Depth (mm) removed by the traffic up to `until`, with the first `grindings`.
    #[must_use]
    pub fn removed_at(&self, until: T, grindings: usize) -> f64 {
        self.wear * until.amount() + self.ground(grindings)
    }

    /// The traffic at which the next grinding is due after `done` of them; infinite without any.
    #[must_use]
    pub fn next_grinding(&self, done: usize) -> T {
        self.grinding.map_or(T::of(f64::INFINITY), |grinding| grinding.at(done))
    }

    /// The traffic at which after `done` grindings the next one is due, or wear reaches the limit.
    #[must_use]
    pub fn next_event(&self, done: usize) -> T {
        let limit = self.limit.map_or(f64::INFINITY, |limit| (limit - self.ground(done)) / self.wear);
        T::of(self.next_grinding(done).amount().min(limit))
    }

    /// The traffic after which the rail is worn to its limit: by wear between two grindings, or at
    /// one of them. `None` without a limit or where nothing is removed.
    #[must_use]
    pub fn replacement(&self) -> Option<T> {
        let limit = self.limit?;
        let by_wear = |ground: f64| (limit - ground).max(0.0) / self.wear;
        let Some(grinding @ Grinding { depth, .. }) = self.grinding else {
            return Some(by_wear(0.0)).filter(|amount| amount.is_finite()).map(T::of);
        };
        let (first, interval) = (grinding.until_first().amount(), grinding.interval.amount());
        // The first grinding k after which `first + k interval` of wear and k + 1 grindings reach
        // the limit.
        let short = limit - self.wear * first - depth;
        let k = (short / (self.wear * interval + depth) - LIMIT_ROUNDING).ceil().max(0.0);
        Some(T::of(by_wear(k * depth).min(first + k * interval)))
    }

    /// The removal over the traffic in which cracks grow as much as others do in the traffic of
    /// `self`, which they outpace by the factor `speed`.
    #[must_use]
    pub fn outpaced(&self, speed: f64) -> Self {
        let longer = |traffic: T| T::of(traffic.amount() * speed);
        let grinding = self.grinding.map(|grinding| Grinding {
            interval: longer(grinding.interval),
            first: grinding.first.map(longer),
            ..grinding
        });
        Self { wear: self.wear / speed, grinding, ..*self }
    }

    /// Depth (mm) that `grindings` remove.
    fn ground(&self, grindings: usize) -> f64 {
        self.grinding.map_or(0.0, |grinding| grinding.depth * grindings as f64)
    }
}

impl SurfaceRemoval<Mgt> {
    /// The same over axles of `tonnes`.
    #[must_use]
    pub fn over_axles(&self, tonnes: f64) -> SurfaceRemoval<Axles> {
        let grinding = self.grinding.map(|Grinding { depth, interval, first }| Grinding {
            depth,
            interval: interval.axles(tonnes),
            first: first.map(|first| first.axles(tonnes)),
        });
        let wear = 1e-6 * tonnes * self.wear;
        let Self { limit, stress, least_spall, .. } = *self;
        SurfaceRemoval { wear, grinding, limit, stress, least_spall }
    }
}

impl SurfaceRemoval<Axles> {
    /// Rejects negative wear, a wear limit of zero, and grinding that removes nothing or never
    /// takes place.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let wears = self.wear >= 0.0 && self.wear.is_finite();
        OutOfRange::unless(wears, "wear (mm per cycle)", self.wear, "zero or more")?;
        OutOfRange::unless_positive("wear limit (mm)", self.limit.unwrap_or(1.0))?;
        let Some(grinding) = self.grinding else { return Ok(()) };
        OutOfRange::unless_positive("grinding depth (mm)", grinding.depth)?;
        let Axles(first) = grinding.until_first();
        let later = first >= 0.0 && first.is_finite();
        OutOfRange::unless(later, "cycles until the first grinding", first, "zero or more")?;
        OutOfRange::unless_positive("cycles between grindings", grinding.interval.0)
    }

    /// Whether `removed` (mm) of the surface reaches the wear limit.
    pub(crate) fn is_at_limit(&self, removed: f64) -> bool {
        self.reached_limit().is_some_and(|limit| removed >= limit)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The removal step by step: wear up to each grinding, then the grinding.
    fn step_by_step(removal: &SurfaceRemoval<Mgt>, limit: f64) -> f64 {
        let Grinding { depth, interval, first } = removal.grinding.unwrap();
        let (mut at, mut removed) = (0.0, 0.0);
        let mut next = first.unwrap_or(interval).0;
        loop {
            let worn = removed + removal.wear * (next - at);
            if worn >= limit {
                return at + (limit - removed) / removal.wear;
            }
            (at, removed) = (next, worn + depth);
            if removed >= limit {
                return at;
            }
            next += interval.0;
        }
    }

    #[test]
    fn the_rail_is_replaced_when_wear_or_a_grinding_reaches_the_limit() {
        let removal =
            |wear, grinding| SurfaceRemoval { wear, grinding, limit: Some(14.0), ..SurfaceRemoval::NONE };
        let every = |depth, interval, first: Option<f64>| {
            Some(Grinding { depth, interval: Mgt(interval), first: first.map(Mgt) })
        };
        assert_eq!(removal(0.02, None).replacement(), Some(Mgt(700.0)));
        assert_eq!(SurfaceRemoval { limit: None, ..removal(0.02, None) }.replacement(), None);
        // 70 grindings of 0.2 mm, the last one at the limit.
        assert_eq!(removal(0.0, every(0.2, 10.0, None)).replacement(), Some(Mgt(700.0)));
        for wear in [0.003, 0.02, 0.3] {
            for (depth, interval) in [(0.1, 5.0), (0.5, 20.0), (3.0, 70.0), (20.0, 30.0)] {
                for first in [None, Some(0.0), Some(2.0), Some(60.0)] {
                    let removal = removal(wear, every(depth, interval, first));
                    let want = step_by_step(&removal, 14.0);
                    let got = removal.replacement().unwrap().0;
                    assert!((got - want).abs() < 1e-9 * want.max(1.0), "{removal:?}: {got} {want}");
                }
            }
        }
    }
}
