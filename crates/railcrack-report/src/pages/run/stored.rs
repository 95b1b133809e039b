//! A run as its folder has it.

use crate::direction::{Heading, heading};
use railcrack::space::WheelPatch;
use railcrack_case::Case;
use railcrack_run::csv::TipRow;
use railcrack_run::decision::Decision;
use railcrack_run::setup::wheel_patches;
use railcrack_run::{OutputError, Summary};
use std::path::{Path, PathBuf};

/// A run without its histories and faces.
#[derive(Debug)]
pub(crate) struct RunFolder {
    pub(crate) path: PathBuf,
    /// Text of `case.toml`.
    pub(crate) text: String,
    pub(crate) case: Case,
    /// The patches of its wheels in space; none in the plane.
    pub(crate) patches: Vec<WheelPatch>,
    pub(crate) summary: Summary,
    /// In the order of the table: by step, crack, tip.
    pub(crate) growth: Vec<TipRow>,
    /// Depth (mm) and σ_xx (MPa) of the residual stress.
    pub(crate) residual: Vec<[f64; 2]>,
}

impl RunFolder {
    /// Errors: no run in the folder; a file of it is damaged; the system refuses.
    pub(crate) fn read(folder: &Path) -> Result<Self, OutputError> {
        let run = railcrack_run::RunFolder::open(folder)?;
        let case = run.case()?;
        Ok(Self {
            patches: wheel_patches(&case),
            case,
            growth: run.growth()?,
            residual: run.residual()?.iter().map(|row| [row.depth, row.stress.xx]).collect(),
            path: run.path,
            text: run.case_text,
            summary: run.summary,
        })
    }

    /// Whether the samples of `[scatter]` were left to the study of the run.
    pub(crate) fn lacks_samples(&self) -> bool {
        let grows = |decision: &Decision| decision.scatter.is_none() && decision.rows.len() > 1;
        self.case.scatter.is_some()
            && self.summary.complete
            && self.summary.decision.as_ref().is_some_and(grows)
    }

    /// The first step at whose start the failure of the decision has happened: what comes later is
    /// of a rail that has been replaced. None where nothing fails.
    pub(super) fn failed_by(&self) -> Option<usize> {
        let decision = self.summary.decision.as_ref().filter(|_| self.is_signed())?;
        let axles = decision.failure.mgt? * 1e6 / decision.axle_load_t;
        self.growth.iter().find(|row| row.load_cycles >= (1.0 - 1e-9) * axles).map(|row| row.step)
    }

    /// Whether `step` begins before the rail has failed.
    pub(super) fn is_before_failure(&self, step: usize) -> bool {
        self.failed_by().is_none_or(|failed| step <= failed)
    }

    /// Whether somebody signs the page: an inspection is decided on.
    pub(super) fn is_signed(&self) -> bool {
        self.case.inspection.is_some() && self.summary.decision.is_some()
    }

    /// The rows of a tip, by step.
    pub(super) fn history(&self, crack: usize, tip: usize) -> impl Iterator<Item = &TipRow> {
        self.growth.iter().filter(move |row| (row.crack, row.tip) == (crack, tip))
    }

    /// Half-widths of the contacts of the wheels, mm.
    pub(crate) fn half_widths(&self) -> Vec<f64> {
        self.case.wheels.iter().map(|wheel| wheel.wheel.half_width()).collect()
    }

    /// The tips, as (crack, tip).
    pub(super) fn tips(&self) -> Vec<(usize, usize)> {
        self.growth.iter().filter(|row| row.step == 0).map(|row| (row.crack, row.tip)).collect()
    }

    /// Direction of the last segment at the tip of `row`, its last one; none where its crack is a
    /// point.
    pub(super) fn heading(&self, row: &TipRow) -> Option<Heading> {
        let crack = self.summary.cracks.get(row.crack.checked_sub(1)?)?;
        heading(crack, &self.history(row.crack, row.tip).collect::<Vec<_>>())
    }

    /// The rows of the last finished step.
    pub(super) fn last(&self) -> impl Iterator<Item = &TipRow> {
        let last = self.summary.steps_recorded.saturating_sub(1);
        self.growth.iter().filter(move |row| row.step == last)
    }
}
