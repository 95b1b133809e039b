//! Studies of minutes in three processes that share a folder and are killed at random: in the end
//! there is one table, with the same bits as that of a study that nobody disturbed.

use super::common::{self, command, done};
use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

/// Drawn runs, packed.
const STUDY: &str = "\
title = \"Long\"
[study]
samples = 12
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = { uniform = [0.1, 0.3] }
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = { normal = [30.0, 3.0] }
friction = 0.2
[passage]
positions = 61
[mesh]
interface_elements = 24
[growth]
steps = 5
[solver]
engine = \"dislocation\"
[output]
run_folders = false
";

const PARTS: usize = 3;

/// How long, and how often something is killed.
struct Plan {
    /// The study, undisturbed, s.
    study_s: f64,
    /// Mean time between two kills, s.
    kill_s: f64,
    steps: usize,
    folders: bool,
}

/// Numbers from 0 to 1 (Marsaglia's xorshift). They only choose when to kill, and whom.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn part(folder: &Path, index: usize) -> Child {
    let shard = format!("{}/{PARTS}", index + 1);
    let line = [
        "sweep",
        "study.toml",
        "--out",
        "killed",
        "--shard",
        &shard,
        "--resume",
        "--threads",
        "1",
        "--quiet",
    ];
    let log = fs::OpenOptions::new().create(true).append(true).open(folder.join("said.txt")).unwrap();
    command(folder, &line).stdout(Stdio::null()).stderr(log).spawn().unwrap()
}

/// Computes the study in parts that are killed until they end by themselves; the number of kills.
fn killed(folder: &Path, plan: &Plan) -> usize {
    let mut random = Random(0x9e37_79b9_7f4a_7c15 ^ u64::from(std::process::id()));
    let mut parts: Vec<Option<Child>> = (0..PARTS).map(|index| Some(part(folder, index))).collect();
    let mut kills = 0;
    while parts.iter().any(Option::is_some) {
        let until = Instant::now() + Duration::from_secs_f64(2.0 * plan.kill_s * random.next());
        while Instant::now() < until && parts.iter().any(Option::is_some) {
            for (index, of_part) in parts.iter_mut().enumerate() {
                let Some(child) = of_part else { continue };
                if let Some(status) = child.try_wait().unwrap() {
                    let said = common::read(&folder.join("said.txt"));
                    assert_eq!(status.code(), Some(0), "part {}: {said}", index + 1);
                    *of_part = None;
                }
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        let at_work: Vec<usize> = (0..PARTS).filter(|&index| parts[index].is_some()).collect();
        if at_work.is_empty() {
            break;
        }
        let index = at_work[(random.next() * at_work.len() as f64) as usize];
        let child = parts[index].as_mut().unwrap();
        child.kill().unwrap();
        // It may have ended just before.
        let ended = child.wait().unwrap().code() == Some(0);
        kills += usize::from(!ended);
        parts[index] = if ended { None } else { Some(part(folder, index)) };
    }
    kills
}

fn long_run(name: &str, plan: &Plan) {
    let folder = common::folder("long-runs", name);
    let mut study = STUDY.replace("steps = 5", &format!("steps = {}", plan.steps));
    if plan.folders {
        study = study.replace("run_folders = false", "");
    }
    let write = |samples: usize| {
        let text = study.replace("samples = 12", &format!("samples = {samples}"));
        fs::write(folder.join("study.toml"), text).unwrap();
    };
    // As many runs as the time allows, by the time of a few; a study has 10 000 at most.
    write(12);
    let started = Instant::now();
    done(&folder, &["sweep", "study.toml", "--out", "few", "--quiet"]);
    let samples = (12.0 * plan.study_s / started.elapsed().as_secs_f64()) as usize;
    let samples = samples.clamp(30, 10_000);
    write(samples);
    let started = Instant::now();
    done(&folder, &["sweep", "study.toml", "--out", "whole", "--quiet"]);
    let whole_s = started.elapsed().as_secs_f64();

    let started = Instant::now();
    let kills = killed(&folder, plan);
    let killed_s = started.elapsed().as_secs_f64();
    // Nothing was damaged, so nothing is said.
    assert_eq!(common::read(&folder.join("said.txt")), "");
    let told = done(&folder, &["verify", "killed"]);
    assert!(told.ends_with("files are intact\n") && !told.contains("note"), "{told}");
    let tables = ["summary.csv", "runs.parquet", "growth.parquet", "sif.parquet", "report.html"];
    for file in tables.into_iter().chain(["plots/ki.svg", "plots/length-cycles.svg"]) {
        let bytes = |study: &str| fs::read(folder.join(study).join(file)).unwrap();
        assert!(bytes("whole") == bytes("killed"), "{file} differs");
    }
    let states = common::column(&folder.join("killed/summary.csv"), "state");
    assert_eq!(states, vec!["done"; samples]);
    println!(
        "{name}: {samples} runs of {} steps, undisturbed {whole_s:.0} s; in {PARTS} processes with {kills} kills \
         {killed_s:.0} s, the same tables",
        plan.steps
    );
    assert!(kills > 0, "nothing was killed in {killed_s:.1} s");
}

#[test]
fn three_killed_processes_make_the_table_of_an_undisturbed_study() {
    for (name, folders) in [("packed", false), ("folders", true)] {
        long_run(name, &Plan { study_s: 2.0, kill_s: 0.25, steps: 5, folders });
    }
}

#[test]
#[ignore = "extra: minutes (RAILCRACK_LONG_MINUTES, else 30) of three processes that are killed every 20 s"]
fn three_killed_processes_make_the_table_of_an_undisturbed_study_in_full() {
    let minutes =
        std::env::var("RAILCRACK_LONG_MINUTES").ok().and_then(|text| text.parse().ok()).unwrap_or(30.0);
    // Half of the time for the study that nobody disturbs; dozens of kills in a shorter one, too.
    let study_s = 30.0 * minutes;
    long_run("long", &Plan { study_s, kill_s: f64::min(20.0, study_s / 30.0), steps: 60, folders: false });
}
