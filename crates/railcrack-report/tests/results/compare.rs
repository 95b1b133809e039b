//! Two run folders set against each other: synthetic runs, whose differences are known.

use super::support::{SMALL, Scratch, Size, case, info, record_steps};
use railcrack_report::{Pages, rebuild_report};
use railcrack_run::compare::COMPARISON;
use railcrack_run::{Comparison, Existing, OutputError, Presentation, Recorder, ResultFolder};
use std::fs;
use std::path::{Path, PathBuf};

/// A finished synthetic run.
fn run(scratch: &Scratch, name: &str, size: Size) -> PathBuf {
    let folder = scratch.path().join(name);
    let mut recorder = Recorder::start(&folder, case(), info(), Existing::Refuse, &Pages).unwrap();
    record_steps(&mut recorder, size, 0, size.increments + 1).unwrap();
    recorder.finish().unwrap();
    folder
}

/// Replaces the field `column` of the rows of a table for which `wanted` (step, crack, tip as text)
/// holds.
fn edit(folder: &Path, file: &str, column: &str, wanted: [&str; 3], value: impl Fn(&str) -> String) {
    let path = folder.join(file);
    let text = fs::read_to_string(&path).unwrap();
    let header: Vec<&str> = text.lines().find(|line| !line.starts_with('#')).unwrap().split(',').collect();
    let at = |name: &str| header.iter().position(|column| *column == name).unwrap();
    let keys = ["step", "crack", "tip"].map(at);
    let line = |line: &str| {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        if !line.starts_with('#') && keys.iter().zip(wanted).all(|(&at, want)| fields[at] == want) {
            fields[at(column)] = value(&fields[at(column)]);
        }
        fields.join(",") + "\n"
    };
    fs::write(&path, text.lines().map(line).collect::<String>()).unwrap();
}

fn add(amount: f64) -> impl Fn(&str) -> String {
    move |text| (text.parse::<f64>().unwrap() + amount).to_string()
}

#[test]
fn a_known_difference_is_found_where_it_is() {
    let scratch = Scratch::new("compare-known");
    let (first, second) = (run(&scratch, "first", SMALL), run(&scratch, "second", SMALL));
    let equal = Comparison::of(&first, &second).unwrap();
    assert_eq!((equal.largest_percent(), equal.tips.len(), equal.common_steps), (Some(0.0), 5, 5));
    assert!(equal.parting.is_none() && equal.notes.is_empty() && equal.case_differences.is_empty());

    edit(&second, "sif.csv", "kii_mpa_sqrt_m", ["3", "1", "1"], add(-0.25));
    edit(&second, "growth.csv", "tip_x_mm", ["4", "1", "1"], add(0.3));
    edit(&second, "growth.csv", "tip_y_mm", ["4", "1", "1"], add(-0.4));
    let comparison = Comparison::of(&first, &second).unwrap();
    for tip in &comparison.tips {
        let sifs = tip.sifs().unwrap();
        let (kii, apart) = (if tip.step == 3 { 0.25 } else { 0.0 }, if tip.step == 4 { 0.5 } else { 0.0 });
        // Both passages of the step were changed, of which the last one counts; round-off of the
        // sums.
        assert!((sifs.kii.largest - kii).abs() < 1e-12 && (sifs.kii.rms - kii).abs() < 1e-12, "{tip:?}");
        assert_eq!((sifs.ki.largest, sifs.positions), (0.0, SMALL.positions));
        assert!((tip.distance - apart).abs() < 1e-12, "{tip:?}");
    }
    let percent = 100.0 * 0.25 / comparison.peak;
    assert!((comparison.largest_percent().unwrap() - percent).abs() < 1e-9);
    let step_3 = &comparison.tips[3];
    assert!(step_3.step_peak <= comparison.peak && step_3.step_peak > 5.0, "{}", step_3.step_peak);
    let text = comparison.text(Some(0.5 * percent));
    assert!(
        text.contains("K is NOT within the tolerance") && text.contains("step 3, crack 1, tip 1"),
        "{text}"
    );
    assert!(comparison.text(Some(2.0 * percent)).contains("K is within the tolerance"));
}

#[test]
fn lives_are_those_to_the_shorter_of_both_lengths() {
    let scratch = Scratch::new("compare-life");
    let (first, second) = (run(&scratch, "first", SMALL), run(&scratch, "second", SMALL));
    let equal = Comparison::of(&first, &second).unwrap().life().unwrap();
    assert_eq!(equal.load_cycles[0], equal.load_cycles[1]);

    // The second crack is longer by 1 mm in its last step: it reaches the length of the first in
    // between.
    edit(&second, "growth.csv", "length_mm", ["4", "1", "1"], add(1.0));
    let comparison = Comparison::of(&first, &second).unwrap();
    let life = comparison.life().unwrap();
    let [before, last] = [&comparison.tips[3], &comparison.tips[4]];
    assert_eq!((life.crack, life.length), (1, last.lengths[0]));
    assert_eq!(life.load_cycles[0], last.load_cycles[0]);
    let part = (last.lengths[0] - before.lengths[1]) / (last.lengths[1] - before.lengths[1]);
    let cycles = before.load_cycles[1] + part * (last.load_cycles[1] - before.load_cycles[1]);
    // Round-off of the interpolation.
    assert!((life.load_cycles[1] - cycles).abs() < 1e-9 * cycles && part < 0.5, "{life:?}");
    assert!(comparison.text(None).contains("life    to "), "{}", comparison.text(None));
}

#[test]
fn an_earlier_passage_does_not_count() {
    let scratch = Scratch::new("compare-passage");
    let (first, second) = (run(&scratch, "first", SMALL), run(&scratch, "second", SMALL));
    let path = second.join("sif.csv");
    let text = fs::read_to_string(&path).unwrap();
    let first_passage = |line: &str| line.split(',').nth(1) == Some("1");
    let changed = text.lines().map(|line| match line.rsplit_once(',') {
        Some((rest, _)) if first_passage(line) => format!("{rest},99.0\n"),
        _ => format!("{line}\n"),
    });
    fs::write(&path, changed.collect::<String>()).unwrap();
    assert_eq!(Comparison::of(&first, &second).unwrap().largest_percent(), Some(0.0));
}

#[test]
fn paths_part_where_the_kinks_do_and_a_near_tie_is_named() {
    let scratch = Scratch::new("compare-parting");
    let (first, second) = (run(&scratch, "first", SMALL), run(&scratch, "second", SMALL));
    // The synthetic run kinks by -2 degrees and has a rival of ratio 0.99 in step 1.
    for step in ["1", "2", "4"] {
        edit(&second, "growth.csv", "kink_angle_deg", [step, "1", "1"], |_| "65.0".to_owned());
    }
    edit(&second, "growth.csv", "kink_angle_deg", ["0", "1", "1"], |_| "2.5".to_owned());
    let parting = |first: &Path| Comparison::of(first, &second).unwrap().parting.unwrap();
    let found = parting(&first);
    assert_eq!((found.step, found.crack, found.tip, found.near_tie), (1, 1, 1, true));
    assert!((found.apart_deg - 67.0).abs() < 1e-9);
    assert_eq!(found.rival_ratio, [Some(0.99); 2]);
    let text = Comparison::of(&first, &second).unwrap().text(None);
    assert!(
        text.contains("the paths part at step 1, crack 1, tip 1") && text.contains("; a near tie:"),
        "{text}"
    );
    for folder in [&first, &second] {
        edit(folder, "growth.csv", "rival_ratio", ["1", "1", "1"], |_| "0.9".to_owned());
    }
    assert!(!parting(&first).near_tie);
}

#[test]
fn what_only_one_run_has_is_left_out_and_said() {
    let scratch = Scratch::new("compare-parts");
    let first = run(&scratch, "first", Size { cracks: 2, ..SMALL });
    let second = run(&scratch, "second", Size { increments: 2, positions: 21, ..SMALL });
    let comparison = Comparison::of(&first, &second).unwrap();
    assert_eq!(comparison.common_steps, 3);
    assert_eq!(comparison.tips.len(), 3, "three steps of the only common crack");
    for says in [
        "steps 0 to 2 are compared: the first run has 5 steps, the second 3",
        "only the first run has the tips (crack.tip) 2.1",
        "wheel positions differ (41 and 21): K of the first run is interpolated at those of the second one, from \
         x_c/a = -6 to 6",
    ] {
        assert!(comparison.notes.iter().any(|note| note.contains(says)), "{says}: {:?}", comparison.notes);
    }
    // Every other position of the first is one of the second: interpolation there is exact up to
    // the round-off of x_c/a.
    assert!(comparison.tips.iter().all(|tip| tip.sifs().unwrap().positions == 21));
    assert!(comparison.largest_percent().unwrap() < 1e-9);
    // The other way round the same run is interpolated.
    let reversed = Comparison::of(&second, &first).unwrap();
    assert!(reversed.notes.iter().any(|note| note.contains("K of the second run is interpolated")));
    let out = scratch.path().join("out");
    let entered = ResultFolder::enter(&out, &COMPARISON, Existing::Refuse).unwrap();
    comparison.write(entered, None, |folder| Pages.comparison(folder)).unwrap();
    rebuild_report(&out).unwrap();
    assert!(fs::read_to_string(out.join("compare-sif-last.svg")).unwrap().contains("at step 2"));
}

#[test]
fn damaged_tables_are_named_with_their_line() {
    let scratch = Scratch::new("compare-damaged");
    let (first, second) = (run(&scratch, "first", SMALL), run(&scratch, "second", SMALL));
    let message = || Comparison::of(&first, &second).unwrap_err().to_string();
    let whole = fs::read_to_string(second.join("growth.csv")).unwrap();
    edit(&second, "growth.csv", "tip_y_mm", ["2", "1", "1"], |_| "deep".to_owned());
    assert!(
        message().contains("growth.csv: line 13: tip_y_mm is \"deep\", not a finite number"),
        "{}",
        message()
    );
    fs::write(second.join("growth.csv"), whole.replace("length_mm,", "size_mm,")).unwrap();
    assert!(message().contains("growth.csv: no column length_mm"), "{}", message());
    fs::write(second.join("growth.csv"), &whole).unwrap();
    let sif = fs::read_to_string(second.join("sif.csv")).unwrap();
    let without: String =
        sif.lines().filter(|line| !line.starts_with("3,")).map(|line| format!("{line}\n")).collect();
    fs::write(second.join("sif.csv"), without).unwrap();
    assert!(message().contains("sif.csv: has no row of step 3, crack 1, tip 1"), "{}", message());
    for file in ["growth.csv", "summary.json", "case.toml"] {
        fs::remove_file(second.join(file)).unwrap();
        let error = Comparison::of(&first, &second).unwrap_err();
        assert!(matches!(&error, OutputError::NotARun { file: missing, .. } if *missing == file), "{error}");
    }
}
