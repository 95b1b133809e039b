//! `railcrack run` as a user meets it.

use super::common;
use super::common::QUICK_CASE;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Files in which two runs of one case must agree.
const FILES: [&str; 8] = [
    "case.toml",
    "sif.csv",
    "growth.csv",
    "faces.csv",
    "plots/ki.svg",
    "plots/kii.svg",
    "plots/paths.svg",
    "plots/faces.svg",
];

/// The quick case through more steps.
fn case() -> String {
    QUICK_CASE.replace("steps = 2", "steps = 12")
}

fn workplace(name: &str) -> PathBuf {
    let folder = common::folder("run-command", name);
    fs::write(folder.join("case.toml"), case()).unwrap();
    folder
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    common::command(folder, &[&["run", "case.toml"], arguments].concat())
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
}

fn same_files(one: &Path, other: &Path) {
    for name in FILES {
        let read = |folder: &Path| fs::read(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(read(one) == read(other), "{name} differs");
    }
}

#[test]
fn a_killed_run_resumes_to_the_files_of_one_that_was_not() {
    let folder = workplace("killed");
    assert_eq!(run(&folder, &["--out", "whole", "--quiet"]).status.code(), Some(0));
    for kill_after in 1..=3 {
        let out = format!("killed-{kill_after}");
        let growth = folder.join(&out).join("growth.csv");
        let mut child = command(&folder, &["--out", &out, "--quiet"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // Rows without the two kinds of header lines.
        let rows = || {
            let text = fs::read_to_string(&growth).unwrap_or_default();
            text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())).count()
        };
        let started = Instant::now();
        while rows() < kill_after && started.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(rows() >= kill_after, "the run wrote nothing");
        let resumed = run(&folder, &["--out", &out, "--quiet", "--resume"]);
        assert_eq!(resumed.status.code(), Some(0), "{}", String::from_utf8_lossy(&resumed.stderr));
        same_files(&folder.join("whole"), &folder.join(&out));
    }
}

#[test]
fn a_list_of_fields_that_is_gone_is_written_again() {
    let folder = common::folder("run-command", "fields");
    fs::write(folder.join("case.toml"), common::QUICK_CASE.replace("steps = 2", "steps = 1")).unwrap();
    let line = ["run", "case.toml", "--out", "out", "--quiet"];
    common::ends(&folder, &line, 0);
    let list = folder.join("out/fields.pvd");
    let before = fs::read(&list).unwrap();
    for content in [None, Some("<VTKFile>")] {
        match content {
            None => fs::remove_file(&list).unwrap(),
            Some(text) => fs::write(&list, text).unwrap(),
        }
        common::ends(&folder, &["verify", "out"], 4);
        common::ends(&folder, &[&line[..], &["--resume"]].concat(), 0);
        assert!(fs::read(&list).unwrap() == before);
        common::ends(&folder, &["verify", "out"], 0);
    }
    // Also that of a run of a study, whose summary stands for all of its files.
    let study = common::QUICK_CASE
        .replace("steps = 2", "steps = 0")
        .replace("friction = 0.3", "friction = [0.1, 0.3]");
    fs::write(folder.join("study.toml"), study + "[output]\nfields = true\n").unwrap();
    common::ends(&folder, &["sweep", "study.toml", "--out", "study", "--quiet"], 0);
    fs::remove_file(folder.join("study/runs/002/fields.pvd")).unwrap();
    let told = common::stdout(&common::ends(&folder, &["verify", "study"], 4));
    assert!(told.contains("study/runs/002/fields.pvd: is not there"), "{told}");
}

#[test]
fn threads_do_not_show_in_the_files() {
    let folder = workplace("threads");
    for threads in ["1", "2"] {
        let output = run(&folder, &["--out", threads, "--threads", threads, "--steps", "2", "--quiet"]);
        assert_eq!(output.status.code(), Some(0));
    }
    same_files(&folder.join("1"), &folder.join("2"));
}

#[test]
fn rows_of_every_step_tip_and_position() {
    let folder = workplace("rows");
    let output = run(&folder, &["--out", "out", "--steps", "2", "--set", "growth.increment=0.04"]);
    assert_eq!(output.status.code(), Some(0));
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(told.lines().filter(|line| line.starts_with("step ")).count(), 3, "{told}");
    assert!(String::from_utf8_lossy(&output.stdout).starts_with("steps-done at step 2"));

    let growth = table(&folder.join("out/growth.csv"));
    assert_eq!(column(&growth, "step"), ["0", "1", "2"]);
    assert_eq!(column(&growth, "stop"), ["", "", "steps-done"]);
    let number = |text: &String| text.parse::<f64>().unwrap();
    let lengths: Vec<f64> = column(&growth, "length_mm").iter().map(number).collect();
    let increments: Vec<f64> = column(&growth, "increment_mm").iter().map(number).collect();
    for step in 0..2 {
        assert!((increments[step] - 0.04 * lengths[step]).abs() < 1e-12);
        assert!((lengths[step + 1] - lengths[step] - increments[step]).abs() < 1e-12);
    }
    assert_eq!(increments[2], 0.0);

    let sif = table(&folder.join("out/sif.csv"));
    let last_passage = column(&sif, "passage").iter().map(|p| p.parse::<usize>().unwrap()).max().unwrap();
    assert!(last_passage >= 2, "friction has memory");
    assert_eq!(column(&sif, "position").iter().filter(|p| *p == "61").count() % 3, 0);
    let over_a: Vec<f64> = column(&sif, "xc_over_a").iter().map(number).take(61).collect();
    assert_eq!((over_a[0], over_a[60]), (-6.0, 6.0));

    let summary = fs::read_to_string(folder.join("out/summary.json")).unwrap();
    for key in [
        "version",
        "engine",
        "contact",
        "wall_s",
        "peak_memory_mb",
        "dofs",
        "face_points",
        "substeps",
        "contact_iterations_mean",
        "contact_iterations_max",
        "complementarity_max",
        "passages",
        "stop",
        "warnings",
    ] {
        assert!(summary.contains(&format!("\"{key}\":")), "summary.json lacks {key}");
    }
}

#[test]
fn both_contact_solvers_give_the_same_path() {
    let folder = workplace("solvers");
    for solver in ["newton", "latin"] {
        let output = run(&folder, &["--out", solver, "--contact", solver, "--steps", "2", "--quiet"]);
        assert_eq!(output.status.code(), Some(0));
    }
    let tips = |solver: &str, axis: &str| -> Vec<f64> {
        let growth = table(&folder.join(solver).join("growth.csv"));
        column(&growth, axis).iter().map(|text| text.parse().unwrap()).collect()
    };
    for axis in ["tip_x_mm", "tip_y_mm", "delta_kii_mpa_sqrt_m"] {
        for (newton, latin) in tips("newton", axis).iter().zip(tips("latin", axis)) {
            // K agrees to 1e-6 on the same steps; events placed by it may move by as much.
            assert!((newton - latin).abs() <= 1e-5 * newton.abs(), "{axis}: {newton} {latin}");
        }
    }
}

#[test]
fn refusals_write_nothing() {
    let folder = workplace("refused");
    let refusals: [(&[&str], i32, &str); 4] = [
        (&["--engine", "fem"], 2, "dislocation"),
        (&["--contact", "bisection"], 2, "newton"),
        (&["--steps", "100000"], 2, "steps"),
        (&["--out", "absent", "--resume"], 2, "absent"),
    ];
    for (arguments, code, word) in refusals {
        let output = run(&folder, arguments);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{told}");
        assert!(told.contains(word), "{told}");
    }
    let left: Vec<_> = fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left, ["case.toml"]);
    fs::write(folder.join("file"), "in the way").unwrap();
    assert_eq!(run(&folder, &["--out", "file", "--steps", "0"]).status.code(), Some(4));
}

/// Header and rows of a table, comments left out.
fn table(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn column(table: &[Vec<String>], name: &str) -> Vec<String> {
    let at = table[0].iter().position(|column| column == name).unwrap_or_else(|| panic!("no column {name}"));
    table[1..].iter().map(|row| row[at].clone()).collect()
}

/// A run that ended for want of steps goes on as if it had had them from the beginning.
#[test]
fn more_steps_of_a_run_that_has_ended() {
    let folder = common::folder("run-command", "more-steps");
    fs::write(folder.join("case.toml"), common::DISLOCATION_CASE.as_str()).unwrap();
    let ended = |arguments: &[&str], code| {
        let output = run(&folder, &[arguments, &["--quiet"]].concat());
        assert_eq!(output.status.code(), Some(code), "{}", common::stderr(&output));
        common::stderr(&output)
    };
    ended(&["--out", "whole", "--steps", "5"], 0);
    ended(&["--out", "parts", "--steps", "1"], 0);
    for steps in ["3", "5"] {
        ended(&["--out", "parts", "--steps", steps, "--resume"], 0);
    }
    same_files(&folder.join("whole"), &folder.join("parts"));
    common::done(&folder, &["verify", "parts"]);
    // Fewer steps, or another case, are another run.
    let says = ended(&["--out", "parts", "--steps", "4", "--resume"], 2);
    assert!(says.contains("steps = 5") && says.contains("steps = 4"), "{says}");
    // A run of the initial cracks alone has no step before its end.
    ended(&["--out", "none", "--steps", "0"], 0);
    ended(&["--out", "none", "--steps", "5", "--resume"], 0);
    same_files(&folder.join("whole"), &folder.join("none"));
}
