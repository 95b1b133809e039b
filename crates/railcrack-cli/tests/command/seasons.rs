//! A rail whose temperature follows the seasons.

use super::common::{done, folder, read};
use std::fs;

const REST: &str = "\
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.1
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 30.0
friction = 0.3
[solver]
engine = \"dislocation\"
[passage]
positions = 21
[mesh]
interface_elements = 10
[growth]
steps = 2
direction = \"coplanar\"
[temperature]
neutral_c = 25.0
";

/// Growth in two seasons is the mean of theirs by shares: cycles lie between those of each alone,
/// and one season with all axles is the plain case, to the last digit.
#[test]
fn the_life_over_the_seasons_lies_between_those_of_each() {
    let place = folder("seasons", "life");
    let growth = |name: &str, keys: &str| {
        fs::write(place.join(format!("{name}.toml")), format!("{REST}{keys}\n")).unwrap();
        done(&place, &["run", &format!("{name}.toml"), "--quiet", "--force", "--out", name]);
        read(&place.join(name).join("growth.csv"))
    };
    let cycles = |growth: &str| -> f64 {
        let mut rows = growth.lines().filter(|line| !line.starts_with('#'));
        let column = rows.next().unwrap().split(',').position(|name| name == "load_cycles").unwrap();
        rows.next_back().unwrap().split(',').nth(column).unwrap().parse().unwrap()
    };
    let summer = growth("summer", "rail_c = 20.0");
    let frost = growth("frost", "rail_c = 0.0");
    assert_eq!(growth("plain", "seasons_c = [0.0]\nseason_shares = [1.0]"), frost);
    let year = growth("year", "seasons_c = [20.0, 0.0]\nseason_shares = [0.7, 0.3]");
    let [summer, frost, year] = [&summer, &frost, &year].map(|growth| cycles(growth));
    assert!(frost < year && year < summer, "{frost} {year} {summer}");
}
