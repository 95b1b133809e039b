//! Numbers that are probably not those that are meant, and those of which nothing is said.

use railcrack_case::{ANY, Case, Kind, Preset, SECTIONS, Section, Topic, USUAL, implausible, usual_ranges};
use std::path::{Path, PathBuf};

fn cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases")
}

/// A case with these sections, and the default ones.
fn said(sections: &str) -> Vec<(Topic, String)> {
    let mut text = sections.to_owned();
    for (section, default) in [
        (
            "[contact]",
            "[contact]\nwheel_load_kn = 110\nwheel_radius_mm = 460\nrail_head_radius_mm = 300\nfriction = 0.2\n",
        ),
        ("[[crack]]", "[[crack]]\nmouth_mm = 0\nlength_mm = 4\nangle_deg = 25\nfriction = 0.3\n"),
    ] {
        let is_there = sections.contains(section) || section == "[contact]" && sections.contains("[[wheel]]");
        if !is_there {
            text.push_str(default);
        }
    }
    let case = Case::parse(&text, "case.toml", &cases()).unwrap_or_else(|errors| panic!("{errors}\n{text}"));
    implausible(&case).into_iter().map(|remark| (remark.topic, remark.text)).collect()
}

/// The only remark.
#[track_caller]
fn one(sections: &str) -> (Topic, String) {
    let mut all = said(sections);
    assert_eq!(all.len(), 1, "{all:?}");
    all.remove(0)
}

#[test]
fn the_committed_page_is_the_generated_one() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/usual-ranges.md");
    if std::fs::read_to_string(path).unwrap_or_default() != usual_ranges() {
        let fresh = concat!(env!("CARGO_TARGET_TMPDIR"), "/usual-ranges.md");
        std::fs::write(fresh, usual_ranges()).unwrap();
        panic!("docs/usual-ranges.md is out of date; the new page is {fresh}");
    }
}

/// Every number that a user types has a usual range or a reason to have none, and its default is
/// usual.
#[test]
fn every_number_has_a_range() {
    let named = |section: &Section, key: &str| format!("{}.{key}", section.name);
    let mut all = Vec::new();
    for section in SECTIONS.iter().filter(|section| !["calibration", ""].contains(&section.name)) {
        for key in section.keys {
            let preset = key.reference.unwrap_or(key.presence.preset());
            let values = match (key.kind, preset) {
                (Kind::Number { .. }, Preset::Number(value)) => vec![value],
                (Kind::Numbers { .. } | Kind::Points { .. }, Preset::Numbers(values)) => values.to_vec(),
                (Kind::Number { .. } | Kind::Numbers { .. } | Kind::Points { .. }, _) => Vec::new(),
                _ => continue,
            };
            let name = named(section, key.name);
            let usual: Vec<_> = USUAL.iter().filter(|usual| usual.keys.contains(&name.as_str())).collect();
            assert_eq!(usual.len() + usize::from(ANY.contains(&name.as_str())), 1, "{name}");
            for value in usual.iter().flat_map(|_| &values) {
                assert_eq!(usual[0].remark(&name, *value), None);
            }
            all.push(name);
        }
    }
    let listed = USUAL.iter().flat_map(|usual| usual.keys).chain(ANY);
    let unknown: Vec<_> = listed.filter(|name| !all.iter().any(|known| known == *name)).collect();
    assert!(unknown.is_empty(), "no such keys: {unknown:?}");
}

#[test]
fn nothing_is_said_of_the_shipped_cases() {
    let mut count = 0;
    for entry in std::fs::read_dir(cases()).unwrap() {
        let path = entry.unwrap().path();
        let is_case = path.extension().is_some_and(|ending| ending == "toml");
        // Studies are read as such.
        let Some(case) = is_case.then(|| Case::read(&path).ok()).flatten() else { continue };
        assert_eq!(implausible(&case), [], "{}", path.display());
        count += 1;
    }
    assert!(count > 20, "{count}");
}

#[test]
fn growth_laws_in_other_units() {
    let law = |text: &str| one(&format!("[growth]\nsteps = 1\n{text}"));
    for (text, says) in [
        ("paris_c = 5.21e-13\nparis_m = 3.0\n", "N/mm^1.5; then paris_c = 1.648e-8 in"),
        (
            "paris_c = 1e-12\nparis_m = 3.0\n",
            "in m per cycle with ranges in MPa sqrt(m); then paris_c = 1e-9 in",
        ),
        ("law = \"walker\"\nwalker_c = 2e-12\n", "then walker_c = 2e-9"),
        ("law = \"nasgro\"\nnasgro_c = 1e-12\n", "then nasgro_c = 1e-9"),
        ("law = \"forman\"\nforman_c = 5e-11\n", "then forman_c = 5e-8"),
    ] {
        let (topic, told) = law(text);
        assert!(topic == Topic::GrowthLaw && told.contains(says), "{text}: {told}");
    }
    let (topic, told) = law("threshold_mpa_sqrt_m = 190\n");
    assert!(topic == Topic::GrowthLaw && told.contains("190 N/mm^1.5 = 6.008 MPa sqrt(m)?"), "{told}");
    // Fitted to measured cracks, limits, thresholds.
    for text in
        ["paris_c = 1e-12\n[calibration]\nsites = 2\n", "steel = \"R260\"\n", "threshold_mpa_sqrt_m = 6\n"]
    {
        assert_eq!(said(&format!("[growth]\nsteps = 1\n{text}")), [], "{text}");
    }
}

#[test]
fn loads_of_wheels_and_axles() {
    let of = |kn: f64, tonnes: f64| {
        said(&format!(
            "[contact]\nwheel_load_kn = {kn}\nwheel_radius_mm = 460\nrail_head_radius_mm = 300\nfriction = 0.2\n\
             [traffic]\naxle_load_t = {tonnes}\n"
        ))
    };
    for (kn, tonnes, says) in [
        (12.26, 22.5, "wheel_load_kn = 12.26 kN is a wheel of an axle of 2.5 t"),
        (12.26, 22.5, "12.26 t = 120.2 kN?"),
        (220.0, 22.5, "is it the load of the axle"),
        (110.0, 11.25, "or axle_load_t that of a wheel?"),
    ] {
        let all = of(kn, tonnes);
        assert!(all.len() == 1 && all[0].0 == Topic::Load && all[0].1.contains(says), "{all:?}");
    }
    assert_eq!((of(65.0, 22.5), of(185.0, 22.5)), (vec![], vec![]));
    let wheel = |kn: f64, tonnes: f64| {
        format!(
            "[[wheel]]\nshare = 0.5\naxle_load_t = {tonnes}\n[wheel.contact]\nwheel_load_kn = {kn}\n\
             wheel_radius_mm = 460\nrail_head_radius_mm = 300\nfriction = 0.2\n"
        )
    };
    let mixed = said(&format!("{}{}", wheel(49.0, 22.5), wheel(110.0, 10.0)));
    assert_eq!(mixed.len(), 2, "{mixed:?}");
    assert!(
        mixed[0].1.starts_with("wheel 1: ")
            && mixed[0].1.contains("axle load of wheel 2: are they exchanged?")
    );
    let track = "[track]\nwheel_load_kn = 10\nsection = \"60E1\"\n[traffic]\naxle_load_t = 22.5\n";
    assert!(one(track).1.contains("the load of its axle in [track] = 10 kN"));
}

#[test]
fn units_of_single_numbers() {
    let contact =
        |a: &str| format!("[contact]\npeak_pressure_mpa = 900\nhalf_width_mm = {a}\nfriction = 0.2\n");
    let rolling = |rest: &str| {
        format!(
            "[contact]\nkind = \"rolling\"\nnormal_kn = 100\nwheel_radius_mm = 460\nrail_head_radius_mm = 300\n\
             friction = 0.3\ncreepage_sign = \"contact\"\n{rest}"
        )
    };
    for (text, says) in [
        (contact("0.01"), "0.01 m = 10 mm?"),
        (rolling("spin_per_mm = 0.21\n"), "beyond 0.002174 1/mm, one over the radius of 460 mm"),
        (rolling("creepage_x = 0.2\n"), "0.2% = 0.002?"),
        (
            "[[crack]]\nmouth_mm = 0\nlength_mm = 4\nangle_deg = 0.7\nfriction = 0.3\n".into(),
            "0.7 rad = 40.11 degrees?",
        ),
        (
            "[[crack]]\nmouth_mm = 0\nlength_mm = 0.004\nangle_deg = 25\nfriction = 0.3\n".into(),
            "0.004 m = 4 mm?",
        ),
        (
            "[[crack]]\npoints_mm = [[0, 0], [0.003, -0.002]]\nfriction = 0.3\n".into(),
            "the length of a crack by crack[1]",
        ),
    ] {
        let (topic, told) = one(&text);
        assert!(topic == Topic::Quantity && told.contains(says), "{text}: {told}");
    }
    // A horizontal crack below the surface has no angle that is typed.
    assert_eq!(said("[[crack]]\npoints_mm = [[-2, -2], [2, -2]]\nfriction = 0.3\n"), []);
}

#[test]
fn stress_profiles_and_tables_of_wheels() {
    let folder = std::env::temp_dir().join(format!("railcrack-plausible-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let of = |name: &str, content: &str, text: &str| {
        std::fs::write(folder.join(name), content).unwrap();
        let case = Case::parse(text, "case.toml", &folder).unwrap_or_else(|errors| panic!("{errors}"));
        implausible(&case).into_iter().map(|remark| remark.text).collect::<Vec<_>>()
    };
    let crack = "[[crack]]\nmouth_mm = 0\nlength_mm = 4\nangle_deg = 25\nfriction = 0.3\nlateral_mm = 20\n";
    let profile = |content: &str| {
        let contact = "[contact]\npeak_pressure_mpa = 900\nhalf_width_mm = 6\nfriction = 0.2\n";
        of("p.csv", content, &format!("{contact}{crack}[residual_stress]\nprofile = \"p.csv\"\n"))
    };
    assert!(profile("depth_mm,sxx_mpa\n0,-300\n0.004,0\n")[0].contains("the last depth_mm = 0.004"));
    let unbalanced = profile("depth_mm,sxx_mpa\n0,200\n40,200\n");
    assert!(unbalanced.len() == 1 && unbalanced[0].contains("add up to 8000 N per mm"), "{unbalanced:?}");
    assert_eq!(profile("depth_mm,sxx_mpa\n0,-300\n5,0\n"), [""; 0]);
    let wheels = |spin: &str, load: &str| {
        let header =
            "wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,rail_radius_mm,wheel_radius_mm";
        let table =
            format!("{header}\n1,{load},19.4,-2.8e-4,2.2e-3,{spin},0.25,80,460\n2,90,21,0,0,0,0.42,80,460\n");
        let wheel =
            "[[wheel]]\ntable = \"w.csv\"\ncreepage_sign = \"vehicle\"\n[traffic]\naxle_load_t = 22.5\n";
        of("w.csv", &table, &format!("{wheel}{crack}"))
    };
    let spin = wheels("0.21", "104");
    assert!(
        spin.len() == 1 && spin[0].starts_with("wheel 1: spin_per_mm") && spin[0].contains("1/m ="),
        "{spin:?}"
    );
    let load = wheels("2e-4", "9");
    assert!(load.len() == 1 && load[0].contains("the sum of normal_kn = 9 kN"), "{load:?}");
    assert_eq!(wheels("2e-4", "104"), [""; 0]);
    std::fs::remove_dir_all(&folder).unwrap();
}
