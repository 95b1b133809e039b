//! Studies without run folders: killed, resumed, in parts.

use super::common::{self, command, done, ends, names, read, stderr};
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
    assert_eq!(done(&folder, &["check", "study.toml", "--json"]).matches("\"run\":").count(), 60);
    assert!(started.elapsed() < Duration::from_secs(20));
}
