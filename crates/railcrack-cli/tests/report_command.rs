//! `railcrack report` as a user meets it: the same files from the folder alone, and what it refuses.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const CASE: &str = r#"
title = "Quick"
[contact]
peak_pressure_mpa = 1000.0
half_width_mm = 6.75
friction = 0.1
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 40.0
friction = 0.2
[passage]
positions = 61
[mesh]
interface_elements = 16
[growth]
steps = 2
[solver]
engine = "dislocation"
"#;

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report-command").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("case.toml"), CASE).unwrap();
    folder
}

fn railcrack(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_railcrack")).args(arguments).current_dir(folder).output().unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = railcrack(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Report and pictures of a folder.
fn shown(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for folder in [folder.to_path_buf(), folder.join("plots")] {
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|ending| ending == "html" || ending == "svg") {
                files.insert(path.clone(), fs::read(path).unwrap());
            }
        }
    }
    files
}

/// The report of `run` built again from its other files.
fn again(folder: &Path, run: &str, what: &str) {
    let before = shown(&folder.join(run));
    assert!(before.len() > 3, "{run}");
    for file in before.keys() {
        fs::remove_file(file).unwrap();
    }
    let said = done(folder, &["report", run]);
    assert!(said.starts_with(&format!("report of the {what} in ")), "{said}");
    let after = shown(&folder.join(run));
    assert_eq!(before.keys().collect::<Vec<_>>(), after.keys().collect::<Vec<_>>());
    for (file, bytes) in before {
        assert!(after[&file] == bytes, "{} differs", file.display());
    }
}

#[test]
fn runs_states_and_comparisons_are_built_again_bit_for_bit() {
    let folder = folder("again");
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    done(&folder, &["run", "case.toml", "--out", "latin", "--contact", "latin", "--quiet"]);
    done(&folder, &["shakedown", "case.toml", "--out", "state", "--quiet"]);
    done(&folder, &["compare", "run", "latin", "--out", "both", "--tolerance", "0.5"]);
    again(&folder, "run", "run");
    again(&folder, "state", "plastic state");
    again(&folder, "both", "comparison");
    let page = |run: &str| fs::read_to_string(folder.join(run).join("report.html")).unwrap();
    assert!(page("both").contains("within the tolerance of 0.5 %"));
    assert!(page("both").contains("solver.contact"));
    // The state's own words of what it found.
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.join("state/shakedown.json")).unwrap()).unwrap();
    let margin = summary["dang_van"]["margin_mpa"].as_f64().unwrap();
    assert!(page("state").contains(&format!("a margin of {margin:.1} MPa")));
}

#[test]
fn a_direct_state_shows_what_passages_lead_to() {
    let folder = folder("direct");
    fs::write(folder.join("case.toml"), format!("{CASE}[shakedown]\nmethod = \"direct\"\n")).unwrap();
    done(&folder, &["shakedown", "case.toml", "--out", "state", "--quiet"]);
    again(&folder, "state", "plastic state");
    let page = fs::read_to_string(folder.join("state/report.html")).unwrap();
    assert!(page.contains("\"name\":\"σxx, pass by pass\""));
    assert!(page.contains("not the one that passages lead to"));
}

#[test]
fn a_resumed_run_has_the_report_of_one_that_was_not_interrupted() {
    let folder = folder("resumed");
    done(&folder, &["run", "case.toml", "--out", "whole", "--quiet"]);
    // A run that ends early is one that was interrupted, but for the case it says; so the run is cut back by hand to
    // what stands after its last checkpoint: tables, then plots and report that are not there.
    done(&folder, &["run", "case.toml", "--out", "cut", "--quiet"]);
    for file in shown(&folder.join("cut")).keys() {
        fs::remove_file(file).unwrap();
    }
    done(&folder, &["run", "case.toml", "--out", "cut", "--resume", "--quiet"]);
    let read = |run: &str| fs::read(folder.join(run).join("report.html")).unwrap();
    assert!(read("whole") == read("cut"));
}

#[test]
fn what_is_no_folder_of_results_is_refused() {
    let folder = folder("refused");
    let refused = |path: &str| {
        let output = railcrack(&folder, &["report", path]);
        assert!(output.stdout.is_empty());
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    for path in [".", "nowhere", "case.toml"] {
        let (code, said) = refused(path);
        assert_eq!(code, Some(2), "{path}: {said}");
        assert!(said.contains("holds nothing to report on") && said.contains("summary.json"), "{said}");
    }
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    fs::write(folder.join("run/summary.json"), "{").unwrap();
    let (code, said) = refused("run");
    assert_eq!(code, Some(4), "{said}");
    assert!(said.contains("summary.json"), "{said}");
}
