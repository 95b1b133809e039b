//! Progress of a study: one bar for all runs on a terminal, one line per finished run elsewhere.

use crate::display::{Display, SteadyTime, Verbosity, styled_bar, time_text};
use crate::interruption::Interruption;
use indicatif::ProgressBar;
use railcrack::growth::StepRecord;
use railcrack_run::simulation::{RunObserver, StudyObserver};
use railcrack_run::study::PlannedRun;
use std::sync::atomic::{AtomicI64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Parts of a step on the bar.
const PARTS: i64 = 1000;

/// Progress of a study, shown on standard error.
pub struct StudyProgress<'a> {
    display: Display,
    interruption: &'a Interruption,
    /// Number of finished parts of all runs.
    done: AtomicI64,
    runs: usize,
    over: AtomicUsize,
    begun: Instant,
    left: Mutex<SteadyTime>,
}

/// Seconds after which the time left can be estimated.
const SETTLED: f64 = 2.0;

impl<'a> StudyProgress<'a> {
    /// `runs` runs with `steps` steps in total, which `interruption` can stop.
    pub fn new(verbosity: Verbosity, runs: usize, steps: usize, interruption: &'a Interruption) -> Self {
        let display = Display::new(verbosity, || bar(runs, steps));
        let (begun, left) = (Instant::now(), Mutex::default());
        Self { display, interruption, done: AtomicI64::new(0), runs, over: AtomicUsize::new(0), begun, left }
    }

    /// Removes the bar.
    pub fn close(&self) {
        self.display.close();
    }

    /// The time left, from the share that is done of what was to do.
    fn show(&self, bar: &ProgressBar, done: i64) {
        let elapsed = self.begun.elapsed().as_secs_f64();
        let whole = bar.length().unwrap_or(0) as f64;
        if elapsed < SETTLED || done <= 0 {
            return;
        }
        let estimate = elapsed * (whole - done as f64).max(0.0) / done as f64;
        let left = self.left.lock().unwrap_or_else(PoisonError::into_inner).left(estimate, Instant::now());
        bar.set_message(format!(", {} left", time_text(left)));
    }

    fn add(&self, parts: i64) {
        let done = self.done.fetch_add(parts, Ordering::Relaxed) + parts;
        if let Some(bar) = self.display.bar() {
            bar.set_position(u64::try_from(done).unwrap_or(0));
            self.show(bar, done);
        }
    }
}

impl StudyObserver for StudyProgress<'_> {
    fn of_run(&self, steps: usize) -> Box<dyn RunObserver + '_> {
        Box::new(RunProgress {
            study: self,
            steps: steps as i64,
            step: AtomicI64::new(0),
            done: AtomicI64::new(0),
        })
    }

    fn over(&self, _: &PlannedRun, text: &str) {
        let over = self.over.fetch_add(1, Ordering::Relaxed) + 1;
        if let Some(bar) = self.display.bar() {
            bar.set_prefix(format!("{over}/{}", self.runs));
            // The bar is the one line of a study; only a failed run is worth another.
            if !text.contains("failed") {
                return;
            }
        }
        self.display.say(&format!("[{over}/{}] {text}", self.runs));
    }

    fn interrupted(&self) -> bool {
        self.interruption.asked()
    }
}

fn bar(runs: usize, steps: usize) -> ProgressBar {
    let template = "run {prefix} [{wide_bar}] {percent}%  {elapsed}{msg}";
    let bar = styled_bar(steps as u64 * PARTS as u64, template);
    bar.set_prefix(format!("0/{runs}"));
    bar
}

/// Progress of one run of a study.
struct RunProgress<'a> {
    study: &'a StudyProgress<'a>,
    steps: i64,
    step: AtomicI64,
    /// Number of its parts counted by the study so far.
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

impl RunObserver for RunProgress<'_> {
    fn begins(&self, first: usize) {
        self.reach(first as i64, 0);
    }

    fn fraction(&self, fraction: f64) {
        let parts = (fraction.clamp(0.0, 1.0) * PARTS as f64) as i64;
        self.count(self.step.load(Ordering::Relaxed) * PARTS + parts);
    }

    fn finished(&self, record: &StepRecord) {
        self.reach(record.step as i64 + 1, 0);
    }

    /// A run that ends early counts as complete.
    fn close(&self) {
        self.count(self.steps * PARTS);
    }

    fn interrupted(&self) -> bool {
        self.study.interrupted()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_all_runs_add_up() {
        let interruption = Interruption::default();
        let study = StudyProgress::new(Verbosity::Quiet, 2, 7, &interruption);
        let (one, other) = (study.of_run(3), study.of_run(4));
        other.begins(2);
        let done = || study.done.load(Ordering::Relaxed);
        assert_eq!(done(), 2 * PARTS);
        one.fraction(0.25);
        other.fraction(0.5);
        // The fraction restarts at zero with every passage of a step.
        one.fraction(0.125);
        assert_eq!(done(), 2 * PARTS + 625);
        one.close();
        other.close();
        assert_eq!(done(), 7 * PARTS);
    }
}
