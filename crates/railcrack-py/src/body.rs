//! Cracked bodies, represented by two matrices at the face points.

use crate::background::{Watch, compute};
use crate::case::CaseCore;
use crate::errors::{bad_input, not_converged};
use crate::grid::matrix;
use crate::limits;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use railcrack::body::{BodyEngine, CrackedBody, FaceMesh, FacePoint, FieldSolver};
use railcrack::crack::{Crack, CrackNetwork, CrackTip};
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::field::RailEnds;
use railcrack::interruption::Interruption;
use railcrack::material::IsotropicElastic;
use railcrack::math::{Matrix, Vec2};
use railcrack::xfem::{RailEnd, RefinedRegion, XfemEngine, XfemSettings, default_element_sizes};
use railcrack_run::setup::body_engine;
use std::sync::Arc;

/// A cracked body with its matrices as NumPy arrays.
#[pyclass(module = "railcrack._railcrack", name = "Body", frozen)]
pub struct BodyCore {
    pub(crate) steel: IsotropicElastic,
    pub(crate) faces: FaceMesh,
    tips: Vec<CrackTip>,
    compliance: Py<PyArray2<f64>>,
    stiffness: Py<PyArray2<f64>>,
    sif_influence: Py<PyArray2<f64>>,
    dofs: usize,
    pub(crate) ends: Option<Arc<dyn RailEnds>>,
    fields: Option<Arc<dyn FieldSolver>>,
    remarks: Vec<String>,
}

impl BodyCore {
    fn new(py: Python<'_>, body: CrackedBody, steel: IsotropicElastic) -> PyResult<Self> {
        let array = |matrix_: Matrix| -> PyResult<Py<PyArray2<f64>>> {
            let columns = matrix_.columns();
            Ok(matrix(py, matrix_.into_entries(), columns)?.unbind())
        };
        Ok(Self {
            steel,
            faces: body.faces,
            tips: body.tips,
            compliance: array(body.compliance)?,
            stiffness: array(body.stiffness)?,
            sif_influence: array(body.sif_influence)?,
            dofs: body.dofs,
            ends: body.ends,
            fields: body.fields,
            remarks: body.remarks,
        })
    }

    /// The body for the mechanics, with copies of the current arrays.
    pub(crate) fn whole(&self, py: Python<'_>) -> PyResult<CrackedBody> {
        let matrix = |array: &Py<PyArray2<f64>>| -> PyResult<Matrix> {
            let array = array.bind(py).readonly();
            let view = array.as_array();
            let entries: Vec<f64> = view.iter().copied().collect();
            limits::finite(py, "a matrix of the body", entries.iter().copied())?;
            Matrix::from_entries(view.nrows(), view.ncols(), entries)
                .ok_or_else(|| bad_input(py, "the shape of a matrix of the body has changed"))
        };
        let matrices = [matrix(&self.compliance)?, matrix(&self.stiffness)?, matrix(&self.sif_influence)?];
        let body = CrackedBody::new(self.faces.clone(), self.tips.clone(), matrices);
        Ok(CrackedBody { ends: self.ends.clone(), fields: self.fields.clone(), dofs: self.dofs, ..body })
    }

    fn of_points<'py, T: numpy::Element>(
        &self,
        py: Python<'py>,
        of: impl Fn(&FacePoint) -> T,
    ) -> Bound<'py, PyArray1<T>> {
        self.faces.points.iter().map(of).collect::<Vec<T>>().into_pyarray(py)
    }
}

#[pymethods]
impl BodyCore {
    #[getter]
    fn compliance(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        self.compliance.clone_ref(py)
    }

    #[getter]
    fn stiffness(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        self.stiffness.clone_ref(py)
    }

    #[getter]
    fn sif_influence(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        self.sif_influence.clone_ref(py)
    }

    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.faces.points.iter().flat_map(|p| [p.position.x, p.position.y]).collect(), 2)
    }

    #[getter]
    fn tangents<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.faces.points.iter().flat_map(|p| [p.tangent.x, p.tangent.y]).collect(), 2)
    }

    #[getter]
    fn arc_lengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.of_points(py, |point| point.s)
    }

    #[getter]
    fn weights<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.of_points(py, |point| point.weight)
    }

    #[getter]
    fn crack_of_point<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        self.of_points(py, |point| point.crack as i64 + 1)
    }

    #[getter]
    fn samples<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.faces.samples.iter().flat_map(|s| [s.point.x, s.point.y]).collect(), 2)
    }

    /// Crack and tip within it, from 1.
    #[getter]
    fn tips(&self) -> Vec<(usize, usize)> {
        self.tips.iter().map(|tip| (tip.crack + 1, tip.tip + 1)).collect()
    }

    #[getter]
    fn unknowns(&self) -> usize {
        self.dofs
    }

    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.remarks.clone()
    }

    /// Nodal forces (2 p) of the stresses (sxx, syy, sxy) at the samples, shape (samples, 3).
    fn nodal_forces<'py>(
        &self,
        py: Python<'py>,
        stresses: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let stresses = crate::wheel::stresses(&stresses, self.faces.samples.len())?;
        limits::finite(py, "stress", stresses.iter().flat_map(|s| [s.xx, s.yy, s.xy]))?;
        Ok(self.faces.nodal_forces_of_samples(|k, _| stresses[k]).into_pyarray(py))
    }
}

/// Cracks by their points (x, y), mm.
type Cracks = Vec<Vec<(f64, f64)>>;

/// The body of `cracks` in a half-plane by extended finite elements.
#[pyfunction]
#[pyo3(signature = (cracks, young, poisson, element_size, threads))]
pub fn xfem_body(
    py: Python<'_>,
    cracks: Cracks,
    young: f64,
    poisson: f64,
    element_size: Option<f64>,
    threads: Option<usize>,
) -> PyResult<BodyCore> {
    let network = network(py, cracks)?;
    let (mut sizes, mut mesh) = (default_element_sizes(&network), String::new());
    if let Some(size) = element_size {
        limits::number(py, "element_size_mm", size, ("mesh", "element_size_mm"))?;
        (sizes, mesh) = (vec![size; network.cracks().len()], format!("element_size_mm = {size:?}"));
    }
    limits::body(py, &network, "xfem", &mesh)?;
    let refined = RefinedRegion::with_sizes(&network, &sizes, 1.0);
    let centre = 0.5 * (network.leftmost_mouth() + network.rightmost_mouth());
    let steel = steel(py, young, poisson)?;
    let end = RailEnd::HalfPlane { centre };
    let engine = XfemEngine::with_region(refined, steel, end, XfemSettings::default());
    made(py, Box::new(engine), &network, steel, threads)
}

/// The body of `cracks` in a half-plane by dislocations.
#[pyfunction]
#[pyo3(signature = (cracks, young, poisson, elements, threads))]
pub fn dislocation_body(
    py: Python<'_>,
    cracks: Cracks,
    young: f64,
    poisson: f64,
    elements: Option<usize>,
    threads: Option<usize>,
) -> PyResult<BodyCore> {
    let network = network(py, cracks)?;
    let (mut resolution, mut mesh) = (FaceResolution::for_cracks(network.cracks().len()), String::new());
    if let Some(elements) = elements {
        limits::integer(py, "elements", elements, ("mesh", "interface_elements"))?;
        (resolution, mesh) = (FaceResolution { elements }, format!("interface_elements = {elements}"));
    }
    limits::body(py, &network, "dislocation", &mesh)?;
    let steel = steel(py, young, poisson)?;
    made(py, Box::new(DislocationEngine { steel, resolution }), &network, steel, threads)
}

/// The body of the cracks of `case` at their start, by its engine.
#[pyfunction]
pub fn case_body(py: Python<'_>, case: &CaseCore, threads: Option<usize>) -> PyResult<BodyCore> {
    let case = &case.case;
    let Some(engine) = body_engine(case) else {
        let says = "a body requires plane cracks; engine = \"space\" supports runs only";
        return Err(bad_input(py, says));
    };
    made(py, engine, &case.cracks, case.steel, threads)
}

fn network(py: Python<'_>, cracks: Cracks) -> PyResult<CrackNetwork> {
    let mut made = Vec::with_capacity(cracks.len());
    for (i, points) in cracks.into_iter().enumerate() {
        let points = points.into_iter().map(|(x, y)| Vec2::new(x, y)).collect();
        let crack = Crack::polyline(points);
        made.push(crack.map_err(|error| bad_input(py, format!("crack {}: {error}", i + 1)))?);
    }
    CrackNetwork::new(made).map_err(|error| bad_input(py, error))
}

fn steel(py: Python<'_>, young: f64, poisson: f64) -> PyResult<IsotropicElastic> {
    limits::number(py, "young_modulus_mpa", young, ("rail", "young_modulus_mpa"))?;
    limits::number(py, "poisson_ratio", poisson, ("rail", "poisson_ratio"))?;
    IsotropicElastic::new(young, poisson).map_err(|error| bad_input(py, error))
}

/// The body of `network`, computed without holding the interpreter lock; Ctrl-C abandons it.
fn made(
    py: Python<'_>,
    mut engine: Box<dyn BodyEngine + Send>,
    network: &CrackNetwork,
    steel: IsotropicElastic,
    threads: Option<usize>,
) -> PyResult<BodyCore> {
    let (watch, told) = Watch::new();
    let (network, observer) = (network.clone(), Arc::clone(&watch));
    let over = compute(py, threads, (watch, told), None, move || {
        let asked = || observer.is_interrupted();
        engine.body_unless(Interruption::when(&asked), &network)
    })?;
    match (over.result, over.signal) {
        (Ok(body), _) => BodyCore::new(py, body, steel),
        (Err(_), Some(signal)) => Err(signal),
        (Err(error), None) => Err(not_converged(py, error)),
    }
}
