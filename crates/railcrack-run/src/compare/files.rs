//! The folder of a comparison.

use super::comparison::Comparison;
use super::json::json_text;
use super::tables::{PositionRow, TipComparison};
use crate::csv::{Table, whole};
use crate::disk::files::{COMPARE_FILE, REPORT_FILE};
use crate::disk::{Durability, checksums, replace_file, write_sums};
use crate::error::OutputError;
use crate::run_folder::{ResultFolder, ResultKind, WithRun};
use railcrack::words::Choice;
use std::path::Path;

/// Plot of K in the first common growth step.
pub const FIRST_STEP: &str = "compare-sif-first.svg";
/// Plot of K in the last common growth step.
pub const LAST_STEP: &str = "compare-sif-last.svg";
/// Plot of the paths.
pub const PATHS: &str = "compare-paths.svg";

/// The files of a comparison.
pub static COMPARISON: ResultKind = ResultKind {
    files: &[TipComparison::FILE, PositionRow::FILE, COMPARE_FILE, FIRST_STEP, LAST_STEP, PATHS, REPORT_FILE],
    folders: &[],
    run: WithRun::No,
};

impl Comparison {
    /// Writes tables, `compare.json`, and what `draw` draws of these, to the `folder` that is
    /// entered for a [`COMPARISON`]. `tolerance`: the accepted difference of K in `compare.json`,
    /// in per cent of the largest |K| of the case.
    ///
    /// Errors: the system refuses.
    pub fn write(
        &self,
        folder: ResultFolder,
        tolerance: Option<f64>,
        draw: impl FnOnce(&Path) -> Result<(), OutputError>,
    ) -> Result<(), OutputError> {
        folder.mark()?;
        let written = self.write_to(folder.path(), tolerance).and_then(|()| draw(folder.path()));
        folder.end(written, |_| false)
    }

    fn write_to(&self, folder: &Path, tolerance: Option<f64>) -> Result<(), OutputError> {
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
