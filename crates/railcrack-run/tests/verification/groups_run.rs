//! Runs in groups: junctions, spalls, mixes of wheels, and runs that are resumed.

use railcrack::growth::{GrowthState, PieceKind, StepRecord, TipStop, Unobserved};
use railcrack_case::Case;
use railcrack_run::setup::PreparedRun;
use std::path::Path;

/// A crack that runs into a buried one, of which a tip breaks out, in a row with others.
const ROW: &str = "
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = 0.025
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 15.0
friction = 0.1
[[crack]]
points_mm = [[6.3, -1.1], [6.3, -2.6]]
friction = 0.1
[[crack]]
mouth_mm = 12.0
length_mm = 4.0
angle_deg = 20.0
friction = 0.1
[passage]
step_tolerance = 1e-3
positions = 121
[growth]
steps = 10
[solver]
engine = \"dislocation\"
";

/// A row of which every crack leans on others, under two wheels.
const MIX: &str = "
[[wheel]]
share = 0.6
contact = { peak_pressure_mpa = 845.0, half_width_mm = 6.75, friction = 0.1 }
[[wheel]]
share = 0.4
contact = { peak_pressure_mpa = 700.0, half_width_mm = 6.0, friction = -0.2 }
[[crack]]
mouth_mm = 0.0
length_mm = 6.0
angle_deg = 15.0
friction = 0.5
count = 4
spacing_mm = 3.4
[passage]
step_tolerance = 5e-4
positions = 61
[growth]
steps = 1
[solver]
engine = \"dislocation\"
";

fn case(text: &str, network: &str) -> Case {
    Case::parse(&format!("{text}network = \"{network}\"\n"), "case.toml", Path::new(".")).unwrap()
}

/// The growth steps from `state` on, and the state after each.
fn steps(case: &Case, state: Option<GrowthState>) -> Vec<(StepRecord, GrowthState)> {
    let mut growth = PreparedRun::new(case, None).unwrap().growth(state);
    let next = || growth.next_step(&Unobserved).unwrap().map(|record| (record, growth.state().clone()));
    std::iter::from_fn(next).collect()
}

/// The largest distance between the tips of two runs in any step, mm.
fn apart(one: &[(StepRecord, GrowthState)], other: &[(StepRecord, GrowthState)]) -> f64 {
    let mut largest = 0.0f64;
    for ((one, _), (other, _)) in one.iter().zip(other) {
        assert_eq!(one.tips.len(), other.tips.len(), "step {}", one.step);
        for (a, b) in one.tips.iter().zip(&other.tips) {
            largest = largest.max((a.x - b.x).hypot(a.y - b.y));
        }
    }
    largest
}

/// The cracks join and spall in the same steps as all together, and a run that is resumed through
/// the bytes of a checkpoint is the same run to the bit.
#[test]
#[ignore = "extra: eleven growth steps three times, 8 s"]
fn junctions_and_spalls_in_groups() {
    let case = case(ROW, "groups");
    let groups = steps(&case, None);
    let joins = |records: &[(StepRecord, GrowthState)]| {
        records.iter().position(|(record, _)| record.tips[0].stop == Some(TipStop::Coalescence))
    };
    let spalls = |records: &[(StepRecord, GrowthState)]| -> Vec<(PieceKind, usize)> {
        let pieces = records.iter().flat_map(|(record, _)| &record.pieces);
        pieces.map(|piece| (piece.kind, piece.crack)).collect()
    };
    let whole = steps(&self::case(ROW, "whole"), None);
    assert_eq!(groups.len(), whole.len());
    assert_eq!(joins(&groups), joins(&whole));
    assert_eq!(spalls(&groups), spalls(&whole));
    assert_eq!(spalls(&groups), [(PieceKind::Spall, 1)]);
    let off = apart(&groups, &whole);
    assert!(off < 5e-3, "paths are {off} mm apart");
    let at = joins(&groups).unwrap();
    let stored = postcard::to_stdvec(&groups[at].1).unwrap();
    let again = steps(&case, Some(postcard::from_bytes(&stored).unwrap()));
    assert_eq!(again.len() + at + 1, groups.len());
    for (one, two) in again.iter().zip(&groups[at + 1..]) {
        assert_eq!((&one.0.tips, one.0.cracks(), &one.1), (&two.0.tips, two.0.cracks(), &two.1));
        assert!(one.0.passages == two.0.passages && one.0.warnings == two.0.warnings);
    }
}

/// Each wheel of a mix passes the row in groups of its own.
#[test]
fn a_mix_of_wheels_in_groups() {
    let (groups, whole) = (steps(&case(MIX, "groups"), None), steps(&case(MIX, "whole"), None));
    assert_eq!((groups.len(), groups[0].0.other_wheels.len()), (2, 1), "steps, other wheels");
    for ((groups, _), (whole, _)) in groups.iter().zip(&whole).take(1) {
        for (one, other) in groups.tips.iter().zip(&whole.tips) {
            assert!((one.rate / other.rate - 1.0).abs() < 0.02, "{} {}", one.rate, other.rate);
            let shares = one.shares.values().iter().zip(other.shares.values());
            assert!(shares.clone().all(|(a, b)| (a - b).abs() < 0.01), "{shares:?}");
        }
    }
    let off = apart(&groups, &whole);
    assert!(off < 5e-3, "{off} mm apart");
}

/// The same step in groups with one, two and four threads.
#[test]
fn threads_change_no_bit_of_a_run_in_groups() {
    let case = case(&MIX.replace("count = 4", "count = 3").replace("steps = 1", "steps = 0"), "groups");
    let with_threads = |number: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(number).build().unwrap();
        pool.install(|| steps(&case, None))
    };
    let one = with_threads(1);
    for other in [2, 4].map(with_threads) {
        assert_eq!(one.len(), other.len());
        for (one, other) in one.iter().zip(&other) {
            assert!(one.0.passages == other.0.passages && one.0.tips == other.0.tips, "step {}", one.0.step);
            assert_eq!(one.1, other.1);
        }
    }
}

/// Wet cracks in groups: the pressure over the mouths, beside a dry buried crack.
#[test]
fn fluid_in_groups() {
    let row = "
[contact]
peak_pressure_mpa = 845.0
half_width_mm = 6.75
friction = -0.2
[[crack]]
mouth_mm = 0.0
length_mm = 4.0
angle_deg = 25.0
friction = 0.1
count = 4
spacing_mm = 3.4
[[crack]]
points_mm = [[20.0, -2.0], [22.0, -3.0]]
friction = 0.2
[passage]
step_tolerance = 5e-4
positions = 61
[growth]
steps = 0
[mesh]
interface_elements = 14
[solver]
engine = \"dislocation\"
";
    for fluid in ["model = \"mouth\"\ncracks = [1, 2, 3, 4]", "model = \"mouth\"\ncracks = [1, 3]"] {
        let of = |network| {
            let text = row.replace("[passage]", &format!("[fluid]\n{fluid}\n[passage]"));
            steps(&case(&text, network), None).remove(0).0
        };
        let (groups, whole) = (of("groups"), of("whole"));
        let [one, other] = [&groups, &whole].map(|step| step.passages.last().unwrap());
        let mut largest = 0.0f64;
        for (tip, (one_k, other_k)) in one.sifs.iter().zip(&other.sifs).enumerate() {
            let peak = other_k.iter().map(|k| k.ki.abs().max(k.kii.abs())).fold(0.0, f64::max);
            for (a, b) in one_k.iter().zip(other_k) {
                largest = largest.max((a.ki - b.ki).abs().max((a.kii - b.kii).abs()) / peak);
            }
            let most = other.fluid[tip].iter().map(|state| state.pressure).fold(0.0, f64::max);
            let apart = one.fluid[tip].iter().zip(&other.fluid[tip]);
            let apart = apart.map(|(a, b)| (a.pressure - b.pressure).abs()).fold(0.0, f64::max);
            assert!(apart <= 0.01 * most, "{fluid}: pressure at tip {tip} differs by {apart} of {most}");
        }
        println!("{fluid}: K in groups differs by {largest:.1e} of its peak");
        assert!(largest < 5e-3, "{fluid}: {largest}");
        let wet = other.fluid.iter().flatten().map(|state| state.pressure).fold(0.0, f64::max);
        assert!(wet > 10.0, "{fluid}: {wet}");
    }
}
