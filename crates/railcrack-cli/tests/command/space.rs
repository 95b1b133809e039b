//! Runs of a crack in space: files, resumption, the plane engines on the same case.

use super::common::{self, column, command, done, names, numbers, read};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Quick: few cells, few positions.
const CASE: &str = r#"
title = "Curved front"

[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.0
lateral_half_width_mm = 5.0
lateral_mm = 1.0
friction = 0.1

[passage]
from_over_a = -3.0
to_over_a = 3.0
positions = 13
step_tolerance = 0.05
max_passages = 2

[[crack]]
mouth_mm = 0.0
length_mm = 3.0
surface_half_length_mm = 4.0
angle_deg = 45.0
friction = 0.3

[growth]
steps = 2

[mesh]
space_cells = 2
space_rings = 2

[solver]
engine = "space"

[traffic]
axle_load_t = 20.0
"#;

fn workplace(name: &str) -> PathBuf {
    let folder = common::folder("space", name);
    fs::write(folder.join("case.toml"), CASE).unwrap();
    folder
}

#[test]
fn a_run_in_space_has_all_its_files() {
    let folder = workplace("files");
    assert!(done(&folder, &["check", "case.toml"]).contains("semi-axes            3 mm down the dip"));
    let told = done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    assert!(told.contains("semi-axes") && told.contains("steps-done at step 2"), "{told}");
    let run = folder.join("run");
    // Nine points of the front, three steps.
    let phi = numbers(&run.join("growth.csv"), "phi_deg");
    assert_eq!(phi.len(), 27);
    assert!((phi[4] - 90.0).abs() < 1e-9 && phi[0] == 0.0 && (phi[8] - 180.0).abs() < 1e-9, "{phi:?}");
    let of_step =
        |column: &str, step: usize| numbers(&run.join("growth.csv"), column)[9 * step..9 * step + 9].to_vec();
    let axes = |name: &str| (0..3).map(|step| of_step(name, step)[0]).collect::<Vec<f64>>();
    let (down, along) = (axes("length_mm"), axes("surface_half_length_mm"));
    assert!(down[0] == 3.0 && down[1] > down[0] && down[2] > down[1], "{down:?}");
    // Its sides are loaded less: they need not grow, but do not heal.
    assert!(along[0] == 4.0 && along[1] >= along[0] && along[2] >= along[1], "{along:?}");
    // The increments move the points by their normal: at the deepest one that is the semi-axis.
    let grown = of_step("length_mm", 1)[0] - 3.0;
    assert!((of_step("increment_mm", 0)[4] - grown).abs() < 1e-9);
    assert!(of_step("load_cycles", 2)[0] > of_step("load_cycles", 1)[0]);
    // The wheel at z = 1 mm loads the side of larger z more.
    let rates = of_step("rate_mm_per_cycle", 0);
    assert!(rates[2] > rates[6], "{rates:?}");
    let passages = numbers(&run.join("sif.csv"), "passage");
    let rows = passages.iter().filter(|passage| **passage == 1.0).count();
    assert_eq!((rows, column(&run.join("sif.csv"), "kiii_mpa_sqrt_m").len()), (3 * 9 * 13, passages.len()));
    assert!(numbers(&run.join("faces.csv"), "opening_mm").iter().all(|opening| *opening >= 0.0));
    for name in names(&run.join("fields")) {
        let text = read(&run.join("fields").join(&name));
        assert!(name.starts_with("crack-step-0000-position-"), "{name}");
        assert!(text.contains("jump_mm") && text.contains("kiii_mpa_sqrt_m"), "{name}");
    }
    for plot in ["ki.svg", "kii.svg", "kiii.svg", "along-front.svg", "paths.svg", "length-cycles.svg"] {
        assert!(read(&run.join("plots").join(plot)).starts_with("<svg"), "{plot}");
    }
    let summary = read(&run.join("summary.json"));
    assert!(summary.contains("\"front\"") && summary.contains("\"engine\": \"space\""));
    let page = read(&run.join("report.html"));
    assert!(page.contains("Seen from above") && page.contains("space-data"));
    done(&folder, &["report", "run"]);
    assert_eq!(read(&run.join("report.html")), page, "rebuilt bit for bit");
    done(&folder, &["verify", "run"]);
    // The same file in the plane: the strip over the middle of the crack.
    let plane = done(
        &folder,
        &["run", "case.toml", "--engine", "dislocation", "--steps", "0", "--out", "plane", "--quiet"],
    );
    assert!(plane.contains("crack 1 tip 1"), "{plane}");
}

#[test]
fn a_turned_crack_on_a_rail_that_bends() {
    let folder = workplace("turned");
    let case = CASE
        .replace("angle_deg = 45.0", "angle_deg = 45.0\nstrike_deg = 90.0")
        .replace("steps = 2", "steps = 1")
        .replace("positions = 13", "positions = 5")
        + "\n[track]\nwheel_load_kn = 100.0\nsection = \"60E1\"\n";
    fs::write(folder.join("case.toml"), &case).unwrap();
    assert!(done(&folder, &["check", "case.toml"]).contains("strike               90 degrees"));
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let run = folder.join("run");
    let of = |column: &str| numbers(&run.join("growth.csv"), column);
    // The mouth along the rail, the larger ζ at the smaller x; down towards +z.
    let (x, y, z) = (of("tip_x_mm"), of("tip_y_mm"), of("tip_z_mm"));
    let down = 3.0 * std::f64::consts::FRAC_1_SQRT_2;
    let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
    assert!(close(x[0], -4.0) && close(x[8], 4.0) && close(z[0], 0.0) && close(y[0], 0.0), "{x:?} {z:?}");
    assert!(close(x[4], 0.0) && close(z[4], down) && close(y[4], -down), "{x:?} {z:?}");
    assert!(z[13] > down && (9..18).all(|q| close(z[q], -y[q])), "it grows in its plane: {y:?} {z:?}");
    assert!(x[9] <= -4.0 && x[17] >= 4.0 && x[17] - x[9] > 8.0, "to both sides: {x:?}");
    let xc = numbers(&run.join("sif.csv"), "xc_mm");
    let (least, most) = xc.iter().fold((0.0f64, 0.0f64), |(a, b), x| (a.min(*x), b.max(*x)));
    assert!(least < -5000.0 && most > 5000.0, "{least} {most}");
    let page = read(&run.join("report.html"));
    assert!(page.contains("Track: axles 100 kN") && page.contains("The whole passage, in metres"));
    assert!(read(&run.join("plots/ki.svg")).contains("metres"));
    let plane = ["run", "case.toml", "--engine", "dislocation", "--out", "plane"];
    let refused = common::stderr(&common::ends(&folder, &plane, 2));
    assert!(refused.contains("strike_deg") && refused.contains("requires the space engine"), "{refused}");
}

#[test]
fn a_killed_run_goes_on_to_the_same_files() {
    let folder = workplace("resume");
    done(&folder, &["run", "case.toml", "--out", "whole", "--quiet"]);
    goes_on(&folder);
}

/// Kills a run of the case and resumes it: its files are those of the folder `whole`.
fn goes_on(folder: &Path) {
    let line = ["run", "case.toml", "--out", "parts", "--quiet"];
    let mut run = command(folder, &line).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let started = Instant::now();
    while !folder.join("parts/checkpoint.bin").exists() && run.try_wait().unwrap().is_none() {
        assert!(started.elapsed() < Duration::from_secs(120));
        std::thread::sleep(Duration::from_millis(2));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    done(folder, &["run", "case.toml", "--out", "parts", "--resume", "--quiet"]);
    for file in ["sif.csv", "growth.csv", "faces.csv", "case.toml", "fields.pvd", "plots/kii.svg"] {
        assert_eq!(read(&folder.join("whole").join(file)), read(&folder.join("parts").join(file)), "{file}");
    }
}

/// A row of two copies behind each other, and a crack beside them: its section crosses theirs.
fn several() -> String {
    CASE.replace("steps = 2", "steps = 2\nincrement = 0.04").replace("friction = 0.3\n", "friction = 0.3\ncount = 2\nspacing_mm = 3.0\n").replace(
        "[growth]",
        "[[crack]]\nmouth_mm = 3.5\nlength_mm = 2.0\nsurface_half_length_mm = 2.0\nangle_deg = 120.0\nfriction = 0.1\nlateral_mm = 8.0\n\n[growth]",
    )
}

#[test]
fn several_cracks_have_their_rows_and_resume() {
    let folder = workplace("several");
    fs::write(folder.join("case.toml"), several()).unwrap();
    assert!(done(&folder, &["check", "case.toml"]).contains("x = 3.5 mm, z = 8 mm"));
    let told = done(&folder, &["run", "case.toml", "--out", "whole", "--quiet"]);
    assert!(told.contains("crack 3: semi-axes"), "{told}");
    let run = folder.join("whole");
    let growth = |name: &str| numbers(&run.join("growth.csv"), name);
    // Nine points of each of three fronts, three steps.
    let (crack, tip) = (growth("crack"), growth("tip"));
    assert_eq!((crack.len(), crack[8], crack[9], crack[26]), (81, 1.0, 2.0, 3.0));
    assert_eq!((tip[8], tip[9], tip[26]), (9.0, 1.0, 9.0));
    let (length, increment) = (growth("length_mm"), growth("increment_mm"));
    for of_crack in 0..3 {
        let deepest = 9 * of_crack + 4;
        assert!((length[27 + deepest] - length[deepest] - increment[deepest]).abs() < 1e-9, "{of_crack}");
    }
    // The fastest of all grows by the increment, the others by less.
    let most = (0..3).map(|of_crack| length[27 + 9 * of_crack] / length[9 * of_crack]).fold(0.0, f64::max);
    assert!((most - 1.04).abs() < 1e-9, "{most}");
    assert_eq!(numbers(&run.join("faces.csv"), "crack").iter().copied().fold(0.0, f64::max), 3.0);
    let summary = read(&run.join("summary.json"));
    assert!(summary.contains("\"fronts\"") && summary.contains("\"front\""));
    for plot in ["ki.svg", "along-front.svg", "paths.svg", "length-cycles.svg"] {
        assert!(read(&run.join("plots").join(plot)).starts_with("<svg"), "{plot}");
    }
    done(&folder, &["verify", "whole"]);
    goes_on(&folder);
    // The plane takes no cracks whose sections cross.
    let plane = command(&folder, &["run", "case.toml", "--engine", "dislocation"]).output().unwrap();
    assert_eq!(plane.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&plane.stderr).contains("cross, touch or overlap"));
}

#[test]
fn a_study_takes_the_keys_of_space() {
    let folder = workplace("study");
    let study = CASE
        .replace("surface_half_length_mm = 4.0", "surface_half_length_mm = [3.0, 5.0]")
        .replace("steps = 2", "steps = 0");
    fs::write(folder.join("study.toml"), study).unwrap();
    done(&folder, &["sweep", "study.toml", "--out", "study", "--quiet"]);
    assert_eq!(column(&folder.join("study/summary.csv"), "state"), ["done", "done"]);
}

/// Two wheels on either side of the crack, the second one with water, and everything that a
/// decision takes.
fn maintained_mix() -> String {
    let wheel = |name: &str, lateral: f64, fluid: &str| {
        format!(
            "[[wheel]]\nname = \"{name}\"\nshare = 0.5\n[wheel.contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.0\n\
             lateral_half_width_mm = 4.0\nlateral_mm = {lateral}\nfriction = 0.1\n{fluid}"
        )
    };
    let contact = CASE.find("[contact]").unwrap()..CASE.find("[passage]").unwrap();
    let water = "[wheel.fluid]\nmodel = \"mouth\"\npressure_cap_mpa = 30.0\n";
    let wheels = wheel("left", -4.0, "") + &wheel("right", 4.0, water);
    CASE.replace(&CASE[contact], &wheels)
        .replace("positions = 13", "positions = 7")
        .replace("steps = 2", "steps = 2\nincrement = 0.1\nstop_after_cycles = 3.2e4")
        + r#"mgt_per_year = 20.0
[maintenance]
wear_mm_per_mgt = 0.01
grinding_mm = 0.1
grinding_interval_mgt = 0.3
[inspection]
detectable_depth_mm = 2.0
critical_depth_mm = 2.25
[scatter]
samples = 500
share_log_std = 0.2
"#
}

#[test]
fn a_mix_with_water_and_maintenance_ends_in_a_decision_and_names_its_places() {
    let folder = workplace("mix");
    fs::write(folder.join("case.toml"), maintained_mix()).unwrap();
    let told = done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    assert!(told.contains("verdict: ") && told.contains("left: 50.0 % of the axles"), "{told}");
    let run = folder.join("run");
    let of = |column: &str| numbers(&run.join("growth.csv"), column);
    let (left, right, phi) = (of("share_wheel_1"), of("share_wheel_2"), of("phi_deg"));
    // φ = 0 is the end of larger z.
    assert!(left.iter().zip(&right).all(|(a, b)| (a + b - 1.0).abs() < 1e-9), "{left:?} {right:?}");
    assert!((phi[2], phi[6]) == (45.0, 135.0) && right[2] > left[2] && left[6] > right[6], "{left:?}");
    assert!(of("removed_mm").last().is_some_and(|removed| *removed > 0.0));
    assert!(numbers(&run.join("sif.csv"), "fluid_mpa").iter().any(|pressure| *pressure > 0.0));
    let page = read(&run.join("report.html"));
    assert!(page.contains("wheels-along-front") && page.contains("z of its contact"), "{page}");
    let said = page.find("The front is grown most").map(|at| &page[at..at + 300]).unwrap_or_default();
    assert!(said.contains("by right at z = 4.0 mm") && said.contains("by left at z = −4.0 mm"), "{said}");
    done(&folder, &["verify", "run"]);
}

/// `case` with a head check that has turned down.
fn with_fold(case: &str) -> String {
    case.replace("mouth_mm = 0.0\nlength_mm = 3.0\n", "points_mm = [[0.0, 0.0], [2.7, -1.3], [3.3, -2.9]]\n")
        .replace("angle_deg = 45.0\n", "")
}

/// The folded crack under everything that a case may add but scatter, for which it would be
/// computed at ten speeds.
fn folded() -> String {
    with_fold(&maintained_mix())
        .replace("[scatter]\nsamples = 500\nshare_log_std = 0.2\n", "")
        .replace("critical_depth_mm = 2.25", "critical_depth_mm = 3.2\nultrasonic_depth_mm = 3.0")
        + "[fracture]\nsteel = \"R260\"\n[temperature]\nrail_c = -5.0\nneutral_c = 25.0\n"
}

#[test]
fn a_folded_crack_that_slips_while_it_is_closed_traps_no_fluid() {
    let folder = workplace("folded-trapped");
    let text = with_fold(CASE).replace("steps = 2", "steps = 0");
    let text = text.replace("friction = 0.1", "friction = -0.4");
    // Before the wheel arrives the rail bends, and the faces slip.
    let text = text + "[fluid]\nmodel = \"trapped\"\n[track]\nwheel_load_kn = 100.0\nsection = \"60E1\"\n";
    fs::write(folder.join("case.toml"), text).unwrap();
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let pressure = numbers(&folder.join("run/sif.csv"), "fluid_mpa");
    let (first, most) = (pressure[0], pressure.iter().copied().fold(0.0, f64::max));
    assert!(first == 0.0 && most > 1.0, "{first} {most}");
}

#[test]
fn a_crack_that_turns_has_all_its_files_and_a_decision() {
    let folder = workplace("turned-surface");
    let case = maintained_mix()
        .replace("increment = 0.1\n", "increment = 0.1\nsurface = \"turned\"\nturning_length_mm = 1.0\n")
        .replace("friction = 0.1\n", "friction = 0.4\n")
        .replace("[scatter]\nsamples = 500\nshare_log_std = 0.2\n", "")
        .replace("angle_deg = 45.0", "angle_deg = 30.0\nstrike_deg = 20.0");
    fs::write(folder.join("case.toml"), case).unwrap();
    let check = done(&folder, &["check", "case.toml"]);
    assert!(check.contains("turn about the direction of their mouths"), "{check}");
    let told = done(&folder, &["run", "case.toml", "--out", "whole", "--quiet"]);
    assert!(told.contains("verdict: "), "{told}");
    let run = folder.join("whole");
    let of = |column: &str| numbers(&run.join("growth.csv"), column);
    let (turn, down, length, phi) = (of("turn_deg"), of("down_mm"), of("length_mm"), of("phi_deg"));
    // The deepest point lies at the length of the crack.
    let deepest: Vec<usize> = (0..phi.len()).filter(|&row| (phi[row] - 90.0).abs() < 1e-9).collect();
    assert!(deepest.len() > 2 && deepest.iter().any(|&row| turn[row].abs() > 0.1), "{turn:?}");
    for row in deepest {
        assert!((down[row] - length[row]).abs() < 1e-6, "{row}: {down:?} {length:?}");
    }
    for name in names(&run.join("fields")) {
        assert!(read(&run.join("fields").join(&name)).contains("jump_mm"), "{name}");
    }
    let page = read(&run.join("report.html"));
    assert!(page.contains("from-the-side") && page.contains("without twist"), "{page}");
    done(&folder, &["report", "whole"]);
    assert_eq!(read(&run.join("report.html")), page, "rebuilt bit for bit");
    done(&folder, &["verify", "whole"]);
    goes_on(&folder);
}

#[test]
fn folded_cracks_may_be_several_and_lie_at_an_angle() {
    let folder = workplace("folded-several");
    let case = with_fold(CASE)
        .replace("steps = 2", "steps = 1")
        .replace("friction = 0.3\n", "friction = 0.3\nstrike_deg = 15.0\ncount = 2\nspacing_mm = 6.0\n");
    fs::write(folder.join("case.toml"), case).unwrap();
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let cracks = numbers(&folder.join("run/growth.csv"), "crack");
    assert!(cracks.contains(&1.0) && cracks.contains(&2.0), "{cracks:?}");
}

#[test]
fn a_folded_crack_has_all_its_files_and_a_decision() {
    let folder = workplace("folded");
    fs::write(folder.join("case.toml"), folded()).unwrap();
    let check = done(&folder, &["check", "case.toml"]);
    assert!(check.contains("to the fold          2.997 mm from the mouth, at 25.71 degrees"), "{check}");
    let told = done(&folder, &["run", "case.toml", "--out", "whole", "--quiet"]);
    assert!(told.contains("fold at ") && told.contains("has turned down, 2.90 mm deep"), "{told}");
    let run = folder.join("whole");
    let of = |column: &str| numbers(&run.join("growth.csv"), column);
    let (phi, depth, length) = (of("phi_deg"), of("depth_mm"), of("length_mm"));
    // Nine points of the branch between three on each side of the strip.
    let wanted = [-90.0, -60.0, -30.0, 0.0, 22.5, 45.0, 67.5, 90.0];
    let differ = phi.iter().zip(wanted).any(|(phi, want)| (phi - want).abs() > 1e-9);
    assert!(
        !differ && (phi[14] - 270.0).abs() < 1e-9 && depth[0] == 0.0 && (depth[7] - 2.9).abs() < 1e-9,
        "{phi:?}"
    );
    let path = (2.7f64.hypot(1.3) + 0.6f64.hypot(1.6), length[0]);
    assert!((path.0 - path.1).abs() < 1e-9 && length[15] != length[0], "{length:?}");
    for name in names(&run.join("fields")) {
        assert!(read(&run.join("fields").join(&name)).contains("jump_mm"), "{name}");
    }
    let page = read(&run.join("report.html"));
    assert!(page.contains("from-the-side") && page.contains("one branch"), "{page}");
    assert!(page.contains("it has turned down before the run"), "{page}");
    done(&folder, &["report", "whole"]);
    assert_eq!(read(&run.join("report.html")), page, "rebuilt bit for bit");
    done(&folder, &["verify", "whole"]);
    goes_on(&folder);
}
