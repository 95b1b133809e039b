//! Failure of the rail in the run: the first of all modes over all cracks and tips.

use super::course::{Course, CourseEvent, FailureMode};
use super::events::{Fate, Limits};
use super::family::Family;
use super::life_error::{error_at, life_error};
use super::path::most_grown;
use super::risk::DepthCurve;
use super::walk::{SampledRates, Track, Walk, Walked};
use super::window::Window;
use crate::log::{RunInfo, StepDigest};
use railcrack::growth::{Axles, Mgt, SurfaceRemoval};
use railcrack_case::Inspection;
use serde::{Deserialize, Serialize};

/// A failure of the rail.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FailureSummary {
    /// The mode; null where the rail does not fail within the run.
    #[serde(with = "mode_or_none")]
    pub mode: Option<FailureMode>,
    /// Million gross tonnes until then.
    pub mgt: Option<f64>,
    /// The estimated error of this tonnage by the increments, million gross tonnes.
    #[serde(default)]
    pub mgt_error: Option<f64>,
    /// Its crack, from 1.
    pub crack: Option<usize>,
    /// The tip within its crack, from 1.
    pub tip: Option<usize>,
}

/// `none` where there is no failure.
mod mode_or_none {
    use super::FailureMode;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    enum Word {
        None,
        #[serde(untagged)]
        Mode(FailureMode),
    }

    pub(super) fn serialize<S: Serializer>(mode: &Option<FailureMode>, to: S) -> Result<S::Ok, S::Error> {
        mode.map_or(Word::None, Word::Mode).serialize(to)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<FailureMode>, D::Error> {
        Ok(match Word::deserialize(from)? {
            Word::None => None,
            Word::Mode(mode) => Some(mode),
        })
    }
}

impl FailureSummary {
    /// No failure within the run.
    pub const NONE: Self = Self { mode: None, mgt: None, mgt_error: None, crack: None, tip: None };
}

/// Question to a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Question {
    /// The inspection; without one, that which finds nothing and calls no depth critical.
    pub inspection: Inspection,
    /// A length that is critical, mm.
    pub critical_length: Option<f64>,
    /// Mean load of an axle, t.
    pub tonnes: f64,
    /// Wear and grinding.
    pub removal: SurfaceRemoval<Mgt>,
}

impl Question {
    /// The question of a case to its runs; none without axle loads.
    pub fn of(info: &RunInfo) -> Option<Self> {
        Some(Self {
            inspection: info.inspection.unwrap_or_default(),
            critical_length: info.critical_length,
            tonnes: info.axle_load?,
            removal: info.maintenance.unwrap_or(SurfaceRemoval::NONE),
        })
    }

    /// The question to cracks that grow faster by `speed`, in the traffic in which they grow as
    /// much.
    pub fn at_speed(&self, speed: f64) -> Self {
        Self { removal: self.removal.outpaced(speed), ..*self }
    }

    pub(super) fn limits(&self) -> Limits {
        Limits {
            critical_depth: self.inspection.critical_depth,
            critical_length: self.critical_length,
            toughness: None,
            detectable_depth: self.inspection.detectable_depth,
            detectable_length: self.inspection.detectable_length,
            ignored: None,
        }
    }

    /// The walk of cracks that grow faster by `speed` than the run of `family`, but for failures of
    /// the mode `ignored`.
    fn walk(&self, family: &Family, speed: f64, ignored: Option<FailureMode>) -> (Walked, Track) {
        let walk = Walk::through(family, self.tonnes, self.removal);
        let rates = SampledRates { faster: speed, ..SampledRates::of_case(self.tonnes, self.removal) };
        let mut track = Track::default();
        let walked = walk.walk(&rates, &Limits { ignored, ..self.limits() }, &mut track);
        (walked, track)
    }
}

/// The run of a decision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Nominal {
    /// How it ends.
    pub failure: FailureSummary,
    /// The next failure, of another mode.
    pub second: FailureSummary,
    /// Million gross tonnes until the crack becomes detectable for the last time, where it does.
    pub detected: Option<f64>,
    /// The traffic in which an inspection can find the crack, where it can.
    pub window: Option<Window>,
    /// Million gross tonnes until the last crack is worn away.
    pub worn: Option<f64>,
    /// Million gross tonnes until the rail is worn to the limit at which it is replaced.
    pub replaced: Option<f64>,
}

impl Nominal {
    /// The run `course`.
    pub fn of(course: &Course, question: &Question) -> Self {
        let family = Family::alone(course);
        let (first, _) = question.walk(&family, 1.0, None);
        let failure = failure_of(course, first.fate, question);
        let second = failure.mode.map_or(FailureSummary::NONE, |mode| {
            let (next, _) = question.walk(&family, 1.0, Some(mode));
            failure_of(course, next.fate, question)
        });
        let (worn, replaced) = match first.fate {
            Fate::Worn(mgt) => (Some(mgt), None),
            Fate::Replaced(mgt) => (None, Some(mgt)),
            _ => (None, None),
        };
        let window = first.window;
        Self { failure, second, detected: window.map(|window| window.from), window, worn, replaced }
    }

    /// Million gross tonnes to failure of cracks in `family` that grow faster by `speed`; none
    /// where they do not fail.
    pub fn mgt_at_speed(family: &Family, speed: f64, question: &Question) -> Option<f64> {
        question.walk(family, speed, None).0.fate.failure()
    }

    /// The depth of the crack that is looked for in the run `course`, over traffic.
    pub fn depths(course: &Course, question: &Question) -> DepthCurve {
        let (_, track) = question.walk(&Family::alone(course), 1.0, None);
        DepthCurve::through(track.points().iter().copied())
    }
}

/// The failure at the end of a walk along `course`.
fn failure_of(course: &Course, fate: Fate, question: &Question) -> FailureSummary {
    let Fate::Fails(mode, mgt) = fate else { return FailureSummary::NONE };
    let Question { tonnes, ref removal, .. } = *question;
    let Axles(axles) = Mgt(mgt).axles(tonnes);
    let after = course.points.iter().find(|point| point.axles >= axles * (1.0 - 1e-9));
    let after = after.or(course.points.last());
    let of_event = || course.event(Some(mode)).map(|event: &CourseEvent| event.tip);
    let tip = match mode {
        FailureMode::Depth => after.map(|point| point.deepest),
        FailureMode::Length => after.map(|point| (point.longest, point.deepest.1)),
        _ => of_event(),
    };
    let Limits { critical_depth, critical_length, .. } = question.limits();
    let error = match (mode, critical_depth, critical_length) {
        (FailureMode::Depth, Some(depth), _) => {
            life_error(course, |point| point.depth, depth, axles, tonnes, removal)
        }
        (FailureMode::Length, _, Some(length)) => {
            life_error(course, |point| point.length, length, axles, tonnes, removal)
        }
        _ => error_at(&course.points, axles),
    };
    FailureSummary {
        mode: Some(mode),
        mgt: Some(mgt),
        mgt_error: after.map(|_| Axles(error).mgt(tonnes).0),
        crack: tip.map(|(crack, _)| crack + 1),
        tip: tip.map(|(_, tip)| tip + 1),
    }
}

/// The run of a decision, with its failures.
#[derive(Debug, Clone)]
pub(crate) struct NominalRun {
    /// The question asked of it.
    pub question: Question,
    /// All its cracks over traffic.
    pub course: Course,
    /// Its failures.
    pub nominal: Nominal,
    /// The crack (from 0) that an inspection looks for: the one that fails first, or where none
    /// does the one that has grown most.
    pub found: usize,
}

impl NominalRun {
    /// The run of `steps`, of which `question` is asked; none without steps.
    pub fn of(steps: &[StepDigest], question: Question) -> Option<Self> {
        let removal = question.removal.over_axles(question.tonnes);
        let run = |found: usize| {
            let course = Course::of(steps, &removal, found);
            let nominal = Nominal::of(&course, &question);
            Self { question, course, nominal, found }
        };
        let first = run(most_grown(steps)?.tip.crack);
        let failing = first.nominal.failure.crack.map_or(first.found, |crack| crack - 1);
        let run = if failing == first.found { first } else { run(failing) };
        (!run.course.points.is_empty()).then_some(run)
    }

    /// Crack and tip (from 0) of the failure.
    pub fn failing_tip(&self) -> Option<(usize, usize)> {
        let FailureSummary { mode, crack, tip, .. } = self.nominal.failure;
        // A length is that of a crack, at any of its tips.
        let tip = tip.filter(|_| mode != Some(FailureMode::Length));
        Some((crack? - 1, tip? - 1))
    }
}
