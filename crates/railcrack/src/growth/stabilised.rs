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
    /// The largest |K| of all tips, MPa √mm.
    fn peak(&self) -> f64 {
        let kiii = self.passages.last().into_iter().flat_map(|passage| passage.kiii.iter().flatten());
        let kiii = kiii.map(|k| k.abs()).fold(0.0, f64::max);
        self.histories.iter().map(SifHistory::peak).fold(kiii, f64::max)
    }

    /// The tip with the lowest K_I, and the ratio of that K_I to the largest |K| of all tips. As
    /// faces do not overlap, a negative value shows the error of the engine at a closed tip.
    #[must_use]
    pub fn lowest_opening(&self) -> Option<(usize, f64)> {
        self.lowest_opening_where(|_| true)
    }

    /// [`StabilisedPassage::lowest_opening`] of the tips that `counts`.
    pub(super) fn lowest_opening_where(&self, counts: impl Fn(usize) -> bool) -> Option<(usize, f64)> {
        let peak = self.peak();
        let lowest = |history: &SifHistory| history.samples.iter().map(|k| k.ki).fold(0.0, f64::min);
        let tips = self.histories.iter().map(|history| lowest(history) / peak).enumerate();
        tips.filter(|(tip, _)| peak > 0.0 && counts(*tip)).min_by(|a, b| a.1.total_cmp(&b.1))
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
            faces: FaceRecord { points: Vec::new(), states: Vec::new(), across: None },
            counts: SolverCounts::default(),
            last_change: None,
            coupling: None,
            delta_kiii: Vec::new(),
        };
        assert_eq!(passage.lowest_opening(), Some((1, -0.04)));
        passage.histories = vec![history(0.0, 0.0)];
        assert_eq!(passage.lowest_opening(), None, "unloaded");
    }
}
