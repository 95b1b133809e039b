//! Samples between the runs of a study.

use super::common::{done, folder, read};
use serde_json::Value;
use std::fs;

/// The coefficient of the law scatters twice: in the study, and in `[scatter]`.
const STUDY: &str = "\
title = \"Population\"
[study]
samples = 12
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.1
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 25.0
friction = 0.3
[passage]
positions = 31
[mesh]
interface_elements = 8
[growth]
steps = 4
increment = 0.05
turning_length_mm = inf
critical_length_mm = 4.6
paris_c = { log-normal = [2e-9, 0.3] }
[traffic]
axle_load_t = 20.0
[inspection]
detectable_length_mm = 4.2
[scatter]
paris_c_log_std = 0.4
samples = 40000
[solver]
engine = \"dislocation\"
";

#[test]
fn samples_between_runs_are_log_normal_where_the_coefficient_is() {
    let folder = folder("population", "coefficient");
    fs::write(folder.join("study.toml"), STUDY).unwrap();
    let told = done(&folder, &["sweep", "study.toml", "--out", "one", "--threads", "1", "--quiet"]);
    assert!(told.contains("detectable to critical, MGT"), "{told}");
    done(&folder, &["sweep", "study.toml", "--out", "two", "--threads", "2", "--quiet"]);
    let text = read(&folder.join("one/population.json"));
    assert_eq!(text, read(&folder.join("two/population.json")), "any number of threads");
    let population: Value = serde_json::from_str(&text).unwrap();
    let population = &population[0];
    assert_eq!((&population["runs"], &population["left_out"]), (&12.into(), &0.into()));
    // The path does not depend on C: what is left is that 17 nodes describe it, between the five
    // steps of a run.
    assert!(population["error"]["worst_percent"].as_f64().unwrap() < 0.6, "{population}");

    // N is inversely proportional to C: log-normal, with the root of 0.3² + 0.4². One run has the
    // median of the study's C to within what twelve samples leave.
    let way = population["interval_mgt"].as_f64().unwrap() * 3.0;
    let ways = &population["scatter"]["mgt_detectable_to_critical"];
    for (key, z) in [("p05", -1.644_854), ("p50", 0.0), ("p95", 1.644_854)] {
        let (found, exact) = (ways[key].as_f64().unwrap(), way * f64::exp(0.5 * z));
        assert!((found / exact - 1.0).abs() < 0.02, "{key}: {found}, not {exact}");
    }
    // A third of the way: ln 3/0.5 = 2.197 standard deviations, 0.0140.
    let missed = population["scatter"]["probability_critical_before_inspection"].as_f64().unwrap();
    assert!((missed - 0.0140).abs() < 0.002, "{missed}");
    // Shares of the variance: 0.16 and 0.09 of 0.25.
    let shares = population["scatter"]["sensitivities"].as_array().unwrap();
    assert_eq!(shares[0]["key"], "paris_c_log_std");
    for (share, exact) in shares.iter().zip([0.64, 0.36]) {
        assert!((share["share"].as_f64().unwrap() - exact).abs() < 0.02, "{shares:?}");
    }
    let page = read(&folder.join("one/report.html"));
    assert!(page.contains("Results are interpolated between 12 runs"), "the page says how");
}

#[test]
fn runs_of_such_a_study_leave_the_samples_to_it() {
    let folder = folder("population", "own");
    let study = STUDY.replace("samples = 12", "samples = 4").replace("samples = 40000", "samples = 2000");
    fs::write(folder.join("study.toml"), &study).unwrap();
    let tables = "[output]\nfaces = \"all\"\nsif = \"all\"\n";
    fs::write(folder.join("whole.toml"), format!("{study}{tables}")).unwrap();
    for (file, out) in [("study.toml", "least"), ("whole.toml", "whole")] {
        done(&folder, &["sweep", file, "--out", out, "--quiet"]);
        let run = folder.join(out).join("runs/002");
        let summary: Value = serde_json::from_str(&read(&run.join("summary.json"))).unwrap();
        let decision = &summary["decision"];
        assert!(
            decision["inspection"]["interval_mgt"].is_f64() && decision["scatter"].is_null(),
            "{decision}"
        );

        // By itself the case samples, and the page of the run has the same.
        let alone = format!("{out}-alone");
        let case = run.join("case.toml");
        done(&folder, &["run", case.to_str().unwrap(), "--out", &alone, "--quiet"]);
        let alone: Value = serde_json::from_str(&read(&folder.join(alone).join("summary.json"))).unwrap();
        assert_eq!(alone["decision"]["scatter"]["samples"], 2000);
        done(&folder, &["report", run.to_str().unwrap()]);
        assert!(read(&run.join("report.html")).contains("MGT of 2\u{a0}000 samples"));
    }

    // A study of lists has no samples between its runs.
    let lists =
        study.replace("[study]\nsamples = 4\n", "").replace("{ log-normal = [2e-9, 0.3] }", "[2e-9, 3e-9]");
    fs::write(folder.join("lists.toml"), lists).unwrap();
    done(&folder, &["sweep", "lists.toml", "--quiet"]);
    let summary: Value = serde_json::from_str(&read(&folder.join("lists/runs/002/summary.json"))).unwrap();
    assert_eq!(summary["decision"]["scatter"]["samples"], 2000);
}

#[test]
fn cracks_that_do_not_grow_are_told_and_not_sampled() {
    let folder = folder("population", "arrest");
    let study = STUDY
        .replace("paris_c = { log-normal = [2e-9, 0.3] }", "arrest_rate_mm_per_cycle = 1.0")
        .replace("friction = 0.3", "friction = { uniform = [0.2, 0.4] }");
    fs::write(folder.join("study.toml"), study).unwrap();
    let told = done(&folder, &["sweep", "study.toml", "--out", "s", "--quiet"]);
    assert!(told.contains("no samples interpolated between the runs: 12 of 12 cracks do not grow"), "{told}");
    assert!(read(&folder.join("s/report.html")).contains("12 of 12 cracks do not grow"));
    let shown = done(&folder, &["show", "s", "--columns", "run,friction"]);
    assert!(shown.starts_with("run  crack[1].friction\n"), "{shown}");
}

/// Runs that the model does not describe make no population that it describes.
#[test]
fn a_population_outside_of_the_model_has_no_interval() {
    let folder = folder("population", "outside");
    let study = STUDY.replace("samples = 12", "samples = 6").replace("2e-9", "2e-6");
    fs::write(folder.join("study.toml"), study).unwrap();
    let told = done(&folder, &["sweep", "study.toml", "--out", "s", "--quiet"]);
    let reason = "6 of 6 runs are outside of what the model describes, or fail at once";
    assert!(told.contains(reason) && !told.contains("detectable to critical"), "{told}");
    let population: Value = serde_json::from_str(&read(&folder.join("s/population.json"))).unwrap();
    assert!(population[0]["interval_mgt"].is_null() && population[0]["scatter"].is_null(), "{population}");
    assert!(read(&folder.join("s/report.html")).contains(reason));
}
