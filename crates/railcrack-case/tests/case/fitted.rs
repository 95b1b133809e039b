//! Numbers of a case that are fitted.

use railcrack_case::{CalibrationPrior, Case, CaseErrors, Overrides, Scatter};
use std::path::Path;

const CRACK: &str = "[contact]
peak_pressure_mpa = 845
half_width_mm = 6.75
friction = 0.1
[[crack]]
mouth_mm = 0
length_mm = 6
angle_deg = 15
friction = 0.4
[[crack]]
mouth_mm = 30
length_mm = 5
angle_deg = 20
friction = 0.5
";

fn read(rest: &str, overrides: &Overrides) -> Result<Case, CaseErrors> {
    // Dotted keys of the top stand before the first section.
    let text = if rest.starts_with('[') { format!("{CRACK}{rest}") } else { format!("{rest}{CRACK}") };
    Case::parse_with(&text, "case.toml", Path::new(""), overrides)
}

/// The case with a coefficient `factor` times as large: its key, and the case as it is written.
fn fitted(rest: &str, factor: f64) -> (String, Case) {
    let case = read(rest, &Overrides::default()).unwrap();
    let coefficient = case.coefficient().unwrap();
    let fitted = read(rest, &coefficient.overrides(factor * coefficient.value)).unwrap();
    (coefficient.key.to_owned(), Case::parse(&fitted.to_toml(), "fitted.toml", Path::new("")).unwrap())
}

/// The rate at 12 MPa√m and R = 0.3 is in proportion to the coefficient, and nothing else changes.
#[test]
fn every_law_and_spelling_has_its_coefficient_fitted() {
    for (key, rest) in [
        ("paris_c", "[traffic]\naxle_load_t = 20\n"),
        ("paris_c", "[growth]\n# paris_c = 1e-9 was for other rails\nparis_c = 3e-9 # paris_c\n"),
        ("paris_c", "growth.steps = 3\ngrowth.paris_c = 3E-9\n"),
        ("paris_c", "growth = { \"paris_c\"=3.0e-9, law = 'paris-threshold', threshold_mpa_sqrt_m = 2 }\n"),
        ("bold_c", "[growth]\nlaw = \"bold\"\n"),
        ("walker_c", "[growth]\nlaw = \"walker\"\nequivalent = \"tanaka\"\n  walker_c   =   1e-9\n"),
        ("forman_c", "[growth]\nlaw = \"forman\"\n"),
        ("nasgro_c", "[growth]\nnasgro_kc = 50\nlaw = \"nasgro\"\n"),
        ("paris_c", "[growth]\nsteel = \"R350HT\"\n[traffic]\naxle_load_t = 20\n[scatter]\nsamples = 10\n"),
    ] {
        let before = read(rest, &Overrides::default()).unwrap();
        let (found, after) = fitted(rest, 1.7);
        assert_eq!(found, key, "{rest}");
        let rate = |case: &Case| case.growth.law.rate.rate(12.0, 0.3);
        assert!((rate(&after) / rate(&before) - 1.7).abs() < 1e-12, "{rest}");
        let mut same = after.growth.clone();
        same.law.rate = before.growth.law.rate.clone();
        // Without its name a steel leaves its scatter from rail to rail.
        let of_steel = before.growth_steel.is_some();
        let scatter = before
            .scatter
            .map(|own| Scatter { c_log_std: if of_steel { own.rail_log_std } else { own.c_log_std }, ..own });
        assert_eq!((same, after.scatter), (before.growth, scatter), "{rest}");
        assert!(after.growth_steel.is_none());
    }
}

/// As long as a case is not calibrated, ln C scatters as the prior of the suite; afterwards as the
/// calibration says, by default from rail to rail.
#[test]
fn scatter_of_an_uncalibrated_case_is_the_prior() {
    let law = |rest: &str| {
        let text = format!("[growth]\nsteel = \"R350HT\"\n[traffic]\naxle_load_t = 20\n[scatter]\n{rest}");
        let scatter = read(&text, &Overrides::default()).unwrap().scatter.unwrap();
        (scatter.c_log_std, scatter.rail_log_std)
    };
    let (prior, rail) = law("");
    assert_eq!((prior, rail), (CalibrationPrior::PLANE.log_std, 0.3));
    assert_eq!(law("[calibration]\nprior_log_std = 0.7\n"), (0.7, rail));
    assert_eq!(law("[calibration]\nsites = 3\n"), (rail, rail));
    assert_eq!(law("paris_c_log_std = 0.45\n[calibration]\nsites = 3\n"), (0.45, 0.45));
}

#[test]
fn a_table_of_rates_is_refused_with_the_reason() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(
        folder.join("measured-rates.csv"),
        "delta_keq_mpa_sqrt_m,rate_mm_per_cycle\n5,1e-7\n50,1e-3\n",
    )
    .unwrap();
    let text = format!(
        "{CRACK}[growth]\nlaw = \"table\"\ntable_profile = \"measured-rates.csv\"\n# paris_c = 2e-9\n"
    );
    let refused = Case::parse(&text, "case.toml", folder).unwrap().coefficient().unwrap_err().to_string();
    assert!(
        refused.starts_with("`growth.law = \"table\"`: the rates of `measured-rates.csv` have no"),
        "{refused}"
    );
}

#[test]
fn a_number_is_found_in_its_own_section() {
    let mix = "[[wheel]]\nshare = 0.5\naxle_load_t = 20\n[wheel.contact]\npeak_pressure_mpa = 845\nhalf_width_mm = 6.75\nfriction = 0.1\n";
    let track = "[wheel.track]\nwheel_load_kn = 100\nfoundation_mpa = 50\nsection = \"60E1\"\n";
    let case = read("[passage]\npositions = 61\n", &Overrides::default()).unwrap();
    for (key, value) in [
        ("contact.friction", 0.1),
        ("crack.friction", 0.4),
        ("crack[1].friction", 0.4),
        ("crack[2].friction", 0.5),
        ("growth.paris_m", 3.33),
    ] {
        assert_eq!(case.number(key), Ok(value), "{key}");
    }
    let crack = CRACK.split_at(CRACK.find("[[crack]]").unwrap()).1;
    let mixed = Case::parse(&format!("{mix}{mix}{track}{crack}"), "mix.toml", Path::new("")).unwrap();
    assert_eq!(mixed.number("wheel[2].track.wheel_load_kn"), Ok(100.0));
    assert!(mixed.number("wheel[1].track.wheel_load_kn").is_err(), "the first wheel has none");
    for (key, reason) in [
        ("crack[3].friction", "the case gives no value for it"),
        ("growth.critical_length_mm", "the case gives no value for it"),
        ("growth.paris_d", "unknown key `paris_d`; nearest known key: `paris_c`"),
        ("grow.paris_c", "unknown section `grow`; nearest known section: `growth`"),
        ("growth.steps", "is not a number but an integer from 0"),
        ("growth.law", "is not a number but \"paris\" or"),
    ] {
        let refused = case.number(key).unwrap_err().to_string();
        assert!(refused.starts_with(&format!("`{key}`: {reason}")), "{refused}");
    }
}

/// A constant of the command line beside a steel of the file is refused as one of the file is.
#[test]
fn a_setting_that_a_steel_contradicts_is_refused() {
    let settings = vec!["growth.paris_c=1e-9".to_owned()];
    let overrides = Overrides { settings, ..Overrides::default() };
    let errors = read("[growth]\nsteel = \"R260\"\n", &overrides).unwrap_err().to_string();
    assert!(errors.contains("`growth.paris_c = 0.000000001`: says the same thing as `steel`"), "{errors}");
}

/// The prior of a calibration is that of the validation suite in the geometry of the case, number
/// by number where one of them is given, and is written as such.
#[test]
fn the_prior_of_a_calibration_follows_the_geometry() {
    let space = "[contact]
peak_pressure_mpa = 845
half_width_mm = 6.75
lateral_half_width_mm = 6.75
friction = 0.1
[[crack]]
mouth_mm = 0
length_mm = 6
surface_half_length_mm = 6
angle_deg = 15
friction = 0.4
[solver]
engine = \"space\"
";
    let of = |text: &str| Case::parse(text, "case.toml", Path::new("")).unwrap();
    for (text, suite) in [(CRACK, CalibrationPrior::PLANE), (space, CalibrationPrior::SPACE)] {
        assert_eq!(of(text).calibration, suite);
        assert_eq!(of(&of(text).to_toml()).calibration, suite);
        let given = of(&format!("{text}[calibration]\nprior_log_std = 0.7\n")).calibration;
        assert_eq!((given.log_mean, given.log_std, given.sites), (suite.log_mean, 0.7, None));
        let given = of(&format!("{text}[calibration]\nprior_log_mean = 0\nsites = 2\n")).calibration;
        assert_eq!((given.log_mean, given.log_std, given.sites), (0.0, suite.log_std, Some(2)));
    }
}
