//! Cases.

use crate::background::{Watch, compute, detached};
use crate::errors::{bad_input, case_error, class_of, in_python};
use crate::judge::OwnJudge;
use crate::run::RunCore;
use crate::scratch::{reading, scratch_folder};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use railcrack::growth::TipJudge;
use railcrack::words::Choice;
use railcrack_run::setup::{RunSize, WheelBounds, represented};
use railcrack_run::simulation::{Ending, Simulation, plastic_stress_left_out};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A checked case.
#[pyclass(module = "railcrack._railcrack", name = "Case", frozen)]
pub struct CaseCore {
    pub(crate) case: Arc<railcrack_case::Case>,
}

/// A run, the kind of its end (empty for a normal end, `interrupted`, or the name of an exception),
/// and the reason.
type Computed = (RunCore, String, String);

#[pymethods]
impl CaseCore {
    /// Parses the case in `text`, called `name` in error messages; file names are relative to
    /// `folder`, or to a temporary folder with `files`.
    #[staticmethod]
    fn parse(
        py: Python<'_>,
        text: &str,
        name: &str,
        folder: PathBuf,
        files: Vec<(String, Vec<u8>)>,
    ) -> PyResult<Self> {
        let case = detached(py, || {
            reading(&folder, files, |folder| railcrack_case::Case::parse(text, name, folder))
        })??;
        Ok(Self { case: Arc::new(case.map_err(|errors| case_error(py, &errors))?) })
    }

    #[getter]
    fn title(&self) -> &str {
        &self.case.title
    }

    /// Number of increments.
    #[getter]
    fn steps(&self) -> usize {
        self.case.growth.steps
    }

    #[getter]
    fn engine(&self) -> &'static str {
        self.case.engine().word()
    }

    /// Points (x, y) of each crack, mm.
    #[getter]
    fn cracks(&self) -> Vec<Vec<(f64, f64)>> {
        let points = |crack: &railcrack::crack::Crack| crack.points().iter().map(|p| (p.x, p.y)).collect();
        self.case.cracks.cracks().iter().map(points).collect()
    }

    /// The case with all defaults filled in.
    fn to_toml(&self) -> String {
        self.case.to_toml()
    }

    /// The files that this text names, with their contents.
    fn companions(&self) -> Vec<(&'static str, String)> {
        let files = self.case.companions().into_iter();
        files.map(|file| (file.name, file.text.to_owned())).collect()
    }

    /// Sizes, bounds and warnings.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let case = Arc::clone(&self.case);
        let (case, text, size) = detached(py, move || {
            let case = represented(&case).into_owned();
            let text = railcrack_cli::check_text(&case, Path::new("."));
            let size = RunSize::estimate(&case);
            (case, text, size)
        })?;
        let wheel = &case.first_wheel().wheel;
        let check = PyDict::new(py);
        check.set_item("text", text)?;
        check.set_item("face_points", size.face_points)?;
        check.set_item("tips", size.tips)?;
        check.set_item("displacement_unknowns", size.displacements)?;
        check.set_item("memory_bytes", size.memory_bytes)?;
        let shear_yield = case.shakedown.hardening.shear_yield_stress();
        let ratio = wheel.contact().map(|contact| contact.peak_pressure() / shear_yield);
        check.set_item("p0_over_k", ratio)?;
        let bounds = WheelBounds::of(&case, 0);
        let bounds = bounds.map(|bounds| (bounds.first_yield.ratio, bounds.shakedown.ratio));
        let (first_yield, shakedown_limit) = bounds.unzip();
        check.set_item("first_yield_p0_over_k", first_yield)?;
        check.set_item("shakedown_limit_p0_over_k", shakedown_limit)?;
        check.set_item("warnings", Vec::from_iter(plastic_stress_left_out(&case)))?;
        Ok(check)
    }

    /// Computes the run in memory, continuing after the steps of `before`.
    #[pyo3(signature = (threads, tell, before, law, direction))]
    fn run(
        &self,
        py: Python<'_>,
        threads: Option<usize>,
        tell: Option<&Bound<'_, PyAny>>,
        before: Option<&RunCore>,
        law: Option<Py<PyAny>>,
        direction: Option<Py<PyAny>>,
    ) -> PyResult<Computed> {
        let (watch, told) = Watch::new();
        let own = law.is_some() || direction.is_some();
        if own && self.case.is_mix() {
            return Err(bad_input(
                py,
                "law, direction: not supported for a mix of wheels, which has several histories",
            ));
        }
        if direction.is_some() && self.case.space().is_some() {
            return Err(bad_input(
                py,
                "direction: not supported with engine = \"space\", where cracks grow in their plane",
            ));
        }
        let judge: Arc<dyn TipJudge> = Arc::new(OwnJudge { law, direction, watch: Arc::clone(&watch) });
        let before = before.and_then(RunCore::in_memory);
        let (case, observer) = (Arc::clone(&self.case), Arc::clone(&watch));
        let scratch = scratch_folder()?;
        let over = compute(py, threads, (watch, told), tell, move || {
            let simulation = Simulation::new(&case).observed_by(observer.as_ref());
            let simulation = if own { simulation.judged_by(&judge) } else { simulation };
            let (run, ending) = simulation.run_in_memory(scratch.path(), before);
            (run, ending, scratch)
        })?;
        let (run, ending, scratch) = over.result;
        let run = RunCore::computed(Arc::clone(&self.case), run, scratch);
        Ok(match ending {
            Ok(Ending::Ended) => (run, String::new(), String::new()),
            Ok(Ending::Interrupted) => (run, "interrupted".into(), String::new()),
            Err(error) => (run, class_of(&error).into(), in_python(&error.to_string())),
        })
    }
}
