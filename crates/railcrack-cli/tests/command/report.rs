//! `railcrack report` as a user meets it: the same files from the folder alone, and what it
//! refuses.

use super::common;
use super::common::{QUICK_CASE, done, railcrack};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A load that yields, and the cheaper engine.
fn case() -> String {
    let case = QUICK_CASE.replace("845.0", "1000.0").replace("friction = 0.3", "friction = 0.1");
    format!("title = \"Quick\"\n{case}[solver]\nengine = \"dislocation\"\n")
}

fn folder(name: &str) -> PathBuf {
    let folder = common::folder("report-command", name);
    fs::write(folder.join("case.toml"), case()).unwrap();
    folder
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
    assert!(page("both").contains("solver.<wbr>contact"));
    // The state's own words of what it found.
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.join("state/shakedown.json")).unwrap()).unwrap();
    let margin = summary["dang_van"]["margin_mpa"].as_f64().unwrap();
    assert!(page("state").contains(&format!("margin of the Dang Van criterion is {margin:.1} MPa")));
}

#[test]
fn a_study_is_built_again_bit_for_bit() {
    let folder = folder("study");
    let study = case().replace("angle_deg = 40.0", "angle_deg = [20.0, 40.0]");
    fs::write(
        folder.join("study.toml"),
        study.replace("steps = 2", "steps = 1") + "[output]\nreport = true\n",
    )
    .unwrap();
    done(&folder, &["sweep", "study.toml", "--out", "study", "--quiet"]);
    again(&folder, "study", "study");
    let page = fs::read_to_string(folder.join("study/report.html")).unwrap();
    let rates = common::column(&folder.join("study/summary.csv"), "rate_mm_per_cycle");
    assert!(page.contains("<a href=\"runs/001/report.html\">1</a>"), "no link to the first run");
    for rate in rates {
        let words = format!("{:.3e}", rate.parse::<f64>().unwrap()).replace('-', "\u{2212}");
        assert!(page.contains(&format!("<td class=\"number\">{words}</td>")), "{words}");
    }
    // What is no longer there is said to be missing, and its curves are not.
    fs::remove_dir_all(folder.join("study/runs/002")).unwrap();
    done(&folder, &["report", "study"]);
    let page = fs::read_to_string(folder.join("study/report.html")).unwrap();
    assert!(
        page.contains("Not computed yet, or stored in another folder, 1 of 2 runs: run 2."),
        "nothing said of run 2"
    );
}

#[cfg(not(feature = "png"))]
#[test]
fn a_build_without_png_says_so_and_leaves_the_folder_alone() {
    let folder = folder("no-png");
    done(&folder, &["run", "case.toml", "--out", "run", "--steps", "0", "--quiet"]);
    let before = shown(&folder.join("run"));
    let refused = railcrack(&folder, &["report", "run", "--png"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(common::stderr(&refused).contains("--features png"), "{}", common::stderr(&refused));
    assert!(before == shown(&folder.join("run")));
}

#[cfg(feature = "png")]
#[test]
fn plots_are_drawn_as_png() {
    let folder = folder("png");
    done(&folder, &["run", "case.toml", "--out", "run", "--steps", "0", "--quiet"]);
    let said = done(&folder, &["report", "run", "--png"]);
    let svg = shown(&folder.join("run")).keys().filter(|path| path.extension().unwrap() == "svg").count();
    assert!(said.ends_with(&format!("{svg} plots also written as PNG\n")) && svg > 3, "{said}");
    let bytes = fs::read(folder.join("run/plots/kii.png")).unwrap();
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    // 2.8 pixels for a unit of the SVG file.
    let size = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    let picture = common::read(&folder.join("run/plots/kii.svg"));
    let width: f32 = picture.split("width=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    assert_eq!(size(16), (2.8 * width).ceil() as u32);
    // A picture that is none is told of, and a new run leaves no picture of the one before.
    fs::write(folder.join("run/note.svg"), "no picture").unwrap();
    let failed = railcrack(&folder, &["report", "run", "--png"]);
    assert_eq!(failed.status.code(), Some(4));
    assert!(common::stderr(&failed).contains("note.svg"), "{}", common::stderr(&failed));
    done(&folder, &["run", "case.toml", "--out", "run", "--steps", "0", "--quiet", "--force"]);
    assert!(!folder.join("run/plots/kii.png").exists());
}

#[test]
fn a_direct_state_shows_what_passages_lead_to() {
    let folder = folder("direct");
    fs::write(folder.join("case.toml"), format!("{}[shakedown]\nmethod = \"direct\"\n", case())).unwrap();
    done(&folder, &["shakedown", "case.toml", "--out", "state", "--quiet"]);
    again(&folder, "state", "plastic state");
    let page = fs::read_to_string(folder.join("state/report.html")).unwrap();
    assert!(page.contains("class=\"curve\" data-name=\"σxx, pass by pass\""));
    assert!(page.contains("by the direct method, which does not follow the passages"));
}

#[test]
fn a_resumed_run_has_the_report_of_one_that_was_not_interrupted() {
    let folder = folder("resumed");
    done(&folder, &["run", "case.toml", "--out", "whole", "--quiet"]);
    // A run that ends early is one that was interrupted, but for the case it says; so the run is
    // cut back by hand to what stands after its last checkpoint: tables, then plots and report that
    // are not there.
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
    let nothing = "holds no results to report on: a run folder has summary.json";
    let absent = "there is no such folder";
    for (path, says) in [(".", nothing), ("nowhere", absent), ("case.toml", absent)] {
        let (code, said) = refused(path);
        assert_eq!(code, Some(2), "{path}: {said}");
        assert!(said.split_whitespace().collect::<Vec<_>>().join(" ").contains(says), "{said}");
    }
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    fs::write(folder.join("run/summary.json"), "{").unwrap();
    let (code, said) = refused("run");
    assert_eq!(code, Some(4), "{said}");
    assert!(said.contains("summary.json"), "{said}");
}
