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
    assert!(volumes.iter().all(|volume| *volume >= 0.0) && largest(&volumes) > 1e-4);
    let page = read(&folder.join("trapped/report.html"));
    assert!(page.contains("none is lost sideways") && page.contains("Fluid in the cracks"));
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
    assert!(told.contains("buried cracks are filled from the start"), "{told}");
}

const LEAKING: &str = "[fluid]\nmodel = \"trapped\"\nbulk_modulus_mpa = 2200\n";

#[test]
fn a_killed_run_with_fluid_resumes_to_the_same_files() {
    let folder = common::folder("fluid", "killed");
    let case = CRACK.replace("steps = 1", "steps = 4");
    std::fs::write(folder.join("wet.toml"), format!("{case}{LEAKING}")).unwrap();
    done(&folder, &["run", "wet.toml", "--out", "whole", "--quiet"]);
    common::killed_run(&folder, ("wet.toml", "killed"), 2);
    done(&folder, &["run", "wet.toml", "--out", "killed", "--quiet", "--resume"]);
    for file in ["sif.csv", "growth.csv", "faces.csv"] {
        assert!(read(&folder.join("whole").join(file)) == read(&folder.join("killed").join(file)), "{file}");
    }
}

/// Two wheels over one wet crack: each has the history of its own run, and the rate is their sum.
#[test]
fn a_mix_of_wheels_over_a_wet_crack() {
    let folder = common::folder("fluid", "mix");
    let (head, tail) = CRACK.split_once("[[crack]]").unwrap();
    let contact = |friction: &str| head.replace("friction = -0.2", friction);
    let wheels = ["friction = -0.2", "friction = 0.1"];
    let mix = wheels.map(|friction| {
        format!("[[wheel]]\nshare = 0.5\n{}", contact(friction).replace("[contact]", "[wheel.contact]"))
    });
    std::fs::write(folder.join("mix.toml"), format!("{}[[crack]]{tail}{LEAKING}", mix.concat())).unwrap();
    done(&folder, &["run", "mix.toml", "--steps", "0", "--quiet"]);
    let of = |name: &str, key: &str| numbers(&folder.join(name).join("sif.csv"), key);
    let of_wheel = of("mix", "wheel");
    let mut rates = 0.0;
    for (i, friction) in wheels.iter().enumerate() {
        let name = format!("alone-{i}");
        let case = format!("{}[[crack]]{tail}{LEAKING}", contact(friction));
        std::fs::write(folder.join(format!("{name}.toml")), case).unwrap();
        done(&folder, &["run", &format!("{name}.toml"), "--steps", "0", "--quiet"]);
        for key in ["ki_mpa_sqrt_m", "kii_mpa_sqrt_m", "fluid_mpa", "fluid_mm2"] {
            let all = of("mix", key).into_iter().zip(&of_wheel);
            let own: Vec<f64> = all.filter(|(_, wheel)| **wheel == (i + 1) as f64).map(|(v, _)| v).collect();
            assert_eq!(own, of(&name, key), "wheel {}: {key}", i + 1);
        }
        rates += 0.5 * numbers(&folder.join(&name).join("growth.csv"), "rate_mm_per_cycle")[0];
    }
    // Its direction is the best of the mix, and of no wheel better than its own.
    let rate = numbers(&folder.join("mix/growth.csv"), "rate_mm_per_cycle")[0];
    assert!(rate <= rates * 1.000_001 && rate > 0.5 * rates, "{rate} {rates}");
}

/// A wet crack that is worn has the history of a crack of what is left of it.
#[test]
fn a_worn_crack_holds_less_water() {
    let folder = common::folder("fluid", "worn");
    let straight = CRACK
        .replace("steps = 1", "steps = 4\ndirection = \"coplanar\"")
        .replace("length_mm = 4.0", "length_mm = 6.0");
    let wear = "[traffic]\naxle_load_t = 20.0\n[maintenance]\nwear_mm_per_mgt = 30.0\n";
    std::fs::write(folder.join("worn.toml"), format!("{straight}{LEAKING}{wear}")).unwrap();
    done(&folder, &["run", "worn.toml", "--quiet"]);
    let table = folder.join("worn/growth.csv");
    let last = |key: &str| *numbers(&table, key).last().unwrap();
    let (length, removed) = (last("length_mm"), last("removed_mm"));
    assert!(removed > 0.05, "{removed}");
    let fresh = straight
        .replace("length_mm = 6.0", &format!("length_mm = {length}"))
        .replace("steps = 4", "steps = 0");
    std::fs::write(folder.join("fresh.toml"), format!("{fresh}{LEAKING}")).unwrap();
    done(&folder, &["run", "fresh.toml", "--quiet"]);
    // Growth that waits for a whole segment makes the cut crack up to 4 % shorter, and its volume
    // goes with the square of the length.
    for (key, limit) in [("ki_mpa_sqrt_m", 4e-2), ("fluid_mpa", 4e-2), ("fluid_mm2", 8e-2)] {
        let largest = |name: &str, step: f64| {
            let file = folder.join(name).join("sif.csv");
            let rows = numbers(&file, key).into_iter().zip(numbers(&file, "step"));
            rows.filter(|row| row.1 == step).map(|row| row.0).fold(0.0, f64::max)
        };
        let (worn, fresh) = (largest("worn", last("step")), largest("fresh", 0.0));
        assert!((worn / fresh - 1.0).abs() < limit, "{key}: {worn} {fresh}");
    }
}

/// A fluid that is softer than a gas has no answer that K could follow.
#[test]
fn the_softest_fluid_is_computed_and_a_softer_one_refused() {
    let folder = common::folder("fluid", "softest");
    let fluid = "[fluid]\nmodel = \"trapped\"\nbulk_modulus_mpa = ";
    let largest = run(&folder, "softest", &format!("{fluid}10.0\n"), "newton");
    assert!(largest.iter().all(|k| k.abs() < 100.0));
    std::fs::write(folder.join("gas.toml"), format!("{CRACK}{fluid}1e-3\n")).unwrap();
    let refused = common::ends(&folder, &["check", "gas.toml"], 2);
    assert!(common::stderr(&refused).contains("must be a number in [10, inf] MPa"));
}
