//! Tables of wheels: their representatives, and patches over cracks in space.

use super::cases::{HEADER, contact, folder, origin, rolling, tabled};
use railcrack::growth::{StepRecord, Unobserved};
use railcrack::space::WheelPatch;
use railcrack_case::{Case, ContactOrigin, WheelGroups};
use railcrack_run::setup::{PreparedRun, represented, represented_in, wheel_demands, wheel_patches};
use std::path::{Path, PathBuf};

fn first_step(case: &Case) -> StepRecord {
    let mut growth = PreparedRun::new(&represented(case), None).unwrap().growth(None);
    growth.next_step(&Unobserved).unwrap().unwrap()
}

#[test]
fn a_table_of_one_row_is_the_wheel_itself_bit_for_bit() {
    let single = rolling(1.5, -4e-4, 2e-4);
    let one = tabled("one", HEADER, "7,85,4.5,8e-4,-4e-4,2e-4,0.3,6,5\n", "");
    assert_eq!(one.wheels.len(), 1);
    assert_eq!((contact(&one), one.half_width()), (contact(&single), single.half_width()));
    let (a, b) = (first_step(&single), first_step(&one));
    let of = |step: &StepRecord| {
        let tip = &step.tips[0];
        [tip.ki_max, tip.delta_ki, tip.delta_kii, tip.delta_keq, tip.rate]
    };
    assert_eq!(of(&a), of(&b));
    assert!(a.tips[0].delta_kii > 0.0);
}

/// Rows of wheels that scatter in load, place, creepage and friction.
fn many(count: usize) -> String {
    let row = |i: usize| {
        let part = |step: f64| (step * i as f64).fract();
        let (load, y) = (70.0 + 40.0 * part(0.618_034), 12.0 * part(0.754_878) - 2.0);
        let (creep, friction) = (2e-3 * (part(0.569_840) - 0.5), 0.15 + 0.3 * part(0.324_717));
        format!(
            "{i},{load},{y},{creep},{},{},{friction},{},5\n",
            3e-3 * part(0.2),
            3e-4 * part(0.7),
            5.0 + 3.0 * part(0.4)
        )
    };
    (0..count).map(row).collect()
}

#[test]
fn representatives_have_the_mean_rate_of_all_wheels() {
    let all_wheels = tabled("many", HEADER, &many(200), "representatives = 20\n");
    let case = represented(&all_wheels);
    let table = case.wheel_table.as_ref().unwrap();
    let groups = table.groups.as_ref().unwrap();
    assert_eq!((table.wheels.len(), all_wheels.wheels.len(), groups.representatives.len()), (200, 200, 20));
    for wheels in [&all_wheels.wheels, &case.wheels] {
        let share: f64 = wheels.iter().map(|wheel| wheel.share).sum();
        assert!((share - 1.0).abs() < 1e-12, "{share}");
    }
    let missed = table.missed(groups);
    assert!(missed > 0.0 && missed < 0.6 && case.wheels.len() == 21, "{missed}");
    assert!(case.wheels[20].wheel.contact().is_none() && case.wheels[20].share == missed);
    assert_eq!(all_wheels.computed_wheels(), 21);
    assert!(groups.error.abs() < 0.02, "{}", groups.error);
    // Every wheel computed by itself.
    let demands = wheel_demands(&all_wheels, &case).unwrap();
    let rate = |of: &dyn Fn(usize) -> f64| (0..200).map(|i| table.wheels[i].share * of(i)).sum::<f64>();
    let all = rate(&|i| demands[i].rate);
    let by = rate(&|i| groups.group_of[i].map_or(0.0, |group| demands[groups.representatives[group]].rate));
    println!("representatives: {:+.4} of the mean rate", by / all - 1.0);
    // Twenty of some hundred loaded wheels: rates of the coarse crack scatter by 1 % from wheel to
    // wheel.
    assert!((by / all - 1.0).abs() < 0.02, "{}", by / all - 1.0);
    // The run adds the same rates.
    let step = first_step(&all_wheels);
    assert!((step.tips[0].rate / by - 1.0).abs() < 1e-3, "{} {by}", step.tips[0].rate);
    let again = Case::parse(&case.to_toml(), "case.toml", &kept(&case, "many-kept")).unwrap();
    assert_eq!(again, all_wheels);
    assert_eq!(represented_in(&again, groups.clone()).unwrap(), *case);
    let damaged = WheelGroups { group_of: groups.group_of[1..].to_vec(), ..groups.clone() };
    assert!(represented_in(&again, damaged).is_none(), "the groups of another table");
}

/// A folder with the files of a stored case.
fn kept(case: &Case, name: &str) -> PathBuf {
    let folder = folder(name);
    for companion in case.companions() {
        let path = folder.join(companion.name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, companion.text).unwrap();
    }
    folder
}

/// A wheel that follows the head but for a hollow touches it 12 mm to either side: each patch loads
/// the half-space where it lies.
#[test]
fn two_patches_of_profiles_load_the_half_space() {
    let folder = folder("hollow");
    let write = |name: &str, away: fn(f64) -> f64, end: i32| {
        let row = |i: i32| {
            let y = 0.2 * f64::from(i);
            format!("{y},{}\n", 80.0 - (6400.0 - y * y).sqrt() - away(y))
        };
        let rows: String = (-end..=end).map(row).collect();
        std::fs::write(folder.join(name), format!("y_mm,z_mm\n{rows}")).unwrap();
    };
    write("rail.csv", |_| 0.0, 175);
    write("wheel.csv", |y| 2e-3 * (y.abs() - 12.0).powi(2), 125);
    let text = "[contact]\nkind = \"rolling\"\nrail_profile = \"rail.csv\"\nwheel_profile = \"wheel.csv\"\n\
        normal_kn = 85\nwheel_radius_mm = 460\nlateral_mm = 10.0\ncreepage_x = 8e-4\ncreepage_sign = \"contact\"\n\
        friction = 0.3\n[[crack]]\nmouth_mm = 0\nlength_mm = 5\nangle_deg = 25\nfriction = 0.2\n\
        surface_half_length_mm = 5\n[solver]\nengine = \"space\"\n";
    let case = Case::parse(text, "case.toml", &folder).unwrap_or_else(|errors| panic!("{errors}"));
    let ContactOrigin::Profiles(own) = origin(&case) else { panic!("{:?}", case.wheels) };
    assert_eq!(own.contacts.len(), 2);
    let [wheel] = &wheel_patches(&case)[..] else { panic!("one wheel") };
    let WheelPatch::Several(patches) = wheel else { panic!("{wheel:?}") };
    // The crack lies 10 mm to the right of the middle of the head.
    let places: Vec<f64> = patches.iter().map(|(_, own)| own.outline().lateral).collect();
    assert!(places.len() == 2 && patches.iter().all(|(ahead, _)| ahead.abs() < 1e-6), "{places:?}");
    for (contact, want) in own.contacts.iter().zip([-22.0, 2.0]) {
        let place = places.iter().copied().find(|place| (place - want).abs() < 0.5).unwrap();
        let pressure = wheel.pressure(1.5, [1.5, place]);
        assert!((pressure / contact.ellipse.peak_pressure - 1.0).abs() < 0.02, "{pressure} {contact:?}");
    }
    assert_eq!(wheel.pressure(1.5, [1.5, -10.0]), 0.0);
    // The middle strip of the heavier one stands for the wheel where one strip is needed.
    let most = own.contacts.iter().map(|own| own.ellipse.peak_pressure).fold(0.0, f64::max);
    assert!((contact(&case).peak_pressure() / most - 1.0).abs() < 0.02);
}

#[test]
fn a_rolling_patch_loads_the_half_space() {
    let text = "[contact]\nkind = \"rolling\"\nnormal_kn = 85\nsemi_axes_mm = [6.0, 5.0]\nlateral_mm = 1.5\n\
        creepage_x = 8e-4\ncreepage_sign = \"contact\"\nfriction = 0.3\n\
        [[crack]]\nmouth_mm = 0\nlength_mm = 5\nangle_deg = 25\nfriction = 0.2\nsurface_half_length_mm = 5\n\
        [solver]\nengine = \"space\"\n";
    let case = Case::parse(text, "case.toml", Path::new(".")).unwrap_or_else(|errors| panic!("{errors}"));
    let patches = wheel_patches(&case);
    let wheel = patches[0].outline();
    assert_eq!((wheel.half_width, wheel.lateral_half_width, wheel.lateral), (6.0, 5.0, -1.5));
    // Mean shear over mean pressure, the force of the patch over its load.
    let ContactOrigin::Rolling { patch, .. } = origin(&case) else { panic!("{:?}", case.wheels) };
    let want = patch.forces().force[0] / patch.normal_force();
    assert!((wheel.friction / want - 1.0).abs() < 5e-3, "{} {want}", wheel.friction);
}
