//! Histories of the stress intensity factors over the stabilised passages.

use crate::OutputError;
use crate::csv::{SIF_FILE, SifScale, StepBlock, read_step_blocks};
use railcrack::growth::StepRecord;
use railcrack::math::MPA_SQRT_MM;
use std::path::Path;

/// Columns of `sif.csv` that make a [`History`].
pub const HISTORY_COLUMNS: [&str; 7] =
    ["step", "passage", "crack", "tip", "xc_over_a", "ki_mpa_sqrt_m", "kii_mpa_sqrt_m"];

/// K of one tip over the stabilised passage of one step.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History {
    /// Growth step, from 0.
    pub step: usize,
    /// Crack, from 1.
    pub crack: usize,
    /// Tip of the crack, from 1.
    pub tip: usize,
    /// x_c/a by position.
    pub xc_over_a: Vec<f64>,
    /// K_I, MPa √m.
    pub ki: Vec<f64>,
    /// K_II, MPa √m.
    pub kii: Vec<f64>,
}

impl History {
    /// Of every tip, in the order and with the numbers of `sif.csv`.
    pub fn of_record(record: &StepRecord, scale: SifScale) -> Vec<Self> {
        let Some(passage) = record.passages.last() else { return Vec::new() };
        let xc_over_a: Vec<f64> = passage.xc.iter().map(|&xc| scale.over_a(xc)).collect();
        let tips = record.tips.iter().zip(&passage.sifs);
        tips.map(|(tip, sifs)| {
            let (ki, kii) = sifs.iter().map(|sif| (sif.ki / MPA_SQRT_MM, sif.kii / MPA_SQRT_MM)).unzip();
            let (crack, number) = (tip.tip.crack + 1, tip.tip.tip + 1);
            Self { step: record.step, crack, tip: number, xc_over_a: xc_over_a.clone(), ki, kii }
        })
        .collect()
    }

    /// Of every tip, in the order of the table.
    ///
    /// Errors: the table is damaged.
    pub fn of_block(block: &StepBlock) -> Result<Vec<Self>, OutputError> {
        let mut histories: Vec<Self> = Vec::new();
        let mut passage = 0;
        block.rows(|row| {
            // The last passage of a step is the stabilised one: a later passage takes the place of an earlier one.
            let now = row.count(1)?;
            if now != passage {
                passage = now;
                histories.clear();
            }
            let (step, crack, tip) = (block.step, row.count(2)?, row.count(3)?);
            if histories.last().is_none_or(|h| (h.crack, h.tip) != (crack, tip)) {
                histories.push(Self { step, crack, tip, ..Self::default() });
            }
            if let Some(history) = histories.last_mut() {
                history.xc_over_a.push(row.real(4)?);
                history.ki.push(row.real(5)?);
                history.kii.push(row.real(6)?);
            }
            Ok(())
        })?;
        Ok(histories)
    }
}

/// The stabilised passage of every tip at the steps that are `wanted`, in the order of the table.
///
/// Errors: the table is damaged; the system refuses.
pub fn read_histories(folder: &Path, wanted: impl Fn(usize) -> bool) -> Result<Vec<History>, OutputError> {
    let mut histories = Vec::new();
    read_step_blocks(&folder.join(SIF_FILE), &HISTORY_COLUMNS, wanted, |block| {
        histories.append(&mut History::of_block(&block)?);
        Ok(())
    })?;
    Ok(histories)
}
