//! Studies: which cases they make, and everything that is said of wrong ones.

use railcrack::contact::FluidModel;
use railcrack_case::{Case, CaseErrors, Combine, Engine, Input, Overrides, PlaneEngine, Study, study_schema};
use serde_json::json;
use std::path::Path;

const XFEM: Engine = Engine::Plane(PlaneEngine::Xfem);

/// A good study of 6 runs in lines 1 to 14; what is appended to it begins on line 15.
const GOOD: &str = "\
title = \"Study\"
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = [0.025, 0.4]
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = [15.0, 30.0, 45.0]
friction = 0.5
[passage]
positions = 61
[solver]
engine = \"dislocation\"
";

fn parse_with(text: &str, overrides: &Overrides) -> Result<Study, CaseErrors> {
    Study::parse_with(text, "study.toml", Path::new("no-such-folder"), overrides)
}

fn study(text: &str) -> Study {
    parse_with(text, &Overrides::default()).unwrap_or_else(|errors| panic!("{errors}\n{text}"))
}

fn replaced(old: &str, new: &str) -> String {
    assert!(GOOD.contains(old), "{old}");
    GOOD.replacen(old, new, 1)
}

/// Wheel friction, length and angle (degrees) of the crack of every run.
fn values(study: &Study) -> Vec<[f64; 3]> {
    let of = |case: &Case| {
        let crack = &case.cracks.cracks()[0];
        let (first, next) = crack.segment(0);
        [
            case.first_wheel().wheel.contact().unwrap().adhesion(),
            crack.length(),
            -(next - first).angle().to_degrees(),
        ]
        .map(|value| (value * 1e9).round() / 1e9)
    };
    study.runs.iter().map(|run| of(&run.case)).collect()
}

#[test]
fn a_product_takes_every_value_with_every_other() {
    let study = study(GOOD);
    assert_eq!((study.combine, study.axes.len()), (Combine::Product, 2));
    let want = [
        [0.025, 6.0, 15.0],
        [0.025, 6.0, 30.0],
        [0.025, 6.0, 45.0],
        [0.4, 6.0, 15.0],
        [0.4, 6.0, 30.0],
        [0.4, 6.0, 45.0],
    ];
    assert_eq!(values(&study), want);
    let run = &study.runs[4];
    assert_eq!((run.number, run.choice.as_slice()), (5, [1, 1].as_slice()));
    assert_eq!(run.label, "friction = 0.4, angle_deg = 30");
    assert_eq!(run.folder, "005");
    assert_eq!(run.case.title, "Study: friction = 0.4, angle_deg = 30");
}

#[test]
fn a_run_is_the_case_with_its_values() {
    let study = study(GOOD);
    let by_hand = replaced("[0.025, 0.4]", "0.4")
        .replace("[15.0, 30.0, 45.0]", "30.0")
        .replace("\"Study\"", "\"Study: friction = 0.4, angle_deg = 30\"")
        + "[output]\nfields = false\nfaces = \"none\"\nsif = \"ends\"\nplots = false\nreport = false\n";
    assert_eq!(study.runs[4].case, Case::parse(&by_hand, "case.toml", Path::new("")).unwrap());
}

#[test]
fn a_zip_takes_the_lists_together() {
    let text = replaced("[0.025, 0.4]", "[0.1, 0.1, 0.3]") + "[study]\ncombine = \"zip\"\n";
    let study = study(&text);
    assert_eq!((study.combine, study.axes.len()), (Combine::Zip, 1));
    assert_eq!(values(&study), [[0.1, 6.0, 15.0], [0.1, 6.0, 30.0], [0.3, 6.0, 45.0]]);
}

#[test]
fn keys_that_go_together_are_one_axis_of_a_product() {
    let text = replaced("length_mm = 6.0", "length_mm = [4.0, 5.0, 6.0]")
        + "[study]\ntogether = [[\"crack.angle_deg\", \"crack[1].length_mm\"]]\ncolour_by = \"crack[1].length_mm\"\n";
    let study = study(&text);
    let keys: Vec<Vec<&str>> =
        study.axes.iter().map(|axis| axis.variations.iter().map(|v| v.key.as_str()).collect()).collect();
    assert_eq!(keys, [vec!["contact.friction"], vec!["crack[1].length_mm", "crack[1].angle_deg"]]);
    assert_eq!(study.colour_axis, 1);
    assert_eq!(values(&study)[3..], [[0.4, 4.0, 15.0], [0.4, 5.0, 30.0], [0.4, 6.0, 45.0]]);
}

#[test]
fn keys_with_one_name_are_told_apart() {
    let text = replaced("friction = 0.5", "friction = [0.1, 0.2]");
    let names = |text: &str| -> Vec<String> {
        study(text).axes.iter().flat_map(|axis| &axis.variations).map(|v| v.name.clone()).collect()
    };
    assert_eq!(names(&text), ["contact.friction", "angle_deg", "crack[1].friction"]);
    let second = "[[crack]]\nmouth_mm = 30.0\nlength_mm = 6.0\nangle_deg = [15.0, 20.0]\nfriction = 0.5\n";
    assert_eq!(names(&format!("{GOOD}{second}")), ["friction", "crack[1].angle_deg", "crack[2].angle_deg"]);
}

#[test]
fn lists_vary_as_lists_of_lists() {
    let crack = "points_mm = [[[0.0, 0.0], [4.0, -1.0]], [[0.0, 0.0], [4.0, -1.0], [6.0, -1.2]]]";
    let text = replaced("mouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = [15.0, 30.0, 45.0]", crack)
        + "[output]\nfields_over_a = [[0.0], [], [1.0, 2.0]]\n";
    let study = study(&text);
    assert_eq!(study.runs.len(), 2 * 2 * 3);
    let last = &study.runs[11];
    assert_eq!(last.case.cracks.cracks()[0].points().len(), 3);
    assert_eq!(last.case.fields.over_a, [1.0, 2.0]);
    assert_eq!(
        last.label,
        "friction = 0.4, points_mm = [[0.0, 0.0], [4.0, -1.0], [6.0, -1.2]], fields_over_a = [1.0, 2.0]"
    );
    assert_eq!(last.folder, "012");
    // A list that is a value does not vary.
    assert!(
        matches!(Input::parse_with("[output]\nfields_over_a = []", "x", Path::new(""), &Overrides::default()), Err(errors) if errors.errors().len() == 2)
    );
}

#[test]
fn words_and_counts_vary_too() {
    let text = replaced("\"dislocation\"", "[\"xfem\", \"dislocation\"]").replace("= 61", "= [21, 41]");
    let study = study(&text);
    assert_eq!(study.runs.len(), 24);
    assert_eq!(study.runs[0].case.engine(), XFEM);
    let last = &study.runs[23];
    assert_eq!(
        (last.case.engine(), last.case.first_wheel().passages.passage.positions),
        (Engine::Plane(PlaneEngine::Dislocation), 41)
    );
    assert!(last.label.ends_with("positions = 41, engine = dislocation"), "{}", last.label);
}

#[test]
fn options_take_the_place_of_single_values() {
    let overrides = Overrides { steps: Some(3), engine: Some("xfem".into()), ..Overrides::default() };
    let study = parse_with(GOOD, &overrides).unwrap();
    assert!(study.runs.iter().all(|run| run.case.growth.steps == 3 && run.case.engine() == XFEM));
}

/// Two wheels, with a list in the contact of the first and a distribution in that of the second.
const MIX: &str = "\
[[wheel]]
share = 0.5
contact = { peak_pressure_mpa = 900.0, half_width_mm = 6.0, friction = [0.1, 0.3] }
[[wheel]]
share = 0.5
[wheel.contact]
peak_pressure_mpa = 800.0
half_width_mm = 6.0
friction = 0.2
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 30.0
friction = 0.3
";

#[test]
fn keys_within_a_wheel_vary() {
    let of_runs = |study: &Study| -> Vec<[f64; 2]> {
        let shear = |case: &Case| [0, 1].map(|i| case.wheels[i].wheel.contact().unwrap().adhesion());
        study.runs.iter().map(|run| shear(&run.case)).collect()
    };
    let listed = study(MIX);
    assert_eq!(listed.axes[0].variations[0].key, "wheel[1].contact.friction");
    assert_eq!(of_runs(&listed), [[0.1, 0.2], [0.3, 0.2]]);
    let drawn =
        MIX.replace("[0.1, 0.3]", "0.1").replace("friction = 0.2\n", "friction = { uniform = [0.2, 0.4] }\n");
    let drawn = study(&format!("{drawn}[study]\nsamples = 8\n"));
    assert_eq!(drawn.axes[0].variations[0].key, "wheel[2].contact.friction");
    assert!(of_runs(&drawn).iter().all(|[one, two]| *one == 0.1 && (0.2..=0.4).contains(two)));
    let settings = vec!["wheel[2].contact.friction=0.05".to_owned()];
    let set = parse_with(MIX, &Overrides { settings, ..Overrides::default() }).unwrap();
    assert_eq!(of_runs(&set), [[0.1, 0.05], [0.3, 0.05]]);
}

#[test]
fn cases_and_studies_are_told_apart() {
    let is_study = |text: &str| {
        matches!(Input::parse_with(text, "x", Path::new(""), &Overrides::default()), Ok(Input::Study(_)))
    };
    let single = replaced("[0.025, 0.4]", "0.1").replace("[15.0, 30.0, 45.0]", "15.0");
    assert!(is_study(GOOD));
    assert!(!is_study(&single));
    assert!(Input::parse_with(&single, "x", Path::new(""), &Overrides::default()).is_ok());
    let as_case = Case::parse(GOOD, "s.toml", Path::new("")).unwrap_err();
    assert_eq!(as_case.errors().len(), 2, "{as_case}");
    assert!(as_case.errors()[0].help().unwrap().contains("railcrack sweep"), "{as_case}");
    let declared = Case::parse(&format!("{GOOD}[study]\n"), "s.toml", Path::new("")).unwrap_err();
    assert_eq!(declared.errors().len(), 1, "{declared}");
    assert!(declared.to_string().contains("`railcrack sweep s.toml` computes it"), "{declared}");
}

/// A study that is wrong in one way: its text, and line, key, a piece of the message and a piece of
/// the help of the only error.
struct Wrong {
    text: String,
    line: usize,
    key: &'static str,
    says: &'static str,
    helps: &'static str,
}

fn wrong(text: String, line: usize, key: &'static str, says: &'static str, helps: &'static str) -> Wrong {
    Wrong { text, line, key, says, helps }
}

fn appended(lines: &str) -> String {
    format!("{GOOD}{lines}")
}

fn check(wrong: &[Wrong], overrides: &Overrides) {
    for want in wrong {
        let text = &want.text;
        let errors = parse_with(text, overrides).err().unwrap_or_else(|| panic!("accepted:\n{text}"));
        let first = &errors.errors()[0];
        let line = first.position().map_or(0, |(line, _)| line);
        assert_eq!(errors.errors().len(), 1, "one thing is wrong, one error:\n{text}\n{errors}");
        assert_eq!((line, first.key().unwrap_or_default()), (want.line, want.key), "\n{text}\n{errors}");
        assert!(first.message().contains(want.says), "`{}` in the message of\n{errors}", want.says);
        let help = first.help().unwrap_or_default();
        assert!(help.contains(want.helps), "`{}` in the help of\n{errors}", want.helps);
    }
}

#[test]
fn wrong_lists() {
    let single = replaced("[0.025, 0.4]", "0.1").replace("[15.0, 30.0, 45.0]", "15.0");
    let many = format!(
        "[{}]",
        (1..=4000).map(|i| format!("{}", 0.0001 * f64::from(i))).collect::<Vec<_>>().join(", ")
    );
    check(
        &[
            wrong(single, 0, "", "nothing varies", "`railcrack run study.toml`"),
            wrong(
                replaced("[0.025, 0.4]", "[]"),
                5,
                "contact.friction",
                "at least one element",
                "must be a number in [-1, 1]",
            ),
            wrong(replaced("\"Study\"", "[\"a\", \"b\"]"), 1, "title", "cannot vary", "title"),
            // A single wrong element is named, once, whatever it is combined with.
            wrong(
                replaced("30.0, 45.0]", "30.0,\n180.0]"),
                10,
                "crack[1].angle_deg",
                "`crack[1].angle_deg = 180.0`: must be a number in [0.5, 179.5] degrees",
                "",
            ),
            wrong(replaced("0.4]", "\"a\"]"), 5, "contact.friction", "not a string", "without quotes"),
            wrong(replaced("0.4]", "[0.4]]"), 5, "contact.friction", "`contact.friction = [0.4]`", ""),
            wrong(
                replaced("[0.025, 0.4]", &many),
                5,
                "",
                "4000 x 3 are more than 10000 runs",
                "shorter lists",
            ),
            wrong(
                replaced("[0.025, 0.4]", "[0.4, 0.4]"),
                9,
                "",
                "runs 1 and 4 of the study are the same",
                "given twice",
            ),
            // What is wrong with the case itself is said once.
            wrong(
                replaced("positions = 61", "positons = 61"),
                12,
                "passage.positons",
                "unknown key",
                "nearest",
            ),
            wrong(appended("x = 1\n"), 15, "solver.x", "unknown key", "nearest"),
        ],
        &Overrides::default(),
    );
    check(
        &[wrong(
            replaced("\"dislocation\"", "[\"xfem\", \"dislocation\"]"),
            14,
            "solver.engine",
            "`--engine xfem` would override `solver.engine`",
            "leave the option out",
        )],
        &Overrides { engine: Some("xfem".into()), ..Overrides::default() },
    );
}

#[test]
fn keys_of_one_word_of_a_list_are_for_its_runs() {
    let fluid = |models: &str| {
        format!("{GOOD}[fluid]\nmodel = [{models}]\npressure_cap_mpa = 100.0\nbulk_modulus_mpa = 2200.0\n")
    };
    let listed = study(&fluid("\"none\", \"mouth\", \"trapped\""));
    let models: Vec<Option<FluidModel>> = listed.runs[..3]
        .iter()
        .map(|run| run.case.first_wheel().fluid.as_ref().map(|fluid| fluid.model))
        .collect();
    let trapped = FluidModel::Trapped { bulk_modulus: 2200.0, leak: true };
    assert_eq!(models, [None, Some(FluidModel::Mouth { cap: 100.0 }), Some(trapped)]);
    // Where no run has the word, the key is as wrong as in a case.
    let errors = parse_with(&fluid("\"none\", \"trapped\""), &Overrides::default()).unwrap_err();
    assert!(errors.to_string().contains("`fluid.pressure_cap_mpa` needs model = \"mouth\""), "{errors}");
}

#[test]
fn wrong_combinations() {
    // 200 mm leave the given rail, which ends at ±150 mm, at 15° and 30°, but not at 45°: so do 4
    // of 12 runs.
    let rail = "[rail]\nwidth_mm = 300.0\n";
    let wrong_in_some = replaced("length_mm = 6.0", "length_mm = [6.0, 200.0]") + rail;
    // 400 mm are longer than the rail at any angle: the element alone is wrong.
    let wrong_by_itself = replaced("length_mm = 6.0", "length_mm = [6.0, 400.0]") + rail;
    check(
        &[
            wrong(
                wrong_in_some,
                7,
                "crack[1].mouth_mm",
                "the crack leaves the rail at x = 193",
                "in run 4 of the study (friction = 0.025, length_mm = 200, angle_deg = 15) and 3 others",
            ),
            wrong(wrong_by_itself.clone(), 8, "crack[1].length_mm", "`crack[1].length_mm = 400.0`", "[rail]"),
        ],
        &Overrides::default(),
    );
    let errors = parse_with(&wrong_by_itself, &Overrides::default()).unwrap_err();
    assert!(!errors.to_string().contains("in run"), "{errors}");
    assert_eq!(errors.errors()[0].position(), Some((8, 19)), "{errors}");
}

#[test]
fn wrong_settings() {
    let zip = "[study]\ncombine = \"zip\"\n";
    let of = |line: &str| appended(&format!("[study]\n{line}\n"));
    check(
        &[
            wrong(
                appended(zip),
                9,
                "crack[1].angle_deg",
                "`crack[1].angle_deg` has 3 values and `contact.friction` has 2",
                "\"product\"",
            ),
            wrong(of("combine = \"sum\""), 16, "study.combine", "must be \"product\" or \"zip\"", "nearest"),
            wrong(of("colour = \"a\""), 16, "study.colour", "unknown key", "`colour_by`"),
            wrong(
                of("colour_by = \"crack.length_mm\""),
                16,
                "study.colour_by",
                "`crack.length_mm` does not vary",
                "nearest: `crack[1].angle_deg`",
            ),
            wrong(
                of("together = [[\"contact.friction\", \"crack.angle_deg\"]]"),
                9,
                "crack[1].angle_deg",
                "must have the same length",
                "together",
            ),
            wrong(
                of("together = [[\"contact.friction\", \"contact.frction\"]]"),
                16,
                "study.together",
                "`contact.frction` does not vary",
                "varying keys: contact.friction, crack[1].angle_deg",
            ),
            wrong(
                of("together = [[\"contact.friction\", \"contact.friction\"]]"),
                16,
                "study.together",
                "named twice",
                "one group",
            ),
            wrong(of("together = [[\"contact.friction\"]]"), 16, "study.together", "group 1 must be", "[["),
            wrong(of("together = \"contact.friction\""), 16, "study.together", "not a string", ""),
            wrong(
                appended(&format!("{zip}together = [[\"contact.friction\", \"crack.angle_deg\"]]\n")),
                17,
                "study.together",
                "all lists are combined element by element",
                "product",
            ),
            wrong(appended("[[study]]\n"), 15, "study", "must be written `[study]`", ""),
        ],
        &Overrides::default(),
    );
}

#[test]
fn the_schema_of_a_study_allows_lists() {
    let schema = study_schema();
    let friction = &schema["properties"]["contact"]["properties"]["friction"];
    assert_eq!(friction["anyOf"][0]["maximum"], json!(1.0));
    assert_eq!(friction["anyOf"][1]["items"], friction["anyOf"][0]);
    assert_eq!(friction["anyOf"][1]["minItems"], json!(1));
    let points = &schema["properties"]["crack"]["items"]["properties"]["points_mm"]["anyOf"];
    assert_eq!(points[1]["items"]["minItems"], json!(2));
    assert_eq!(schema["properties"]["title"]["type"], json!("string"));
    assert_eq!(schema["properties"]["study"]["properties"]["combine"]["enum"], json!(["product", "zip"]));
    let alternatives = json!([{ "required": ["contact"] }, { "required": ["wheel"] }]);
    assert_eq!((&schema["required"], &schema["allOf"][0]["oneOf"]), (&json!(["crack"]), &alternatives));
}
