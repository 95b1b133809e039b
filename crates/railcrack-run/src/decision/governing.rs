//! The path that governs a decision: of those that were computed the one with the shortest life.

use super::companions::Companions;
use super::failure::NominalRun;
use super::inspection::InspectionSummary;
use super::path::GrowthPath;
use super::rows::rows_of;
use crate::log::{CompanionKind, RunInfo, StepDigest};
use serde::{Deserialize, Serialize};

/// A path of the cracks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DecisionPath {
    /// That of the run.
    #[default]
    Nominal,
    /// Straight ahead.
    Straight,
    /// The limit path.
    Limit,
}

impl DecisionPath {
    /// In words, as a note on a life; none for that of the run.
    #[must_use]
    pub fn note(self) -> Option<&'static str> {
        match self {
            Self::Nominal => None,
            Self::Straight => Some("straight ahead"),
            Self::Limit => Some("along the limit path"),
        }
    }
}

/// The run along the path that governs, with its steps.
#[derive(Debug, Clone)]
pub(crate) struct Governing<'a> {
    /// The path.
    pub path: DecisionPath,
    /// The run along it.
    pub run: NominalRun,
    /// Its finished steps.
    pub steps: &'a [StepDigest],
}

/// A life is shorter than another one where it is by more than this fraction of it.
const SHORTER: f64 = 1e-6;

impl<'a> Governing<'a> {
    /// The `run` of `steps` by itself.
    pub fn alone(run: &NominalRun, steps: &'a [StepDigest]) -> Self {
        Self { path: DecisionPath::Nominal, run: run.clone(), steps }
    }

    /// The inspection of the case along this path, where it has one.
    pub fn inspected(&self, info: &RunInfo) -> Option<InspectionSummary> {
        let given = info.inspection.as_ref()?;
        let path = GrowthPath::of(self.steps, self.run.failing_tip());
        let rows = path.map_or_else(Vec::new, |path| rows_of(&path, self.run.question.tonnes));
        Some(InspectionSummary::of(&self.run.nominal, given, &rows))
    }

    /// Of the `run` of `steps` and its `companions` along other paths the one that fails first.
    pub fn of(run: &NominalRun, steps: &'a [StepDigest], companions: &Companions<'a>) -> Self {
        let life = |of: &Self| of.run.nominal.failure.mgt.unwrap_or(f64::INFINITY);
        let others =
            [(CompanionKind::Straight, DecisionPath::Straight), (CompanionKind::Limit, DecisionPath::Limit)];
        let other = |(kind, path)| {
            let steps = companions.steps_of(kind)?;
            Some(Self { path, run: NominalRun::of(steps, companions.question)?, steps })
        };
        let shorter =
            |most: Self, next: Self| if life(&next) < life(&most) * (1.0 - SHORTER) { next } else { most };
        others.into_iter().filter_map(other).fold(Self::alone(run, steps), shorter)
    }
}
