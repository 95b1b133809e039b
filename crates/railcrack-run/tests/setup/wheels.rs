//! Tables of wheels: their representatives, and patches over cracks in space.

use super::cases::{HEADER, STRIP, contact, folder, origin, rolling, tabled};
use railcrack::growth::{StepRecord, Unobserved};
use railcrack::math::Vec2;
use railcrack::space::WheelPatch;
use railcrack_case::{Case, ContactOrigin, WheelGroups};
use railcrack_run::setup::{
    PreparedRun, plane_field, represented, represented_in, wheel_demands, wheel_patches,
};
use railcrack_run::summary::validity;
use std::path::{Path, PathBuf};

fn first_step(case: &Case) -> StepRecord {
    let mut growth = PreparedRun::new(&represented(case), None).unwrap().growth(None);
    growth.next_step(&Unobserved).unwrap().unwrap()
}

#[test]
fn a_table_of_one_row_is_the_wheel_itself_bit_for_bit() {
    for (name, extent) in [("one", ""), ("one-strip", STRIP)] {
        let single = rolling([1.5, -4e-4, 2e-4], extent);
        let one = tabled(name, HEADER, "7,85,4.5,8e-4,-4e-4,2e-4,0.3,6,5\n", extent);
        assert_eq!(one.wheels.len(), 1);
        assert_eq!((contact(&one), one.half_width()), (contact(&single), single.half_width()));
        let (a, b) = (demand(&single), demand(&one));
        assert_eq!(a, b, "{name}");
        assert!(a[2] > 0.0);
    }
}

/// Ranges of K, ΔK_eq and the rate of the crack at the beginning.
fn demand(case: &Case) -> [f64; 5] {
    let tip = &first_step(case).tips[0];
    [tip.ki_max, tip.delta_ki, tip.delta_kii, tip.delta_keq, tip.rate]
}

/// Seen in a mirror along the rail, the lateral place of the crack, lateral creepage and spin
/// change their signs, and nothing in the plane of the crack does.
#[test]
fn the_mirrored_rail_has_the_same_demand() {
    let right = demand(&rolling([1.5, -4e-4, 2e-4], ""));
    let left = demand(&rolling([-1.5, 4e-4, -2e-4], ""));
    let rows = "1,85,7.5,8e-4,4e-4,-2e-4,0.3,6,5\n";
    for other in [left, demand(&tabled("mirrored", HEADER, rows, ""))] {
        for (a, b) in right.iter().zip(other) {
            assert!((a - b).abs() < 1e-6 * a.abs().max(1e-12), "{right:?} {other:?}");
        }
    }
    let other_spin = demand(&rolling([-1.5, -4e-4, 2e-4], ""));
    assert!((other_spin[2] / right[2] - 1.0).abs() > 1e-4, "{other_spin:?} {right:?}");
}

/// A wheel beside the crack loads it, the less the farther it passes; as a strip it is refused or
/// misses.
#[test]
fn a_wheel_beside_the_crack_loads_it() {
    let places = [0.0, 6.0, 12.0, 24.0];
    let own = places.map(|lateral| demand(&rolling([lateral, 0.0, 0.0], ""))[2]);
    assert!(own.windows(2).all(|two| two[1] < 0.9 * two[0]) && own[3] > 0.0, "{own:?}");
    for (lateral, range) in places.into_iter().zip(own).skip(1) {
        let row = format!("1,85,{},8e-4,0,0,0.3,6,5\n", 6.0 - lateral);
        let name = format!("beside-{lateral}");
        assert_eq!(demand(&tabled(&name, HEADER, &row, ""))[2], range, "{lateral}");
    }
    let rows = "1,85,6,8e-4,0,0,0.3,6,5\n2,85,-6,8e-4,0,0,0.3,6,5\n";
    let misses = |extent: &str| {
        let case = tabled("beside", HEADER, rows, extent);
        case.wheels.iter().map(|wheel| wheel.wheel.contact().is_none()).collect::<Vec<_>>()
    };
    assert_eq!((misses(""), misses(STRIP)), (vec![false, false], vec![false, true]));
}

/// The fields of two patches of a wheel add, each where it lies; so do the loads of the crack.
#[test]
fn two_patches_over_a_crack_add() {
    let header = format!("{HEADER},x_mm");
    let (first, second) = ("1,60,4.5,8e-4,0,0,0.3,6,5,0\n", "1,40,7.0,8e-4,0,1e-4,0.3,4,3,-9\n");
    let field = |name: &str, rows: &str| plane_field(&tabled(name, &header, rows, ""), 0).unwrap();
    let both = field("both", &format!("{first}{second}"));
    let (a, b) = (field("first", first), field("second", second));
    for xc in [-12.0, -3.0, 0.0, 7.5] {
        for point in [[0.0, -0.5], [2.0, -1.0], [-4.0, -3.0]].map(|[x, y]| Vec2::new(x, y)) {
            // A patch alone is the middle of its wheel.
            let (sum, a, b) = (both.stress(point, xc), a.stress(point, xc), b.stress(point, xc - 9.0));
            for (sum, parts) in [(sum.xx, a.xx + b.xx), (sum.yy, a.yy + b.yy), (sum.xy, a.xy + b.xy)] {
                assert!((sum - parts).abs() < 1e-9 * parts.abs().max(1.0), "{xc} {point:?}: {sum} {parts}");
            }
        }
    }
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
    let keys = format!("representatives = 20\n{STRIP}");
    let all_wheels = tabled("many", HEADER, &many(200), &keys);
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

/// No wheel misses cracks that are loaded by patches.
#[test]
fn representatives_of_patches_have_the_mean_rate_of_all_wheels() {
    let all_wheels = tabled("many-patches", HEADER, &many(200), "representatives = 20\n");
    let case = represented(&all_wheels);
    let table = case.wheel_table.as_ref().unwrap();
    let groups = table.groups.as_ref().unwrap();
    assert_eq!((table.missed(groups), case.wheels.len(), all_wheels.computed_wheels()), (0.0, 20, 20));
    assert!(case.wheels.iter().all(|wheel| wheel.wheel.contact().is_some()));
    let demands = wheel_demands(&all_wheels, &case).unwrap();
    let rate = |of: &dyn Fn(usize) -> f64| (0..200).map(|i| table.wheels[i].share * of(i)).sum::<f64>();
    let all = rate(&|i| demands[i].rate);
    let by = rate(&|i| demands[groups.representatives[groups.group_of[i].unwrap()]].rate);
    println!("representatives: {:+.4} of the mean rate, {:+.4} by groups", by / all - 1.0, groups.error);
    // The coarse wheels slide in full, with the mean shear of their patches: 4.7 %.
    assert!((by / all - 1.0).abs() < 0.06, "{}", by / all - 1.0);
    let step = first_step(&all_wheels);
    assert!((step.tips[0].rate / by - 1.0).abs() < 1e-3, "{} {by}", step.tips[0].rate);
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

/// The part of an ellipse, or the crack, that the plane does not have is warned of where it counts.
#[test]
fn what_a_plane_crack_lacks_is_warned_of() {
    let warned = |contact: &str, crack: &str, more: &str| {
        let text = format!(
            "[contact]\npeak_pressure_mpa = 800.0\nhalf_width_mm = 6.0\nlateral_half_width_mm = 8.0\n\
             friction = 0.1\n{contact}\n[[crack]]\nmouth_mm = 0.0\nlength_mm = 4.0\nangle_deg = 25.0\n\
             friction = 0.3\n{crack}\n{more}"
        );
        let case = Case::parse(&text, "case.toml", Path::new("")).unwrap();
        validity::of_case(&case).into_iter().map(|warning| warning.text).collect::<Vec<_>>()
    };
    assert_eq!(warned("lateral_mm = 2.0", "surface_half_length_mm = 4.0", ""), [""; 0]);
    let beside = warned("lateral_mm = -4.0", "", "");
    assert!(beside.len() == 1 && beside[0].contains("lies 0.50 b beside the cracks"), "{beside:?}");
    assert_eq!(warned("lateral_mm = -4.0\nlateral = \"strip\"", "", ""), [""; 0]);
    let in_space = "surface_half_length_mm = 3.0\n[solver]\nengine = \"space\"";
    assert!(!warned("lateral_mm = -4.0", in_space, "").iter().any(|text| text.contains("beside the cracks")));
    let narrow = warned("", "surface_half_length_mm = 3.0", "");
    assert!(narrow.len() == 1 && narrow[0].contains("1.50 times as long"), "{narrow:?}");
    let coupled = warned("coupled = true", "", "");
    assert!(coupled.len() == 1 && coupled[0].contains("contact.coupled = false takes"), "{coupled:?}");
    let block = warned("", "", "[rail]\nboundary = \"block\"\n[solver]\nengine = \"xfem\"\n");
    assert!(block.len() == 1 && block[0].contains("\"half-plane\" takes the whole patch"), "{block:?}");
}
