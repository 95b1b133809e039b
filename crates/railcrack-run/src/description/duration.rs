//! Estimate of the processor time that a run takes.
//!
//! Powers of the numbers of unknowns, positions and steps, with factors measured on one core. Of 14
//! whole runs, of 0.1 to 78 s, eleven took between half and twice of what is estimated, the others
//! a third of it and three times as long; the number of increments is the largest uncertainty.

use crate::setup::{RunSize, rolls_on_patches};
use crate::simulation::variants;
use railcrack::growth::NetworkContact;
use railcrack_case::{Case, Engine, Kept, PlaneEngine, PlasticSource};

/// Seconds of a load step of dislocations or finite elements: always, and per square of the number
/// of contact unknowns.
const PER_LOAD_STEP: f64 = 5e-6;
const PER_SQUARE: f64 = 1.6e-9;
/// The same per face point of a single crack below a patch, by how much each further crack raises
/// it, and to fill the table of its stresses.
const PER_PATCH_POINT: f64 = 7e-7;
const PER_FURTHER_CRACK: f64 = 0.6;
const PATCH_TABLE: f64 = 0.15;
/// Seconds of a body of dislocations per square of that number.
const BODY_SQUARE: f64 = 1e-7;
/// Seconds per displacement: of the first mesh, and for each contact unknown in later steps.
const MESH: f64 = 1e-5;
const CONDENSATION: f64 = 1e-8;
/// Seconds of a body in space per contact unknown, and of a load step per square of their number.
const SPACE_BODY: f64 = 4.5e-3;
const SPACE_SQUARE: f64 = 4.5e-8;
/// Seconds to roll the rail, and to carry its state over to finite elements.
const ROLLING: f64 = 0.3;
const CARRYING: f64 = 5.0;
/// Seconds of the tables per face point and position, and of everything else that is written.
const PER_ROW: f64 = 1.1e-6;
const OUTPUT: f64 = 0.15;
/// Passages until the history repeats, with friction.
const PASSAGES: f64 = 2.0;
/// Cracks in a group, and sweeps over all groups.
const OF_GROUP: f64 = 5.0;
const SWEEPS: f64 = 4.5;
/// Growth of the number of unknowns over a run, in the mean.
const GROWN: f64 = 1.25;
/// Increments of a run that ends with its answer: straight ahead, and where it turns.
const STRAIGHT_STEPS: usize = 15;
const TURNING_STEPS: usize = 35;
/// Increments over those asked for, where a path that turns cuts some.
const CUT: f64 = 1.25;
/// Runs at other speeds for samples against removal, and seconds of a sample against it and of
/// another one.
const SPEEDS: usize = 10;
const REMOVED_SAMPLE: f64 = 5e-5;
const SAMPLE: f64 = 1.5e-5;

/// Time (s) from which on a growth step is worth a warning.
const LONG: f64 = 30.0;

/// Approximate processor time (s) of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunTime {
    /// Of its first growth step.
    pub step: f64,
    /// Of the run alone.
    pub run: f64,
    /// Number of further runs for its decision, and their time.
    pub companions: (usize, f64),
    /// Number of samples, and their time.
    pub samples: (usize, f64),
}

impl RunTime {
    /// That of the run of `case`, whose size is `size`.
    pub fn of(case: &Case, size: &RunSize) -> Self {
        let goes_straight = case.growth.all_go_straight();
        let usual = if goes_straight { STRAIGHT_STEPS } else { TURNING_STEPS };
        let ends_early = case.growth.answer.is_some()
            || case.growth.stop_after_cycles.is_some()
            || case.growth.critical_length.is_some()
            || case.growth.toughness.is_some()
            || case.inspection.is_some_and(|inspection| inspection.critical_depth.is_some());
        let turns = !(goes_straight || case.growth.turning.is_kink() || case.space().is_some());
        let cut = if turns { CUT } else { 1.0 };
        let given = (cut * case.growth.steps as f64).round() as usize;
        let steps = if ends_early { given.min(usual) } else { given };
        let later = size.displacements as f64 * size.unknowns as f64 * CONDENSATION;
        let dislocations = steps as f64 * contact(case, size, if steps > 1 { GROWN } else { 1.0 });
        let rolled = matches!(case.plastic_stress(), Some(PlasticSource::Rolled));
        let once = size.displacements as f64 * MESH
            + if rolls_on_patches(case) { PATCH_TABLE } else { 0.0 }
            + match (rolled, size.displacements) {
                (false, _) => 0.0,
                (true, 0) => ROLLING,
                (true, _) => ROLLING + CARRYING,
            };
        let positions = case.positions(case.first_wheel()).len() as f64;
        let rows = match case.output.faces {
            Kept::All => steps as f64 + 1.0,
            Kept::Ends => 2.0,
            Kept::None => 0.0,
        };
        let output = OUTPUT + PER_ROW * rows * positions * size.face_points as f64;
        let is_removed = case.maintenance.is_some_and(|removal| removal.mean_rate() > 0.0);
        // Those of finite elements are dislocations wherever these repeat the run.
        let quick = match case.engine() {
            Engine::Plane(_) => Engine::Plane(PlaneEngine::Dislocation),
            Engine::Space => Engine::Space,
        };
        let samples = case.scatter.map_or(0, |scatter| scatter.samples);
        let speeds = if samples > 0 && is_removed { SPEEDS } else { 0 };
        let companions = variants(case, quick).len() + speeds;
        let of_sample = if is_removed { REMOVED_SAMPLE } else { SAMPLE };
        Self {
            step: once + contact(case, size, 1.0),
            run: once + dislocations + steps as f64 * later + output,
            companions: (companions, companions as f64 * dislocations),
            samples: (samples, samples as f64 * of_sample),
        }
    }

    /// All of it.
    pub fn total(&self) -> f64 {
        self.run + self.companions.1 + self.samples.1
    }

    /// In words.
    pub fn in_words(&self) -> String {
        let mut parts = vec![format!("the run {}", duration(self.run))];
        if self.companions.0 > 0 {
            let (count, seconds) = self.companions;
            parts.push(format!("some {count} more for its decision {}", duration(seconds)));
        }
        if self.samples.0 > 0 {
            let (count, seconds) = self.samples;
            parts.push(format!("{count} samples {}", duration(seconds)));
        }
        let all = format!("about {} on one core", duration(self.total()));
        if parts.len() == 1 { all } else { format!("{all}: {}", parts.join(", ")) }
    }
}

/// Body and contact of a growth step, whose cracks have `grown` times their first size, without
/// what depends on displacements.
fn contact(case: &Case, size: &RunSize, grown: f64) -> f64 {
    let unknowns = grown * size.unknowns as f64;
    let cracks = case.cracks.cracks().len().max(1) as f64;
    let (problems, coupled) = match case.network {
        NetworkContact::Groups => (SWEEPS * cracks, unknowns.min(OF_GROUP * unknowns / cracks)),
        NetworkContact::Whole => (1.0, unknowns),
    };
    let wheels = case.computed_wheels() as f64;
    let load_steps = case.positions(case.first_wheel()).len() as f64 * PASSAGES * wheels;
    if case.space().is_some() {
        return SPACE_BODY * unknowns + load_steps * problems * SPACE_SQUARE * coupled * coupled;
    }
    let further = 1.0 + PER_FURTHER_CRACK * (cracks - 1.0).min(4.0);
    let points = if rolls_on_patches(case) { further * grown * size.face_points as f64 } else { 0.0 };
    let solved = problems * (PER_LOAD_STEP + PER_SQUARE * coupled * coupled);
    BODY_SQUARE * unknowns * coupled + load_steps * (solved + PER_PATCH_POINT * points)
}

/// Remark on a growth step that takes `seconds`; none where it is soon finished.
pub fn long_step(seconds: f64, size: &RunSize) -> Option<String> {
    (seconds >= LONG).then(|| {
        let mesh = match size.displacements {
            0 => String::new(),
            count => format!(" and {count} in the mesh"),
        };
        format!(
            "a growth step takes about {} on one core, because of {} unknowns on the faces{mesh}",
            duration(seconds),
            size.unknowns,
        )
    })
}

/// `seconds` in words, of which one digit counts.
pub fn duration(seconds: f64) -> String {
    match seconds {
        _ if seconds < 1.0 => "a second".to_owned(),
        _ if seconds < 90.0 => format!("{:.0} s", seconds),
        _ if seconds < 5400.0 => format!("{:.0} minutes", seconds / 60.0),
        _ if seconds < 48.0 * 3600.0 => format!("{:.0} hours", seconds / 3600.0),
        _ => format!("{:.0} days", seconds / 86400.0),
    }
}
