//! Companions of a run in its decision: lives along other paths and with other friction between the
//! faces, and courses at other speeds.

use super::course::Course;
use super::failure::{Nominal, Question};
use crate::log::{Companion, CompanionKind};
use railcrack_case::MaintenancePlan;
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
pub(super) struct Companions<'a> {
    pub all: &'a [Companion],
    pub question: Question<'a>,
    /// The crack (from 0) that an inspection looks for.
    pub found: usize,
}

impl Companions<'_> {
    fn course(&self, companion: &Companion) -> Course {
        let speed = match companion.kind {
            CompanionKind::Speed(speed) => speed,
            _ => 1.0,
        };
        let plan = self.question.maintenance.map(|plan| slowed(plan, speed));
        Course::of(&companion.steps, plan.as_ref(), self.question.tonnes, self.found)
    }

    /// The courses at other speeds, and those speeds, the fastest first; none that failed.
    pub fn speeds(&self) -> Vec<(f64, Course)> {
        let of = |companion: &Companion| match companion.kind {
            CompanionKind::Speed(speed) if companion.reason.is_none() => {
                Some((speed, self.course(companion)))
            }
            _ => None,
        };
        let mut all: Vec<(f64, Course)> = self.all.iter().filter_map(of).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        all
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

/// `plan` for cracks that grow faster by `speed`, told in their traffic: the same growth takes that
/// much less, and less is removed meanwhile.
pub(crate) fn slowed(plan: &MaintenancePlan, speed: f64) -> MaintenancePlan {
    MaintenancePlan {
        wear: plan.wear / speed,
        grinding: plan.grinding.map(|(depth, interval)| (depth, interval * speed)),
        first_grinding: plan.first_grinding.map(|first| first * speed),
        ..*plan
    }
}
