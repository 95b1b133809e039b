//! Passages until their history repeats, and the errors of a step.

use super::{FaceRecord, PassageRecord, PassageSettings, SolverCounts};
use crate::body::BodyError;
use crate::contact::{CrackFrictionError, FaceState, SteppingError};
use crate::crack::NetworkError;
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

    /// Forgets the faces but at the output position where they are widest open.
    pub(crate) fn keep_widest(&mut self) {
        let widest = |states: &Vec<FaceState>| states.iter().map(|state| state.opening).fold(0.0, f64::max);
        let all = std::mem::take(&mut self.faces.states).into_iter();
        self.faces.states.extend(all.max_by(|a, b| widest(a).total_cmp(&widest(b))));
        self.faces.surface.clear();
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

/// A passage that may repeat the previous one.
pub(crate) trait Repeats: Sized {
    /// The part of a passage that is kept.
    type Record: Clone;

    /// The record of this passage.
    fn record(&self) -> Self::Record;

    /// The largest change of K at any tip and position since the passage recorded in `before`,
    /// relative to the largest |K|.
    fn change_from(&self, before: &Self::Record) -> f64;

    /// Whether it coincides with the previous passage from some position on; the next passage is
    /// then identical to this one.
    fn joins(&self) -> bool {
        false
    }
}

/// All passages, with the last one in full.
pub(crate) struct Repeated<P: Repeats> {
    pub records: Vec<P::Record>,
    pub last: P,
    /// Change of K between the last two passages; `None` after a single passage.
    pub change: Option<f64>,
}

/// Whether the faces retain a memory of a passage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Memory {
    /// Friction locks in slip, so that passages differ until the history repeats.
    Friction,
    /// Without friction all passages are the same.
    None,
}

/// Computes passages with `pass`, which takes the number of the passage (from 1) and the previous
/// one, until they repeat or their number reaches the limit in `settings`; without memory, a single
/// passage.
pub(crate) fn until_repeated<P: Repeats, E>(
    settings: &PassageSettings,
    memory: Memory,
    mut pass: impl FnMut(usize, Option<&P>) -> Result<P, E>,
) -> Result<Repeated<P>, E> {
    let mut records: Vec<P::Record> = Vec::new();
    let mut before: Option<P> = None;
    loop {
        let last = pass(records.len() + 1, before.as_ref())?;
        let mut change = records.last().map(|before| last.change_from(before));
        records.push(last.record());
        let mut repeats = change.is_some_and(|change| change <= settings.passage_tolerance);
        if last.joins() && !repeats && records.len() < settings.max_passages {
            records.push(last.record());
            (change, repeats) = (Some(0.0), true);
        }
        if repeats || records.len() >= settings.max_passages || memory == Memory::None {
            return Ok(Repeated { records, last, change });
        }
        before = Some(last);
    }
}

/// Why a step could not be computed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GrowthError {
    /// Settings under which nothing can be computed.
    #[error(transparent)]
    Settings(#[from] OutOfRange),
    /// Crack-face friction that does not fit the cracks.
    #[error(transparent)]
    Friction(#[from] CrackFrictionError),
    /// The observer interrupted the step; the state before it is intact.
    #[error("interrupted at step {step}")]
    Interrupted {
        /// The step that was abandoned.
        step: usize,
    },
    /// The engine cannot represent the cracks.
    #[error("step {step}: {source}")]
    Body {
        /// The step.
        step: usize,
        /// The error of the engine.
        source: BodyError,
    },
    /// Contact did not converge.
    #[error("step {step}: {source}")]
    Passage {
        /// The step.
        step: usize,
        /// The position and the failure.
        source: PassageError,
    },
    /// A state with cracks in the plane given to a run in space, or vice versa.
    #[error("step {step}: the state contains cracks {found}, but the engine computes cracks {wanted}")]
    Geometry {
        /// The step.
        step: usize,
        /// The kind of cracks in the state.
        found: &'static str,
        /// The kind of cracks that the engine computes.
        wanted: &'static str,
    },
    /// The cracks have run into each other.
    #[error("step {step}: {source}")]
    Network {
        /// The step.
        step: usize,
        /// The cracks concerned.
        source: NetworkError,
    },
}

impl GrowthError {
    /// Whether the observer interrupted the step.
    #[must_use]
    pub fn is_interruption(&self) -> bool {
        matches!(self, Self::Interrupted { .. })
    }
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

    /// K of a passage.
    #[derive(Clone)]
    struct Value(f64);

    impl Repeats for Value {
        type Record = f64;

        fn record(&self) -> f64 {
            self.0
        }

        fn change_from(&self, before: &f64) -> f64 {
            (self.0 - before).abs()
        }
    }

    fn passes(memory: Memory, max_passages: usize) -> Repeated<Value> {
        let settings = PassageSettings { max_passages, passage_tolerance: 0.3, ..PassageSettings::default() };
        until_repeated(&settings, memory, |number, _| Ok::<_, ()>(Value(1.0 / number as f64))).unwrap()
    }

    #[test]
    fn passages_go_on_until_they_repeat_or_are_enough() {
        // 1, 1/2, 1/3: the last two differ by 1/6.
        let all = passes(Memory::Friction, 5);
        assert_eq!((all.records.len(), all.change), (3, Some(1.0 / 2.0 - 1.0 / 3.0)));
        assert_eq!(passes(Memory::Friction, 2).change, Some(0.5));
        let one = passes(Memory::None, 5);
        assert_eq!((one.records.len(), one.change), (1, None));
    }
}
