//! A wheel that feels the cracks, from the case file to the tables.

use super::common::{self, done, numbers, read};

/// A quick pair of cracks under a driving wheel.
const CASE: &str = "\
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = -0.2
coupled = true
surface_nodes_per_half_width = 20
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 45.0
friction = 0.1
[[crack]]
mouth_mm = 3.0
length_mm = 4.0
angle_deg = 60.0
friction = 0.1
[passage]
positions = 61
[growth]
steps = 4
[solver]
engine = \"dislocation\"
";

/// Tables of a run.
const TABLES: [&str; 4] = ["sif.csv", "growth.csv", "faces.csv", "contact.csv"];

#[test]
fn a_killed_run_resumes_to_the_same_files_with_any_number_of_threads() {
    let folder = common::folder("coupled", "killed");
    std::fs::write(folder.join("felt.toml"), CASE).unwrap();
    done(&folder, &["run", "felt.toml", "--out", "whole", "--quiet", "--threads", "1"]);
    common::killed_run(&folder, ("felt.toml", "killed"), 4);
    done(&folder, &["run", "felt.toml", "--out", "killed", "--quiet", "--resume", "--threads", "3"]);
    for file in TABLES {
        assert!(read(&folder.join("whole").join(file)) == read(&folder.join("killed").join(file)), "{file}");
    }
    assert!(numbers(&folder.join("whole/contact.csv"), "step").contains(&4.0));
}

#[test]
fn wheels_of_a_mix_feel_the_cracks_each_as_its_own_section_says() {
    let folder = common::folder("coupled", "mix");
    let case = CASE.replace("steps = 4", "steps = 0");
    let (contact, rest) = case.split_once("[[crack]]").unwrap();
    let second = contact.replace("friction = -0.2", "friction = 0.1");
    let wheel = |contact: &str| {
        format!("[[wheel]]\nshare = 0.5\n{}", contact.replace("[contact]", "[wheel.contact]"))
    };
    let uncoupled = second.split_once("coupled = true").unwrap().0;
    let write = |name: &str, text: &str| {
        std::fs::write(folder.join(format!("{name}.toml")), text).unwrap();
        done(&folder, &["run", &format!("{name}.toml"), "--quiet"]);
        numbers(&folder.join(name).join("sif.csv"), "kii_mpa_sqrt_m")
    };
    let mix = write("mix", &format!("{}{}[[crack]]{rest}", wheel(contact), wheel(uncoupled)));
    let first = write("first", &case);
    let other = write("other", &format!("{uncoupled}[[crack]]{rest}"));
    // The passages of the wheels stand one behind the other in the table of a mix.
    let of_both: Vec<f64> = first.iter().chain(&other).copied().collect();
    assert_eq!(mix.len(), of_both.len());
    assert!(mix == of_both, "a wheel of the mix has another history than alone");
    assert!(read(&folder.join("mix/sif.csv")).contains("lip_load_n_per_mm"));
}
