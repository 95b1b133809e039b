//! `passes.csv` and `profile.csv`.

use super::{PASSES_FILE, PROFILE_FILE};
use crate::OutputError;
use crate::csv::{Rows, header};
use railcrack::fatigue::Initiation;
use railcrack::shakedown::{PassRecord, StabilisedRail};

/// Columns of `passes.csv`.
pub const PASSES_COLUMNS: [&str; 7] = [
    "pass",
    "stress_change_mpa",
    "plastic_strain_change",
    "plastic_strain_max",
    "plastic_path_max",
    "left_stress_max_mpa",
    "redistributions",
];

/// Columns of `profile.csv`.
pub const PROFILE_COLUMNS: [&str; 11] = [
    "depth_mm",
    "sxx_mpa",
    "syy_mpa",
    "szz_mpa",
    "sxy_mpa",
    "ep_xx",
    "ep_yy",
    "ep_zz",
    "ep_xy",
    "plastic_per_pass",
    "dang_van_mpa",
];

pub(super) fn passes_header() -> String {
    let comments = [
        "What each passage changes, the largest over depth; strains are equivalent, sqrt(2/3) of the Frobenius norm",
        "stress_change_mpa: of sxx or szz of the residual stress, MPa; plastic_strain_max: after the passage; plastic_path_max: strain along the way; left_stress_max_mpa: that the passages so far leave",
    ];
    header(&comments, &PASSES_COLUMNS)
}

pub(super) fn pass_row(pass: &PassRecord) -> Result<Vec<u8>, OutputError> {
    let [_, stress, change, strain, path, left, _] = PASSES_COLUMNS;
    let mut rows = Rows::default();
    rows.count(pass.pass);
    rows.real(stress, pass.stress_change);
    rows.real(change, pass.strain_change);
    rows.real(strain, pass.largest_strain);
    rows.real(path, pass.plastic_path);
    rows.real(left, pass.left_stress);
    rows.count(pass.iterations);
    rows.end();
    Ok(rows.text(PASSES_FILE)?.to_vec())
}

/// The whole `profile.csv`: `initiation` has the surface, then the layers of `rail`.
pub(super) fn profile_table(rail: &StabilisedRail, initiation: &Initiation) -> Result<Vec<u8>, OutputError> {
    let [depth, sxx, syy, szz, sxy, xx, yy, zz, xy, path, dang_van] = PROFILE_COLUMNS;
    let mut rows = Rows::default();
    for (layer, value) in rail.profile.iter().zip(initiation.by_depth.iter().skip(1)) {
        rows.real(depth, layer.depth);
        rows.real(sxx, layer.stress.xx);
        rows.real(syy, layer.stress.yy);
        rows.real(szz, layer.stress.zz);
        rows.real(sxy, layer.stress.xy);
        rows.real(xx, layer.strain.xx);
        rows.real(yy, layer.strain.yy);
        rows.real(zz, layer.strain.zz);
        rows.real(xy, layer.strain.xy);
        rows.real(path, layer.plastic_per_pass);
        rows.real(dang_van, value.worst.value);
        rows.end();
    }
    let comments = [
        "What the unloaded rail keeps, by depth: residual stress (that of manufacturing included), plastic strain (tensor components)",
        "depth_mm: middle of the layer, mm; stress: MPa, tension positive; x along the rail, y upwards, z out of plane",
        "plastic_per_pass: equivalent plastic strain along the way of one passage; dang_van_mpa: largest tau + a p_h of the cycle, MPa",
    ];
    let mut table = header(&comments, &PROFILE_COLUMNS).into_bytes();
    table.extend_from_slice(rows.text(PROFILE_FILE)?);
    Ok(table)
}
