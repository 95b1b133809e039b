//! `railcrack contact`: tables of patches, and a folder with earlier results.

use super::common::{column, done, ends, folder, names, numbers, stderr};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

const CASE: &str = "\
[[wheel]]
table = \"wheels.csv\"
creepage_sign = \"contact\"
[passage]
positions = 21
[mesh]
interface_elements = 10
[growth]
steps = 0
[solver]
engine = \"dislocation\"
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 30.0
friction = 0.3
";
/// The second wheel has two patches, the third misses the crack.
const WHEELS: &str = "\
wheel,patch,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm,place_m
7,1,85,1,0.001,0.0005,0.0002,0.3,6,4,10.5
8,1,60,0,0.002,0,0,0.3,6,5,20
8,2,20,20,-0.001,0,0,0.3,4,3,20
9,1,70,-30,0,0.001,0,0.3,6,5,20
";

/// Force along the rail, kN, of the tractions of a table: strips of even width.
fn force(path: &Path) -> f64 {
    let [x, y, q] = ["x_mm", "y_mm", "qx_mpa"].map(|name| numbers(path, name));
    let mut strips: BTreeMap<i64, Vec<(f64, f64)>> = BTreeMap::new();
    for ((x, y), q) in x.into_iter().zip(y).zip(q) {
        strips.entry((1e6 * y) as i64).or_default().push((x, q));
    }
    let ys: Vec<f64> = strips.keys().map(|y| 1e-6 * *y as f64).collect();
    let width = (ys[ys.len() - 1] - ys[0]) / (ys.len() - 1) as f64;
    let along = |strip: &Vec<(f64, f64)>| -> f64 {
        strip.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[0].0 - pair[1].0)).sum()
    };
    1e-3 * width * strips.values().map(along).sum::<f64>()
}

#[test]
fn a_table_of_each_patch_carries_its_force_and_earlier_results_stay_without_force() {
    let place = folder("contact", "patches");
    fs::write(place.join("case.toml"), CASE).unwrap();
    fs::write(place.join("wheels.csv"), WHEELS).unwrap();
    done(&place, &["contact", "case.toml", "--patches", "--quiet"]);
    let results = place.join("case-contact");
    let patches = results.join("patches");
    assert_eq!(
        names(&patches),
        [
            "wheel-7-place-10.5-patch-1.csv",
            "wheel-8-place-20-patch-1.csv",
            "wheel-8-place-20-patch-2.csv",
            "wheel-9-place-20-patch-1.csv"
        ]
    );
    let told = numbers(&results.join("wheels.csv"), "fx_kn");
    let of = |name: &str| force(&patches.join(name));
    let first = of("wheel-7-place-10.5-patch-1.csv");
    assert!(first < -5.0 && (first / told[0] - 1.0).abs() < 0.01, "{first} {}", told[0]);
    let second = of("wheel-8-place-20-patch-1.csv") + of("wheel-8-place-20-patch-2.csv");
    assert!((second / told[1] - 1.0).abs() < 0.01, "{second} {}", told[1]);
    let slips = column(&patches.join("wheel-7-place-10.5-patch-1.csv"), "slips");
    assert!(slips.iter().any(|slips| slips == "0") && slips.iter().any(|slips| slips == "1"));

    fs::write(results.join("notes.txt"), "mine").unwrap();
    let refused = stderr(&ends(&place, &["contact", "case.toml", "--quiet"], 2));
    assert!(
        refused.contains("case-contact already holds results (wheels.csv): replace them with --force"),
        "{refused}"
    );
    done(&place, &["contact", "case.toml", "--force", "--quiet"]);
    assert!(!patches.exists() && results.join("wheels.csv").exists());
    assert_eq!(fs::read_to_string(results.join("notes.txt")).unwrap(), "mine");
}
