//! The difference that the distant cracks of a long row make to the runs of a decision.

use super::course::{Course, CoursePoint};
use super::failure::Question;
use super::nominal_run::NominalRun;
use super::path::GrowthPath;
use crate::log::{Companion, CompanionKind, RunInfo, RunLog};
use serde::{Deserialize, Serialize};

/// The cracks of a long row that were followed along other paths and at other speeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowPartSummary {
    /// These cracks, from 1: those that decide and their neighbours.
    pub cracks: Vec<usize>,
    /// Number of all cracks.
    pub of: usize,
    /// Million gross tonnes to failure with these cracks alone, otherwise as in the run; null where
    /// the rail does not fail.
    pub mgt: Option<f64>,
    /// Difference that leaving out the others makes to the life, or where the rail does not fail to
    /// the growth of the crack that is looked for, percent.
    pub difference_percent: f64,
}

impl RowPartSummary {
    /// The numbers of its cracks, `1 to 4, 12 to 15`.
    #[must_use]
    pub fn numbers(&self) -> String {
        let rows = self.cracks.chunk_by(|one, next| *next == one + 1);
        let of_row = |row: &[usize]| match row {
            [first, .., last] => format!("{first} to {last}"),
            alone => alone.iter().map(usize::to_string).collect(),
        };
        rows.map(of_row).collect::<Vec<String>>().join(", ")
    }

    /// Of the run of `log` with its companions; none where these have all cracks.
    pub(super) fn of(info: &RunInfo, log: &RunLog) -> Option<Self> {
        let all = log.now.companions.as_deref()?;
        let alone = all.iter().find(|companion| companion.kind == CompanionKind::PartOfRow)?;
        let mut cracks: Vec<usize> = alone.steps.first()?.tips.iter().map(|tip| tip.tip.crack + 1).collect();
        cracks.dedup();
        Some(Self {
            cracks,
            of: log.now.initial_cracks.len(),
            mgt: with_failures(info, alone).and_then(|run| run.nominal.failure.mgt),
            difference_percent: 100.0 * from_run(info, log, alone)?,
        })
    }
}

/// The cracks (from 0) that decide in the run of `log`: that of the first failure, that of the next
/// one, and the one that is looked for.
pub(crate) fn deciding(info: &RunInfo, log: &RunLog) -> Vec<usize> {
    let run = Question::of(info).and_then(|question| NominalRun::of(&log.steps, question));
    let failing = run.into_iter().flat_map(|run| [run.nominal.failure.crack, run.nominal.second.crack]);
    let mut all: Vec<usize> = failing.flatten().map(|crack| crack - 1).collect();
    if all.is_empty() {
        all.extend(GrowthPath::of(&log.steps, None).map(|path| path.tip.0 - 1));
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// The difference of the run with some cracks `alone` from the run of `log`: of the life, or where
/// neither fails of the growth of the crack that is looked for, relative to that of the run. None
/// where one of them fails and the other does not, or they fail differently.
pub(crate) fn from_run(info: &RunInfo, log: &RunLog, alone: &Companion) -> Option<f64> {
    let run = NominalRun::of(&log.steps, Question::of(info)?)?;
    let part = with_failures(info, alone)?;
    let (one, other) = (run.nominal.failure, part.nominal.failure);
    if (one.mode, one.crack) != (other.mode, other.crack) {
        return None;
    }
    if let (Some(mgt), Some(of_part)) = (one.mgt, other.mgt) {
        return Some((of_part / mgt - 1.0).abs());
    }
    let end = |course: &Course| course.points.last().map_or(0.0, |point| point.axles);
    let at = end(&run.course).min(end(&part.course));
    let [run, part] = [&run.course, &part.course].map(|course| grown(course, at));
    Some(if run == part { 0.0 } else { (part / run - 1.0).abs() })
}

/// The companion `alone` with its failures; none where it could not be followed to its end.
fn with_failures(info: &RunInfo, alone: &Companion) -> Option<NominalRun> {
    NominalRun::of(&alone.steps, Question::of(info)?).filter(|_| alone.reason.is_none())
}

/// Growth into the depth of the crack that is looked for until `axles`, mm; what is removed counts.
fn grown(course: &Course, axles: f64) -> f64 {
    let reach = |point: &CoursePoint| point.own_depth + point.removed;
    let Some(first) = course.points.first() else { return 0.0 };
    let next = course.points.iter().position(|point| point.axles >= axles).unwrap_or(0);
    let after = &course.points[next];
    let Some(before) = next.checked_sub(1).map(|i| &course.points[i]) else { return 0.0 };
    let share = (axles - before.axles) / (after.axles - before.axles);
    reach(before) + share * (reach(after) - reach(before)) - reach(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_cracks_in_words() {
        let of = |cracks: &[usize]| {
            RowPartSummary { cracks: cracks.to_vec(), of: 20, mgt: None, difference_percent: 0.0 }.numbers()
        };
        assert_eq!(of(&[12, 13, 14, 15]), "12 to 15");
        assert_eq!(of(&[1, 2, 4, 7, 8, 9]), "1 to 2, 4, 7 to 9");
    }
}
