//! A stabilised plastic state as its folder has it.

use super::document::ShakedownSummary;
use super::{CYCLE_FILE, PASSES_FILE, PROFILE_FILE, SHAKEDOWN_FILE};
use crate::OutputError;
use crate::csv::read_columns;
use crate::folder::{read_if_there, stored_case};
use railcrack::math::Stress;
use railcrack::mesh::{Array, UnstructuredGrid};
use railcrack::shakedown::PlasticStrain;
use railcrack_vtu::read_vtu;
use std::path::Path;

/// What the unloaded rail keeps in a layer: a row of `profile.csv`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StoredLayer {
    /// Depth of its middle, mm.
    pub depth: f64,
    /// σ_xx of the residual stress, MPa.
    pub sxx: f64,
    /// σ_zz of the residual stress, MPa.
    pub szz: f64,
    /// Plastic strain.
    pub strain: PlasticStrain,
    /// Plastic path of a passage.
    pub plastic_per_pass: f64,
    /// τ + a p_h, MPa.
    pub dang_van: f64,
}

/// A row of `passes.csv`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StoredPass {
    /// From 1.
    pub pass: f64,
    /// MPa.
    pub stress_change: f64,
    /// The largest plastic strain after it.
    pub largest_strain: f64,
    /// The largest plastic path of it.
    pub plastic_path: f64,
}

/// Stress and plastic strain around the contact: cells in columns, each from the surface down.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StoredCycle {
    /// Borders of the columns, mm from the centre of the contact: one more than columns.
    pub borders: Vec<f64>,
    /// Borders of the layers, mm: one more than layers.
    pub depths: Vec<f64>,
    /// `stress[column * layers + layer]`, MPa.
    pub stress: Vec<Stress>,
    /// In the same order.
    pub strain: Vec<PlasticStrain>,
}

/// Everything that plots and report show.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredState {
    /// Text of `case.toml`.
    pub case: String,
    pub summary: ShakedownSummary,
    pub profile: Vec<StoredLayer>,
    pub passes: Vec<StoredPass>,
    pub cycle: StoredCycle,
}

impl StoredState {
    /// Errors: no such state in the folder; a file of it is damaged; the system refuses.
    pub fn read(folder: &Path) -> Result<Self, OutputError> {
        let path = folder.join(SHAKEDOWN_FILE);
        let file = SHAKEDOWN_FILE;
        let text = read_if_there(&path)?
            .ok_or_else(|| OutputError::NotARun { folder: folder.to_path_buf(), file })?;
        let summary: ShakedownSummary = serde_json::from_slice(&text)
            .map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        let profile = read_profile(&folder.join(PROFILE_FILE))?;
        Ok(Self {
            case: stored_case(folder)?.unwrap_or_default(),
            cycle: read_cycle(&folder.join(CYCLE_FILE), profile.len())?,
            passes: read_passes(&folder.join(PASSES_FILE))?,
            profile,
            summary,
        })
    }
}

fn read_profile(path: &Path) -> Result<Vec<StoredLayer>, OutputError> {
    let columns = [
        "depth_mm",
        "sxx_mpa",
        "szz_mpa",
        "ep_xx",
        "ep_yy",
        "ep_zz",
        "ep_xy",
        "plastic_per_pass",
        "dang_van_mpa",
    ];
    let layer = |[depth, sxx, szz, xx, yy, zz, xy, plastic_per_pass, dang_van]: [f64; 9]| StoredLayer {
        depth,
        sxx,
        szz,
        strain: PlasticStrain { xx, yy, zz, xy },
        plastic_per_pass,
        dang_van,
    };
    Ok(read_columns(path, &columns)?.into_iter().map(layer).collect())
}

fn read_passes(path: &Path) -> Result<Vec<StoredPass>, OutputError> {
    let columns = ["pass", "stress_change_mpa", "plastic_strain_max", "plastic_path_max"];
    let pass = |[pass, stress_change, largest_strain, plastic_path]: [f64; 4]| StoredPass {
        pass,
        stress_change,
        largest_strain,
        plastic_path,
    };
    Ok(read_columns(path, &columns)?.into_iter().map(pass).collect())
}

/// The cells of `cycle.vtu`, as [`super::fields`] writes them.
fn read_cycle(path: &Path, layers: usize) -> Result<StoredCycle, OutputError> {
    let grid = read_vtu(path)?;
    let rows = layers + 1;
    let damaged = |reason: String| OutputError::damaged(path, reason);
    if grid.points.len() % rows != 0
        || grid.cell_count() != (grid.points.len() / rows).saturating_sub(1) * layers
    {
        let (points, cells) = (grid.points.len(), grid.cell_count());
        return Err(damaged(format!("{points} points and {cells} cells are not columns of {layers} layers")));
    }
    let tensors = |name: &str| -> Result<Vec<Stress>, OutputError> {
        let array = grid.cell_array(name).ok_or_else(|| damaged(format!("no cell data {name}")))?;
        Array::to_stresses(array).map_err(|reason| damaged(reason.to_string()))
    };
    let strain = |s: &Stress| PlasticStrain { xx: s.xx, yy: s.yy, zz: s.zz, xy: s.xy };
    Ok(StoredCycle {
        borders: borders(&grid, rows),
        depths: grid.points.iter().take(rows).map(|point| -point.y).collect(),
        stress: tensors("stress_mpa")?,
        strain: tensors("plastic_strain")?.iter().map(strain).collect(),
    })
}

fn borders(grid: &UnstructuredGrid, rows: usize) -> Vec<f64> {
    grid.points.iter().step_by(rows).map(|point| point.x).collect()
}
