//! `railcrack paper` as a user meets it.

use super::common;
use super::common::{railcrack, stderr, stdout};

#[test]
fn one_figure() {
    let place = common::folder("paper-command", "one");
    let (folder, out) = (place.join("paper"), "paper");
    let done = railcrack(&place, &["paper", "--only", "13", "--out", out, "--quiet"]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    assert!(done.stderr.is_empty(), "{}", stderr(&done));
    assert!(stdout(&done).contains("4-agreement: holds in the 2 decided\n"), "{}", stdout(&done));
    for file in [
        "paper.md",
        "statements.json",
        "report.html",
        "claims.csv",
        "figures/fig13.svg",
        "figures/fig13.csv",
        "cases/fig13-half-plane-along.toml",
    ] {
        assert!(folder.join(file).is_file(), "{file}");
    }
    assert!(!folder.join("figures/fig14.svg").exists());

    // The page, from the other files alone.
    let page = std::fs::read(folder.join("report.html")).unwrap();
    assert!(String::from_utf8_lossy(&page).contains("holds in the 2 decided"));
    std::fs::remove_file(folder.join("report.html")).unwrap();
    let said = common::done(&place, &["report", out]);
    assert!(said.starts_with("report of the paper in "), "{said}");
    assert!(std::fs::read(folder.join("report.html")).unwrap() == page);

    // The case files are there to be run and changed.
    let case = folder.join("cases/fig13-half-plane-along.toml");
    let check = railcrack(&place, &["check", case.to_str().unwrap()]);
    assert_eq!(check.status.code(), Some(0), "{}", stderr(&check));

    let again = railcrack(&place, &["paper", "--only", "13", "--out", out, "--quiet"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(stderr(&again).contains("--force"), "{}", stderr(&again));
}

#[test]
fn a_figure_that_is_not_there() {
    let place = common::folder("paper-command", "none");
    let refused = railcrack(&place, &["paper", "--only", "13", "26", "--out", "paper"]);
    assert_eq!(refused.status.code(), Some(2));
    let said = stderr(&refused);
    assert!(
        said.contains("`26`")
            && said.contains("13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 27, 28, 29, 30"),
        "{said}"
    );
    assert!(!place.join("paper").exists(), "something was written");
}
