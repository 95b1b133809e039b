//! A rail whose temperature follows the seasons.

use super::common::{DISLOCATION_CASE, done, folder, numbers, read};
use std::fs;

/// Growth in two seasons is the mean of theirs by shares: cycles lie between those of each alone,
/// and one season with all axles is the plain case, to the last digit.
#[test]
fn the_life_over_the_seasons_lies_between_those_of_each() {
    let place = folder("seasons", "life");
    let growth = |name: &str, keys: &str| {
        let straight = DISLOCATION_CASE.replace("steps = 2", "steps = 2\ndirection = \"coplanar\"");
        let text = format!("{straight}[temperature]\nneutral_c = 25.0\n{keys}\n");
        fs::write(place.join(format!("{name}.toml")), text).unwrap();
        done(&place, &["run", &format!("{name}.toml"), "--quiet", "--force", "--out", name]);
        read(&place.join(name).join("growth.csv"))
    };
    let cycles = |name: &str| *numbers(&place.join(name).join("growth.csv"), "load_cycles").last().unwrap();
    growth("summer", "rail_c = 20.0");
    let frost = growth("frost", "rail_c = 0.0");
    assert_eq!(growth("plain", "seasons_c = [0.0]\nseason_shares = [1.0]"), frost);
    growth("year", "seasons_c = [20.0, 0.0]\nseason_shares = [0.7, 0.3]");
    let [summer, frost, year] = ["summer", "frost", "year"].map(cycles);
    assert!(frost < year && year < summer, "{frost} {year} {summer}");
}
