//! Verification of a folder of any kind, and of a study with all its runs.

use crate::csv::Table;
use crate::disk::FolderLock;
use crate::disk::files::{
    CASE_FILE, CHECKPOINT_FILE, COMPARE_FILE, PLAN_FILE, RUN_LOG_FILE, SHAKEDOWN_FILE, SUMMARY_FILE,
};
use crate::error::OutputError;
use crate::run_folder::{Extent, Verification, same_bytes};
use crate::study::{StudyFolder, StudySummaryRow};
use std::path::Path;

/// Compares the files in `folder` with the checksums that were stored with them: of a run, a
/// stabilised plastic state, a comparison, or a study with all its runs. Plots and reports are not
/// among them: `railcrack report` builds these anew.
///
/// Errors: the folder holds no such results, or is being computed; the system refuses.
pub fn verify(folder: &Path) -> Result<Verification, OutputError> {
    let mut found = Verification::default();
    let has = |file: &str| folder.join(file).is_file();
    if !folder.is_dir() {
        return Err(OutputError::NoFolder { folder: folder.to_path_buf() });
    }
    if FolderLock::is_taken(folder) {
        drop(FolderLock::take(folder)?);
    }
    if has(PLAN_FILE) {
        verify_study(&mut found, folder)?;
    } else if has(COMPARE_FILE) {
        found.documented(folder, COMPARE_FILE)?;
    } else if has(SHAKEDOWN_FILE) {
        found.documented(folder, SHAKEDOWN_FILE)?;
    } else if [SUMMARY_FILE, CHECKPOINT_FILE, RUN_LOG_FILE].into_iter().any(has) {
        found.run(folder, Extent::All)?;
    } else {
        return Err(OutputError::NothingToReport { folder: folder.to_path_buf() });
    }
    Ok(found)
}

/// The plan, every run, and the table of them.
fn verify_study(found: &mut Verification, folder: &Path) -> Result<(), OutputError> {
    found.document(folder, PLAN_FILE)?;
    let study = StudyFolder::open(folder)?;
    let mut over = true;
    let packed = study.packed()?;
    for run in &study.plan().runs {
        // A damaged record counts as missing.
        if packed.has(run.number) {
            found.files += 1;
            continue;
        }
        let of_run = study.run_folder(run);
        if FolderLock::is_taken(&of_run) {
            found.notes.push(format!("{}: is being computed", of_run.display()));
        } else if of_run.join(CASE_FILE).is_file() {
            found.run(&of_run, Extent::All)?;
        } else {
            found.notes.push(format!("{}: has not begun", of_run.display()));
        }
        over &= study.outcome(run).is_ok_and(|outcome| outcome.is_some());
    }
    if over && found.damages.is_empty() {
        let path = folder.join(StudySummaryRow::FILE);
        let results = study.read_results()?.table(study.plan())?;
        found.answer(same_bytes(&path, &results))?;
    }
    Ok(())
}
