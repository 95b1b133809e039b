//! Loads from the case file to the tables: partial slip, tables, track, temperature, fracture.

use super::common;
use super::common::{done, ends, railcrack, read, stdout};
use std::path::{Path, PathBuf};

/// A quick case without a contact.
const CRACK: &str = "\
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 40.0
friction = 0.2
[passage]
positions = 61
[growth]
steps = 0
[solver]
engine = \"dislocation\"
[mesh]
interface_elements = 24
";

const SIZE: &str = "peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\n";

fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases").join(name)
}

/// The table `sif.csv` of the run of `contact` over the quick crack.
fn histories(folder: &Path, name: &str, contact: &str) -> String {
    std::fs::write(folder.join(format!("{name}.toml")), format!("[contact]\n{contact}\n{CRACK}")).unwrap();
    ends(folder, &["run", &format!("{name}.toml"), "--quiet"], 0);
    read(&folder.join(name).join("sif.csv"))
}

/// x_c (mm), K_I and K_II of the last passage of the first step.
fn numbers(table: &str) -> Vec<[f64; 3]> {
    let mut lines = table.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|value| value.parse().unwrap()).collect()).collect();
    let column = |name: &str| names.iter().position(|other| *other == name).unwrap();
    let last = rows.last().unwrap()[column("passage")];
    let columns = ["xc_mm", "ki_mpa_sqrt_m", "kii_mpa_sqrt_m"].map(column);
    rows.iter().filter(|row| row[column("passage")] == last).map(|row| columns.map(|c| row[c])).collect()
}

fn apart(one: &[[f64; 3]], other: &[[f64; 3]]) -> f64 {
    assert_eq!(one.len(), other.len());
    let peak = one.iter().flat_map(|row| &row[1..]).fold(0.0f64, |peak, k| peak.max(k.abs()));
    let pairs = one.iter().zip(other).flat_map(|(a, b)| [(a[1] - b[1]).abs(), (a[2] - b[2]).abs()]);
    pairs.fold(0.0, f64::max) / peak
}

#[test]
fn partial_slip_ends_in_sliding_and_in_pressure_alone() {
    let folder = common::folder("loads", "partial-slip");
    let carter =
        |traction: f64| format!("kind = \"carter\"\n{SIZE}friction = 0.3\ntraction = {traction:?}\n");
    let hertz = |friction: f64| format!("{SIZE}friction = {friction:?}\n");
    for (traction, friction) in [(1.0, 0.3), (-1.0, -0.3), (0.0, 0.0)] {
        let partial = histories(&folder, &format!("carter{traction}"), &carter(traction));
        assert_eq!(partial, histories(&folder, &format!("hertz{friction}"), &hertz(friction)));
    }
    let half = numbers(&histories(&folder, "half", &carter(0.5)));
    let same_shear = numbers(&histories(&folder, "same-shear", &hertz(0.15)));
    assert!(apart(&half, &same_shear) > 0.1, "partial slip is no sliding with the same shear force");
}

#[test]
fn a_table_of_an_ellipse_is_the_ellipse() {
    let folder = common::folder("loads", "table");
    let mut text = "# half-ellipse\nu_mm,p_mpa,q_mpa\n".to_owned();
    for i in 0..=400 {
        let u = -6.75 * (std::f64::consts::PI * f64::from(i) / 400.0).cos();
        let p = if i % 400 == 0 { 0.0 } else { 422.5 * (1.0 - (u / 6.75).powi(2)).sqrt() };
        text += &format!("{u},{p},{}\n", -0.2 * p);
    }
    std::fs::write(folder.join("ellipse.csv"), text).unwrap();
    let table = "kind = \"table\"\nprofile = \"ellipse.csv\"\nscale = 2.0\nfriction = 0.2\n";
    let table = numbers(&histories(&folder, "table", table));
    let hertz = numbers(&histories(&folder, "hertz", &format!("{SIZE}friction = -0.2\n")));
    // Chords of 400 pieces, even in the angle: (π/400)²/12 of the pressure.
    assert!(apart(&table, &hertz) < 1e-4, "{:e}", apart(&table, &hertz));
    // The run folder is complete without the table.
    std::fs::remove_file(folder.join("ellipse.csv")).unwrap();
    ends(&folder, &["check", "table/case.toml"], 0);
}

#[test]
fn the_passage_of_a_rail_that_bends_has_rows_far_away() {
    let folder = common::folder("loads", "bending");
    let more = "[track]\nwheel_load_kn = 100.0\nsection = \"60E1\"\n[temperature]\nrail_c = -5.0\nneutral_c = 25.0\n";
    let contact = format!("{SIZE}friction = 0.025\n{more}");
    let rows = numbers(&histories(&folder, "winter", &contact));
    let shown = stdout(&railcrack(&folder, &["check", "winter.toml"]));
    assert!(shown.contains(&format!("{} output positions in all", rows.len())), "{shown}");
    assert!(shown.contains("length 1 / beta      845.2 mm"), "{shown}");
    assert!(shown.contains("sigma_xx             72.45 MPa"), "{shown}");
    let most = rows.iter().copied().reduce(|most, row| if row[1] > most[1] { row } else { most }).unwrap();
    // β s = π/2 of 60E1 on 50 MPa, and neither engine nor friction move it.
    assert!((most[0].abs() - 1327.715).abs() < 0.01, "{most:?}");
    let near = rows.iter().filter(|row| row[0].abs() <= 40.5 + 1e-9).map(|row| row[1]).fold(0.0, f64::max);
    assert!(most[1] > 5.0 * near, "{most:?} {near}");
    let summary: serde_json::Value =
        serde_json::from_str(&read(&folder.join("winter/summary.json"))).unwrap();
    assert!(summary["fracture"]["largest_k1_mpa_sqrt_m"].as_f64().unwrap() >= most[1]);
    assert_eq!(summary["fracture"]["of_toughness"], serde_json::Value::Null);
    let page = read(&folder.join("winter/report.html"));
    assert!(page.contains("The whole passage, in metres") && page.contains("ki-far"));
    assert_eq!(read(&folder.join("winter/plots/ki.svg")).matches("Wheel position").count(), 2);
}

#[test]
fn shipped_loads_run_and_say_what_came_out() {
    let folder = common::folder("loads", "shipped");
    let run = |name: &str| {
        let case = shipped(&format!("{name}.toml"));
        let output = ends(&folder, &["run", case.to_str().unwrap(), "--out", name, "--quiet"], 0);
        let summary: serde_json::Value =
            serde_json::from_str(&read(&folder.join(name).join("summary.json"))).unwrap();
        (stdout(&output), summary)
    };
    let (text, summary) = run("winter-rail");
    assert!(text.starts_with("fracture at step "), "{text}");
    assert!(text.contains("with the wheel at -1.26 m, 100 % of the toughness"), "{text}");
    assert_eq!(summary["stop"], "fracture");
    let stops = common::column(&folder.join("winter-rail/growth.csv"), "stop");
    assert_eq!(stops.last().map(String::as_str), Some("fracture"));
    assert!(read(&folder.join("winter-rail/report.html")).contains("Fraction of the toughness"));
    let (text, summary) = run("driven-wheel");
    assert!(text.starts_with("steps-done at step 8, ") && !text.contains("warning"), "{text}");
    assert_eq!(summary["warnings"], serde_json::json!([]));
    let (text, _) = run("measured-contact");
    assert!(text.contains("warning, step 0: the peak pressure of 900 MPa is beyond first yield"), "{text}");
    let (_, summary) = run("rolling-contact");
    assert_eq!(summary["stop"], "steps-done");
}

#[test]
fn the_plastic_state_is_that_of_the_contact_whatever_it_is() {
    let folder = common::folder("loads", "shakedown");
    let partial = format!("[contact]\nkind = \"carter\"\n{SIZE}friction = 0.3\ntraction = 0.5\n{CRACK}");
    std::fs::write(folder.join("carter.toml"), &partial).unwrap();
    let output = ends(&folder, &["shakedown", "carter.toml"], 0);
    assert!(stdout(&output).contains("shakedown"), "{}", stdout(&output));
    let state: serde_json::Value =
        serde_json::from_str(&read(&folder.join("carter/shakedown.json"))).unwrap();
    assert_eq!((state["contact"].as_str(), state["friction"].as_f64()), (Some("carter"), Some(0.15)));
    let page = read(&folder.join("carter/report.html"));
    assert!(page.contains("in partial slip (Carter)") && page.contains("Q/P 0.15"));
    let winter = shipped("winter-rail.toml");
    done(&folder, &["shakedown", winter.to_str().unwrap(), "--out", "winter"]);
    let state: serde_json::Value =
        serde_json::from_str(&read(&folder.join("winter/shakedown.json"))).unwrap();
    let first = state["warnings"][0].as_str().unwrap();
    assert!(first.contains("of the contact stress only; bending and thermal stress are added"), "{first}");
}
