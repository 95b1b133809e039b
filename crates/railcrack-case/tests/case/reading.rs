//! Good case files: what they mean, and that writing them back changes nothing.

use proptest::prelude::*;
use railcrack::contact::FluidModel;
use railcrack::fatigue::{GrowthLaw, RateLaw};
use railcrack::growth::{GrowthSettings, PassageSettings};
use railcrack::math::RailBox;
use railcrack_case::{Case, ContactSolver, Engine, Input, Overrides, PlaneEngine, init_text};
use std::path::{Path, PathBuf};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn shipped(name: &str) -> PathBuf {
    Path::new(ROOT).join("cases").join(name)
}

fn parse(text: &str) -> Case {
    Case::parse(text, "case.toml", Path::new("")).unwrap()
}

fn reference_with(crack: &str, rest: &str) -> Case {
    parse(&format!(
        "[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0.025\n[[crack]]\n{crack}\nfriction = 0.5\n{rest}"
    ))
}

/// Writes the case as a run folder would, reads it again.
fn rewritten(case: &Case, folder: &Path) -> Case {
    for companion in case.companions() {
        let path = folder.join(companion.name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, companion.text).unwrap();
    }
    let path = folder.join("case.toml");
    std::fs::write(&path, case.to_toml()).unwrap();
    Case::read(&path).unwrap()
}

fn temporary(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn defaults_are_the_reference_case() {
    let short = reference_with("mouth_mm = 0\nlength_mm = 6\nangle_deg = 15", "");
    let mut long = parse(&init_text());
    assert_eq!(long.title, "Reference case, Table 1");
    long.title = short.title.clone();
    assert_eq!(format!("{:?}", short.growth), format!("{:?}", long.growth));
    // Without a given increment, the increments are chosen for a tolerance.
    let chosen = GrowthSettings { increment: 0.02, tolerance: Some(0.01), ..GrowthSettings::default() };
    assert_eq!(short.growth, chosen);
    assert_eq!(short.growth.law, GrowthLaw::RAIL_STEEL);
    assert_eq!((short.steel.young(), short.steel.poisson()), (210e3, 0.3));
    assert_eq!(short.first_wheel().passages, PassageSettings::default());
    assert_eq!(short.rail, RailBox::default());
    assert_eq!(
        (short.engine(), short.contact_solver()),
        (Engine::Plane(PlaneEngine::Xfem), ContactSolver::Newton)
    );
    assert_eq!(
        (long.cracks.clone(), long.first_wheel().passages.passage, long.rail),
        (short.cracks.clone(), short.first_wheel().passages.passage, short.rail)
    );
}

#[test]
fn every_shipped_case_is_good_and_survives_a_run_folder() {
    let mut count = 0;
    for entry in std::fs::read_dir(shipped("")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let cases: Vec<Case> =
                match Input::read_with(&path, &Overrides::default()).unwrap_or_else(|e| panic!("{e}")) {
                    Input::Case(case) => vec![*case],
                    Input::Study(study) => study.runs.into_iter().map(|run| run.case).collect(),
                };
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            for case in cases {
                assert_eq!(rewritten(&case, &temporary(&name)), case, "{name}");
                count += 1;
            }
        }
    }
    assert!(count >= 6, "{count}");
}

#[test]
fn the_reference_case_is_what_init_writes_with_the_path_of_the_paper() {
    let mut text = init_text();
    for (by_default, of_the_paper) in [
        ("\n# increment = 0.04\n", "\nincrement = 0.04\n"),
        ("\nturning = \"smooth\"\n", "\nturning = \"kink\"\n"),
        ("\nturning_length_mm = 0.5\n", "\n# turning_length_mm = 0.5\n"),
        ("\nkink_angle_deg = 30.0 ", "\n# kink_angle_deg = 30.0 "),
    ] {
        assert!(text.contains(by_default), "{by_default}");
        text = text.replacen(by_default, of_the_paper, 1);
    }
    assert_eq!(std::fs::read_to_string(shipped("reference.toml")).unwrap(), text);
}

/// First and last position of the passage, mm.
fn ends(case: &Case) -> (f64, f64) {
    let passage = case.first_wheel().passages.passage;
    (passage.from, passage.to)
}

#[test]
fn nine_cracks() {
    let case = Case::read(&shipped("network-nine.toml")).unwrap();
    let mouths: Vec<f64> = case.cracks.cracks().iter().map(|c| c.points()[0].x).collect();
    assert_eq!(mouths, (0..9).map(|i| 3.375 * f64::from(i)).collect::<Vec<_>>());
    assert_eq!(case.crack_friction, vec![0.5; 9]);
    assert_eq!(ends(&case), (-40.5, 67.5));
    assert_eq!(case.rail.centre, 13.5);
    assert!(case.to_toml().contains("\ncentre_mm = 13.5\n"), "defaults are filled in");
    assert_eq!(case.growth.steps, 5);
}

#[test]
fn passage_towards_minus_x_exchanges_the_mouths() {
    let crack = "mouth_mm = 10\nlength_mm = 6\nangle_deg = 165\ncount = 2\nspacing_mm = 20";
    let case = reference_with(crack, "[passage]\nfrom_over_a = 6\nto_over_a = -5");
    assert_eq!(ends(&case), (30.0 + 40.5, 10.0 - 33.75));
    let case = reference_with(crack, "[passage]\nfrom_over_a = -6\nto_over_a = 5");
    assert_eq!(ends(&case), (10.0 - 40.5, 30.0 + 33.75));
}

#[test]
fn contact_from_line_load() {
    let case = parse(
        "[contact]\nline_load_n_per_mm = 8959.4\nwheel_radius_mm = 460.9\nrail_radius_mm = inf\nfriction = 0\n\
         [[crack]]\npoints_mm = [[0, -1], [5, -2]]\nfriction = 0\n",
    );
    assert!((case.first_wheel().wheel.contact().unwrap().peak_pressure() - 845.0).abs() < 0.05);
    assert!((case.half_width() - 6.75).abs() < 5e-4);
    assert_eq!(case.cracks.cracks()[0].tips().len(), 2);
    assert!(case.to_toml().contains("rail_radius_mm = inf\n"));
}

#[test]
fn the_command_line_takes_the_place_of_the_file() {
    let text = init_text();
    let overrides = Overrides {
        steps: Some(3),
        engine: Some("dislocation".into()),
        contact: Some("latin".into()),
        ..Overrides::default()
    };
    let case = Case::parse_with(&text, "case.toml", Path::new(""), &overrides).unwrap();
    assert_eq!((case.growth.steps, case.contact_solver()), (3, ContactSolver::Latin));
    assert_eq!(case.engine(), Engine::Plane(PlaneEngine::Dislocation));
    assert!(case.to_toml().contains("\nsteps = 3\n") && case.to_toml().contains("\ncontact = \"latin\"\n"));

    let wrong = Overrides {
        steps: Some(u64::MAX),
        engine: Some("fem".into()),
        contact: Some("x".into()),
        ..Overrides::default()
    };
    let errors = Case::parse_with(&text, "case.toml", Path::new(""), &wrong).unwrap_err();
    let lines: Vec<String> = errors.errors().iter().map(|e| e.one_line()).collect();
    assert_eq!(lines.len(), 3, "{lines:?}");
    assert!(
        lines[0].starts_with("command line: `--steps (too large)`: must be an integer from 0"),
        "{lines:?}"
    );
    assert!(
        lines[1].contains("`--engine fem`: must be \"xfem\" or \"dislocation\" or \"space\""),
        "{lines:?}"
    );
    assert!(lines[2].contains("`--contact x`: must be \"newton\" or \"latin\""), "{lines:?}");
}

#[test]
fn the_command_line_may_say_one_of_two_keys_that_go_together() {
    let row = "mouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0\n";
    let text = format!(
        "[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0\n[[crack]]\n{row}count = 3\nspacing_mm = 20\n"
    );
    let cracks = |settings: &[&str]| {
        let settings = settings.iter().map(|given| (*given).to_owned()).collect();
        let overrides = Overrides { settings, ..Overrides::default() };
        let case = Case::parse_with(&text, "case.toml", Path::new(""), &overrides);
        case.map(|case| case.cracks.cracks().len()).map_err(|errors| errors.to_string())
    };
    assert_eq!(cracks(&[]), Ok(3));
    assert_eq!(cracks(&["crack[1].count=2"]), Ok(2));
    assert_eq!(cracks(&["crack[1].count=1"]), Ok(1));
    assert_eq!(cracks(&["crack[1].spacing_mm=10.0"]), Ok(3));
    assert_eq!(cracks(&["crack[1].count=2", "crack[1].spacing_mm=10.0"]), Ok(2));
}

#[test]
fn profile_errors_name_the_line_of_the_profile() {
    let folder = temporary("profiles");
    let case = init_text() + "\n[residual_stress]\nprofile = \"p.csv\"\n";
    std::fs::write(folder.join("case.toml"), case).unwrap();
    for (profile, line, says) in [
        ("", 1, "empty"),
        ("# nothing\n\n", 1, "empty"),
        ("depth_mm,sxx_mpa\n", 1, "at least one row"),
        ("depth,sxx_mpa\n0,1\n", 1, "unknown column `depth`; nearest known column: `depth_mm`"),
        ("# a\nsxx_mpa,szz_mpa\n0,1\n", 2, "`depth_mm` is missing"),
        ("depth_mm,sxx_mpa,sxx_mpa\n0,1,1\n", 1, "given twice"),
        ("depth_mm,sxx_mpa\n0,25\n1,-110,3\n", 3, "3 values in a row of 2 columns"),
        ("depth_mm,sxx_mpa\n0,25\n\n1,abc\n", 4, "`sxx_mpa = abc`"),
        ("depth_mm,sxx_mpa\n0,nan\n", 2, "`sxx_mpa = nan`"),
        ("depth_mm,sxx_mpa\n0,1\n1,\n", 3, "row 2: `sxx_mpa` is blank"),
        ("depth_mm,sxx_mpa\n-1,25\n", 2, "must not be negative"),
        ("# a\r\ndepth_mm,sxx_mpa\r\n0,25\r\n0,30\r\n", 4, "must exceed"),
        ("depth_mm;sxx_mpa\n0;25\n", 2, "the only row"),
        ("depth_mm;sxx_mpa\nm;MPa\n0;25\n1;0\n", 2, "`depth_mm` is in mm, but the row of units has m"),
    ] {
        std::fs::write(folder.join("p.csv"), profile).unwrap();
        let errors = Case::read(&folder.join("case.toml")).unwrap_err();
        let error = &errors.errors()[0];
        assert!(error.file().ends_with("p.csv"), "{errors}");
        assert_eq!(error.position().map(|p| p.0), Some(line), "{profile:?}: {errors}");
        assert!(error.message().contains(says), "{profile:?}: {errors}");
    }
    std::fs::write(folder.join("p.csv"), b"depth_mm,sxx_mpa\n0,\xff\n").unwrap();
    let errors = Case::read(&folder.join("case.toml")).unwrap_err();
    assert!(
        errors.to_string().contains("p.csv:2:3: ") && errors.to_string().contains("not UTF-8"),
        "{errors}"
    );
    std::fs::remove_file(folder.join("p.csv")).unwrap();
    std::fs::create_dir(folder.join("p.csv")).unwrap();
    let errors = Case::read(&folder.join("case.toml")).unwrap_err();
    assert!(errors.to_string().contains("it is a folder"), "{errors}");
}

#[test]
fn windows_line_ends_and_byte_order_mark() {
    let text = format!("\u{feff}{}", init_text().replace('\n', "\r\n"));
    assert_eq!(parse(&text), parse(&init_text()));
}

#[test]
fn titles_that_need_escapes() {
    let title = "back\\slash, \"quotes\" and µ\u{7f}".trim_end_matches('\u{7f}');
    let text = format!("title = '{title}'\n{}", init_text().replace("title =", "# title ="));
    let case = parse(&text);
    assert_eq!(case.title, title);
    assert_eq!(parse(&case.to_toml()), case);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// Any accepted numbers survive being written and read again, bit for bit.
    #[test]
    fn written_back_is_equal(
        pressure in 1e-3..1e4f64,
        half_width in 0.01..50f64,
        wheel in -1.0..1.0f64,
        length in 1e-3..50f64,
        angle in 0.5..179.5f64,
        friction in 0.0..2.0f64,
        from in -1e3..1e3f64,
        c in 1e-30..4e-4f64,
        steps in 0..10_000u32,
    ) {
        let case = parse(&format!(
            "[contact]\npeak_pressure_mpa = {pressure:e}\nhalf_width_mm = {half_width:e}\nfriction = {wheel:?}\n\
             [[crack]]\nmouth_mm = 0\nlength_mm = {length:?}\nangle_deg = {angle:?}\nfriction = {friction:?}\n\
             [passage]\nfrom_over_a = {from:?}\nto_over_a = 2000e-1\n[growth]\nparis_c = {c:?}\nsteps = {steps}\n\
             critical_length_mm = {length:?}\n"
        ));
        let again = parse(&case.to_toml());
        prop_assert_eq!(&again, &case);
        prop_assert_eq!(again.to_toml(), case.to_toml());
        let RateLaw::Paris(law) = case.growth.law.rate else { panic!("the default is Paris' law") };
        prop_assert_eq!(law.c.to_bits(), c.to_bits());
    }

    /// Whatever is written, it is read or refused: never a panic.
    #[test]
    fn any_text_is_read_or_refused(
        index in 0..1000usize,
        piece in "[-\\[\\]{}=,.\"#a-z0-9_\\n\u{e9}]{0,6}",
    ) {
        let text = init_text();
        let mut at = index * text.len() / 1000;
        while !text.is_char_boundary(at) {
            at += 1;
        }
        let text = format!("{}{piece}{}", &text[..at], &text[at..]);
        if let Err(errors) = Case::parse(&text, "case.toml", Path::new("")) {
            prop_assert!(!errors.errors().is_empty());
            for error in errors.errors() {
                prop_assert!(error.span().is_none() || error.position().is_some(), "{}", error.one_line());
            }
        }
    }
}

#[test]
fn fields_are_read_and_written_back() {
    let fragment = "[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0.1\n[[crack]]\nmouth_mm = 0\n\
                    length_mm = 6\nangle_deg = 15\nfriction = 0\n";
    let read = |text: &str| Case::parse(text, "case.toml", Path::new("")).unwrap();
    let plain = read(fragment);
    assert_eq!((plain.fields.over_a.as_slice(), plain.fields.every), (&[-1.0, 0.0, 1.0][..], 25));
    let given = read(&format!("{fragment}[output]\nfields_over_a = [2, -0.5]\nfields_every = 0\n"));
    assert_eq!((given.fields.over_a.as_slice(), given.fields.every), (&[2.0, -0.5][..], 0));
    assert!(given.to_toml().contains("fields_over_a = [2.0, -0.5]\nfields_every = 0\n"));
    assert_eq!(read(&given.to_toml()).fields, given.fields);
}

/// Laws with constants of their own, and back.
#[test]
fn growth_laws() {
    let minimal = "[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0.025\n\
        [[crack]]\nmouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0.5\n[growth]\n";
    for (lines, law) in [
        ("law = \"walker\"\nwalker_gamma = 0.4", "da/dN = 2e-9 [dK/(1-R)^0.6000]^3.33"),
        ("law = \"bold\"", "da/dN = 5.07e-10 (dK^3.74 - 4^3.74)"),
        ("law = \"paris-threshold\"\nthreshold_mpa_sqrt_m = 4", "da/dN = 2e-9 (dK^3.33 - 4^3.33)"),
        ("law = \"forman\"\nequivalent = \"tanaka\"", "da/dN = 5e-8 dK^3/((1-R) 60 - dK)"),
        (
            "law = \"nasgro\"\nequivalent = \"richard\"",
            "da/dN = 1e-9 [(1-f)/(1-R) dK]^3 (1 - 5/dK)^0.5/(1 - Kmax/40)^0.5",
        ),
        ("direction = \"mts\"", "da/dN = 2e-9 dK^3.33"),
    ] {
        let case = parse(&format!("{minimal}{lines}\n"));
        assert_eq!(case.growth.law.rate.formula(), law);
        assert_eq!(parse(&case.to_toml()), case, "{lines}");
    }
    let sheared = parse(&format!("{minimal}threshold_mpa_sqrt_m = 4\nthreshold_2_mpa_sqrt_m = 13\n"));
    assert_eq!(sheared.growth.law.threshold_2, 13.0);
    assert_eq!(sheared.growth.law.shear_threshold().unwrap(), "growth where (dKI/4)^2 + (dKII/13)^2 > 1");
    assert_eq!(parse(&sheared.to_toml()), sheared);
    assert_eq!(sheared.number("growth.threshold_2_mpa_sqrt_m").unwrap(), 13.0);
    let held = parse(&format!("{minimal}steel = \"R260\"\nthreshold_2_mpa_sqrt_m = 13\n"));
    assert_eq!(held.growth.law.threshold_2, 13.0);
    assert_eq!(parse(&held.to_toml()), held);
    let steel = parse(&format!("{minimal}steel = \"R260\"\n"));
    assert_eq!(steel.growth_steel.map(|steel| steel.name), Some("R260"));
    assert!((steel.growth.law.rate.rate(10.0, 0.0) / 17e-6 - 1.0).abs() < 1e-12);
    assert_eq!(parse(&steel.to_toml()), steel);
    // Typical growth has thresholds of both modes, of which a case may replace the second.
    let typical = parse(&format!("{minimal}steel = \"R260-typical\"\n"));
    assert_eq!(typical.growth.law.rate.formula(), "da/dN = 3.03e-10 (dK^4 - 6^4)");
    assert_eq!(typical.growth.law.threshold_2, 3.5);
    assert_eq!(parse(&typical.to_toml()), typical);
    let other = parse(&format!("{minimal}steel = \"R350HT-typical\"\nthreshold_2_mpa_sqrt_m = 5\n"));
    assert_eq!(other.growth.law.threshold_2, 5.0);
    assert_eq!(parse(&other.to_toml()), other);
    let none = parse(&format!("{minimal}steel = \"U71Mn\"\n"));
    assert_eq!((none.growth.law.threshold_2, none.growth_steel.unwrap().name), (0.0, "U71Mn"));
}

/// Wheels with contacts, loads and temperatures of their own.
#[test]
fn a_mix_of_wheels_is_read_and_written() {
    let case = parse(
        "[[crack]]\nmouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0.5\n\
         [temperature]\nrail_c = 5\nneutral_c = 25\n\
         [[wheel]]\nname = \"freight\"\nshare = 0.7\naxle_load_t = 22.5\n\
         contact = { peak_pressure_mpa = 1000, half_width_mm = 7, friction = 0.1 }\n\
         [[wheel]]\nshare = 0.3\naxle_load_t = 15\n\
         [wheel.contact]\nkind = \"carter\"\npeak_pressure_mpa = 800\nhalf_width_mm = 5\nfriction = 0.3\ntraction = 0.5\n\
         [wheel.temperature]\nrail_c = -10\nneutral_c = 25\n\
         [inspection]\ndetectable_depth_mm = 2.0\n[scatter]\nsamples = 1000\n",
    );
    assert_eq!(
        (case.wheels.len(), &case.wheels[0].name[..], &case.wheels[1].name[..]),
        (2, "freight", "wheel 2")
    );
    assert_eq!(case.axle_load, Some(0.7 * 22.5 + 0.3 * 15.0));
    // Positions count in the half-width of each wheel.
    assert_eq!([0, 1].map(|i| case.wheels[i].passages.passage.to), [42.0, 30.0]);
    let rail = |i: usize| case.wheels[i].wheel.temperature.unwrap().rail;
    assert_eq!([rail(0), rail(1)], [5.0, -10.0]);
    assert_eq!((case.half_width(), case.scatter.unwrap().c_log_std), (7.0, case.calibration.log_std));
    let again = parse(&case.to_toml());
    assert_eq!(again, case, "{}", case.to_toml());
}

/// Wheels that run either way, over wet and dry cracks.
#[test]
fn a_wheel_of_a_mix_has_its_own_direction_and_fluid() {
    let text = |wheels: &str| {
        format!(
            "[[crack]]\nmouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0.5\ncount = 2\nspacing_mm = 20\n\
             [passage]\nfrom_over_a = -8.0\nto_over_a = 5.0\n[fluid]\nmodel = \"trapped\"\n{wheels}"
        )
    };
    let contact = "contact = { peak_pressure_mpa = 1000, half_width_mm = 5, friction = 0.1 }\n";
    let wheels = format!(
        "[[wheel]]\nshare = 0.5\ndirection = \"-x\"\nfluid = false\n{contact}\
         [[wheel]]\nshare = 0.3\n{contact}\
         [[wheel]]\nshare = 0.2\ndirection = \"+x\"\nfluid = {{ model = \"mouth\", pressure_cap_mpa = 100 }}\n{contact}"
    );
    let case = parse(&text(&wheels));
    let passages = [0, 1, 2].map(|i| case.wheels[i].passages.passage);
    assert_eq!(passages.map(|passage| passage.from), [20.0 + 40.0, -40.0, -40.0]);
    assert_eq!(passages.map(|passage| passage.to), [-25.0, 20.0 + 25.0, 20.0 + 25.0]);
    let fluids = [0, 1, 2].map(|i| case.wheels[i].fluid.as_ref().map(|fluid| fluid.model));
    assert_eq!(fluids[0], None);
    assert!(matches!(fluids[1], Some(FluidModel::Trapped { .. })));
    assert_eq!(fluids[2], Some(FluidModel::Mouth { cap: 100.0 }));
    assert!(case.first_wheel().fluid.is_none() && case.has_fluid());
    assert_eq!(parse(&case.to_toml()), case, "{}", case.to_toml());
}

/// The yield stress follows the steel of the section, or that of the growth law.
#[test]
fn the_yield_stress_of_a_steel() {
    let of = |text: &str| {
        let case = parse(&format!(
            "[contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0.1\n\
             [[crack]]\nmouth_mm = 0\nlength_mm = 6\nangle_deg = 15\nfriction = 0.5\n{text}"
        ));
        assert_eq!(parse(&case.to_toml()), case, "{}", case.to_toml());
        case.shakedown.hardening.yield_stress()
    };
    assert_eq!(of(""), 500.0);
    assert_eq!(of("[shakedown]\nsteel = \"R350HT\"\n"), 800.0);
    assert_eq!(of("[growth]\nsteel = \"R260\"\n"), 480.0);
    assert_eq!(of("[growth]\nsteel = \"R260\"\n[shakedown]\nsteel = \"R350HT\"\n"), 800.0);
    assert_eq!(of("[growth]\nsteel = \"R260\"\n[shakedown]\nyield_stress_mpa = 450\n"), 450.0);
}

#[test]
fn an_error_in_a_section_that_wheels_share_is_reported_once() {
    let wheel = |name: &str| {
        format!(
            "[[wheel]]\nname = \"{name}\"\nshare = 0.5\n[wheel.contact]\npeak_pressure_mpa = 800.0\nhalf_width_mm = 6.0\nfriction = 0.1\n"
        )
    };
    let text = format!(
        "[[crack]]\nmouth_mm = 0.0\nlength_mm = 5.0\nangle_deg = 25.0\nfriction = 0.3\n\
         [track]\nwheel_load_kn = 100.0\nsection = \"60E1\"\naxles_mm = [0.0, 1800.0]\naxle_loads_kn = [100.0]\n{}{}",
        wheel("one"),
        wheel("other")
    );
    let errors = Case::parse(&text, "case.toml", Path::new("")).unwrap_err();
    let lines: Vec<String> = errors.errors().iter().map(|error| error.one_line()).collect();
    assert!(lines.len() == 1 && lines[0].contains("axle_loads_kn"), "{lines:?}");
}

#[test]
fn the_most_similar_file_is_named_where_there_is_none() {
    let folder = std::env::temp_dir().join(format!("railcrack-similar-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("base.toml"), init_text()).unwrap();
    let missing = |name: &str| {
        let errors = Case::read(&folder.join(name)).unwrap_err();
        errors.errors()[0].help().map(str::to_owned)
    };
    let near = missing("base.tml").unwrap();
    assert!(near.starts_with("nearest: `") && near.ends_with("base.toml`"), "{near}");
    assert_eq!(missing("something-else.csv"), None);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_free_front_needs_no_key_but_its_own() {
    let text = include_str!("bad_input/good/space.toml");
    let parsed = |keys: &str| parse(&format!("{text}\n[growth]\n{keys}"));
    let harmonics = |case: &Case| {
        let shape = case.space().unwrap().shapes[0];
        shape.deviation.map(|deviation| (deviation.harmonics(), deviation.largest()))
    };
    assert_eq!(harmonics(&parsed("front = \"free\"\n")), Some((6, 0.0)));
    assert_eq!(harmonics(&parsed("front = \"free\"\nfront_harmonics = 8\n")), Some((8, 0.0)));
    assert_eq!(harmonics(&parsed("front = \"ellipse\"\n")), None);
}
