//! A comparison read back from its folder.

use super::align::Aligned;
use super::files::{COMPARE_COLUMNS, COMPARE_POSITIONS_COLUMNS, JSON_FILE, POSITIONS, TABLE};
use super::stored::TipKey;
use super::{CaseDifference, Comparison, Parting, RunLabel, SifDifference, TipComparison, TipSifs};
use crate::csv::{Row, read_steps};
use crate::folder::read_if_there;
use crate::{CrackSummary, OutputError};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

/// What `compare.json` says that the tables do not.
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
    let path = folder.join(JSON_FILE);
    let text = read_if_there(&path)?
        .ok_or_else(|| OutputError::NotARun { folder: folder.to_path_buf(), file: JSON_FILE })?;
    let document: Document =
        serde_json::from_slice(&text).map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
    let tips = read_tips(&folder.join(TABLE))?;
    let mut positions = read_positions(&folder.join(POSITIONS))?;
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

fn read_tips(path: &Path) -> Result<Vec<TipComparison>, OutputError> {
    let mut tips = Vec::new();
    read_steps(
        path,
        &COMPARE_COLUMNS,
        |_| true,
        |row| {
            let pair = |i: usize| Ok::<_, OutputError>([row.real(i)?, row.real(i + 1)?]);
            let options = |i: usize| Ok::<_, OutputError>([row.optional(i)?, row.optional(i + 1)?]);
            let positions = row.count(3)?;
            let modes = mode(row, 4)?.zip(mode(row, 9)?);
            tips.push(TipComparison {
                step: row.count(0)?,
                crack: row.count(1)?,
                tip: row.count(2)?,
                sifs: modes.map(|(ki, kii)| TipSifs { positions, ki, kii }),
                step_peak: row.real(14)?,
                places: [pair(15)?, pair(17)?],
                distance: row.real(19)?,
                lengths: pair(20)?,
                load_cycles: pair(22)?,
                kink_deg: options(24)?,
                rival_deg: options(26)?,
                rival_ratio: options(28)?,
                stops: [row.text(30).to_owned(), row.text(31).to_owned()],
            });
            Ok(())
        },
    )?;
    Ok(tips)
}

/// The five columns of a mode from column `i` on; none where there was no common position.
fn mode(row: &Row, i: usize) -> Result<Option<SifDifference>, OutputError> {
    let (largest, xc_over_a, rms) = (row.optional(i)?, row.optional(i + 3)?, row.optional(i + 4)?);
    Ok(largest.zip(xc_over_a).zip(rms).map(|((largest, xc_over_a), rms)| SifDifference {
        largest,
        xc_over_a,
        rms,
    }))
}

fn read_positions(path: &Path) -> Result<BTreeMap<TipKey, Aligned>, OutputError> {
    let mut all: BTreeMap<TipKey, Aligned> = BTreeMap::new();
    read_steps(
        path,
        &COMPARE_POSITIONS_COLUMNS,
        |_| true,
        |row| {
            let aligned = all.entry((row.count(0)?, row.count(1)?, row.count(2)?)).or_default();
            aligned.xc_over_a.push(row.real(3)?);
            for (k, first) in [(&mut aligned.ki, 4), (&mut aligned.kii, 7)] {
                for (run, k) in k.iter_mut().enumerate() {
                    k.push(row.real(first + run)?);
                }
            }
            Ok(())
        },
    )?;
    Ok(all)
}
