//! `runs.parquet`, `growth.parquet` and `sif.parquet` of a study.

use super::csv_text::{append, kind_of, stabilised};
use super::folder::StudyFolder;
use super::results::StudyResults;
use super::table::StudySummaryRow;
use crate::csv::{Column, SifRow, Table, TipRow, column_names};
use crate::disk::files::{GROWTH_TABLE, RUNS_TABLE, SIF_TABLE};
use crate::disk::read_if_there;
use crate::error::OutputError;
use crate::parquet::{ColumnKind, ParquetFile, check};
use railcrack_case::{Kind, SECTIONS};

impl StudyFolder {
    /// Writes the tables of all runs. Those of K have the stabilised passages of the steps whose K
    /// is kept.
    pub(crate) fn write_tables(&self, results: &StudyResults) -> Result<(), OutputError> {
        let (columns, text) = self.runs_table(results)?;
        let mut runs = ParquetFile::new(columns);
        append(&mut runs, &[], &text);
        let study = self.plan().checksum();
        self.put(RUNS_TABLE, &runs.finish(&study))?;
        let packed = self.packed()?;
        let (mut growth, mut sif) = (None, None);
        for (planned, row) in self.plan().runs.iter().zip(&results.rows) {
            if row.summary.is_none() {
                continue;
            }
            // A run that is gone is packed by another process, which writes the tables after this
            // one.
            let Ok(run) = self.run_in(planned, &packed) else { continue };
            let number = row.number.to_string();
            if let Some(text) = run.table_text(TipRow::FILE)? {
                add::<TipRow>(&mut growth, &number, &text);
            }
            if let Some(text) = run.table_text(SifRow::FILE)? {
                add::<SifRow>(&mut sif, &number, &stabilised(&text));
            }
        }
        for (file, table) in [(GROWTH_TABLE, growth), (SIF_TABLE, sif)] {
            match table {
                Some(table) => self.put(file, &table.finish(&study))?,
                None => self.take_away(file)?,
            }
        }
        Ok(())
    }

    /// Checks a Parquet table.
    ///
    /// Errors: it is not there, damaged, or that of another study; the system refuses.
    pub(crate) fn check_table(&self, file: &str) -> Result<(), OutputError> {
        let path = self.path().join(file);
        let answer = match read_if_there(&path)? {
            Some(content) => check(&content, &self.plan().checksum()),
            None => Err("is not there"),
        };
        answer.map_err(|reason| OutputError::damaged(&path, reason))
    }

    /// The Parquet tables that the study has with these results.
    ///
    /// Errors: the system refuses.
    pub(crate) fn tables_with(&self, results: &StudyResults) -> Result<Vec<&'static str>, OutputError> {
        let packed = self.packed()?;
        let mut tables = [(RUNS_TABLE, true), (GROWTH_TABLE, false), (SIF_TABLE, false)];
        for (planned, row) in self.plan().runs.iter().zip(&results.rows) {
            if row.summary.is_some() {
                let run = self.run_in(planned, &packed)?;
                tables[1].1 |= run.has::<TipRow>();
                tables[2].1 |= run.has::<SifRow>();
            }
        }
        Ok(tables.into_iter().filter(|(_, is_made)| *is_made).map(|(file, _)| file).collect())
    }

    /// Columns and rows of the table of runs: those of `summary.csv`, the keys with their kinds.
    fn runs_table(&self, results: &StudyResults) -> Result<(Vec<(String, ColumnKind)>, String), OutputError> {
        let keys = self.plan().axes.iter().flat_map(|axis| &axis.keys);
        let of_run = ["run", "folder"].map(|name| (name.to_owned(), kind_of(name)));
        let keys = keys.map(|key| (key.key.clone(), kind_of_key(&key.key)));
        let own = column_names::<StudySummaryRow>(&[]).into_iter();
        let columns = of_run.into_iter().chain(keys).chain(own.map(|name| (name.to_owned(), kind_of(name))));
        let text = String::from_utf8_lossy(&results.table(self.plan())?).into_owned();
        Ok((columns.collect(), text))
    }
}

/// Appends the rows of a run to `table`, which begins with the first of them.
fn add<T: Table>(table: &mut Option<ParquetFile>, run: &str, text: &str) {
    let begin = || {
        let header = text.lines().find(|line| !line.starts_with('#')).unwrap_or_default();
        let there = |column: &&Column| header.split(',').any(|name| name == column.name);
        let own =
            T::COLUMNS.iter().filter(there).map(|column| (column.name.to_owned(), kind_of(column.name)));
        ParquetFile::new(std::iter::once(("run".to_owned(), ColumnKind::Integer)).chain(own).collect())
    };
    append(table.get_or_insert_with(begin), &[run], text);
}

/// The kind of a key of the case file: `contact.friction`, `crack[1].angle_deg`.
fn kind_of_key(key: &str) -> ColumnKind {
    let (section, name) = key.rsplit_once('.').unwrap_or(("", key));
    let section = section.split('[').next().unwrap_or(section);
    let declared = SECTIONS.iter().find(|other| other.name == section).and_then(|section| section.key(name));
    match declared.map(|key| key.kind) {
        Some(Kind::Number { .. }) => ColumnKind::Number,
        Some(Kind::Integer { .. }) => ColumnKind::Integer,
        _ => ColumnKind::Text,
    }
}
