//! Sessions of a page against runs of the library, and what they refuse.

use railcrack_case::Case;
use railcrack_run::simulation::Simulation;
use railcrack_web::{Refusal, Session};
use serde_json::Value;
use std::path::Path;

const CASE: &str = r#"
[contact]
peak_pressure_mpa = 1000.0
half_width_mm = 6.75
friction = -0.2

[[crack]]
mouth_mm = 0.0
length_mm = 3.0
angle_deg = 25.0
friction = 0.3

[growth]
steps = 2

[passage]
positions = 61

[mesh]
interface_elements = 12

[traffic]
axle_load_t = 22.5

[inspection]
detectable_depth_mm = 1.3
critical_depth_mm = 1.33

[scatter]
samples = 1000
seed = 4

[solver]
engine = "dislocation"
"#;

/// A session that has ended, and what its steps gave.
fn ended(text: &str) -> (Session, Vec<Value>) {
    let mut session = Session::begin(text).unwrap();
    let mut steps = Vec::new();
    while !session.has_ended() {
        steps.push(session.step().unwrap());
    }
    (session, steps)
}

fn refusals(text: &str) -> Vec<Refusal> {
    Session::begin(text).err().unwrap()
}

#[test]
fn a_session_has_the_tables_and_the_decision_of_the_run() {
    let (mut session, steps) = ended(CASE);
    assert_eq!(steps.len(), 3);
    let case = Case::parse(CASE, "case", Path::new("")).unwrap();
    let (run, ending) = Simulation::new(&case).run_in_memory(Path::new(""), None);
    ending.unwrap();
    // The same computation: the same bits.
    let tables = session.tables().unwrap();
    assert_eq!(tables["sif.csv"], run.sif_table().unwrap());
    assert_eq!(tables["growth.csv"], run.growth_table().unwrap());
    let decision = session.decide().unwrap()["decision"].clone();
    let expected = serde_json::to_value(run.summary()).unwrap()["decision"].clone();
    assert_eq!(decision, expected);
    // With everything that is not computed step by step.
    assert!(decision["paths"]["straight"].is_number());
    assert_eq!(decision["scatter"]["samples"], 1000);
    // The step that the page shows is that of the table.
    let row = run.growth_rows().next().unwrap();
    assert_eq!(steps[0]["tips"][0]["delta_kii_mpa_sqrt_m"], row.delta_kii);
    assert_eq!(steps[0]["passage"]["xc_mm"].as_array().unwrap().len(), 61);
}

#[test]
fn an_ended_session_has_no_further_step() {
    let (mut session, _) = ended(&CASE.replace("steps = 2", "steps = 0"));
    assert_eq!(session.step().unwrap(), Value::Null);
}

#[test]
fn errors_of_a_case_have_their_line() {
    let [refusal] = &refusals(&CASE.replace("friction = -0.2", "friction = 7"))[..] else {
        panic!("one error")
    };
    assert!(refusal.message.contains("[-1, 1]"), "{refusal:?}");
    assert_eq!(refusal.position.unwrap().0, 5);
}

#[test]
fn a_page_refuses_with_a_sentence_what_it_cannot_compute() {
    for (edit, says) in [
        (CASE.replace("\"dislocation\"", "\"xfem\""), "a page computes with \"dislocation\" only"),
        (format!("{CASE}\n[plastic_stress]\n"), "a page does not balance a plastic stress"),
        (CASE.replace("positions = 61", "positions = 61\nfrom_over_a = 'x'"), "from_over_a"),
        (
            CASE.replace("friction = 0.3", "friction = 0.3\ncount = 60\nspacing_mm = 4.0")
                .replace("interface_elements = 12", "interface_elements = 80"),
            "unknowns of contact",
        ),
    ] {
        let refusals = refusals(&edit);
        assert!(refusals.iter().any(|refusal| refusal.message.contains(says)), "{says}: {refusals:?}");
    }
}
