//! Companions of a run in its decision: lives along other paths and with other friction between the
//! faces, courses at other speeds, and the difference that the distant cracks of a long row make to
//! them.

use super::course::{Course, CoursePoint};
use super::failure::{Nominal, NominalRun, Question};
use super::family::Family;
use super::path::GrowthPath;
use super::scatter::CourseAccuracy;
use crate::log::{Companion, CompanionKind, RunInfo, RunLog, StepDigest};
use serde::{Deserialize, Serialize};

/// Million gross tonnes to failure along three paths; null where that path does not lead to a
/// failure within its run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PathLives {
    /// Straight ahead.
    pub straight: Option<f64>,
    /// The path of the run.
    pub nominal: Option<f64>,
    /// The limit path, on which the best kink is zero at each tip.
    pub limit: Option<f64>,
}

/// Million gross tonnes to failure with another friction between the faces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrictionLife {
    /// Friction coefficient.
    pub friction: f64,
    /// The life; null where the rail does not fail within the run.
    pub mgt: Option<f64>,
}

/// The courses of the companions of a run.
pub(crate) struct Companions<'a> {
    pub all: &'a [Companion],
    /// The question asked of the run.
    pub question: Question,
    /// The crack (from 0) that an inspection looks for.
    pub found: usize,
}

impl<'a> Companions<'a> {
    fn course(&self, companion: &Companion) -> Course {
        let speed = companion.at_speed().unwrap_or(1.0);
        let Question { removal, tonnes, .. } = self.question.at_speed(speed);
        Course::of(&companion.steps, &removal.over_axles(tonnes), self.found)
    }

    /// The courses at other speeds, and those speeds, the fastest first; none that failed.
    pub fn speeds(&self) -> Speeds {
        let of = |companion: &Companion| Some((companion.at_speed()?, self.course(companion)));
        let mut all: Vec<(f64, Course)> = self.all.iter().filter_map(of).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        Speeds(all)
    }

    /// The finished steps of the companion of `kind`; none where there is none, or where it could
    /// not be followed to its end.
    pub fn steps_of(&self, kind: CompanionKind) -> Option<&'a [StepDigest]> {
        let all: &'a [Companion] = self.all;
        let ended = |companion: &&Companion| companion.kind == kind && companion.reason.is_none();
        all.iter().find(ended).map(|companion| companion.steps.as_slice())
    }

    /// The life of the companion of `kind`; none where there is none.
    fn life(&self, kind: CompanionKind) -> Option<Option<f64>> {
        let companion =
            self.all.iter().find(|companion| companion.kind == kind && companion.reason.is_none())?;
        Some(Nominal::of(&self.course(companion), &self.question).failure.mgt)
    }

    /// The lives along the three paths, where the others were computed; `nominal` is that of the
    /// run, which is one of the others where it goes straight ahead or along the limit path.
    pub fn paths(&self, nominal: Option<f64>) -> Option<PathLives> {
        use CompanionKind::{Limit, Straight};
        let was_asked = |kind: CompanionKind| self.all.iter().any(|companion| companion.kind == kind);
        let of = |kind| if was_asked(kind) { self.life(kind).flatten() } else { nominal };
        let is_known = [Straight, Limit].iter().any(|kind| self.life(*kind).is_some());
        is_known.then(|| PathLives { straight: of(Straight), nominal, limit: of(Limit) })
    }

    /// The lives with other frictions.
    pub fn frictions(&self) -> Vec<FrictionLife> {
        let of = |companion: &Companion| match companion.kind {
            CompanionKind::Friction(friction) => {
                Some(FrictionLife { friction, mgt: self.life(companion.kind)? })
            }
            _ => None,
        };
        self.all.iter().filter_map(of).collect()
    }
}

/// Runs of the same rail at other speeds, and these speeds, the fastest first.
#[derive(Default)]
pub(crate) struct Speeds(Vec<(f64, Course)>);

impl Speeds {
    /// The courses among which samples of the run `course` are made.
    pub fn family(&self, course: &Course) -> Family {
        self.family_without(None, course)
    }

    fn family_without(&self, left_out: Option<f64>, course: &Course) -> Family {
        let of = |is_it: &dyn Fn(f64) -> bool| -> Vec<&Course> {
            let kept = self.0.iter().filter(|(speed, _)| is_it(*speed) && Some(*speed) != left_out);
            kept.map(|(_, course)| course).collect()
        };
        let nominal = of(&|speed| speed == 1.0).first().copied().unwrap_or(course);
        Family::of(nominal, &of(&|speed| speed > 1.0), &of(&|speed| speed < 1.0))
    }

    /// How well samples between the run `course` and these repeat each of them that lies between
    /// two others; none without any.
    pub fn accuracy(&self, course: &Course, question: &Question) -> Option<CourseAccuracy> {
        let runs = self.others().count() + 1;
        let errors = self.left_out(course, question).into_iter();
        let left_out_percent = errors.map(|(_, error)| 100.0 * error).reduce(f64::max);
        (runs > 1).then_some(CourseAccuracy { runs, left_out_percent })
    }

    /// Speeds that would halve the gaps beside each of them that the others repeat with an error of
    /// more than `accepted`.
    pub fn finer(&self, course: &Course, question: &Question, accepted: f64) -> Vec<f64> {
        let mut all: Vec<f64> = self.others().map(|(speed, _)| *speed).chain([1.0]).collect();
        all.sort_by(f64::total_cmp);
        let errors = self.left_out(course, question);
        let is_coarse = |speed: &f64| errors.iter().any(|(own, error)| own == speed && *error > accepted);
        let gaps = all.windows(2).filter(|pair| pair.iter().any(is_coarse));
        gaps.map(|pair| (pair[0] * pair[1]).sqrt()).collect()
    }

    fn others(&self) -> impl Iterator<Item = &(f64, Course)> {
        self.0.iter().filter(|(speed, _)| *speed != 1.0)
    }

    /// The speeds between two others, and the error of the life at each of them by samples between
    /// the other runs, relative to its own.
    fn left_out(&self, course: &Course, question: &Question) -> Vec<(f64, f64)> {
        let inner = self.others().skip(1).take(self.others().count().saturating_sub(2));
        let error = |(speed, left_out): &(f64, Course)| {
            let family = self.family_without(Some(*speed), course);
            let own = Nominal::of(left_out, &question.at_speed(*speed));
            let found = Nominal::mgt_at_speed(&family, *speed, question)?;
            Some((*speed, (found * speed / own.failure.mgt? - 1.0).abs()))
        };
        inner.filter_map(error).collect()
    }
}

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
