//! `railcrack plan`.

use super::common::{self, done, ends, names, read, stderr, stdout};
use serde_json::Value;
use std::fs;
use std::path::Path;

const CASE: &str = "\
title = \"Plan\"
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.3
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 30.0
friction = 0.3
[passage]
positions = 25
[mesh]
interface_elements = 8
[growth]
paris_c = 2e-11
arrest_rate_mm_per_cycle = 1e-14
[traffic]
axle_load_t = 20.0
mgt_per_year = 12.0
[maintenance]
wear_mm_per_mgt = 0.001
wear_limit_mm = 9.0
[inspection]
detectable_depth_mm = 2.05
critical_depth_mm = 2.1
[calibration]
sites = 1
[solver]
engine = \"dislocation\"
";

fn json(file: &Path) -> Value {
    serde_json::from_str(&read(file)).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Tonnages of a plan and of the whole run with the same grinding: increments choose themselves for
/// 1 % of the life, and the few positions of the wheel lie elsewhere over a worn mouth, where plans
/// take K of a mouth that stays: peaks of K_I between them differ by 3 %.
const SAME_RUN: f64 = 2e-3;

#[test]
fn a_plan_is_the_run_with_its_grinding() {
    let place = common::folder("plan", "runs");
    fs::write(place.join("case.toml"), CASE).unwrap();
    let told = done(
        &place,
        &[
            "plan",
            "case.toml",
            "--grinding",
            "0.3,0.1",
            "--interval",
            "20,10",
            "--horizon",
            "160",
            "--out",
            "plan",
            "--quiet",
        ],
    );
    assert_eq!(
        names(&place.join("plan")),
        ["SHA256SUMS", "case.toml", "plan.csv", "plan.json", "plots", "report.html"]
    );
    let plan = json(&place.join("plan/plan.json"));
    let plans = plan["plans"].as_array().unwrap();
    let order: Vec<(f64, f64)> = plans
        .iter()
        .map(|one| (number(&one["grinding_mm"]), number(&one["grinding_interval_mgt"])))
        .collect();
    assert_eq!(order, [(0.1, 10.0), (0.1, 20.0), (0.3, 10.0), (0.3, 20.0)]);
    let mut ends = Vec::new();
    for of in &plans[1..3] {
        let depth = number(&of["grinding_mm"]);
        let interval = of["grinding_interval_mgt"].as_f64();
        let mut text = CASE.replace("[growth]\n", "[growth]\nsteps = 400\nstop_after_cycles = 8e6\n");
        if let Some(interval) = interval {
            let grinding = format!("grinding_mm = {depth}\ngrinding_interval_mgt = {interval:?}\n");
            text = text.replace("[maintenance]\n", &format!("[maintenance]\n{grinding}"));
        }
        fs::write(place.join("whole.toml"), text).unwrap();
        done(&place, &["run", "whole.toml", "--quiet", "--force", "--out", "whole"]);
        let summary = json(&place.join("whole/summary.json"));
        let decision = &summary["decision"];
        let outcome = of["outcome"].as_str().unwrap();
        let (want, mgt) = match decision["failure"]["mode"].as_str().unwrap() {
            "none" if of["outcome"] == "holds" => ("holds", &summary["million_gross_tonnes"]),
            "none" => ("worn-away", &decision["maintenance"]["mgt_to_worn_away"]),
            mode => (mode, &decision["failure"]["mgt"]),
        };
        assert_eq!(outcome, want, "{of}");
        let (found, mgt) = (number(&of["mgt"]), number(mgt));
        assert!((found / mgt - 1.0).abs() < SAME_RUN, "{depth} every {interval:?}: {found}, not {mgt}");
        assert!((number(&of["months"]) - found).abs() < 1e-6 * found, "12 MGT in a year");
        ends.push(outcome.to_owned());
    }
    assert!(ends.contains(&"depth".to_owned()) && ends.contains(&"worn-away".to_owned()), "{ends:?}");
    // The least grinding is the one of least removal among those that hold; deeper is no worse.
    let least = &plan["least"];
    let holds = |one: &&Value| one["holds"] == true;
    let removal = |one: &Value| number(&one["removal_mm_per_mgt"]);
    let want = plans.iter().filter(holds).map(removal).fold(f64::INFINITY, f64::min);
    assert_eq!(removal(least), want, "{told}");
    // 0.1 or 0.3 mm at a time with the wear between: the first grinding at or beyond the limit.
    let (depth, interval) = (number(&least["grinding_mm"]), number(&least["grinding_interval_mgt"]));
    let count = (1..).find(|n| f64::from(*n) * (depth + 0.001 * interval) >= 9.0 - 1e-9).unwrap();
    let before = interval * f64::from(count - 1);
    let by_wear = before + (9.0 - f64::from(count - 1) * (depth + 0.001 * interval)) / 0.001;
    let limit = by_wear.min(before + interval);
    assert!((number(&least["mgt_to_wear_limit"]) / limit - 1.0).abs() < 1e-9, "{least}");
    assert!((number(&least["months_to_wear_limit"]) / limit - 1.0).abs() < 1e-9, "{least}");
    let (today, then) = (plan["date"].as_str().unwrap(), least["replacement_date"].as_str().unwrap());
    let year = |date: &str| date[..4].parse::<f64>().unwrap();
    assert!((year(then) - year(today) - limit / 12.0).abs() <= 1.0, "{today} {then}");
    // The page has what is needed to sign it.
    let page = read(&place.join("plan/report.html"));
    let checksum = plan["case_checksum"].as_str().unwrap();
    // A year is what is known of a replacement.
    for what in [today, &then[..4], checksum, "railcrack 0", "Approved by", "counter(pages)", "Assumptions"] {
        assert!(page.contains(what), "{what}");
    }
    // As every decision it says how well rates are known.
    let known = "he growth law is calibrated by 1 measured site";
    assert!(told.contains(&format!("t{known}")) && page.contains(&format!("T{known}")), "{told}");
    assert!(read(&place.join("plan/plots/plan.svg")).contains("worn away"));
    // It is rebuilt to the byte, and its files are checked.
    done(&place, &["report", "plan"]);
    assert_eq!(read(&place.join("plan/report.html")), page);
    done(&place, &["verify", "plan"]);
    let shown = done(&place, &["show", "plan", "--columns", "grinding_mm,outcome,holds"]);
    assert_eq!(shown.lines().count(), 6, "{shown}");
    let table = read(&place.join("plan/plan.csv"));
    fs::write(place.join("plan/plan.csv"), table.replace("depth", "holds")).unwrap();
    let told = stdout(&common::ends(&place, &["verify", "plan"], 4));
    assert!(told.contains("damaged: plan/plan.csv"), "{told}");
}

/// Accuracy of the speed of the sample that fails at the horizon: samples lie between runs of all
/// plans and at other speeds.
const SAME_LIFE: f64 = 0.06;

#[test]
#[ignore = "extra: some 30 s of whole runs"]
fn the_probability_of_a_plan_is_that_of_whole_runs_in_full() {
    let place = common::folder("plan", "risk");
    let case = format!("{CASE}[scatter]\nsamples = 4000\nparis_c_log_std = 0.3\n");
    fs::write(place.join("case.toml"), &case).unwrap();
    let line = ["plan", "case.toml", "--grinding", "0.1,0.2", "--interval", "10,20", "--horizon", "150"];
    done(&place, &[&line[..], &["--out", "plan", "--quiet"]].concat());
    let plan = json(&place.join("plan/plan.json"));
    let mut between = 0;
    for of in plan["plans"].as_array().unwrap() {
        let (depth, interval) = (number(&of["grinding_mm"]), number(&of["grinding_interval_mgt"]));
        let found = number(&of["probability_of_failure"]);
        assert_eq!(of["holds"], found <= 0.05, "{of}");
        if !(0.01..0.99).contains(&found) {
            continue;
        }
        between += 1;
        // A run a little faster than the sample that fails at the horizon, and one a little slower.
        let coefficient = 2e-11 * (0.3 * inverse_normal(1.0 - found)).exp();
        let grinding = format!("grinding_mm = {depth}\ngrinding_interval_mgt = {interval:?}\n");
        for (speed, fails) in [(1.0 + SAME_LIFE, true), (1.0 / (1.0 + SAME_LIFE), false)] {
            let text = CASE.replace("[maintenance]\n", &format!("[maintenance]\n{grinding}"));
            let text = text.replace("paris_c = 2e-11", &format!("paris_c = {:e}", coefficient * speed));
            let text = text.replace("[growth]\n", "[growth]\nsteps = 400\nstop_after_cycles = 9e6\n");
            fs::write(place.join("whole.toml"), text).unwrap();
            done(&place, &["run", "whole.toml", "--quiet", "--force", "--out", "whole"]);
            let life = json(&place.join("whole/summary.json"))["decision"]["failure"]["mgt"].as_f64();
            let is_short = life.is_some_and(|life| life < 150.0);
            assert_eq!(is_short, fails, "{depth} every {interval}, P {found}, {speed}: {life:?}");
        }
    }
    assert!(between > 1, "the plans are certain: {plan}");
    // The plans share their runs: each by itself takes ten.
    assert!(number(&plan["runs"]) < 20.0, "{}", plan["runs"]);
}

/// The quantile of the standard normal distribution, by the sum of its density.
fn inverse_normal(share: f64) -> f64 {
    let density = |z: f64| (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
    let (mut z, mut below) = (-6.0, 0.0);
    while below < share {
        below += 1e-4 * density(z + 5e-5);
        z += 1e-4;
    }
    z
}

#[test]
fn refusals_say_what_is_missing() {
    let place = common::folder("plan", "refused");
    fs::write(place.join("case.toml"), CASE).unwrap();
    fs::write(
        place.join("tonnes.toml"),
        CASE.replace("[traffic]\naxle_load_t = 20.0\nmgt_per_year = 12.0\n", "")
            .replace("[maintenance]\nwear_mm_per_mgt = 0.001\nwear_limit_mm = 9.0\n", "")
            .replace("[inspection]\ndetectable_depth_mm = 2.05\ncritical_depth_mm = 2.1\n", ""),
    )
    .unwrap();
    fs::write(place.join("safe.toml"), CASE.replace("critical_depth_mm = 2.1\n", "")).unwrap();
    for (line, says) in [
        (&["plan", "tonnes.toml"][..], "add a [traffic] section with axle_load_t"),
        (&["plan", "safe.toml"], "add critical_depth_mm to [inspection]"),
        (&["plan", "case.toml", "--grinding", "0.1,-0.2"], "must be a number from 0.000001 to 1e6"),
        (&["plan", "case.toml", "--interval", "often"], "must be a number from 0.000001 to 1e6"),
        (&["plan", "none.toml"], "none.toml"),
    ] {
        let told = stderr(&ends(&place, line, 2)).replace('\n', " ");
        assert!(told.contains(says), "{line:?}: {told}");
    }
    fs::create_dir(place.join("full")).unwrap();
    fs::write(place.join("full/plan.json"), "{}").unwrap();
    let told = stderr(&ends(&place, &["plan", "case.toml", "--out", "full", "--quiet"], 2));
    assert!(told.contains("full already holds"), "{told}");
}

/// A rail that the model does not describe has no plan.
#[test]
fn nothing_is_derived_from_what_the_model_does_not_describe() {
    let place = common::folder("plan", "outside");
    fs::write(place.join("case.toml"), CASE.replace("2e-11", "2e-8")).unwrap();
    let line = ["plan", "case.toml", "--grinding", "0.2", "--interval", "10", "--out", "plan", "--quiet"];
    let told = done(&place, &line);
    assert!(told.contains("no grinding plan is derived from this case"), "{told}");
    let plan = json(&place.join("plan/plan.json"));
    assert_eq!(plan["verdict"]["level"], "outside");
    assert!(plan["least"].is_null() && plan["least_by_interval"][0].is_null());
}
