//! A run that is compared, from its folder.

use crate::csv::{SifRow, Table, TipRow};
use crate::decision::VerdictLevel;
use crate::disk::files::{CASE_FILE, SUMMARY_FILE};
use crate::error::OutputError;
use crate::run_folder::{History, RunFolder, stored_case};
use crate::summary::Summary;
use railcrack::bulk::Boundary;
use railcrack::growth::RunStop;
use railcrack_case::{Case, ContactSolver, Engine, Kept};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Step, crack and tip, as in the tables.
pub(super) type TipKey = (usize, usize, usize);

/// A run in a comparison: its distinguishing features.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunLabel {
    /// The run folder.
    pub folder: PathBuf,
    /// Engine.
    #[serde(with = "crate::disk::words")]
    pub engine: Engine,
    /// Contact solver.
    #[serde(with = "crate::disk::words")]
    pub contact: ContactSolver,
    /// Boundary of the rail.
    #[serde(with = "crate::disk::words")]
    pub boundary: Boundary,
    /// Half-width a of the wheel contact, mm.
    pub half_width_mm: f64,
    /// Finished steps, the initial geometry counted.
    pub steps_recorded: usize,
    /// Why the run ended; null where it has not.
    #[serde(with = "crate::disk::words::optional")]
    pub stop: Option<RunStop>,
    /// Load cycles at the start of the last finished step.
    pub load_cycles: f64,
    /// Wall time, seconds.
    pub wall_s: f64,
    /// Million gross tonnes of these load cycles; null without axle loads.
    #[serde(default)]
    pub million_gross_tonnes: Option<f64>,
    /// Million gross tonnes to the failure; null where there is none within the run.
    #[serde(default)]
    pub failure_mgt: Option<f64>,
    /// Level of the verdict; null without one.
    #[serde(default)]
    pub verdict: Option<VerdictLevel>,
    /// The inspection interval to act on, million gross tonnes; null without one.
    #[serde(default)]
    pub interval_mgt: Option<f64>,
    /// Ends of the passage near the cracks, x_c/a; beyond them are the positions of a rail that
    /// bends.
    #[serde(default)]
    pub near_over_a: Option<[f64; 2]>,
}

/// Everything of a run that is compared.
#[derive(Debug)]
pub(super) struct StoredRun {
    pub folder: RunFolder,
    pub growth: BTreeMap<TipKey, TipRow>,
    pub histories: BTreeMap<TipKey, History>,
    /// The steps with K.
    pub kept: Kept,
}

impl StoredRun {
    /// The finished steps of the run in `folder`.
    ///
    /// Errors: not a run folder; a file of it is damaged; the system refuses.
    pub(super) fn read(folder: &Path) -> Result<Self, OutputError> {
        let case = stored_case(folder)?.unwrap_or_default();
        let sif = Case::parse(&case, "", folder).map_or(Kept::All, |case| case.output.sif);
        if sif == Kept::None {
            return Err(OutputError::NoSif { folder: folder.to_path_buf() });
        }
        for file in [CASE_FILE, SUMMARY_FILE, SifRow::FILE, TipRow::FILE] {
            if !folder.join(file).is_file() {
                return Err(OutputError::NotARun { folder: folder.to_path_buf(), file });
            }
        }
        let folder = RunFolder::open(folder)?;
        let (histories, growth) = (folder.histories(folder.summary.steps_recorded)?, folder.growth()?);
        let histories: BTreeMap<TipKey, History> =
            histories.into_iter().map(|h| ((h.step, h.crack, h.tip), h)).collect();
        let growth = growth.into_iter().map(|row| ((row.step, row.crack, row.tip), row));
        Ok(Self { growth: growth.collect(), histories, kept: sif, folder })
    }

    pub(super) fn summary(&self) -> &Summary {
        &self.folder.summary
    }

    pub(super) fn label(&self) -> RunLabel {
        let summary = self.summary();
        RunLabel {
            folder: self.folder.path.clone(),
            engine: summary.engine,
            contact: summary.contact,
            boundary: summary.boundary,
            half_width_mm: summary.half_width_mm,
            steps_recorded: summary.steps_recorded,
            stop: summary.stop,
            load_cycles: summary.load_cycles,
            wall_s: summary.wall_s,
            million_gross_tonnes: summary.million_gross_tonnes,
            failure_mgt: summary.decision.as_ref().and_then(|decision| decision.failure.mgt),
            verdict: summary.verdict.as_ref().map(|verdict| verdict.level),
            interval_mgt: summary
                .decision
                .as_ref()
                .and_then(|decision| Some(decision.risk.act_on?.interval_mgt)),
            near_over_a: self.near_over_a(),
        }
    }

    fn near_over_a(&self) -> Option<[f64; 2]> {
        let summary = self.summary();
        let origin =
            summary.cracks.first().and_then(|crack| crack.initial_points_mm.first()).map_or(0.0, |p| p[0]);
        let [from, to] = summary.passage_mm?.map(|xc| (xc - origin) / summary.half_width_mm);
        Some([from.min(to), from.max(to)])
    }

    /// K of a tip over the stabilised passage; none in a step whose K the run does not keep.
    ///
    /// Errors: the table lacks a step that it should have.
    pub(super) fn history(&self, key: TipKey) -> Result<Option<&History>, OutputError> {
        let history = self.histories.get(&key);
        if history.is_some() || self.kept != Kept::All {
            return Ok(history);
        }
        let (step, crack, tip) = key;
        let (growth, sif) = (TipRow::FILE, self.folder.path.join(SifRow::FILE));
        let reason = format!("has no row of step {step}, crack {crack}, tip {tip}, which {growth} has");
        Err(OutputError::damaged(&sif, reason))
    }
}
