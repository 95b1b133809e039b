//! Fields on meshes as NumPy arrays.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use railcrack::mesh::{Array, UnstructuredGrid};
use railcrack_vtu::vtk_type;

/// A dictionary of points (n, 3) in mm, cells and cell types as in VTK, and point and cell arrays
/// by name.
pub fn to_numpy<'py>(py: Python<'py>, grid: &UnstructuredGrid) -> PyResult<Bound<'py, PyDict>> {
    // Plane grids have no z.
    let z = grid.z.iter().copied().chain(std::iter::repeat(0.0));
    let points: Vec<f64> = grid.points.iter().zip(z).flat_map(|(p, z)| [p.x, p.y, z]).collect();
    let (mut cells, mut types): (Vec<i64>, Vec<u8>) = (Vec::new(), Vec::new());
    for block in &grid.cells {
        for cell in block.cells() {
            cells.push(cell.len() as i64);
            cells.extend(cell.iter().map(|&node| node as i64));
            types.push(vtk_type(block.shape));
        }
    }
    let dictionary = PyDict::new(py);
    dictionary.set_item("points", matrix(py, points, 3)?)?;
    dictionary.set_item("cells", cells.into_pyarray(py))?;
    dictionary.set_item("cell_types", types.into_pyarray(py))?;
    dictionary.set_item("point_data", arrays(py, &grid.point_data)?)?;
    dictionary.set_item("cell_data", arrays(py, &grid.cell_data)?)?;
    Ok(dictionary)
}

fn arrays<'py>(py: Python<'py>, arrays: &[Array]) -> PyResult<Bound<'py, PyDict>> {
    let dictionary = PyDict::new(py);
    for array in arrays {
        let values = array.values.clone();
        if array.components == 1 {
            dictionary.set_item(&array.name, values.into_pyarray(py))?;
        } else {
            dictionary.set_item(&array.name, matrix(py, values, array.components)?)?;
        }
    }
    Ok(dictionary)
}

/// `values`, row by row, as an array with `columns` columns, without copying.
pub fn matrix(py: Python<'_>, values: Vec<f64>, columns: usize) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let rows = values.len().checked_div(columns).unwrap_or(0);
    let array = Array2::from_shape_vec((rows, columns), values);
    let array = array.map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(PyArray2::from_owned_array(py, array))
}
