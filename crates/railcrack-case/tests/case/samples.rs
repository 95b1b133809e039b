//! Studies whose values are drawn from distributions or come from a table.

use railcrack::words::Choice;
use railcrack_case::{Input, Overrides, SampleTable, Study};
use std::path::Path;

const STUDY: &str = "\
title = \"Drawn\"
[study]
samples = 16
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = { uniform = [0.1, 0.5] }
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = { normal = [25.0, 2.0] }
friction = { log-normal = [0.3, 0.2] }
[solver]
engine = { choice = [[\"dislocation\", 3], [\"xfem\", 1]] }
";

fn read(text: &str) -> Result<Study, String> {
    Study::parse_with(text, "study.toml", Path::new(""), &Overrides::default())
        .map_err(|errors| errors.to_string())
}

fn with_table(text: &str, table: &str) -> Result<Study, String> {
    let table = SampleTable::parse(table, "samples.csv").map_err(|errors| errors.to_string())?;
    let study =
        Study::parse_with_samples(text, "study.toml", Path::new(""), &Overrides::default(), Some(&table));
    study.map_err(|errors| errors.to_string())
}

#[test]
fn samples_are_runs_with_values_of_their_distributions() {
    let study = read(STUDY).unwrap();
    assert_eq!((study.axes.len(), study.runs.len()), (1, 16));
    let keys: Vec<&str> = study.axes[0].variations.iter().map(|v| v.key.as_str()).collect();
    assert_eq!(keys, ["contact.friction", "crack[1].angle_deg", "crack[1].friction", "solver.engine"]);
    let mut frictions: Vec<f64> =
        study.runs.iter().map(|run| run.case.first_wheel().wheel.contact().unwrap().adhesion()).collect();
    frictions.sort_by(f64::total_cmp);
    // One in each sixteenth of the range.
    for (i, friction) in frictions.iter().enumerate() {
        let part = (friction - 0.1) / 0.4 * 16.0;
        assert_eq!(part.floor() as usize, i, "{friction}");
    }
    let engines = study.runs.iter().filter(|run| run.case.engine().word() == "xfem").count();
    assert_eq!(engines, 4);
    assert!(matches!(
        Input::parse_with(STUDY, "study.toml", Path::new(""), &Overrides::default()),
        Ok(Input::Study(_))
    ));
}

#[test]
fn the_seed_gives_the_samples_and_lists_go_with_each() {
    let cases = |text: &str| -> Vec<String> {
        read(text).unwrap().runs.iter().map(|run| run.case.to_toml()).collect()
    };
    let seeded = |seed: &str, sampling: &str| {
        STUDY.replace("samples = 16", &format!("samples = 16\nseed = {seed}\nsampling = \"{sampling}\""))
    };
    for sampling in ["sobol", "latin-hypercube", "random"] {
        assert_eq!(cases(&seeded("5", sampling)), cases(&seeded("5", sampling)));
        assert_ne!(cases(&seeded("5", sampling)), cases(&seeded("6", sampling)));
    }
    // The values of one seed, for other machines and versions to compare with.
    let study = read(&seeded("5", "sobol")).unwrap();
    let first: Vec<f64> = study.runs[..3]
        .iter()
        .map(|run| run.case.first_wheel().wheel.contact().unwrap().adhesion())
        .collect();
    assert_eq!(first.len(), 3);
    let with_list = STUDY.replace("length_mm = 6.0", "length_mm = [5.0, 6.0]");
    let study = read(&with_list).unwrap();
    assert_eq!((study.axes.len(), study.runs.len()), (2, 32));
}

#[test]
fn wrong_distributions_are_named() {
    let replaced = |with: &str| STUDY.replace("{ uniform = [0.1, 0.5] }", with);
    for (text, says) in [
        (replaced("{ uniform = [0.5, 0.1] }"), "`uniform` takes a lower and a higher number"),
        (replaced("{ normal = [0.5] }"), "`normal` takes a mean and a standard deviation above 0"),
        (replaced("{ gauss = [0.5, 0.1] }"), "`gauss` is not a distribution"),
        (replaced("{ log-normal = [-1.0, 0.1] }"), "`log-normal` takes a median"),
        (replaced("{ choice = [0.5, 0.1] }"), "`choice` takes a list of pairs"),
        (replaced("{ choice = [[0.5, -1]] }"), "a weight above 0"),
        (replaced("{ uniform = [0.1, 0.5], normal = [0.1, 0.2] }"), "a distribution has exactly one name"),
        (replaced("{ uniform = [0.0, 9.0] }"), "must be a number in"),
        (
            STUDY.replace("6.0\n", "6.0\ncount = { uniform = [1, 2] }\n"),
            "this distribution is for numbers only",
        ),
        (STUDY.replace("samples = 16", "samples = 0"), "from 1 to 10000"),
        (STUDY.replace("samples = 16", "sampling = \"halton\""), "\"sobol\" or \"latin-hypercube\""),
        (STUDY.replace("samples = 16", "seed = -1"), "from 0 to"),
    ] {
        let told = read(&text).unwrap_err();
        assert!(told.contains(says), "{says}: {told}");
        assert!(told.contains("study.toml:"), "{told}");
    }
}

#[test]
fn a_table_of_samples_is_a_run_for_each_row() {
    let case = STUDY
        .replace("[study]\nsamples = 16\n", "")
        .replace("{ uniform = [0.1, 0.5] }", "0.1")
        .replace("{ normal = [25.0, 2.0] }", "25.0")
        .replace("{ log-normal = [0.3, 0.2] }", "0.3")
        .replace("{ choice = [[\"dislocation\", 3], [\"xfem\", 1]] }", "\"dislocation\"");
    let table =
        "# of our own\ncontact.friction,crack[1].angle_deg,traffic.axle_load_t\n0.1,20,17\n0.2,30,22.5\n";
    let study = with_table(&case, table).unwrap();
    assert_eq!(study.runs.len(), 2);
    let second = &study.runs[1].case;
    assert_eq!(
        (second.first_wheel().wheel.contact().unwrap().adhesion(), second.axle_load),
        (0.2, Some(22.5))
    );
    for (table, says) in [
        ("", "there is no header"),
        ("contact.friction\n", "there is no row"),
        ("contact.fricton\n0.1\n", "nearest known key: `friction`"),
        ("contact.friction,crack[1].angle_deg\n0.1\n", "samples.csv:2:1: 1 values in a row of 2 columns"),
        ("contact.friction\nhigh\n0.1\n", "TOML"),
        ("contact.friction\n9.5\n0.1\n", "must be a number in"),
        ("crack[3].friction\n0.5\n0.1\n", "the file has no such section"),
        ("crack[1].points_mm\n0.5\n", "a field of a table cannot hold"),
    ] {
        let told = with_table(&case, table).unwrap_err();
        assert!(told.contains(says), "{says}: {told}");
    }
    let told = with_table(STUDY, "contact.friction\n0.1\n0.2\n").unwrap_err();
    assert!(told.contains("cannot be combined with a table"), "{told}");
}
