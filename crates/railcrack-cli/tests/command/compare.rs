//! `railcrack compare` as a user meets it.

use super::common;
use super::common::{QUICK_CASE, names, numbers as column, railcrack, stderr, stdout};
use std::fs;
use std::path::{Path, PathBuf};

const FILES: [&str; 8] = [
    "SHA256SUMS",
    "compare-paths.svg",
    "compare-positions.csv",
    "compare-sif-first.svg",
    "compare-sif-last.svg",
    "compare.csv",
    "compare.json",
    "report.html",
];

/// A folder with the runs `one` and, with another friction of the crack, `other`.
fn workplace(name: &str) -> PathBuf {
    let folder = common::folder("compare-command", name);
    fs::write(folder.join("one.toml"), QUICK_CASE).unwrap();
    fs::write(folder.join("other.toml"), QUICK_CASE.replace("friction = 0.2", "friction = 0.1")).unwrap();
    for case in ["one.toml", "other.toml"] {
        assert_eq!(railcrack(&folder, &["run", case, "--quiet"]).status.code(), Some(0));
    }
    folder
}

/// Exit code, standard output, standard error.
fn compare(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = railcrack(folder, &[&["compare"], arguments].concat());
    (output.status.code(), stdout(&output), stderr(&output))
}

#[test]
fn a_run_does_not_differ_from_itself() {
    let folder = workplace("itself");
    let (code, out, err) = compare(&folder, &["one", "one/", "--tolerance", "0"]);
    assert_eq!(code, Some(0), "{err}");
    for says in
        ["cases   equal", "K is within the tolerance of 0 %", "do not part", "comparison in one-compare"]
    {
        assert!(out.contains(says), "{says}: {out}");
    }
    let comparison = folder.join("one-compare");
    assert_eq!(names(&comparison), FILES);
    for name in ["dki_max_mpa_sqrt_m", "dkii_max_mpa_sqrt_m", "dkii_rms_mpa_sqrt_m", "tip_distance_mm"] {
        assert_eq!(column(&comparison.join("compare.csv"), name), [0.0; 3], "{name}");
    }
    assert_eq!(column(&comparison.join("compare-positions.csv"), "dki_mpa_sqrt_m"), [0.0; 183]);

    let (code, _, err) = compare(&folder, &["one", "other"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("one-compare already holds results") && err.contains("--force"), "{err}");
    fs::write(comparison.join("mine.txt"), "kept").unwrap();
    assert_eq!(compare(&folder, &["one", "other", "--force"]).0, Some(0));
    assert_eq!(fs::read_to_string(comparison.join("mine.txt")).unwrap(), "kept");
    assert!(column(&comparison.join("compare.csv"), "dkii_max_mpa_sqrt_m")[0] > 0.0);
}

#[test]
fn another_friction_is_another_history() {
    let folder = workplace("friction");
    let (code, out, err) = compare(&folder, &["one", "other", "--out", "difference", "--tolerance", "1"]);
    assert_eq!(code, Some(1), "{err}");
    assert!(out.contains("case    crack[1].friction: 0.2 | 0.1"), "{out}");
    assert!(out.contains("K is NOT within the tolerance of 1 %"), "{out}");

    // From the tables of the runs: the rows of the last passage of step 0.
    let history = |run: &str| {
        let path = folder.join(run).join("sif.csv");
        let (step, passage) = (column(&path, "step"), column(&path, "passage"));
        let initial = || step.iter().zip(&passage).filter(|(step, _)| **step == 0.0);
        let last = initial().map(|(_, passage)| *passage).fold(0.0, f64::max);
        let rows: Vec<usize> = (0..step.len()).filter(|&i| step[i] == 0.0 && passage[i] == last).collect();
        let kii = column(&path, "kii_mpa_sqrt_m");
        rows.into_iter().map(|i| kii[i]).collect::<Vec<f64>>()
    };
    let (one, other) = (history("one"), history("other"));
    let want = one.iter().zip(&other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
    let table = folder.join("difference/compare.csv");
    assert_eq!((one.len(), column(&table, "dkii_max_mpa_sqrt_m")[0]), (61, want));
    assert!(want > 0.1, "{want}");

    let positions = folder.join("difference/compare-positions.csv");
    assert_eq!(column(&positions, "kii_1_mpa_sqrt_m")[..61], one);
    assert_eq!(column(&positions, "kii_2_mpa_sqrt_m")[..61], other);
    let summary = fs::read_to_string(folder.join("difference/compare.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["within_tolerance"], false);
    let percent = column(&table, "dkii_percent_of_case").into_iter().fold(0.0, f64::max);
    // The last digit: decimals in JSON are not read to the bit.
    let found = summary["dkii_largest"]["percent_of_case"].as_f64().unwrap();
    assert!((found / percent - 1.0).abs() < 1e-14, "{found} {percent}");
    assert_eq!(summary["runs"][1]["folder"], "other");
}

#[test]
fn refusals_name_what_is_wrong_and_write_nothing() {
    let folder = workplace("refused");
    let sif = folder.join("other/sif.csv");
    let text = fs::read_to_string(&sif).unwrap();
    let line = 1 + text.lines().position(|line| line.starts_with("2,1,1,1,7,")).unwrap();
    let broken: Vec<String> = (1..)
        .zip(text.lines())
        .map(|(i, row)| if i == line { row.replacen(",7,", ",7,x", 1) } else { row.to_owned() })
        .collect();
    fs::write(&sif, broken.join("\n").replace(",7,x", ",7,1.0,x,")).unwrap();
    fs::create_dir(folder.join("empty")).unwrap();
    let before = names(&folder);
    let broken_row = format!("sif.csv: line {line}: xc_over_a is \"x\", not a finite number");
    let refusals: [(&[&str], i32, &str); 6] = [
        (&["one", "other"], 4, &broken_row),
        (&["one", "empty"], 2, "empty is not a run folder: it has no case.toml"),
        (&["absent", "one"], 2, "absent is not a run folder"),
        (&["one"], 2, "<DIR>"),
        (&["one.toml", "one", "--engines"], 2, "cannot be used with"),
        (&["one", "one", "--tolerance", "-1"], 2, "percentage"),
    ];
    for (arguments, code, says) in refusals {
        let (found, out, err) = compare(&folder, arguments);
        assert_eq!((found, out.as_str()), (Some(code), ""), "{arguments:?}: {err}");
        assert!(err.contains(says), "{arguments:?}: {err}");
    }
    assert_eq!(names(&folder), before);
    let (code, _, err) = compare(&folder, &["one", "one", "--out", "one.toml"]);
    assert_eq!(code, Some(4), "{err}");
}

/// The X-FEM engine is promised to be within 1 % of the peak of the converged history, the other
/// one within 0.5 %.
const ENGINES_APART: f64 = 1.5;

#[test]
fn both_engines_on_one_case() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("compare-command").join("engines");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("one.toml"), QUICK_CASE.replace("interface_elements = 16", "")).unwrap();
    let tolerance = ENGINES_APART.to_string();
    let (code, out, err) = compare(&folder, &["one.toml", "--engines", "--quiet", "--tolerance", &tolerance]);
    assert_eq!(code, Some(0), "{err}");
    assert!(out.contains("K is within the tolerance of 1.5 %"), "{out}");
    assert!(out.contains("solver.engine: \"xfem\" | \"dislocation\""), "{out}");
    let comparison = folder.join("one-compare");
    for engine in ["xfem", "dislocation"] {
        assert!(comparison.join(engine).join("sif.csv").is_file(), "{engine}");
    }
    let apart = column(&comparison.join("compare.csv"), "tip_distance_mm");
    assert!(apart.iter().all(|distance| *distance < 0.1), "{apart:?}");
    let differences = column(&comparison.join("compare.csv"), "dkii_max_mpa_sqrt_m");
    assert!(
        differences.iter().all(|difference| *difference > 0.0),
        "two engines, not one twice: {differences:?}"
    );
}
