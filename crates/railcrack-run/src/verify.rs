//! Verification of a folder of any kind, and of a study with all its runs.

use crate::csv::Table;
use crate::disk::files::{
    CASE_FILE, CHECKPOINT_FILE, COMPARE_FILE, GROWTH_TABLE, PLAN_FILE, PLANS_FILE, POPULATION_FILE,
    RUN_LOG_FILE, RUNS_TABLE, SHAKEDOWN_FILE, SIF_TABLE, SUMMARY_FILE, SUMS_FILE,
};
use crate::disk::{FolderLock, read_if_there};
use crate::error::OutputError;
use crate::run_folder::{Extent, Verification, is_unfinished, same_bytes};
use crate::study::{StudyFolder, StudySummaryRow, listed_as_done};
use std::path::Path;

/// Compares the files in `folder` with the checksums that were stored with them: of a run, a
/// stabilised plastic state, a comparison, grinding plans, contact patches, a validation, or a
/// study with all its runs. Plots and reports are not among them: `railcrack report` builds these
/// anew.
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
    if is_unfinished(folder) {
        found.notes.push(format!("{}: the results are unfinished", folder.display()));
    }
    if has(PLAN_FILE) {
        verify_study(&mut found, folder)?;
    } else if has(COMPARE_FILE) {
        found.documented(folder, COMPARE_FILE)?;
    } else if has(PLANS_FILE) {
        found.documented(folder, PLANS_FILE)?;
    } else if has(SHAKEDOWN_FILE) {
        found.documented(folder, SHAKEDOWN_FILE)?;
    } else if [SUMMARY_FILE, CHECKPOINT_FILE, RUN_LOG_FILE].into_iter().any(has) {
        found.run(folder, Extent::All)?;
    } else if has(SUMS_FILE) {
        found.listed(folder)?;
    } else {
        return Err(OutputError::NothingToReport { folder: folder.to_path_buf() });
    }
    Ok(found)
}

/// The plan, every run, and the table of them.
fn verify_study(found: &mut Verification, folder: &Path) -> Result<(), OutputError> {
    found.document(folder, PLAN_FILE)?;
    if !found.damages.is_empty() {
        // Everything else is compared with the plan.
        return Ok(());
    }
    let study = StudyFolder::open(folder)?;
    found.answer(study.check_text())?;
    if folder.join(POPULATION_FILE).is_file() {
        found.document(folder, POPULATION_FILE)?;
    }
    let table = read_if_there(&folder.join(StudySummaryRow::FILE))?;
    let done = table.as_ref().map(|text| listed_as_done(&String::from_utf8_lossy(text))).unwrap_or_default();
    let mut over = true;
    let packed = study.packed()?;
    for flaw in packed.flaws() {
        found.answer(Err(OutputError::damaged(&flaw.file, &*flaw.reason)))?;
    }
    for run in &study.plan().runs {
        if packed.has(run.number) {
            found.answer(study.check_packed(run, &packed))?;
            continue;
        }
        let of_run = study.run_folder(run);
        if FolderLock::is_taken(&of_run) {
            found.notes.push(format!("{}: is being computed", of_run.display()));
        } else if of_run.join(CASE_FILE).is_file() {
            let damages = found.damages.len();
            found.run(&of_run, Extent::All)?;
            // Files that are whole may be those of another study.
            if found.damages.len() == damages
                && let Err(error) = study.check_case_of(run)
            {
                found.answer(Err(error))?;
            }
        } else if done.contains(&run.number) {
            let reason = format!("is not there, and {} lists it as done", StudySummaryRow::FILE);
            found.answer(Err(OutputError::damaged(&of_run, reason)))?;
        } else {
            found.notes.push(format!("{}: has not begun", of_run.display()));
        }
        over &= study.outcome(run).is_ok_and(|outcome| outcome.is_some());
    }
    let mut tables = [RUNS_TABLE, GROWTH_TABLE, SIF_TABLE].map(|file| (file, folder.join(file).is_file()));
    if over && found.damages.is_empty() {
        let results = study.read_results()?;
        found.answer(same_bytes(&folder.join(StudySummaryRow::FILE), &results.table(study.plan())?))?;
        let needed = study.tables_with(&results)?;
        tables.iter_mut().for_each(|(file, is_there)| *is_there |= needed.contains(file));
    }
    for (file, _) in tables.iter().filter(|(_, is_there)| *is_there) {
        match study.plan().text {
            Some(_) => found.answer(study.check_table(file))?,
            None => found.notes.push(format!("{file}: has no checksum (an older version wrote the study)")),
        }
    }
    Ok(())
}
