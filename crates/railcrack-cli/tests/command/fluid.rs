//! Water in the cracks, from the case file to the tables, the page and the study.

use super::common::{self, done, numbers, read};
use std::path::Path;

/// A quick crack under a driven wheel.
const CRACK: &str = "\
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = -0.2
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 25.0
friction = 0.1
[passage]
positions = 121
[growth]
steps = 1
[solver]
engine = \"dislocation\"
";

fn run(folder: &Path, name: &str, fluid: &str, contact: &str) -> Vec<f64> {
    std::fs::write(folder.join(format!("{name}.toml")), format!("{CRACK}{fluid}")).unwrap();
    done(folder, &["run", &format!("{name}.toml"), "--quiet", "--contact", contact]);
    numbers(&folder.join(name).join("sif.csv"), "ki_mpa_sqrt_m")
}

#[test]
fn the_models_of_the_fluid_stand_beside_each_other() {
    let folder = common::folder("fluid", "models");
    let largest = |k: &[f64]| k.iter().fold(0.0f64, |m, v| m.max(*v));
    let dry = run(&folder, "dry", "", "newton");
    let none = run(&folder, "none", "[fluid]\nmodel = \"none\"\n", "newton");
    assert_eq!(dry, none);
    assert!(!read(&folder.join("dry/sif.csv")).contains("fluid"));
    let trapped = run(&folder, "trapped", "[fluid]\nmodel = \"trapped\"\n", "newton");
    let latin = run(&folder, "latin", "[fluid]\nmodel = \"trapped\"\n", "latin");
    let capped = run(&folder, "capped", "[fluid]\nmodel = \"mouth\"\npressure_cap_mpa = 200\n", "newton");
    assert!(largest(&trapped) > 1.5 * largest(&dry), "{} {}", largest(&trapped), largest(&dry));
    assert!(largest(&capped) > largest(&dry));
    let apart = trapped.iter().zip(&latin).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-5 * largest(&trapped), "{apart}");
    let header = read(&folder.join("trapped/sif.csv"));
    assert!(header.contains("kii_mpa_sqrt_m,fluid_mpa,fluid_mm2\n"));
    let pressures = numbers(&folder.join("capped/sif.csv"), "fluid_mpa");
    assert_eq!(largest(&pressures), 200.0);
    let volumes = numbers(&folder.join("trapped/sif.csv"), "fluid_mm2");
    assert!(volumes.iter().all(|volume| *volume > -1e-6) && largest(&volumes) > 1e-4);
    let page = read(&folder.join("trapped/report.html"));
    assert!(page.contains("a bound from above") && page.contains("Water in the cracks"));
    assert!(folder.join("trapped/plots/fluid.svg").exists() && !folder.join("dry/plots/fluid.svg").exists());
}

#[test]
fn a_buried_crack_says_that_its_fluid_was_there_from_the_beginning() {
    let folder = common::folder("fluid", "buried");
    let buried = CRACK.replace(
        "mouth_mm = 0.0\nlength_mm = 4.0\nangle_deg = 25.0\n",
        "points_mm = [[0.0, -3.0], [4.0, -5.0]]\n",
    );
    std::fs::write(folder.join("buried.toml"), format!("{buried}[fluid]\nmodel = \"trapped\"\n")).unwrap();
    let told = done(&folder, &["check", "buried.toml"]);
    assert!(told.contains("buried cracks hold theirs from the beginning"), "{told}");
}
