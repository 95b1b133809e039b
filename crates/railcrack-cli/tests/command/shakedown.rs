//! `railcrack shakedown`: files, columns, exit codes.

use super::common;
use super::common::{railcrack, read, stderr, stdout};
use std::path::Path;

const CASE: &str = "\
title = \"Rolled\"
[contact]
peak_pressure_mpa = 1000.0
half_width_mm = 6.75
friction = 0.1
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 15.0
friction = 0.5
";

/// Header and rows without comments.
fn table(path: &Path) -> (String, Vec<Vec<f64>>) {
    let text = read(path);
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header = lines.next().unwrap().to_owned();
    (header, lines.map(|line| line.split(',').map(|v| v.parse().unwrap()).collect()).collect())
}

#[test]
fn writes_what_the_formats_promise() {
    let folder = common::folder("shakedown-command", "shakedown-files");
    std::fs::write(folder.join("rolled.toml"), CASE).unwrap();
    let output = railcrack(&folder, &["shakedown", "rolled.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).starts_with("elastic shakedown after "), "{}", stdout(&output));
    assert!(stderr(&output).starts_with("passage 1: residual stress changes by "), "{}", stderr(&output));
    let run = folder.join("rolled");
    let summary: serde_json::Value = serde_json::from_str(&read(&run.join("shakedown.json"))).unwrap();
    assert_eq!(summary["state"], "elastic shakedown");
    assert_eq!(summary["alternating_zone"], serde_json::Value::Null);
    assert!((summary["shakedown_limit"]["p0_over_k"].as_f64().unwrap() - 3.987).abs() < 1e-3);
    assert!((summary["first_yield"]["p0_over_k"].as_f64().unwrap() - 3.063).abs() < 1e-3);
    let (header, passes) = table(&run.join("passes.csv"));
    assert!(header.starts_with("pass,stress_change_mpa,"), "{header}");
    assert_eq!(passes.len() as u64, summary["passes"].as_u64().unwrap());
    assert!(passes.iter().enumerate().all(|(i, row)| row[0] == (i + 1) as f64));
    let (header, profile) = table(&run.join("profile.csv"));
    assert_eq!(
        header,
        "depth_mm,sxx_mpa,syy_mpa,szz_mpa,sxy_mpa,ep_xx,ep_yy,ep_zz,ep_xy,plastic_per_pass,dang_van_mpa"
    );
    let depths: Vec<f64> = profile.iter().map(|row| row[0]).collect();
    assert!(depths.windows(2).all(|pair| pair[0] < pair[1]) && depths[0] > 0.0);
    // The critical point is the largest value of the table or the surface.
    let largest = profile.iter().map(|row| row[10]).fold(0.0, f64::max);
    let critical = summary["dang_van"]["critical_value_mpa"].as_f64().unwrap();
    assert!(critical >= largest);
    let margin = summary["dang_van"]["margin_mpa"].as_f64().unwrap();
    assert!((margin - (250.0 - critical)).abs() < 1e-9);
    for name in
        ["residual-stress", "plastic-strain", "passes", "bounds", "shakedown-map", "dang-van", "field"]
    {
        let svg = read(&run.join(format!("plots/{name}.svg")));
        assert!(svg.starts_with("<svg") && svg.contains("Rolled") && !svg.contains("NaN"), "{name}");
    }
    assert!(read(&run.join("report.html")).contains("elastic shakedown"));
    for name in ["plastic.vtu", "cycle.vtu"] {
        assert!(read(&run.join(name)).contains("Name=\"plastic_strain\""), "{name}");
    }
    assert!(read(&run.join("plastic.vtu")).contains("Name=\"plastic_stress_mpa\""));
    // The same case again: refused without --force, the same bits with it.
    let output = railcrack(&folder, &["shakedown", "rolled.toml"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    let before = (read(&run.join("profile.csv")), read(&run.join("passes.csv")));
    let output = railcrack(&folder, &["shakedown", "rolled.toml", "--force", "--quiet"]);
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    assert_eq!(before, (read(&run.join("profile.csv")), read(&run.join("passes.csv"))));
}

/// The residual profile of one state is what another case takes as its balanced residual stress and
/// as its stress of manufacturing.
#[test]
fn profile_goes_into_another_case() {
    let folder = common::folder("shakedown-command", "shakedown-profile");
    std::fs::write(folder.join("rolled.toml"), CASE).unwrap();
    assert_eq!(railcrack(&folder, &["shakedown", "rolled.toml", "--quiet"]).status.code(), Some(0));
    let again = format!(
        "{CASE}[residual_stress]\nprofile = \"rolled/profile.csv\"\n[shakedown]\ninitial_residual = \"rolled/profile.csv\"\n"
    );
    std::fs::write(folder.join("again.toml"), again).unwrap();
    let output = railcrack(&folder, &["check", "again.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let output = railcrack(&folder, &["shakedown", "again.toml", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(folder.join("again/inputs/initial-residual.csv").is_file());
}

#[test]
fn direct_shows_its_difference_and_too_few_passages_their_end() {
    let folder = common::folder("shakedown-command", "shakedown-ways");
    std::fs::write(folder.join("direct.toml"), format!("{CASE}[shakedown]\nmethod = \"direct\"\n")).unwrap();
    let output = railcrack(&folder, &["shakedown", "direct.toml", "--out", "d"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).contains("the residual stress differs by up to "), "{}", stdout(&output));
    let summary: serde_json::Value = serde_json::from_str(&read(&folder.join("d/shakedown.json"))).unwrap();
    let other = &summary["direct_against_pass_by_pass"];
    assert!(other["stress_difference_mpa"].as_f64().unwrap() > 1.0, "{other}");
    assert!(3 * summary["redistributions"].as_u64().unwrap() <= other["redistributions"].as_u64().unwrap());
    std::fs::write(folder.join("few.toml"), format!("{CASE}[shakedown]\nmax_passes = 2\n")).unwrap();
    let output = railcrack(&folder, &["shakedown", "few.toml", "--out", "f"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stdout(&output).starts_with("not stabilised after 2 passages"), "{}", stdout(&output));
    assert_eq!(table(&folder.join("f/passes.csv")).1.len(), 2);
}

#[test]
fn bad_input_exits_with_2_and_writes_nothing() {
    let folder = common::folder("shakedown-command", "shakedown-bad");
    let heavy = CASE.replace("1000.0", "9000.0");
    for (name, case, says) in [
        (
            "modulus",
            format!("{CASE}[shakedown]\nhardening_modulus_mpa = 0.0\n"),
            "`shakedown.hardening_modulus_mpa",
        ),
        ("passes", format!("{CASE}[shakedown]\nmax_passes = 0\n"), "must be an integer from 1 to 100000"),
        (
            "method",
            format!("{CASE}[shakedown]\nmethod = \"fast\"\n"),
            "must be \"pass-by-pass\" or \"direct\"",
        ),
        ("heavy", heavy, "p0/k = "),
    ] {
        std::fs::write(folder.join("bad.toml"), case).unwrap();
        let output = railcrack(&folder, &["shakedown", "bad.toml", "--out", name]);
        assert_eq!(output.status.code(), Some(2), "{name}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{name}: {}", stderr(&output));
        assert_eq!(stdout(&output), "", "{name}");
        assert!(!folder.join(name).exists(), "{name} wrote a folder");
    }
}

/// Two wheels with patches at lateral places, each beyond first yield.
const MIX: &str = "\
title = \"Mix\"
[[wheel]]
name = \"inside\"
share = 0.4
contact = { peak_pressure_mpa = 1300.0, half_width_mm = 6.0, lateral_half_width_mm = 6.0, lateral_mm = 2.0, friction = 0.1 }
[[wheel]]
name = \"outside\"
share = 0.6
contact = { peak_pressure_mpa = 1200.0, half_width_mm = 6.0, lateral_half_width_mm = 6.0, lateral_mm = -4.0, friction = 0.1 }
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 15.0
friction = 0.5
";

/// Wheels roll in turn at their places, or the heaviest alone; the profile is that of any lateral
/// place, and its resultant across the rail vanishes.
#[test]
fn wheels_of_a_mix_roll_in_turn_or_alone() {
    let folder = common::folder("shakedown-command", "shakedown-mix");
    let lateral = |run: &str| -> Vec<f64> {
        let (header, rows) = table(&folder.join(run).join("section.csv"));
        let of = |name: &str| header.split(',').position(|own| own == name).unwrap();
        let (lateral, strain) = (of("y_mm"), of("plastic_per_pass"));
        rows.iter().filter(|row| row[strain] > 0.0).map(|row| row[lateral]).collect()
    };
    let ends = |places: &[f64]| {
        let of = |pick: fn(f64, f64) -> f64| places.iter().copied().reduce(pick).unwrap();
        [of(f64::min), of(f64::max)]
    };
    for (name, wheels, ended) in [("turn", "in turn", 2), ("alone", "heaviest", 1)] {
        let case = format!("{MIX}[shakedown]\nwheels = \"{wheels}\"\nmax_passes = {ended}\n");
        std::fs::write(folder.join("mix.toml"), case).unwrap();
        let output = railcrack(&folder, &["shakedown", "mix.toml", "--out", name, "--lateral", "1.5"]);
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        let says = if ended == 2 { "under 2 wheels in turn" } else { "under the wheel \"inside\" alone" };
        assert!(stdout(&output).contains(says), "{}", stdout(&output));
        let (header, profile) = table(&folder.join(name).join("profile.csv"));
        let of = |name: &str| header.split(',').position(|own| own == name).unwrap();
        let (depth, across) = (of("depth_mm"), of("szz_mpa"));
        // Layers lie between the middles of their neighbours' borders: their borders from the
        // surface.
        let (mut top, mut sum, mut size) = (0.0, 0.0, 0.0);
        for row in &profile {
            let thickness = 2.0 * (row[depth] - top);
            sum += thickness * row[across];
            size += thickness * row[across].abs();
            top += thickness;
        }
        // What lies below the layers carries the rest.
        assert!(sum.abs() < 0.08 * size, "{name}: {sum} of {size}");
    }
    let [turn, alone] = ["turn", "alone"].map(|run| ends(&lateral(run)));
    // The second wheel yields further out, on its side only.
    assert!(turn[0] < alone[0] - 4.0 && (turn[1] - alone[1]).abs() < 1.0, "{turn:?} {alone:?}");
}
