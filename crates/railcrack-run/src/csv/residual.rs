//! `residual.csv`: the residual stress that the crack mesh carries.

use super::{Rows, header};
use crate::OutputError;
use railcrack::math::Stress;

pub const RESIDUAL_FILE: &str = "residual.csv";

/// Columns of `residual.csv`.
pub const RESIDUAL_COLUMNS: [&str; 5] = ["depth_mm", "sxx_mpa", "syy_mpa", "szz_mpa", "sxy_mpa"];

/// Residual stress at a depth on the middle line of the crack mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResidualRow {
    /// Depth below the running surface, mm.
    pub depth: f64,
    /// The stress there, MPa.
    pub stress: Stress,
}

/// The whole table.
pub fn residual_table(profile: &[ResidualRow]) -> Result<Vec<u8>, OutputError> {
    let [depth, xx, yy, zz, xy] = RESIDUAL_COLUMNS;
    let mut rows = Rows::default();
    for row in profile {
        rows.real(depth, row.depth);
        rows.real(xx, row.stress.xx);
        rows.real(yy, row.stress.yy);
        rows.real(zz, row.stress.zz);
        rows.real(xy, row.stress.xy);
        rows.end();
    }
    let comments = [
        "Residual stress that the crack mesh carries, after balance, on the middle line",
        "depth_mm: below the running surface, mm; stress: MPa, tension positive; x along the rail, y upwards, z out of plane",
    ];
    let mut table = header(&comments, &RESIDUAL_COLUMNS).into_bytes();
    table.extend_from_slice(rows.text(RESIDUAL_FILE)?);
    Ok(table)
}
