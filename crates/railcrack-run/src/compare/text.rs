//! A comparison as text.

use super::comparison::Comparison;
use super::parting::Parting;
use super::tables::TipComparison;
use super::tip::SifDifference;
use railcrack::growth::RunStop;
use railcrack::words::Choice;
use std::fmt::Write;

impl Comparison {
    /// The differences, for a terminal: runs, cases, a table with the tip that differs most in each
    /// step, where paths part, and, where there is a `tolerance` (per cent of the largest |K| of
    /// the case), whether K is within it.
    pub fn text(&self, tolerance: Option<f64>) -> String {
        let mut text = self.runs_text();
        self.add_cases(&mut text);
        for note in &self.notes {
            add(&mut text, format_args!("note: {note}"));
        }
        if self.tips.is_empty() {
            add(&mut text, format_args!("the runs have no step and tip in common"));
            return text;
        }
        self.add_life(&mut text);
        self.add_table(&mut text);
        self.add_largest(&mut text);
        self.add_paths(&mut text);
        if let (Some(tolerance), Some(largest)) = (tolerance, self.largest_percent()) {
            let how = if self.is_within(tolerance) { "within" } else { "NOT within" };
            add(
                &mut text,
                format_args!("K is {how} the tolerance of {tolerance} %: it differs by {} %", small(largest)),
            );
        }
        text
    }

    fn runs_text(&self) -> String {
        let mut text = String::new();
        for (run, name) in self.runs.iter().zip(["first ", "second"]) {
            let stop = run.stop.map_or("not ended", RunStop::word);
            let (folder, engine, contact) = (run.folder.display(), run.engine.word(), run.contact.word());
            let (boundary, steps) = (run.boundary.word(), run.steps_recorded);
            add(
                &mut text,
                format_args!("{name}  {folder}: {engine}, {contact}, {boundary}; {steps} steps, {stop}"),
            );
        }
        text
    }

    fn add_cases(&self, text: &mut String) {
        if self.case_differences.is_empty() {
            add(text, format_args!("cases   equal"));
        }
        for difference in &self.case_differences {
            let [first, second] =
                difference.values.each_ref().map(|value| value.as_deref().unwrap_or("(not there)"));
            add(text, format_args!("case    {}: {first} | {second}", difference.key));
        }
    }

    fn add_life(&self, text: &mut String) {
        let Some(life) = self.life() else { return };
        let [first, second] = life.load_cycles;
        let tonnes = life.million_gross_tonnes.map_or_else(String::new, |[first, second]| {
            format!(", {first:.3} | {second:.3} million gross tonnes")
        });
        add(
            text,
            format_args!(
                "life    to {:.3} mm of crack {}: {first:.0} | {second:.0} load cycles{tonnes}; the second is {:.3} times the first",
                life.length,
                life.crack,
                second / first
            ),
        );
    }

    fn add_table(&self, text: &mut String) {
        let one_tip =
            self.tips.iter().all(|tip| (tip.crack, tip.tip) == (self.tips[0].crack, self.tips[0].tip));
        let which = if one_tip { "" } else { "; of each step the tip that differs most" };
        add(text, format_args!("\nlargest differences over the passage, % of the step's largest |K|{which}"));
        add(
            text,
            format_args!(
                "step tip     |dK_I| MPa√m       % at x_c/a   |dK_II| MPa√m       % at x_c/a  tips apart mm  \
                 length mm           kink deg        cycles"
            ),
        );
        for step in 0..self.common_steps {
            let tips = self.tips.iter().filter(|tip| tip.step == step);
            let worst = tips.reduce(|most, next| if badness(next) > badness(most) { next } else { most });
            if let Some(tip) = worst {
                add(text, format_args!("{}", row(tip)));
            }
        }
    }

    fn add_largest(&self, text: &mut String) {
        let peak = self.peak;
        add(text, format_args!("\nlargest |K| of both runs: {peak:.4} MPa√m; in per cent of it:"));
        let modes = [("K_I ", self.largest(|sifs| sifs.ki)), ("K_II", self.largest(|sifs| sifs.kii))];
        for (name, largest) in modes {
            let Some((tip, difference)) = largest else { continue };
            let SifDifference { largest, xc_over_a, rms } = difference;
            let TipComparison { step, crack, tip, .. } = tip;
            let [percent, k, rms] = [self.percent(largest), largest, rms].map(small);
            add(
                text,
                format_args!(
                    "  {name} differs by at most {percent} % ({k} MPa√m, rms {rms}) at step {step}, crack {crack}, tip \
                     {tip}, x_c/a = {xc_over_a:.3}"
                ),
            );
        }
    }

    fn add_paths(&self, text: &mut String) {
        if let Some(TipComparison { distance, step, crack, tip, .. }) = self.farthest() {
            add(
                text,
                format_args!(
                    "tips are at most {distance:.4} mm apart: step {step}, crack {crack}, tip {tip}"
                ),
            );
        }
        match &self.parting {
            None => add(text, format_args!("the paths do not part: kinks differ by at most 5°")),
            Some(parting) => add(text, format_args!("{}", parting_text(parting))),
        }
        for tip in self.tips.iter().filter(|tip| tip.stops[0] != tip.stops[1]) {
            let [first, second] = tip.stops.map(|stop| stop.map_or("goes on", RunStop::word));
            let TipComparison { step, crack, tip, .. } = tip;
            add(text, format_args!("step {step}, crack {crack}, tip {tip}: {first} | {second}"));
        }
    }
}

fn add(text: &mut String, line: std::fmt::Arguments) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "{line}");
}

/// Order of the tips of a step: by the largest difference of K.
fn badness(tip: &TipComparison) -> f64 {
    tip.sifs().map_or(tip.distance, |sifs| sifs.ki.largest.max(sifs.kii.largest))
}

/// A difference: three decimals, or a power of ten where they would hide it.
fn small(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        0.001.. => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    }
}

fn row(tip: &TipComparison) -> String {
    let mode = |mode: Option<SifDifference>| match mode {
        None => format!("{:>15} {:>7} {:>8}", "-", "-", "-"),
        Some(SifDifference { largest, xc_over_a, .. }) => {
            format!("{:>15} {:>7} {xc_over_a:>8.3}", small(largest), small(tip.percent(largest)))
        }
    };
    let angle = |angle: Option<f64>| angle.map_or_else(|| "-".to_owned(), |angle| format!("{angle:.1}"));
    let [first, second] = tip.kink_deg.map(angle);
    let lengths = format!("{:.3} | {:.3}", tip.lengths[0], tip.lengths[1]);
    format!(
        "{:>4} {:<6} {} {} {:>14}  {:<19} {:<15} {:.0} | {:.0}",
        tip.step,
        format!("{}.{}", tip.crack, tip.tip),
        mode(tip.sifs().map(|sifs| sifs.ki)),
        mode(tip.sifs().map(|sifs| sifs.kii)),
        small(tip.distance),
        lengths,
        format!("{first} | {second}"),
        tip.load_cycles[0],
        tip.load_cycles[1]
    )
}

fn parting_text(parting: &Parting) -> String {
    let Parting { step, crack, tip, apart_deg, kink_angle_deg, rival_ratio, near_tie } = parting;
    let shown = |values: &[Option<f64>; 2], decimals: usize| {
        let [first, second] = values
            .map(|value| value.map_or_else(|| "none".to_owned(), |value| format!("{value:.decimals$}")));
        format!("{first} | {second}")
    };
    let tie = if *near_tie { "a near tie" } else { "not a near tie" };
    format!(
        "the paths part at step {step}, crack {crack}, tip {tip}: kinks {} deg, {apart_deg:.1} deg apart; {tie}: \
         the rival grows {} times as fast",
        shown(kink_angle_deg, 1),
        shown(rival_ratio, 4)
    )
}
