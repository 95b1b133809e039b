//! `growth.csv` read back.

use super::{GROWTH_COLUMNS, GROWTH_FILE, read_steps};
use crate::output::OutputError;
use std::path::Path;

/// A row of `growth.csv`: one tip at one step, in the units of the table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TipRow {
    pub step: usize,
    /// From 1.
    pub crack: usize,
    /// From 1 within its crack.
    pub tip: usize,
    pub place: [f64; 2],
    pub length: f64,
    pub ki_max: f64,
    pub delta_ki: f64,
    pub delta_kii: f64,
    pub delta_keq: f64,
    pub kink_deg: Option<f64>,
    pub rival_deg: Option<f64>,
    pub rival_ratio: Option<f64>,
    pub increment: f64,
    pub rate: f64,
    pub load_cycles: f64,
    pub stop: String,
    /// Growth that is not in its crack yet; `length` counts it.
    pub waiting: f64,
}

/// The rows of the first `steps` steps of the run in `folder`, by step, crack, tip.
///
/// Errors: the table is damaged; the system refuses.
pub(crate) fn read_growth(folder: &Path, steps: usize) -> Result<Vec<TipRow>, OutputError> {
    let mut growth = Vec::new();
    read_steps(
        &folder.join(GROWTH_FILE),
        &GROWTH_COLUMNS,
        |step| step < steps,
        |row| {
            growth.push(TipRow {
                step: row.count(0)?,
                crack: row.count(1)?,
                tip: row.count(2)?,
                place: [row.real(3)?, row.real(4)?],
                length: row.real(5)?,
                ki_max: row.real(6)?,
                delta_ki: row.real(7)?,
                delta_kii: row.real(8)?,
                delta_keq: row.real(9)?,
                kink_deg: row.optional(10)?,
                rival_deg: row.optional(11)?,
                rival_ratio: row.optional(12)?,
                increment: row.real(13)?,
                rate: row.real(14)?,
                load_cycles: row.real(15)?,
                stop: row.text(16).to_owned(),
                waiting: row.real(17)?,
            });
            Ok(())
        },
    )?;
    Ok(growth)
}
