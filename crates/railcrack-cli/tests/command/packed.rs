//! Studies without run folders: killed, resumed, in parts.

use super::common::{self, command, done, ends, names, read, stderr, stdout};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// 60 quick runs, drawn.
const STUDY: &str = "\
title = \"Packed\"
[study]
samples = 60
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = { uniform = [0.1, 0.3] }
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = { normal = [30.0, 3.0] }
friction = { choice = [[0.2, 1], [0.3, 2]] }
[passage]
positions = 31
[mesh]
interface_elements = 12
[growth]
steps = 3
[solver]
engine = \"dislocation\"
[output]
run_folders = false
";

const TABLES: [&str; 4] = ["summary.csv", "runs.parquet", "growth.parquet", "sif.parquet"];

fn workplace(name: &str) -> PathBuf {
    let folder = common::folder("packed", name);
    fs::write(folder.join("study.toml"), STUDY).unwrap();
    folder
}

fn same_tables(folder: &Path, one: &str, other: &str) {
    for file in TABLES.iter().chain(&["report.html", "plots/ki.svg", "plots/length-cycles.svg"]) {
        let bytes = |study: &str| {
            fs::read(folder.join(study).join(file)).unwrap_or_else(|e| panic!("{study}/{file}: {e}"))
        };
        assert!(bytes(one) == bytes(other), "{one} and {other} differ in {file}");
    }
}

#[test]
fn a_study_without_run_folders_is_a_handful_of_files_however_it_came_about() {
    let folder = workplace("whole");
    let line = ["sweep", "study.toml", "--quiet", "--out"];
    done(&folder, &[&line[..], &["whole"]].concat());
    let files = [
        "growth.parquet",
        "packed-1.bin",
        "plots",
        "report.html",
        "runs.parquet",
        "sif.parquet",
        "study.json",
        "study.toml",
        "summary.csv",
        "times.csv",
    ];
    assert_eq!(names(&folder.join("whole")), files);
    assert!(done(&folder, &["verify", "whole"]).lines().count() == 1);

    // Killed at odd moments again and again.
    for (round, wait) in [37u64, 91, 150, 260, 75, 410].into_iter().enumerate() {
        let more: &[&str] = if round == 0 { &["killed"] } else { &["killed", "--resume"] };
        let mut child = command(&folder, &[&line[..], more].concat()).stdout(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(wait));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let resume: &[&str] = if folder.join("killed").exists() { &["killed", "--resume"] } else { &["killed"] };
    done(&folder, &[&line[..], resume].concat());
    same_tables(&folder, "whole", "killed");
    assert_eq!(names(&folder.join("killed")), files);

    // In parts at once, in one folder.
    let part = |shard: &str| {
        let line = [&line[..], &["parts", "--shard", shard]].concat();
        command(&folder, &line).stdout(Stdio::null()).spawn().unwrap()
    };
    for mut part in ["1/3", "2/3", "3/3"].map(part) {
        assert_eq!(part.wait().unwrap().code(), Some(0));
    }
    done(&folder, &["report", "parts"]);
    same_tables(&folder, "whole", "parts");
    let refused = ends(&folder, &[&line[..], &["parts", "--shard", "2/3"]].concat(), 2);
    assert!(stderr(&refused).contains("run 2, packed"), "{}", stderr(&refused));
    done(&folder, &[&line[..], &["parts", "--shard", "2/3", "--force"]].concat());
    same_tables(&folder, "whole", "parts");

    // A page of one run, in a folder of its own.
    let told = done(&folder, &["report", "whole", "--run", "7"]);
    assert!(
        told.contains("whole/runs/07/report.html") || told.contains("whole/runs/007/report.html"),
        "{told}"
    );
    assert!(read(&folder.join("whole/runs/007/growth.csv")).lines().count() > 4);
    // It does not disturb the study.
    done(&folder, &[&line[..], &["whole", "--resume"]].concat());
    same_tables(&folder, "whole", "parts");
}

#[test]
fn a_packed_study_keeps_no_more_than_tables() {
    let folder = workplace("refused");
    for more in ["faces = \"ends\"\n", "plots = true\n", "report = true\n"] {
        fs::write(folder.join("more.toml"), format!("{STUDY}{more}")).unwrap();
        let told = stderr(&ends(&folder, &["check", "more.toml"], 2));
        assert!(told.contains("keeps growth and K of the runs"), "{told}");
    }
    let started = Instant::now();
    let checked: serde_json::Value =
        serde_json::from_str(&done(&folder, &["check", "study.toml", "--json"])).unwrap();
    assert_eq!(checked["runs"].as_array().map(Vec::len), Some(60));
    assert!(started.elapsed() < Duration::from_secs(20));
}

/// Two parts of a study in the folder `mine`, the second one of another pressure, copied there by
/// `copy`.
fn with_runs_of_another_study(name: &str, study: &str, copy: impl Fn(&Path)) -> PathBuf {
    let folder = common::folder("packed", name);
    let few = study.replace("samples = 60", "samples = 4").replace("steps = 3", "steps = 1");
    fs::write(folder.join("mine.toml"), &few).unwrap();
    fs::write(folder.join("other.toml"), few.replace("845.0", "1000.0")).unwrap();
    done(&folder, &["sweep", "mine.toml", "--shard", "1/2", "--quiet"]);
    done(&folder, &["sweep", "other.toml", "--shard", "2/2", "--quiet"]);
    // In the same folder, the other study is refused at once.
    let refused = ends(&folder, &["sweep", "other.toml", "--out", "mine", "--shard", "2/2", "--quiet"], 2);
    let says = "peak_pressure_mpa = 845.0\" there, \"peak_pressure_mpa = 1000.0\" now";
    assert!(words(&stderr(&refused)).contains(says), "{}", stderr(&refused));
    copy(&folder);
    folder
}

/// A message without the breaks of its lines.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn packed_runs_of_another_study_are_refused() {
    let folder = with_runs_of_another_study("foreign", STUDY, |folder| {
        fs::copy(folder.join("other/packed-1.bin"), folder.join("mine/packed-2.bin")).unwrap();
    });
    let says = "mine/packed-2.bin: holds run 2 of another study";
    let told = stdout(&ends(&folder, &["verify", "mine"], 4));
    assert!(told.contains(&format!("damaged: {says}")), "{told}");
    let said = words(&stderr(&ends(&folder, &["report", "mine"], 4)));
    assert!(said.contains(says), "{said}");
    // None of its numbers is in the tables.
    let summary = folder.join("mine/summary.csv");
    assert_eq!(
        common::column(&summary, "state"),
        ["done", "cannot-read-or-write", "done", "cannot-read-or-write"]
    );
    assert_eq!(common::column(&summary, "length_mm")[1], "");
    let resume = ["sweep", "mine.toml", "--resume", "--quiet"];
    let said = words(&stderr(&ends(&folder, &resume, 2)));
    let says = "packed-2.bin holds run 2 of another study (line 13 of its case.toml is \"peak_pressure_mpa = 1000.0\", \
                not \"peak_pressure_mpa = 845.0\"): take the file out of the folder";
    assert!(said.contains(says), "{said}");
    fs::remove_file(folder.join("mine/packed-2.bin")).unwrap();
    assert!(done(&folder, &resume).starts_with("4 runs: 4 done\n"));
    done(&folder, &["verify", "mine"]);

    // A study that was changed itself is not taken for another one.
    fs::copy(folder.join("other.toml"), folder.join("mine.toml")).unwrap();
    let said = words(&stderr(&ends(&folder, &resume, 2)));
    assert!(said.contains("resume with the case and options it was started with"), "{said}");
}

#[test]
fn run_folders_of_another_study_are_refused() {
    let (with_folders, _) = STUDY.split_once("[output]").unwrap();
    let folder = with_runs_of_another_study("foreign-folders", with_folders, |folder| {
        for run in ["002", "004"] {
            let (from, to) = (folder.join("other/runs").join(run), folder.join("mine/runs").join(run));
            fs::rename(from, to).unwrap();
        }
    });
    let says = "002/case.toml: is not the case of run 2 of this study";
    let told = stdout(&ends(&folder, &["verify", "mine"], 4));
    assert!(told.contains(says), "{told}");
    let said = words(&stderr(&ends(&folder, &["report", "mine"], 4)));
    assert!(said.contains(says), "{said}");
    assert_eq!(common::column(&folder.join("mine/summary.csv"), "length_mm")[1], "");
    ends(&folder, &["sweep", "mine.toml", "--resume", "--quiet"], 2);
}

#[test]
fn a_damaged_record_is_the_only_run_that_is_lost() {
    let folder = workplace("record");
    let line = ["sweep", "study.toml", "--quiet", "--steps", "1", "--out"];
    done(&folder, &[&line[..], &["whole"]].concat());
    let path = folder.join("whole/packed-1.bin");
    let before = fs::read(&path).unwrap();
    let summary = read(&folder.join("whole/summary.csv"));
    for (part, named) in [(0, false), (3, true)] {
        // The header of the first record, which names its run; or the middle of the file.
        let at = if part == 0 { 9 } else { before.len() * part / 7 };
        let mut turned = before.clone();
        turned[at] ^= 1;
        fs::write(&path, &turned).unwrap();
        let told = stdout(&ends(&folder, &["verify", "whole"], 4));
        assert_eq!(told.matches("damaged: whole/packed-1.bin: bytes ").count(), 1, "{told}");
        assert_eq!(told.contains("(run "), named, "{told}");
        ends(&folder, &["report", "whole"], 4);
        let states = common::column(&folder.join("whole/summary.csv"), "state");
        assert_eq!(states.iter().filter(|state| *state == "done").count(), 59, "{states:?}");
        let lost = states.iter().find(|state| *state != "done").unwrap();
        assert_eq!(lost, if named { "cannot-read-or-write" } else { "missing" });
        assert!(fs::read(&path).unwrap() == turned, "nothing is cut");

        let output = ends(&folder, &[&line[..], &["whole", "--resume"]].concat(), 0);
        assert!(stdout(&output).starts_with("60 runs: 60 done\n"));
        let said = words(&stderr(&output));
        assert!(said.contains("do not hold what was written") && said.contains("computed again"), "{said}");
        let file = fs::read(&path).unwrap();
        let behind = before.len() * 6 / 7;
        assert!(file[behind..before.len()] == before[behind..], "the records behind it stay");
        done(&folder, &["verify", "whole"]);
        assert_eq!(read(&folder.join("whole/summary.csv")), summary);
        fs::write(&path, &before).unwrap();
    }
}

#[test]
fn every_file_of_a_study_is_verified() {
    let folder = workplace("verified");
    let few = STUDY.replace("samples = 60", "samples = 4").replace("steps = 3", "steps = 1");
    fs::write(folder.join("study.toml"), &few).unwrap();
    fs::write(folder.join("other.toml"), few.replace("845.0", "1000.0")).unwrap();
    for study in ["study", "other"] {
        done(&folder, &["sweep", &format!("{study}.toml"), "--quiet", "--out", &format!("{study}-out")]);
    }
    let out = folder.join("study-out");
    assert!(done(&folder, &["verify", "study-out"]).ends_with("10 files are intact\n"));
    let damaged = |file: &str, content: Option<&[u8]>| {
        let before = fs::read(out.join(file)).unwrap();
        match content {
            Some(content) => fs::write(out.join(file), content).unwrap(),
            None => fs::remove_file(out.join(file)).unwrap(),
        }
        let told = stdout(&ends(&folder, &["verify", "study-out"], 4));
        assert!(told.contains(&format!("damaged: study-out/{file}: ")), "{file}: {told}");
        fs::write(out.join(file), before).unwrap();
    };
    let tables = ["runs.parquet", "growth.parquet", "sif.parquet"];
    for file in tables.into_iter().chain(["study.toml", "study.json", "summary.csv"]) {
        let bytes = fs::read(out.join(file)).unwrap();
        // A bit of every 30th part, so that pages, headers and footer have some.
        for part in 0..30 {
            let mut turned = bytes.clone();
            turned[bytes.len() * part / 30] ^= 1 << (part % 8);
            damaged(file, Some(&turned));
        }
        if file != "study.json" {
            damaged(file, None);
        }
    }
    for file in tables {
        damaged(file, Some(&fs::read(folder.join("other-out").join(file)).unwrap()));
    }
    // Packed runs that are gone, although the table lists them as done.
    fs::remove_file(out.join("packed-1.bin")).unwrap();
    let told = stdout(&ends(&folder, &["verify", "study-out"], 4));
    assert_eq!(told.matches("is not there, and summary.csv lists it as done").count(), 4, "{told}");
    // While they are computed anew, nothing is listed that is gone.
    done(&folder, &["sweep", "study.toml", "--quiet", "--out", "study-out", "--force", "--shard", "1/2"]);
    let told = done(&folder, &["verify", "study-out"]);
    assert_eq!(told.matches("has not begun").count(), 2, "{told}");
}

#[test]
fn files_that_a_case_names_are_packed_and_verified() {
    let folder = common::folder("packed", "inputs");
    fs::write(
        folder.join("contact.csv"),
        "u_mm,p_mpa,q_mpa\n-6,0,0\n-3,600,60\n0,845,84.5\n3,600,60\n6,0,0\n",
    )
    .unwrap();
    let (before, _) = STUDY.split_once("[study]").unwrap();
    let (_, behind) = STUDY.split_once("[[crack]]").unwrap();
    let behind = behind.replace("angle_deg = { normal = [30.0, 3.0] }", "angle_deg = [25.0, 30.0]");
    let behind = behind.replace("friction = { choice = [[0.2, 1], [0.3, 2]] }", "friction = 0.2");
    let study = format!("{before}[contact]\nkind = \"table\"\nprofile = \"contact.csv\"\n[[crack]]{behind}");
    fs::write(folder.join("study.toml"), &study).unwrap();
    fs::write(folder.join("folders.toml"), study.replace("run_folders = false", "run_folders = true"))
        .unwrap();
    for study in ["study", "folders"] {
        done(&folder, &["sweep", &format!("{study}.toml"), "--steps", "1", "--quiet", "--out", study]);
        done(&folder, &["verify", study]);
        // The page of a run computes it again, from its case.
        done(&folder, &["report", study, "--run", "2"]);
        assert!(read(&folder.join(study).join("runs/002/inputs/contact-table")).contains("845"));
    }
    let path = folder.join("folders/runs/001/inputs/contact-table");
    let table = read(&path);
    fs::write(&path, table.replace("845", "945")).unwrap();
    let told = stdout(&ends(&folder, &["verify", "folders"], 4));
    assert!(told.contains("damaged: folders/runs/001/inputs/contact-table: "), "{told}");
    fs::write(&path, table).unwrap();
    // A run of the same case with another table is one of another study.
    let other = read(&folder.join("contact.csv")).replace("845", "945");
    fs::write(folder.join("contact.csv"), other).unwrap();
    for study in ["study", "folders"] {
        let line = ["sweep", &format!("{study}.toml"), "--steps", "1", "--quiet", "--out", study, "--resume"];
        let said = words(&stderr(&ends(&folder, &line, 2)));
        assert!(said.contains("contact-table differs"), "{said}");
    }
}
