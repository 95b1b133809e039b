//! Limits of the case file for the arguments of functions.

use crate::errors::bad_input;
use pyo3::prelude::*;
use railcrack::crack::CrackNetwork;
use railcrack_case::{Case, Key, Kind, SECTIONS};
use std::fmt::Write;
use std::path::Path;

/// Largest stress, K and coordinate of an argument that has no key in the case file: beyond it,
/// results would no longer be numbers.
const LARGEST: f64 = 1e12;

fn declared(section: &str, key: &str) -> Option<&'static Key> {
    SECTIONS.iter().find(|declared| declared.name == section)?.key(key)
}

/// Checks the number `value` of the argument `name` against the range of `key` in `section`.
///
/// Errors: `BadInput`.
pub fn number(py: Python<'_>, name: &str, value: f64, (section, key): (&str, &str)) -> PyResult<()> {
    match declared(section, key).map(|key| key.kind) {
        Some(Kind::Number { unit, range }) if !range.contains(value) => {
            let says = format!("{name} = {value}: must be a number in {range} {unit}");
            Err(bad_input(py, says.trim_end()))
        }
        _ => Ok(()),
    }
}

/// Checks the integer `value` of the argument `name` against the range of `key` in `section`.
///
/// Errors: `BadInput`.
pub fn integer(py: Python<'_>, name: &str, value: usize, (section, key): (&str, &str)) -> PyResult<()> {
    match declared(section, key).map(|key| key.kind) {
        Some(Kind::Integer { min, max }) if !(min..=max).contains(&(value as u64)) => {
            Err(bad_input(py, format!("{name} = {value}: must be an integer from {min} to {max}")))
        }
        _ => Ok(()),
    }
}

/// Checks that the `values` of the argument `name` are finite and of a size with which one can
/// compute.
///
/// Errors: `BadInput`.
pub fn finite(py: Python<'_>, name: &str, values: impl IntoIterator<Item = f64>) -> PyResult<()> {
    match values.into_iter().find(|value| value.is_nan() || value.abs() > LARGEST) {
        Some(value) => Err(bad_input(py, format!("{name}: {value} is not a number of at most {LARGEST:e}"))),
        None => Ok(()),
    }
}

/// Checks that a case could have the cracks of `network`, with the lines `mesh` of its `[mesh]`, in
/// `engine`: that the engine resolves them and that the machine could hold their matrices.
///
/// Errors: `BadInput`.
pub fn body(py: Python<'_>, network: &CrackNetwork, engine: &str, mesh: &str) -> PyResult<()> {
    let mut text = format!(
        "[rail]\nwidth_mm = 1e5\ndepth_mm = 1e5\n[contact]\npeak_pressure_mpa = 1.0\nhalf_width_mm = 1.0\n\
         friction = 0.0\n[passage]\npositions = 2\n[growth]\nsteps = 0\n[mesh]\n{mesh}\n\
         [solver]\nengine = \"{engine}\"\n"
    );
    for crack in network.cracks() {
        let points: Vec<String> =
            crack.points().iter().map(|point| format!("[{:?}, {:?}]", point.x, point.y)).collect();
        let _ = write!(text, "[[crack]]\nfriction = 0.0\npoints_mm = [{}]\n", points.join(", "));
    }
    let checked = Case::parse(&text, "body", Path::new(""));
    checked.map(drop).map_err(|errors| match errors.errors().first() {
        Some(error) => bad_input(py, error.message()),
        None => bad_input(py, &errors),
    })
}
