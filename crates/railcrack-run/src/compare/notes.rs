//! Notes on what a comparison leaves out or changes, in sentences.

use super::align::Aligned;
use super::stored::{StoredRun, TipKey};
use super::tables::TipComparison;
use railcrack_case::Kept;
use std::collections::BTreeSet;

const NAMES: [&str; 2] = ["first", "second"];

pub(super) fn notes(runs: [&StoredRun; 2], tips: &[TipComparison], aligned: &[Aligned]) -> Vec<String> {
    let mut notes = Vec::new();
    for (run, name) in runs.iter().zip(NAMES) {
        if !run.summary().complete {
            notes.push(format!("the {name} run has not ended"));
        }
    }
    let [first, second] = runs.map(|run| run.summary().steps_recorded);
    if first != second {
        let both = match first.min(second) {
            0 => "no step is compared".to_owned(),
            count => format!("steps 0 to {} are compared", count - 1),
        };
        notes.push(format!("{both}: the first run has {first} steps, the second {second}"));
    }
    notes.extend(lone_tips(runs));
    notes.extend(positions(runs, tips, aligned));
    let [first, second] = runs.map(|run| run.summary().half_width_mm);
    if first != second {
        notes.push(format!("K is compared at equal x_c/a, with a = {first:.3} mm and {second:.3} mm"));
    }
    notes
}

/// Tips of the initial geometry present in one run only.
fn lone_tips(runs: [&StoredRun; 2]) -> Vec<String> {
    let initial = runs.map(|run| {
        let keys = run.growth.keys().filter(|key| key.0 == 0);
        keys.copied().collect::<BTreeSet<TipKey>>()
    });
    let mut notes = Vec::new();
    for (here, there) in [(0, 1), (1, 0)] {
        let lone = initial[here].difference(&initial[there]);
        let lone: Vec<String> = lone.map(|(_, crack, tip)| format!("{crack}.{tip}")).collect();
        if !lone.is_empty() {
            let name = NAMES[here];
            notes.push(format!(
                "only the {name} run has the tips (crack.tip) {}: not compared",
                lone.join(", ")
            ));
        }
    }
    notes
}

fn positions(runs: [&StoredRun; 2], tips: &[TipComparison], aligned: &[Aligned]) -> Vec<String> {
    let mut notes = Vec::new();
    let has_k = runs.iter().all(|run| run.kept == Kept::All);
    let lacking = tips.iter().filter(|tip| tip.sifs().is_none()).count();
    if !has_k && lacking < tips.len() {
        notes.push(format!(
            "K is compared in {} of {} tips and steps: the runs keep that of the first and the last step",
            tips.len() - lacking,
            tips.len()
        ));
    } else if lacking > 0 {
        notes.push("the passages have no wheel position in common: K is not compared".to_owned());
    }
    let Some((tip, aligned)) = tips.iter().zip(aligned).find(|(_, aligned)| aligned.interpolated.is_some())
    else {
        return notes;
    };
    let counts = runs.map(|run| {
        run.histories.get(&(tip.step, tip.crack, tip.tip)).map_or(0, |history| history.xc_over_a.len())
    });
    if let (Some(run), [low, .., high]) = (aligned.interpolated, &aligned.xc_over_a[..]) {
        let [first, second] = counts;
        notes.push(format!(
            "wheel positions differ ({first} and {second}): K of the {} run is interpolated at those of the {} one, from \
             x_c/a = {low} to {high}",
            NAMES[run],
            NAMES[1 - run]
        ));
    }
    notes
}
