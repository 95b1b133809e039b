//! The cracks of a long row that the companions of its run follow: those that decide, with the
//! neighbours that shield them.

use super::error::RunError;
use super::job::Beside;
use super::run::Simulation;
use crate::decision::{deciding, from_run};
use crate::log::{Companion, CompanionKind, RunInfo, RunLog, StepDigest};

/// Neighbours on each side of a crack that decides; more where the life with these differs by more
/// than [`LARGEST_DIFFERENCE`]. Cracks beyond the 4th neighbour change K by 1.4 %, beyond the 6th
/// by 0.4 %, and of that most is common to all runs.
const NEIGHBOURS: [usize; 2] = [3, 6];
/// Difference of the life of a run with these cracks alone, relative to the life of the run.
/// Samples are held to 2 % of whole runs.
const LARGEST_DIFFERENCE: f64 = 0.01;
/// All cracks are followed unless at most one in this many is enough.
const ONE_IN: usize = 2;

/// The cracks that companions follow.
pub(super) struct RowPart {
    /// The cracks that decide and their neighbours, from 0.
    kept: Vec<usize>,
    /// The run with these cracks and their neighbours alone.
    run: Companion,
}

impl RowPart {
    pub fn into_companion(self) -> Companion {
        self.run
    }
}

impl Simulation<'_> {
    /// The part of a long row that companions of the run of `log` follow; none where all cracks are
    /// followed, because there are few or because no part of them repeats the run.
    ///
    /// Errors: an interruption.
    pub(super) fn part_of_row(
        &self,
        info: &RunInfo,
        log: &RunLog,
        beside: &Beside,
    ) -> Result<Option<RowPart>, RunError> {
        if self.case.space.is_some() {
            return Ok(None);
        }
        let deciding = deciding(info, log);
        for neighbours in NEIGHBOURS {
            let Some(kept) = self.kept(&deciding, neighbours) else { return Ok(None) };
            let run = self.companion(CompanionKind::PartOfRow, Some(&kept), beside)?;
            if from_run(info, log, &run).is_some_and(|difference| difference <= LARGEST_DIFFERENCE) {
                return Ok(Some(RowPart { kept, run }));
            }
        }
        Ok(None)
    }

    /// The companion of `kind` with the cracks of `part` alone. That with another friction between
    /// the faces has all cracks: friction changes how far they shield one another, and which leads.
    ///
    /// Errors: an interruption.
    pub(super) fn companion_of_part(
        &self,
        kind: CompanionKind,
        part: &RowPart,
        beside: &Beside,
    ) -> Result<Companion, RunError> {
        // Without scatter, samples about a run that must not break are that run.
        let has_all = kind == CompanionKind::Speed(1.0) || matches!(kind, CompanionKind::Friction(_));
        self.companion(kind, (!has_all).then_some(&part.kept), beside)
    }

    /// The cracks (from 0) around those that are `deciding`; none where they are so many that all
    /// are followed.
    fn kept(&self, deciding: &[usize], neighbours: usize) -> Option<Vec<usize>> {
        let kept = self.case.cracks.around(deciding, neighbours);
        let is_part = !kept.is_empty() && ONE_IN * kept.len() <= self.case.cracks.cracks().len();
        is_part.then_some(kept)
    }
}

/// Gives the cracks of `steps`, which are those `kept` (from 0) of a row, their numbers in it.
pub(super) fn numbered_as_in_the_run(steps: &mut [StepDigest], kept: Option<&[usize]>) {
    let Some(kept) = kept else { return };
    let renumber = |crack: &mut usize| *crack = kept.get(*crack).copied().unwrap_or(*crack);
    for step in steps {
        step.tips.iter_mut().for_each(|tip| renumber(&mut tip.tip.crack));
        step.pieces.iter_mut().for_each(|piece| renumber(&mut piece.crack));
        step.pop_in_test.iter_mut().for_each(|test| renumber(&mut test.crack));
    }
}
