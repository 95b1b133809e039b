//! Progress of a run: a bar on a terminal, one line per step elsewhere.

use crate::display::{Display, SteadyTime, Verbosity, styled_bar, time_text};
use crate::interruption::Interruption;
use indicatif::ProgressBar;
use railcrack::growth::{StepRecord, TipRecord, TipStop};
use railcrack::words::Choice;
use railcrack_run::simulation::RunObserver;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Parts of a step on the bar.
const PARTS: u64 = 1000;

/// Progress of one run, shown on standard error.
#[derive(Debug)]
pub struct Progress<'a> {
    display: Display,
    interruption: &'a Interruption,
    increments: usize,
    step: AtomicUsize,
    begun: Instant,
    step_times: Mutex<StepTimes>,
    /// Million gross tonnes per load cycle, if the case has traffic.
    tonnes: Option<f64>,
}

/// Cost of the finished steps.
#[derive(Debug)]
struct StepTimes {
    /// Start of the current step.
    since: Instant,
    /// Wall times of the last steps, s.
    steps: VecDeque<f64>,
    /// Of the last finished step.
    state: String,
    /// The time left as it is shown.
    left: SteadyTime,
}

/// Number of recent steps from which the cost of the next ones is extrapolated.
const RECENT: usize = 5;

impl<'a> Progress<'a> {
    /// A run of `increments` increments that `interruption` can stop.
    pub fn new(verbosity: Verbosity, increments: usize, interruption: &'a Interruption) -> Self {
        let display = Display::new(verbosity, || bar(increments));
        let now = Instant::now();
        let step_times = Mutex::new(StepTimes {
            since: now,
            steps: VecDeque::new(),
            state: String::new(),
            left: SteadyTime::default(),
        });
        let step = AtomicUsize::new(0);
        Self { display, interruption, increments, step, begun: now, step_times, tonnes: None }
    }

    /// Also shows million gross tonnes, for an axle load of `load` tonnes.
    #[must_use]
    pub fn with_axle_load(self, load: Option<f64>) -> Self {
        Self { tonnes: load.map(|load| load / 1e6), ..self }
    }

    fn step_times(&self) -> MutexGuard<'_, StepTimes> {
        self.step_times.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// State and remaining time, shown after the bar.
    fn show(&self, bar: &ProgressBar, fraction: f64) {
        let mut step_times = self.step_times();
        let step = self.step.load(Ordering::Relaxed);
        let left = match time_left(&step_times.steps, (self.increments + 1).saturating_sub(step), fraction) {
            _ if step > self.increments => "writing".to_owned(),
            Some(seconds) => format!("{} left", time_text(step_times.left.left(seconds, Instant::now()))),
            None => String::new(),
        };
        let parts: Vec<&str> =
            [left.as_str(), step_times.state.as_str()].into_iter().filter(|part| !part.is_empty()).collect();
        bar.set_message(parts.join("  "));
    }
}

/// Estimated time, s, of `steps` steps, a `fraction` of the first of them done; none before the
/// first step is finished. The increase from step to step is extrapolated from the last steps.
fn time_left(finished: &VecDeque<f64>, steps: usize, fraction: f64) -> Option<f64> {
    let (first, last) = (finished.front()?, finished.back()?);
    let growth = (last - first) / (finished.len().max(2) - 1) as f64;
    let mean = finished.iter().sum::<f64>() / finished.len() as f64;
    let (latest, left) = (mean + 0.5 * growth.max(0.0) * (finished.len() - 1) as f64, steps as f64);
    let whole = left * latest + 0.5 * growth.max(0.0) * left * (left + 1.0);
    Some((whole - fraction.clamp(0.0, 1.0) * latest).max(0.0))
}

impl RunObserver for Progress<'_> {
    fn begins(&self, first: usize) {
        self.step.store(first, Ordering::Relaxed);
        if let Some(bar) = self.display.bar() {
            bar.set_position(first as u64 * PARTS);
            bar.set_prefix(format!("{first}/{}", self.increments));
        }
        // The remaining time follows from steps of this run, not of an earlier one.
        self.step_times().since = Instant::now();
    }

    fn fraction(&self, fraction: f64) {
        if let Some(bar) = self.display.bar() {
            let parts = (fraction.clamp(0.0, 1.0) * PARTS as f64) as u64;
            bar.set_position(self.step.load(Ordering::Relaxed) as u64 * PARTS + parts);
            self.show(bar, fraction);
        }
    }

    fn finished(&self, record: &StepRecord) {
        self.step.store(record.step + 1, Ordering::Relaxed);
        let state = state_of(record, self.tonnes);
        {
            let mut step_times = self.step_times();
            let took = step_times.since.elapsed().as_secs_f64();
            step_times.steps.push_back(took);
            if step_times.steps.len() > RECENT {
                step_times.steps.pop_front();
            }
            step_times.since = Instant::now();
            step_times.state.clone_from(&state);
        }
        for warning in &record.warnings {
            self.display.say(&format!(
                "warning, step {}, {}: {}",
                warning.step,
                warning.kind.name(),
                warning.text
            ));
        }
        for event in events(record) {
            self.display.say(&format!("step {}: {event}", record.step));
        }
        match &self.display {
            Display::Bar(bar) => {
                let next = (record.step + 1).min(self.increments);
                bar.set_prefix(format!("{next}/{}", self.increments));
                self.fraction(0.0);
            }
            Display::Lines => self.display.say(&format!(
                "step {}/{}  {state}  {} passages  {:.1} s",
                record.step,
                self.increments,
                record.counts.passages,
                self.begun.elapsed().as_secs_f64()
            )),
            Display::Quiet => {}
        }
    }

    fn stage(&self, text: &str) {
        match &self.display {
            Display::Bar(bar) => bar.set_message(text.to_owned()),
            Display::Lines | Display::Quiet => self.display.say(text),
        }
    }

    fn note(&self, text: &str) {
        self.display.say(&format!("note: {text}"));
    }

    fn close(&self) {
        self.display.close();
        self.interruption.acknowledge();
    }

    fn interrupted(&self) -> bool {
        self.interruption.asked()
    }
}

fn bar(increments: usize) -> ProgressBar {
    // The message is truncated at the end of the line; 40 columns still show the remaining time.
    let template = "step {prefix} [{bar:8}] {elapsed}  {wide_msg}";
    styled_bar((increments as u64 + 1) * PARTS, template)
}

/// Cracks that join others in this step, and pieces of the rail that are enclosed.
fn events(record: &StepRecord) -> Vec<String> {
    let joins = |tip: &&TipRecord| tip.stop == Some(TipStop::Coalescence) && tip.increment != 0.0;
    let joined = record
        .tips
        .iter()
        .filter(joins)
        .map(|tip| format!("crack {} tip {} joins a crack", tip.tip.crack + 1, tip.tip.tip + 1));
    let enclosed = record.pieces.iter().map(|piece| {
        format!("{} at crack {}, {:.3} mm\u{b2}", piece.kind.word(), piece.crack + 1, piece.area)
    });
    joined.chain(enclosed).collect()
}

/// Crack and length of the fastest tip, load cycles, million gross tonnes at `tonnes` per cycle,
/// and the rate. After a bar, 80 columns show all but the rate.
fn state_of(record: &StepRecord, tonnes: Option<f64>) -> String {
    let faster = |one: &TipRecord, other: &TipRecord| one.rate.total_cmp(&other.rate);
    let fastest = record.tips.iter().max_by(|one, other| faster(one, other));
    fastest.map_or_else(String::new, |tip| {
        let gross =
            tonnes.map_or_else(String::new, |tonnes| format!("  {:.3} MGT", tonnes * record.load_cycles));
        format!(
            "crack {} {:.2} mm  {} cycles{gross}  {:.2e} mm/cycle",
            tip.tip.crack + 1,
            tip.length,
            cycles(record.load_cycles),
            tip.rate
        )
    })
}

/// A whole number of load cycles with spaces between thousands.
pub fn cycles(cycles: f64) -> String {
    let digits = format!("{cycles:.0}");
    if digits.len() > 15 {
        return format!("{cycles:.3e}");
    }
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{cycles, time_left};

    #[test]
    fn the_time_left_follows_from_the_steps_behind() {
        let left = |finished: &[f64], steps, fraction| {
            time_left(&finished.iter().copied().collect(), steps, fraction)
        };
        assert_eq!(left(&[], 5, 0.0), None);
        assert_eq!(left(&[2.0, 2.0, 2.0], 5, 0.5), Some(9.0));
        // Each step takes a second longer: 4, 5 and 6 s.
        assert_eq!(left(&[1.0, 2.0, 3.0], 3, 0.0), Some(15.0));
        assert_eq!(left(&[3.0, 1.0], 0, 1.0), Some(0.0));
    }

    #[test]
    fn cycles_are_grouped() {
        assert_eq!([0.0, 999.6, 381_234.4].map(cycles), ["0", "1 000", "381 234"]);
        assert_eq!(cycles(1.5e18), "1.500e18");
    }
}
