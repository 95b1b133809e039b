//! The stabilised passage of a wheel over fixed cracks.

use crate::background::{Watch, compute};
use crate::body::BodyCore;
use crate::errors::{bad_input, not_converged};
use crate::grid::matrix;
use crate::judge::history_array;
use crate::limits;
use crate::wheel::{OwnWheel, Tabulated};
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use railcrack::contact::{ContactSolver, FaceProblem, FaceStatus, Latin, Newton};
use railcrack::field::{HertzWheel, StressField, Wheel};
use railcrack::growth::{PassageError, PassageSettings, StabilisedPassage};
use railcrack::load::{HertzianContact, Passage};
use railcrack::math::Vec2;
use railcrack::plane::{RailLoad, stabilised_passage};
use std::sync::Arc;

/// Maximum number of edges of a user-defined wheel.
const MOST_EDGES: usize = 100;

/// The wheel: p0 (MPa), half-width (mm) and friction of Hertzian contact, or a function of points
/// and x_c with the edges of its contact.
#[derive(FromPyObject)]
pub enum Load {
    /// Hertzian contact.
    Hertz(f64, f64, f64),
    /// A user-defined function.
    Own(Py<PyAny>, Vec<f64>),
}

/// First and last position (mm), number of output positions, maximum number of passages, tolerances
/// of passages and of load steps.
type Settings = (f64, f64, usize, usize, f64, f64);

/// Arrays of the stabilised passage of `load` over the cracks of `body`.
#[pyfunction]
#[pyo3(signature = (body, load, friction, residual, settings, solver, threads, tell))]
#[expect(clippy::too_many_arguments, reason = "named in the package")]
pub fn passage<'py>(
    py: Python<'py>,
    body: &BodyCore,
    load: Load,
    friction: Vec<f64>,
    residual: Option<Py<PyAny>>,
    settings: Settings,
    solver: &str,
    threads: Option<usize>,
    tell: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let (watch, told) = Watch::new();
    let wheel = wheel(py, load, body, &watch)?;
    let samples: Vec<Vec2> = body.faces.samples.iter().map(|sample| sample.point).collect();
    let residual = residual.map(|stress| Tabulated::new(py, &stress, &samples)).transpose()?;
    let solver: Box<dyn ContactSolver + Send> = match solver {
        "newton" => Box::new(Newton::default()),
        "latin" => Box::new(Latin::default()),
        other => return Err(bad_input(py, format!("solver \"{other}\": must be newton or latin"))),
    };
    friction.iter().try_for_each(|one| limits::number(py, "friction", *one, ("crack", "friction")))?;
    let settings = checked(py, settings)?;
    let whole = body.whole(py)?;
    FaceProblem::new(&whole, &friction).map_err(|error| bad_input(py, error))?;
    let observer = Arc::clone(&watch);
    let over = compute(py, threads, (watch, told), tell, move || {
        let problem = FaceProblem::new(&whole, &friction).ok()?;
        let residual = residual.as_ref().map(|field| field as &dyn StressField);
        let load = RailLoad { wheel: wheel.as_ref(), residual };
        Some(stabilised_passage(&problem, solver.as_ref(), load, &settings, observer.as_ref()))
    })?;
    match (over.result, over.signal) {
        (_, Some(signal)) => Err(signal),
        (Some(Ok(passage)), None) => arrays(py, &passage),
        (Some(Err(error @ (PassageError::Settings(_) | PassageError::Ends(_)))), None) => {
            Err(bad_input(py, error))
        }
        (Some(Err(error)), None) => Err(not_converged(py, error)),
        (None, None) => Err(bad_input(py, "the friction must be one number, or one number per crack")),
    }
}

/// The wheel of `load` over the cracks of `body`.
fn wheel(py: Python<'_>, load: Load, body: &BodyCore, watch: &Arc<Watch>) -> PyResult<Box<dyn Wheel>> {
    Ok(match load {
        Load::Hertz(peak_pressure, half_width, friction) => {
            limits::number(py, "peak_pressure_mpa", peak_pressure, ("contact", "peak_pressure_mpa"))?;
            limits::number(py, "half_width_mm", half_width, ("contact", "half_width_mm"))?;
            limits::number(py, "friction of the wheel", friction, ("contact", "friction"))?;
            let contact = HertzianContact { peak_pressure, half_width, friction };
            Box::new(HertzWheel::new(&contact, &body.steel).map_err(|error| bad_input(py, error))?)
        }
        Load::Own(..) if body.ends.is_some() => {
            return Err(bad_input(py, "a user-defined wheel requires a half-plane; this body has ends"));
        }
        Load::Own(_, edges) if edges.len() > MOST_EDGES => {
            let says = format!("edges_mm has {} numbers: must be at most {MOST_EDGES}", edges.len());
            return Err(bad_input(py, says));
        }
        Load::Own(_, edges)
            if !edges.windows(2).all(|pair| pair[0] < pair[1])
                || edges.iter().any(|edge| !edge.is_finite()) =>
        {
            return Err(bad_input(py, "edges_mm: must be increasing numbers"));
        }
        Load::Own(stress, edges) => Box::new(OwnWheel { stress, edges, watch: Arc::clone(watch) }),
    })
}

fn checked(py: Python<'_>, settings: Settings) -> PyResult<PassageSettings> {
    let (from, to, positions, max_passages, passage_tolerance, step_tolerance) = settings;
    limits::finite(py, "from_mm, to_mm", [from, to])?;
    limits::integer(py, "positions", positions, ("passage", "positions"))?;
    limits::integer(py, "max_passages", max_passages, ("passage", "max_passages"))?;
    limits::number(py, "passage_tolerance", passage_tolerance, ("passage", "passage_tolerance"))?;
    limits::number(py, "step_tolerance", step_tolerance, ("passage", "step_tolerance"))?;
    let settings = PassageSettings {
        passage: Passage { from, to, positions },
        max_passages,
        passage_tolerance,
        step_tolerance,
        ..PassageSettings::default()
    };
    settings.check().map_err(|error| bad_input(py, error))?;
    Ok(settings)
}

fn arrays<'py>(py: Python<'py>, passage: &StabilisedPassage) -> PyResult<Bound<'py, PyDict>> {
    let result = PyDict::new(py);
    let xc = passage.passages.last().map_or_else(Vec::new, |last| last.xc.clone());
    let positions = xc.len();
    result.set_item("xc", xc.into_pyarray(py))?;
    let (ki, kii) = (PyList::empty(py), PyList::empty(py));
    for one in &passage.passages {
        let of = |k: fn(&railcrack::fracture::Sif) -> f64| one.sifs.iter().flatten().map(k).collect();
        ki.append(matrix(py, of(|sif| sif.ki_mpa_sqrt_m()), positions)?)?;
        kii.append(matrix(py, of(|sif| sif.kii_mpa_sqrt_m()), positions)?)?;
    }
    result.set_item("ki", ki)?;
    result.set_item("kii", kii)?;
    let histories = passage.histories.iter().map(|history| history_array(py, &history.samples));
    result.set_item("histories", histories.collect::<PyResult<Vec<_>>>()?)?;
    let states = || passage.faces.states.iter().flatten();
    let points = passage.faces.points.len();
    result.set_item("opening", matrix(py, states().map(|state| state.opening).collect(), points)?)?;
    result.set_item("slip", matrix(py, states().map(|state| state.slip).collect(), points)?)?;
    result.set_item("s22", matrix(py, states().map(|state| state.s22).collect(), points)?)?;
    result.set_item("s12", matrix(py, states().map(|state| state.s12).collect(), points)?)?;
    let code = |status| match status {
        FaceStatus::Open => 0.0,
        FaceStatus::Stick => 1.0,
        FaceStatus::Slip => 2.0,
    };
    result.set_item("status", matrix(py, states().map(|state| code(state.status)).collect(), points)?)?;
    result.set_item("passages", passage.passages.len())?;
    result.set_item("solves", passage.counts.solves)?;
    result.set_item("last_change", passage.last_change)?;
    Ok(result)
}
