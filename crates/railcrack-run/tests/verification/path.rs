//! The limit of the path in the increment, in both engines, and events that are located.

use crate::common::{measured, measured_as, measured_order, order};
use railcrack::growth::{RunStop, StepRecord, TipStop, Unobserved};
use railcrack::math::{MPA_SQRT_MM, Vec2};
use railcrack_case::{Case, Overrides};
use railcrack_run::setup::PreparedRun;
use std::path::Path;

/// The steps of `text`, an engine given.
fn run(text: &str, engine: &str) -> Vec<StepRecord> {
    let overrides = Overrides { engine: Some(engine.into()), ..Overrides::default() };
    let case = Case::parse_with(text, "case.toml", Path::new(""), &overrides).unwrap();
    let mut run = PreparedRun::new(&case, None).unwrap().growth(None);
    std::iter::from_fn(|| run.next_step(&Unobserved).unwrap()).collect()
}

/// A head check of 4 mm at 30° up to 5.5 mm, with further lines of `[growth]`.
fn head_check(growth: &str, engine: &str) -> Vec<StepRecord> {
    let text = format!(
        "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.3\n\
         [[crack]]\nmouth_mm = 0.0\nlength_mm = 4.0\nangle_deg = 30.0\nfriction = 0.3\n\
         [growth]\nparis_c = 2e-11\nsteps = 2000\ncritical_length_mm = 5.5\n{growth}\n"
    );
    run(&text, engine)
}

/// The reference case of the paper up to 11 mm on the limit path, with further lines of `[growth]`.
fn paper_on_the_limit_path(friction: f64, growth: &str) -> Vec<StepRecord> {
    let text = format!(
        "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = {friction}\n\
         [[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.5\n\
         [growth]\nsteps = 2000\ncritical_length_mm = 11.0\nturning_length_mm = 0\n{growth}\n"
    );
    run(&text, "dislocation")
}

/// The end of a run: cycles and tip.
fn end(records: &[StepRecord]) -> (f64, Vec2) {
    let last = &records[records.len() - 1];
    (last.load_cycles, Vec2::new(last.tips[0].x, last.tips[0].y))
}

/// Lives and tips that an independent program found with small increments that turn by
/// θ* (1 − e^(−Δa/ℓ)).
const INDEPENDENT: [(&str, f64, [f64; 2]); 3] =
    [("inf", 5.541e6, [4.763, -2.750]), ("0.5", 5.004e6, [4.707, -2.837]), ("0.16", 4.45e6, [4.59, -2.98])];

#[test]
fn lives_and_tips_are_those_of_small_increments() {
    let (mut off_life, mut off_tip) = (0.0f64, 0.0f64);
    for (length, life, tip) in INDEPENDENT {
        let records = head_check(&format!("turning_length_mm = {length}"), "dislocation");
        let (cycles, at) = end(&records);
        assert_eq!(records[records.len() - 1].stop, Some(RunStop::CriticalLength));
        off_life = off_life.max((cycles / life - 1.0).abs());
        off_tip = off_tip.max((at - Vec2::new(tip[0], tip[1])).length());
    }
    measured_as("life", off_life, 0.01, "the tolerance by default");
    measured_as("tip", off_tip, 0.01, "mm; digits of the published numbers");
    assert!(off_life < 0.01 && off_tip < 0.01, "{off_life} {off_tip}");
}

#[test]
fn engines_follow_the_same_path() {
    for (length, apart, life) in [("0.5", 0.02, 0.01), ("0.16", 0.02, 0.02)] {
        let growth = format!("turning_length_mm = {length}");
        let (one, other) = (end(&head_check(&growth, "xfem")), end(&head_check(&growth, "dislocation")));
        let (tips, lives) = ((one.1 - other.1).length(), (one.0 / other.0 - 1.0).abs());
        if length == "0.5" {
            measured_as("tip", tips, apart, "mm; at the default turning length");
            measured_as("life", lives, life, "at the default turning length");
        }
        assert!(tips < apart && lives < life, "{length}: {tips} mm, {lives}");
    }
}

#[test]
fn the_life_converges_where_the_path_turns() {
    let life = |increment: f64| {
        let growth = format!("turning_length_mm = 0.16\nincrement = {increment}");
        end(&head_check(&growth, "dislocation")).0
    };
    let [coarse, middle, fine] = [0.04, 0.02, 0.01].map(life);
    let observed = order(coarse - middle, middle - fine);
    measured_order(observed, 1.5, "differences of 4, 2 and 1 % increments");
    assert!(observed > 1.5, "order {observed}: {coarse} {middle} {fine}");
}

/// With turning length 0 the crack turns at once, and then goes on in the direction in which the
/// best kink is zero.
#[test]
fn the_limit_path_turns_at_once_to_the_stationary_direction() {
    let records = head_check("turning_length_mm = 0.0", "dislocation");
    let (first, last) = (&records[2], &records[records.len() - 1]);
    let kink = last.tips[0].kink.unwrap().to_degrees();
    assert!(kink.abs() < 0.5, "{kink}");
    let crack = &last.cracks()[0];
    let points = crack.points();
    let end = points[points.len() - 1] - points[points.len() - 2];
    let down = -end.angle().to_degrees();
    assert!((down - 77.0).abs() < 3.0, "{down}");
    assert!(first.tips[0].length < 4.2, "it has turned within a few hundredths of its length");
}

/// The first bend is made by a short step, whatever the increment, so that the life does not depend
/// on it.
#[test]
fn the_limit_path_has_one_life() {
    let mut spread = 0.0f64;
    let head_check = |growth: &str| head_check(&format!("turning_length_mm = 0\n{growth}"), "dislocation");
    let braked = |growth: &str| paper_on_the_limit_path(0.4, growth);
    let rolling = |growth: &str| paper_on_the_limit_path(0.1, growth);
    type Runs<'a> = &'a dyn Fn(&str) -> Vec<StepRecord>;
    let cases: [Runs; 3] = [&head_check, &braked, &rolling];
    for case in cases {
        let lives = ["tolerance = 0.02", "increment = 0.08", "increment = 0.04"].map(|growth| {
            let records = case(growth);
            assert_eq!(records[records.len() - 1].stop, Some(RunStop::CriticalLength), "{growth}");
            end(&records).0
        });
        let (least, most) =
            (lives.iter().fold(f64::MAX, |a, b| a.min(*b)), lives.iter().fold(0.0, |a: f64, b| a.max(*b)));
        spread = spread.max(most / least - 1.0);
    }
    measured(spread, 0.02, "limit path, increments of 8 and 4 % and those that choose themselves");
    assert!(spread < 0.02, "{spread}");
}

/// Straight ahead is a direction from which all others lead away: the path kinks down, and does not
/// run back along its own crack.
#[test]
fn the_limit_path_leaves_a_direction_that_it_cannot_hold() {
    for growth in ["tolerance = 0.05", "increment = 0.04"] {
        let records = paper_on_the_limit_path(0.025, growth);
        let last = &records[records.len() - 1];
        assert_eq!(last.stop, Some(RunStop::CriticalLength), "{growth}");
        // The straight crack lives for 0.85 million axles, and is then 2.85 mm deep.
        assert!(last.load_cycles > 5e6 && last.tips[0].y < -4.0, "{growth}: {last:?}");
        let warned =
            |record: &StepRecord| record.warnings.iter().any(|warning| warning.text.contains("not unique"));
        assert!(records.iter().any(warned), "{growth}");
    }
}

/// A crack in a cold rail reaches the toughness after the same traffic, whatever the increment.
#[test]
fn fracture_is_located() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let text = std::fs::read_to_string(folder.join("winter-rail.toml")).unwrap();
    let growth = text.find("\n[growth]\n").unwrap();
    let rest = text[growth + 1..].find("\n[solver]").unwrap() + growth + 1;
    let life = |line: &str| {
        let text = format!("{}\n[growth]\nsteps = 400\n{line}\n{}", &text[..growth], &text[rest..]);
        let records = run(&text, "dislocation");
        let last = &records[records.len() - 1];
        assert_eq!(last.stop, Some(RunStop::Fracture), "{line}");
        last.load_cycles
    };
    let fine = life("tolerance = 0.001");
    let mut off = 0.0f64;
    for line in ["increment = 0.16", "increment = 0.08", "increment = 0.04", "increment = 0.02", ""] {
        off = off.max((life(line) / fine - 1.0).abs());
    }
    measured_as("", off, 0.01, "increments of 16 to 2 %, and chosen ones");
    assert!(off < 0.01, "{off}");
}

/// Without `[fracture]` a real kink is tested where k1 reaches the usual toughness, without effect
/// on the run: under shear it arrests, in a cold rail it does not.
#[test]
fn kinks_are_tested_where_no_toughness_is_given() {
    let sheared = "[contact]\npeak_pressure_mpa = 1200.0\nhalf_width_mm = 6.75\nfriction = -0.4\n\
         [[crack]]\nmouth_mm = 0.0\nlength_mm = 4.4\nangle_deg = 45.0\nfriction = 0.1\n\
         [growth]\nparis_c = 2e-11\nsteps = 2\n";
    let records = run(sheared, "dislocation");
    let test = records[0].pop_in_test.expect("k1 beyond 29 MPa√m");
    let usual = 29.0 * MPA_SQRT_MM;
    assert!(test.k1 > usual && test.arrests(usual), "{test:?}");
    // The same kink as with a toughness.
    let popped = run(&format!("{sheared}[fracture]\ntoughness_mpa_sqrt_m = 29.0\n"), "dislocation");
    assert!(popped[0].pop_in_test.is_none());
    let after = popped[1].tips[0].largest_k1.map_or(0.0, |largest| largest.k1);
    assert_eq!(test.k1_after, Some(after));
    assert_eq!(records[0].load_cycles, 0.0);

    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let text = std::fs::read_to_string(folder.join("winter-rail.toml")).unwrap();
    let (start, end) = (text.find("\n[fracture]").unwrap(), text.find("\n[passage]").unwrap());
    let cold = format!("{}{}", &text[..start], &text[end..]);
    let records = run(&cold, "dislocation");
    let breaks = records.iter().filter_map(|record| record.pop_in_test).find(|test| !test.arrests(usual));
    assert!(breaks.is_some_and(|test| test.k1_after.is_some_and(|k1| k1 >= usual)), "{breaks:?}");
}

/// Under a braked wheel, k1 of a virtual kink of a shallow head check exceeds a low toughness, but
/// the kink closes: a pop-in. In the cold rail above, K_I keeps a kink open.
#[test]
fn a_shallow_crack_under_shear_pops_in_and_arrests() {
    let text = |criterion: &str| {
        format!(
            "[contact]\npeak_pressure_mpa = 1000.0\nhalf_width_mm = 6.75\nfriction = -0.3\n\
             [[crack]]\nmouth_mm = 0.0\nlength_mm = 4.4\nangle_deg = 45.0\nfriction = 0.1\n\
             [growth]\nparis_c = 2e-11\nsteps = 6\n\
             [fracture]\ntoughness_mpa_sqrt_m = 20.0\ncriterion = \"{criterion}\"\n"
        )
    };
    let at_once = run(&text("k1"), "dislocation");
    assert_eq!(at_once.last().unwrap().stop, Some(RunStop::Fracture));
    let arrests = run(&text("arrest"), "dislocation");
    let popped = arrests
        .iter()
        .position(|record| record.tips[0].plane().unwrap().jump == Some(railcrack::growth::Jump::PopIn));
    let popped = popped.expect("a pop-in");
    assert!(arrests.last().unwrap().stop != Some(RunStop::Fracture), "{:?}", arrests.last().unwrap().stop);
    let (before, after) = (&arrests[popped], &arrests[popped + 1]);
    assert!((after.tips[0].length - before.tips[0].length - 2.0).abs() < 1e-9);
    assert_eq!(after.load_cycles, before.load_cycles);
    assert!(before.warnings.iter().any(|warning| warning.text.contains("pop-in of 2.00 mm")));
}

/// The first steps of a run do not depend on how many follow.
#[test]
fn a_shorter_run_is_the_beginning_of_a_longer_one() {
    let steps = |count: usize, engine: &str| {
        let text = format!(
            "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.3\n\
             [[crack]]\nmouth_mm = 0.0\nlength_mm = 4.0\nangle_deg = 30.0\nfriction = 0.3\n\
             [growth]\nparis_c = 2e-11\nsteps = {count}\n"
        );
        run(&text, engine)
    };
    let (short, long) = (steps(2, "dislocation"), steps(4, "dislocation"));
    for (one, other) in short.iter().zip(&long) {
        assert_eq!((one.load_cycles, &one.geometry), (other.load_cycles, &other.geometry));
        assert_eq!(one.tips[0].rate, other.tips[0].rate);
    }
}

/// The first step has the same bits in a run of one step and in long ones, in both engines: the
/// mesh does not make room for the growth that is asked for.
#[test]
fn the_first_step_does_not_depend_on_the_number_of_steps() {
    for engine in ["xfem", "dislocation"] {
        let first = |growth: &str| {
            let text = format!(
                "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n\
                 [[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 30.0\nfriction = 0.3\n\
                 [growth]\n{growth}\n"
            );
            let overrides = Overrides { engine: Some(engine.into()), ..Overrides::default() };
            let case = Case::parse_with(&text, "case.toml", Path::new(""), &overrides).unwrap();
            let mut run = PreparedRun::new(&case, None).unwrap().growth(None);
            let mut record = run.next_step(&Unobserved).unwrap().unwrap();
            (record.passages.pop().unwrap().sifs, record.dofs, record.tips[0].kink)
        };
        let alone = first("steps = 0");
        for growth in ["steps = 5", "steps = 25", "steps = 25\nincrement = 0.16", "steps = 2000"] {
            assert!(first(growth) == alone, "{engine}, {growth}");
        }
    }
}

/// The threshold of ΔK_II arrests a crack that is sheared less, names the branch that is left out,
/// and changes nothing where it is exceeded.
#[test]
fn the_threshold_of_shear_arrests() {
    let straight =
        |line: &str| head_check(&format!("turning_length_mm = inf\nincrement = 0.1\n{line}"), "dislocation");
    let free = straight("");
    let shear = free.iter().map(|record| record.tips[0].delta_kii).fold(f64::MAX, f64::min) / MPA_SQRT_MM;
    let below = straight(&format!("threshold_2_mpa_sqrt_m = {}", 0.99 * shear));
    assert_eq!(end(&below), end(&free));
    // With a threshold of opening, the axis of the ellipse is the other one.
    let held = straight("threshold_mpa_sqrt_m = 8.0\nthreshold_2_mpa_sqrt_m = 40.0");
    assert_eq!(
        (held.len(), held[0].stop, held[0].tips[0].rate),
        (1, Some(RunStop::NoTipGrows(TipStop::Arrest)), 0.0)
    );
    let warning = held[0].warnings.iter().find(|warning| warning.text.contains("may branch"));
    assert!(warning.is_some(), "{:?}", held[0].warnings);
    assert!(straight("threshold_mpa_sqrt_m = 8.0").len() > 1);
}
