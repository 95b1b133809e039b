//! Temperatures of the seasons, and the section of the track as that of the rail.

use railcrack_case::{Case, CaseErrors};
use std::path::Path;

const REST: &str =
    "[[crack]]\nmouth_mm = 0\nlength_mm = 4\nangle_deg = 25\nfriction = 0.3\n[fracture]\nsteel = \"R260\"\n";
const CONTACT: &str = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n";

fn parsed(text: &str) -> Result<Case, CaseErrors> {
    Case::parse(&format!("{text}{REST}"), "case.toml", Path::new("."))
}

fn case(text: &str) -> Case {
    parsed(text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn temperature(keys: &str) -> String {
    format!("[temperature]\n{keys}\nneutral_c = 25.0\n")
}

#[test]
fn one_temperature_and_equal_ones_are_the_plain_case() {
    let plain = case(&format!("{CONTACT}{}", temperature("rail_c = -5.0")));
    for seasons in
        ["seasons_c = [-5.0]\nseason_shares = [1.0]", "seasons_c = [-5.0, -5.0]\nseason_shares = [0.3, 0.7]"]
    {
        let other = case(&format!("{CONTACT}{}", temperature(seasons)));
        assert_eq!((&other.wheels, &other.fracture), (&plain.wheels, &plain.fracture));
        assert_eq!(other.growth, plain.growth);
    }
}

#[test]
fn every_wheel_passes_in_every_season() {
    let wheel = |name: &str, share: f64, own: &str| {
        format!(
            "[[wheel]]\nname = \"{name}\"\nshare = {share}\n{own}\
             contact = {{ peak_pressure_mpa = 845.0, half_width_mm = 6.75, friction = 0.1 }}\n"
        )
    };
    let seasons = temperature("seasons_c = [35.0, -5.0]\nseason_shares = [0.75, 0.25]");
    let own = "temperature = { rail_c = 10.0, neutral_c = 25.0 }\n";
    let mix = case(&format!("{}{}{seasons}", wheel("freight", 0.5, ""), wheel("metro", 0.5, own)));
    let of = |i: usize| {
        let wheel = &mix.wheels[i];
        (wheel.name.as_str(), wheel.share, wheel.wheel.temperature.unwrap().rail)
    };
    assert_eq!(mix.wheels.len(), 3);
    assert_eq!(of(0), ("freight, 35 \u{b0}C", 0.375, 35.0));
    assert_eq!(of(1), ("metro", 0.5, 10.0));
    assert_eq!(of(2), ("freight, -5 \u{b0}C", 0.125, -5.0));
    // As the coldest rail has it.
    let cold = case(&format!("{CONTACT}{}", temperature("rail_c = -5.0")));
    assert_eq!(mix.fracture, cold.fracture);
    let stored = Case::parse(&mix.to_toml(), "case.toml", Path::new("."));
    assert_eq!(stored.unwrap_or_else(|errors| panic!("{errors}")), mix);
}

#[test]
fn seasons_that_are_refused() {
    let says = |keys: &str| parsed(&format!("{CONTACT}{}", temperature(keys))).unwrap_err().to_string();
    let of = |keys: &str, expected: &str| {
        let says = says(keys);
        assert!(says.contains(expected), "{says}");
    };
    of(
        "seasons_c = [35.0, -5.0]\nseason_shares = [0.5, 0.4]",
        "the shares add up to 0.9; they must add up to 1",
    );
    of("seasons_c = [35.0, -5.0]\nseason_shares = [1.0]", "1 shares of 2 temperatures; one of each");
    of("seasons_c = [35.0]\nseason_shares = [1.0]\nrail_c = 3.0", "says the same thing as");
    of("seasons_c = [35.0]", "`temperature.season_shares` is missing");
    let many: Vec<String> = (0..40).map(|c| format!("{c}.0")).collect();
    let shares = vec!["0.025"; 40].join(", ");
    of(
        &format!("seasons_c = [{}]\nseason_shares = [{shares}]", many.join(", ")),
        "make a mix of 40 wheels; the limit is 32",
    );
}

#[test]
fn the_section_of_the_track_is_that_of_the_rail() {
    let of = |rail: &str, track: &str| {
        format!("[rail]\nsection = \"{rail}\"\n[track]\nwheel_load_kn = 100.0\n{track}\n{CONTACT}")
    };
    let named = case(&of("60E1", "section = \"60E1\""));
    let same = case(&of("track", "section = \"UIC60\""));
    assert_eq!((same.rail, &same.geometry), (named.rail, &named.geometry));
    assert_eq!(same.wheels, named.wheels);
    let says = |text: &str| parsed(text).unwrap_err().to_string();
    let measured = says(&of("track", "second_moment_mm4 = 3e7\nneutral_axis_depth_mm = 91.0"));
    assert!(
        measured.contains("`rail.section = \"track\"`: is that of [track], which gives none"),
        "{measured}"
    );
    let without = says(&format!("[rail]\nsection = \"track\"\n{CONTACT}"));
    assert!(without.contains("which gives none with a name"), "{without}");
}
