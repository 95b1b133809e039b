//! Tables as NumPy arrays.

use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use railcrack_run::csv::{Column, ColumnValues};

/// A dictionary from the name of each column to its array, the words that codes denote (none for
/// numbers), and its meaning. The arrays take ownership of the data without copying.
pub fn to_numpy<'py>(
    py: Python<'py>,
    columns: Vec<(&'static Column, ColumnValues)>,
) -> PyResult<Bound<'py, PyDict>> {
    let table = PyDict::new(py);
    for (column, values) in columns {
        let none: Option<Vec<&str>> = None;
        let meaning: Vec<&str> = column.meaning.iter().map(|line| line.trim()).collect();
        let meaning = meaning.join(" ").replace("\\|", "|");
        let entry = match values {
            ColumnValues::Counts(values) => (values.into_pyarray(py).into_any(), none, meaning),
            ColumnValues::Reals(values) => (values.into_pyarray(py).into_any(), none, meaning),
            ColumnValues::Words { codes, words } => (codes.into_pyarray(py).into_any(), Some(words), meaning),
            ColumnValues::Texts(texts) => (texts.into_pyobject(py)?, none, meaning),
        };
        table.set_item(column.name, entry)?;
    }
    Ok(table)
}
