//! `railcrack calibrate`.

use super::common::{self, DISLOCATION_CASE, done, ends, numbers, read, stderr};
use railcrack_case::Case;
use std::fs;

/// Depths of the tip of the case at the tonnages of its own run times `slower`.
fn depths(folder: &std::path::Path, slower: f64) -> String {
    let mgt = numbers(&folder.join("run/growth.csv"), "mgt");
    let depth: Vec<f64> = numbers(&folder.join("run/growth.csv"), "tip_y_mm").iter().map(|y| -y).collect();
    let rows = mgt.iter().zip(&depth).skip(1);
    let rows: String = rows.map(|(mgt, depth)| format!("{},{depth}\n", slower * mgt)).collect();
    format!("mgt,depth_mm\n{rows}")
}

/// The key that is fitted stands in a comment and, as another key, in two sections; of a steel it
/// stands nowhere.
#[test]
fn the_fitted_case_has_the_coefficient_of_the_measurements() {
    for (name, growth) in [
        ("constants", "# paris_c = 7e-9: of another rail\n paris_c=0.2E-8 # not paris_c = 1e-9"),
        ("steel", "steel = \"R260\""),
    ] {
        let folder = common::folder("calibrate", name);
        let text = DISLOCATION_CASE.replace("[growth]", &format!("[growth]\n{growth}"))
            + "\n[traffic]\naxle_load_t = 20.0\n[scatter]\nsamples = 10\nparis_c_log_std = 0.2\n";
        fs::write(folder.join("case.toml"), text).unwrap();
        done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
        // Twice the tonnage for the same growth: half the coefficient.
        fs::write(folder.join("measured.csv"), depths(&folder, 2.0)).unwrap();
        let told = done(
            &folder,
            &["calibrate", "case.toml", "--measured", "measured.csv", "--out", "fit", "--quiet"],
        );
        assert!(told.starts_with("paris_c = ") && told.contains(", 0.5000 times that of the case"), "{told}");
        let [before, after] =
            ["case.toml", "fit/calibrated.toml"].map(|file| Case::read(&folder.join(file)).unwrap());
        let rate = |case: &Case| case.growth.law.rate.rate(10.0, 0.0);
        assert!(
            (rate(&after) / rate(&before) - 0.5).abs() < 1e-9,
            "{}",
            read(&folder.join("fit/calibrated.toml"))
        );
        assert_eq!(after.scatter, before.scatter);
        assert_eq!(after.growth.law.equivalent, before.growth.law.equivalent);
    }
}

#[test]
fn refusals_say_why_and_where() {
    let folder = common::folder("calibrate", "refused");
    let rates = "delta_keq_mpa_sqrt_m,rate_mm_per_cycle\n5,1e-7\n50,1e-3\n";
    fs::write(folder.join("rates.csv"), rates).unwrap();
    let table = "[growth]\nlaw = \"table\"\ntable_profile = \"rates.csv\"";
    let text = DISLOCATION_CASE.replace("[growth]", table) + "\n[traffic]\naxle_load_t = 20.0\n";
    fs::write(folder.join("table.toml"), &text).unwrap();
    fs::write(folder.join("included.toml"), format!("include = \"table.toml\"\n{text}")).unwrap();
    let maintained =
        text.replace(table, "[growth]\nlaw = \"walker\"") + "[maintenance]\nwear_mm_per_mgt = 0.01\n";
    fs::write(folder.join("maintained.toml"), maintained).unwrap();
    fs::write(folder.join("measured.csv"), "mgt,depth_mm\n1,4\n").unwrap();
    for (case, parameter, says) in [
        ("table.toml", None, "the rates of `rates.csv` have no coefficient to fit"),
        ("included.toml", None, "`include = \"table.toml\"`: unknown key"),
        ("maintained.toml", None, "--parameter growth.walker_c fits it by runs"),
        ("table.toml", Some("growth.steel"), "--parameter `growth.steel`: is not a number but \"R260\""),
        (
            "table.toml",
            Some("crack[2].friction"),
            "--parameter `crack[2].friction`: the case gives no value for it",
        ),
    ] {
        let mut line = vec!["calibrate", case, "--measured", "measured.csv"];
        line.extend(parameter.into_iter().flat_map(|key| ["--parameter", key]));
        let refused = stderr(&ends(&folder, &line, 2)).replace('\n', " ");
        assert!(refused.contains(says), "{says}: {refused}");
        assert!(!folder.join(case.trim_end_matches(".toml")).exists());
    }
}
