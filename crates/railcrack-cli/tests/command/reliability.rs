//! Reliability of a user's results: other processes, turned bits, signals, cases larger than the
//! machine.

use super::common::{self, DISLOCATION_CASE, command, done, ends, read, stderr, stdout};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

fn workplace(name: &str) -> PathBuf {
    let folder = common::folder("reliability", name);
    fs::write(folder.join("case.toml"), &**DISLOCATION_CASE).unwrap();
    folder
}

fn wait_for(file: &Path) {
    let started = Instant::now();
    while !file.exists() {
        assert!(started.elapsed() < Duration::from_secs(60), "{} never came", file.display());
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Turns a bit of the last digit in `file`: a number with another value, or a word with another
/// letter.
fn turn_a_bit(file: &Path) -> Vec<u8> {
    let before = fs::read(file).unwrap();
    let mut bytes = before.clone();
    let at = bytes.iter().rposition(u8::is_ascii_digit).unwrap();
    bytes[at] ^= 1;
    fs::write(file, bytes).unwrap();
    before
}

#[test]
fn two_processes_do_not_share_a_run_folder() {
    let folder = workplace("lock");
    let long = DISLOCATION_CASE.replace("interface_elements = 16", "interface_elements = 400");
    fs::write(folder.join("long.toml"), long.replace("steps = 2", "steps = 500")).unwrap();
    let line = ["run", "long.toml", "--out", "ab", "--quiet"];
    let mut first = command(&folder, &line).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    wait_for(&folder.join("ab/case.toml"));
    let before = fs::read(folder.join("ab/case.toml")).unwrap();
    for line in [
        &["run", "case.toml", "--out", "ab", "--force"][..],
        &["run", "long.toml", "--out", "ab", "--resume"],
        &["shakedown", "case.toml", "--out", "ab", "--force"],
        &["verify", "ab"],
    ] {
        let said = stderr(&ends(&folder, line, 4));
        let says = format!("is being computed by another process ({})", first.id());
        assert!(said.split_whitespace().collect::<Vec<_>>().join(" ").contains(&says), "{said}");
    }
    assert!(fs::read(folder.join("ab/case.toml")).unwrap() == before, "the run was touched");
    first.kill().unwrap();
    first.wait().unwrap();
    // The lock has died with its process.
    assert!(folder.join("ab/run.lock").exists());
    done(&folder, &["run", "case.toml", "--out", "ab", "--force", "--quiet"]);
    assert!(!folder.join("ab/run.lock").exists());
}

#[test]
fn a_turned_bit_is_found() {
    let folder = workplace("bits");
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let told = done(&folder, &["verify", "run"]);
    assert!(told.ends_with("files are intact\n") && !told.contains("damaged"), "{told}");
    for file in [
        "sif.csv",
        "growth.csv",
        "faces.csv",
        "case.toml",
        "summary.json",
        "SHA256SUMS",
        "run-log.bin",
        "checkpoint.bin",
    ] {
        let path = folder.join("run").join(file);
        let before = turn_a_bit(&path);
        let output = ends(&folder, &["verify", "run"], 4);
        assert!(stdout(&output).contains(&format!("damaged: run/{file}: ")), "{file}: {}", stdout(&output));
        // What is written anew by it is no damage to a run that goes on.
        if !["case.toml", "summary.json", "SHA256SUMS"].contains(&file) {
            let said = stderr(&ends(&folder, &["run", "case.toml", "--out", "run", "--resume"], 4));
            assert!(said.contains(file), "{said}");
        }
        fs::write(path, before).unwrap();
    }
    done(&folder, &["verify", "run"]);
    assert!(stderr(&ends(&folder, &["verify", "nope"], 2)).contains("there is no such folder"));
    ends(&folder, &["verify", "."], 2);
}

/// Without railcrack: the checksums are those of coreutils, in their format.
#[cfg(target_os = "linux")]
#[test]
fn sha256sum_checks_the_folder_of_a_run() {
    let folder = workplace("sha256sum");
    let check = |of: &str| {
        let mut program = Command::new("sha256sum");
        let output = program.args(["--check", "--strict", "SHA256SUMS"]).current_dir(folder.join(of));
        let output = output.output().unwrap();
        (output.status.success(), stdout(&output))
    };
    done(&folder, &["run", "case.toml", "--out", "run", "--steps", "1", "--quiet"]);
    done(&folder, &["shakedown", "case.toml", "--out", "rolled", "--quiet"]);
    for (of, files) in [
        ("run", &["case.toml", "sif.csv", "growth.csv", "faces.csv"][..]),
        ("rolled", &["case.toml", "profile.csv", "passes.csv", "plastic.vtu", "cycle.vtu"]),
    ] {
        let (fine, told) = check(of);
        assert!(fine && told.lines().count() == files.len(), "{told}");
        assert!(files.iter().all(|file| told.contains(&format!("{file}: OK"))), "{told}");
    }
    turn_a_bit(&folder.join("run/growth.csv"));
    let (fine, told) = check("run");
    assert!(!fine && told.contains("growth.csv: FAILED"), "{told}");
}

/// A folder with checksums of another kind is neither intact nor damaged.
#[test]
fn older_checksums_are_named_and_not_compared() {
    let folder = workplace("older");
    done(&folder, &["shakedown", "case.toml", "--out", "rolled", "--quiet"]);
    let path = folder.join("rolled/shakedown.json");
    let mut document: serde_json::Value = serde_json::from_str(&read(&path)).unwrap();
    document["checksum"] = "cbf29ce484222325".into();
    fs::write(&path, document.to_string()).unwrap();
    let told = done(&folder, &["verify", "rolled"]);
    assert!(told.contains("shakedown.json: has no SHA-256 checksum (an older version wrote it)"), "{told}");
}

#[test]
fn other_folders_are_verified_too() {
    let folder = workplace("others");
    for out in ["a", "b"] {
        done(&folder, &["run", "case.toml", "--out", out, "--steps", "1", "--quiet"]);
    }
    done(&folder, &["compare", "a", "b", "--out", "difference"]);
    done(&folder, &["shakedown", "case.toml", "--out", "rolled", "--quiet"]);
    for (of, files) in [
        ("difference", &["compare.csv", "compare.json", "SHA256SUMS"][..]),
        (
            "rolled",
            &["case.toml", "profile.csv", "passes.csv", "plastic.vtu", "shakedown.json", "SHA256SUMS"],
        ),
    ] {
        done(&folder, &["verify", of]);
        for file in files {
            let path = folder.join(of).join(file);
            let before = turn_a_bit(&path);
            let told = stdout(&ends(&folder, &["verify", of], 4));
            assert!(told.contains(&format!("damaged: {of}/{file}: ")), "{told}");
            fs::write(path, before).unwrap();
        }
    }
}

#[test]
fn a_study_has_no_numbers_of_damaged_runs() {
    let folder = workplace("study");
    fs::write(
        folder.join("study.toml"),
        DISLOCATION_CASE.replace("angle_deg = 40.0", "angle_deg = [30.0, 40.0]"),
    )
    .unwrap();
    done(&folder, &["sweep", "study.toml", "--steps", "0", "--quiet"]);
    done(&folder, &["verify", "study"]);
    let run = "study/runs/002";
    let path = folder.join(run).join("growth.csv");
    let before = turn_a_bit(&path);
    let output = ends(&folder, &["sweep", "study.toml", "--steps", "0", "--quiet", "--resume"], 4);
    assert!(stdout(&output).starts_with("2 runs: 1 done, 1 failed\nrun 2 (angle_deg = 40) failed: "));
    for said in [stdout(&output), stderr(&output), stderr(&ends(&folder, &["report", "study"], 4))] {
        assert!(said.contains("growth.csv"), "{said}");
    }
    let summary = folder.join("study/summary.csv");
    assert_eq!(common::column(&summary, "state"), ["done", "cannot-read-or-write"]);
    assert_eq!(common::column(&summary, "length_mm")[1], "");
    assert!(stdout(&ends(&folder, &["verify", "study"], 4)).contains(&format!("damaged: {run}/growth.csv")));
    fs::write(path, before).unwrap();
    done(&folder, &["sweep", "study.toml", "--steps", "0", "--quiet", "--resume"]);
    done(&folder, &["verify", "study"]);
}

#[test]
fn a_run_of_another_process_is_left_to_it() {
    let folder = workplace("left");
    let study = DISLOCATION_CASE.replace("angle_deg = 40.0", "angle_deg = [30.0, 40.0]");
    fs::write(folder.join("study.toml"), &study).unwrap();
    done(&folder, &["sweep", "study.toml", "--steps", "0", "--quiet", "--shard", "1/2"]);
    let run = folder.join("study/runs/002");
    fs::create_dir_all(&run).unwrap();
    // The lock of this process stands for that of another sweep.
    let lock = fs::File::create(run.join("run.lock")).unwrap();
    lock.lock().unwrap();
    fs::write(run.join("run.lock"), "4711\n").unwrap();
    let output = ends(&folder, &["sweep", "study.toml", "--steps", "0", "--resume"], 0);
    assert!(stdout(&output).starts_with("2 runs: 1 done, 1 missing\n"), "{}", stdout(&output));
    assert!(stderr(&output).contains("another process (4711)"), "{}", stderr(&output));
    ends(&folder, &["sweep", "study.toml", "--steps", "0", "--quiet", "--force"], 4);
    drop(lock);
    let told = done(&folder, &["sweep", "study.toml", "--steps", "0", "--quiet", "--resume"]);
    assert!(told.starts_with("2 runs: 2 done\n"), "{told}");
}

/// Every file below `folder` with its content.
#[cfg(unix)]
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    for name in common::names(folder) {
        let path = folder.join(name);
        match path.is_dir() {
            true => found.extend(contents(&path)),
            false => found.push((path.clone(), fs::read(&path).unwrap())),
        }
    }
    found
}

/// Starts `line` where `link` leads to a file or a folder outside, which must stay as it is; the
/// program ends with one of `codes`.
#[cfg(unix)]
#[track_caller]
fn with_a_link(folder: &Path, link: &str, is_folder: bool, line: &[&str], codes: &[i32]) {
    let (outside, place) = (folder.join("outside"), folder.join("out").join(link));
    let _ = fs::remove_dir_all(folder.join("out"));
    let _ = fs::remove_dir_all(&outside);
    fs::create_dir_all(place.parent().unwrap()).unwrap();
    fs::create_dir(&outside).unwrap();
    fs::write(outside.join("file"), "theirs").unwrap();
    // Files that would be replaced or removed, were the link followed.
    for file in ["sif.csv", "ki.svg", "case.toml", "summary.json", "checkpoint.bin", "outcome.json"] {
        fs::write(outside.join(file), "theirs").unwrap();
    }
    let target = if is_folder { outside.clone() } else { outside.join("file") };
    std::os::unix::fs::symlink(target, &place).unwrap();
    let before = contents(&outside);
    let output = common::railcrack(folder, line);
    let (code, said) = (output.status.code().unwrap_or(-1), stderr(&output));
    assert!(codes.contains(&code), "{link}: {code}, {said}");
    if code == 4 {
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains("it is a link, and nothing is written through a link"), "{link}: {said}");
    }
    assert!(contents(&outside) == before, "{link}: what is outside was changed");
}

#[cfg(unix)]
#[test]
fn nothing_is_written_through_links() {
    let folder = workplace("links");
    let case = DISLOCATION_CASE.replace("steps = 2", "steps = 1");
    fs::write(folder.join("case.toml"), &case).unwrap();
    let run = ["run", "case.toml", "--out", "out", "--quiet", "--force"];
    for file in ["run.lock", "case.toml.partial"] {
        with_a_link(&folder, file, false, &run, &[4]);
    }
    // These are replaced, a link like a file.
    let tables =
        ["sif.csv", "growth.csv", "faces.csv", "run-log.bin", "sif.csv.partial", "checkpoint.bin.partial"];
    let whole =
        ["case.toml", "summary.json", "checkpoint.bin", "report.html", "plots/ki.svg", "plots/ki.png"];
    for file in tables.into_iter().chain(whole) {
        with_a_link(&folder, file, false, &run, &[0]);
    }
    for inner in ["plots", "fields", "inputs"] {
        with_a_link(&folder, inner, true, &run, &[4]);
    }
    with_a_link(&folder, "shakedown", true, &run, &[4]);
    with_a_link(&folder, "run.lock", false, &["shakedown", "case.toml", "--out", "out", "--quiet"], &[4]);

    let study = case.replace("angle_deg = 40.0", "angle_deg = [30.0, 40.0]");
    fs::write(folder.join("study.toml"), format!("{study}\n[output]\nrun_folders = false\n")).unwrap();
    fs::write(folder.join("folders.toml"), &study).unwrap();
    let force = ["--out", "out", "--quiet", "--force"];
    for begin in [&["sweep", "study.toml"][..], &["sweep", "folders.toml"]] {
        let line = [begin, &force].concat();
        for inner in ["plots", "runs", "runs/001", "runs/002"] {
            with_a_link(&folder, inner, true, &line, &[4]);
        }
        with_a_link(&folder, "runs/001/run.lock", false, &line, &[4]);
        for file in
            ["runs/001/sif.csv", "packed-1.bin", "study.json", "study.toml", "summary.csv", "runs.parquet"]
        {
            with_a_link(&folder, file, false, &line, &[0]);
        }
        // Without --force the link is in the way; in the first part of a study it stays what it is.
        let part = [begin, &["--out", "out", "--quiet", "--shard", "1/2"]].concat();
        with_a_link(&folder, "packed-1.bin", false, &part, &[2]);
    }

    // A run folder that a link brings into a study is read, and left alone.
    let _ = fs::remove_dir_all(folder.join("out"));
    done(&folder, &["sweep", "folders.toml", "--out", "out", "--quiet"]);
    fs::rename(folder.join("out/runs/001"), folder.join("elsewhere")).unwrap();
    std::os::unix::fs::symlink("../../elsewhere", folder.join("out/runs/001")).unwrap();
    let before = contents(&folder.join("elsewhere"));
    done(&folder, &["sweep", "folders.toml", "--out", "out", "--quiet", "--resume"]);
    done(&folder, &["verify", "out"]);
    ends(&folder, &["sweep", "folders.toml", "--out", "out", "--quiet", "--force"], 4);
    ends(&folder, &["report", "out", "--run", "1"], 4);
    assert!(contents(&folder.join("elsewhere")) == before);
}

#[cfg(unix)]
#[test]
fn a_pipe_is_no_file_of_a_run() {
    let folder = workplace("pipes");
    for (file, code) in [("run.lock", 4), ("case.toml.partial", 4), ("sif.csv", 0)] {
        fs::create_dir_all(folder.join("out")).unwrap();
        assert!(Command::new("mkfifo").arg(folder.join("out").join(file)).status().unwrap().success());
        // It does not wait for somebody who reads.
        ends(&folder, &["run", "case.toml", "--out", "out", "--quiet", "--force", "--steps", "0"], code);
        fs::remove_dir_all(folder.join("out")).unwrap();
    }
}

#[test]
fn a_case_larger_than_the_machine_is_refused() {
    let folder = workplace("budget");
    let cracks = "angle_deg = 40.0\ncount = 30\nspacing_mm = 5.0\n";
    let whole = DISLOCATION_CASE.replace("[solver]\n", "[solver]\nnetwork = \"whole\"\n");
    let large = whole.replace("angle_deg = 40.0", cracks).replace("16", "400").replace("41", "2001");
    fs::write(folder.join("large.toml"), large).unwrap();
    let told = done(&folder, &["check", "large.toml"]);
    assert!(told.contains("\nmachine\n") && told.contains("--no-limits"), "{told}");
    let said = stderr(&ends(&folder, &["run", "large.toml"], 2));
    assert!(said.contains("MB") && said.contains("--no-limits"), "{said}");
    let study = read(&folder.join("large.toml")).replace("friction = 0.3", "friction = [0.1, 0.3]");
    fs::write(folder.join("study.toml"), study).unwrap();
    assert!(stderr(&ends(&folder, &["sweep", "study.toml"], 2)).contains("--no-limits"));
    assert_eq!(common::names(&folder), ["case.toml", "large.toml", "study.toml"]);
    done(&folder, &["run", "case.toml", "--no-limits", "--quiet", "--out", "run"]);
}

#[cfg(unix)]
#[test]
fn a_signal_ends_a_run_within_its_assembly() {
    let folder = workplace("signal");
    let cracks = "angle_deg = 40.0\ncount = 25\nspacing_mm = 6.0\n";
    let whole = DISLOCATION_CASE.replace("[solver]\n", "[solver]\nnetwork = \"whole\"\n");
    let long = whole.replace("angle_deg = 40.0", cracks).replace("elements = 16", "elements = 400");
    fs::write(folder.join("long.toml"), long).unwrap();
    for signal in ["-INT", "-TERM"] {
        let line = ["run", "long.toml", "--no-limits", "--out", &signal[1..]];
        let child = command(&folder, &line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        wait_for(&folder.join(&signal[1..]).join("faces.csv"));
        std::thread::sleep(Duration::from_millis(500));
        let asked = Instant::now();
        Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        let output = child.wait_with_output().unwrap();
        let took = asked.elapsed();
        assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
        let said = format!("{}{}", stdout(&output), stderr(&output));
        assert!(said.contains("--resume"), "{said}");
        // One second is the promise; the rest is for a machine that does much else.
        assert!(took < Duration::from_millis(2500), "{signal}: {took:?}");
        println!("{signal}: {:.2} s", took.as_secs_f64());
    }
}

#[test]
fn what_goes_wrong_is_said_on_standard_error() {
    let folder = workplace("said");
    assert!(stderr(&ends(&folder, &["report", "nope"], 2)).contains("nope: there is no such folder"));
    // At 90° the elements cannot follow face points as close as a third of them.
    let study = DISLOCATION_CASE
        .replace("angle_deg = 40.0", "angle_deg = 90.0")
        .replace("interface_elements = 16", "element_size_mm = 0.3\ninterface_spacing_mm = [0.3, 0.1]")
        .replace("dislocation", "xfem");
    fs::write(folder.join("study.toml"), study).unwrap();
    let output = ends(&folder, &["sweep", "study.toml", "--steps", "0", "--quiet"], 3);
    assert!(
        stderr(&output).starts_with("run 2 (interface_spacing_mm = 0.1) failed: "),
        "{}",
        stderr(&output)
    );
}

#[test]
fn an_option_does_not_hide_a_wrong_value() {
    let folder = workplace("hidden");
    for (good, wrong, option) in [
        ("engine = \"dislocation\"", "engine = \"fem\"", ["--engine", "dislocation"]),
        ("steps = 2", "steps = -1", ["--steps", "0"]),
    ] {
        fs::write(folder.join("wrong.toml"), DISLOCATION_CASE.replace(good, wrong)).unwrap();
        let said = stderr(&ends(&folder, &["run", "wrong.toml", option[0], option[1]], 2));
        assert!(said.contains(wrong), "{said}");
    }
}
