//! Tables of wheels over cracks in space.

use railcrack::growth::{StepRecord, TipRecord, Unobserved};
use railcrack::space::WheelPatch;
use railcrack_case::Case;
use railcrack_run::setup::{PreparedRun, represented, wheel_demands, wheel_patches};
use std::path::{Path, PathBuf};

const HEADER: &str = "wheel,normal_kn,y_rail_mm,creepage_x,creepage_y,spin_per_mm,mu,a_mm,b_mm";

/// A crack with its middle at `lateral` (mm), on few cells and with few load steps.
fn crack(lateral: f64) -> String {
    format!(
        "[[crack]]\nmouth_mm = 0\nlength_mm = 3\nangle_deg = 40\nfriction = 0.3\nsurface_half_length_mm = 4\n\
         lateral_mm = {lateral}\n\
         [passage]\nfrom_over_a = -2.0\nto_over_a = 2.0\npositions = 9\nstep_control = \"fixed\"\nmax_passages = 2\n\
         [growth]\nsteps = 0\n[mesh]\nspace_cells = 2\nspace_rings = 2\n[solver]\nengine = \"space\"\n"
    )
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wheels-in-space").join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn parsed(text: &str, folder: &Path) -> Case {
    Case::parse(text, "case.toml", folder).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The case of a table with `rows`, with `keys` beside it, and the crack at `lateral`.
fn tabled(name: &str, lateral: f64, (header, rows): (&str, &str), keys: &str) -> Case {
    let folder = folder(name);
    std::fs::write(folder.join("curve.csv"), format!("{header}\n{rows}")).unwrap();
    let table = format!("[[wheel]]\ntable = \"curve.csv\"\ncreepage_sign = \"contact\"\n{keys}");
    parsed(&format!("{}{table}", crack(lateral)), &folder)
}

fn tips(case: &Case) -> Vec<TipRecord> {
    let mut growth = PreparedRun::new(&represented(case), None).unwrap().growth(None);
    let step: StepRecord = growth.next_step(&Unobserved).unwrap().unwrap();
    step.tips
}

fn modes(tip: &TipRecord) -> [f64; 4] {
    [tip.ki_max, tip.delta_ki, tip.delta_kii, tip.front().unwrap().delta_kiii]
}

#[test]
fn a_table_of_one_row_is_the_wheel_itself_bit_for_bit() {
    let single = format!(
        "{}[contact]\nkind = \"rolling\"\nnormal_kn = 85\nsemi_axes_mm = [6.0, 5.0]\nlateral_mm = -1.5\n\
         creepage_x = 8e-4\ncreepage_y = -4e-4\nspin_per_mm = 2e-4\ncreepage_sign = \"contact\"\nfriction = 0.3\n",
        crack(0.0)
    );
    let single = parsed(&single, Path::new("."));
    let one = tabled("one", 0.0, (HEADER, "7,85,1.5,8e-4,-4e-4,2e-4,0.3,6,5\n"), "");
    assert_eq!((one.wheels.len(), one.half_width()), (1, single.half_width()));
    assert_eq!(wheel_patches(&one), wheel_patches(&single));
    let (a, b) = (tips(&single), tips(&one));
    assert_eq!(a.iter().map(modes).collect::<Vec<_>>(), b.iter().map(modes).collect::<Vec<_>>());
    assert!(a.iter().any(|tip| tip.delta_kii > 0.0));
}

/// Differences of K between mirror images, over the largest range: round-off of the sums over nodes
/// and of the solver, whose systems end at 1e-9.
const MIRRORED: f64 = 1e-7;

#[test]
fn the_mirrored_rail_has_the_mirrored_history() {
    let rows = ["1,85,18.5,8e-4,-4e-4,2e-4,0.3,6,5\n", "1,85,-18.5,8e-4,4e-4,-2e-4,0.3,6,5\n"];
    let left = tips(&tabled("left", 17.0, (HEADER, rows[0]), ""));
    let right = tips(&tabled("right", -17.0, (HEADER, rows[1]), ""));
    let peak = left.iter().map(|tip| tip.delta_kii).fold(0.0, f64::max);
    for (one, other) in left.iter().zip(right.iter().rev()) {
        for (a, b) in modes(one).into_iter().zip(modes(other)) {
            assert!((a - b).abs() < MIRRORED * peak, "{:?} {:?}", modes(one), modes(other));
        }
    }
    // The wheel beside the middle loads one side more than the other.
    let [first, last] = [&left[1], &left[left.len() - 2]].map(|tip| tip.delta_kii);
    assert!((first / last - 1.0).abs() > 0.1, "{first} {last}");
}

#[test]
fn two_patches_are_one_history() {
    // At full slip, 60 and 40 kN on the same ellipse are 100 kN. Tables refuse the same place
    // twice.
    let whole = tabled("whole", 0.0, (HEADER, "1,100,0,0.1,0,0,0.3,6,5\n"), "");
    let mut both = whole.clone();
    let patches = &mut both.wheel_table.as_mut().unwrap().wheels[0].wheel.patches;
    patches.push(patches[0]);
    for (patch, part) in patches.iter_mut().zip([0.6, 0.4]) {
        patch.patch.ellipse.peak_pressure *= part;
    }
    assert!(matches!(&wheel_patches(&both)[0], WheelPatch::Several(parts) if parts.len() == 2));
    let (a, b) = (tips(&both), tips(&whole));
    let peak = b.iter().map(|tip| tip.delta_kii).fold(0.0, f64::max);
    for (one, other) in a.iter().zip(&b) {
        for (a, b) in modes(one).into_iter().zip(modes(other)) {
            // Full slip at a creepage of 0.1 leaves 1e-3 of the shear to the edge that sticks.
            assert!((a - b).abs() < 2e-3 * peak, "{a} {b} of {peak}");
        }
    }
}

/// Rows of wheels that scatter in load, place across the rail, creepage and friction.
fn many(count: usize) -> String {
    let row = |i: usize| {
        let part = |step: f64| (step * i as f64).fract();
        let (load, y) = (70.0 + 40.0 * part(0.618_034), 24.0 * (part(0.754_878) - 0.5));
        let (creep, friction) = (2e-3 * (part(0.569_840) - 0.5), 0.15 + 0.3 * part(0.324_717));
        format!(
            "{i},{load},{y},{creep},{},{},{friction},{},4\n",
            3e-3 * part(0.2),
            3e-4 * part(0.7),
            5.0 + 3.0 * part(0.4)
        )
    };
    (0..count).map(row).collect()
}

/// Error of the mean rate along the front of half as many representatives as wheels: the coarse
/// crack ranks wheels to some per cent.
const REPRESENTED: f64 = 0.04;

#[test]
fn representatives_keep_the_growth_of_the_front() {
    let rows = many(16);
    let all = tabled("all", 0.0, (HEADER, &rows), "");
    let few = tabled("few", 0.0, (HEADER, &rows), "representatives = 8\n");
    let few = represented(&few);
    let table = few.wheel_table.as_ref().unwrap();
    let groups = table.groups.as_ref().unwrap();
    assert_eq!((groups.representatives.len(), few.wheels.len(), table.missed(groups)), (8, 8, 0.0));
    let share: f64 = few.wheels.iter().map(|wheel| wheel.share).sum();
    assert!((share - 1.0).abs() < 1e-12, "{share}");
    let (a, b) = (tips(&all), tips(&few));
    let counted = |tips: &[TipRecord]| -> Vec<f64> {
        tips.iter().filter(|tip| tip.front().unwrap().counts).map(|tip| tip.rate).collect()
    };
    let (a, b) = (counted(&a), counted(&b));
    let mean = |rates: &[f64]| rates.iter().sum::<f64>() / rates.len() as f64;
    println!("mean rate {:+.4} ({:+.4} by the coarse crack)", mean(&b) / mean(&a) - 1.0, groups.error);
    assert!((mean(&b) / mean(&a) - 1.0).abs() < REPRESENTED, "{} {}", mean(&b), mean(&a));
    // Wheels by themselves add up to the rates of the run.
    let demands = wheel_demands(&all, &represented(&all)).unwrap();
    let table = all.wheel_table.as_ref().unwrap();
    let sum: f64 = table.wheels.iter().zip(&demands).map(|(wheel, own)| wheel.share * own.rate).sum();
    assert!((sum / mean(&a) - 1.0).abs() < 1e-9, "{sum} {}", mean(&a));
    // Wheels far to the side load the crack by little, but by something.
    let far = |i: usize| table.wheels[i].wheel.heaviest().y_rail.abs() > 10.0;
    assert!((0..16).filter(|i| far(*i)).all(|i| demands[i].rate > 0.0 && demands[i].rate < mean(&a)));
}
