//! A comparison as text.

use super::case_keys::CaseDifference;
use super::comparison::Comparison;
use super::life::SameLength;
use super::parting::Parting;
use super::stored::RunLabel;
use super::tables::TipComparison;
use super::tip::{SifDifference, TipSifs};
use crate::decision::{VerdictLevel, three_digits};
use railcrack::growth::RunStop;
use railcrack::words::Choice;

impl Comparison {
    /// The differences, for a terminal: runs, cases, a table with the tip that differs most in each
    /// step, where paths part, and, where there is a `tolerance` (per cent of the largest |K| of
    /// the case), whether K is within it.
    pub fn text(&self, tolerance: Option<f64>) -> String {
        let mut lines = self.runs_text();
        lines.extend(self.cases_text());
        lines.extend(self.notes.iter().map(|note| format!("note: {note}")));
        if self.tips.is_empty() {
            lines.push("the runs have no step and tip in common".to_owned());
            return lines.join("\n") + "\n";
        }
        lines.extend(self.decisions_text());
        lines.extend(self.life_text());
        lines.extend(self.table_text());
        lines.push(format!("\nlargest |K| of both runs: {:.4} MPa√m; in per cent of it:", self.peak));
        lines.extend(self.largest_text("K_I ", |sifs| sifs.ki));
        lines.extend(self.largest_text("K_II", |sifs| sifs.kii));
        lines.extend(self.paths_text());
        if let (Some(tolerance), Some(largest)) = (tolerance, self.largest_percent()) {
            let how = if self.is_within(tolerance) { "within" } else { "NOT within" };
            let largest = small(largest);
            lines.push(format!("K is {how} the tolerance of {tolerance} %: it differs by {largest} %"));
        }
        lines.join("\n") + "\n"
    }

    fn runs_text(&self) -> Vec<String> {
        let line = |(run, name): (&RunLabel, &str)| {
            let stop = run.stop.map_or("not ended", RunStop::word);
            let (folder, engine, contact) = (run.folder.display(), run.engine.word(), run.contact.word());
            let (boundary, steps) = (run.boundary.word(), run.steps_recorded);
            format!("{name}  {folder}: {engine}, {contact}, {boundary}; {steps} steps, {stop}")
        };
        self.runs.iter().zip(["first ", "second"]).map(line).collect()
    }

    fn cases_text(&self) -> Vec<String> {
        if self.case_differences.is_empty() {
            return vec!["cases   equal".to_owned()];
        }
        let line = |difference: &CaseDifference| {
            let values = difference.values.each_ref();
            let [first, second] = values.map(|value| value.as_deref().unwrap_or("(not there)"));
            format!("case    {}: {first} | {second}", difference.key)
        };
        self.case_differences.iter().map(line).collect()
    }

    /// Life, verdict and interval of both runs, where they have them.
    fn decisions_text(&self) -> Vec<String> {
        let mgt = |value: Option<f64>| value.map_or_else(|| "none".to_owned(), three_digits);
        let both = |of: &dyn Fn(&RunLabel) -> String| {
            let [first, second] = self.runs.each_ref().map(of);
            format!("{first} | {second}")
        };
        let any = |has: &dyn Fn(&RunLabel) -> bool| self.runs.iter().any(has);
        let level = |run: &RunLabel| run.verdict.map_or("none", VerdictLevel::word).to_owned();
        let verdict = any(&|run| run.verdict.is_some()).then(|| format!("verdict {}", both(&level)));
        let life = any(&|run| run.failure_mgt.is_some())
            .then(|| format!("failure after {} million gross tonnes", both(&|run| mgt(run.failure_mgt))));
        let interval = any(&|run| run.interval_mgt.is_some()).then(|| {
            format!("inspection interval {} million gross tonnes", both(&|run| mgt(run.interval_mgt)))
        });
        [verdict, life, interval].into_iter().flatten().collect()
    }

    fn life_text(&self) -> Option<String> {
        let SameLength { length, crack, load_cycles: [first, second], million_gross_tonnes } = self.life()?;
        let tonnes = million_gross_tonnes.map_or_else(String::new, |[first, second]| {
            format!(", {first:.3} | {second:.3} million gross tonnes")
        });
        Some(format!(
            "life    to {length:.3} mm of crack {crack}: {first:.0} | {second:.0} load cycles{tonnes}; the second is {:.3} times the first",
            second / first
        ))
    }

    fn table_text(&self) -> Vec<String> {
        let one_tip =
            self.tips.iter().all(|tip| (tip.crack, tip.tip) == (self.tips[0].crack, self.tips[0].tip));
        let which = if one_tip { "" } else { "; of each step the tip that differs most" };
        let worst = (0..self.common_steps).filter_map(|step| {
            let has_k = self.tips.iter().any(|tip| tip.step == step && tip.sifs().is_some());
            let tips = self.tips.iter().filter(|tip| tip.step == step && tip.sifs().is_some() == has_k);
            tips.reduce(|most, next| if badness(next) > badness(most) { next } else { most })
        });
        let head = [
            format!("\nlargest differences over the passage, % of the step's largest |K|{which}"),
            "step tip     |dK_I| MPa√m       % at x_c/a   |dK_II| MPa√m       % at x_c/a  tips apart mm  \
             length mm           kink deg        cycles"
                .to_owned(),
        ];
        head.into_iter().chain(worst.map(row)).collect()
    }

    fn largest_text(&self, name: &str, mode: fn(TipSifs) -> SifDifference) -> Option<String> {
        let (TipComparison { step, crack, tip, .. }, difference) = self.largest(mode)?;
        let SifDifference { largest, xc_over_a, rms } = difference;
        let [percent, k, rms] = [self.percent(largest), largest, rms].map(small);
        Some(format!(
            "  {name} differs by at most {percent} % ({k} MPa√m, rms {rms}) at step {step}, crack {crack}, tip \
             {tip}, x_c/a = {xc_over_a:.3}"
        ))
    }

    fn paths_text(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some(TipComparison { distance, step, crack, tip, .. }) = self.farthest() {
            let place = format!("step {step}, crack {crack}, tip {tip}");
            lines.push(format!("tips are at most {distance:.4} mm apart: {place}"));
        }
        let equal = || match self.common_steps {
            0 | 1 => "only the initial cracks are compared: nothing is said about their paths".to_owned(),
            _ => format!(
                "the paths do not part in the {} tips and steps compared: kinks differ by at most 5°",
                self.tips.len()
            ),
        };
        lines.push(self.parting.as_ref().map_or_else(equal, parting_text));
        for tip in self.tips.iter().filter(|tip| tip.stops[0] != tip.stops[1]) {
            let [first, second] = tip.stops.map(|stop| stop.map_or("goes on", RunStop::word));
            let TipComparison { step, crack, tip, .. } = tip;
            lines.push(format!("step {step}, crack {crack}, tip {tip}: {first} | {second}"));
        }
        lines
    }
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
