//! The stabilised passage, and errors that prevent it.

use super::{FaceRecord, PassageRecord, SolverCounts};
use crate::contact::SteppingError;
use crate::field::EndsError;
use crate::fracture::SifHistory;
use crate::math::OutOfRange;
use thiserror::Error;

/// The stabilised passage and those before it.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilisedPassage {
    /// All passages, the stabilised one last.
    pub passages: Vec<PassageRecord>,
    /// Histories of K over the stabilised passage, one per tip, with all accepted substeps, every
    /// change of contact status and both unloaded ends.
    pub histories: Vec<SifHistory>,
    /// The faces at the output positions of the stabilised passage.
    pub faces: FaceRecord,
    /// Effort of all passages.
    pub counts: SolverCounts,
    /// Change of K between the last two passages, relative to its peak; `None` after a single
    /// passage.
    pub last_change: Option<f64>,
    /// The estimated error of K, where cracks are followed in groups.
    pub coupling: Option<GroupsError>,
    /// In space, the range of K_III of each front point over the samples of its history, MPa √mm;
    /// empty in the plane.
    pub delta_kiii: Vec<f64>,
}

/// Parts of the estimated error of K for cracks that are followed in groups: the largest at any
/// tip, relative to its peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroupsError {
    /// Error of the sweeps, which end before the groups agree completely.
    pub sweeps: f64,
    /// Error of interpolating the jumps of neighbouring cracks, estimated for free faces: an upper
    /// bound.
    pub interpolation: f64,
    /// Error of the expansion of forces between distant cracks, estimated likewise.
    pub far: f64,
}

impl GroupsError {
    /// The sum of all parts.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.sweeps + self.interpolation + self.far
    }
}

impl StabilisedPassage {
    /// Whether there is fluid in the cracks.
    pub(crate) fn is_wet(&self) -> bool {
        self.passages.last().is_some_and(|passage| !passage.fluid.is_empty())
    }

    /// Whether the wheel feels the cracks.
    pub(crate) fn is_coupled(&self) -> bool {
        self.passages.last().is_some_and(|passage| passage.wheel.iter().any(Option::is_some))
    }

    /// The largest opening of the faces at an output position, mm.
    pub(crate) fn largest_opening(&self) -> f64 {
        self.faces.states.iter().flatten().map(|state| state.opening).fold(0.0, f64::max)
    }

    /// The largest |K| of a tip, MPa √mm.
    fn peak(&self, tip: usize) -> f64 {
        let kiii = self.passages.last().and_then(|passage| passage.kiii.get(tip));
        let kiii = kiii.into_iter().flatten().map(|k| k.abs()).fold(0.0, f64::max);
        self.histories.get(tip).map_or(kiii, |history| history.peak().max(kiii))
    }

    /// How far the K_I of each tip falls below zero. As faces do not overlap, a negative K_I shows
    /// the error of the engine at a closed tip. `crack` is the crack of a tip.
    #[must_use]
    pub fn overlaps(&self, crack: impl Fn(usize) -> usize) -> Vec<Overlap> {
        let of = |tip: usize| {
            let own = (0..self.histories.len()).filter(|&other| crack(other) == crack(tip));
            let k1 =
                |fold: fn(f64, f64) -> f64| self.histories[tip].samples.iter().map(|k| k.ki).fold(0.0, fold);
            Overlap {
                tip,
                lowest: k1(f64::min),
                largest: k1(f64::max),
                peak: own.map(|other| self.peak(other)).fold(0.0, f64::max),
            }
        };
        (0..self.histories.len()).map(of).collect()
    }
}

/// K_I of a tip over a passage, MPa √mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// The tip.
    pub tip: usize,
    /// Its lowest K_I, or zero.
    pub lowest: f64,
    /// Its largest K_I, or zero.
    pub largest: f64,
    /// The largest |K| of its crack.
    pub peak: f64,
}

impl Overlap {
    /// A warning is due where K_I at a closed tip is negative by more than this share of the
    /// largest |K| of its crack. At default settings it is at most 0.7 % where K is accurate to
    /// 1 %; a tip at which the engines differed by 3.9 % had −3.9 %.
    const OF_CRACK: f64 = 0.01;
    /// The same of the largest K_I of the tip itself, on which the direction depends: over 278 tips
    /// of random networks it is the difference of K_I between the engines.
    const OF_OWN: f64 = 0.04;
    /// The share of the largest |K| of the crack from which K_I of a tip counts.
    const COUNTS: f64 = 0.01;

    /// The lowest K_I over the largest |K| of the crack.
    #[must_use]
    pub fn of_crack(&self) -> f64 {
        if self.peak > 0.0 { self.lowest / self.peak } else { 0.0 }
    }

    /// The lowest K_I over the largest one; zero where the tip hardly opens.
    #[must_use]
    pub fn of_own(&self) -> f64 {
        if self.largest > Self::COUNTS * self.peak { self.lowest / self.largest } else { 0.0 }
    }

    /// Whether K is less accurate than promised.
    #[must_use]
    pub fn is_large(&self) -> bool {
        self.of_crack() < -Self::OF_CRACK
    }

    /// Whether K_I is less accurate than directions need.
    #[must_use]
    pub fn is_large_of_own(&self) -> bool {
        self.of_own() < -Self::OF_OWN
    }
}

/// Reasons why a passage cannot be computed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PassageError {
    /// Inadmissible settings.
    #[error(transparent)]
    Settings(#[from] OutOfRange),
    /// The ends of the rail do not suit the wheel or the cracks.
    #[error(transparent)]
    Ends(#[from] EndsError),
    /// Contact did not converge.
    #[error("passage {passage}, {phase}: {source}")]
    NotConverged {
        /// Passage, from 1; 0 while residual stress is applied.
        passage: usize,
        /// The part of the passage.
        phase: &'static str,
        /// The position on the load path and the failure.
        source: SteppingError,
    },
    /// The observer requested an interruption.
    #[error("interrupted")]
    Interrupted,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fracture::Sif;

    #[test]
    fn the_lowest_opening_is_relative_to_the_largest_k() {
        let history = |ki: f64, kii: f64| SifHistory { samples: vec![Sif::default(), Sif { ki, kii }] };
        let mut passage = StabilisedPassage {
            passages: Vec::new(),
            histories: vec![history(10.0, -500.0), history(-20.0, 30.0)],
            faces: FaceRecord { points: Vec::new(), states: Vec::new(), across: None, surface: Vec::new() },
            counts: SolverCounts::default(),
            last_change: None,
            coupling: None,
            delta_kiii: Vec::new(),
        };
        let both = passage.overlaps(|_| 0);
        assert_eq!((both[1].of_crack(), both[1].of_own()), (-0.04, 0.0));
        assert!(both[1].is_large() && !both[0].is_large());
        // On a crack of its own, the tip has a smaller peak.
        assert_eq!(passage.overlaps(|tip| tip)[1].of_crack(), -20.0 / 30.0);
        passage.histories = vec![history(0.0, 0.0)];
        assert_eq!(passage.overlaps(|tip| tip)[0].of_crack(), 0.0, "unloaded");
        let opens = |lowest: f64| SifHistory {
            samples: vec![Sif { ki: 30.0, kii: 500.0 }, Sif { ki: lowest, kii: 0.0 }],
        };
        passage.histories = vec![opens(-1.0), opens(-1.5)];
        let own: Vec<bool> = passage.overlaps(|_| 0).iter().map(Overlap::is_large_of_own).collect();
        assert_eq!(own, [false, true]);
    }
}
