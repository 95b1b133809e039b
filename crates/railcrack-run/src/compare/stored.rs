//! A run as its folder has it.

use crate::csv::{GROWTH_FILE, SIF_FILE, TipRow, read_growth};
use crate::folder::{CASE_FILE, SUMMARY_FILE, read_if_there, stored_case};
use crate::histories::{History, read_histories};
use crate::{OutputError, Summary};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Step, crack and tip, as in the tables.
pub(super) type TipKey = (usize, usize, usize);

/// How a run is told from the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunLabel {
    /// The run folder.
    pub folder: PathBuf,
    /// `xfem` or `dislocation`.
    pub engine: String,
    /// `latin` or `newton`.
    pub contact: String,
    /// Boundary of the rail: `half-plane` or `block`.
    pub boundary: String,
    /// Half-width a of the wheel contact, mm.
    pub half_width_mm: f64,
    /// Finished steps, the initial geometry counted.
    pub steps_recorded: usize,
    /// Why the run ended; null where it has not.
    pub stop: Option<String>,
    /// Load cycles at the start of the last finished step.
    pub load_cycles: f64,
    /// Wall time, seconds.
    pub wall_s: f64,
}

/// Everything of a run that is compared.
#[derive(Debug)]
pub(super) struct StoredRun {
    pub folder: PathBuf,
    pub case: String,
    pub summary: Summary,
    pub growth: BTreeMap<TipKey, TipRow>,
    pub histories: BTreeMap<TipKey, History>,
}

impl StoredRun {
    /// The finished steps of the run in `folder`.
    ///
    /// Errors: not a run folder; a file of it is damaged; the system refuses.
    pub(super) fn read(folder: &Path) -> Result<Self, OutputError> {
        for file in [CASE_FILE, SUMMARY_FILE, SIF_FILE, GROWTH_FILE] {
            if !folder.join(file).is_file() {
                return Err(OutputError::NotARun { folder: folder.to_path_buf(), file });
            }
        }
        let path = folder.join(SUMMARY_FILE);
        let text = read_if_there(&path)?.unwrap_or_default();
        let summary: Summary = serde_json::from_slice(&text)
            .map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        let histories = read_histories(folder, |step| step < summary.steps_recorded)?;
        let growth = read_growth(folder, summary.steps_recorded)?;
        Ok(Self {
            folder: folder.to_path_buf(),
            case: stored_case(folder)?.unwrap_or_default(),
            growth: growth.into_iter().map(|row| ((row.step, row.crack, row.tip), row)).collect(),
            histories: histories.into_iter().map(|h| ((h.step, h.crack, h.tip), h)).collect(),
            summary,
        })
    }

    pub(super) fn label(&self) -> RunLabel {
        let summary = &self.summary;
        RunLabel {
            folder: self.folder.clone(),
            engine: summary.engine.clone(),
            contact: summary.contact.clone(),
            boundary: summary.boundary.clone(),
            half_width_mm: summary.half_width_mm,
            steps_recorded: summary.steps_recorded,
            stop: summary.stop.clone(),
            load_cycles: summary.load_cycles,
            wall_s: summary.wall_s,
        }
    }

    /// K of a tip over the stabilised passage.
    pub(super) fn history(&self, key: TipKey) -> Result<&History, OutputError> {
        self.histories.get(&key).ok_or_else(|| {
            let (step, crack, tip) = key;
            let reason =
                format!("has no row of step {step}, crack {crack}, tip {tip}, which {GROWTH_FILE} has");
            OutputError::damaged(&self.folder.join(SIF_FILE), reason)
        })
    }
}
