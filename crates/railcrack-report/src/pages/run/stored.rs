//! What the report needs of a run folder.

use crate::direction::{Heading, heading};
use railcrack_run::compare::case_keys;
use railcrack_run::csv::{RESIDUAL_FILE, TipRow, read_growth};
use railcrack_run::folder::{SUMMARY_FILE, read_if_there, stored_case};
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
        let path = folder.join(SUMMARY_FILE);
        let Some(text) = read_if_there(&path)? else {
            return Err(OutputError::NotARun { folder: folder.to_path_buf(), file: SUMMARY_FILE });
        };
        let summary: Summary = serde_json::from_slice(&text)
            .map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        let case = stored_case(folder)?.unwrap_or_default();
        Ok(Self {
            path: folder.to_path_buf(),
            keys: case_keys(&case, folder)?,
            case,
            growth: read_growth(folder, summary.steps_recorded)?,
            residual: read_residual(folder)?,
            summary,
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

/// Depth and σ_xx of `residual.csv`; nothing where there is no such file.
fn read_residual(folder: &Path) -> Result<Vec<[f64; 2]>, OutputError> {
    let path = folder.join(RESIDUAL_FILE);
    if !path.is_file() {
        return Ok(Vec::new());
    }
    railcrack_run::csv::read_columns(&path, &["depth_mm", "sxx_mpa"])
}
