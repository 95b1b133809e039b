//! The folder of plans, written and read back.

use super::document::PlanSummary;
use super::tables::PlanRow;
use crate::csv::{Table, whole};
use crate::disk::files::{CASE_FILE, PLANS_FILE};
use crate::disk::{Durability, checksums, read_json, replace_file, write_json, write_sums};
use crate::error::OutputError;
use crate::run_folder::{read_case, stored_case};
use railcrack_case::Case;
use std::path::{Path, PathBuf};

/// The results of `railcrack plan`, read back from their folder.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanFolder {
    /// The folder.
    pub path: PathBuf,
    /// Text of `case.toml`.
    pub case_text: String,
    /// `plan.json`.
    pub summary: PlanSummary,
}

impl PlanFolder {
    /// Opens the folder `path`.
    ///
    /// Errors: no plans in the folder; a file of it is damaged; the system refuses.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        Ok(Self {
            summary: read_json(path, PLANS_FILE)?,
            case_text: stored_case(path)?.unwrap_or_default(),
            path: path.to_path_buf(),
        })
    }

    /// The case.
    ///
    /// Errors: there is none, or this version does not accept it.
    pub fn case(&self) -> Result<Case, OutputError> {
        read_case(&self.path)
    }
}

/// Writes the table and `plan.json` to `folder`, which has the case; the summary with checksums.
///
/// Errors: a number that is not finite; the system refuses.
pub(crate) fn write_plan(folder: &Path, summary: PlanSummary) -> Result<PlanSummary, OutputError> {
    let rows = std::iter::once(&summary.without_grinding).chain(&summary.plans).map(PlanRow::from);
    replace_file(&folder.join(PlanRow::FILE), &whole(rows)?, Durability::Cached)?;
    let checksums = checksums(folder, [CASE_FILE, PlanRow::FILE])?;
    write_sums(folder, &checksums)?;
    let case_checksum = checksums.get(CASE_FILE).cloned().unwrap_or_default();
    let summary = PlanSummary { checksums, case_checksum, ..summary };
    write_json(folder, PLANS_FILE, &summary, Durability::Cached)?;
    Ok(summary)
}
