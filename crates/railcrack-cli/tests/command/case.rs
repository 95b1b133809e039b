//! The commands that read and write case files: exit codes, what they say, what they write.

use super::common;
use super::common::{names, railcrack, stderr, stdout};

#[test]
fn init_then_check() {
    let folder = common::folder("case-commands", "init-then-check");
    let output = railcrack(&folder, &["init"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(names(&folder), ["case.toml"]);
    let output = railcrack(&folder, &["check", "case.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let summary = stdout(&output);
    for line in [
        "Reference case, Table 1",
        "  peak pressure p0     845 MPa",
        "  line load            8959 N/mm",
        "  from, to             x = -40.5 to 40.5 mm",
        "  tips                 1",
    ] {
        assert!(summary.lines().any(|l| l == line), "`{line}` in\n{summary}");
    }
    assert_eq!(names(&folder), ["case.toml"], "check writes nothing");
}

#[test]
fn init_never_overwrites_unasked() {
    let folder = common::folder("case-commands", "init-overwrite");
    std::fs::write(folder.join("a.toml"), "mine").unwrap();
    let output = railcrack(&folder, &["init", "a.toml"]);
    assert_eq!(output.status.code(), Some(4));
    assert!(stderr(&output).contains("a.toml already exists; --force"), "{}", stderr(&output));
    assert_eq!(std::fs::read_to_string(folder.join("a.toml")).unwrap(), "mine");
    assert_eq!(railcrack(&folder, &["init", "--force", "a.toml"]).status.code(), Some(0));
    let written = std::fs::read_to_string(folder.join("a.toml")).unwrap();
    assert!(written.contains("\n[growth]\n") && written != "mine");
    let output = railcrack(&folder, &["init", "-"]);
    assert_eq!((stdout(&output), names(&folder)), (written, vec!["a.toml".to_string()]));
    let output = railcrack(&folder, &["init", "no/such/folder.toml"]);
    assert_eq!(output.status.code(), Some(4));
    assert!(stderr(&output).contains("cannot write no/such/folder.toml"), "{}", stderr(&output));
}

#[test]
fn bad_files_exit_with_2_and_write_nothing() {
    let folder = common::folder("case-commands", "bad-files");
    std::fs::create_dir(folder.join("dir.toml")).unwrap();
    std::fs::write(folder.join("empty.toml"), "").unwrap();
    std::fs::write(folder.join("latin1.toml"), b"# \nx = 1\ntitle = \"\xe9t\xe9\"\n").unwrap();
    let text = stdout(&railcrack(&folder, &["init", "-"]));
    std::fs::write(folder.join("key.toml"), text.replace("positions = 241", "positons = 241")).unwrap();
    std::fs::write(folder.join("nan.toml"), text.replace("= 845.0", "= nan")).unwrap();
    let before = names(&folder);
    for (file, says) in [
        ("missing.toml", "error: missing.toml: cannot read `missing.toml`: there is no such file"),
        ("dir.toml", "it is a folder"),
        ("empty.toml", "empty.toml:1:1: `[contact]` is missing"),
        ("latin1.toml", "latin1.toml:3:10: `latin1.toml` is not UTF-8"),
        ("key.toml", ":1: `passage.positons = 241`: unknown key (nearest known key: `positions`"),
        ("nan.toml", "`contact.peak_pressure_mpa = nan`: must be a number in [0.001, 10000] MPa"),
    ] {
        let output = railcrack(&folder, &["check", file]);
        assert_eq!(output.status.code(), Some(2), "{file}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{file}: {}", stderr(&output));
        assert_eq!(stdout(&output), "", "{file}");
    }
    assert_eq!(names(&folder), before);
}

#[test]
fn usage_errors_exit_with_2() {
    let folder = common::folder("case-commands", "usage");
    for arguments in [&["frobnicate"][..], &["check"], &["check", "a", "b"], &["init", "--nonsense"], &[]] {
        let output = railcrack(&folder, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
    }
    assert!(names(&folder).is_empty());
}

#[test]
fn help_and_schema() {
    let folder = common::folder("case-commands", "help");
    let help = railcrack(&folder, &["--help"]);
    assert_eq!(help.status.code(), Some(0));
    for word in ["init", "check", "schema", "Exit codes"] {
        assert!(stdout(&help).contains(word), "{word}");
    }
    let schema = railcrack(&folder, &["schema"]);
    let schema: serde_json::Value = serde_json::from_str(&stdout(&schema)).unwrap();
    assert_eq!(schema["title"], "Case file of railcrack");
}

/// Another file that is named by mistake, or by a case of somebody else, may hold what nobody
/// should see in a log.
#[test]
fn lines_of_files_of_another_kind_are_not_shown() {
    let folder = common::folder("case-commands", "other-kinds");
    let private = "root:secret-hash:19000\nPASSWORD = \"secret-word\"\n";
    std::fs::write(folder.join("private"), private).unwrap();
    std::fs::write(folder.join("valid.toml"), "PASSWORD = \"secret-word\"\n[secret]\nkey = 1\n").unwrap();
    std::fs::write(folder.join("comment.mat"), "% secret-word\n1 2 3\n").unwrap();
    std::fs::write(folder.join("binary"), b"secret-word \xff\n").unwrap();
    let with = |name: &str, appended: &str| {
        std::fs::write(folder.join(name), format!("{}{appended}", common::QUICK_CASE)).unwrap();
    };
    with("profile.toml", "[residual_stress]\nprofile = \"private\"\n");
    with("binary.toml", "[residual_stress]\nprofile = \"binary\"\n");
    with("field.toml", "[plastic_stress]\nfield = \"private\"\n");
    with("rates.toml", "[shakedown]\ninitial_residual = \"private\"\n");
    let table = "kind = \"table\"\nprofile = \"comment.mat\"\n";
    let contact =
        common::QUICK_CASE.replace("peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.3", table);
    std::fs::write(folder.join("contact.toml"), contact).unwrap();
    with("study.toml", "[study]\n");
    with("traffic.toml", "[traffic]\naxle_load_t = 20.0\n");
    for arguments in [
        &["check", "private"][..],
        &["run", "private"],
        &["sweep", "private"],
        &["check", "valid.toml"],
        &["check", "profile.toml"],
        &["check", "binary.toml"],
        &["check", "field.toml"],
        &["check", "rates.toml"],
        &["check", "contact.toml"],
        &["sweep", "study.toml", "--samples", "private"],
        &["calibrate", "traffic.toml", "--measured", "private"],
    ] {
        let output = railcrack(&folder, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        let said = stderr(&output).to_lowercase();
        assert!(!said.contains("secret") && !said.contains("password"), "{arguments:?}: {said}");
    }
}

/// Of a line with a carriage return, a terminal would show only the end.
#[test]
fn no_carriage_return_reaches_the_terminal() {
    let folder = common::folder("case-commands", "carriage-return");
    std::fs::write(folder.join("case.toml"), "[contact]\r\nfriction 0.1\rall is well\r\n").unwrap();
    let output = railcrack(&folder, &["check", "case.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("friction 0.1?all is well"), "{}", stderr(&output));
    assert!(!stderr(&output).contains('\r'), "{:?}", stderr(&output));
}

/// Values next to zero are no values of a rail: their results would not be numbers.
#[test]
fn values_next_to_zero_are_out_of_range() {
    let folder = common::folder("case-commands", "next-to-zero");
    let text = format!("{}[solver]\nengine = \"dislocation\"\n", common::QUICK_CASE);
    std::fs::write(folder.join("case.toml"), text).unwrap();
    for (key, least, below) in [
        ("traffic.axle_load_t", "0.001", "1e-305"),
        ("shakedown.yield_stress_mpa", "1.0", "1e-12"),
        ("shakedown.hardening_modulus_mpa", "1.0", "1e-300"),
        ("rail.width_mm", "", "1e-300"),
        ("rail.depth_mm", "", "1e-300"),
        ("growth.stop_after_cycles", "0.001", "5e-324"),
        ("growth.critical_length_mm", "0.001", "5e-324"),
    ] {
        let refused = railcrack(&folder, &["check", "case.toml", "--set", &format!("{key}={below}")]);
        assert_eq!(refused.status.code(), Some(2), "{key}: {}", stdout(&refused));
        assert!(stderr(&refused).contains("must be a number in ["), "{key}: {}", stderr(&refused));
        if !least.is_empty() {
            let set = format!("{key}={least}");
            let run = ["run", "case.toml", "--quiet", "--force", "--steps", "1", "--set", &set];
            let output = railcrack(&folder, &run);
            assert_eq!(output.status.code(), Some(0), "{key}: {}", stderr(&output));
        }
    }
}

/// Time to check a large file, on a machine that is busy; on a quiet one it takes a fifth of it.
const TO_CHECK: std::time::Duration = std::time::Duration::from_secs(10);

#[test]
fn large_files_are_checked_soon() {
    let folder = common::folder("case-commands", "large");
    let crack = "[[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nfriction = 0.5\n";
    let contact = "half_width_mm = 6.75\npeak_pressure_mpa";
    let write = |name: &str, text: String| std::fs::write(folder.join(name), text).unwrap();
    let wheel = "{share=2e-5,contact={half_width_mm=6,peak_pressure_mpa=800,friction=0}},\n";
    write("wheels.toml", format!("wheel = [{}]\n{crack}angle_deg = 15.0\n", wheel.repeat(50_000)));
    write("few.toml", format!("wheel = [{}]\n{crack}angle_deg = 15.0\n", "{share=1e-5},\n".repeat(100_000)));
    let study = |vary: &str, angle: &str, engine: &str| {
        format!(
            "[contact]\n{contact} = {vary}\nfriction = 0.1\n{crack}angle_deg = {angle}\n\
             [solver]\nengine = \"{engine}\"\n[study]\nsamples = 10000\n"
        )
    };
    let pressures = "{ uniform = [700.0, 900.0] }";
    write("loads.toml", study(pressures, "15.0", "xfem"));
    write("angles.toml", study("845.0", "{ uniform = [10.0, 60.0] }", "xfem"));
    write("both.toml", study(pressures, "{ uniform = [10.0, 60.0] }", "dislocation"));
    for (file, code) in
        [("wheels.toml", 2), ("few.toml", 2), ("loads.toml", 0), ("angles.toml", 0), ("both.toml", 0)]
    {
        let begun = std::time::Instant::now();
        let output = railcrack(&folder, &["check", file]);
        let took = begun.elapsed();
        println!("{file}: {took:?}");
        assert_eq!(output.status.code(), Some(code), "{file}: {}", stderr(&output));
        assert!(took < TO_CHECK, "{file}: {took:?}");
    }
}

#[test]
fn a_long_growth_step_is_announced() {
    let folder = common::folder("case-commands", "long-step");
    let text = format!("{}[solver]\nengine = \"dislocation\"\n", common::QUICK_CASE);
    std::fs::write(folder.join("case.toml"), text).unwrap();
    let long = ["check", "case.toml", "--set", "passage.positions=241", "--set", "crack.angle_deg=0.5"];
    let said = |arguments: &[&str]| stdout(&railcrack(&folder, arguments));
    let mesh = ["--set", "mesh.interface_elements=56"];
    let flat = said(&[&long[..], &mesh].concat());
    assert!(flat.contains("slow") && flat.contains("a growth step takes about"), "{flat}");
    assert!(!said(&["check", "case.toml"]).contains("slow"));
}

/// The default rail is as long as its cracks need; a given one is not.
#[test]
fn the_rail_reaches_as_far_as_its_cracks() {
    let folder = common::folder("case-commands", "reach");
    let row = common::QUICK_CASE.replace("friction = 0.2", "friction = 0.2\ncount = 100\nspacing_mm = 3.4");
    let text = format!("{row}[solver]\nengine = \"dislocation\"\n");
    std::fs::write(folder.join("row.toml"), &text).unwrap();
    std::fs::write(folder.join("case.toml"), common::QUICK_CASE).unwrap();
    let said = |file: &str, set: &[&str]| {
        let output = railcrack(&folder, &[&["check", file][..], set].concat());
        (output.status.code(), stdout(&output), stderr(&output))
    };
    let (code, out, err) = said("row.toml", &[]);
    assert_eq!(code, Some(0), "{err}");
    // The outermost tip is 336.6/2 + 6 cos 40° = 172.896 mm from the middle.
    assert!(out.contains("x = -154.6 to 491.2 mm, depth 172 mm"), "{out}");
    let (code, out, _) = said("case.toml", &[]);
    assert!(code == Some(0) && out.contains("x = -150 to 150 mm"), "{out}");
    let (code, _, err) = said("row.toml", &["--set", "rail.width_mm=300.0"]);
    assert!(code == Some(2) && err.contains("the crack leaves the rail at x ="), "{err}");
    let (code, _, err) = said("row.toml", &["--set", "solver.engine=xfem", "--set", "rail.boundary=block"]);
    assert!(code == Some(2) && err.contains("the crack leaves the rail at x ="), "{err}");
}
