//! How much a run computes, without a clock: a change that costs more passages, load steps or
//! solutions of the contact fails here, one that saves some has its numbers noted.

use super::common::{self, DISLOCATION_CASE, QUICK_CASE, done};

/// Counts may be off by so much: the last digits of a processor move an event.
const MARGIN: f64 = 0.1;

/// Passages, load steps, solutions of the contact and iterations of all of them.
type Counts = [f64; 4];

fn counts(name: &str, case: &str) -> Counts {
    let folder = common::folder("counts", name);
    std::fs::write(folder.join("case.toml"), case).unwrap();
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let summary: serde_json::Value =
        serde_json::from_str(&common::read(&folder.join("run/summary.json"))).unwrap();
    let number = |key: &str| summary[key].as_f64().unwrap();
    let passages = summary["passages_per_step"].as_array().unwrap();
    let solves = number("contact_solves");
    [
        passages.iter().map(|own| own.as_f64().unwrap()).sum(),
        number("substeps"),
        solves,
        solves * number("contact_iterations_mean"),
    ]
}

#[test]
fn runs_compute_no_more_than_they_did() {
    let dislocations = DISLOCATION_CASE.as_str();
    let patch = dislocations.replace(
        "peak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\n",
        "wheel_load_kn = 83.0\nwheel_radius_mm = 460.0\nrail_head_radius_mm = 300.0\n",
    );
    let four = "count = 4\nspacing_mm = 10.0\nlength_mm = 6.0";
    let groups = dislocations.replace("length_mm = 6.0", four).replace("steps = 2", "steps = 0");
    let groups = format!("{groups}network = \"groups\"\n");
    let felt = dislocations.replace("friction = 0.3\n", "friction = 0.3\ncoupled = true\n");
    let wet = format!("{dislocations}\n[fluid]\nmodel = \"trapped\"\n");
    let space = dislocations
        .replace("\"dislocation\"", "\"space\"")
        .replace("interface_elements = 16", "space_cells = 3")
        .replace("length_mm = 6.0", "length_mm = 6.0\nsurface_half_length_mm = 6.0")
        .replace("half_width_mm = 6.75", "half_width_mm = 6.75\nlateral_half_width_mm = 6.75");
    let known: [(&str, &str, Counts); 7] = [
        ("finite elements", QUICK_CASE, [6.0, 45.0, 297.0, 297.0]),
        ("dislocations", dislocations, [6.0, 50.0, 242.0, 242.0]),
        ("patch", &patch, [8.0, 158.0, 471.0, 471.0]),
        ("groups", &groups, [2.0, 0.0, 17_380.0, 17_380.0]),
        ("felt", &felt, [6.0, 49.0, 247.0, 250.0]),
        ("wet", &wet, [6.0, 87.0, 282.0, 282.0]),
        ("space", &space, [6.0, 742.0, 1000.0, 3232.0]),
    ];
    let mut off = String::new();
    for (name, case, noted) in known {
        let own = counts(name, case);
        if own.iter().zip(noted).any(|(own, noted)| (own - noted).abs() > MARGIN * noted) {
            off += &format!("{name}: {own:.0?}, noted {noted:.0?}\n");
        }
    }
    assert!(off.is_empty(), "{off}");
}
