//! How far a study is: one bar for all runs on a terminal, a line per finished run elsewhere.

use crate::display::{Display, Verbosity, styled_bar};
use crate::progress::Tell;
use indicatif::ProgressBar;
use railcrack::growth::StepRecord;
use std::sync::atomic::{AtomicI64, AtomicUsize, Ordering};

/// Parts of a step on the bar.
const PARTS: i64 = 1000;

/// The progress of a study, told on standard error.
pub struct StudyProgress {
    display: Display,
    /// Parts of all runs that are done.
    done: AtomicI64,
    runs: usize,
    over: AtomicUsize,
}

impl StudyProgress {
    /// `runs` runs of `steps` steps altogether.
    pub fn new(verbosity: Verbosity, runs: usize, steps: usize) -> Self {
        let display = Display::new(verbosity, || bar(runs, steps));
        Self { display, done: AtomicI64::new(0), runs, over: AtomicUsize::new(0) }
    }

    /// The progress of one of its runs, of `steps` steps, which goes on with step `first`.
    pub fn of_run(&self, steps: usize, first: usize) -> RunProgress<'_> {
        let run = RunProgress {
            study: self,
            steps: steps as i64,
            step: AtomicI64::new(0),
            done: AtomicI64::new(0),
        };
        run.reach(first as i64, 0);
        run
    }

    /// A run is over; `told` says how.
    pub fn over(&self, told: &str) {
        let over = self.over.fetch_add(1, Ordering::Relaxed) + 1;
        if let Some(bar) = self.display.bar() {
            bar.set_prefix(format!("{over}/{}", self.runs));
        }
        self.display.say(&format!("[{over}/{}] {told}", self.runs));
    }

    /// Takes the bar away.
    pub fn close(&self) {
        self.display.close();
    }

    fn add(&self, parts: i64) {
        let done = self.done.fetch_add(parts, Ordering::Relaxed) + parts;
        if let Some(bar) = self.display.bar() {
            bar.set_position(u64::try_from(done).unwrap_or(0));
        }
    }
}

fn bar(runs: usize, steps: usize) -> ProgressBar {
    let template = "run {prefix} [{bar:36}] {percent}%  {elapsed} elapsed, {eta} left";
    let bar = styled_bar(steps as u64 * PARTS as u64, template);
    bar.set_prefix(format!("0/{runs}"));
    bar
}

/// The progress of one run of a study.
pub struct RunProgress<'a> {
    study: &'a StudyProgress,
    steps: i64,
    step: AtomicI64,
    /// Parts of it that the study counts.
    done: AtomicI64,
}

impl RunProgress<'_> {
    fn reach(&self, step: i64, parts: i64) {
        self.step.store(step, Ordering::Relaxed);
        self.count(step * PARTS + parts);
    }

    fn count(&self, parts: i64) {
        let before = self.done.swap(parts, Ordering::Relaxed);
        self.study.add(parts - before);
    }
}

impl Tell for RunProgress<'_> {
    fn fraction(&self, fraction: f64) {
        let parts = (fraction.clamp(0.0, 1.0) * PARTS as f64) as i64;
        self.count(self.step.load(Ordering::Relaxed) * PARTS + parts);
    }

    fn finished(&self, record: &StepRecord) {
        self.reach(record.step as i64 + 1, 0);
    }

    // Runs side by side tell of their steps only; what is to be known of one is in its folder.
    fn stage(&self, _: &str) {}

    fn note(&self, _: &str) {}

    /// A run that ends early has all its steps behind it.
    fn close(&self) {
        self.count(self.steps * PARTS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_all_runs_add_up() {
        let study = StudyProgress::new(Verbosity::Quiet, 2, 7);
        let (one, other) = (study.of_run(3, 0), study.of_run(4, 2));
        let done = || study.done.load(Ordering::Relaxed);
        assert_eq!(done(), 2 * PARTS);
        one.fraction(0.25);
        other.fraction(0.5);
        // Every passage of a step begins at zero again.
        one.fraction(0.125);
        assert_eq!(done(), 2 * PARTS + 625);
        one.close();
        other.close();
        assert_eq!(done(), 7 * PARTS);
    }
}
