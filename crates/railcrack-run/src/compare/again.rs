//! A comparison read back from its folder.

use super::align::Aligned;
use super::case_keys::CaseDifference;
use super::comparison::Comparison;
use super::parting::Parting;
use super::stored::{RunLabel, TipKey};
use super::tables::{PositionRow, TipComparison};
use crate::csv::read_table;
use crate::disk::files::COMPARE_FILE;
use crate::disk::read_json;
use crate::error::OutputError;
use crate::summary::CrackSummary;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

/// The part of `compare.json` that is not in the tables.
#[derive(Deserialize)]
struct Document {
    runs: [RunLabel; 2],
    case_differences: Vec<CaseDifference>,
    notes: Vec<String>,
    common_steps: usize,
    peak_mpa_sqrt_m: f64,
    tolerance_percent: Option<f64>,
    parting: Option<Parting>,
    paths: [Vec<CrackSummary>; 2],
}

/// The comparison in `folder`, and the tolerance that it was judged by, per cent.
///
/// Errors: no comparison there; a file of it is damaged; the system refuses.
pub fn stored_comparison(folder: &Path) -> Result<(Comparison, Option<f64>), OutputError> {
    let document: Document = read_json(folder, COMPARE_FILE)?;
    let tips: Vec<TipComparison> = read_table(folder)?;
    let mut positions = read_positions(folder)?;
    let of_tip = |tip: &TipComparison| positions.remove(&(tip.step, tip.crack, tip.tip)).unwrap_or_default();
    let comparison = Comparison {
        runs: document.runs,
        case_differences: document.case_differences,
        notes: document.notes,
        common_steps: document.common_steps,
        peak: document.peak_mpa_sqrt_m,
        aligned: tips.iter().map(of_tip).collect(),
        tips,
        parting: document.parting,
        cracks: document.paths,
    };
    Ok((comparison, document.tolerance_percent))
}

fn read_positions(folder: &Path) -> Result<BTreeMap<TipKey, Aligned>, OutputError> {
    let mut all: BTreeMap<TipKey, Aligned> = BTreeMap::new();
    for row in read_table::<PositionRow>(folder)? {
        let aligned = all.entry((row.step, row.crack, row.tip)).or_default();
        aligned.xc_over_a.push(row.xc_over_a);
        for run in 0..2 {
            aligned.ki[run].push(row.ki[run]);
            aligned.kii[run].push(row.kii[run]);
        }
    }
    Ok(all)
}
