//! Studies: many cases, computed here or by several processes.

use crate::background::{Watch, check_threads, compute, detached};
use crate::case::CaseCore;
use crate::columns;
use crate::errors::{case_error, output_error, run_error, warn_of_damages};
use crate::scratch::reading;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use railcrack_case::Overrides;
use railcrack_report::Pages;
use railcrack_run::csv::columns_of;
use railcrack_run::simulation::{StudyComputation, case_files, study_plan};
use railcrack_run::study::{Entry, ExistingRuns, StudyPlan, StudySummaryRow};
use railcrack_run::summary::RunEnd;
use railcrack_run::{OutputError, Presentation, StudyFolder, TablesOnly};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A checked study.
#[pyclass(module = "railcrack._railcrack", name = "Study", frozen)]
pub struct StudyCore {
    study: Arc<railcrack_case::Study>,
}

/// Folder of each run; keys that vary, with the value of each run; the other columns.
type Results<'py> = (Vec<String>, Vec<(String, Vec<String>)>, Bound<'py, PyDict>);

/// Number of a failed run, its values, and the reason.
type Failed = (usize, String, String);

#[pymethods]
impl StudyCore {
    /// Parses the study in `text`, like [`Case::parse`].
    #[staticmethod]
    fn parse(
        py: Python<'_>,
        text: &str,
        name: &str,
        folder: PathBuf,
        files: Vec<(String, Vec<u8>)>,
    ) -> PyResult<Self> {
        let study = detached(py, || {
            reading(&folder, files, |folder| {
                railcrack_case::Study::parse_with(text, name, folder, &Overrides::default())
            })
        })??;
        Ok(Self { study: Arc::new(study.map_err(|errors| case_error(py, &errors))?) })
    }

    #[getter]
    fn title(&self) -> &str {
        &self.study.title
    }

    /// Number, values and folder of every run.
    #[getter]
    fn runs(&self) -> Vec<(usize, &str, &str)> {
        let runs = self.study.runs.iter();
        runs.map(|run| (run.number, run.label.as_str(), run.folder.as_str())).collect()
    }

    /// Keys that vary, with their values as text.
    #[getter]
    fn keys(&self) -> Vec<(String, Vec<String>)> {
        let plan = study_plan(&self.study, Vec::new());
        plan.axes.into_iter().flat_map(|axis| axis.keys).map(|key| (key.key, key.values)).collect()
    }

    /// The case of run `number`.
    fn case(&self, number: usize) -> Option<CaseCore> {
        let run = self.study.runs.iter().find(|run| run.number == number)?;
        Some(CaseCore { case: Arc::new(run.case.clone()) })
    }

    /// Opens the folder `out` to compute the runs `own`; returns the numbers of the remaining runs
    /// and of those that have failed permanently. `entry` is begin, of the whole study, resume or
    /// replace.
    fn enter(
        &self,
        py: Python<'_>,
        out: PathBuf,
        own: Vec<usize>,
        entry: &str,
    ) -> PyResult<(Vec<usize>, Vec<Failed>)> {
        let entry = match entry {
            "resume" => part(&own),
            "replace" => Entry { part: None, existing: ExistingRuns::Replace },
            _ => Entry { part: None, existing: ExistingRuns::Refuse },
        };
        let entered = py.detach(|| {
            let plan = study_plan(&self.study, Vec::new());
            let folder = folder_of(&self.study, plan, &out, &entry)?;
            let (waiting, failed) = folder.left_to_do(&self.study, &own)?;
            Ok((waiting, failed, folder.damages().to_vec()))
        });
        let (waiting, failed, damages) = entered.map_err(|error: OutputError| output_error(py, &error))?;
        warn_of_damages(py, &damages)?;
        let numbers = waiting.into_iter().map(|i| self.study.runs[i].number).collect();
        let failed = failed.into_iter().map(|run| (run.number, run.label, run.reason)).collect();
        Ok((numbers, failed))
    }

    /// Computes the runs `own` into the folder `out`, opened as a part of the study; returns the
    /// failed runs and whether it was interrupted. If the runs `travel`, each keeps its folder
    /// regardless of the study's settings.
    #[pyo3(signature = (out, own, pages, threads, tell, travel = false))]
    fn compute(
        &self,
        py: Python<'_>,
        out: PathBuf,
        own: Vec<usize>,
        pages: bool,
        threads: Option<usize>,
        tell: Option<&Bound<'_, PyAny>>,
        travel: bool,
    ) -> PyResult<(Vec<Failed>, bool)> {
        check_threads(py, threads)?;
        let (watch, told) = Watch::new();
        let (study, observer) = (Arc::clone(&self.study), Arc::clone(&watch));
        let plan = study_plan(&study, Vec::new());
        let plan = StudyPlan { run_folders: plan.run_folders || travel, ..plan };
        let threads =
            threads.or_else(|| std::thread::available_parallelism().ok().map(Into::into)).unwrap_or(1);
        // The computation has its own threads, one pool for each run.
        let over = compute(py, Some(1), (watch, told), tell, move || {
            let presentation: &dyn Presentation = if pages { &Pages } else { &TablesOnly };
            let folder = folder_of(&study, plan, &out, &part(&own))?;
            let (waiting, mut failed) = folder.left_to_do(&study, &own)?;
            let computation = StudyComputation {
                study: &study,
                folder: &folder,
                observer: observer.as_ref(),
                presentation,
            };
            if !waiting.is_empty() {
                failed.extend(computation.compute(&waiting, threads)?);
            }
            Ok(failed)
        })?;
        let failed = over.result.map_err(|error| run_error(py, &error))?;
        let failed = failed.into_iter().map(|run| (run.number, run.label, run.reason)).collect();
        Ok((failed, over.signal.is_some()))
    }

    /// Collects the results in the folder `out` and writes tables, plots and report of the study.
    fn gather(&self, py: Python<'_>, out: PathBuf) -> PyResult<()> {
        let written = detached(py, || StudyFolder::open(&out)?.write_results(&Pages))?;
        let results = written.map_err(|error| output_error(py, &error))?;
        warn_of_damages(py, &results.flaws)
    }

    /// Packs the finished runs among `numbers` in the folder `out`, if the study keeps no run
    /// folders.
    #[staticmethod]
    fn pack(py: Python<'_>, out: PathBuf, numbers: Vec<usize>) -> PyResult<()> {
        let packed = py.detach(|| {
            let folder = StudyFolder::open(&out)?;
            if folder.plan().run_folders {
                return Ok(());
            }
            for run in numbers.iter().filter_map(|number| folder.plan().runs.get(number.checked_sub(1)?)) {
                if let Some(outcome) = folder.outcome(run)?.filter(|outcome| outcome.end == RunEnd::Done) {
                    folder.settle(run, &outcome)?;
                }
            }
            Ok(())
        });
        packed.map_err(|error: OutputError| output_error(py, &error))
    }

    /// The folder of run `number` in the folder `out`, unpacked if necessary.
    #[staticmethod]
    fn run_folder(py: Python<'_>, out: PathBuf, number: usize) -> PyResult<PathBuf> {
        let found = py.detach(|| {
            let folder = StudyFolder::open(&out)?;
            match number.checked_sub(1).and_then(|i| folder.plan().runs.get(i)) {
                Some(run) => folder.unpacked(run),
                None => Ok(out.clone()),
            }
        });
        found.map_err(|error| output_error(py, &error))
    }

    /// The results in the folder `out` by columns: folder and values (as text) of each run, and the
    /// remaining columns of `summary.csv`.
    #[staticmethod]
    fn results<'py>(py: Python<'py>, out: PathBuf) -> PyResult<Results<'py>> {
        let read = detached(py, || {
            let folder = StudyFolder::open(&out)?;
            let results = folder.read_results()?;
            Ok((folder, results))
        })?;
        let (folder, results) = read.map_err(|error: OutputError| output_error(py, &error))?;
        let plan = folder.plan();
        let keys: Vec<String> =
            plan.axes.iter().flat_map(|axis| &axis.keys).map(|key| key.key.clone()).collect();
        let mut values: Vec<(String, Vec<String>)> = keys.into_iter().map(|key| (key, Vec::new())).collect();
        for run in &plan.runs {
            for ((_, values), (_, value)) in values.iter_mut().zip(plan.values_of(run)) {
                values.push(value.to_owned());
            }
        }
        let folders = plan.runs.iter().map(|run| run.folder.clone()).collect();
        let rows = results.rows.iter().map(|row| Ok::<_, OutputError>(StudySummaryRow::from(row)));
        let columns = columns_of(rows, None).map_err(|error| output_error(py, &error))?;
        Ok((folders, values, columns::to_numpy(py, columns)?))
    }

    /// Text of the study file in the folder `out`.
    #[staticmethod]
    fn stored_text(py: Python<'_>, out: PathBuf) -> PyResult<String> {
        let text = StudyFolder::open(&out).and_then(|folder| folder.study_text());
        text.map_err(|error| output_error(py, &error))
    }
}

fn folder_of(
    study: &railcrack_case::Study,
    plan: StudyPlan,
    out: &Path,
    entry: &Entry,
) -> Result<StudyFolder, OutputError> {
    let cases: Vec<_> = study.runs.iter().map(|run| case_files(&run.case)).collect();
    StudyFolder::enter(out, plan, &study.text, entry, &cases)
}

/// The part of a study with the runs `own`, which are resumed.
fn part(own: &[usize]) -> Entry {
    Entry { part: Some(own.iter().copied().collect()), existing: ExistingRuns::Resume }
}
