//! What the report needs of a run folder.

use crate::direction::{Heading, heading};
use railcrack_run::compare::case_keys;
use railcrack_run::csv::TipRow;
use railcrack_run::{OutputError, Summary};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A run as its folder has it, without K and faces.
#[derive(Debug)]
pub(crate) struct RunFolder {
    pub path: PathBuf,
    /// Text of `case.toml`.
    pub case: String,
    /// Its keys with their values as written.
    keys: BTreeMap<String, String>,
    pub summary: Summary,
    /// In the order of the table: by step, crack, tip.
    pub growth: Vec<TipRow>,
    /// Depth (mm) and σ_xx (MPa) of the residual stress.
    pub residual: Vec<[f64; 2]>,
}

impl RunFolder {
    /// Errors: no run in the folder; a file of it is damaged; the system refuses.
    pub(crate) fn read(folder: &Path) -> Result<Self, OutputError> {
        let run = railcrack_run::RunFolder::open(folder)?;
        Ok(Self {
            keys: case_keys(&run.case_text, folder)?,
            growth: run.growth()?,
            residual: run.residual()?.iter().map(|row| [row.depth, row.stress.xx]).collect(),
            path: run.path,
            case: run.case_text,
            summary: run.summary,
        })
    }

    /// A number of the case; none where the case does not say it.
    pub(super) fn number(&self, key: &str) -> Option<f64> {
        self.keys.get(key)?.replace('_', "").parse().ok()
    }

    /// A word of the case; none where the case does not say it.
    pub(super) fn word(&self, key: &str) -> Option<&str> {
        Some(self.keys.get(key)?.trim_matches('"'))
    }

    /// Every number of a key of the cracks, in their order.
    pub(super) fn of_cracks(&self, key: &str) -> Vec<f64> {
        (1..).map_while(|i| self.number(&format!("crack[{i}].{key}"))).collect()
    }

    /// Load of an axle, t, where the case gives it.
    pub(super) fn axle_load(&self) -> Option<f64> {
        self.number("traffic.axle_load_t")
    }

    /// Peak pressure (MPa) of the contact: given, or that of the line load P′: p0 = 2 P′/(π a).
    pub(super) fn peak_pressure(&self) -> Option<f64> {
        let of_load = |load: f64| 2.0 * load / (std::f64::consts::PI * self.summary.half_width_mm);
        self.number("contact.peak_pressure_mpa")
            .or_else(|| self.number("contact.line_load_n_per_mm").map(of_load))
    }

    /// The rows of a tip, by step.
    pub(super) fn history(&self, crack: usize, tip: usize) -> impl Iterator<Item = &TipRow> {
        self.growth.iter().filter(move |row| (row.crack, row.tip) == (crack, tip))
    }

    /// The tips, as (crack, tip).
    pub(super) fn tips(&self) -> Vec<(usize, usize)> {
        self.growth.iter().filter(|row| row.step == 0).map(|row| (row.crack, row.tip)).collect()
    }

    /// Where the tip of `row`, its last one, is heading; none where its crack is a point.
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
