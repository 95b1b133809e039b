//! `railcrack sweep` as a user meets it.

use super::common;
use super::common::{DISLOCATION_CASE, command};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// A quick study of six runs.
static STUDY: LazyLock<String> = LazyLock::new(|| {
    let varied = DISLOCATION_CASE.replace("friction = 0.3", "friction = [0.1, 0.3]");
    "title = \"Friction and angle\"".to_owned() + &varied.replace("40.0", "[20.0, 30.0, 40.0]")
});

fn workplace(name: &str, study: &str) -> PathBuf {
    let folder = common::folder("sweep-command", name);
    fs::write(folder.join("study.toml"), study).unwrap();
    folder
}

/// Exit code, standard output, standard error.
fn railcrack(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = common::railcrack(folder, arguments);
    (output.status.code(), common::stdout(&output), common::stderr(&output))
}

fn sweep(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    railcrack(folder, &[&["sweep", "study.toml", "--quiet"], arguments].concat())
}

/// Every file below `folder` that must be the same whoever computed it: all but wall times, and the
/// checkpoint and summary that hold some.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut pending = vec![folder.to_path_buf()];
    while let Some(current) = pending.pop() {
        for entry in fs::read_dir(&current).unwrap() {
            let path = entry.unwrap().path();
            let name = path.strip_prefix(folder).unwrap().to_string_lossy().into_owned();
            if path.is_dir() {
                pending.push(path);
            } else if !["times.csv", "checkpoint.bin", "run-log.bin", "summary.json"]
                .iter()
                .any(|file| name.ends_with(file))
            {
                found.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    found
}

fn same_files(one: &Path, other: &Path) {
    let (one, other) = (files(one), files(other));
    assert!(one.len() > 20, "{:?}", one.keys());
    assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
    for (name, content) in &one {
        assert!(content == &other[name], "{name} differs");
    }
}

/// Whether the run in `folder` is done.
fn is_over(folder: &Path) -> bool {
    fs::read_to_string(folder.join("summary.json")).is_ok_and(|text| text.contains("\"outcome\""))
}

/// A column of `summary.csv`.
fn column(folder: &Path, name: &str) -> Vec<String> {
    common::column(&folder.join("summary.csv"), name)
}

#[test]
fn every_run_is_the_run_of_its_case() {
    let folder = workplace("whole", &STUDY);
    let (code, out, err) = sweep(&folder, &["--steps", "1"]);
    assert_eq!((code, out.as_str()), (Some(0), "6 runs: 6 done\nresults in study\n"), "{err}");
    let out = folder.join("study");
    assert_eq!(column(&out, "run"), ["1", "2", "3", "4", "5", "6"]);
    assert_eq!(column(&out, "contact.friction"), ["0.1", "0.1", "0.1", "0.3", "0.3", "0.3"]);
    assert_eq!(column(&out, "crack[1].angle_deg"), ["20", "30", "40", "20", "30", "40"]);
    assert_eq!(column(&out, "state"), ["done"; 6]);
    assert_eq!(column(&out, "steps"), ["1"; 6]);

    // The case of a run folder, computed by itself.
    let runs = column(&out, "folder");
    assert_eq!(runs[4], "005");
    let of_study = out.join("runs").join(&runs[4]);
    let case = of_study.join("case.toml").display().to_string();
    assert_eq!(railcrack(&folder, &["run", &case, "--out", "alone", "--quiet"]).0, Some(0));
    let files = files(&of_study);
    assert!(files.keys().eq(["SHA256SUMS", "case.toml", "growth.csv", "sif.csv"]), "{:?}", files.keys());
    assert!(fs::read_dir(&of_study).unwrap().count() <= 5);
    // The run alone has more tables, and so more checksums.
    for (name, content) in files.iter().filter(|(name, _)| *name != "SHA256SUMS") {
        assert!(*content == fs::read(folder.join("alone").join(name)).unwrap(), "{name} differs");
    }

    // What the table says is what the folder of the run says.
    let growth = fs::read_to_string(of_study.join("growth.csv")).unwrap();
    let mut lines = growth.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let value = |step: usize, name: &str| rows[step][names.iter().position(|n| *n == name).unwrap()];
    for (ours, step, theirs) in [
        ("initial_length_mm", 0, "length_mm"),
        ("length_mm", 1, "length_mm"),
        ("tip_x_mm", 1, "tip_x_mm"),
        ("tip_y_mm", 1, "tip_y_mm"),
        ("delta_kii_mpa_sqrt_m", 0, "delta_kii_mpa_sqrt_m"),
        ("delta_keq_mpa_sqrt_m", 0, "delta_keq_mpa_sqrt_m"),
        ("kink_angle_deg", 0, "kink_angle_deg"),
        ("rate_mm_per_cycle", 0, "rate_mm_per_cycle"),
        ("load_cycles", 1, "load_cycles"),
    ] {
        assert_eq!(column(&out, ours)[4], value(step, theirs), "{ours}");
    }
    let kii = fs::read_to_string(out.join("plots/kii.svg")).unwrap();
    assert_eq!(kii.matches("class=\"series\"").count(), 6);
    for words in ["friction", "0.1", "0.3", "angle_deg", "6 runs"] {
        assert!(kii.contains(words), "{words}");
    }
    let (code, told, _) = railcrack(&folder, &["compare", &case.replace("/case.toml", ""), "alone"]);
    assert_eq!(code, Some(0));
    assert!(told.contains("cases   equal"), "{told}");
}

#[test]
fn threads_parts_and_order_do_not_show() {
    let folder = workplace("order", &STUDY);
    assert_eq!(sweep(&folder, &["--out", "one", "--threads", "1"]).0, Some(0));
    // Two threads and a half for each of two runs at a time would be odd: five threads for six
    // runs.
    for (out, threads) in [("two", "2"), ("five", "5")] {
        assert_eq!(sweep(&folder, &["--out", out, "--threads", threads]).0, Some(0));
        same_files(&folder.join("one"), &folder.join(out));
    }
    // Parts into one folder, the last one first, two of them at the same time.
    let (code, out, err) = sweep(&folder, &["--out", "parts", "--shard", "3/3"]);
    assert_eq!((code, out.as_str()), (Some(0), "6 runs: 2 done, 4 missing\nresults in parts\n"), "{err}");
    let parts = ["1/3", "2/3"].map(|shard| {
        let line = ["sweep", "study.toml", "--quiet", "--out", "parts", "--shard", shard];
        command(&folder, &line).stdout(Stdio::null()).spawn().unwrap()
    });
    for mut part in parts {
        assert_eq!(part.wait().unwrap().code(), Some(0));
    }
    same_files(&folder.join("one"), &folder.join("parts"));
    // A part is not computed twice, unless it is to be replaced.
    let (code, _, err) = sweep(&folder, &["--out", "parts", "--shard", "2/3"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("already holds a study (runs/002/case.toml)"), "{err}");
    assert_eq!(sweep(&folder, &["--out", "parts", "--shard", "2/3", "--force"]).0, Some(0));
    same_files(&folder.join("one"), &folder.join("parts"));
}

#[test]
fn parts_in_folders_of_their_own_merge() {
    let folder = workplace("merge", &STUDY);
    for (out, shard) in [("here", "1/2"), ("there", "2/2")] {
        assert_eq!(sweep(&folder, &["--out", out, "--shard", shard]).0, Some(0));
    }
    for entry in fs::read_dir(folder.join("there/runs")).unwrap() {
        let run = entry.unwrap();
        fs::rename(run.path(), folder.join("here/runs").join(run.file_name())).unwrap();
    }
    let before = fs::metadata(folder.join("here/runs/002/sif.csv")).unwrap();
    let (code, out, _) = sweep(&folder, &["--out", "here", "--resume"]);
    assert_eq!((code, out.as_str()), (Some(0), "6 runs: 6 done\nresults in here\n"));
    let after = fs::metadata(folder.join("here/runs/002/sif.csv")).unwrap();
    assert_eq!(before.modified().unwrap(), after.modified().unwrap(), "computed again");
    assert_eq!(sweep(&folder, &["--out", "whole"]).0, Some(0));
    same_files(&folder.join("whole"), &folder.join("here"));
}

#[test]
fn a_killed_study_resumes_to_the_files_of_one_that_was_not() {
    let folder = workplace("killed", &STUDY);
    assert_eq!(sweep(&folder, &["--out", "whole", "--steps", "6"]).0, Some(0));
    let line = ["sweep", "study.toml", "--quiet", "--steps", "6", "--out"];
    for (out, finished) in [("killed-1", 1), ("killed-3", 3)] {
        let mut child =
            command(&folder, &[&line[..], &[out]].concat()).stdout(Stdio::null()).spawn().unwrap();
        let over = || {
            let runs = fs::read_dir(folder.join(out).join("runs")).into_iter().flatten();
            runs.filter(|run| is_over(&run.as_ref().unwrap().path())).count()
        };
        let started = Instant::now();
        while over() < finished && started.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        assert!((finished..6).contains(&over()), "killed too late");
        let (code, _, err) = railcrack(&folder, &[&line[..], &[out, "--resume"]].concat());
        assert_eq!(code, Some(0), "{err}");
        same_files(&folder.join("whole"), &folder.join(out));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_study_says_so_and_goes_on() {
    let folder = workplace("interrupted", &STUDY);
    let line = ["sweep", "study.toml", "--steps", "12", "--threads", "1", "--out", "cut"];
    let child = command(&folder, &line).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
    let first = folder.join("cut/runs/001");
    let started = Instant::now();
    while !is_over(&first) && started.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let output = child.wait_with_output().unwrap();
    let told = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(130), "{told}");
    assert!(told.contains("repeat the command with --resume"), "{told}");
    // Table and plots have what was computed.
    assert_eq!(column(&folder.join("cut"), "state")[0], "done");
    assert!(column(&folder.join("cut"), "state").contains(&"missing".to_owned()));
    assert!(folder.join("cut/plots/paths.svg").exists());
    assert_eq!(sweep(&folder, &["--steps", "12", "--out", "cut", "--resume"]).0, Some(0));
    assert_eq!(sweep(&folder, &["--steps", "12", "--out", "whole"]).0, Some(0));
    same_files(&folder.join("whole"), &folder.join("cut"));
}

#[test]
fn a_failed_run_is_reported_and_the_others_go_on() {
    // At 90° the elements cannot follow face points as close as a third of them.
    let study = STUDY
        .replace("[20.0, 30.0, 40.0]", "90.0")
        .replace("interface_elements = 16", "element_size_mm = 0.3\ninterface_spacing_mm = [0.3, 0.1]")
        .replace("dislocation", "xfem");
    let folder = workplace("failing", &study);
    let (code, out, _) = sweep(&folder, &["--steps", "0"]);
    assert_eq!(code, Some(3), "{out}");
    assert!(
        out.starts_with(
            "4 runs: 2 done, 2 failed\nrun 2 (friction = 0.1, interface_spacing_mm = 0.1) failed: step 0: "
        ),
        "{out}"
    );
    let told = folder.join("study");
    assert_eq!(column(&told, "state"), ["done", "not-converged", "done", "not-converged"]);
    assert!(column(&told, "reason")[1].contains("not positive definite"), "{:?}", column(&told, "reason"));
    assert_eq!(fs::read_to_string(told.join("plots/ki.svg")).unwrap().matches("class=\"series\"").count(), 2);
    // It would fail again: it is not tried, but told again.
    let before = files(&told);
    let (code, again, _) = sweep(&folder, &["--steps", "0", "--resume"]);
    assert_eq!((code, again), (Some(3), out));
    assert_eq!(files(&told), before);
}

#[test]
fn a_run_that_cannot_be_written_is_tried_again() {
    let folder = workplace("unwritable", &STUDY);
    let in_the_way = folder.join("study/runs/002/sif.csv");
    fs::create_dir_all(&in_the_way).unwrap();
    let (code, out, err) = sweep(&folder, &["--steps", "0", "--force"]);
    assert_eq!(code, Some(4), "{out}{err}");
    let (code, _, err) = sweep(&folder, &["--steps", "0", "--resume"]);
    assert_eq!(code, Some(4), "{err}");
    fs::remove_dir(&in_the_way).unwrap();
    let (code, out, err) = sweep(&folder, &["--steps", "0", "--resume"]);
    assert_eq!(code, Some(0), "{out}{err}");
    assert_eq!(column(&folder.join("study"), "state"), ["done"; 6]);
}

/// Runs of finite elements with one rail for two of them each.
const SHARING: &str = r#"
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = [0.1, 0.3]

[[crack]]
mouth_mm = 0.0
length_mm = [5.0, 6.0]
angle_deg = 40.0
friction = 0.2

[passage]
positions = 31

[mesh]
element_size_mm = 0.25

[growth]
steps = 2

[output]
faces = "all"
fields = true
"#;

/// Plastic stress by depth.
const PLASTIC: &str = "depth_mm,sxx_mpa,szz_mpa\n0,0,0\n2,120,-60\n4,0,0\n";

#[test]
fn runs_that_share_a_rail_are_those_that_do_not() {
    let block = SHARING.to_owned() + "[rail]\nboundary = \"block\"\n";
    let plastic = SHARING.to_owned() + "[plastic_stress]\nprofile = \"plastic.csv\"\n";
    for (name, study) in [("sharing", SHARING), ("sharing-block", &block), ("sharing-plastic", &plastic)] {
        let folder = workplace(name, study);
        fs::write(folder.join("plastic.csv"), PLASTIC).unwrap();
        let (_, told, _) = railcrack(&folder, &["check", "study.toml"]);
        assert!(told.contains("2 meshes and factorisations for 4 runs"), "{told}");
        assert_eq!(sweep(&folder, &[]).0, Some(0));
        for run in column(&folder.join("study"), "folder") {
            let of_study = folder.join("study/runs").join(&run);
            let case = of_study.join("case.toml").display().to_string();
            assert_eq!(railcrack(&folder, &["run", &case, "--out", &run, "--quiet"]).0, Some(0));
            for file in
                ["case.toml", "sif.csv", "growth.csv", "faces.csv", "fields/step-0000-position-0016.vtu"]
            {
                let read =
                    |folder: &Path| fs::read(folder.join(file)).unwrap_or_else(|e| panic!("{file}: {e}"));
                assert!(read(&of_study) == read(&folder.join(&run)), "{run}/{file} differs");
            }
        }
    }
}

#[test]
fn refusals_write_nothing() {
    let folder = workplace("refused", &STUDY);
    let single = STUDY.replace("[0.1, 0.3]", "0.1").replace("[20.0, 30.0, 40.0]", "20.0");
    fs::write(folder.join("case.toml"), single).unwrap();
    fs::write(folder.join("deep.toml"), STUDY.replace("length_mm = 6.0", "length_mm = [6.0, 400.0]"))
        .unwrap();
    let refusals: [(&[&str], &str); 10] = [
        (&["sweep", "study.toml", "--threads", "100000"], "from 1 to 1024"),
        (&["run", "case.toml", "--threads", "100000"], "from 1 to 1024"),
        (&["sweep", "case.toml"], "nothing varies"),
        (&["sweep", "deep.toml"], "deep.toml:9:19: `crack[1].length_mm = 400.0`"),
        (&["run", "study.toml"], "`railcrack sweep` computes"),
        (&["sweep", "study.toml", "--resume"], "study holds no study to resume"),
        (&["sweep", "study.toml", "--shard", "3/2"], "must be I/N"),
        (&["sweep", "study.toml", "--engine", "fem"], "`--engine fem`"),
        (&["sweep", "study.toml", "--resume", "--force"], "cannot be used with"),
        (&["sweep", "absent.toml"], "there is no such file"),
    ];
    for (arguments, says) in refusals {
        let (code, out, err) = railcrack(&folder, arguments);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{arguments:?}: {err}");
        assert!(err.contains(says), "{arguments:?}: {err}");
    }
    let names = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    assert_eq!(names, ["case.toml", "deep.toml", "study.toml"]);
}

#[test]
fn a_study_replaces_no_file_of_the_user() {
    let folder = workplace("mine", &STUDY);
    let line = ["--steps", "0", "--out", "out"];
    let plots = ["plots/ki.svg", "plots/kii.svg", "plots/paths.svg", "plots/length-cycles.svg"];
    let files = ["study.toml", "summary.csv", "times.csv", "runs.parquet", "growth.parquet", "sif.parquet"];
    let more = ["population.json", "packed-1.bin", "report.html", "study.json"];
    for file in files.into_iter().chain(plots).chain(more) {
        let path = folder.join("out").join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, "mine").unwrap();
        for more in [&[][..], &["--shard", "1/2"], &["--resume"], &["--shard", "1/2", "--resume"]] {
            let (code, _, err) = sweep(&folder, &[&line[..], more].concat());
            let expected = if file == "study.json" { 4 } else { 2 };
            assert_eq!(code, Some(expected), "{file} {more:?}: {err}");
        }
        let (_, _, err) = sweep(&folder, &line);
        assert!(err.contains(file), "{err}");
        assert_eq!(common::names(&folder.join("out")).len(), 1, "{file}: something was written");
        assert_eq!(fs::read(&path).unwrap(), b"mine", "{file}");
        fs::remove_dir_all(folder.join("out")).unwrap();
    }
    // Files that no study writes stay; what it replaces, it does with --force.
    fs::create_dir_all(folder.join("out")).unwrap();
    for file in ["notes.txt", "summary.csv"] {
        fs::write(folder.join("out").join(file), "mine").unwrap();
    }
    assert_eq!(sweep(&folder, &[&line[..], &["--force"]].concat()).0, Some(0));
    assert_eq!(fs::read(folder.join("out/notes.txt")).unwrap(), b"mine");
    assert_eq!(column(&folder.join("out"), "state"), ["done"; 6]);
    // The folder of the study file itself.
    let own = folder.join("own");
    fs::create_dir(&own).unwrap();
    fs::write(own.join("study.toml"), &*STUDY).unwrap();
    assert_eq!(sweep(&own, &["--steps", "0", "--out", "."]).0, Some(0));
}

#[test]
fn no_name_in_a_file_leads_out_of_its_folder() {
    let folder = workplace("names", &STUDY);
    assert_eq!(sweep(&folder, &["--steps", "0"]).0, Some(0));
    let victim = folder.join("victim");
    fs::rename(folder.join("study/runs/001"), &victim).unwrap();
    let plan = folder.join("study/study.json");
    let text = fs::read_to_string(&plan).unwrap();
    fs::write(&plan, text.replace("001", "../../victim")).unwrap();
    let before = files(&victim);
    for line in [&["sweep", "study.toml", "--steps", "0", "--force"][..], &["report", "study"]] {
        let (code, _, err) = railcrack(&folder, line);
        assert_eq!(code, Some(4), "{err}");
        assert!(err.contains("study.json names \"../../victim\""), "{err}");
    }
    assert_eq!(files(&victim), before);
}

#[test]
fn another_study_does_not_enter_the_folder() {
    let folder = workplace("entered", &STUDY);
    assert_eq!(sweep(&folder, &["--steps", "0"]).0, Some(0));
    let before = files(&folder.join("study"));
    let refused = |arguments: &[&str], says: &str| {
        let (code, _, err) = sweep(&folder, arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {err}");
        assert!(err.contains(says), "{arguments:?}: {err}");
    };
    refused(&["--steps", "0"], "study already holds a study (study.json)");
    refused(&["--resume"], "it was started with --steps 0, now no options");
    fs::write(folder.join("study.toml"), STUDY.replace("0.3]", "0.5]")).unwrap();
    refused(
        &["--steps", "0", "--resume"],
        "contact.friction = [0.1, 0.3] there, contact.friction = [0.1, 0.5] now",
    );
    fs::write(folder.join("study.toml"), STUDY.replace("positions = 41", "positions = 43")).unwrap();
    refused(&["--steps", "0", "--resume"], "\"positions = 41\" there, \"positions = 43\" now");
    assert_eq!(files(&folder.join("study")), before);

    // Replaced, nothing of the old study remains but what is not of it.
    fs::write(folder.join("study/runs/001/mine.txt"), "kept").unwrap();
    fs::write(folder.join("study.toml"), STUDY.replace("0.1, 0.3]", "0.2, 0.5]")).unwrap();
    assert_eq!(sweep(&folder, &["--steps", "0", "--force"]).0, Some(0));
    let names = fs::read_dir(folder.join("study/runs")).unwrap();
    let mut names: Vec<String> =
        names.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names.len(), 6, "{names:?}");
    assert_eq!(names[0], "001");
    assert!(files(&folder.join("study/runs").join(&names[0])).contains_key("mine.txt"));
    // Nor does a study enter the folder of a run.
    let run = folder.join("study/runs").join(&names[2]).display().to_string();
    refused(&["--out", &run, "--resume"], "already holds a run");
}
