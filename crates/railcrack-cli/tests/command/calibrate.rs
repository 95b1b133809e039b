//! `railcrack calibrate`.

use super::common::{self, DISLOCATION_CASE, done, ends, numbers, read, stderr};
use railcrack_case::{CalibrationPrior, Case};
use std::fs;
use std::path::Path;

/// Depths of the tip of the case at the tonnages of its own run times `slower`.
fn depths(folder: &Path, slower: f64) -> String {
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
        // One site does not show how rails differ: the scatter of the case stays.
        let scatter = |case: &Case| case.scatter.as_ref().unwrap().c_log_std;
        assert!((scatter(&after) - scatter(&before)).abs() < 1e-3, "{}", scatter(&after));
        let json = read(&folder.join("fit/calibration.json"));
        assert!(json.contains("\"key\": \"growth.paris_c\""), "{json}");
        let page = read(&folder.join("fit/calibration.html"));
        assert!(page.contains("Calibration") && page.contains("measured.csv"));
        assert_eq!(after.growth.law.equivalent, before.growth.law.equivalent);
    }
}

/// Two narrow classes of one rail at the same tonnage, a quarter of a millimetre apart with an
/// error of reading of a hundredth: the coefficient lies between them, known to 4 %. By a Φ without
/// a lower tail it would be off by a quarter.
#[test]
fn sharp_readings_that_contradict_each_other_meet_between() {
    let folder = common::folder("calibrate", "contradiction");
    fs::write(
        folder.join("case.toml"),
        "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.3\n\
         [[crack]]\nmouth_mm = 0.0\nlength_mm = 5.0\nangle_deg = 30.0\nfriction = 0.3\n\
         [growth]\nsteps = 60\n[traffic]\naxle_load_t = 20.0\n[solver]\nengine = \"dislocation\"\n",
    )
    .unwrap();
    let header = "mgt,depth_mm,at_least_mm,at_most_mm,std_mm";
    fs::write(
        folder.join("m.csv"),
        format!("{header},crew\n0.50,,2.69,2.71,0.01,A\n0.50,,2.95,2.97,0.01,B\n"),
    )
    .unwrap();
    let line = ["calibrate", "case.toml", "--measured", "m.csv", "--out", "fit", "--quiet"];
    let output = ends(&folder, &line, 0);
    let (told, warned) = (common::stdout(&output), stderr(&output));
    assert!(told.contains("2 of 2 measurements used"), "{told}");
    assert!(warned.contains("warning: m.csv: these columns are not read: `crew`"), "{warned}");
    let json: serde_json::Value = serde_json::from_str(&read(&folder.join("fit/calibration.json"))).unwrap();
    let number = |name: &str| json[name].as_f64().unwrap();
    let (mean, std) = (number("log_mean"), number("log_std"));
    let [low, high] = [-1.96, 1.96].map(|z| (mean + z * std).exp());
    for (got, want) in [(mean.exp(), 0.829), (low, 0.798), (high, 0.861)] {
        assert!((got - want).abs() < 2e-3, "{got} and {want}");
    }
}

/// Two sites of which one grows at the rate of the case and the other at a quarter of it, with
/// readings, classes and no indication; the discrepancy is given.
#[test]
fn several_sites_are_weighed_and_carry_their_scatter() {
    let folder = common::folder("calibrate", "sites");
    let section = "[traffic]\naxle_load_t = 20.0\n[calibration]\nprior_log_mean = 0.0\nprior_log_std = 1.0\ndiscrepancy_log_std = 0.5\n";
    fs::write(folder.join("case.toml"), format!("{}{section}", *DISLOCATION_CASE)).unwrap();
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let mgt = numbers(&folder.join("run/growth.csv"), "mgt");
    let depth: Vec<f64> = numbers(&folder.join("run/growth.csv"), "depth_mm");
    let site = |slower: f64, class: &str| {
        let (mgt, depth) = (slower * mgt[2], depth[2]);
        format!("mgt,depth_mm,at_least_mm,at_most_mm,std_mm\n{mgt},{depth},,,0.01\n{class}\n")
    };
    // Classes that both sites satisfy with certainty: they are read, and change nothing.
    fs::write(folder.join("a.csv"), site(1.0, "1,,,100,")).unwrap();
    fs::write(folder.join("b.csv"), site(4.0, "1,,0.5,,")).unwrap();
    let line =
        ["calibrate", "case.toml", "--measured", "a.csv", "--measured", "b.csv", "--out", "fit", "--quiet"];
    let told = done(&folder, &line);
    // m = 0 and −ln 4, v ≪ s² = ¼: precision 1 + 2/s² = 9, mean −(ln 4)·4/9, a new rail ⅑ + ¼.
    let json: serde_json::Value = serde_json::from_str(&read(&folder.join("fit/calibration.json"))).unwrap();
    let number = |of: &serde_json::Value| of.as_f64().unwrap();
    assert!((number(&json["log_mean"]) + 4.0 / 9.0 * 4f64.ln()).abs() < 2e-3, "{json}");
    assert!((number(&json["log_std"]) - 1.0 / 3.0).abs() < 2e-3, "{json}");
    let new = (1.0_f64 / 9.0 + 0.25).sqrt();
    assert!((number(&json["new_rail"]["log_std"]) - new).abs() < 2e-3, "{json}");
    assert!(told.contains("sites differ by 0.5000 in ln C (as given)"), "{told}");
    assert!(told.contains("4 of 4 measurements used"), "{told}");
    let fitted = Case::read(&folder.join("fit/calibrated.toml")).unwrap();
    assert!((fitted.scatter.unwrap().c_log_std - new).abs() < 2e-3);
}

/// The rate of the measured rail is a twentieth of that of the case, outside of twice and half of
/// its coefficient; a range without it is refused.
#[test]
fn a_search_widens_its_bracket_and_refuses_an_end() {
    let folder = common::folder("calibrate", "bracket");
    let section = "[traffic]\naxle_load_t = 20.0\n";
    fs::write(folder.join("case.toml"), format!("{}{section}", *DISLOCATION_CASE)).unwrap();
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    fs::write(folder.join("measured.csv"), depths(&folder, 20.0)).unwrap();
    let line =
        ["calibrate", "case.toml", "--measured", "measured.csv", "--parameter", "growth.paris_c", "--quiet"];
    let told = done(&folder, &[&line[..], &["--out", "fit"]].concat());
    let value: f64 = told["growth.paris_c = ".len()..].split(',').next().unwrap().parse().unwrap();
    assert!((value / 1e-10 - 1.0).abs() < 5e-3, "{told}");
    // With errors that are known; by its scatter alone, one wrong value is as good as another.
    let exact = depths(&folder, 20.0).replacen("depth_mm\n", "depth_mm,std_mm\n", 1);
    let exact: Vec<String> = exact
        .lines()
        .enumerate()
        .map(|(i, line)| match i {
            0 => line.to_owned(),
            _ => format!("{line},0.01"),
        })
        .collect();
    fs::write(folder.join("exact.csv"), exact.join("\n")).unwrap();
    let end =
        ["calibrate", "case.toml", "--measured", "exact.csv", "--parameter", "growth.paris_c", "--quiet"];
    let refused =
        stderr(&ends(&folder, &[&end[..], &["--between", "1e-9,4e-9", "--out", "end"]].concat(), 2));
    assert!(refused.contains("is at an end, 1.0000e-9: it is no result"), "{refused}");
    let outside = ["--parameter", "contact.friction", "--between", "0.1,7", "--out", "outside"];
    let line = ["calibrate", "case.toml", "--measured", "measured.csv", "--quiet"];
    let refused = stderr(&ends(&folder, &[&line[..], &outside].concat(), 2)).replace('\n', " ");
    assert!(refused.contains("--between 0.1,7: `contact.friction` must be a number in ["), "{refused}");
    let twice = stderr(&ends(&folder, &[&line[..], &["--measured", "measured.csv"]].concat(), 2));
    assert!(twice.contains("given twice"), "{twice}");
    let two = ["--parameter", "crack.friction", "--parameter", "crack.angle_deg"];
    let refused = stderr(&ends(&folder, &[&line[..], &two].concat(), 2));
    assert!(refused.replace('\n', " ").contains("must be the coefficient, growth.paris_c"), "{refused}");
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
        let parameter: Option<&str> = parameter;
        line.extend(parameter.into_iter().flat_map(|key| ["--parameter", key]));
        let refused = stderr(&ends(&folder, &line, 2)).replace('\n', " ");
        assert!(refused.contains(says), "{says}: {refused}");
        assert!(!folder.join(case.trim_end_matches(".toml")).exists());
    }
}

/// The prior of a plane case: that of the residuals of the validation suite, which a reading of
/// poor precision leaves visible; one that is given takes its place.
#[test]
fn the_prior_is_that_of_the_suite_unless_it_is_given() {
    let folder = common::folder("calibrate", "prior");
    let traffic = "\n[traffic]\naxle_load_t = 20.0\n";
    fs::write(folder.join("case.toml"), format!("{}{traffic}", *DISLOCATION_CASE)).unwrap();
    let given = "[calibration]\nprior_log_mean = 0.5\nprior_log_std = 0.4\n";
    fs::write(folder.join("given.toml"), format!("{}{traffic}{given}", *DISLOCATION_CASE)).unwrap();
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let mgt = numbers(&folder.join("run/growth.csv"), "mgt")[2];
    let depth = numbers(&folder.join("run/growth.csv"), "depth_mm")[2];
    fs::write(folder.join("poor.csv"), format!("mgt,depth_mm,std_mm\n{mgt},{depth},1.0\n")).unwrap();
    let plane = CalibrationPrior::PLANE;
    for (case, mean, std) in [("case", plane.log_mean, plane.log_std), ("given", 0.5, 0.4)] {
        let file = format!("{case}.toml");
        done(&folder, &["calibrate", &file, "--measured", "poor.csv", "--out", case, "--quiet"]);
        let found: serde_json::Value =
            serde_json::from_str(&read(&folder.join(case).join("calibration.json"))).unwrap();
        let number = |of: &serde_json::Value| of.as_f64().unwrap();
        let site = &found["sites"][0];
        let (own, error) = (number(&site["log_mean"]), number(&site["log_std"]));
        assert!(own.abs() < 1e-9 && error > 0.5, "{site}");
        let precision = error.powi(-2) + std.powi(-2);
        let want = mean * std.powi(-2) / precision;
        assert!((number(&found["log_mean"]) - want).abs() < 1e-9, "{found}");
        assert!((number(&found["log_std"]) - precision.sqrt().recip()).abs() < 1e-9, "{found}");
        // The calibrated case begins from its own coefficient.
        let calibrated = Case::read(&folder.join(case).join("calibrated.toml")).unwrap().calibration;
        assert_eq!((calibrated.log_mean, calibrated.log_std), (0.0, std));
    }
}

/// The default priors are what `railcrack validate` prints; the page of the comparison, whose lines
/// for the plane are computed anew by its own test, has them for both geometries.
#[test]
fn the_default_priors_are_those_of_the_page() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/validation.md");
    let page = read(&page);
    for (prior, geometry) in [(CalibrationPrior::PLANE, "the plane"), (CalibrationPrior::SPACE, "space")] {
        let line = format!(
            "prior of ln C by the residuals of 8 entries of track in {geometry}: mean {:.2}, sd {:.2}\n",
            prior.log_mean, prior.log_std
        );
        assert!(page.contains(&line), "{line}");
    }
}

/// One reading cannot tell a friction from the coefficient: the friction stays, and the coefficient
/// is the one that belongs to it, as it is by itself; over all frictions it is known far less.
#[test]
fn a_coefficient_next_to_a_number_that_is_not_determined_belongs_to_the_case() {
    let folder = common::folder("calibrate", "indistinct");
    let section = "\n[traffic]\naxle_load_t = 20.0\n[growth]\nsteps = 6\n";
    let text = DISLOCATION_CASE.replace("[growth]\nsteps = 2\n", "") + section;
    fs::write(folder.join("case.toml"), text).unwrap();
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let mgt = numbers(&folder.join("run/growth.csv"), "mgt")[2];
    let depth = numbers(&folder.join("run/growth.csv"), "depth_mm")[2];
    fs::write(folder.join("one.csv"), format!("mgt,depth_mm,std_mm\n{},{depth},0.02\n", 3.0 * mgt)).unwrap();
    let line = ["calibrate", "case.toml", "--measured", "one.csv", "--quiet"];
    done(&folder, &[&line[..], &["--out", "alone"]].concat());
    let both = ["--parameter", "crack.friction", "--parameter", "growth.paris_c", "--out", "both"];
    let told = done(&folder, &[&line[..], &both].concat());
    assert!(told.contains("do not determine crack.friction") && told.contains("weighted by their"), "{told}");
    let json = |of: &str| -> serde_json::Value {
        serde_json::from_str(&read(&folder.join(of).join("calibration.json"))).unwrap()
    };
    let number = |of: &serde_json::Value| of.as_f64().unwrap();
    let (alone, both) = (json("alone"), json("both")["coefficient"].clone());
    for key in ["log_mean", "log_std"] {
        assert!((number(&alone[key]) - number(&both[key])).abs() < 1e-9, "{key}: {alone} {both}");
    }
    assert!(number(&both["over_all_values"]["log_std"]) > 3.0 * number(&both["log_std"]), "{both}");
    let rate = |of: &str| {
        let case = Case::read(&folder.join(of).join("calibrated.toml")).unwrap();
        case.growth.law.rate.rate(10.0, 0.0)
    };
    assert!((rate("alone") / rate("both") - 1.0).abs() < 1e-9);
}

/// A poor reading at a second site does not show that rails hardly differ: the scatter of the case
/// stays, as for one site.
#[test]
fn sites_that_say_little_leave_the_scatter_of_the_case() {
    let folder = common::folder("calibrate", "little");
    let section = "\n[traffic]\naxle_load_t = 20.0\n[scatter]\nparis_c_log_std = 0.25\n";
    fs::write(folder.join("case.toml"), format!("{}{section}", *DISLOCATION_CASE)).unwrap();
    done(&folder, &["run", "case.toml", "--out", "run", "--quiet"]);
    let mgt = numbers(&folder.join("run/growth.csv"), "mgt")[2];
    let depth = numbers(&folder.join("run/growth.csv"), "depth_mm")[2];
    for (name, std) in [("good.csv", 0.002), ("poor.csv", 0.2)] {
        fs::write(folder.join(name), format!("mgt,depth_mm,std_mm\n{mgt},{depth},{std}\n")).unwrap();
    }
    let line = ["calibrate", "case.toml", "--measured", "good.csv", "--measured", "poor.csv", "--quiet"];
    let told = done(&folder, &[&line[..], &["--out", "fit"]].concat());
    assert!(told.contains("do not show that rails differ by less than the scatter of the case"), "{told}");
    let json: serde_json::Value = serde_json::from_str(&read(&folder.join("fit/calibration.json"))).unwrap();
    let want = json["log_std"].as_f64().unwrap().hypot(0.25);
    let fitted = Case::read(&folder.join("fit/calibrated.toml")).unwrap();
    assert!((fitted.scatter.unwrap().c_log_std - want).abs() < 1e-9, "{json}");
}
