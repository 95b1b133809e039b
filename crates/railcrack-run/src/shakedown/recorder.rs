//! Recorder of the stabilised plastic state: passages as they finish, the rest at the end.

use super::document::ShakedownSummary;
use super::fields;
use super::results::ShakedownResults;
use super::tables::{LayerRow, PassRow, SectionRow};
use crate::csv::{CsvFile, Rows, Table, header, whole};
use crate::disk::files::{CASE_FILE, CYCLE_FILE, PLASTIC_FILE, SECTION_FILE, SHAKEDOWN_FILE};
use crate::disk::{Durability, checksums, replace_file, write_json, write_sums};
use crate::error::OutputError;
use crate::run_folder::{CaseFiles, Existing, begin};
use railcrack::shakedown::PassRecord;
use railcrack_vtu::write_vtu;
use std::path::{Path, PathBuf};

/// A folder being written.
#[derive(Debug)]
pub(crate) struct ShakedownRecorder {
    folder: PathBuf,
    passes: CsvFile,
}

impl ShakedownRecorder {
    /// Begins the folder, which is entered, with the case.
    ///
    /// Errors: the system refuses.
    pub fn start(folder: &Path, case: &CaseFiles) -> Result<Self, OutputError> {
        begin(folder, case, Existing::Entered)?;
        let passes = passes_of(folder)?;
        Ok(Self { folder: folder.to_path_buf(), passes })
    }

    /// Appends a passage. The first one begins the table anew: a computation that needs more layers
    /// starts again.
    ///
    /// Errors: a number that is not finite; the system refuses.
    pub fn pass(&mut self, pass: &PassRecord) -> Result<(), OutputError> {
        if pass.pass == 1 {
            self.passes = passes_of(&self.folder)?;
        }
        let mut row = Rows::default();
        PassRow::from(pass).put(&mut row);
        self.passes.append(row.text(PassRow::FILE)?)
    }

    /// Writes tables, fields, plots, report and summary.
    ///
    /// Errors: a number that is not finite; the system refuses.
    pub fn finish(&self, results: &ShakedownResults) -> Result<ShakedownSummary, OutputError> {
        let put = |name: &str, content: &[u8]| replace(&self.folder.join(name), content);
        put(LayerRow::FILE, &whole(LayerRow::of(&results.stabilised, &results.initiation))?)?;
        for (name, grid) in
            [(PLASTIC_FILE, fields::plastic_grid(results)), (CYCLE_FILE, fields::cycle_grid(results))]
        {
            let path = self.folder.join(name);
            write_vtu(&path, &grid)?;
        }
        let mut files = vec![CASE_FILE, PassRow::FILE, LayerRow::FILE, PLASTIC_FILE, CYCLE_FILE];
        if let Some(section) = &results.section {
            let rows = SectionRow::of(section);
            write_vtu(&self.folder.join(SECTION_FILE), &fields::section_grid(section, &rows))?;
            put(SectionRow::FILE, &whole(rows)?)?;
            files.extend([SectionRow::FILE, SECTION_FILE]);
        }
        let checksums = checksums(&self.folder, files)?;
        write_sums(&self.folder, &checksums)?;
        let summary = ShakedownSummary { checksums, ..ShakedownSummary::of(results) };
        write_json(&self.folder, SHAKEDOWN_FILE, &summary, Durability::Cached)?;
        Ok(summary)
    }
}

fn passes_of(folder: &Path) -> Result<CsvFile, OutputError> {
    CsvFile::create(&folder.join(PassRow::FILE), &header::<PassRow>(&[]))
}

fn replace(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    replace_file(path, content, Durability::Cached)
}
