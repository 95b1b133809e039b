//! Options that all commands share: values of the command line, standard input, JSON, tables,
//! templates, completions.

use super::common::{self, QUICK_CASE, command, done, ends, names, railcrack, read, stderr, stdout};
use serde_json::Value;
use std::fs;
use std::io::Write;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Time for a refusal, on a machine that is busy.
const PATIENCE: Duration = Duration::from_secs(20);

fn workplace(name: &str) -> std::path::PathBuf {
    let folder = common::folder("options", name);
    fs::write(folder.join("case.toml"), QUICK_CASE).unwrap();
    folder
}

#[test]
fn a_setting_is_the_value_of_the_file() {
    let folder = workplace("settings");
    let told =
        done(&folder, &["check", "case.toml", "--set", "contact.friction=0.1", "--set", "growth.steps=7"]);
    assert!(told.contains("friction             0.1") && told.contains("increments           7,"), "{told}");
    // A word without quotes, a crack by its number, a section that the file does not have.
    let line =
        ["check", "case.toml", "--set", "solver.engine=dislocation", "--set", "crack[1].angle_deg=35.0"];
    let told = done(&folder, &[&line[..], &["--set", "traffic.axle_load_t=17.0"]].concat());
    for says in ["dislocation", " 35 ", "axle load            17 t"] {
        assert!(told.contains(says), "{says}: {told}");
    }
    // The run remembers it.
    done(
        &folder,
        &[
            "run",
            "case.toml",
            "--set",
            "growth.steps=0",
            "--set",
            "solver.engine=dislocation",
            "--out",
            "r",
            "--quiet",
        ],
    );
    let stored = read(&folder.join("r/case.toml"));
    assert!(stored.contains("steps = 0") && stored.contains("engine = \"dislocation\""), "{stored}");
    for (wrong, says) in [
        ("contact.friction", "must be section.key=value"),
        ("contact.frction=0.1", "nearest known key: `friction`"),
        ("contct.friction=0.1", "nearest known section: `contact`"),
        ("contact.friction=9.0", "`--set contact.friction=9.0`: must be a number in"),
        ("crack[9].friction=0.1", "`--set crack[9].friction=0.1`: the file has no such `[[crack]]`"),
        ("wheel[1].contact.friction=0.1", "the file has no such `[[wheel]]`"),
        ("contact.friction=\"x\"", "not a string"),
        ("contact[2].friction=0.1", "there is one `[contact]`"),
        ("crack[0].friction=0.1", "counts cracks from 1"),
        ("contact.friction=[", "not valid TOML"),
        ("solver.engine=fem", "nearest: \"xfem\""),
    ] {
        let output = ends(&folder, &["check", "case.toml", "--set", wrong], 2);
        assert!(stderr(&output).contains(says), "{wrong}: {}", stderr(&output));
    }
}

#[test]
fn a_case_comes_by_standard_input() {
    let folder = workplace("standard-input");
    let mut child = command(&folder, &["check", "-", "--set", "growth.steps=3"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(QUICK_CASE.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(stdout(&output).contains("increments           3,"));
}

#[test]
fn results_and_failures_are_one_object() {
    let folder = workplace("json");
    let object = |arguments: &[&str], code: i32| -> Value {
        serde_json::from_str(&stdout(&ends(&folder, arguments, code))).unwrap()
    };
    let quick = ["--set", "growth.steps=1", "--set", "solver.engine=dislocation"];
    let checked = object(&["check", "case.toml", "--json"], 0);
    assert_eq!((checked["kind"].as_str(), checked["tips"].as_u64()), (Some("case"), Some(1)));
    let run = |out: &str, more: &[&str]| {
        let line = [&["run", "case.toml", "--json", "--quiet", "--out", out], &quick[..], more].concat();
        object(&line, 0)
    };
    let first = run("one", &[]);
    assert_eq!((first["ending"].as_str(), first["summary"]["steps"].as_u64()), (Some("ended"), Some(1)));
    run("other", &["--set", "contact.friction=0.1"]);
    let compared = object(&["compare", "one", "other", "--tolerance", "0.1", "--json"], 1);
    assert_eq!(compared["comparison"]["within_tolerance"].as_bool(), Some(false));
    fs::write(folder.join("study.toml"), QUICK_CASE.replace("friction = 0.3", "friction = [0.1, 0.3]"))
        .unwrap();
    let swept = object(&[&["sweep", "study.toml", "--json", "--quiet"], &quick[..]].concat(), 0);
    assert_eq!((swept["runs"].as_u64(), swept["done"].as_u64()), (Some(2), Some(2)));
    assert_eq!(object(&["check", "study.toml", "--json"], 0)["runs"].as_array().unwrap().len(), 2);

    fs::write(folder.join("wrong.toml"), QUICK_CASE.replace("friction = 0.2", "fiction = 0.2")).unwrap();
    let wrong = object(&["run", "wrong.toml", "--json"], 2);
    let error = &wrong["errors"][1];
    assert_eq!((wrong["exit"].as_u64(), error["line"].as_u64()), (Some(2), Some(11)));
    assert!(error["message"].as_str().unwrap().contains("unknown key"));
}

#[test]
fn the_line_of_an_error_is_shown_with_its_place() {
    let folder = workplace("caret");
    fs::write(folder.join("wrong.toml"), QUICK_CASE.replace("angle_deg = 40.0", "angle_deg = 400.0"))
        .unwrap();
    let told = stderr(&ends(&folder, &["check", "wrong.toml"], 2));
    assert!(told.contains("\n  10 | angle_deg = 400.0\n     |             ^^^^^\n"), "{told}");
}

#[test]
fn a_table_is_shown_by_its_columns() {
    let folder = workplace("show");
    let quick = [
        "--set",
        "growth.steps=1",
        "--set",
        "growth.increment=0.04",
        "--set",
        "solver.engine=dislocation",
        "--quiet",
    ];
    done(&folder, &[&["run", "case.toml", "--out", "run"], &quick[..]].concat());
    let told = done(&folder, &["show", "run", "--columns", "step,length_mm,stop"]);
    assert_eq!(told, "step  length_mm  stop\n   0          6\n   1       6.24  steps-done\n");
    let exact = done(&folder, &["show", "run", "--columns", "step,length_mm", "--exact", "--last", "1"]);
    let lines: Vec<&str> = exact.lines().collect();
    let length = lines[1].strip_prefix("1,").and_then(|length| length.parse().ok()).unwrap_or(f64::NAN);
    assert!(lines.len() == 2 && lines[0] == "step,length_mm" && (length - 6.24f64).abs() < 1e-12, "{exact}");
    assert!(done(&folder, &["show", "run", "--table", "sif", "--last", "2"]).lines().count() == 3);
    for (arguments, says) in [
        (&["show", "run", "--table", "growt"][..], "the tables are faces, growth, sif"),
        (&["show", "run", "--columns", "lenght_mm"], "no column `lenght_mm`: the columns are step, crack"),
        (&["show", "run", "--table", "../case"], "has no table"),
        (&["show", "nothing"], "there is no such folder"),
    ] {
        let output = railcrack(&folder, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(says), "{arguments:?}: {}", stderr(&output));
    }
}

#[test]
fn every_template_is_a_case_that_is_accepted() {
    let folder = common::folder("options", "templates");
    for name in ["head-check", "squat", "curve", "network", "residual-stress", "study"] {
        done(&folder, &["init", "--template", name]);
        let file = format!("{name}.toml");
        let told = done(&folder, &["check", &file]);
        assert!(told.lines().count() > 10, "{told}");
        assert_eq!(railcrack(&folder, &["init", "--template", name]).status.code(), Some(4), "not replaced");
    }
    assert!(folder.join("residual-stress.csv").is_file());
    done(&folder, &["run", "head-check.toml", "--steps", "0", "--quiet"]);
}

#[test]
fn shells_and_man_are_told_every_command() {
    let folder = common::folder("options", "shells");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = done(&folder, &["completions", shell]);
        assert!(script.contains("sweep") && script.contains("--shard"), "{shell}");
    }
    assert!(done(&folder, &["man"]).contains("railcrack"));
    done(&folder, &["man", "--out", "pages"]);
    let pages = names(&folder.join("pages"));
    assert!(pages.contains(&"railcrack-sweep.1".to_owned()) && pages.len() >= 14, "{pages:?}");
}

#[test]
fn a_run_writes_what_its_case_asks_for() {
    let folder = workplace("output");
    let quick = ["--set", "growth.steps=2", "--set", "solver.engine=dislocation", "--quiet"];
    let run = |out: &str, more: &[&str]| {
        done(&folder, &[&["run", "case.toml", "--out", out], &quick[..], more].concat());
    };
    run("whole", &[]);
    run(
        "least",
        &[
            "--set",
            "output.faces=false",
            "--set",
            "output.sif=false",
            "--set",
            "output.plots=false",
            "--set",
            "output.report=false",
        ],
    );
    let written = ["SHA256SUMS", "case.toml", "checkpoint.bin", "growth.csv", "run-log.bin", "summary.json"];
    assert_eq!(names(&folder.join("least")), written);
    assert_eq!(read(&folder.join("least/growth.csv")), read(&folder.join("whole/growth.csv")));
    run(
        "ends",
        &["--set", "output.faces=ends", "--set", "output.sif=\"ends\"", "--set", "output.plots=false"],
    );
    assert!(folder.join("ends/report.html").is_file() && !folder.join("ends/plots").exists());
    let steps = |run: &str, table: &str| {
        let mut steps = common::column(&folder.join(run).join(table), "step");
        steps.dedup();
        steps
    };
    for table in ["faces.csv", "sif.csv"] {
        assert_eq!(
            (steps("ends", table), steps("whole", table)),
            (vec!["0".into(), "2".into()], vec!["0".into(), "1".into(), "2".into()])
        );
    }

    // Its plots are made again of its case: the same.
    done(&folder, &["report", "least"]);
    for plot in names(&folder.join("whole/plots")) {
        let plot = format!("plots/{plot}");
        assert!(read(&folder.join("least").join(&plot)) == read(&folder.join("whole").join(&plot)), "{plot}");
    }
    assert!(folder.join("least/report.html").is_file());
    assert!(!folder.join("least/again.partial").exists());
    // Runs without K cannot be compared, those with the ends at the ends.
    let refused = ends(&folder, &["compare", "least", "whole"], 2);
    assert!(stderr(&refused).contains("sif = \"none\""), "{}", stderr(&refused));
    done(&folder, &["compare", "ends", "whole", "--tolerance", "0"]);
    assert_eq!(done(&folder, &["verify", "least"]).lines().count(), 1);
}

/// A pipe without a writer and a device without end are refused at once, wherever a file is read.
#[cfg(unix)]
#[test]
fn only_regular_files_are_read() {
    let folder = common::folder("options", "regular-files");
    let made = std::process::Command::new("mkfifo").arg(folder.join("pipe")).status().unwrap();
    assert!(made.success());
    let with = |name: &str, appended: &str| {
        std::fs::write(folder.join(name), format!("{QUICK_CASE}{appended}")).unwrap();
    };
    with("traffic.toml", "[traffic]\naxle_load_t = 20.0\n");
    with("study.toml", "[study]\n");
    with("profile.toml", "[residual_stress]\nprofile = \"pipe\"\n");
    with("field.toml", "[plastic_stress]\nfield = \"pipe\"\n");
    std::fs::create_dir(folder.join("run")).unwrap();
    std::os::unix::fs::symlink(folder.join("pipe"), folder.join("run/summary.json")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", folder.join("run/case.toml")).unwrap();
    for (arguments, code) in [
        (&["check", "pipe"][..], 2),
        (&["check", "/dev/zero"], 2),
        (&["run", "pipe"], 2),
        (&["sweep", "pipe"], 2),
        (&["check", "profile.toml"], 2),
        (&["check", "field.toml"], 2),
        (&["sweep", "study.toml", "--samples", "pipe"], 2),
        (&["calibrate", "traffic.toml", "--measured", "pipe"], 2),
        (&["calibrate", "traffic.toml", "--measured", "/dev/zero"], 2),
        (&["report", "run"], 2),
        (&["verify", "run"], 2),
        (&["show", "run"], 2),
    ] {
        let mut child =
            common::command(&folder, arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let begun = Instant::now();
        let ended = loop {
            match child.try_wait().unwrap() {
                None if begun.elapsed() < PATIENCE => std::thread::sleep(Duration::from_millis(20)),
                ended => break ended,
            }
        };
        if ended.is_none() {
            child.kill().unwrap();
        }
        let output = child.wait_with_output().unwrap();
        let said = common::stderr(&output);
        assert_eq!(ended.and_then(|status| status.code()), Some(code), "{arguments:?}: {said}");
    }
}

/// A larger file is refused, not cut.
#[test]
fn a_case_on_standard_input_has_the_limit_of_a_file() {
    let folder = common::folder("options", "long-input");
    let mut child = common::command(&folder, &["check", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    // A valid case in its first 4 MB. The program may have ended before it has read all.
    let _ = input.write_all(format!("{QUICK_CASE}\n{}", "# rest\n".repeat(1 << 20)).as_bytes());
    drop(input);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", common::stderr(&output));
}

/// Every help text is prose for users: no source, no numbers that nobody reads.
#[test]
fn every_help_text_is_readable() {
    let folder = workplace("help");
    let all = done(&folder, &["--help"]);
    let commands: Vec<&str> = all
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .map_while(|line| line.strip_prefix("  "))
        .filter(|line| !line.starts_with(' '))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(commands.len() > 15, "{commands:?}");
    for name in commands {
        for (line, text) in done(&folder, &["help", name]).lines().map(|line| (line, line.to_lowercase())) {
            let is_source =
                ["#[", "::", "value_name", "///", "unwrap"].iter().any(|part| text.contains(part));
            let is_unread = text.contains("0000000") || text.contains("= inf") || text.contains("nan");
            assert!(!is_source && !is_unread, "{name}: {line}");
        }
    }
}

#[test]
fn numbers_in_messages_are_short() {
    let folder = workplace("short");
    let table = "wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm\n";
    fs::write(folder.join("wheels.csv"), format!("{table}7,1e-300,1,0.001,0,0,0.3,6,4\n")).unwrap();
    let crack = QUICK_CASE.split("[[crack]]").nth(1).unwrap();
    let text = format!("[[wheel]]\ntable = \"wheels.csv\"\ncreepage_sign = \"contact\"\n[[crack]]{crack}");
    fs::write(folder.join("wheels.toml"), text).unwrap();
    let said = stderr(&ends(&folder, &["check", "wheels.toml"], 2));
    assert!(said.contains("`normal_kn = 1e-300`"), "{said}");
}

/// A noncharacter that no plot can hold.
#[test]
fn titles_are_text() {
    let folder = workplace("title");
    for c in ["\\uFFFE", "\\uFFFF", "\\u0007"] {
        fs::write(folder.join("bad.toml"), format!("title = \"a{c}\"\n{QUICK_CASE}")).unwrap();
        let said = stderr(&ends(&folder, &["check", "bad.toml"], 2));
        assert!(said.contains("`title") && said.contains("must be one line of text"), "{said}");
    }
}

#[test]
fn numbers_of_threads_in_the_environment_have_a_bound() {
    let folder = workplace("threads");
    for (threads, code) in [("999999", 2), ("many", 2), ("0", 0), ("2", 0)] {
        let mut program = command(&folder, &["check", "case.toml"]);
        let output = program.env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{threads}: {}", stderr(&output));
        let says = format!("RAYON_NUM_THREADS = \"{threads}\": must be an integer from 1 to 1024");
        assert!(code == 0 || stderr(&output).contains(&says), "{}", stderr(&output));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn too_little_address_space_is_an_error() {
    let folder = workplace("addresses");
    let line = "ulimit -v 700000; exec \"$0\" run case.toml --engine dislocation --quiet";
    let mut shell = std::process::Command::new("sh");
    let output =
        shell.args(["-c", line, env!("CARGO_BIN_EXE_railcrack")]).current_dir(&folder).output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(stderr(&output).contains("the address space is limited to 0.7 GB"), "{}", stderr(&output));
    assert!(!folder.join("case").exists());
}

/// The output of `check` for a flat crack in space takes a moment, and samples count as memory.
#[test]
fn a_check_takes_a_moment_and_counts_samples() {
    let folder = workplace("moment");
    let flat = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nlateral_half_width_mm = 6.0\nfriction = 0.3\n\
        [[crack]]\nmouth_mm = 0.0\nlength_mm = 10.0\nangle_deg = 5.0\nfriction = 0.2\nsurface_half_length_mm = 10.0\n\
        [solver]\nengine = \"space\"\n";
    fs::write(folder.join("flat.toml"), flat).unwrap();
    let started = Instant::now();
    done(&folder, &["check", "flat.toml"]);
    assert!(started.elapsed() < Duration::from_secs(5), "{:?}", started.elapsed());
    let sampled = format!(
        "{QUICK_CASE}[traffic]\naxle_load_t = 20.0\n[inspection]\ndetectable_depth_mm = 2.0\ncritical_depth_mm = 5.0\n\
         [scatter]\nsamples = 10000000\nparis_c_log_std = 0.3\n"
    );
    fs::write(folder.join("sampled.toml"), sampled).unwrap();
    let value: Value = serde_json::from_str(&done(&folder, &["check", "sampled.toml", "--json"])).unwrap();
    let memory = value["memory_bytes"].as_f64().unwrap();
    assert!((2.5e9..5e9).contains(&memory), "{memory}");
}

/// Escape codes in a table do not reach the terminal, by whatever command reads it.
#[test]
fn no_table_commands_the_terminal() {
    let folder = workplace("escape");
    for out in ["a", "b"] {
        done(
            &folder,
            &["run", "case.toml", "--engine", "dislocation", "--steps", "0", "--out", out, "--quiet"],
        );
    }
    let table = folder.join("a/growth.csv");
    let text = read(&table);
    let code = "\u{1b}]0;owned\u{7}\u{9b}2J";
    let with_code = |line: &str| line.rsplit_once(',').map(|(rest, _)| format!("{rest},{code}\n")).unwrap();
    let (head, last) = text.trim_end().rsplit_once('\n').unwrap();
    fs::write(&table, format!("{head}\n{}", with_code(last))).unwrap();
    for line in [
        &["show", "a"][..],
        &["show", "a", "growth", "--exact"],
        &["report", "a"],
        &["compare", "a", "b", "--json"],
        &["compare", "a", "b"],
        &["verify", "a"],
    ] {
        let output = railcrack(&folder, line);
        let said = format!("{}{}", stdout(&output), stderr(&output));
        assert!(!said.contains(['\u{1b}', '\u{7}', '\u{9b}']), "{line:?}: {said:?}");
    }
}
