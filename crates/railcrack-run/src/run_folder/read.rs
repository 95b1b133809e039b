//! The results of a run, read back from its folder.

use super::history::History;
use super::stored_case::{read_case, stored_case};
use crate::csv::{FaceRow, ResidualRow, SifRow, StepBlocks, Table, TipRow, read_table};
use crate::disk::files::{CASE_FILE, SUMMARY_FILE};
use crate::disk::{read_if_there, read_json};
use crate::error::OutputError;
use crate::fields::{FieldFile, field_files};
use crate::summary::Summary;
use railcrack_case::Case;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Files of a run by their names.
pub(crate) type RunFiles = BTreeMap<String, String>;

/// The folder of a run. Summary and case are read when it is opened, tables and fields when they
/// are asked for; only finished growth steps count.
///
/// ```
/// # use railcrack_run::simulation::{RunEntry, Simulation};
/// # let folder = std::env::temp_dir().join(format!("railcrack-open-{}", std::process::id()));
/// # let text = "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.025\n\
/// #     [[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.5\n\
/// #     [solver]\nengine = \"dislocation\"\n[growth]\nsteps = 1\n";
/// # let case = railcrack_case::Case::parse(text, "case.toml", "".as_ref())?;
/// # Simulation::new(&case).run_in(&folder, RunEntry::Replace)?;
/// use railcrack_run::RunFolder;
///
/// let run = RunFolder::open(&folder)?;
/// assert_eq!(run.summary.steps, 1);
/// assert_eq!(run.case()?.half_width(), 6.75);
/// for tip in run.growth()? {
///     println!("step {}: {:.3} mm, {:.2} MPa√m", tip.step, tip.length, tip.delta_keq);
/// }
/// for step in run.faces()? {
///     let open = step?.rows().filter(|point| point.as_ref().is_ok_and(|point| point.opening >
/// 0.0)).count();     assert!(open > 0);
/// }
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RunFolder {
    /// The folder.
    pub path: PathBuf,
    /// `summary.json`.
    pub summary: Summary,
    /// Text of `case.toml`.
    pub case_text: String,
    /// Its files, where they are packed with those of other runs.
    packed: Option<Arc<RunFiles>>,
}

impl RunFolder {
    /// Opens the folder `path`.
    ///
    /// Errors: no run in it; summary or case are damaged; the system refuses.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        Ok(Self {
            summary: read_json(path, SUMMARY_FILE)?,
            case_text: stored_case(path)?.unwrap_or_default(),
            path: path.to_path_buf(),
            packed: None,
        })
    }

    /// The run with these `files`, which would stand in the folder `path`.
    ///
    /// Errors: its summary is damaged.
    pub(crate) fn of_packed(path: &Path, files: RunFiles) -> Result<Self, OutputError> {
        let summary = files.get(SUMMARY_FILE).map_or("", String::as_str);
        let damaged =
            |reason: serde_json::Error| OutputError::damaged(&path.join(SUMMARY_FILE), reason.to_string());
        Ok(Self {
            summary: serde_json::from_str(summary).map_err(damaged)?,
            case_text: files.get(CASE_FILE).cloned().unwrap_or_default(),
            path: path.to_path_buf(),
            packed: Some(Arc::new(files)),
        })
    }

    /// The text of a table; none where the run has no such table.
    ///
    /// Errors: the system refuses.
    pub(crate) fn table_text(&self, file: &str) -> Result<Option<String>, OutputError> {
        match &self.packed {
            Some(files) => Ok(files.get(file).cloned()),
            None => {
                let path = self.path.join(file);
                let text = read_if_there(&path)?.map(String::from_utf8).transpose();
                text.map_err(|_| OutputError::damaged(&path, "is not UTF-8 text"))
            }
        }
    }

    /// Whether the run has the table `T`.
    pub(crate) fn has<T: Table>(&self) -> bool {
        match &self.packed {
            Some(files) => files.contains_key(T::FILE),
            None => self.path.join(T::FILE).is_file(),
        }
    }

    /// The case, with the representatives of its table of wheels that the run has computed.
    ///
    /// Errors: there is none, or this version does not accept it.
    pub fn case(&self) -> Result<Case, OutputError> {
        read_case(&self.path)
    }

    /// `growth.csv`: every tip at every growth step.
    ///
    /// Errors: the table is damaged; the system refuses.
    pub fn growth(&self) -> Result<Vec<TipRow>, OutputError> {
        self.by_step()?.read()
    }

    /// `sif.csv`, step by step: K at every wheel position.
    ///
    /// Errors: the table is damaged; the system refuses.
    pub fn sif(&self) -> Result<StepBlocks<SifRow>, OutputError> {
        self.by_step()
    }

    /// `faces.csv`, step by step: the face points at every wheel position.
    ///
    /// Errors: the table is damaged; the system refuses.
    pub fn faces(&self) -> Result<StepBlocks<FaceRow>, OutputError> {
        self.by_step()
    }

    fn by_step<T: Table>(&self) -> Result<StepBlocks<T>, OutputError> {
        self.blocks(0..self.summary.steps_recorded)
    }

    fn blocks<T: Table>(&self, steps: Range<usize>) -> Result<StepBlocks<T>, OutputError> {
        match &self.packed {
            Some(files) => {
                StepBlocks::of_text(&self.path, files.get(T::FILE).cloned().unwrap_or_default(), steps)
            }
            None => StepBlocks::open(&self.path, steps),
        }
    }

    /// K of every tip over the stabilised passages of the first `steps` growth steps.
    ///
    /// Errors: the table is damaged; the system refuses.
    pub fn histories(&self, steps: usize) -> Result<Vec<History>, OutputError> {
        let mut histories = Vec::new();
        for block in self.blocks::<SifRow>(0..steps.min(self.summary.steps_recorded))? {
            histories.append(&mut History::of_step(block?.rows())?);
        }
        Ok(histories)
    }

    /// `residual.csv`, from the surface down; empty if the rail carries no residual stress.
    ///
    /// Errors: the table is damaged; the system refuses.
    pub fn residual(&self) -> Result<Vec<ResidualRow>, OutputError> {
        let is_there = self.path.join(ResidualRow::FILE).is_file();
        if is_there { read_table(&self.path) } else { Ok(Vec::new()) }
    }

    /// The field files of finished growth steps, in their order.
    ///
    /// Errors: the system refuses.
    pub fn fields(&self) -> Result<Vec<FieldFile>, OutputError> {
        field_files(&self.path, self.summary.steps_recorded)
    }
}
