//! The folder of a comparison.

use super::comparison::Comparison;
use super::json::json_text;
use super::tables::{PositionRow, TipComparison};
use crate::csv::{Table, whole};
use crate::disk::files::{COMPARE_FILE, REPORT_FILE, SUMS_FILE};
use crate::disk::{Durability, checksums, replace_file, write_sums};
use crate::error::OutputError;
use crate::run_folder::Existing;
use railcrack::words::Choice;
use std::path::Path;

/// Plot of K in the first common growth step.
pub const FIRST_STEP: &str = "compare-sif-first.svg";
/// Plot of K in the last common growth step.
pub const LAST_STEP: &str = "compare-sif-last.svg";
/// Plot of the paths.
pub const PATHS: &str = "compare-paths.svg";

const FILES: [&str; 8] = [
    TipComparison::FILE,
    PositionRow::FILE,
    COMPARE_FILE,
    SUMS_FILE,
    FIRST_STEP,
    LAST_STEP,
    PATHS,
    REPORT_FILE,
];

impl Comparison {
    /// Writes tables, `compare.json`, plots and report to `folder`, which is created where it does
    /// not exist. `tolerance`: the accepted difference of K in `compare.json`, in per cent of the
    /// largest |K| of the case.
    ///
    /// Errors: the folder holds a comparison and `existing` says to leave it alone; the system
    /// refuses.
    pub fn write(
        &self,
        folder: &Path,
        existing: Existing,
        tolerance: Option<f64>,
    ) -> Result<(), OutputError> {
        let there = FILES.into_iter().find(|file| folder.join(file).exists());
        if let (Existing::Refuse, Some(file)) = (existing, there) {
            return Err(OutputError::HoldsComparison { folder: folder.to_path_buf(), file });
        }
        std::fs::create_dir_all(folder).map_err(OutputError::io("create", folder))?;
        let put = |file: &str, content: &[u8]| replace_file(&folder.join(file), content, Durability::Cached);
        put(TipComparison::FILE, &whole(self.tips.iter().copied())?)?;
        put(PositionRow::FILE, &whole(self.tips.iter().zip(&self.aligned).flat_map(PositionRow::of_tip))?)?;
        let checksums = checksums(folder, [TipComparison::FILE, PositionRow::FILE])?;
        write_sums(folder, &checksums)?;
        put(COMPARE_FILE, json_text(self, tolerance, &checksums).as_bytes())?;
        Ok(())
    }

    /// Names of the runs in plots and texts: folder and engine.
    pub fn names(&self) -> [String; 2] {
        let [first, second] = self.runs.each_ref().map(|run| {
            run.folder.file_name().map_or_else(|| ".".to_owned(), |name| name.to_string_lossy().into_owned())
        });
        let names = if first == second {
            self.runs.each_ref().map(|run| run.folder.display().to_string())
        } else {
            [first, second]
        };
        let [first, second] = names;
        [
            format!("{first} ({})", self.runs[0].engine.word()),
            format!("{second} ({})", self.runs[1].engine.word()),
        ]
    }
}
