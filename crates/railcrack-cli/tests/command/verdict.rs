//! Verdicts and warnings of runs outside the model, and of studies.

use super::common::{done, folder, read};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Three parallel head checks, closely spaced.
const NETWORK: &str = "\
title = \"Network\"
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.1
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 15.0
friction = 0.5
count = 3
spacing_mm = 3.375
[passage]
positions = 25
[mesh]
interface_elements = 8
[growth]
steps = 3
increment = 0.05
arrest_rate_mm_per_cycle = 1e-18
[calibration]
sites = 1
[solver]
engine = \"dislocation\"
";
/// The same, without a statement that the growth law was fitted.
const UNFITTED: (&str, &str) = ("[calibration]\nsites = 1\n", "");
const TRAFFIC: &str = "[traffic]\naxle_load_t = 20.0\n";
const INSPECTION: &str = "[inspection]\ndetectable_depth_mm = 1.6\ncritical_depth_mm = 12.0\n";
/// Water under the whole pressure of the contact opens everything.
const PRESSURE: &str = "[fluid]\nmodel = \"mouth\"\nprofile = \"constant\"\n";

fn summary(of: &Path) -> Value {
    serde_json::from_str(&read(&of.join("summary.json"))).unwrap()
}

fn kinds(verdict: &Value) -> Vec<&str> {
    verdict["reasons"].as_array().unwrap().iter().map(|reason| reason["kind"].as_str().unwrap()).collect()
}

/// The columns `names` of a table, row by row.
fn columns(table: &str, names: &[&str]) -> Vec<Vec<String>> {
    let mut lines = table.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let place = |name: &&str| header.iter().position(|column| column == name).unwrap();
    let places: Vec<usize> = names.iter().map(place).collect();
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        places.iter().map(|at| fields[*at].to_owned()).collect()
    };
    lines.map(row).collect()
}

fn numbers(table: &str, names: &[&str]) -> Vec<Vec<f64>> {
    let value = |text: &String| text.parse().unwrap_or(f64::NAN);
    columns(table, names).iter().map(|row| row.iter().map(value).collect()).collect()
}

/// K_I of hundreds of MPa√m, flaps lifted by tenths of a millimetre and depths that grow by
/// millimetres per million gross tonnes are no results: with and without axle loads, terminal,
/// page and summary say so, and nothing is concluded from them.
#[test]
fn what_the_model_does_not_describe_is_said_everywhere() {
    let place = folder("verdict", "outside");
    // The limit path of so fast a crack has many turns in each step.
    let network = NETWORK.replace("steps = 3", "steps = 1");
    let slow = network.replace("increment = 0.05", "increment = 0.05\nparis_c = 1e-14");
    let fast = network.replace("increment = 0.05", "increment = 0.05\nparis_c = 2.5e-6");
    let tough = "[fracture]\ntoughness_mpa_sqrt_m = 1000.0\ncriterion = \"k1\"\n";
    let cases = [
        // What the case is, and the reasons that it must give.
        (format!("{network}{PRESSURE}"), vec!["toughness", "lifted-flap"]),
        (format!("{network}{PRESSURE}{TRAFFIC}{INSPECTION}"), vec!["toughness", "lifted-flap"]),
        (format!("{slow}{PRESSURE}{TRAFFIC}{INSPECTION}"), vec!["toughness", "lifted-flap"]),
        (format!("{slow}{PRESSURE}{TRAFFIC}{INSPECTION}{tough}"), vec!["lifted-flap"]),
        (format!("{fast}{TRAFFIC}{INSPECTION}"), vec!["rate"]),
    ];
    for (text, reasons) in cases {
        fs::write(place.join("case.toml"), format!("{text}[output]\nfaces = \"none\"\n")).unwrap();
        let told = done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        let summary = summary(&place.join("run"));
        let verdict = &summary["verdict"];
        assert_eq!(verdict["level"], "outside", "{text}\n{told}");
        for kind in &reasons {
            assert!(kinds(verdict).contains(kind), "{kind} in {verdict}");
        }
        assert!(told.contains("verdict: outside of what the model describes"), "{told}");
        assert!(!told.contains("interval"), "{told}");
        let decision = &summary["decision"];
        assert_eq!(decision.is_null(), !text.contains(TRAFFIC));
        if !decision.is_null() {
            assert_eq!(&decision["verdict"], verdict);
            assert!(decision["inspection"].is_null() && decision["interval_for_target_mgt"].is_null());
        }
        let page = read(&place.join("run/report.html"));
        assert!(page.contains("Outside of what the model describes"));
        assert!(!page.contains("would continue"), "{text}");
        if text.contains("profile") {
            let of = |kind: &str| {
                let all = verdict["reasons"].as_array().unwrap();
                all.iter().find(|reason| reason["kind"] == kind).and_then(|reason| reason["value"].as_f64())
            };
            assert!(of("lifted-flap").unwrap() > 0.3, "{verdict}");
            assert!(text.contains(tough) || of("toughness").unwrap() > 200.0, "{verdict}");
        }
    }
}

/// A coefficient in another unit is no law of rail steel: the verdict is never that all is well.
#[test]
fn a_growth_law_in_another_unit_is_outside() {
    let place = folder("verdict", "unit");
    let text = NETWORK.replace(UNFITTED.0, UNFITTED.1);
    let text = text.replace("increment = 0.05", "increment = 0.05\nparis_c = 1e-12\nparis_m = 3.0");
    for traffic in [TRAFFIC, ""] {
        fs::write(place.join("case.toml"), format!("{text}{traffic}")).unwrap();
        let told = done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        let verdict = &summary(&place.join("run"))["verdict"];
        assert_eq!((&verdict["level"], kinds(verdict)), (&"outside".into(), vec!["growth-law"]), "{verdict}");
        assert!(told.contains("then paris_c = 1e-9 in mm per cycle"), "{told}");
        assert!(told.contains("what they mean and what to do: docs/warnings.md#input"), "{told}");
        assert!(read(&place.join("run/report.html")).contains("docs/warnings.md#input"));
    }
}

/// A run within the limits keeps its sentence.
#[test]
fn growth_continues_only_where_it_is_known() {
    let place = folder("verdict", "continues");
    fs::write(place.join("case.toml"), format!("{NETWORK}[output]\nfaces = \"none\"\n")).unwrap();
    let told = done(&place, &["run", "case.toml", "--quiet", "--out", "run"]);
    assert!(!told.contains("verdict"), "{told}");
    assert!(summary(&place.join("run"))["verdict"].is_null());
    assert!(read(&place.join("run/report.html")).contains("growth would continue"));
}

/// A warning has the numbers of the worst step, and the number of those concerned.
#[test]
fn warnings_are_those_of_the_worst_step() {
    let place = folder("verdict", "worst");
    // Not outside: 0.3 to 3 mm per million gross tonnes.
    let law = "increment = 0.05\nparis_c = 1e-10";
    let text = NETWORK.replace("increment = 0.05", law).replace("steps = 3", "steps = 6");
    let trapped = "[fluid]\nmodel = \"trapped\"\n";
    fs::write(place.join("rate.toml"), format!("{text}{trapped}{TRAFFIC}")).unwrap();
    let told = done(&place, &["run", "rate.toml", "--quiet", "--out", "rate"]);
    let run = place.join("rate");
    let of_run = summary(&run);
    let warning = |summary: &Value, part: &str| {
        let all = summary["warnings"].as_array().unwrap().iter();
        let own: Vec<&Value> =
            all.filter(|warning| warning["text"].as_str().unwrap().contains(part)).collect();
        assert_eq!(own.len(), 1, "{part}: {own:?}");
        own[0].clone()
    };
    let first_number = |warning: &Value, before: &str| -> f64 {
        let text = warning["text"].as_str().unwrap();
        let rest = &text[text.find(before).unwrap() + before.len()..];
        rest.split_whitespace().next().unwrap().parse().unwrap()
    };

    // The rate along the crack times the sine of the way.
    let names = ["step", "crack", "tip", "depth_mm", "rate_mm_per_cycle", "increment_mm"];
    let growth = numbers(&read(&run.join("growth.csv")), &names);
    // About three times the fastest that is measured: 0.11 mm per million gross tonnes down to 2.3
    // mm, 0.32 from 5 mm on.
    let limit = |depth: f64| {
        let share = (depth.clamp(2.3, 5.0) / 2.3).ln() / (5.0f64 / 2.3).ln();
        0.3 * (0.32f64 / 0.11).powf(share)
    };
    let mut fast = std::collections::BTreeSet::new();
    let mut rates: Vec<(f64, f64)> = Vec::new();
    for row in &growth {
        let next = growth.iter().find(|next| next[0] == row[0] + 1.0 && next[1..3] == row[1..3]);
        let Some(next) = next else { continue };
        let rate = row[4] * 1e6 / 20.0 * (next[3] - row[3]) / row[5];
        rates.push((rate, row[0]));
        if rate > limit(row[3]) {
            fast.insert(row[0] as u64);
        }
    }
    let fastest = rates.iter().copied().reduce(|a, b| if b.0 > a.0 { b } else { a }).unwrap();
    let rate = warning(&of_run, "the fastest growth that is measured in track");
    assert!((first_number(&rate, "deeper by ") / fastest.0 - 1.0).abs() < 0.01, "{rate}, {fastest:?}");
    assert_eq!(rate["step"].as_f64().unwrap(), fastest.1);
    assert_eq!(rate["steps"].as_u64().unwrap() as usize, fast.len());
    assert!(fastest.1 > 0.0 && fast.len() > 1, "a worst step that is not the first: {rates:?}");
    assert!(told.contains(&format!("warning, step {}, the worst of {}: a crack", fastest.1, fast.len())));

    // The largest opening of the faces.
    let capped = PRESSURE.replace("constant\"", "constant\"\npressure_cap_mpa = 300.0");
    fs::write(place.join("flap.toml"), format!("{NETWORK}{capped}{TRAFFIC}")).unwrap();
    done(&place, &["run", "flap.toml", "--quiet", "--out", "flap"]);
    let run = place.join("flap");
    let faces = numbers(&read(&run.join("faces.csv")), &["step", "opening_mm"]);
    let flap = warning(&summary(&run), "the wheel would feel the flap");
    let widest = faces.iter().map(|row| row[1]).fold(0.0, f64::max);
    let found = first_number(&flap, "by up to ");
    // Between output positions the faces may open a little more.
    assert!(found > widest - 5e-4 && found < 1.02 * widest + 5e-4, "{flap}, {widest}");
    let lifted = |step: u64| faces.iter().any(|row| row[0] as u64 == step && row[1] > 0.05);
    let steps = (0..=3).filter(|step| lifted(*step)).count() as u64;
    assert!(flap["steps"].as_u64().unwrap() >= steps && steps > 1, "{flap}, {steps}");
}

/// Nothing is known after the last of the steps that the case allows.
#[test]
fn steps_that_end_before_a_failure_leave_the_answer_unknown() {
    let place = folder("verdict", "steps");
    let text = NETWORK.replace("increment = 0.05", "increment = 0.05\nparis_c = 1e-12");
    let text = text.replace("steps = 3", "steps = 1");
    let ended = text.replace("steps = 1", "steps = 1\nstop_after_cycles = 1e4");
    // Without any step nothing is known of growth, whatever is looked for.
    let none = text.replace("steps = 1", "steps = 0");
    let found = "[inspection]\ndetectable_depth_mm = 1.6\n";
    let cases = [
        (&text, INSPECTION, "unknown", "steps"),
        (&ended, INSPECTION, "ok", "end-of-run"),
        (&none, INSPECTION, "unknown", "steps"),
        (&none, found, "unknown", "steps"),
    ];
    for (text, inspection, level, kind) in cases {
        fs::write(place.join("case.toml"), format!("{text}{TRAFFIC}{inspection}")).unwrap();
        done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        let decision = summary(&place.join("run"))["decision"].clone();
        assert!(level != "unknown" || decision["inspection"].is_null(), "{decision}");
        let verdict = &decision["verdict"];
        assert_eq!((&verdict["level"], kinds(verdict)), (&level.into(), vec![kind]), "{verdict}");
    }
}

/// Each run of a study has its verdict in the table, and the page counts them.
#[test]
fn a_study_has_the_reasons_of_its_runs() {
    let place = folder("verdict", "study");
    let text = NETWORK.replace("increment = 0.05", "increment = 0.05\nparis_c = [1e-12, 3e-7, 1e-6]");
    let short = INSPECTION.replace("12.0", "1.7");
    fs::write(place.join("study.toml"), format!("{text}{TRAFFIC}{short}")).unwrap();
    done(&place, &["sweep", "study.toml", "--quiet", "--out", "study"]);
    let study = place.join("study");
    let rows =
        columns(&read(&study.join("summary.csv")), &["verdict", "reasons", "failure", "failure_crack"]);
    assert_eq!(rows.len(), 3);
    for (run, row) in rows.iter().enumerate() {
        let decision = summary(&study.join(format!("runs/00{}", run + 1)))["decision"].clone();
        assert_eq!(row[0], decision["verdict"]["level"].as_str().unwrap());
        assert_eq!(row[1], kinds(&decision["verdict"]).join(" "));
        assert_eq!(row[2], "depth");
        assert_eq!(row[3].parse::<u64>().ok(), decision["failure"]["crack"].as_u64());
    }
    assert_eq!([&rows[0][0], &rows[1][0], &rows[2][0]], ["act", "outside", "outside"]);
    let parquet = fs::read(study.join("runs.parquet")).unwrap();
    for name in ["verdict", "reasons", "failure_mgt"] {
        assert!(parquet.windows(name.len()).any(|part| part == name.as_bytes()), "{name}");
    }
    let page = read(&study.join("report.html"));
    assert!(page.contains("Verdicts on the runs by their reasons"));
    assert!(page.contains("growth faster than cracks grow") && page.contains("2 of 3 runs"), "{page}");
}
