//! Decisions: failure over all cracks, verdict, samples against the run and against whole runs.

use super::common::{column, done, ends, folder, read, stderr};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A section that a case may have, and one that it may have instead.
struct Part {
    name: &'static str,
    text: &'static str,
}

const RAIL: &str = "\
title = \"Decision\"
[passage]
positions = 25
[mesh]
interface_elements = 8
[growth]
steps = 60
paris_c = 2e-11
arrest_rate_mm_per_cycle = 1e-14
increment = 0.06
turning_length_mm = inf
[inspection]
detectable_depth_mm = 2.05
critical_depth_mm = 2.5
[calibration]
sites = 1
[solver]
engine = \"dislocation\"
";

const WHEEL: &str = "\
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.3
[traffic]
axle_load_t = 20.0
";

const ELLIPSE: &str = "\
[contact]
wheel_load_kn = 98.0
wheel_radius_mm = 460.0
wheel_profile_radius_mm = -450.0
rail_head_radius_mm = 300.0
friction = 0.3
[traffic]
axle_load_t = 20.0
";

const MIX: &str = "\
[[wheel]]
name = \"loaded\"
share = 0.6
axle_load_t = 22.5
contact = { peak_pressure_mpa = 845.0, half_width_mm = 6.75, friction = 0.3 }
[[wheel]]
name = \"empty, the other way, in the rain and the cold\"
share = 0.4
axle_load_t = 12.0
direction = \"-x\"
fluid = { model = \"trapped\" }
temperature = { rail_c = 0.0, neutral_c = 15.0 }
contact = { peak_pressure_mpa = 700.0, half_width_mm = 5.5, friction = -0.2 }
";

const CRACK: &str = "\
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 30.0
friction = 0.3
";

const SECOND: &str = "\
[[crack]]
mouth_mm = 9.0
length_mm = 3.0
angle_deg = 25.0
friction = 0.2
";

const NETWORK: Part = Part { name: "two cracks", text: SECOND };
const MAINTENANCE: Part = Part {
    name: "wear and grinding",
    // A plan without a first grinding is followed by one at once where it does not hold.
    text: "\
[maintenance]
wear_mm_per_mgt = 0.001
grinding_mm = 0.05
grinding_interval_mgt = 20.0
first_grinding_mgt = 20.0
",
};
const FLUID: Part = Part { name: "fluid", text: "[fluid]\nmodel = \"trapped\"\n" };
const FRACTURE: Part = Part { name: "fracture", text: "[fracture]\ntoughness_mpa_sqrt_m = 20.0\n" };
const COLD: Part = Part { name: "cold", text: "[temperature]\nneutral_c = 25.0\nrail_c = 5.0\n" };

/// The decision of a run, whose verdict is that of its summary.
fn decision(of: &Path) -> Value {
    let summary: Value = serde_json::from_str(&read(&of.join("summary.json"))).unwrap();
    let decision = summary["decision"].clone();
    assert_eq!(summary["verdict"], decision["verdict"]);
    decision
}

fn number(value: &Value) -> Option<f64> {
    value.as_f64()
}

/// Without any scatter all samples are the run, and so are a run of a study and a plan that grinds
/// as the case does, whatever sections the case has.
#[test]
#[ignore = "extra: minutes"]
fn run_samples_study_and_plan_have_one_life_in_full() {
    let place = folder("decision", "product");
    let scatter = "[scatter]\nsamples = 20\nparis_c_log_std = 0.0\n";
    let parts = [NETWORK, MAINTENANCE, FLUID, FRACTURE, COLD];
    let mut failed = 0;
    for mask in 0..1 << (parts.len() + 1) {
        // Pairs and everything at once: triples add nothing but time.
        let chosen = (0..=parts.len()).filter(|i| mask >> i & 1 == 1).count();
        if chosen > 2 && chosen < parts.len() + 1 {
            continue;
        }
        let mixed = mask >> parts.len() & 1 == 1;
        let taken = || parts.iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1).map(|(_, part)| part);
        let wheels = if mixed { MIX } else { ELLIPSE };
        let mut text = format!("{RAIL}{wheels}{CRACK}");
        let mut names = vec![if mixed { "mix" } else { "wheel" }];
        for part in taken() {
            text.push_str(part.text);
            names.push(part.name);
        }
        text.push_str(scatter);
        fs::write(place.join("case.toml"), &text).unwrap();
        done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        let decision = decision(&place.join("run"));
        let life = number(&decision["failure"]["mgt"]);
        failed += usize::from(life.is_some());
        let is = |found: Option<f64>, accepted: f64, by: &str| {
            let is_same = match (life, found) {
                (Some(life), Some(found)) => (found - life).abs() <= accepted * life,
                (life, found) => life.is_none() && found.is_none(),
            };
            assert!(is_same, "{names:?}: {life:?} in the run, {found:?} {by}");
        };
        for key in ["p05", "p50", "p95"] {
            is(number(&decision["scatter"]["mgt_to_critical"][key]), 1e-6, "in the samples");
        }
        let study = text.replace("paris_c = 2e-11", "paris_c = [2e-11, 4e-11]");
        fs::write(place.join("study.toml"), study).unwrap();
        done(&place, &["sweep", "study.toml", "--quiet", "--force", "--out", "study"]);
        let lives = column(&place.join("study/summary.csv"), "failure_mgt");
        is(lives[0].parse().ok(), 1e-9, "in the study");
        if let Some(life) = life.filter(|life| *life > 0.0 && names.contains(&MAINTENANCE.name)) {
            let horizon = format!("{}", 2.0 * life);
            let grinding = ["--grinding", "0.05", "--interval", "20", "--horizon", &horizon];
            let plan = [&["plan", "case.toml", "--quiet", "--force", "--out", "plan"], &grinding[..]];
            done(&place, &plan.concat());
            let plan: Value = serde_json::from_str(&read(&place.join("plan/plan.json"))).unwrap();
            is(number(&plan["plans"][0]["mgt"]), 2e-3, "in the plan");
        }
    }
    assert!(failed > 15, "{failed}");
}

/// A life in the decision of a run that ends with it is the traffic of that run: with wear, whose
/// removal follows the cycles that each step was predicted to take, with grinding, and with both.
#[test]
fn a_life_is_the_traffic_of_its_run() {
    let place = folder("decision", "life");
    let (wear, grinding) =
        ("wear_mm_per_mgt = 0.004\n", "grinding_mm = 0.05\ngrinding_interval_mgt = 20.0\n");
    for plan in [wear.to_owned(), grinding.to_owned(), format!("{wear}{grinding}")] {
        for control in ["increment = 0.06\n", ""] {
            let rail = RAIL.replace("increment = 0.06\n", control);
            // Without an inspection there are no further runs for it.
            let rail =
                rail.replace("[inspection]\ndetectable_depth_mm = 2.05\ncritical_depth_mm = 2.5\n", "");
            let rail = rail.replace("[growth]\n", "[growth]\ncritical_length_mm = 5.0\n");
            let text = format!("{rail}{WHEEL}{CRACK}{SECOND}[maintenance]\n{plan}");
            fs::write(place.join("case.toml"), &text).unwrap();
            done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
            let summary: Value = serde_json::from_str(&read(&place.join("run/summary.json"))).unwrap();
            assert_eq!(summary["stop"], "critical-length", "{plan}");
            let (traffic, failure) = (&summary["million_gross_tonnes"], &summary["decision"]["failure"]);
            let (traffic, life) = (number(traffic).unwrap(), number(&failure["mgt"]).unwrap());
            // A life is that of a length smaller by 1e-8 of it.
            assert!((life / traffic - 1.0).abs() < 1e-6, "{plan}{control}: {life} of {traffic}");
        }
    }
}

/// Wheels of other kinds than Hertz's strips.
const KINDS: [Part; 3] = [
    Part {
        name: "table of wheels",
        text: "\
[[wheel]]
table = \"wheels.csv\"
creepage_sign = \"vehicle\"
[traffic]
axle_load_t = 20.0
",
    },
    Part {
        name: "coupled wheel",
        text: "\
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.3
coupled = true
surface_nodes_per_half_width = 10
[traffic]
axle_load_t = 20.0
",
    },
    Part {
        name: "rolling wheel",
        text: "\
[contact]
kind = \"rolling\"
normal_kn = 100.0
semi_axes_mm = [6.75, 5.0]
creepage_x = 0.002
creepage_sign = \"contact\"
friction = 0.3
[traffic]
axle_load_t = 20.0
",
    },
];

const TABLE: &str = "\
wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm,share
1,100,0,0.002,0,0,0.3,6.75,5.0,0.7
2,80,0,-0.001,0,0,0.3,6.0,5.0,0.3
";

/// The samples of other kinds of wheels are the run, too, with and without the removal of the
/// surface.
#[test]
#[ignore = "extra: minutes"]
fn without_scatter_samples_are_the_run_under_all_kinds_of_wheels_in_full() {
    let place = folder("decision", "kinds");
    fs::write(place.join("wheels.csv"), TABLE).unwrap();
    let scatter = "[scatter]\nsamples = 20\nparis_c_log_std = 0.0\n";
    let rail = RAIL.replace("increment = 0.06", "increment = 0.1").replace("2e-11", "2e-10");
    for kind in &KINDS {
        for more in ["", MAINTENANCE.text] {
            let text = format!("{rail}{}{CRACK}{more}{scatter}", kind.text);
            fs::write(place.join("case.toml"), text).unwrap();
            done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
            let decision = decision(&place.join("run"));
            let life = number(&decision["failure"]["mgt"]).unwrap_or_else(|| panic!("{}", kind.name));
            for key in ["p05", "p50", "p95"] {
                let sampled = number(&decision["scatter"]["mgt_to_critical"][key]).unwrap();
                assert!((sampled - life).abs() <= 1e-6 * life, "{}: {life}, {sampled}", kind.name);
            }
        }
    }
}

/// In space, too, samples without scatter are the run: of a wheel, of a mix across the rail, with
/// wear and grinding, with fluid.
#[test]
#[ignore = "extra: half a minute"]
fn without_scatter_samples_are_the_run_in_space() {
    let place = folder("decision", "space");
    let rail = RAIL
        .replace("interface_elements = 8", "space_cells = 2\nspace_rings = 2")
        .replace("\"dislocation\"", "\"space\"")
        .replace("positions = 25", "positions = 15\nstep_tolerance = 0.05")
        .replace("increment = 0.06", "increment = 0.1")
        .replace("steps = 60", "steps = 6")
        .replace("2e-11", "2e-10");
    let ellipse = "half_width_mm = 6.75, lateral_half_width_mm = 5.0";
    let wheel = WHEEL.replace("half_width_mm = 6.75", &ellipse.replace(", ", "\n"));
    let mix = format!(
        "[[wheel]]\nshare = 0.6\naxle_load_t = 22.5\ncontact = {{ peak_pressure_mpa = 845.0, {ellipse}, friction = 0.3 }}\n\
         [[wheel]]\nshare = 0.4\naxle_load_t = 12.0\n\
         contact = {{ peak_pressure_mpa = 700.0, {ellipse}, friction = -0.2, lateral_mm = 4.0 }}\n"
    );
    let crack = format!("{CRACK}surface_half_length_mm = 5.0\n");
    let cases = [
        (&wheel, "", "a wheel"),
        (&mix, MAINTENANCE.text, "a mix with wear and grinding"),
        (&wheel, FLUID.text, "fluid"),
    ];
    for (wheels, more, name) in cases {
        let text = format!("{rail}{wheels}{crack}{more}[scatter]\nsamples = 20\nparis_c_log_std = 0.0\n");
        fs::write(place.join("case.toml"), text).unwrap();
        done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        let decision = decision(&place.join("run"));
        let life = number(&decision["failure"]["mgt"]).unwrap_or_else(|| panic!("{name}"));
        for key in ["p05", "p50", "p95"] {
            let sampled = number(&decision["scatter"]["mgt_to_critical"][key]).unwrap();
            assert!(
                (sampled - life).abs() <= 1e-6 * life,
                "{name}: {life} in the run, {sampled} in the samples"
            );
        }
    }
}

/// Accuracy of quantiles of the samples against whole runs. Without removal a coefficient changes
/// the traffic alone; with it the samples lie between runs at other speeds.
const SAME_QUANTILE: f64 = 0.02;

/// Quantiles of the samples are the lives of whole runs with the coefficient at those quantiles.
#[test]
#[ignore = "extra: minutes"]
fn quantiles_of_samples_are_lives_of_whole_runs_in_full() {
    let place = folder("decision", "quantiles");
    let std = 0.3;
    // Chosen increments and turns under removal, a few straight steps elsewhere.
    let removed = RAIL.replace("increment = 0.06\n", "").replace("turning_length_mm = inf\n", "");
    let fragile = "[fracture]\ntoughness_mpa_sqrt_m = 20.0\n[temperature]\nneutral_c = 25.0\nrail_c = -30.0\n\
                   [track]\nsection = \"60E1\"\nwheel_load_kn = 100.0\n";
    let all = [
        (removed.as_str(), WHEEL, MAINTENANCE),
        (&removed, WHEEL, Part { name: "wear", text: "[maintenance]\nwear_mm_per_mgt = 0.002\n" }),
        (RAIL, MIX, NETWORK),
        (RAIL, WHEEL, FLUID),
        (&RAIL.replace("= 2.5", "= 8.0"), WHEEL, Part { name: "fracture in the cold", text: fragile }),
    ];
    for (rail, wheels, part) in all {
        let case = format!("{rail}{wheels}{CRACK}{}", part.text);
        let scatter = format!("[scatter]\nsamples = 2000\nparis_c_log_std = {std}\n");
        fs::write(place.join("case.toml"), format!("{case}{scatter}")).unwrap();
        done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "sampled"]);
        let sampled = decision(&place.join("sampled"));
        let breaks = part.text.contains("[fracture]");
        assert_eq!(sampled["failure"]["mode"] == "fracture", breaks, "{}", sampled["failure"]);
        for (key, z) in [("p05", 1.644_854_f64), ("p50", 0.0), ("p95", -1.644_854)] {
            let coefficient = 2e-11 * (std * z).exp();
            let whole = case.replace("paris_c = 2e-11", &format!("paris_c = {coefficient:e}"));
            fs::write(place.join("whole.toml"), whole).unwrap();
            done(&place, &["run", "whole.toml", "--quiet", "--force", "--out", "whole"]);
            let life = number(&decision(&place.join("whole"))["failure"]["mgt"]).unwrap();
            let found = number(&sampled["scatter"]["mgt_to_critical"][key]).unwrap();
            assert!((found / life - 1.0).abs() < SAME_QUANTILE, "{} {key}: {found}, not {life}", part.name);
        }
        // The samples say how well the runs between which they lie agree.
        let accuracy = &sampled["scatter"]["between_runs"];
        assert_eq!(accuracy.is_null(), !part.text.contains("[maintenance]"), "{accuracy}");
        assert!(
            accuracy.is_null() || number(&accuracy["left_out_percent"]).unwrap() < 4.0 * 2.0,
            "{accuracy}"
        );
    }
}

/// Accuracy of the life with another friction, which is computed with all cracks.
const SAME_LIFE: f64 = 1e-6;

/// The companions of a long row follow the crack that decides with its neighbours, and the decision
/// says which, and what leaving out the others changes. The life with a friction with which the
/// crack at the other end leads, and quantiles of the samples, are those of whole runs with all
/// cracks.
#[test]
#[ignore = "extra: minutes"]
fn a_part_of_a_long_row_decides_like_the_row_in_full() {
    let place = folder("decision", "row");
    let rail = RAIL
        .replace("increment = 0.06", "increment = 0.1\ndirection = \"coplanar\"\ncritical_length_mm = 3.8")
        .replace("2.05", "1.3")
        .replace("2.5", "1.5");
    let row = "[[crack]]\nmouth_mm = 0.0\nlength_mm = 2.8\nangle_deg = 25.0\nfriction = 0.1\ncount = 20\nspacing_mm = 4.0\n";
    let case = format!("{rail}{WHEEL}{row}[maintenance]\nwear_mm_per_mgt = 0.001\n");
    let scatter = "[scatter]\nsamples = 2000\nparis_c_log_std = 0.3\n";
    fs::write(place.join("case.toml"), format!("{case}{scatter}")).unwrap();
    let told = done(&place, &["run", "case.toml", "--quiet", "--out", "row"]);
    let of_row = decision(&place.join("row"));
    let part = &of_row["part_of_row"];
    assert_eq!((&part["of"], &of_row["failure"]["crack"]), (&20.into(), &20.into()), "{part}");
    let cracks: Vec<u64> = part["cracks"].as_array().unwrap().iter().map(|c| c.as_u64().unwrap()).collect();
    assert!((4..=7).contains(&cracks.len()) && cracks.last() == Some(&20), "{part}");
    let (life, alone) = (number(&of_row["failure"]["mgt"]).unwrap(), number(&part["mgt"]).unwrap());
    let difference = number(&part["difference_percent"]).unwrap();
    assert!((100.0 * (alone / life - 1.0).abs() - difference).abs() < 1e-9, "{part}");
    assert!(difference > 0.0 && difference < 1.0, "{part}");
    let sentence = format!("to 20 of 20 alone, which changes the life by {difference:.2} %");
    assert!(told.contains(&sentence), "{told}");

    let whole = |text: &str| {
        fs::write(place.join("whole.toml"), text).unwrap();
        done(&place, &["run", "whole.toml", "--quiet", "--force", "--out", "whole"]);
        decision(&place.join("whole"))
    };
    let slow = whole(&case.replace("= 0.1\ncount", "= 0.5\ncount"));
    assert_eq!(slow["failure"]["crack"], 1, "{}", slow["failure"]);
    let (found, life) =
        (number(&of_row["frictions"][1]["mgt"]).unwrap(), number(&slow["failure"]["mgt"]).unwrap());
    assert!((found / life - 1.0).abs() < SAME_LIFE, "friction 0.5: {found}, not {life}");
    for (key, z) in [("p05", 1.644_854_f64), ("p95", -1.644_854)] {
        let other = whole(&case.replace("2e-11", &format!("{:e}", 2e-11 * (0.3 * z).exp())));
        let of_samples = |quantity: &str| number(&of_row["scatter"][quantity][key]).unwrap();
        let (found, life) = (of_samples("mgt_to_critical"), number(&other["failure"]["mgt"]).unwrap());
        assert!((found / life - 1.0).abs() < SAME_QUANTILE, "{key}: {found}, not {life}");
        let way = number(&other["inspection"]["mgt_detectable_to_critical"]).unwrap();
        let found = of_samples("mgt_detectable_to_critical");
        assert!((found / way - 1.0).abs() < SAME_QUANTILE, "{key}, from detectable: {found}, not {way}");
    }
}

/// A rail that breaks in the first step has failed, and nobody may wait for an inspection.
#[test]
fn a_rail_that_breaks_at_once_is_stopped() {
    let place = folder("decision", "at-once");
    let brittle = "[fracture]\ntoughness_mpa_sqrt_m = 8.0\ncriterion = \"k1\"\n";
    for scatter in ["", "[scatter]\nsamples = 20\n"] {
        fs::write(place.join("case.toml"), format!("{RAIL}{WHEEL}{CRACK}{brittle}{scatter}")).unwrap();
        let told = done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        assert!(told.contains("verdict: stop: fracture of crack 1 at once"), "{told}");
        assert!(!told.contains("inspection interval"), "{told}");
        let decision = decision(&place.join("run"));
        assert_eq!(decision["failure"]["mode"], "fracture");
        assert_eq!(number(&decision["failure"]["mgt"]), Some(0.0));
        assert_eq!(decision["verdict"]["reasons"][0]["kind"], "at-once");
        assert!(decision["inspection"].is_null(), "{decision}");
    }
}

/// Tonnes have months beside them where the traffic of a year is known; each wheel may have its own
/// axle load.
#[test]
fn months_are_told_with_tonnes() {
    let place = folder("decision", "months");
    let traffic = "[traffic]\nmgt_per_year = 12.0\n";
    fs::write(place.join("case.toml"), format!("{RAIL}{MIX}{traffic}{CRACK}")).unwrap();
    let told = done(&place, &["run", "case.toml", "--quiet", "--out", "run"]);
    let decision = decision(&place.join("run"));
    let reason = &decision["verdict"]["reasons"][0];
    let (life, text) = (number(&reason["mgt"]).unwrap(), reason["text"].as_str().unwrap());
    assert!((10.0..999.0).contains(&life), "{life}");
    // A million gross tonnes in a month.
    let digits = if life < 99.95 { format!("{life:.1}") } else { format!("{life:.0}") };
    assert!(text.contains(&format!("after {digits} million gross tonnes ({digits} months")), "{text}");
    let interval = number(&decision["inspection"]["interval_mgt"]).unwrap();
    assert!(told.contains(&format!("inspection interval {interval:.1} million gross tonnes (")), "{told}");
    // One wheel without a load of its own.
    let wheel = WHEEL.replace("axle_load_t = 20.0", "mgt_per_year = 12.0");
    fs::write(place.join("none.toml"), format!("{RAIL}{wheel}{CRACK}")).unwrap();
    let told = stderr(&ends(&place, &["check", "none.toml"], 2));
    assert!(told.contains("`traffic.axle_load_t` is missing"), "{told}");
    assert_eq!(told.matches("error: ").count(), 1, "{told}");
}

/// A rail that the computed steps do not bring to failure has no quantiles: its samples outlive
/// what is computed, and are not cut off there.
#[test]
fn samples_that_outlive_the_run_have_no_quantile() {
    let place = folder("decision", "censored");
    let rail = RAIL.replace("steps = 60", "steps = 60\nstop_after_cycles = 2e6");
    let scatter = "[scatter]\nsamples = 2000\nparis_c_log_std = 0.2\n";
    fs::write(place.join("case.toml"), format!("{rail}{WHEEL}{CRACK}{scatter}")).unwrap();
    done(&place, &["run", "case.toml", "--quiet", "--out", "run"]);
    let decision = decision(&place.join("run"));
    assert_eq!(decision["failure"]["mode"], "none");
    let scatter = &decision["scatter"];
    for key in ["p05", "p50", "p95"] {
        assert!(scatter["mgt_to_critical"][key].is_null(), "{scatter}");
    }
    assert_eq!(number(&scatter["outlived"]["share"]), Some(1.0));
    // The fastest of 2000 samples, about 3.3 deviations above the mean.
    let first = number(&scatter["outlived"]["mgt"]).unwrap() / 40.0;
    assert!((-4.5..-2.8).contains(&(first.ln() / 0.2)), "{first}");
    // A rail that holds with the friction of the case may fail with another one.
    let lives = decision["frictions"].as_array().unwrap();
    assert_eq!(lives.iter().map(|of| number(&of["friction"]).unwrap()).collect::<Vec<_>>(), [0.1, 0.5]);
}

/// A steep crack whose faces stick is deep from the beginning and hardly grows: the other one
/// fails, and is detectable later.
#[test]
fn the_first_failure_over_all_cracks_decides() {
    let place = folder("decision", "network");
    let still = "[[crack]]\nmouth_mm = -12.0\nlength_mm = 2.8\nangle_deg = 55.0\nfriction = 1.5\n";
    fs::write(place.join("case.toml"), format!("{RAIL}{WHEEL}{still}{CRACK}")).unwrap();
    let told = done(&place, &["run", "case.toml", "--quiet", "--out", "run"]);
    assert!(told.contains("verdict: act: critical depth of crack 2"), "{told}");
    let decision = decision(&place.join("run"));
    assert_eq!((&decision["failure"]["mode"], &decision["failure"]["crack"]), (&"depth".into(), &2.into()));
    assert_eq!(decision["crack"], 2);
    let inspection = &decision["inspection"];
    let detected = number(&inspection["mgt_to_detectable"]).unwrap();
    let failed = number(&decision["failure"]["mgt"]).unwrap();
    assert!(detected > 0.0 && detected < failed, "{inspection}");
    // The run goes straight ahead.
    let paths = &decision["paths"];
    assert_eq!((number(&paths["straight"]), number(&paths["nominal"])), (Some(failed), Some(failed)));
    assert!(number(&paths["limit"]).is_some_and(|limit| limit != failed), "{paths}");
}

/// A law that lets a crack get deeper by millimetres per million gross tonnes has no interval.
#[test]
fn what_the_model_does_not_describe_has_no_interval() {
    let place = folder("decision", "outside");
    let text = format!("{}{WHEEL}{CRACK}[scatter]\nsamples = 100\n", RAIL.replace("2e-11", "2e-8"));
    fs::write(place.join("case.toml"), text).unwrap();
    let told = done(&place, &["run", "case.toml", "--quiet", "--out", "run"]);
    assert!(told.contains("verdict: outside") && !told.contains("inspection interval"), "{told}");
    let decision = decision(&place.join("run"));
    assert_eq!(decision["verdict"]["level"], "outside");
    assert_eq!(decision["verdict"]["reasons"][0]["kind"], "rate");
    assert!(decision["inspection"].is_null());
    assert!(decision["scatter"]["mgt_detectable_to_critical"]["p50"].is_null());
}

/// The probabilities of failure before detection with their intervals.
fn risks(decision: &Value) -> Vec<(f64, f64)> {
    let risk = decision["risk"].as_array().unwrap().iter();
    risk.map(|at| (number(&at["interval_mgt"]).unwrap(), number(&at["probability"]).unwrap())).collect()
}

/// Each crack from the detectable depth on is found: the risk of the run, and of samples without
/// scatter, is max(0, 1 − N/T) with the traffic N from detectable to failure.
#[test]
fn the_risk_of_a_step_is_its_closed_form() {
    let place = folder("decision", "risk");
    let rail = RAIL.replace("[inspection]\n", "[inspection]\ntarget_risk = 0.25\n");
    for scatter in ["", "[scatter]\nsamples = 50\nparis_c_log_std = 0.0\n"] {
        fs::write(place.join("case.toml"), format!("{rail}{WHEEL}{CRACK}{scatter}")).unwrap();
        let told = done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        let decision = decision(&place.join("run"));
        let way = number(&decision["inspection"]["mgt_detectable_to_critical"]).unwrap();
        let risks = risks(&decision);
        assert!(risks.len() > 8, "{risks:?}");
        for (interval, probability) in risks {
            let want = (1.0 - way / interval).max(0.0);
            // Depths of samples are kept in single precision.
            let tolerance = if scatter.is_empty() { 1e-9 } else { 1e-6 };
            assert!((probability - want).abs() < tolerance, "every {interval}: {probability}, not {want}");
        }
        let interval = number(&decision["interval_for_target_mgt"]).unwrap();
        // Found by bisection to 0.1 %.
        assert!((interval / (way / 0.75) - 1.0).abs() < 1.5e-3, "{interval} {way}");
        // The interval by the safety factor misses nothing, and is the one to act on.
        let by_safety = number(&decision["inspection"]["interval_mgt"]);
        assert_eq!(number(&decision["act_on"]["interval_mgt"]), by_safety);
        assert_eq!(decision["act_on"]["basis"], "safety-factor");
        assert_eq!(told.matches("interval").count(), 1, "{told}");
        assert_eq!(number(&decision["risk_at_interval"]["probability"]), Some(0.0));
    }
}

/// A probability of detection that does not depend on the depth: (1 − q)^n by n inspections, or one
/// more, by the phase.
#[test]
fn a_constant_probability_of_detection_misses_with_its_power() {
    let place = folder("decision", "constant");
    fs::write(place.join("pod.csv"), "depth_mm,probability\n0.0,0.4\n9.0,0.4\n").unwrap();
    let rail = RAIL.replace("[inspection]\n", "[inspection]\npod = \"pod.csv\"\n");
    fs::write(place.join("case.toml"), format!("{rail}{WHEEL}{CRACK}")).unwrap();
    done(&place, &["run", "case.toml", "--quiet", "--out", "run"]);
    let decision = decision(&place.join("run"));
    // Risks are those along the path with the shortest life.
    let life = number(&decision["inspection"]["mgt_to_critical"]).unwrap();
    for (interval, probability) in risks(&decision) {
        let count = life / interval;
        let want = 0.6f64.powf(count.floor()) * (1.0 - 0.4 * count.fract());
        assert!((probability - want).abs() < 1e-3, "every {interval}: {probability}, not {want}");
    }
}

/// Scatter of the coefficient alone: some samples fail where the run does not, and their risk is
/// above a small target.
#[test]
fn a_risk_above_its_target_asks_for_action() {
    let place = folder("decision", "target");
    let rail = RAIL.replace("[inspection]\n", "[inspection]\ntarget_risk = 1e-3\n");
    let rail = rail.replace("steps = 60", "steps = 60\nstop_after_cycles = 3.5e6");
    let grinding = "[maintenance]\nwear_mm_per_mgt = 0.001\n";
    let scatter = "[scatter]\nsamples = 4000\nparis_c_log_std = 0.4\n";
    let case = |detected: &str| {
        let rail = rail.replace("detectable_depth_mm = 2.05", detected);
        format!("{rail}{WHEEL}{CRACK}{grinding}{scatter}")
    };
    fs::write(place.join("case.toml"), case("detectable_depth_mm = 2.45")).unwrap();
    let told = done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
    let decision = decision(&place.join("run"));
    assert_eq!(decision["failure"]["mode"], "none", "{told}");
    assert_eq!(decision["verdict"]["level"], "act", "{told}");
    let reason = &decision["verdict"]["reasons"][0];
    assert_eq!(reason["kind"], "risk");
    assert!(number(&reason["value"]).unwrap() > number(&reason["limit"]).unwrap());
    let risks = risks(&decision);
    assert!(risks.windows(2).all(|pair| pair[1].1 >= pair[0].1), "{risks:?}");
}

/// The rail is replaced at its wear limit: neither a failure nor a crack that is worn away.
#[test]
fn a_rail_worn_to_its_limit_is_replaced() {
    let place = folder("decision", "wear-limit");
    let wears = "[maintenance]\nwear_mm_per_mgt = 0.02\nwear_limit_mm = 0.8\n";
    let scatter = "[scatter]\nsamples = 200\nparis_c_log_std = 0.2\nwear_std = 0.002\n";
    fs::write(place.join("case.toml"), format!("{RAIL}{WHEEL}{CRACK}{wears}{scatter}")).unwrap();
    let told = done(&place, &["run", "case.toml", "--quiet", "--out", "run"]);
    assert!(told.contains("wear-limit at step") && told.contains("verdict: ok: the rail is worn"), "{told}");
    let decision = decision(&place.join("run"));
    assert_eq!((&decision["verdict"]["level"], &decision["failure"]["mode"]), (&"ok".into(), &"none".into()));
    assert!((number(&decision["maintenance"]["mgt_to_wear_limit"]).unwrap() - 40.0).abs() < 1e-9);
    assert!((number(&decision["verdict"]["reasons"][0]["mgt"]).unwrap() - 40.0).abs() < 1e-6);
    // Samples that are replaced have not outlived the run.
    assert!(decision["scatter"]["outlived"].is_null(), "{}", decision["scatter"]);
}

/// A grinding that takes the surface down to a tip that had turned up cuts off a flake: its size is
/// told, and it is a failure only of a rail whose case calls one so thin a failure.
#[test]
fn a_flake_that_a_grinding_cuts_off_is_no_failure() {
    let place = folder("decision", "flake");
    let case = "\
[contact]
peak_pressure_mpa = 800.0
half_width_mm = 6.0
friction = 0.2
[passage]
positions = 25
[[crack]]
points_mm = [[0.0, 0.0], [0.8, -0.4], [1.1, -0.18]]
friction = 0.4
[growth]
critical_length_mm = 8.0
[traffic]
axle_load_t = 20.0
[inspection]
detectable_depth_mm = 0.8
critical_depth_mm = 2.7
[solver]
engine = \"dislocation\"
[maintenance]
grinding_mm = 0.2
grinding_interval_mgt = 5.0
first_grinding_mgt = 0.001
";
    let decided = |more: &str| {
        fs::write(place.join("case.toml"), format!("{case}{more}")).unwrap();
        done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        let summary: Value = serde_json::from_str(&read(&place.join("run/summary.json"))).unwrap();
        let piece = &summary["pieces"][0];
        // Between the crack and the new surface, 0.2 mm deeper: a triangle of half that height.
        let (thickness, area) =
            (number(&piece["thickness_mm"]).unwrap(), number(&piece["area_mm2"]).unwrap());
        assert!((thickness - 0.2).abs() < 1e-3, "{piece}");
        assert!((area - 0.5 * 0.2 * (0.4 + 0.2 * 0.3 / 0.22)).abs() < 0.01, "{piece}");
        assert_eq!(piece["cause"], "grinding");
        decision(&place.join("run"))
    };
    let of = decided("");
    assert_eq!((&of["verdict"]["level"], &of["failure"]["mode"]), (&"ok".into(), &"none".into()), "{of}");
    assert!(of["verdict"]["reasons"][0]["text"].as_str().unwrap().contains("flake 0.200 mm thick"), "{of}");
    let of = decided("least_spall_mm = 0.1\n");
    assert_eq!((&of["verdict"]["level"], &of["failure"]["mode"]), (&"stop".into(), &"spall".into()), "{of}");
}

/// A case that says what a failure is needs no number of steps; one that says nothing has 25.
#[test]
fn a_run_without_a_number_of_steps_goes_on_until_its_answer_is_known() {
    let place = folder("decision", "open");
    let rail = RAIL.replace("steps = 60\n", "").replace("increment = 0.06", "increment = 0.005");
    let summary = |rail: &str| -> Value {
        fs::write(place.join("case.toml"), format!("{rail}{WHEEL}{CRACK}")).unwrap();
        done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        serde_json::from_str(&read(&place.join("run/summary.json"))).unwrap()
    };
    let of = summary(&rail);
    assert_eq!(of["stop"], "critical-depth");
    // From 2 to 2.5 mm in steps of half a per cent.
    assert!((40..60).contains(&of["steps"].as_u64().unwrap()), "{}", of["steps"]);
    assert_eq!(of["decision"]["failure"]["mode"], "depth");
    let of = summary(&rail.replace("critical_depth_mm = 2.5\n", ""));
    assert_eq!((&of["stop"], &of["steps"]), (&"steps-done".into(), &25.into()));
    assert_eq!(of["verdict"]["level"], "unknown");
}

/// Verdict and interval are those of the path with the shortest life, and the terminal says which.
#[test]
fn the_shortest_path_governs() {
    let place = folder("decision", "paths");
    let rail = RAIL.replace("turning_length_mm = inf\n", "").replace("steps = 60\n", "");
    let mut governed = Vec::new();
    for straight in ["straight_to_mm = 0.0", "straight_to_mm = 2.5"] {
        let rail = rail.replace("[growth]\n", &format!("[growth]\n{straight}\n"));
        fs::write(place.join("case.toml"), format!("{rail}{WHEEL}{CRACK}")).unwrap();
        let told = done(&place, &["run", "case.toml", "--quiet", "--force", "--out", "run"]);
        let decision = decision(&place.join("run"));
        let paths = &decision["paths"];
        let lives =
            ["nominal", "straight", "limit"].map(|path| number(&paths[path]).unwrap_or(f64::INFINITY));
        let shortest = lives.iter().copied().fold(f64::INFINITY, f64::min);
        let reason = &decision["verdict"]["reasons"][0];
        assert!((number(&reason["mgt"]).unwrap() / shortest - 1.0).abs() < 1e-5, "{reason} {paths}");
        let critical = number(&decision["inspection"]["mgt_to_critical"]).unwrap();
        assert!((critical / shortest - 1.0).abs() < 1e-5, "{critical} {paths}");
        let by = decision["governed_by"].as_str().unwrap();
        let note = match by {
            "straight" => "straight ahead",
            "limit" => "along the limit path",
            _ => "million gross tonnes",
        };
        assert!(told.lines().any(|line| line.starts_with("verdict") && line.contains(note)), "{told}");
        governed.push(by.to_owned());
        if straight.ends_with("2.5") {
            // The run goes straight as far as it goes.
            assert!((lives[0] / lives[1] - 1.0).abs() < 5e-3, "{paths}");
        }
    }
    assert!(governed.iter().any(|path| path != "nominal"), "{governed:?}");
}
