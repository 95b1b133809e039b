//! Estimate of the time that a growth step takes.

use crate::setup::RunSize;
use railcrack::growth::NetworkContact;
use railcrack_case::Case;

/// Seconds per cube of the number of contact unknowns: inverse and factors of the body. This and
/// the next one were measured on one core with single cracks at 0.5 to 2 degrees by dislocations,
/// of 800 to 3200 unknowns; they are right to a factor of three.
const PER_CUBE: f64 = 4.2e-10;
/// Seconds per square of that number, position and passage: one load step.
const PER_SQUARE: f64 = 1.1e-9;
/// Seconds per displacement unknown to the power of 5/4: mesh, factor and columns.
const PER_DISPLACEMENT: f64 = 3e-7;
/// Passages until the history repeats, with friction.
const PASSAGES: f64 = 2.0;
/// Largest number of unknowns of a group of cracks, and sweeps over all groups.
const OF_GROUP: f64 = 600.0;
const SWEEPS: f64 = 5.0;
/// Cracks in space take this many times as long as those in the plane with as many unknowns.
const IN_SPACE: f64 = 6.0;

/// Time (s) from which on a growth step is worth a warning.
const LONG: f64 = 30.0;

/// Approximate time (s) of the first growth step of `case` on one core.
pub fn step_seconds(case: &Case, size: &RunSize) -> f64 {
    let unknowns = size.unknowns as f64;
    let (coupled, sweeps) = match case.network {
        NetworkContact::Whole => (unknowns, 1.0),
        NetworkContact::Groups => (unknowns.min(OF_GROUP), SWEEPS),
    };
    let wheels = case.computed_wheels() as f64;
    let load_steps = case.positions(case.first_wheel()).len() as f64 * PASSAGES * wheels * sweeps;
    let plane = unknowns * coupled * (PER_CUBE * coupled + PER_SQUARE * load_steps)
        + PER_DISPLACEMENT * (size.displacements as f64).powf(1.25);
    if case.space().is_some() { IN_SPACE * plane } else { plane }
}

/// Remark on a growth step that takes `seconds`; none where it is soon finished.
pub fn long_step(seconds: f64, size: &RunSize) -> Option<String> {
    let time = match seconds {
        seconds if seconds < LONG => return None,
        seconds if seconds < 90.0 => "a minute".to_owned(),
        seconds if seconds < 5400.0 => format!("{:.0} minutes", seconds / 60.0),
        seconds if seconds < 48.0 * 3600.0 => format!("{:.0} hours", seconds / 3600.0),
        seconds => format!("{:.0} days", seconds / 86400.0),
    };
    Some(format!(
        "a growth step takes about {time} on one core, because of {} unknowns on the faces{}",
        size.unknowns,
        if size.displacements > 0 {
            format!(" and {} in the mesh", size.displacements)
        } else {
            String::new()
        }
    ))
}
