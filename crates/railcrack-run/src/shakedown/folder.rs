//! The results of `railcrack shakedown`, read back.

use super::document::ShakedownSummary;
use super::tables::{LayerRow, PassRow, SectionRow};
use crate::csv::{Table, read_table};
use crate::disk::files::{CYCLE_FILE, SHAKEDOWN_FILE};
use crate::disk::read_json;
use crate::error::OutputError;
use crate::run_folder::{read_case, stored_case};
use railcrack::math::Stress;
use railcrack::mesh::{Array, UnstructuredGrid};
use railcrack::shakedown::PlasticStrain;
use railcrack_case::Case;
use railcrack_vtu::read_vtu;
use std::path::{Path, PathBuf};

/// Stress and plastic strain around the contact: cells in columns, each from the surface down.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CycleField {
    /// Borders of the columns, mm from the centre of the contact: one more than columns.
    pub borders: Vec<f64>,
    /// Borders of the layers, mm: one more than layers.
    pub depths: Vec<f64>,
    /// `stress[column * layers + layer]`, MPa.
    pub stress: Vec<Stress>,
    /// In the same order.
    pub strain: Vec<PlasticStrain>,
}

/// The results of `railcrack shakedown`, read back from their folder.
#[derive(Debug, Clone, PartialEq)]
pub struct ShakedownFolder {
    /// The folder.
    pub path: PathBuf,
    /// Text of `case.toml`.
    pub case_text: String,
    /// `shakedown.json`.
    pub summary: ShakedownSummary,
    /// `profile.csv`: the layers, from the surface down.
    pub profile: Vec<LayerRow>,
    /// `passes.csv`.
    pub passes: Vec<PassRow>,
    /// `cycle.vtu`.
    pub cycle: CycleField,
    /// `section.csv`: by lateral place, then by depth; empty under a line contact.
    pub section: Vec<SectionRow>,
}

impl ShakedownFolder {
    /// Opens the folder `path`.
    ///
    /// Errors: no such state in the folder; a file of it is damaged; the system refuses.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        let summary = read_json(path, SHAKEDOWN_FILE)?;
        let profile: Vec<LayerRow> = read_table(path)?;
        Ok(Self {
            section: if path.join(SectionRow::FILE).is_file() { read_table(path)? } else { Vec::new() },
            cycle: read_cycle(&path.join(CYCLE_FILE), profile.len())?,
            passes: read_table(path)?,
            case_text: stored_case(path)?.unwrap_or_default(),
            path: path.to_path_buf(),
            profile,
            summary,
        })
    }

    /// The case.
    ///
    /// Errors: there is none, or this version does not accept it.
    pub fn case(&self) -> Result<Case, OutputError> {
        read_case(&self.path)
    }
}

/// The cells of `cycle.vtu`, as [`super::fields`] writes them.
fn read_cycle(path: &Path, layers: usize) -> Result<CycleField, OutputError> {
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
    Ok(CycleField {
        borders: borders(&grid, rows),
        depths: grid.points.iter().take(rows).map(|point| -point.y).collect(),
        stress: tensors("stress_mpa")?,
        strain: tensors("plastic_strain")?.iter().map(strain).collect(),
    })
}

fn borders(grid: &UnstructuredGrid, rows: usize) -> Vec<f64> {
    grid.points.iter().step_by(rows).map(|point| point.x).collect()
}
