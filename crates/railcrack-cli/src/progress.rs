//! How far a run is: a bar on a terminal, a line per step elsewhere.

use crate::display::{Display, Verbosity, styled_bar};
use crate::interruption::Interruption;
use indicatif::ProgressBar;
use railcrack::growth::{StepRecord, TipRecord, TipStop};
use railcrack::words::Choice;
use railcrack_run::simulation::RunObserver;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Parts of a step on the bar.
const PARTS: u64 = 1000;

/// The progress of one run, told on standard error.
#[derive(Debug)]
pub struct Progress<'a> {
    display: Display,
    interruption: &'a Interruption,
    increments: usize,
    step: AtomicUsize,
    begun: Instant,
}

impl<'a> Progress<'a> {
    /// A run of `increments` increments that `interruption` may stop.
    pub fn new(verbosity: Verbosity, increments: usize, interruption: &'a Interruption) -> Self {
        let display = Display::new(verbosity, || bar(increments));
        Self { display, interruption, increments, step: AtomicUsize::new(0), begun: Instant::now() }
    }
}

impl RunObserver for Progress<'_> {
    fn begins(&self, first: usize) {
        self.step.store(first, Ordering::Relaxed);
        if let Some(bar) = self.display.bar() {
            bar.set_position(first as u64 * PARTS);
            bar.set_prefix(format!("{first}/{}", self.increments));
            // Time left follows from the pace since now, not from steps that were done before.
            bar.reset_eta();
        }
    }

    fn fraction(&self, fraction: f64) {
        if let Some(bar) = self.display.bar() {
            let parts = (fraction.clamp(0.0, 1.0) * PARTS as f64) as u64;
            bar.set_position(self.step.load(Ordering::Relaxed) as u64 * PARTS + parts);
        }
    }

    fn finished(&self, record: &StepRecord) {
        self.step.store(record.step + 1, Ordering::Relaxed);
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
                bar.set_message(state_of(record));
                self.fraction(0.0);
            }
            Display::Lines => self.display.say(&format!(
                "step {}/{}  {}  cycles {}  {} passages  {:.1} s",
                record.step,
                self.increments,
                state_of(record),
                cycles(record.load_cycles),
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
    let template = "step {prefix} [{bar:28}] {percent}%  {msg}  {elapsed} elapsed, {eta} left";
    styled_bar((increments as u64 + 1) * PARTS, template)
}

/// Cracks that join others in this step, and pieces that it encloses.
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

/// Length and rate of the fastest tip.
fn state_of(record: &StepRecord) -> String {
    let faster = |one: &TipRecord, other: &TipRecord| one.rate.total_cmp(&other.rate);
    let fastest = record.tips.iter().max_by(|one, other| faster(one, other));
    fastest.map_or_else(String::new, |tip| {
        format!("length {:.3} mm  rate {:.2e} mm/cycle", tip.length, tip.rate)
    })
}

/// A number of load cycles as people write it: whole, with spaces between thousands.
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
    use super::cycles;

    #[test]
    fn cycles_are_grouped() {
        assert_eq!([0.0, 999.6, 381_234.4].map(cycles), ["0", "1 000", "381 234"]);
        assert_eq!(cycles(1.5e18), "1.500e18");
    }
}
