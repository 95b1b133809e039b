//! Mixed traffic: direction, fluid, track and temperature of each wheel.

use super::common::{column, done, folder, numbers, read};
use serde_json::Value;
use std::path::Path;

const RAIL: &str = "\
[passage]
positions = 41
[mesh]
interface_elements = 10
[growth]
steps = 1
[solver]
engine = \"dislocation\"
";
const CRACK: &str = "[[crack]]\nmouth_mm = 0.0\nlength_mm = 4.0\nangle_deg = 30.0\nfriction = 0.3\n";
const LOADED: &str = "contact = { peak_pressure_mpa = 900.0, half_width_mm = 6.75, friction = 0.3 }\n";
const EMPTY: &str = "contact = { peak_pressure_mpa = 700.0, half_width_mm = 5.0, friction = -0.2 }\n";
const COLD: &str = "temperature = { rail_c = -15.0, neutral_c = 25.0 }\n";
const TRACK: &str = "track = { section = \"60E1\", wheel_load_kn = 100.0, axles_mm = [0.0, -1800.0] }\n";
const WET: &str = "fluid = { model = \"trapped\" }\n";

/// Round-off of K, relative to its largest value.
const ROUND_OFF: f64 = 1e-9;

fn wheel(share: f64, text: &str) -> String {
    format!("[[wheel]]\nshare = {share}\n{text}")
}

/// The run of `text` in `place/name`.
fn run(place: &Path, name: &str, text: &str) -> std::path::PathBuf {
    std::fs::write(place.join(format!("{name}.toml")), text).unwrap();
    done(place, &["run", &format!("{name}.toml"), "--quiet", "--force", "--out", name]);
    place.join(name)
}

/// The rows of `sif.csv` of the column `name` under `wheel` in step 0.
fn under(run: &Path, wheel: usize, name: &str) -> Vec<String> {
    let (wheels, steps) = (column(&run.join("sif.csv"), "wheel"), column(&run.join("sif.csv"), "step"));
    let values = column(&run.join("sif.csv"), name).into_iter().zip(wheels.iter().zip(steps));
    values.filter(|(_, (own, step))| **own == wheel.to_string() && step == "0").map(|(v, _)| v).collect()
}

/// The rows of step 0 of a run under one wheel.
fn alone(run: &Path, name: &str) -> Vec<String> {
    let steps = column(&run.join("sif.csv"), "step");
    column(&run.join("sif.csv"), name)
        .into_iter()
        .zip(steps)
        .filter(|(_, s)| s == "0")
        .map(|(v, _)| v)
        .collect()
}

fn assert_opposite(one: &Path, other: &Path, column: &str, sign: f64) {
    let (one, other) = (numbers(&one.join("sif.csv"), column), numbers(&other.join("sif.csv"), column));
    assert!(one.len() == other.len() && one.len() > 200, "{} {}", one.len(), other.len());
    let peak = one.iter().fold(0.0_f64, |peak, value| peak.max(value.abs()));
    let apart = one.iter().zip(&other).map(|(a, b)| (a - sign * b).abs()).fold(0.0, f64::max);
    assert!(peak > 1.0 && apart < ROUND_OFF * peak, "{column}: {apart} of {peak}");
}

/// A network in the mirror, under wheels that run the other way, with the axles of the train.
#[test]
fn a_mirrored_mix_has_mirrored_sifs() {
    let place = folder("traffic", "mirror");
    let second = "[[crack]]\nmouth_mm = 9.0\nlength_mm = 3.0\nangle_deg = 50.0\nfriction = 0.2\n";
    let carter = "contact = { kind = \"carter\", peak_pressure_mpa = 800.0, half_width_mm = 6.0, friction = 0.4, traction = 0.6 }\n";
    let there = format!(
        "{RAIL}{CRACK}{second}{}{}",
        wheel(0.6, &format!("direction = \"+x\"\n{LOADED}{TRACK}")),
        wheel(0.4, &format!("direction = \"-x\"\n{carter}{COLD}"))
    );
    let back = there
        .replace("mouth_mm = 9.0", "mouth_mm = -9.0")
        .replace("angle_deg = 30.0", "angle_deg = 150.0")
        .replace("angle_deg = 50.0", "angle_deg = 130.0")
        .replace("\"+x\"", "\"=x\"")
        .replace("\"-x\"", "\"+x\"")
        .replace("\"=x\"", "\"-x\"")
        .replace("half_width_mm = 6.75, friction = 0.3", "half_width_mm = 6.75, friction = -0.3")
        .replace("traction = 0.6", "traction = -0.6")
        .replace("-1800.0", "1800.0");
    let (there, back) = (run(&place, "there", &there), run(&place, "back", &back));
    assert_opposite(&there, &back, "ki_mpa_sqrt_m", 1.0);
    assert_opposite(&there, &back, "kii_mpa_sqrt_m", -1.0);
    assert_opposite(&there, &back, "xc_mm", -1.0);
    // The second wheel starts beyond the crack that it meets first.
    let first = |run: &Path, wheel: usize| under(run, wheel, "xc_mm")[0].parse::<f64>().unwrap();
    assert_eq!(first(&there, 2), 9.0 + 6.0 * 6.0);
    let rates = [&there, &back].map(|run| numbers(&run.join("growth.csv"), "rate_mm_per_cycle"));
    assert!(rates[0].iter().zip(&rates[1]).all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{rates:?}");
}

/// A mix of one wheel, and two wheels that run against [passage] or with it.
#[test]
fn a_mix_of_one_wheel_is_the_wheel() {
    let place = folder("traffic", "one");
    let plain =
        format!("[contact]\n{}\n", LOADED.replace("contact = { ", "").replace(" }", "").replace(", ", "\n"));
    let plain = run(&place, "plain", &format!("{plain}{RAIL}{CRACK}"));
    let one = format!("{RAIL}{CRACK}{}", wheel(1.0, &format!("direction = \"+x\"\n{LOADED}")));
    let backward = RAIL.replace("[passage]\n", "[passage]\nfrom_over_a = 6.0\nto_over_a = -6.0\n");
    let against = format!("{backward}{CRACK}{}", wheel(1.0, &format!("direction = \"+x\"\n{LOADED}")));
    for (name, text) in [("one", one), ("against", against)] {
        let mix = run(&place, name, &text);
        for column_of in ["xc_mm", "ki_mpa_sqrt_m", "kii_mpa_sqrt_m"] {
            let [mixed, plain] = [&mix, &plain].map(|run| column(&run.join("sif.csv"), column_of));
            assert!(mixed == plain && mixed.len() > 80, "{name}: {column_of}");
        }
        for column_of in ["rate_mm_per_cycle", "load_cycles", "tip_x_mm", "tip_y_mm"] {
            let [mixed, plain] = [&mix, &plain].map(|run| column(&run.join("growth.csv"), column_of));
            assert!(mixed == plain && mixed.len() == 2, "{name}: {column_of}");
        }
    }
}

/// Each wheel has its own fluid, temperature and track: K under it is that of a run with them, and
/// rates add by share.
#[test]
fn each_wheel_has_its_own_fluid_temperature_and_track() {
    let place = folder("traffic", "own");
    let alone_of = |name: &str, text: &str| run(&place, name, &format!("{RAIL}{CRACK}{}", wheel(1.0, text)));
    let kinds = [
        ("wet", format!("{EMPTY}{WET}")),
        ("cold", format!("{LOADED}{COLD}fluid = false\n")),
        ("bent", format!("{LOADED}{TRACK}fluid = false\n")),
    ];
    let shares = [0.2, 0.3, 0.5];
    let runs: Vec<_> = kinds.iter().map(|(name, text)| alone_of(name, text)).collect();
    let mixed: String = kinds.iter().zip(shares).map(|((_, text), share)| wheel(share, text)).collect();
    let mix = run(&place, "mix", &format!("{RAIL}{CRACK}{mixed}"));
    let mut sum = 0.0;
    for (i, (own, share)) in runs.iter().zip(shares).enumerate() {
        for name in ["xc_mm", "ki_mpa_sqrt_m", "kii_mpa_sqrt_m"] {
            assert!(under(&mix, i + 1, name) == alone(own, name), "wheel {}: {name}", i + 1);
        }
        sum += share * numbers(&own.join("growth.csv"), "rate_mm_per_cycle")[0];
    }
    let rate = numbers(&mix.join("growth.csv"), "rate_mm_per_cycle")[0];
    assert!((rate / sum - 1.0).abs() < 1e-12, "{rate} {sum}");
    assert_eq!(under(&mix, 1, "fluid_mpa"), alone(&runs[0], "fluid_mpa"));
    assert!(under(&mix, 2, "fluid_mpa").iter().all(String::is_empty), "dry under the second wheel");
    // Without the words of its own, a wheel has the fluid of the case.
    let common = format!(
        "{RAIL}{CRACK}[fluid]\nmodel = \"trapped\"\n{}{}",
        wheel(0.5, EMPTY),
        wheel(0.5, &kinds[1].1)
    );
    let common = run(&place, "common", &common);
    assert_eq!(under(&common, 1, "ki_mpa_sqrt_m"), alone(&runs[0], "ki_mpa_sqrt_m"));
    assert_eq!(under(&common, 2, "ki_mpa_sqrt_m"), alone(&runs[1], "ki_mpa_sqrt_m"));
}

/// The rail breaks under the wheel that passes in the cold, with the toughness of that temperature.
#[test]
fn the_rail_breaks_under_the_cold_wheel() {
    let place = folder("traffic", "fracture");
    let toughness = "temperature_c,toughness_mpa_sqrt_m\n-15.0,16.0\n20.0,60.0\n";
    std::fs::write(place.join("toughness.csv"), toughness).unwrap();
    let rail = RAIL.replace("steps = 1", "steps = 40");
    let warm = "temperature = { rail_c = 20.0, neutral_c = 25.0 }\n";
    let text = format!(
        "{rail}{CRACK}[temperature]\nrail_c = 20.0\nneutral_c = 25.0\n[fracture]\nprofile = \"toughness.csv\"\ncriterion = \"k1\"\n{}{}",
        wheel(0.7, &format!("{LOADED}{warm}")),
        wheel(0.3, &format!("{LOADED}{COLD}"))
    );
    let broken = run(&place, "mixed", &text);
    let summary: Value = serde_json::from_str(&read(&broken.join("summary.json"))).unwrap();
    assert_eq!(summary["stop"], "fracture");
    // k1 of the cold wheel alone, at the same step, reaches the toughness in the cold.
    let share = summary["fracture"]["of_toughness"].as_f64().unwrap();
    let [k1, limit] = ["largest_k1_mpa_sqrt_m", "toughness_mpa_sqrt_m"]
        .map(|key| summary["fracture"][key].as_f64().unwrap());
    assert!((0.99..1.02).contains(&share), "{share}");
    assert!((k1 / 16.0 - share).abs() < 1e-9 && limit == 16.0, "{k1} of {limit}");
}

/// Wheels of a case in space may run either way; fluid is refused there.
#[test]
fn in_space_a_wheel_may_run_either_way() {
    let place = folder("traffic", "space");
    let text = |angle: f64, [one, other]: [&str; 2], sign: f64| {
        let wheel = |share: f64, direction: &str, friction: f64| {
            wheel(
                share,
                &format!(
                    "direction = \"{direction}\"\nfluid = false\ncontact = {{ peak_pressure_mpa = 900.0, half_width_mm = 6.0, lateral_half_width_mm = 5.0, friction = {friction} }}\n"
                ),
            )
        };
        format!(
            "[passage]\npositions = 15\nmax_passages = 2\n[mesh]\nspace_cells = 2\nspace_rings = 3\n[growth]\nsteps = 0\n[solver]\nengine = \"space\"\n\
             [[crack]]\nmouth_mm = 0.0\nlength_mm = 3.0\nangle_deg = {angle}\nsurface_half_length_mm = 4.0\nfriction = 0.3\n{}{}",
            wheel(0.5, one, sign * 0.3),
            wheel(0.5, other, sign * 0.1)
        )
    };
    let there = run(&place, "there", &text(30.0, ["+x", "-x"], 1.0));
    let back = run(&place, "back", &text(150.0, ["-x", "+x"], -1.0));
    let k = |run: &Path, wheel: usize, name: &str, reversed: bool| {
        // In the mirror the front is walked along from the other end.
        let (tips, values) = (under(run, wheel, "tip"), under(run, wheel, name));
        let mut by_tip: std::collections::BTreeMap<i64, Vec<f64>> = std::collections::BTreeMap::new();
        for (tip, value) in tips.iter().zip(values) {
            by_tip.entry(tip.parse().unwrap()).or_default().push(value.parse().unwrap());
        }
        let mut all: Vec<Vec<f64>> = by_tip.into_values().collect();
        if reversed {
            all.reverse();
        }
        all.concat()
    };
    for wheel in [1, 2] {
        for (name, sign) in [("ki_mpa_sqrt_m", 1.0), ("kii_mpa_sqrt_m", -1.0)] {
            let (a, b) = (k(&there, wheel, name, false), k(&back, wheel, name, false));
            let c = k(&back, wheel, name, true);
            let peak = a.iter().fold(0.0_f64, |peak, value| peak.max(value.abs()));
            let apart = |b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - sign * b).abs()).fold(0.0, f64::max);
            let apart = apart(&b).min(apart(&c));
            assert!(peak > 0.1 && apart < 1e-6 * peak, "wheel {wheel}, {name}: {apart} of {peak}");
        }
    }
}
