//! The course of a run with its failures.

use super::course::Course;
use super::failure::{Nominal, Question};
use crate::log::{RunInfo, RunLog};

/// The question of a case to its runs with axles of `tonnes`.
pub(crate) fn question(info: &RunInfo, tonnes: f64) -> Question<'_> {
    Question {
        inspection: info.inspection.as_ref(),
        critical_length: info.critical_length,
        tonnes,
        maintenance: info.maintenance.as_ref(),
    }
}

/// The course of the run of `log` with its failures, for the crack that fails first; none without
/// steps.
pub(crate) fn course_of(info: &RunInfo, log: &RunLog, tonnes: f64) -> Option<(Course, Nominal)> {
    let question = question(info, tonnes);
    let plan = info.maintenance.as_ref();
    let mut found = grown_most(log)?;
    let mut course = Course::of(&log.steps, plan, tonnes, found);
    let mut nominal = Nominal::of(&course, &question);
    if let Some(crack) = nominal.failure.crack
        && crack - 1 != found
    {
        found = crack - 1;
        course = Course::of(&log.steps, plan, tonnes, found);
        nominal = Nominal::of(&course, &question);
    }
    (!course.points.is_empty()).then_some((course, nominal))
}

/// The crack (from 0) at whose tips most has grown.
fn grown_most(log: &RunLog) -> Option<usize> {
    let last = log.steps.last()?;
    let grown = |tip: &railcrack::growth::TipRecord| {
        let same = |step: &crate::log::StepDigest| {
            step.tips.iter().find(|other| other.tip == tip.tip).map_or(0.0, |other| other.increment)
        };
        log.steps.iter().map(same).sum::<f64>()
    };
    let most = last.tips.iter().max_by(|a, b| {
        let deeper = a.depth().total_cmp(&b.depth());
        grown(a).total_cmp(&grown(b)).then(deeper)
    })?;
    Some(most.tip.crack)
}
