//! Folders of commands whose results are whole or none: `contact`, `calibrate`, `validate`, `plan`,
//! `shakedown`, `compare`; and that no command destroys what it reads.

use super::common::{self, DISLOCATION_CASE, command, done, ends, names, railcrack, read, stderr, stdout};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A case of every command, with few positions.
const CASE: &str = "\
[contact]
peak_pressure_mpa = 1000.0
half_width_mm = 6.0
friction = 0.1
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 30.0
friction = 0.3
[solver]
engine = \"dislocation\"
[passage]
positions = 21
[mesh]
interface_elements = 10
[growth]
steps = 1
direction = \"coplanar\"
[traffic]
axle_load_t = 20.0
[inspection]
detectable_depth_mm = 2.1
critical_depth_mm = 2.5
";

const WHEELS: &str = "\
[[wheel]]
table = \"wheels.csv\"
creepage_sign = \"contact\"
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 30.0
friction = 0.3
[solver]
engine = \"dislocation\"
[passage]
positions = 21
[mesh]
interface_elements = 10
";

const TABLE: &str = "\
wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm
7,85,1,0.001,0.0005,0.0002,0.3,6,4
8,60,0,0.002,0,0,0.3,6,5
";

/// An empty place with the files that the commands below read.
fn workplace(name: &str) -> PathBuf {
    let place = common::folder("result-folders", name);
    fs::create_dir_all(place.join("entries/conditions")).unwrap();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation");
    for file in ["L1.toml", "conditions/law.toml"] {
        fs::copy(source.join(file), place.join("entries").join(file)).unwrap();
    }
    for (file, text) in [
        ("case.toml", CASE),
        ("wheels.toml", WHEELS),
        ("wheels.csv", TABLE),
        ("measured.csv", "mgt,depth_mm\n0.1,2.02\n"),
    ] {
        fs::write(place.join(file), text).unwrap();
    }
    place
}

/// A command line that writes the folder `out`, and the names of some of the files there.
type Writer = (&'static [&'static str], &'static [&'static str]);

const WRITERS: [Writer; 5] = [
    (&["contact", "wheels.toml"], &["wheels.csv", "contact.html", "plots/wheel-7.svg"]),
    (&["validate", "entries"], &["validation.csv", "validation.html", "plots/law-mm-per-cycle.svg"]),
    (&["calibrate", "case.toml", "--measured", "measured.csv"], &["calibration.csv", "calibrated.toml"]),
    (&["plan", "case.toml", "--grinding", "0.1", "--interval", "1", "--horizon", "2"], &["plan.csv"]),
    (&["shakedown", "case.toml"], &["profile.csv", "shakedown.json"]),
];

fn line<'a>(writer: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [writer, &["--out", "out", "--quiet"], more].concat()
}

/// All files below `folder` with their contents, without wall times.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all = Vec::new();
    for name in names(folder) {
        let path = folder.join(&name);
        if path.is_dir() {
            let inner = contents(&path).into_iter();
            all.extend(inner.map(|(file, bytes)| (format!("{name}/{file}"), bytes)));
        } else {
            all.push((name, fs::read(&path).unwrap()));
        }
    }
    all
}

#[test]
fn results_have_checksums_and_are_replaced_on_request_only() {
    for (writer, files) in WRITERS {
        let place = workplace(&format!("whole-{}", writer[0]));
        let out = place.join("out");
        done(&place, &line(writer, &[]));
        for file in files {
            assert!(out.join(file).is_file(), "{writer:?}: {file}");
        }
        assert!(!names(&out).iter().any(|name| name.contains("partial") || name == "run.lock"));
        let told = done(&place, &["verify", "out"]);
        assert!(told.ends_with("files are intact\n"), "{writer:?}: {told}");
        let sums = read(&out.join("SHA256SUMS"));
        assert!(sums.contains(&format!("  {}\n", files[0])), "{writer:?}: {sums}");

        let before = contents(&out);
        let refused = stderr(&ends(&place, &line(writer, &[]), 2));
        assert!(refused.contains("out already holds") && refused.contains("--force"), "{refused}");
        let goes_on = refused.contains("--resume") && !refused.contains("`railcrack run --resume`");
        assert!(!goes_on, "{writer:?}: {refused}");
        assert_eq!(contents(&out), before, "{writer:?}");

        // A changed file is found, and replaced with all the others; the user's stay.
        fs::write(out.join(files[0]), "mine").unwrap();
        let told = stdout(&ends(&place, &["verify", "out"], 4));
        assert!(told.contains(&format!("damaged: out/{}", files[0])), "{told}");
        fs::create_dir_all(out.join("plots")).unwrap();
        for mine in ["notes.txt", "plots/wheel-7.jpg", "plots/wheel-mine.svg"] {
            fs::write(out.join(mine), "mine").unwrap();
        }
        done(&place, &line(writer, &["--force"]));
        done(&place, &["verify", "out"]);
        for mine in ["notes.txt", "plots/wheel-7.jpg", "plots/wheel-mine.svg"] {
            assert_eq!(read(&out.join(mine)), "mine", "{writer:?}: {mine}");
        }
    }
}

#[test]
fn files_of_the_user_are_not_replaced_without_force() {
    for (writer, files) in WRITERS {
        let place = workplace(&format!("user-{}", writer[0]));
        for file in files {
            let path = place.join("out").join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, "mine").unwrap();
            let refused = stderr(&ends(&place, &line(writer, &[]), 2));
            assert!(refused.contains("out already h"), "{writer:?}: {refused}");
            assert_eq!(read(&path), "mine", "{writer:?}: {file}");
            fs::remove_dir_all(place.join("out")).unwrap();
        }
    }
    let place = workplace("user-run");
    for file in ["plots/ki.svg", "fields/step-0001-position-0001.vtu", "growth.csv"] {
        let path = place.join("out").join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, "mine").unwrap();
        let refused = stderr(&ends(&place, &line(&["run", "case.toml"], &[]), 2));
        assert!(refused.contains("out already h") && refused.contains("--force"), "{refused}");
        assert_eq!(contents(&place.join("out")), [(file.to_owned(), b"mine".to_vec())]);
        fs::remove_dir_all(place.join("out")).unwrap();
    }
}

#[test]
fn one_process_at_a_time_writes_a_folder() {
    for (writer, _) in WRITERS {
        let place = workplace(&format!("lock-{}", writer[0]));
        fs::create_dir(place.join("out")).unwrap();
        // The lock of this process stands for that of another command.
        let lock = fs::File::create(place.join("out/run.lock")).unwrap();
        lock.lock().unwrap();
        let refused = stderr(&ends(&place, &line(writer, &["--force"]), 4));
        assert!(refused.contains("is being computed by another process"), "{writer:?}: {refused}");
        assert_eq!(names(&place.join("out")), ["run.lock"]);
    }
}

#[cfg(unix)]
#[test]
fn nothing_is_written_or_removed_through_links() {
    use std::os::unix::fs::symlink;
    for (writer, inner) in [(WRITERS[0].0, "plots"), (WRITERS[0].0, "patches"), (WRITERS[1].0, "plots")] {
        let place = workplace(&format!("links-{}-{inner}", writer[0]));
        let more: &[&str] = if inner == "patches" { &["--patches"] } else { &[] };
        fs::create_dir_all(place.join("outside")).unwrap();
        fs::create_dir_all(place.join("out")).unwrap();
        for file in ["wheel-7.svg", "wheel-7-patch-1.csv", "law-mm-per-cycle.svg"] {
            fs::write(place.join("outside").join(file), "mine").unwrap();
        }
        symlink(place.join("outside"), place.join("out").join(inner)).unwrap();
        let before = contents(&place.join("outside"));
        for force in [&[][..], &["--force"]] {
            let refused = stderr(&ends(&place, &line(writer, &[more, force].concat()), 4));
            assert!(refused.contains("it is a link"), "{refused}");
        }
        assert_eq!(contents(&place.join("outside")), before);
        assert_eq!(names(&place.join("out")), [inner]);
    }
}

#[test]
fn unfinished_results_are_none() {
    for (writer, files) in WRITERS {
        let place = workplace(&format!("unfinished-{}", writer[0]));
        let out = place.join("out");
        done(&place, &line(writer, &[]));
        let whole = names(&out);
        // What a kill leaves while files are put in place.
        fs::remove_file(out.join(files[0])).unwrap();
        fs::write(out.join("results.partial"), "").unwrap();
        let told = stdout(&railcrack(&place, &["verify", "out"]));
        assert!(told.contains("the results are unfinished"), "{writer:?}: {told}");
        done(&place, &line(writer, &[]));
        assert_eq!(names(&out), whole, "{writer:?}");
        done(&place, &["verify", "out"]);
    }
}

/// The commands, each computing for a minute.
#[cfg(unix)]
#[test]
fn a_signal_leaves_no_results_and_says_so() {
    let place = workplace("signal");
    let long = |text: &str| {
        text.replace("angle_deg = 30.0", "angle_deg = 30.0\ncount = 8\nspacing_mm = 6.0")
            .replace("interface_elements = 10", "interface_elements = 400")
            .replace("steps = 1", "steps = 400")
    };
    fs::write(place.join("case.toml"), long(CASE)).unwrap();
    fs::write(place.join("wheels.toml"), long(WHEELS)).unwrap();
    let study = format!("{}[study]\n", long(CASE)).replace("friction = 0.3", "friction = [0.3]");
    fs::write(place.join("entries/conditions/long.toml"), study).unwrap();
    let entry = "id = \"A\"\ngrade = \"track\"\nquantity = \"q\"\nconditions = \"c\"\nsource = \"s\"\nread = \"full-text\"\ncertainty = 3\n[compare]\nkind = \"depth-rate\"\nstudy = \"conditions/long.toml\"\nlow = 0.1\nhigh = 0.2\nfrom_mm = 2.1\nto_mm = 2.2\n";
    fs::write(place.join("entries/A.toml"), entry).unwrap();
    let writers = WRITERS.into_iter().map(|(writer, _)| writer).filter(|writer| writer[0] != "shakedown");
    let compare: &[&str] = &["compare", "case.toml", "--engines", "--no-limits"];
    for writer in writers.chain([compare]) {
        let out = place.join("out");
        let mut child = command(&place, &line(writer, &[]));
        let child = child.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let started = Instant::now();
        while !out.join("run.lock").exists() {
            assert!(started.elapsed() < Duration::from_secs(60), "{writer:?} never began");
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(Duration::from_millis(300));
        let asked = Instant::now();
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        let output = child.wait_with_output().unwrap();
        let took = asked.elapsed();
        assert_eq!(output.status.code(), Some(130), "{writer:?}: {}", stderr(&output));
        let said = format!("{}{}", stdout(&output), stderr(&output));
        assert!(said.contains("interrupted: no results are written"), "{writer:?}: {said}");
        assert!(!said.contains("--resume") && !said.contains("results in"), "{writer:?}: {said}");
        assert!(took < Duration::from_millis(2500), "{writer:?}: {took:?}");
        // Nothing, or what is known to be unfinished.
        let is_clean = !out.exists() || names(&out).contains(&"results.partial".to_owned());
        assert!(is_clean || names(&out) == ["run.lock"], "{writer:?}: {:?}", names(&out));
        let _ = fs::remove_dir_all(&out);
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_found_first() {
    for (writer, _) in WRITERS {
        let place = workplace(&format!("refused-{}", writer[0]));
        fs::write(place.join("out"), "mine").unwrap();
        let started = Instant::now();
        let refused = stderr(&ends(&place, &line(writer, &[]), 4));
        assert!(refused.contains("it is a file, not a folder"), "{writer:?}: {refused}");
        assert!(started.elapsed() < Duration::from_secs(5), "{writer:?}");
        assert_eq!(read(&place.join("out")), "mine");
    }
}

/// A command, where its results would replace an input, and that input.
#[test]
fn no_input_is_replaced() {
    let place = workplace("inputs");
    let profile = "depth_mm,sxx_mpa\n0,25\n0.8,-110\n40,0\n";
    fs::write(place.join("residual.csv"), profile).unwrap();
    let stressed = format!("{CASE}[residual_stress]\nprofile = \"residual.csv\"\n");
    fs::write(place.join("stressed.toml"), &stressed).unwrap();
    fs::create_dir_all(place.join("plots")).unwrap();
    let drawn = stressed.replace("residual.csv", "plots/ki.svg");
    fs::write(place.join("plots/ki.svg"), profile).unwrap();
    fs::write(place.join("drawn.toml"), drawn).unwrap();
    let study = |profile: &str| {
        format!("{CASE}[residual_stress]\nprofile = \"{profile}\"\n")
            .replace("friction = 0.3", "friction = [0.2, 0.3]")
    };
    fs::write(place.join("summary.csv"), profile).unwrap();
    fs::write(place.join("study.toml"), study("summary.csv")).unwrap();
    fs::write(place.join("calibration.csv"), "mgt,depth_mm\n0.1,2.05\n").unwrap();
    let before = contents(&place);
    let refused: [&[&str]; 9] = [
        &["contact", "wheels.toml", "--out", "."],
        &["run", "stressed.toml", "--out", "."],
        &["run", "drawn.toml", "--out", "."],
        &["run", "case.toml", "--out", "."],
        &["plan", "stressed.toml", "--out", "."],
        &["shakedown", "stressed.toml", "--out", "."],
        &["calibrate", "case.toml", "--measured", "calibration.csv", "--out", "../inputs"],
        &["sweep", "study.toml", "--out", "."],
        &["explorer", "case.toml", "--out", "./case.toml"],
    ];
    for line in refused {
        let said = stderr(&ends(&place, &[line, &["--force"]].concat(), 2)).replace('\n', " ");
        assert!(said.contains("is an input and would be replaced"), "{line:?}: {said}");
        assert_eq!(contents(&place), before, "{line:?}");
    }
}

/// A comparison in the folder of one of its runs would replace the report of that run.
#[test]
fn results_of_another_command_are_not_replaced() {
    let place = workplace("others");
    fs::write(place.join("quick.toml"), &**DISLOCATION_CASE).unwrap();
    for out in ["a", "b"] {
        done(&place, &["run", "quick.toml", "--steps", "0", "--out", out, "--quiet"]);
    }
    let before = contents(&place.join("a"));
    for line in [
        &["compare", "a", "b", "--out", "a", "--force"][..],
        &["contact", "wheels.toml", "--out", "a", "--force"],
        &["validate", "entries", "--out", "a", "--force"],
    ] {
        let said = stderr(&ends(&place, line, 2));
        assert!(said.contains("a holds other results"), "{line:?}: {said}");
        assert_eq!(contents(&place.join("a")), before, "{line:?}");
    }
}
