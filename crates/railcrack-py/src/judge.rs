//! User-defined growth laws and direction criteria.

use crate::background::Watch;
use numpy::PyArray2;
use numpy::ndarray::Array2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use railcrack::fatigue::KINK_ANGLES;
use railcrack::fracture::{Sif, SifHistory};
use railcrack::growth::{TipGeometry, TipJudge, TipRecord};
use railcrack::math::MPA_SQRT_MM;
use std::sync::Arc;

/// Functions of the history of K at a tip that replace law and criterion of the case.
#[derive(Debug)]
pub struct OwnJudge {
    /// The growth rate, mm per cycle.
    pub law: Option<Py<PyAny>>,
    /// The kink, degrees from straight ahead; none for a tip that is not loaded.
    pub direction: Option<Py<PyAny>>,
    /// Receives exceptions.
    pub watch: Arc<Watch>,
}

impl TipJudge for OwnJudge {
    fn judge(&self, history: &SifHistory, tip: &mut TipRecord) {
        if self.watch.is_interrupted() {
            return;
        }
        Python::attach(|py| {
            if let Err(error) = self.asked(py, history, tip) {
                self.watch.fail(error);
            }
        });
    }
}

impl OwnJudge {
    fn asked(&self, py: Python<'_>, history: &SifHistory, tip: &mut TipRecord) -> PyResult<()> {
        let samples = history_array(py, &history.samples)?;
        if let Some(direction) = &self.direction {
            let degrees: Option<f64> = direction.call1(py, (&samples,))?.extract(py)?;
            let range = (KINK_ANGLES.start().to_degrees(), KINK_ANGLES.end().to_degrees());
            if let Some(degrees) = degrees.filter(|degrees| !(range.0..=range.1).contains(degrees)) {
                let says = format!(
                    "direction = {degrees} degrees: must be None, or from {:.0} to {:.0} degrees from straight ahead",
                    range.0, range.1
                );
                return Err(PyValueError::new_err(says));
            }
            tip.kink = degrees.map(f64::to_radians);
            if let TipGeometry::Plane(plane) = &mut tip.geometry {
                (plane.secondary, plane.secondary_ratio) = (None, None);
            }
        }
        if let Some(law) = &self.law {
            let rate: f64 = law.call1(py, (&samples,))?.extract(py)?;
            if !(rate >= 0.0 && rate.is_finite()) {
                let says = format!("law = {rate} mm per cycle: must be finite and not negative");
                return Err(PyValueError::new_err(says));
            }
            tip.rate = rate;
        }
        Ok(())
    }
}

/// K_I and K_II of every sample, MPa√m: shape (samples, 2).
pub fn history_array<'py>(py: Python<'py>, samples: &[Sif]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let values = samples.iter().flat_map(|k| [k.ki_mpa_sqrt_m(), k.kii_mpa_sqrt_m()]).collect();
    let array = Array2::from_shape_vec((samples.len(), 2), values);
    let array = array.map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(PyArray2::from_owned_array(py, array))
}

/// The samples of an array of K_I and K_II, MPa√m: shape (samples, 2).
///
/// Errors: another shape.
pub fn history_of(array: &numpy::PyReadonlyArray2<'_, f64>) -> PyResult<SifHistory> {
    let view = array.as_array();
    if view.ncols() != 2 {
        let says = format!("history has the shape {:?}: must be (samples, 2), K_I and K_II", view.shape());
        return Err(PyValueError::new_err(says));
    }
    let sample =
        |row: numpy::ndarray::ArrayView1<f64>| Sif { ki: row[0] * MPA_SQRT_MM, kii: row[1] * MPA_SQRT_MM };
    Ok(SifHistory { samples: view.rows().into_iter().map(sample).collect() })
}
