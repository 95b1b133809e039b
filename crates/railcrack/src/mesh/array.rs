//! Arrays of data on points or cells.

use super::GridError;
use crate::math::{Stress, Vec2};

/// Components of a symmetric tensor in the order of VTK.
pub const SYMMETRIC_TENSOR: [&str; 6] = ["XX", "YY", "ZZ", "XY", "YZ", "XZ"];

/// Named data with an entry per point or per cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// The name, with the unit: `stress_mpa`.
    pub name: String,
    /// Components of one entry, at least 1.
    pub components: usize,
    /// `values[entry * components + component]`.
    pub values: Vec<f64>,
}

impl Array {
    /// An array with one number per point or cell.
    pub fn scalars(name: &str, values: Vec<f64>) -> Self {
        Self { name: name.to_owned(), components: 1, values }
    }

    /// Plane vectors stored with 3 components, the third of which is 0.
    pub fn vectors(name: &str, vectors: &[Vec2]) -> Self {
        let values = vectors.iter().flat_map(|v| [v.x, v.y, 0.0]).collect();
        Self { name: name.to_owned(), components: 3, values }
    }

    /// Symmetric tensors stored with the 6 components XX, YY, ZZ, XY, YZ, XZ of VTK, the last two
    /// 0.
    pub fn stresses(name: &str, stresses: &[Stress]) -> Self {
        let values = stresses.iter().flat_map(|s| [s.xx, s.yy, s.zz, s.xy, 0.0, 0.0]).collect();
        Self { name: name.to_owned(), components: SYMMETRIC_TENSOR.len(), values }
    }

    /// The entries, each of `components` values.
    pub fn entries(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks_exact(self.components.max(1))
    }

    /// The entries as plane vectors; a third component is ignored.
    ///
    /// Errors: a number of components other than 2 or 3; a value that is not finite.
    pub fn to_vectors(&self) -> Result<Vec<Vec2>, GridError> {
        if !matches!(self.components, 2 | 3) {
            return Err(self.other_components("2 or 3"));
        }
        self.finite()?;
        Ok(self.entries().map(|v| Vec2::new(v[0], v[1])).collect())
    }

    /// The entries as plane-strain tensors: 4 components XX, YY, ZZ, XY, or the 6 of VTK, of which
    /// the out-of-plane shears are ignored.
    ///
    /// Errors: a number of components other than 4 or 6; a value that is not finite.
    pub fn to_stresses(&self) -> Result<Vec<Stress>, GridError> {
        if !matches!(self.components, 4 | 6) {
            return Err(self.other_components("4 or 6"));
        }
        self.finite()?;
        Ok(self.entries().map(|s| Stress { xx: s[0], yy: s[1], zz: s[2], xy: s[3] }).collect())
    }

    /// Checks that every value is finite.
    ///
    /// Errors: the first value that is not finite.
    pub fn finite(&self) -> Result<(), GridError> {
        match self.values.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(i) => Err(GridError::NotFinite {
                name: self.name.clone(),
                entry: i / self.components.max(1),
                value: self.values[i],
            }),
        }
    }

    pub(super) fn check(&self, entries: usize) -> Result<(), GridError> {
        let fits = self.components.checked_mul(entries) == Some(self.values.len());
        if self.components == 0 || !fits {
            return Err(GridError::Length {
                name: self.name.clone(),
                found: self.values.len(),
                components: self.components,
                entries,
            });
        }
        Ok(())
    }

    fn other_components(&self, accepted: &'static str) -> GridError {
        GridError::Components { name: self.name.clone(), found: self.components, accepted }
    }
}
