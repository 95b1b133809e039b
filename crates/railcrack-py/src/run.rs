//! Runs, in memory and in folders.

use crate::background::{Watch, compute};
use crate::columns;
use crate::errors::{bad_input, exception, output_error, run_error};
use crate::grid;
use crate::scratch::scratch_folder;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use railcrack_case::{FieldOutput, Output};
use railcrack_report::{Pages, rebuild_report};
use railcrack_run::csv::{Column, ColumnValues, StepBlocks, Table, columns_of};
use railcrack_run::simulation::{RunInMemory, Simulation};
use railcrack_run::{Existing, OutputError, Presentation, RunFolder, TablesOnly, field_grids};
use std::path::PathBuf;
use std::sync::Arc;
use tempfile::TempDir;

/// A run: computed here, or stored in a folder.
#[pyclass(module = "railcrack._railcrack", name = "Run", frozen)]
pub struct RunCore {
    source: Source,
}

enum Source {
    Memory {
        case: Arc<railcrack_case::Case>,
        run: Arc<RunInMemory>,
        /// Folder with the plastic state of a rolled rail.
        _scratch: TempDir,
    },
    Folder(Box<RunFolder>),
}

type TableColumns = Vec<(&'static Column, ColumnValues)>;

impl RunCore {
    pub(crate) fn computed(case: Arc<railcrack_case::Case>, run: RunInMemory, scratch: TempDir) -> Self {
        Self { source: Source::Memory { case, run: Arc::new(run), _scratch: scratch } }
    }

    /// The run in a form that can be continued; none for a stored run.
    pub(crate) fn in_memory(&self) -> Option<RunInMemory> {
        match &self.source {
            Source::Memory { run, .. } => Some(RunInMemory::clone(run)),
            Source::Folder(_) => None,
        }
    }

    fn table(&self, name: &str) -> Result<Option<TableColumns>, OutputError> {
        match &self.source {
            Source::Memory { run, .. } => of_memory(run, name).transpose(),
            Source::Folder(run) => of_folder(run, name).transpose(),
        }
    }
}

fn of_memory(run: &RunInMemory, name: &str) -> Option<Result<TableColumns, OutputError>> {
    let sections = run.sections();
    let sections = Some(sections.as_slice());
    Some(match name {
        "sif" => columns_of(run.sif_rows().map(Ok), sections),
        "growth" => columns_of(run.growth_rows().map(Ok), sections),
        "faces" => columns_of(run.face_rows().map(Ok), sections),
        "residual" => columns_of(run.residual().iter().copied().map(Ok), sections),
        _ => return None,
    })
}

fn of_folder(run: &RunFolder, name: &str) -> Option<Result<TableColumns, OutputError>> {
    Some(match name {
        "sif" => run.sif().and_then(by_step),
        "growth" => run.growth().and_then(|rows| columns_of(rows.into_iter().map(Ok), None)),
        "faces" => run.faces().and_then(by_step),
        "residual" => run.residual().and_then(|rows| columns_of(rows.into_iter().map(Ok), None)),
        _ => return None,
    })
}

fn by_step<T: Table>(blocks: StepBlocks<T>) -> Result<TableColumns, OutputError> {
    let mut rows = Vec::new();
    for block in blocks {
        for row in block?.rows() {
            rows.push(row?);
        }
    }
    columns_of(rows.into_iter().map(Ok), None)
}

#[pymethods]
impl RunCore {
    /// The run in the folder `path`.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let run = RunFolder::open(&path).map_err(|error| output_error(py, &error))?;
        Ok(Self { source: Source::Folder(Box::new(run)) })
    }

    /// The case with all defaults filled in.
    fn case_toml(&self) -> String {
        match &self.source {
            Source::Memory { case, .. } => case.to_toml(),
            Source::Folder(run) => run.case_text.clone(),
        }
    }

    /// `summary.json`.
    fn summary_json(&self, py: Python<'_>) -> PyResult<String> {
        let text = match &self.source {
            Source::Memory { run, .. } => serde_json::to_string(&run.summary()),
            Source::Folder(run) => serde_json::to_string(&run.summary),
        };
        text.map_err(|error| exception(py, "FolderError", (error.to_string(),)))
    }

    /// The table `sif`, `growth`, `faces` or `residual`, column by column.
    fn columns<'py>(&self, py: Python<'py>, table: &str) -> PyResult<Bound<'py, PyDict>> {
        let read = py.detach(|| self.table(table)).map_err(|error| output_error(py, &error))?;
        match read {
            Some(table) => columns::to_numpy(py, table),
            None => Err(bad_input(py, format!("table \"{table}\": must be sif, growth, faces or residual"))),
        }
    }

    /// Writes the run folder, with plots and report where `pages` are wanted.
    fn save(&self, py: Python<'_>, folder: PathBuf, replace: bool, pages: bool) -> PyResult<()> {
        let Source::Memory { run, .. } = &self.source else {
            return Err(bad_input(py, "the run is already stored in a folder"));
        };
        let presentation: &dyn Presentation = if pages { &Pages } else { &TablesOnly };
        let existing = if replace { Existing::Replace } else { Existing::Refuse };
        let saved = py.detach(|| run.save(&folder, run.output(), existing, presentation));
        saved.map(drop).map_err(|error| output_error(py, &error))
    }

    /// Writes plots and report to `folder`: with the whole run folder for a run in memory, in a
    /// copy of it for a stored run.
    fn report(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        let made = py.detach(|| match &self.source {
            Source::Memory { run, .. } => run.save(&folder, Output::ALL, Existing::Replace, &Pages).map(drop),
            Source::Folder(_) => rebuild_report(&folder).map(drop),
        });
        made.map_err(|error| output_error(py, &error))
    }

    /// Steps and positions (from 1) of the fields that were stored, with their files; empty in
    /// memory.
    fn stored_fields(&self, py: Python<'_>) -> PyResult<Vec<(usize, usize, PathBuf)>> {
        let Source::Folder(run) = &self.source else { return Ok(Vec::new()) };
        let files = run.fields().map_err(|error| output_error(py, &error))?;
        Ok(files.into_iter().map(|file| (file.step, file.position, file.path)).collect())
    }

    /// The field file `path`.
    #[staticmethod]
    fn read_grid<'py>(py: Python<'py>, path: PathBuf) -> PyResult<Bound<'py, PyDict>> {
        let read = py.detach(|| railcrack_vtu::read_vtu(&path));
        let grid = read.map_err(|error| exception(py, "FolderError", (error.to_string(),)))?;
        grid::to_numpy(py, &grid)
    }

    /// The field in step `step` with the wheel at `over_a` (x_c/a), computed again; none if the
    /// state before that step is not available, or if the engine computes no fields.
    fn fields_at<'py>(
        &self,
        py: Python<'py>,
        step: usize,
        over_a: f64,
        threads: Option<usize>,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let (case, state) = match &self.source {
            Source::Memory { case, run, .. } => {
                (railcrack_case::Case::clone(case), run.state_before(step).cloned())
            }
            Source::Folder(run) => (run.case().map_err(|error| output_error(py, &error))?, None),
        };
        if step > 0 && state.is_none() {
            return Ok(None);
        }
        let (watch, told) = Watch::new();
        let observer = Arc::clone(&watch);
        let scratch = scratch_folder()?;
        let over = compute(py, threads, (watch, told), None, move || {
            let mut case = case;
            case.fields = FieldOutput { over_a: vec![over_a], every: 1 };
            let simulation = Simulation::new(&case).observed_by(observer.as_ref());
            let record = simulation.one_step(scratch.path(), state)?;
            Ok(record.and_then(|record| field_grids(&record).next()).map(|(.., grid)| grid))
        })?;
        if let Some(signal) = over.signal {
            return Err(signal);
        }
        let grid = over.result.map_err(|error| run_error(py, &error))?;
        grid.map(|grid| grid::to_numpy(py, &grid)).transpose()
    }
}
