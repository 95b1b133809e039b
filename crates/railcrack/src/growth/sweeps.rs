//! Sweeps over groups of cracks: a waveform relaxation with overlapping blocks (Schwarz).
//!
//! Each group is followed under the wheel and the forces of all cracks that are not among its
//! members, with the jumps that these cracks had in the previous sweep, each in its own group. The
//! error that is left after a sweep is due to the coupling beyond the members of a group.

use super::{Observer, PassageSettings};
use crate::words::{Choice, Word};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Largest number of sweeps over a passage.
const MOST_SWEEPS: usize = 12;

/// Interpolation error of the jumps that groups keep for each other, relative to the largest jump:
/// with 3e-3 the sweeps in the plane no longer terminate.
pub(crate) const KEPT: f64 = 3e-4;

/// The error that sweeps leave, from the changes of K between them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SweepError {
    /// The last known ratio of the change of K in a sweep to that in the previous sweep.
    contraction: f64,
    /// That ratio is assumed to be at least this large.
    least_contraction: f64,
    /// The change in the last sweep over this part of the load path.
    before: f64,
    sweeps: usize,
    /// The largest estimated error left at the end of a part, relative to the peak of K.
    pub largest: f64,
}

impl SweepError {
    /// The error before any sweep.
    pub fn new(least_contraction: f64) -> Self {
        Self { contraction: 1.0, least_contraction, before: 0.0, sweeps: 0, largest: 0.0 }
    }

    /// Begins a part of the load path, and gives the number of its first sweep.
    pub fn begin(&mut self) -> usize {
        (self.before, self.sweeps) = (0.0, 1);
        self.sweeps
    }

    /// The number of the next sweep after one that changed K by `change`, relative to its peak;
    /// `None` where the sweeps have ended.
    pub fn next(&mut self, change: f64, settings: &PassageSettings) -> Option<usize> {
        // Changes below that are due to the load steps.
        if self.before > settings.step_tolerance {
            self.contraction = (change / self.before).clamp(self.least_contraction, 1.0);
        }
        self.before = change;
        let left = self.contraction * change;
        if left <= settings.network_tolerance || self.sweeps == MOST_SWEEPS {
            self.largest = self.largest.max(left);
            return None;
        }
        self.sweeps += 1;
        Some(self.sweeps)
    }
}

/// Progress of a sweep over groups, which may end in any order. The number of sweeps is unknown:
/// each one is reported as half of the remaining progress.
pub(crate) struct SweepProgress<'a> {
    observer: &'a dyn Observer,
    groups: usize,
    done: AtomicUsize,
    /// The share that was left before this sweep.
    left: f64,
}

impl<'a> SweepProgress<'a> {
    /// Of sweep `number` (from 1) over `groups`.
    pub fn new(observer: &'a dyn Observer, number: usize, groups: usize) -> Self {
        Self { observer, groups, done: AtomicUsize::new(0), left: 0.5f64.powi(number as i32 - 1) }
    }

    /// Reports that another group is done.
    pub fn group_done(&self) {
        let share = (self.done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / self.groups as f64;
        self.observer.progress(1.0 - self.left * (1.0 - 0.5 * share));
    }
}

/// Treatment of the contact of many cracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NetworkContact {
    /// All cracks are followed together, event by event.
    #[default]
    Whole,
    /// Each crack is followed with its neighbours, event by event, under the forces of all others,
    /// in sweeps until they agree. For engines that build bodies by groups; with finite elements,
    /// cracks are followed together.
    Groups,
}

impl Choice for NetworkContact {
    const WORDS: &'static [(Self, Word)] = &[
        (
            Self::Whole,
            Word::now("whole", "all cracks together; the cost grows with the square of their number"),
        ),
        (
            Self::Groups,
            Word::now(
                "groups",
                "each crack with its neighbours, in sweeps until they agree within network_tolerance; for dozens of cracks, with the dislocation or the space engine and the newton solver, without trapped fluid and without fields",
            ),
        ),
    ];
}
