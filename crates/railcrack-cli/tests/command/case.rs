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
    let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/reference.toml");
    let written = std::fs::read_to_string(folder.join("a.toml")).unwrap();
    assert_eq!(written, std::fs::read_to_string(shipped).unwrap());
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
