//! User-defined stress fields.

use crate::background::Watch;
use crate::grid::matrix;
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use railcrack::field::{StressField, Wheel};
use railcrack::math::{Stress, Vec2};
use std::collections::HashMap;
use std::sync::Arc;

/// A wheel whose stress is a function of points (n, 2) and x_c: an array (n, 3) of sxx, syy, sxy.
#[derive(Debug)]
pub struct OwnWheel {
    /// The function.
    pub stress: Py<PyAny>,
    /// Edges of the contact relative to x_c, mm, increasing.
    pub edges: Vec<f64>,
    /// Receives exceptions.
    pub watch: Arc<Watch>,
}

impl Wheel for OwnWheel {
    fn stress(&self, point: Vec2, xc: f64) -> Stress {
        self.stresses(&[point], xc).into_iter().next().unwrap_or_default()
    }

    fn stresses(&self, points: &[Vec2], xc: f64) -> Vec<Stress> {
        if self.watch.is_interrupted() {
            return vec![Stress::ZERO; points.len()];
        }
        Python::attach(|py| ask(py, &self.stress, points, Some(xc))).unwrap_or_else(|error| {
            self.watch.fail(error);
            vec![Stress::ZERO; points.len()]
        })
    }

    /// Not needed: only bodies without ends are supported, and they require no displacements.
    fn displacement(&self, _: Vec2, _: f64) -> Vec2 {
        Vec2::default()
    }

    fn edges(&self) -> &[f64] {
        &self.edges
    }
}

/// A residual stress given at points.
pub struct Tabulated(HashMap<[u64; 2], Stress>);

impl Tabulated {
    /// The function `stress` of points (n, 2) at `points`: an array (n, 3) of sxx, syy, sxy.
    pub fn new(py: Python<'_>, stress: &Py<PyAny>, points: &[Vec2]) -> PyResult<Self> {
        let stresses = ask(py, stress, points, None)?;
        Ok(Self(points.iter().map(|&point| bits(point)).zip(stresses).collect()))
    }
}

fn bits(point: Vec2) -> [u64; 2] {
    [point.x.to_bits(), point.y.to_bits()]
}

impl StressField for Tabulated {
    fn stress(&self, point: Vec2) -> Stress {
        self.0.get(&bits(point)).copied().unwrap_or_default()
    }
}

fn ask(py: Python<'_>, stress: &Py<PyAny>, points: &[Vec2], xc: Option<f64>) -> PyResult<Vec<Stress>> {
    let array = matrix(py, points.iter().flat_map(|p| [p.x, p.y]).collect(), 2)?;
    let answer = match xc {
        Some(xc) => stress.call1(py, (array, xc))?,
        None => stress.call1(py, (array,))?,
    };
    let answer = py.import("numpy")?.call_method1("asarray", (answer, "float64"))?;
    let answer: PyReadonlyArray2<'_, f64> = answer.extract().map_err(|_| {
        PyValueError::new_err(
            "stress: must return an array of the shape (points, 3), sxx, syy and sxy in MPa",
        )
    })?;
    stresses(&answer, points.len())
}

/// The stresses (sxx, syy, sxy) of an array of the shape (`points`, 3), MPa.
///
/// Errors: another shape, or a stress that is not finite.
pub fn stresses(array: &PyReadonlyArray2<'_, f64>, points: usize) -> PyResult<Vec<Stress>> {
    let view = array.as_array();
    if view.shape() != [points, 3] {
        let says =
            format!("stress has the shape {:?}: must be ({points}, 3), sxx, syy and sxy", view.shape());
        return Err(PyValueError::new_err(says));
    }
    let row = |row: numpy::ndarray::ArrayView1<f64>| Stress { xx: row[0], yy: row[1], zz: 0.0, xy: row[2] };
    let stresses: Vec<Stress> = view.rows().into_iter().map(row).collect();
    match stresses.iter().position(|s| !(s.xx.is_finite() && s.yy.is_finite() && s.xy.is_finite())) {
        Some(i) => Err(PyValueError::new_err(format!("stress at point {i} (from 0) is not finite"))),
        None => Ok(stresses),
    }
}
