//! The growth of the cracks as a case gives it.

use super::growth::{
    ARREST_RATE, CRITICAL_LENGTH, CrackSurface, DIRECTION, INCREMENT, KINK_ANGLE, KINK_FRICTION, STEPS,
    STOP_AFTER_CYCLES, STRAIGHT_TO, SURFACE, TOLERANCE, TURNING, TURNING_LENGTH, Turns,
};
use super::law::read_law;
use crate::files::RatesFile;
use crate::schema::{Report, SectionValues};
use railcrack::fatigue::RailSteel;
use railcrack::growth::{Answer, GrowthSettings, Turning};
use std::path::Path;

/// The growth of the cracks as a case gives it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Growing {
    pub settings: GrowthSettings,
    /// The steel whose law it is.
    pub steel: Option<&'static RailSteel>,
    /// The table whose law it is.
    pub rates: Option<RatesFile>,
    /// Whether the case says how its paths turn.
    pub path: PathGiven,
}

/// Who says how paths turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PathGiven {
    /// The case.
    ByCase,
    /// Nobody.
    ByDefault,
}

/// The first increment that is chosen for a tolerance, as a fraction of the length.
const FIRST_INCREMENT: f64 = 0.02;
/// The tolerance of the life by default.
const TOLERANCE_BY_DEFAULT: f64 = 0.01;

/// The growth of the cracks; files are relative to `folder`.
pub(crate) fn read_growth(section: &SectionValues, folder: &Path, report: &mut Report) -> Option<Growing> {
    let given = read_law(section, folder, report)?;
    let defaults = GrowthSettings::REFERENCE;
    let turning = match section.get(TURNING)? {
        Turns::Smooth => Turning::Over(section.get(TURNING_LENGTH)?),
        Turns::Kink => Turning::Kink,
    };
    let (increment, tolerance) = (section.get(INCREMENT), section.get(TOLERANCE));
    if tolerance.is_some() && (increment.is_some() || turning.is_kink()) {
        let (says, help) = match increment {
            Some(_) => {
                ("increments are either given or chosen for a tolerance", "leave out increment or tolerance")
            }
            None => (
                "a path that kinks in each increment has no limit, so that no increment is small enough for a tolerance",
                "leave out tolerance or turning = \"kink\"",
            ),
        };
        return report.refuse(section.fault(TOLERANCE, says).help(help));
    }
    let is_given = increment.is_some() || turning.is_kink();
    let steps = section.get(STEPS);
    let settings = GrowthSettings {
        toughness: None,
        pop_in: None,
        usual_toughness: None,
        maintenance: None,
        steps: steps.unwrap_or(GrowthSettings::MOST_STEPS),
        answer: steps.is_none().then_some(Answer::default()),
        increment: increment.unwrap_or(if is_given { defaults.increment } else { FIRST_INCREMENT }),
        tolerance: (!is_given).then_some(tolerance.unwrap_or(TOLERANCE_BY_DEFAULT)),
        turning,
        turns_in_space: section.get(SURFACE)? == CrackSurface::Turned,
        straight_depth: section.get(STRAIGHT_TO).unwrap_or(0.0),
        kink_angle: section.get(KINK_ANGLE).map_or(defaults.kink_angle, f64::to_radians),
        kink_friction: section.get(KINK_FRICTION)?,
        law: given.law,
        arrest_rate: section.get(ARREST_RATE)?,
        criterion: section.get(DIRECTION)?,
        critical_length: section.get(CRITICAL_LENGTH),
        stop_after_cycles: section.get(STOP_AFTER_CYCLES),
    };
    let says_so = turning.is_kink() || section.is_given(TURNING_LENGTH) || section.is_given(STRAIGHT_TO);
    let path = if says_so { PathGiven::ByCase } else { PathGiven::ByDefault };
    Some(Growing { path, settings, steel: given.steel, rates: given.rates })
}
