//! Progress of sweeps over groups of cracks.

use super::Observer;
use std::sync::atomic::{AtomicUsize, Ordering};

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
