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

/// The curve of a set-up itself, moved up by half a unit, is half a unit away from it.
#[test]
fn a_digitised_curve_is_drawn_and_measured() {
    let place = common::folder("paper-command", "overlay");
    common::done(&place, &["paper", "--only", "13", "--out", "plain", "--quiet"]);
    let table = std::fs::read_to_string(place.join("plain/figures/fig13.csv")).unwrap();
    let rows = table.lines().filter_map(|line| line.strip_prefix("\"half-plane, along\",fig13,1,"));
    let moved = rows.step_by(8).map(|row| {
        let values: Vec<f64> = row.split(',').map(|value| value.parse().unwrap()).collect();
        format!("fig13,{},{}\n", values[0], values[2] + 0.5)
    });
    let text = format!("curve,xc_over_a,kii_mpa_sqrt_m\n{}", moved.collect::<String>());
    std::fs::write(place.join("fig13.csv"), text).unwrap();

    common::done(&place, &["paper", "--only", "13", "--overlay", "fig13.csv", "--out", "paper", "--quiet"]);
    let distances = std::fs::read_to_string(place.join("paper/overlays.csv")).unwrap();
    let own = distances.lines().find(|line| line.contains("\"half-plane, along\""));
    let values: Vec<f64> = own.unwrap().rsplitn(3, ',').take(2).map(|value| value.parse().unwrap()).collect();
    assert!(values.iter().all(|value| (value - 0.5).abs() < 1e-9), "{distances}");
    let page = std::fs::read_to_string(place.join("paper/report.html")).unwrap();
    assert!(page.contains("igitised"), "the page does not tell of the curve");
    assert!(place.join("paper/overlays/fig13.csv").is_file());

    // Curves and figures that are not there are named.
    let refused = |file: &str, content: &str| {
        std::fs::write(place.join(file), content).unwrap();
        let refused = railcrack(&place, &["paper", "--only", "14", "--overlay", file, "--out", "none"]);
        assert_eq!(refused.status.code(), Some(2));
        assert!(!place.join("none").exists(), "something was written");
        stderr(&refused)
    };
    let said = refused("fig14.csv", "curve,xc_over_a,kii_mpa_sqrt_m\nfig13,0,1\n");
    assert!(said.contains("`fig13` is not a curve of Fig. 14: must be one of reference"), "{said}");
    let said = refused("fig13.csv", "curve,xc_over_a,kii_mpa_sqrt_m\nfig13,0,1\n");
    assert!(said.contains("not among the recomputed ones"), "{said}");
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
