//! Companions of a run in its decision: lives along other paths and with other friction between the
//! faces, and courses at other speeds.

use super::course::Course;
use super::failure::{Nominal, Question};
use super::family::Family;
use super::scatter::CourseAccuracy;
use crate::log::{Companion, CompanionKind};
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
    /// What is asked of the run.
    pub question: Question,
    /// The crack (from 0) that an inspection looks for.
    pub found: usize,
}

impl Companions<'_> {
    fn course(&self, companion: &Companion) -> Course {
        let Question { removal, tonnes, .. } = self.question.at_speed(companion.kind.speed());
        Course::of(&companion.steps, &removal.over_axles(tonnes), self.found)
    }

    /// The courses at other speeds, and those speeds, the fastest first; none that failed.
    pub fn speeds(&self) -> Speeds {
        let is_one = |companion: &&Companion| {
            matches!(companion.kind, CompanionKind::Speed(_)) && companion.reason.is_none()
        };
        let of = |companion: &Companion| (companion.kind.speed(), self.course(companion));
        let mut all: Vec<(f64, Course)> = self.all.iter().filter(is_one).map(of).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        Speeds(all)
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
        let others = || self.0.iter().filter(|(speed, _)| *speed != 1.0);
        let runs = others().count() + 1;
        let inner = others().skip(1).take(runs.saturating_sub(3));
        let error = |(speed, left_out): &(f64, Course)| {
            let family = self.family_without(Some(*speed), course);
            let own = Nominal::of(left_out, &question.at_speed(*speed));
            let found = Nominal::mgt_at_speed(&family, *speed, question)?;
            Some(100.0 * (found * speed / own.failure.mgt? - 1.0).abs())
        };
        let left_out_percent = inner.filter_map(error).reduce(f64::max);
        (runs > 1).then_some(CourseAccuracy { runs, left_out_percent })
    }
}
