//! `railcrack paper` as a user meets it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn railcrack(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_railcrack")).args(arguments).output().unwrap()
}

fn fresh(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn one_figure() {
    let folder = fresh("paper-one");
    let out = folder.to_str().unwrap();
    let done = railcrack(&["paper", "--only", "13", "--out", out, "--quiet"]);
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    assert!(done.stderr.is_empty(), "{}", text(&done.stderr));
    assert!(text(&done.stdout).contains("4-agreement: holds in the 2 decided\n"), "{}", text(&done.stdout));
    for file in [
        "paper.md",
        "claims.csv",
        "figures/fig13.svg",
        "figures/fig13.csv",
        "cases/fig13-half-plane-with.toml",
    ] {
        assert!(folder.join(file).is_file(), "{file}");
    }
    assert!(!folder.join("figures/fig14.svg").exists());

    // The case files are there to be run and changed.
    let case = folder.join("cases/fig13-half-plane-with.toml");
    let check = railcrack(&["check", case.to_str().unwrap()]);
    assert_eq!(check.status.code(), Some(0), "{}", text(&check.stderr));

    let again = railcrack(&["paper", "--only", "13", "--out", out, "--quiet"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(text(&again.stderr).contains("--force"), "{}", text(&again.stderr));
}

#[test]
fn a_figure_that_is_not_there() {
    let folder = fresh("paper-none");
    let refused = railcrack(&["paper", "--only", "13", "26", "--out", folder.to_str().unwrap()]);
    assert_eq!(refused.status.code(), Some(2));
    let said = text(&refused.stderr);
    assert!(
        said.contains("`26`")
            && said.contains("13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 27, 28, 29, 30"),
        "{said}"
    );
    assert!(!folder.exists(), "something was written");
}
